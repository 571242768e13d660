"""Checks the site that mdBook made: every link and picture within it leads to a file, and to an anchor of that file.

Usage: site.py FOLDER
"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """The anchors of a page and where it leads."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.targets = set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(value for name in ("id", "name") if (value := values.get(name)))
        self.targets += [value for name in ("href", "src") if (value := values.get(name))]


def main(folder):
    paths = [path for path in sorted(folder.rglob("*.html")) if path.name not in ("print.html", "toc.html", "404.html")]
    pages = {path.resolve(): Page(path) for path in paths}
    failures = []
    for path, page in pages.items():
        for target in page.targets:
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            place = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not place.exists():
                failures.append(f"{path.relative_to(folder)}: {target}: no such file")
            elif parts.fragment and place in pages and unquote(parts.fragment) not in pages[place].anchors:
                failures.append(f"{path.relative_to(folder)}: {target}: no such anchor")
    for failure in failures:
        print(failure, file=sys.stderr)
    print(f"{len(pages)} pages of the site, {len(failures)} broken links")
    return bool(failures) or not pages


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
