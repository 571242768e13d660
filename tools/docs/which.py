"""Checks the page of tasks: every function of planish.h stands there, and every name there is a function.

Usage: which.py ROOT

A name that begins with `_` goes on at the end of some beginning of the last whole name in its cell.
"""

import json
import re
import sys
from pathlib import Path

#: Records are filled, handles copied and freed, and arrays sized in every task.
ANYWHERE = ("_init", "_free", "_clone", "_count")


def named(text, functions):
    """The functions that a page names, and the names that are none."""
    found, unknown = set(), set()
    for cell in re.split(r"[|\n]", text):
        whole = None
        for name in re.findall(r"`(planish_\w+|_\w+)`", cell):
            if name in ANYWHERE:
                continue
            whole = name if name.startswith("planish_") else _continued(whole, name, functions)
            if whole in functions:
                found.add(whole)
            else:
                unknown.add(name)
    return found, unknown


def _continued(whole, ending, functions):
    """`planish_mesh_read` and `_buffer` are `planish_mesh_read_buffer`; the longest beginning that makes a function counts."""
    words = (whole or "").split("_")
    candidates = ("_".join(words[:count]) + ending for count in range(len(words), 0, -1))
    return next((name for name in candidates if name in functions), None)


def main(root):
    api = json.loads((root / "bindings/planish.api.json").read_text())
    functions = {function["name"] for function in api["functions"]}
    found, unknown = named((root / "docs/which-function.md").read_text(), functions)
    missing = {name for name in functions - found if not name.endswith(ANYWHERE)}
    for name in sorted(missing):
        print(f"docs/which-function.md lacks {name}", file=sys.stderr)
    for name in sorted(unknown):
        print(f"docs/which-function.md names {name}, which is no function", file=sys.stderr)
    print(f"{len(found)} functions by task, {len(missing)} missing, {len(unknown)} unknown")
    return bool(missing or unknown)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
