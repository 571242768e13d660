"""Document objects. They need no window: they recompute in freecadcmd too.

    from freecad.Planish import features
    solid = features.make("SolidFromMesh", Source=mesh, Tolerance=0.5)
    FreeCAD.ActiveDocument.recompute()
"""

import hashlib
import math

import FreeCAD
import numpy as np
import planish

from . import convert, view

_READ_ONLY, _NO_RECOMPUTE = 1, 8


def add(obj, kind, name, group, tip, value=None, mode=0):
    """Adds a property, unless the object has it (from a file of this or an older version)."""
    if name in obj.PropertiesList:
        return
    obj.addProperty("App::Property" + kind, name, group, tip, mode)
    if value is not None:
        setattr(obj, name, value)


class Proxy:
    """What all objects share: they keep nothing of their own in files, and their properties grow with versions."""

    def __init__(self, obj):
        obj.Proxy = self
        self.add_properties(obj)

    def onDocumentRestored(self, obj):
        self.add_properties(obj)

    def add_properties(self, obj):
        raise NotImplementedError

    def dumps(self):
        return None

    def loads(self, state):
        return None

    # FreeCAD 0.20 asks for these, 0.21.2 and later for dumps and loads
    __getstate__ = dumps
    __setstate__ = loads


class Fitted(Proxy):
    """An object whose shape a fit makes, with its errors as read-only properties.

    `result`, the surface or model, is not saved with the document: whoever needs it after reopening recomputes.
    """

    result = None
    #: What a panel's worker has computed already: the key of the job and its result.
    ready = None

    def add_properties(self, obj):
        add(obj, "Length", "Tolerance", "Fit", "Largest distance allowed at the nodes; 0 takes a thousandth of the size")
        report = (
            ("Length", "MaxError", "Largest distance between a node and the surface"),
            ("Length", "RmsError", "Root of the mean of its square"),
            ("Length", "BetweenNodes", "Largest distance of the middle of a triangle or of an edge to the surface"),
            ("Integer", "ControlPoints", "Control points of the shape"),
            ("String", "Status", "What the fit came to"),
            ("StringList", "Remarks", "What is worth knowing"),
        )
        for kind, name, tip in report:
            add(obj, kind, name, "Report", tip, mode=_READ_ONLY | _NO_RECOMPUTE)

    def job(self, obj):
        """Key and work of a fit, or None. The work touches no FreeCAD object: any thread may do it."""
        raise NotImplementedError

    def execute(self, obj):
        job = self.job(obj)
        if job is None:
            return
        self.result = self._done(obj, *job)
        obj.Shape = convert.to_shape(self.result)
        self.tell(obj)

    def _done(self, obj, key, work):
        """The result that a panel has ready for this key, else computed here."""
        ready, self.ready = self.ready, None
        if ready is not None and ready[0] == key:
            return ready[1]
        progress, stop = _progress_bar(obj.Label)
        try:
            return work(progress)
        except planish.Error as error:
            raise RuntimeError(f"{obj.Label}: {error}") from None  # marks the object and appears in the report view
        finally:
            stop()

    def measured(self, obj):
        """A new object that shows how far the mesh is from this one."""
        return make("Deviation", Fitted=obj)

    def tell(self, obj):
        """Fills the report's properties; a missed tolerance warns, since the best shape is kept."""
        report = self.result.report
        obj.MaxError, obj.RmsError = report.max_error, report.rms_error
        obj.BetweenNodes = report.max_interior_error
        obj.ControlPoints = report.coefficient_count
        obj.Status = report.status.replace("_", " ")
        obj.Remarks = sorted(remark.replace("_", " ") for remark in report.remarks)
        if report.max_error > report.tolerance:
            FreeCAD.Console.PrintWarning(
                f"Planish: {obj.Label}: tolerance missed: {report.max_error:.4g} mm of {report.tolerance:.4g} mm allowed\n"
            )


def _progress_bar(title):
    """Progress for recomputes without a panel: FreeCAD's own bar, whose Escape cancels."""
    if not FreeCAD.GuiUp:
        return None, lambda: None
    bar = FreeCAD.Base.ProgressIndicator()
    bar.start(title, 100)
    done = 0

    def progress(fraction, *_):
        nonlocal done
        while done < int(100 * fraction):
            bar.next(True)  # raises when the user presses Escape
            done += 1

    return progress, bar.stop


