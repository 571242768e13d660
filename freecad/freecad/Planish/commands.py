"""Menu and toolbar."""

import FreeCAD
import FreeCADGui

from . import convert, features, icon, preferences
from . import translate as tr


def _selected():
    """What is selected and has triangles."""
    return [obj for obj in FreeCADGui.Selection.getSelection() if convert.is_source(obj)]


def _fitted():
    chosen = FreeCADGui.Selection.getSelection()
    return [obj for obj in chosen if isinstance(getattr(obj, "Proxy", None), features.Fitted)]


def _one_mesh():
    return len(_selected()) == 1


class Command:
    """A command of FreeCAD that does one thing as one step to undo."""

    def __init__(self, name, text, tip, picture, is_active, run):
        self.name, self.text, self.tip, self.picture = name, text, tip, picture
        self.is_active, self.run = is_active, run

    def GetResources(self):
        return {"MenuText": tr(self.text), "ToolTip": tr(self.tip), "Pixmap": icon(self.picture)}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None and self.is_active()

    def Activated(self):
        self.run()


def _with_panel(kind):
    """Makes an object of the selected mesh and opens its panel, which commits or aborts."""

    def run():
        FreeCAD.ActiveDocument.openTransaction(tr("Fit"))
        obj = features.make(kind, Source=_selected()[0])
        obj.Tolerance = preferences.default_tolerance()
        FreeCADGui.ActiveDocument.setEdit(obj.Name)

    return run


def _at_once(title, make):
    """Makes objects and recomputes them as one step."""

    def run():
        document = FreeCAD.ActiveDocument
        document.openTransaction(tr(title))
        try:
            make()
            document.recompute()
            document.commitTransaction()
        except Exception as error:
            document.abortTransaction()
            FreeCAD.Console.PrintError(f"Planish: {error}\n")

    return run


def _skin():
    features.make("Skin", Sections=FreeCADGui.Selection.getSelection())


def _decimate():
    features.make("Decimate", Source=_selected()[0])


def _creased():
    features.make("SmoothCreased", Source=_selected()[0])


def _deviation():
    meshes = _selected()
    for obj in _fitted():
        features.make("Deviation", Fitted=obj, Source=meshes[0] if meshes else None)


def _export():
    try:
        from PySide import QtWidgets
    except ImportError:
        from PySide2 import QtWidgets
    path, _ = QtWidgets.QFileDialog.getSaveFileName(None, tr("Export STEP"), "", "STEP (*.step *.stp)")
    if path:
        _at_once("Export STEP", lambda: features.make("ExportSTEP", Fitted=_fitted()[0], Path=path))()


def _several():
    return len(FreeCADGui.Selection.getSelection()) > 1


COMMANDS = (
    Command(
        "Planish_FitSurface", "Fit surface", "A smooth trimmed face over the selected open mesh or rows of points", "fit",
        _one_mesh, _with_panel("FitSurface"),
    ),
    Command(
        "Planish_SolidFromMesh", "Solid from mesh", "A solid of smooth patches from the selected mesh",
        "solid", _one_mesh, _with_panel("SolidFromMesh"),
    ),
    Command(
        "Planish_Skin", "Skin sections", "One surface through the selected sections, whatever their numbers of points",
        "skin", _several, _at_once("Skin sections", _skin),
    ),
    Command(
        "Planish_SmoothCreased", "Smooth creased", "A smooth surface over a coarse mesh that keeps its sharp edges",
        "creased", _one_mesh, _at_once("Smooth creased", _creased),
    ),
    Command(
        "Planish_Decimate", "Decimate", "Fewer nodes, the same shape", "decimate",
        _one_mesh, _at_once("Decimate", _decimate),
    ),
    Command(
        "Planish_Deviation", "Deviation", "Colours the mesh by its distance from the fitted shape", "deviation",
        lambda: bool(_fitted()), _at_once("Deviation", _deviation),
    ),
    Command(
        "Planish_ExportSTEP", "Export STEP", "Writes the fitted shape to a STEP file", "export",
        lambda: len(_fitted()) == 1, _export,
    ),
)  # fmt: skip


def register():
    """Tells FreeCAD the commands; returns their names."""
    for command in COMMANDS:
        FreeCADGui.addCommand(command.name, command)
    return [command.name for command in COMMANDS]
