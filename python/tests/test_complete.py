"""Everything in the C header can be reached from Python."""

import re
from pathlib import Path

import planish
from planish import _abi

#: What Python does without: records have their defaults from _abi, handles their own copies and locations.
NOT_NEEDED = {
    "planish_status_name": "the names of the statuses stand in _abi",
    "planish_pht_cell_at": "evaluation finds cells by itself",
    "planish_surface_patch_at": "evaluation finds patches by itself",
}


def test_every_function_is_called_somewhere():
    folder = Path(planish.__file__).parent
    source = "\n".join(path.read_text() for path in folder.glob("*.py") if path.name != "_abi.py")
    missing = [name for name in _abi.FUNCTIONS if not _is_named(name, source) and name not in NOT_NEEDED]
    assert not missing, f"not reachable from Python: {missing}"


def _is_named(name, source):
    """Whether the name stands in the source, or follows from a pattern that does."""
    if name in source or name.endswith("_init"):
        return True
    for pattern in re.findall(r"planish_[a-z0-9_]*\{[a-z_()]+\}[a-z0-9_]*", source):
        if re.fullmatch(re.sub(r"\{[^}]*\}", "[a-z0-9]+", pattern), name):
            return True
    return False
