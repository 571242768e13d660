"""The panel in a real window, driven as a user would: preview, cancel, preview, OK, undo, redo, save.

Runs inside FreeCAD's window; pictures and a log go into the folder PLANISH_PICTURES. Exits with 1 on the first failure.
"""

import os
import subprocess
import sys
import time
import traceback

import FreeCAD
import FreeCADGui
import numpy as np

try:
    from PySide import QtCore
except ImportError:
    from PySide2 import QtCore

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
PICTURES = os.environ["PLANISH_PICTURES"]
log = open(os.path.join(PICTURES, "window.log"), "w")


def say(*words):
    print("window:", *words, file=log, flush=True)


def picture(name):
    """The whole screen, 3-D view and panel together."""
    subprocess.run(["import", "-window", "root", os.path.join(PICTURES, name + ".png")], check=False)


def wait(milliseconds):
    """Lets the window work."""
    loop = QtCore.QEventLoop()
    QtCore.QTimer.singleShot(milliseconds, loop.quit)
    loop.exec_() if hasattr(loop, "exec_") else loop.exec()


def wait_until(condition, seconds, what):
    end = time.perf_counter() + seconds
    while not condition():
        assert time.perf_counter() < end, f"waited {seconds} s for {what}"
        wait(20)


def panel():
    """The panel that is open."""
    import gc

    from freecad.Planish.panel import Panel

    return [obj for obj in gc.get_objects() if isinstance(obj, Panel)][-1]


def main():
    import shapes

    FreeCADGui.activateWorkbench("PlanishWorkbench")
    commands = [name for name in FreeCADGui.listCommands() if name.startswith("Planish_")]
    say(len(commands), "commands")
    assert len(commands) == 7

    document = FreeCAD.newDocument("scan")
    scan = document.addObject("Mesh::Feature", "Scan")
    scan.Mesh = shapes.sheet(220, 200)
    FreeCADGui.activeDocument().activeView().viewAxonometric()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    FreeCADGui.Selection.addSelection(scan)
    assert FreeCADGui.Command.get("Planish_FitSurface").isActive()
    FreeCADGui.runCommand("Planish_FitSurface")
    wait(500)
    form = panel()
    obj = form.obj

    # a fit that takes long is cancelled while the window lives on
    form.tolerance.setProperty("rawValue", 1e-6)
    form.start()
    beats = []
    timer = QtCore.QTimer()
    timer.timeout.connect(lambda: beats.append(time.perf_counter()))
    timer.start(20)
    wait(1500)
    picture("panel-running")
    assert form.worker is not None, "the fit ended before it could be cancelled"
    asked = time.perf_counter()
    form.halt()
    wait_until(lambda: form.worker is None, 30, "the cancelled fit")
    say(f"cancelled after {time.perf_counter() - asked:.2f} s, {form.text.text()!r}")
    gaps = np.diff(beats)
    say(f"longest stand-still of the window {gaps.max():.2f} s")
    timer.stop()
    assert not obj.Shape.Faces, "a cancelled fit changes nothing"

    # preview, with colours
    form.tolerance.setProperty("rawValue", 0.2)
    form.colour.setChecked(True)
    form.start()
    wait_until(lambda: form.worker is None, 120, "the preview")
    wait(800)
    assert obj.Shape.isValid() and obj.MaxError.Value <= 0.2 and "met" in form.text.text(), form.text.text()
    picture("panel-done")
    say("fitted:", form.text.text())
    assert form.form.minimumSizeHint().width() <= 300, "the panel fits a column of 300 pixels"

    # OK is one step: undo takes all of it away, redo brings it back
    assert form.accept()
    wait(300)
    count = len(document.Objects)
    assert document.UndoNames, "there is something to undo"
    document.undo()
    assert len(document.Objects) == 1, [obj.Name for obj in document.Objects]
    document.redo()
    document.recompute()
    assert len(document.Objects) == count
    fitted = document.getObject(obj.Name)
    assert fitted.Shape.isValid()
    document.saveAs(os.path.join(PICTURES, "scan.FCStd"))
    picture("face")
    say("panel, undo, redo and save pass")


def gallery():
    """One picture of each kind of object, as the documentation shows them."""
    import Part
    import shapes

    from freecad.Planish import features

    def shown(name, *objects):
        """The objects alone, from the front above. What a picture shows is not one colour."""
        FreeCAD.ActiveDocument.recompute()
        for obj in FreeCAD.ActiveDocument.Objects:
            obj.ViewObject.Visibility = obj in objects
        view = FreeCADGui.activeDocument().activeView()
        view.viewAxonometric()
        view.fitAll()
        wait(200)
        path = os.path.join(PICTURES, f"freecad-{name}.png")
        view.saveImage(path, 640, 400, "White")
        colours = subprocess.run(["identify", "-format", "%k", path], capture_output=True, text=True, check=True).stdout
        assert int(colours) > 50, f"{name}: {colours} colours"

    document = FreeCAD.newDocument("gallery")
    scan = document.addObject("Mesh::Feature", "Scan")
    scan.Mesh = shapes.jagged(40)
    ball = document.addObject("Mesh::Feature", "Ball")
    ball.Mesh = shapes.ball()
    face = features.make("FitSurface", Source=scan, Tolerance=0.2, SmoothBorder=2.0)
    solid = features.make("SolidFromMesh", Source=ball, Tolerance=0.2)
    document.recompute()
    scan.ViewObject.DisplayMode = "Wireframe"
    shown("fit-surface", scan, face)
    shown("solid-from-mesh", solid)
    sections = []
    for number in range(6):
        section = document.addObject("Part::Feature", "Section")
        circle = Part.makeCircle(12 + 4 * np.sin(number), FreeCAD.Vector(0, 0, 9 * number))
        points = Part.Wire(circle).discretize(Number=13 + 4 * number)
        section.Shape = Part.makePolygon(points)
        sections.append(section)
    shown("skin", features.make("Skin", Sections=sections, Tolerance=0.05), *sections)
    control = document.addObject("Mesh::Feature", "Control")
    control.Mesh = shapes.open_box()
    control.ViewObject.DisplayMode = "Wireframe"
    shown("smooth-creased", features.make("SmoothCreased", Source=control, SharpAngle=100), control)
    coarse = features.make("Decimate", Source=scan, Nodes=120)
    document.recompute()
    coarse.ViewObject.DisplayMode = "Flat Lines"
    shown("decimate", coarse)
    shown("deviation", features.make("Deviation", Fitted=face, Limit=0.2))
    say("gallery passes")


def run():
    code = 0
    try:
        main()
        gallery()
    except BaseException:
        code = 1
        traceback.print_exc(file=log)
        traceback.print_exc()
        log.flush()
        picture("failure")
    log.flush()
    sys.stdout.flush()
    os._exit(code)


QtCore.QTimer.singleShot(1500, run)
