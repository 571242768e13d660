#!/usr/bin/env python3
"""Fits the closed meshes of the data folder by default and with --smooth, and writes the rows into docs/measured.md.

Usage: tools/docs/models.py TOOL DATA     TOOL: a release build of planish

Errors are in parts of the diagonal; seconds are processor time of the whole command, with reading and the STEP file.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from measured import put, where

MESHES = {
    "igea, 44,992 nodes": "igea_closed_45k.ply",
    "igea, 134,345 nodes": "igea_closed_134k.ply",
    "hammer": "hammer_closed_30k.ply",
    "rocker arm, genus 1": "rockerarm_genus1_10k.off",
    "bullet": "bullet_closed_14k.ply",
    "fandisk": "fandisk_closed_6k.off",
}
HEAD = ("mesh", "tolerance", "options", "patches, planes", "control points", "nodes", "between", "model to mesh", "normal jump",
        "folds", "crossings", "volume beside the mesh's", "faces", "seconds", "MB")


def fit(tool, mesh, options, folder):
    """The report of a fit, with the seconds and megabytes that its process took."""
    command = [tool, "fit", mesh, *options, "--threads", "2", "--json", "--out", Path(folder, "model.step")]
    with tempfile.TemporaryFile() as out:
        process = subprocess.Popen(command, stdout=out)
        _, status, usage = os.wait4(process.pid, 0)
        # 2: the tolerance was not met, and the report says so
        if os.waitstatus_to_exitcode(status) not in (0, 2):
            sys.exit(f"models: {' '.join(map(str, command))} failed")
        out.seek(0)
        return json.load(out), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def row(name, tolerance, options, made):
    report, seconds, megabytes = made
    share = lambda key: f"{report[key] / report['diagonal']:.2g}"
    planes = sum(component["exact_face_count"] for component in report["components"])
    folds = sum(component["fold_count"] for component in report["components"]) + report["folded_cells"]
    beside = abs(report["volume"] / report["mesh_volume"] - 1)
    return (name, tolerance, options, f"{report['patch_count']}, {planes}", f"{report['coefficient_count']:,}", share("max_error"),
            f"{share('max_interior_error')} ({share('facet_sagitta')})", share("max_back_distance"),
            f"{report['normal_jump']:.0e}", folds, report["crossings"], f"{beside:.1e}", report["face_count"],
            f"{seconds:.1f}", f"{megabytes:.0f}")


def line(cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def main():
    tool, data = sys.argv[1:]
    above = where()
    lines = [line(HEAD), "|" + "---|" * len(HEAD)]
    with tempfile.TemporaryDirectory() as folder:
        for name, file in MESHES.items():
            for tolerance in ["1e-3", "1e-2"]:
                for options in [[], ["--smooth"]]:
                    made = fit(tool, Path(data, file), ["--tolerance", tolerance, *options], folder)
                    lines.append(line(row(name, tolerance, " ".join(options), made)))
                    print(lines[-1], flush=True)
    put("closed models", above + "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
