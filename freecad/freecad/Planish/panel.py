"""The task panel of fits: tolerance and options, preview with live progress and Cancel, the result in words."""

import threading

import FreeCAD
import FreeCADGui
import planish

from . import preferences
from . import translate as tr

try:
    from PySide import QtCore, QtWidgets  # FreeCAD's own alias for Qt5 and Qt6
except ImportError:
    from PySide2 import QtCore, QtWidgets


class _Signals(QtCore.QObject):
    """Emitted by the worker, heard by the window's thread: Qt carries them over."""

    progress = QtCore.Signal(float, float, str)
    done = QtCore.Signal(object)


class Panel:
    """Edits one FitSurface or SolidFromMesh. The worker knows only planish; `execute` takes what it leaves with the object."""

    def __init__(self, obj):
        self.obj = obj
        self.worker = None
        self.stop = False
        self.deviation = None
        self.signals = _Signals()
        self.signals.progress.connect(self.heard)
        self.signals.done.connect(self.finished)
        self.form = self._widgets()
        if not FreeCAD.getActiveTransaction():  # a command that made the object has opened one
            FreeCAD.ActiveDocument.openTransaction(tr("Fit"))

    # what the user sees

    def _widgets(self):
        obj = self.obj
        form = QtWidgets.QWidget()
        form.setWindowTitle(tr("Fit surface") if hasattr(obj, "Family") else tr("Solid from mesh"))
        rows = QtWidgets.QFormLayout(form)
        rows.setRowWrapPolicy(QtWidgets.QFormLayout.WrapLongRows)  # the column may be 300 pixels wide
        self.tolerance = _length(float(obj.Tolerance))
        rows.addRow(tr("Tolerance"), self.tolerance)
        self.inputs = {}
        advanced = QtWidgets.QGroupBox(tr("Advanced"))
        advanced.setCheckable(True)
        advanced.setChecked(False)
        folded = QtWidgets.QWidget()
        hidden = QtWidgets.QFormLayout(folded)
        hidden.setRowWrapPolicy(QtWidgets.QFormLayout.WrapLongRows)
        for name, label, is_advanced in self._options():
            self.inputs[name] = _Input(obj, name)
            (hidden if is_advanced else rows).addRow(tr(label), self.inputs[name].widget)
        folded.setVisible(False)
        advanced.toggled.connect(folded.setVisible)
        box = QtWidgets.QVBoxLayout(advanced)
        box.setContentsMargins(0, 0, 0, 0)
        box.addWidget(folded)
        rows.addRow(advanced)
        self.colour = QtWidgets.QCheckBox(tr("Deviation colours"))
        self.colour.setChecked(preferences.shows_colours())
        rows.addRow(self.colour)
        self.go, self.cancel = QtWidgets.QPushButton(tr("Preview")), QtWidgets.QPushButton(tr("Cancel"))
        self.cancel.setEnabled(False)
        self.go.clicked.connect(self.start)
        self.cancel.clicked.connect(self.halt)
        buttons = QtWidgets.QHBoxLayout()
        buttons.addWidget(self.go)
        buttons.addWidget(self.cancel)
        rows.addRow(buttons)
        self.bar = QtWidgets.QProgressBar()
        self.bar.setRange(0, 1000)
        rows.addRow(self.bar)
        self.text = QtWidgets.QLabel()
        self.text.setWordWrap(True)
        self.text.setMinimumWidth(1)
        rows.addRow(self.text)
        return form

    def _options(self):
        """(property, label, whether it stands behind the fold) of this kind of object."""
        if hasattr(self.obj, "Family"):
            return (
                ("Family", "Family", False),
                ("SmoothBorder", "Smooth border", True),
                ("SharpAngle", "Sharp angle", True),
                ("Smoothing", "Smoothing", True),
            )
        return (
            ("SharpAngle", "Sharp angle", True),
            ("ExactFaces", "Exact faces", True),
            ("Patches", "Patches", True),
        )

    # what the buttons do

    def start(self):
        """Starts a fit on a worker thread, unless one runs."""
        if self.worker is not None:
            return
        self.obj.Tolerance = self.tolerance.property("rawValue")
        for name, value in self.inputs.items():
            value.store(self.obj, name)
        try:
            self.key, work = self.obj.Proxy.job(self.obj)  # here: it reads the document; the worker does not
        except (planish.Error, TypeError, ValueError) as error:
            self._tell_failure(error)
            return
        self.stop = False
        self.go.setEnabled(False)
        self.cancel.setEnabled(True)
        self.bar.setValue(0)
        self.text.setText(tr("Working ..."))

        def hear(fraction, error, stage):
            self.signals.progress.emit(fraction, error, stage)
            return not self.stop

        def run():
            try:
                result = work(hear)
            except planish.Cancelled:
                result = None
            except Exception as error:  # told in the panel
                result = error
            self.signals.done.emit(result)

        self.worker = threading.Thread(target=run, name="planish fit", daemon=True)
        self.worker.start()

    def halt(self):
        """Asks the worker to end."""
        self.stop = True
        self.text.setText(tr("Stopping ..."))

    def heard(self, fraction, error, stage):
        """Progress, in the window's thread."""
        self.bar.setValue(int(1000 * fraction))
        words = tr(stage.replace("_", " ") or "working")
        self.text.setText(words if error != error else f"{words}: {tr('error so far')} {error:.4g} mm")

    def finished(self, result):
        """The worker's end, in the window's thread. State is cleared first: a recompute spins the event loop."""
        self.worker = None
        self.go.setEnabled(True)
        self.cancel.setEnabled(False)
        if result is None:
            self.bar.setValue(0)
            self.text.setText(tr("Cancelled; nothing has changed"))
            return
        if isinstance(result, Exception):
            self._tell_failure(result)
            return
        self.obj.Proxy.ready = (self.key, result)
        self.obj.touch()
        FreeCAD.ActiveDocument.recompute()
        self.bar.setValue(1000)
        self.text.setText(in_words(result.report))
        if self.colour.isChecked():
            self._show_deviation()

    def _tell_failure(self, error):
        self.text.setText(str(error))
        FreeCAD.Console.PrintError(f"Planish: {self.obj.Label}: {error}\n")

    def _show_deviation(self):
        if self.deviation is None:
            self.deviation = self.obj.Proxy.measured(self.obj)
        self.deviation.touch()
        FreeCAD.ActiveDocument.recompute()
        self.obj.ViewObject.Visibility = False
        self.obj.Source.ViewObject.Visibility = False

    def accept(self):
        """OK: fits first if there is no preview; one step to undo."""
        if self.worker is not None:
            return False
        if not self.obj.Shape.Faces:
            self.start()
            return False
        self.obj.ViewObject.Visibility = True
        self.obj.Source.ViewObject.Visibility = False
        if self.deviation is not None:
            self.deviation.ViewObject.Visibility = False
        FreeCAD.ActiveDocument.commitTransaction()
        self._close()
        return True

    def reject(self):
        """Cancel: everything as it was before the panel opened."""
        self.stop = True
        if self.worker is not None:
            self.worker.join(10)
        FreeCAD.ActiveDocument.abortTransaction()
        self._close()
        return True

    def _close(self):
        FreeCADGui.ActiveDocument.resetEdit()
        FreeCADGui.Control.closeDialog()

    def getStandardButtons(self):
        box = QtWidgets.QDialogButtonBox
        flags = box.Ok | box.Cancel
        return flags.value if hasattr(flags, "value") else int(flags)  # Qt6's flags are enumerations, Qt5 wants an int


