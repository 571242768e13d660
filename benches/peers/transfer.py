#!/usr/bin/env python3
"""scipy's RBFInterpolator on the nodes that benches/transfer.rs has written into FOLDER: time and errors.

    transfer.py FOLDER
"""
import sys
import time

import numpy as np
from scipy.interpolate import RBFInterpolator

folder = sys.argv[1]
source, target = (np.fromfile(f"{folder}/transfer_{name}.f64").reshape(-1, 6) for name in ("source", "target"))
carried = np.fromfile(f"{folder}/transfer_carried.f64")


def line(who, values, seconds=None):
    errors = np.abs(values - target[:, 5])
    took = "" if seconds is None else f", {seconds:.1f} s"
    print(f"line\t{who}: error max {errors.max():.2e}, rms {np.sqrt(np.mean(errors**2)):.2e}{took}", flush=True)


line("planish, the last grid of cargo bench --bench transfer", carried)
for where, columns in (("x, y, z", slice(0, 3)), ("angle, height", slice(3, 5))):
    start = time.process_time()
    values = RBFInterpolator(source[:, columns], source[:, 5], neighbors=50)(target[:, columns])
    line(f"RBFInterpolator(neighbors=50) over {where}", values, time.process_time() - start)
