"""Puts the shared library into the wheel: the one that PLANISH_LIBRARY names, or the one that cargo builds from this tree.

The package is pure ctypes, so one wheel suits every Python 3 of a platform: py3-none-PLATFORM.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py

NAME = {"darwin": "libplanish.dylib", "win32": "planish.dll"}.get(sys.platform, "libplanish.so")
TREE = Path(__file__).resolve().parent.parent


def built_library() -> Path:
    """Builds the library from the tree around this file."""
    if not (TREE / "Cargo.toml").exists():
        sys.exit("planish: name a built library in PLANISH_LIBRARY, or install from the whole source tree")
    target = Path(os.environ.get("CARGO_TARGET_DIR", TREE / "target"))
    subprocess.run(["cargo", "build", "--release", "--locked", "--lib"], check=True, cwd=TREE)
    return target / "release" / NAME


class BuildWithLibrary(build_py):
    """Copies the library beside the modules."""

    def run(self) -> None:
        super().run()
        given = os.environ.get("PLANISH_LIBRARY")
        source = Path(given) if given else built_library()
        shutil.copyfile(source, Path(self.build_lib) / "planish" / (NAME if source.suffix != ".dll" else "planish.dll"))


class PlatformWheel(bdist_wheel):
    """A wheel of one platform for every Python 3."""

    def finalize_options(self) -> None:
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


class WithLibrary(Distribution):
    """Not pure: else the library would land where only Python files belong."""

    def has_ext_modules(self) -> bool:
        return True


setup(distclass=WithLibrary, cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel})
