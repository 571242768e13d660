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
MESHES = ["maxface_disk_4k.off", "camelhead_disk_11k.off", "igea_disk_43k.ply", "neon_side_holes_16k.off",
          "blow_shell_displacement.ply", "mannequin_disk_13k.off", "airplane_holes_8k.off"]
# The benchmark of each table and its arguments, DATA in place of the folder.
TABLES = {
    "fits of meshes": ["tensor_fit", *(f"DATA/{name}" for name in MESHES)],
    "PHT fits of samples": ["pht", "points", "DATA"],
    "PHT fits as patches": ["pht", "convert", "DATA"],
    "skins": ["skin"],
    "evaluation": ["evaluate"],
    "fields": ["field"],
    "transfers": ["transfer"],
    "closest points": ["project"],
    "cancelling": ["cancel"],
    "seeded blocks": ["models_robustness"],
    "seeded parts": ["exact_parts", "200", "0,0.01,0.05"],
}
SLOW = ["seeded blocks", "seeded parts"]


def run(data, bench, *arguments):
    """The table that a benchmark prints."""
    command = ["cargo", "bench", "--locked", "--bench", bench, "--", *(a.replace("DATA", data) for a in arguments)]
    table = []
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=PAGE.parents[1]) as process:
        for line in process.stdout:
            print(line, end="", flush=True)
            if line.startswith("|"):
                table.append(line)
    if process.returncode or not table:
        sys.exit(f"measured: {' '.join(command)} failed")
    return "".join(table)


def commit():
    return subprocess.run(["git", "describe", "--always", "--dirty"], check=True, capture_output=True, text=True).stdout.strip()


def processor():
    names = re.findall(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    return f"{names[0] if names else 'a processor without a name'}, {os.cpu_count()} hardware threads"


def put(name, text):
    """Puts a text between the marks of a name."""
    pattern = re.compile(rf"(<!-- table of {re.escape(name)} -->\n).*?(<!-- end of table -->\n)", re.DOTALL)
    page, count = pattern.subn(lambda marks: marks[1] + text + marks[2], PAGE.read_text())
    if count != 1:
        sys.exit(f"measured: {PAGE.name} has {count} places for the table of {name}")
    PAGE.write_text(page)


def main():
    data, *names = sys.argv[1:]
    for name in names or [name for name in TABLES if name not in SLOW]:
        where = f"*{processor()}, load {os.getloadavg()[0]:.1f} before, {date.today()}, at {commit()}.*\n\n"
        put(name, where + run(str(Path(data).resolve()), *TABLES[name]))


if __name__ == "__main__":
    main()
