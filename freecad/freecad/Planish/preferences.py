"""The preferences page: its file, and the values with their defaults."""

import os

import FreeCAD

from . import DIRECTORY

PAGE = os.path.join(DIRECTORY, "resources", "preferences.ui")


def group():
    """Where FreeCAD keeps the values."""
    return FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Planish")


def default_tolerance():
    """Millimetres; 0 takes a thousandth of the size."""
    return group().GetFloat("Tolerance", 0.0)


def shows_colours():
    """Whether deviation colours follow a fit."""
    return group().GetBool("Colours", True)
