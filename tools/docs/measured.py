#!/usr/bin/env python3
"""Runs benchmarks and puts their tables into docs/measured.md, each between the marks of its name.

Usage: tools/docs/measured.py DATA [NAME...]     DATA: the folder of shapes; all tables by default but those that take an hour

A table is what a benchmark prints in lines that begin with a bar; above it stands where it was measured. Nothing else should
run meanwhile.
"""

import os
import re
import subprocess
import sys
from datetime import date
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs/measured.md"
OPEN_MESHES = ["maxface_disk_4k.off", "camelhead_disk_11k.off", "igea_disk_43k.ply", "neon_side_holes_16k.off",
               "blow_shell_displacement.ply", "mannequin_disk_13k.off", "airplane_holes_8k.off"]
CLOSED_MESHES = ["hammer_closed_30k.ply", "igea_closed_45k.ply", "igea_closed_134k.ply"]
# The benchmark of each table and its arguments, DATA in place of the folder.
TABLES = {
    "fits of meshes": ["tensor_fit", *(f"DATA/{name}" for name in OPEN_MESHES)],
    "fits of samples": ["tensor_fit", "--tolerance", "1e-3", "DATA/synthetic/ridges_45k.f64",
                        "held:DATA/synthetic/ridges_held_100k.f64"],
    "seeded surfaces": ["robustness"],
    "PHT fits of samples": ["pht", "points", "DATA"],
    "PHT conversions": ["pht", "convert", "DATA"],
    "PHT evaluation": ["pht", "evaluate"],
    "a large model": ["models", "ball", "1e-3"],
    "sample parts": ["exact_parts", "samples"],
    "seeded blocks": ["models_robustness"],
    "seeded parts": ["exact_parts", "200", "0,0.01,0.05"],
    "D1RC-splines": ["d1rc", "DATA/mask_control_1290.off"],
    "D1RC over many neighbours": ["d1rc", "--fan"],
    "D1RC fits": ["d1rc_fit", "--control", "1290", "DATA/maxface_disk_4k.off", "DATA/mannequin_disk_13k.off"],
    "skins": ["skin"],
    "collapsed meshes": ["decimate", "--field", "1000000", *(f"DATA/{name}" for name in CLOSED_MESHES)],
    "evaluation": ["evaluate"],
    "fields": ["field"],
    "transfers": ["transfer"],
    "reading": ["mesh_read"],
    "plane maps": ["parameterize"],
    "sphere maps": ["sphere", "--threads", "2", "--ball", "100000", *(f"DATA/{name}" for name in CLOSED_MESHES)],
    "closest points": ["project"],
    "cancelling": ["cancel"],
}
SLOW = ["seeded blocks", "seeded parts"]


def run(data, bench, *arguments):
    """The tables that a benchmark prints, an empty line between two."""
    command = ["cargo", "bench", "--locked", "--bench", bench, "--", *(a.replace("DATA", data) for a in arguments)]
    lines = []
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=PAGE.parents[1]) as process:
        for line in process.stdout:
            print(line, end="", flush=True)
            lines.append(line if line.startswith("|") else "\n")
    tables = re.sub(r"\n{2,}", "\n\n", "".join(lines)).strip()
    if process.returncode or not tables:
        sys.exit(f"measured: {' '.join(command)} failed")
    return tables + "\n"


def where():
    """On which machine, when and of which version: the line above a table."""
    names = re.findall(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    processor = names[0] if names else "a processor without a name"
    version = subprocess.run(["git", "describe", "--always"], check=True, capture_output=True, text=True, cwd=PAGE.parent)
    load = os.getloadavg()[0]
    return f"*{processor}, {os.cpu_count()} hardware threads, load {load:.1f} before, {date.today()}, at {version.stdout.strip()}.*\n\n"


def marks(name):
    return re.compile(rf"(<!-- table of {re.escape(name)} -->\n)(.*?)(<!-- end of table -->\n)", re.DOTALL)


def between(page, name):
    """What stands between the marks of a name."""
    found = marks(name).findall(page)
    if len(found) != 1:
        sys.exit(f"measured: {PAGE.name} has {len(found)} places for the table of {name}")
    return found[0][1]


def put(name, text):
    """Puts a text between the marks of a name."""
    page = PAGE.read_text()
    between(page, name)
    PAGE.write_text(marks(name).sub(lambda found: found[1] + text + found[3], page))


def main():
    data, *names = sys.argv[1:]
    for name in names or [name for name in TABLES if name not in SLOW]:
        above = where()
        put(name, above + run(str(Path(data).resolve()), *TABLES[name]))


if __name__ == "__main__":
    main()
