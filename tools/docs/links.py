"""Checks the pages: every relative link leads to a file and a heading that are there, and the table of contents names every page.

Usage: links.py ROOT
"""

import re
import sys
from pathlib import Path


def anchors(text):
    """The anchors that headings get: lower case, blanks as hyphens, nothing but letters, digits, hyphens and underscores."""
    found = set()
    for heading in re.findall(r"^#+ +(.+)$", without_code(text), re.M):
        words = re.sub(r"[`*]|\[([^]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        found.add(re.sub(r"[^\w\- ]", "", words).replace(" ", "-"))
    return found


def without_code(text):
    return re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)


def broken_links(page):
    text = page.read_text()
    for target in re.findall(r"\]\(([^)\s]+)\)", without_code(text)):
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        place = (page.parent / name).resolve() if name else page
        if not place.exists():
            yield f"{target}: no such file"
        elif anchor and place.suffix == ".md" and anchor not in anchors(place.read_text()):
            yield f"{target}: no such heading"


def main(root):
    docs = root / "docs"
    pages = sorted(docs.rglob("*.md"))
    summary = docs / "SUMMARY.md"
    failures = []
    for page in [root / "README.md", root / "CHANGELOG.md", *pages]:
        failures += [f"{page.relative_to(root)}: {broken}" for broken in broken_links(page)]
    named = {(docs / target).resolve() for target in re.findall(r"\]\(([^)#]+)\)", summary.read_text())}
    failures += [f"SUMMARY.md lacks {page.relative_to(docs)}" for page in pages if page.resolve() not in named | {summary.resolve()}]
    for failure in failures:
        print(failure, file=sys.stderr)
    print(f"{len(pages) + 2} pages, {len(failures)} broken links")
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