def _key(*parts):
    """Tells whether two jobs are the same."""
    digest = hashlib.sha256()
    for part in parts:
        digest.update(part.tobytes() if isinstance(part, np.ndarray) else repr(part).encode())
    return digest.hexdigest()


def _tolerance(obj):
    """The tolerance as keywords: absolute in millimetres, or the default."""
    value = float(obj.Tolerance)
    return {"tolerance": value, "absolute": True} if value > 0 else {}


class FitSurface(Fitted):
    """One smooth trimmed face over an open mesh."""

    FAMILIES = ["auto", "tensor", "pht", "d1rc"]

    def add_properties(self, obj):
        add(obj, "Link", "Source", "Fit", "The mesh, or points in rows and columns")
        add(obj, "Length", "SmoothBorder", "Fit", "How far a jagged border may move to become smooth; 0 leaves it")
        tip = "auto chooses; tensor: one grid; pht: refined where the shape asks; d1rc: keeps sharp edges"
        add(obj, "Enumeration", "Family", "Fit", tip)
        if not obj.getEnumerationsOfProperty("Family"):
            obj.Family = self.FAMILIES
        add(obj, "Angle", "SharpAngle", "Fit", "d1rc: edges that turn by more stay sharp", 40.0)
        add(obj, "Float", "Smoothing", "Fit", "Weight of bending energy; 0 chooses")
        super().add_properties(obj)

    def job(self, obj):
        if not obj.Source:
            return None
        points, triangles = convert.nodes_of(obj.Source)
        border = float(obj.SmoothBorder)
        keywords = dict(_tolerance(obj), family=obj.Family)
        if obj.Family == "d1rc":
            keywords["sharp_angle"] = math.radians(float(obj.SharpAngle))
        if float(obj.Smoothing) > 0:
            keywords["smoothing"] = float(obj.Smoothing)

        def work(progress=None):
            surface = planish.fit(planish.Mesh(points, triangles, orient=True), progress=progress, **keywords)
            if border > 0 and not convert.smooth_border(surface, border):
                surface.report.remarks |= {"border_not_smoothed"}
            return surface

        return _key(points, triangles, border, sorted(keywords.items())), work


class SolidFromMesh(Fitted):
    """A solid of planes, cylinders and smooth patches that share their edges; an open mesh becomes a shell."""

    def add_properties(self, obj):
        add(obj, "Link", "Source", "Fit", "The mesh: closed for a solid")
        add(obj, "Angle", "SharpAngle", "Fit", "Edges that turn by more stay sharp", 40.0)
        add(obj, "Bool", "ExactFaces", "Fit", "Planes and cylinders are found, and are exact", True)
        add(obj, "Integer", "Patches", "Fit", "About how many patches; 0 chooses")
        super().add_properties(obj)

    def job(self, obj):
        if not obj.Source:
            return None
        points, triangles = convert.nodes_of(obj.Source)
        keywords = dict(
            _tolerance(obj), sharp_angle=math.radians(float(obj.SharpAngle)), exact=bool(obj.ExactFaces)
        )
        if obj.Patches > 0:
            keywords["patches"] = int(obj.Patches)

        def work(progress=None):
            return planish.model(planish.Mesh(points, triangles, orient=True), progress=progress, **keywords)

        return _key(points, triangles, sorted(keywords.items())), work


class Skin(Fitted):
    """One surface through sections, whatever their numbers of points."""

    def add_properties(self, obj):
        add(obj, "LinkList", "Sections", "Fit", "Sketches, wires or points, in order")
        add(obj, "Length", "Spacing", "Fit", "About how far apart points are taken on curves; 0 chooses")
        add(obj, "Bool", "Closed", "Fit", "The last section is followed by the first")
        add(obj, "Bool", "Align", "Fit", "Closed sections are turned so that they do not twist", True)
        super().add_properties(obj)

    def job(self, obj):
        if len(obj.Sections) < 2:
            return None
        rows, are_closed = convert.rows_of(obj.Sections, float(obj.Spacing))
        keywords = dict(
            _tolerance(obj), closed=are_closed, closed_v=bool(obj.Closed), align=bool(obj.Align and are_closed)
        )

        def work(progress=None):
            return planish.skin(rows, progress=progress, **keywords)

        return _key(*rows, sorted(keywords.items())), work


