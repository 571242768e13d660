"""Checks the page of statuses: every planish_status but OK, and every planish_remark, of planish.h stands there.

Usage: statuses.py ROOT
"""

import json
import re
import sys
from pathlib import Path

ENUMERATIONS = ("planish_status", "planish_remark")


def main(root):
    api = json.loads((root / "bindings/planish.api.json").read_text())
    words = set(re.findall(r"[A-Z_]{2,}", (root / "docs/statuses.md").read_text()))
    names = [
        value["name"].removeprefix(f"{enumeration['name'].upper()}_")
        for enumeration in api["enumerations"]
        if enumeration["name"] in ENUMERATIONS
        for value in enumeration["enumerators"]
        if value["value"] != 0
    ]
    missing = [name for name in names if name not in words]
    for name in missing:
        print(f"docs/statuses.md lacks {name}", file=sys.stderr)
    print(f"{len(names)} statuses and remarks, {len(missing)} missing")
    return bool(missing)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
