"""Modules of the package know those below them and nothing above."""

import ast
from graphlib import TopologicalSorter
from pathlib import Path

import planish


def _imported(path):
    """The modules of the package that one imports, wherever in it."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            yield from [node.module] if node.module else (name.name for name in node.names)


def test_imports_run_one_way():
    paths = list(Path(planish.__file__).parent.glob("*.py"))
    # raises where imports go round
    order = list(TopologicalSorter({path.stem: set(_imported(path)) for path in paths}).static_order())
    assert order[0] == "_abi" and order[-1] == "__init__"