class Decimate(Proxy):
    """A coarser mesh whose nodes are nodes of the source."""

    def add_properties(self, obj):
        add(obj, "Link", "Source", "Decimate", "The mesh")
        add(obj, "Integer", "Nodes", "Decimate", "Nodes that are to be left", 1000)
        add(obj, "Angle", "SharpAngle", "Decimate", "Edges that turn by more are kept", 40.0)
        report = (
            ("Excess", "Nodes beyond the number asked for that had to stay"),
            ("SharpEdges", "Edges of the coarse mesh that are sharp"),
        )
        for name, tip in report:
            add(obj, "Integer", name, "Report", tip, mode=_READ_ONLY | _NO_RECOMPUTE)

    def execute(self, obj):
        if not obj.Source:
            return
        angle = math.radians(float(obj.SharpAngle))
        try:
            coarse = convert.mesh_of(obj.Source).decimate(obj.Nodes, sharp_angle=angle)
        except planish.Error as error:
            raise RuntimeError(f"{obj.Label}: {error}") from None
        obj.Mesh = convert.to_mesh(coarse)
        obj.Excess, obj.SharpEdges = coarse.report.excess_count, coarse.report.sharp_edge_count


class SmoothCreased(Proxy):
    """The smooth surface over a coarse control mesh, as a mesh that follows it live."""

    surface = None
    _control = None

    def add_properties(self, obj):
        add(obj, "Link", "Source", "Creased", "The control mesh")
        add(obj, "Angle", "SharpAngle", "Creased", "Edges that turn by more stay sharp", 40.0)
        add(obj, "Length", "Chord", "Creased", "Largest distance between the mesh shown and the surface; 0 chooses")
        mode = _READ_ONLY | _NO_RECOMPUTE
        add(obj, "Integer", "ControlPoints", "Report", "Control points of the surface", mode=mode)

    def execute(self, obj):
        if not obj.Source:
            return
        points, triangles = convert.nodes_of(obj.Source)
        try:
            self._follow(points, triangles, math.radians(float(obj.SharpAngle)))
            chord = float(obj.Chord)
            obj.Mesh = convert.to_mesh(self.surface.tessellate(**({"chord_tolerance": chord} if chord > 0 else {})))
            obj.ControlPoints = self.surface.n_control_points
        except planish.Error as error:
            raise RuntimeError(f"{obj.Label}: {error}") from None

    def _follow(self, points, triangles, angle):
        """Moves the control points that moved; a new surface only where the control mesh is another one."""
        if self.surface is not None and self._control is not None:
            before, old_triangles, old_angle = self._control
            if old_angle == angle and np.array_equal(old_triangles, triangles) and before.shape == points.shape:
                moved = np.flatnonzero((before != points).any(axis=1))
                if moved.size:
                    self.surface.set_control_points(moved, points[moved])
                self._control = (points, triangles, angle)
                return
        self.surface = planish.smooth_creased(planish.Mesh(points, triangles, orient=True), sharp_angle=angle)
        self._control = (points, triangles, angle)


def _apart(points, distances, count):
    """The nodes with the largest distances, none nearer to another than a twentieth of the diagonal."""
    least = np.linalg.norm(np.ptp(points, axis=0)) / 20
    chosen = []
    for node in np.argsort(-distances):
        if len(chosen) >= count:
            break
        if all(np.linalg.norm(points[node] - points[other]) >= least for other in chosen):
            chosen.append(node)
    return chosen


