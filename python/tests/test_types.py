"""The package carries its types in its own source (`py.typed`): each public name tells those of its arguments and result."""

import inspect
import subprocess
import sys
import typing
from pathlib import Path

import pytest

import planish

PUBLIC = [name for name in planish.__all__ if not name.startswith("_")]


def _functions(name):
    """The function of this name, or the methods and properties of the class, inherited ones included."""
    found = getattr(planish, name)
    if inspect.isfunction(found):
        yield name, found
    elif inspect.isclass(found):
        for part, member in inspect.getmembers(found):
            member = member.fget if isinstance(member, property) else inspect.unwrap(member) if callable(member) else member
            own = part == "__init__" or part == "__call__" or not part.startswith("_")
            if own and inspect.isfunction(getattr(member, "__func__", member)):
                yield f"{name}.{part}", getattr(member, "__func__", member)


@pytest.mark.parametrize("name", PUBLIC)
def test_arguments_and_results_have_types(name):
    for where, function in _functions(name):
        if not function.__module__.startswith("planish"):
            continue
        signature = inspect.signature(function)
        bare = [
            argument.name
            for place, argument in enumerate(signature.parameters.values())
            if argument.annotation is inspect.Parameter.empty and not (place == 0 and argument.name in ("self", "cls"))
        ]
        assert not bare, f"{where}: {bare}"
        if where.rpartition(".")[2] != "__init__":
            assert signature.return_annotation is not inspect.Signature.empty, where
        typing.get_type_hints(function)  # all names in them are known


def test_checkers_are_told_that_there_are_types():
    assert (Path(planish.__file__).parent / "py.typed").exists()


def test_a_users_program_passes_a_strict_checker(tmp_path):
    """Without stubs: checkers read the types in the package itself."""
    pytest.importorskip("mypy")
    program = Path(__file__).with_name("typed_program.py")
    checker = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(program)]
    done = subprocess.run(checker, capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