def in_words(report):
    """What a fit came to, in a sentence or two."""
    verb = tr("met") if report.max_error <= report.tolerance else tr("missed")
    lines = [
        f"<b>{verb}: {report.max_error:.4g} mm {tr('of')} {report.tolerance:.4g} mm</b>",
        f"{tr('between the nodes')}: {report.max_interior_error:.4g} mm",
        f"{report.coefficient_count:,} {tr('control points')}, {report.seconds:.2g} s",
    ]
    lines += [tr(remark.replace("_", " ")) for remark in sorted(report.remarks)]
    return "<br>".join(lines)


def _length(value):
    spin = FreeCADGui.UiLoader().createWidget("Gui::QuantitySpinBox")
    spin.setProperty("unit", "mm")
    spin.setProperty("minimum", 0.0)
    spin.setProperty("rawValue", value)
    spin.setToolTip(tr("0 takes a thousandth of the size"))
    return spin


class _Input:
    """One property as a widget of its kind."""

    def __init__(self, obj, name):
        value = getattr(obj, name)
        choices = obj.getEnumerationsOfProperty(name) if obj.getTypeIdOfProperty(name) == "App::PropertyEnumeration" else None
        if choices:
            self.widget = QtWidgets.QComboBox()
            self.widget.addItems(choices)
            self.widget.setCurrentText(value)
            self.read = self.widget.currentText
        elif isinstance(value, bool):
            self.widget = QtWidgets.QCheckBox()
            self.widget.setChecked(value)
            self.read = self.widget.isChecked
        elif isinstance(value, int):
            self.widget = QtWidgets.QSpinBox()
            self.widget.setRange(0, 100_000)
            self.widget.setValue(value)
            self.read = self.widget.value
        else:
            self.widget = QtWidgets.QDoubleSpinBox()
            self.widget.setDecimals(6)
            self.widget.setRange(0, 1e6)
            self.widget.setValue(float(value))
            self.read = self.widget.value
        self.widget.setToolTip(obj.getDocumentationOfProperty(name))

    def store(self, obj, name):
        """Puts the widget's value into the property, if it is another one."""
        value = self.read()
        if getattr(obj, name) != value:
            setattr(obj, name, value)