class Deviation(Proxy):
    """Signed distances of a mesh's nodes from a fitted shape; positive outside."""

    def add_properties(self, obj):
        add(obj, "Link", "Fitted", "Deviation", "The object that was fitted")
        add(obj, "Link", "Source", "Deviation", "The mesh that is measured; empty: the one that was fitted")
        add(obj, "Length", "Limit", "Deviation", "Where the colours end; 0 takes the tolerance")
        add(obj, "Integer", "Labels", "Deviation", "How many of the largest places are labelled", 3)
        report = (
            ("Distance", "LargestOutside", "The largest distance on the side of the normals"),
            ("Distance", "LargestInside", "The largest distance on the other side, negative"),
            ("Length", "RmsDistance", "Root of the mean square"),
            ("Float", "ShareWithin", "Share of the nodes within the limit"),
        )
        for kind, name, tip in report:
            add(obj, kind, name, "Report", tip, mode=_READ_ONLY | _NO_RECOMPUTE)
        add(obj, "FloatList", "Distances", "Report", "One for each node", mode=_READ_ONLY | _NO_RECOMPUTE)
        add(obj, "VectorList", "LargestPlaces", "Report", "The largest places", mode=_READ_ONLY | _NO_RECOMPUTE)

    def source(self, obj):
        return obj.Source or getattr(obj.Fitted, "Source", None)

    def limit(self, obj):
        return float(obj.Limit) or float(obj.Fitted.Tolerance) or obj.Fitted.Proxy.result.report.tolerance

    def execute(self, obj):
        source = self.source(obj) if obj.Fitted else None
        if source is None:
            return
        proxy = obj.Fitted.Proxy
        if proxy.result is None:  # after reopening: shapes are saved, fits are not
            proxy.execute(obj.Fitted)
        points, triangles = convert.nodes_of(source)
        try:
            mesh = planish.Mesh(points, triangles, orient=True)  # repair may append nodes; the others keep their numbers
            distances = proxy.result.deviation(mesh)[1].signed[: len(points)]
        except planish.Error as error:
            raise RuntimeError(f"{obj.Label}: {error}") from None
        distances = np.nan_to_num(distances)  # a node without triangles has no distance
        obj.Distances = distances.tolist()
        obj.LargestOutside, obj.LargestInside = max(distances.max(), 0.0), min(distances.min(), 0.0)
        obj.RmsDistance = math.sqrt(np.mean(distances**2))
        obj.ShareWithin = float(np.mean(np.abs(distances) <= self.limit(obj)))
        obj.LargestPlaces = [FreeCAD.Vector(*points[node]) for node in _apart(points, np.abs(distances), obj.Labels)]


class ExportSTEP(Proxy):
    """Writes a fitted shape to a STEP file whenever it changes."""

    def add_properties(self, obj):
        add(obj, "Link", "Fitted", "Export", "The object that was fitted")
        add(obj, "File", "Path", "Export", "The file; written when the object is recomputed")
        for kind, name, tip in (
            ("Integer", "Faces", "Faces in the file"),
            ("Integer", "Poles", "Control points of its surfaces"),
        ):
            add(obj, kind, name, "Report", tip, mode=_READ_ONLY | _NO_RECOMPUTE)

    def execute(self, obj):
        if not obj.Fitted or not obj.Path:
            return
        proxy = obj.Fitted.Proxy
        if proxy.result is None:
            proxy.execute(obj.Fitted)
        try:
            report = proxy.result.write_step(obj.Path)
        except planish.Error as error:
            raise RuntimeError(f"{obj.Label}: {error}") from None
        obj.Faces, obj.Poles = report.face_count, report.pole_count


#: Each kind of object: its proxy, and the FreeCAD type it is made of.
KINDS = {
    "FitSurface": (FitSurface, "Part::FeaturePython"),
    "SolidFromMesh": (SolidFromMesh, "Part::FeaturePython"),
    "Skin": (Skin, "Part::FeaturePython"),
    "SmoothCreased": (SmoothCreased, "Mesh::FeaturePython"),
    "Decimate": (Decimate, "Mesh::FeaturePython"),
    "Deviation": (Deviation, "App::FeaturePython"),
    "ExportSTEP": (ExportSTEP, "App::FeaturePython"),
}


def make(kind, **values):
    """A new object of this kind with these property values, in the active document."""
    if kind not in KINDS:
        raise ValueError(f"there is no kind {kind!r}; there are {', '.join(KINDS)}")
    proxy, base = KINDS[kind]
    document = FreeCAD.ActiveDocument or FreeCAD.newDocument()
    obj = document.addObject(base, kind)
    proxy(obj)
    for name, value in values.items():
        setattr(obj, name, value)
    if FreeCAD.GuiUp:
        view.attach(obj, kind)
    return obj
