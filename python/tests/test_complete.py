"""Everything in the C header can be reached from Python."""

import re
from pathlib import Path

import planish
from planish import _abi

#: What Python does without: records have their defaults from _abi, handles their own copies and locations.
NOT_NEEDED = {
    "planish_status_name": "the names of the statuses stand in _abi",
    "planish_surface_patch_at": "evaluation finds patches by itself",
}


def _source():
    folder = Path(planish.__file__).parent
    return "\n".join(path.read_text() for path in sorted(folder.glob("*.py")) if path.name != "_abi.py")


def test_every_function_is_called_somewhere():
    source = _source()
    assert not [name for name in NOT_NEEDED if name in source], "not needed, but used"
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


def test_calls_that_can_be_cancelled_hear_ctrl_c():
    """Wherever options have a flag that cancels, the call runs as a `LongCall`, which raises it."""
    source = _source()
    for name, kind in vars(_abi).items():
        record = name.removeprefix("planish_") if isinstance(kind, type) else ""
        if record and any(field == "cancel" for field, *_ in getattr(kind, "_fields_", ())):
            made = len(re.findall(rf'\boptions\(\s*"{record}"', source))
            heard = len(re.findall(rf'long\.fields\("{record}"\)', source))
            assert heard >= made, f"{record} is filled {made} times, {heard} times for a call that can be cancelled"
