#!/usr/bin/env bash
# Strong and weak scaling of a batch of faces on 1 and 2 MPI ranks, one thread each: medians of several runs, as a table in Markdown.
# Usage: benches/mpi.sh [FACES [REPEATS]]   after `cmake --build build`; PROGRAM names another build of examples/mpi/faces.c
set -euo pipefail
cd "$(dirname "$0")/.."

faces=${1:-1000}
repeats=${2:-7}
program=${PROGRAM:-build/examples/example_faces_c}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1

# The runs take turns, so that a change in the machine's load meets all alike.
for ((i = 0; i < repeats; ++i)); do
  mpiexec -n 1 "$program" "$faces"
  mpiexec -n 2 "$program" "$faces"
  mpiexec -n 2 "$program" "$((2 * faces))"
done | python3 -c '
import re, statistics, sys
runs = {}
for line in sys.stdin:
    found = re.fullmatch(r"(\d+) ranks, (\d+) faces.* equal to the serial run, (\S+) s, serial (\S+) s\n", line)
    ranks, faces = int(found[1]), int(found[2])
    runs.setdefault((ranks, faces), []).append((float(found[3]), float(found[4])))
load = open("/proc/loadavg").read().split()[0]
median = {case: [statistics.median(column) for column in zip(*times)] for case, times in runs.items()}
(_, least), (one, _) = min(median.items())
print(f"Medians of {len(runs[1, least])} runs of each, which took turns; load {load} at the end.\n")
print("| ranks | faces | seconds | the same serially, in the same runs | scaling | against one rank | against the serial part |")
print("|---|---|---|---|---|---|---|")
for (ranks, faces), (together, serial) in sorted(median.items()):
    kind = "" if ranks == 1 else "strong" if faces == least else "weak"
    share = one / together / ranks * (faces / least)
    print(f"| {ranks} | {faces:,} | {together:.2f} | {serial:.2f} | {kind} | {share:.2f} | {serial / together / ranks:.2f} |")
'
