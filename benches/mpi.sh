#!/usr/bin/env bash
# Median seconds of a batch of faces on 1 and 2 MPI ranks, one thread each, over several runs.
# Usage: benches/mpi.sh [FACES [REPEATS]]   after `cmake --build build`
set -euo pipefail
cd "$(dirname "$0")/.."

faces=${1:-1000}
repeats=${2:-7}
program=${BUILD:-build}/examples/example_faces_c
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1

# The runs take turns, so that a change in the machine's load meets all alike.
for ((i = 0; i < repeats; ++i)); do
  for ranks in 1 2; do
    mpiexec -n "$ranks" "$program" "$faces"
  done
done | python3 -c '
import re, statistics, sys
seconds = {}
for line in sys.stdin:
    ranks, together, serial = re.fullmatch(r"(\d+) ranks.* equal to the serial run, (\S+) s, serial (\S+) s\n", line).groups()
    seconds.setdefault(int(ranks), []).append((float(together), float(serial)))
one = statistics.median(together for together, _ in seconds[1])
for ranks, runs in seconds.items():
    together = statistics.median(run[0] for run in runs)
    serial = statistics.median(run[1] for run in runs)
    print(f"{ranks} ranks: {together:.3f} s, serial {serial:.3f} s, {one / together:.2f} times one rank")
'
