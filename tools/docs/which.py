"""Checks the page of tasks: every function of planish.h stands there, and every name there is a function.

Usage: which.py ROOT
"""

import json
import re
import sys
from pathlib import Path

#: Records are filled, handles copied and freed, and arrays sized in every task.
ANYWHERE = ("_init", "_free", "_clone", "_count")


def main(root):
    api = json.loads((root / "bindings/planish.api.json").read_text())
    functions = {function["name"] for function in api["functions"]}
    named = set(re.findall(r"`(planish_\w+)`", (root / "docs/which-function.md").read_text()))
    unknown = named - functions
    missing = {name for name in functions - named if not name.endswith(ANYWHERE)}
    for name in sorted(missing):
        print(f"docs/which-function.md lacks {name}", file=sys.stderr)
    for name in sorted(unknown):
        print(f"docs/which-function.md names {name}, which is no function", file=sys.stderr)
    print(f"{len(named & functions)} functions by task, {len(missing)} missing, {len(unknown)} unknown")
    return bool(missing or unknown)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
