"""Planish for FreeCAD. Importing this package needs no window: macros and freecadcmd use `features` as the commands do."""

import os
import sys

DIRECTORY = os.path.dirname(os.path.abspath(__file__))

# the add-on carries the package planish with its library beside freecad/; FreeCAD's window does not look at PYTHONPATH
_BUNDLED = os.path.dirname(os.path.dirname(DIRECTORY))
if os.path.isdir(os.path.join(_BUNDLED, "planish")) and _BUNDLED not in sys.path:
    sys.path.append(_BUNDLED)


def icon(name):
    """The path of an icon."""
    return os.path.join(DIRECTORY, "resources", "icons", name + ".svg")


def translate(text):
    """A text in the user's language."""
    import FreeCAD

    return FreeCAD.Qt.translate("Planish", text)
