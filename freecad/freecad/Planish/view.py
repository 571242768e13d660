"""How objects look: icons, children, double clicks, and the colour map of a deviation."""

import FreeCAD
import numpy as np

from . import icon

_ICONS = {"FitSurface": "fit", "SolidFromMesh": "solid", "Skin": "skin", "SmoothCreased": "creased", "ExportSTEP": "export"}


def attach(obj, kind):
    """Gives an object its view provider."""
    (DeviationView if kind == "Deviation" else View)(obj.ViewObject, kind)


class View:
    """Icon, children, and a panel on double click for the objects that have one."""

    WITH_PANEL = ("FitSurface", "SolidFromMesh")

    def __init__(self, view_object, kind):
        self.kind = kind
        view_object.Proxy = self

    def attach(self, view_object):
        self.Object = view_object.Object

    def getIcon(self):
        return icon(_ICONS.get(self.kind, self.kind.lower()))

    def claimChildren(self):
        obj = self.Object
        linked = [getattr(obj, "Source", None), *getattr(obj, "Sections", [])]
        return [child for child in linked if child is not None]

    def setEdit(self, view_object, mode=0):
        if mode != 0 or self.kind not in self.WITH_PANEL:
            return None
        import FreeCADGui

        from . import panel

        FreeCADGui.Control.showDialog(panel.Panel(view_object.Object))
        return True

    def unsetEdit(self, view_object, mode=0):
        import FreeCADGui

        FreeCADGui.Control.closeDialog()
        return True

    def doubleClicked(self, view_object):
        if self.kind not in self.WITH_PANEL:
            return False
        view_object.Document.setEdit(view_object.Object.Name)
        return True

    def dumps(self):
        return self.kind

    def loads(self, state):
        self.kind = state

    __getstate__ = dumps
    __setstate__ = loads


#: Blue over green to red, as inspection programs show signed distances.
_STOPS = np.array([(0.05, 0.2, 0.8), (0.1, 0.75, 0.85), (0.25, 0.8, 0.3), (0.98, 0.85, 0.2), (0.85, 0.1, 0.1)])


def colours(values, limit):
    """Rows (r, g, b) for signed values: the colours end at -limit and limit."""
    share = np.clip(np.asarray(values, float) / limit, -1, 1)
    return np.stack([np.interp(share, np.linspace(-1, 1, 5), _STOPS[:, channel]) for channel in range(3)], axis=-1)


def _packed(rows):
    """Colours as Coin packs them: 0xrrggbbff."""
    parts = np.c_[np.round(255 * rows), np.full(len(rows), 255)].astype(np.uint32)
    return (parts @ np.array([1 << 24, 1 << 16, 1 << 8, 1], np.uint32)).tolist()


class DeviationView(View):
    """The mesh in colours with a legend: Coin nodes, so that it works in every version."""

    def attach(self, view_object):
        from pivy import coin

        super().attach(view_object)
        self.root = coin.SoSeparator()
        view_object.addDisplayMode(self.root, "Map")
        self.draw()

    def getDisplayModes(self, view_object):
        return ["Map"]

    def getDefaultDisplayMode(self):
        return "Map"

    def setDisplayMode(self, mode):
        return mode

    def updateData(self, obj, name):
        if name in ("Distances", "Limit", "LargestPlaces"):
            self.draw()

    def draw(self):
        """Draws the map anew from the object's properties."""
        from . import convert

        obj = self.Object
        root = getattr(self, "root", None)
        if root is None or "Distances" not in obj.PropertiesList:
            return
        root.removeAllChildren()
        source = obj.Proxy.source(obj) if getattr(obj, "Fitted", None) else None
        if source is None or not obj.Distances:
            return
        points, triangles = convert.nodes_of(source)
        if len(points) != len(obj.Distances):
            return  # the mesh has changed; the next recompute measures it
        limit = obj.Proxy.limit(obj)
        for node in (*_surface(points, triangles, np.array(obj.Distances), limit), _legend(limit)):
            root.addChild(node)
        for place in obj.LargestPlaces:
            nearest = int(np.argmin(((points - tuple(place)) ** 2).sum(axis=1)))
            root.addChild(_label(place, f"{obj.Distances[nearest]:+.3g} mm"))


def _surface(points, triangles, values, limit):
    from pivy import coin

    hints = coin.SoShapeHints()
    hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
    hints.shapeType = coin.SoShapeHints.UNKNOWN_SHAPE_TYPE
    hints.creaseAngle = 0.6
    vertices = coin.SoVertexProperty()
    vertices.vertex.setValues(0, len(points), points.tolist())
    packed = _packed(colours(values, limit))
    vertices.orderedRGBA.setValues(0, len(packed), packed)
    vertices.materialBinding = coin.SoMaterialBinding.PER_VERTEX_INDEXED
    faces = coin.SoIndexedFaceSet()
    faces.vertexProperty = vertices
    corners = np.c_[triangles, np.full(len(triangles), -1)].astype(np.int32).ravel()
    faces.coordIndex.setValues(0, len(corners), corners.tolist())
    return hints, faces


def _label(place, text):
    from pivy import coin

    label = coin.SoSeparator()
    translation = coin.SoTranslation()
    translation.translation = (place.x, place.y, place.z)
    black = coin.SoBaseColor()
    black.rgb = (0, 0, 0)
    words = coin.SoText2()
    words.string = text
    for node in (translation, black, words):
        label.addChild(node)
    return label


def _legend(limit):
    """A bar of colours with five numbers at the right edge of the view, in front of everything."""
    from pivy import coin

    legend = coin.SoAnnotation()
    camera = coin.SoOrthographicCamera()
    camera.viewportMapping = coin.SoCamera.LEAVE_ALONE
    camera.height = 2
    light = coin.SoLightModel()
    light.model = coin.SoLightModel.BASE_COLOR
    legend.addChild(camera)
    legend.addChild(light)
    count, left, right, low, high = 40, 0.84, 0.90, -0.7, 0.7
    heights = np.linspace(low, high, count + 1)
    packed = _packed(colours(np.linspace(-1, 1, count), 1.0))
    for bottom, top, colour in zip(heights, heights[1:], packed):
        box = coin.SoVertexProperty()
        box.vertex.setValues(0, 4, [(left, bottom, 0), (right, bottom, 0), (right, top, 0), (left, top, 0)])
        box.orderedRGBA = colour
        face = coin.SoFaceSet()
        face.vertexProperty = box
        legend.addChild(face)
    black = coin.SoBaseColor()
    black.rgb = (0, 0, 0)
    legend.addChild(black)
    for share in (-1, -0.5, 0, 0.5, 1):
        mark = coin.SoSeparator()
        translation = coin.SoTranslation()
        translation.translation = (left - 0.02, high * share - 0.015, 0)
        words = coin.SoText2()
        words.justification = coin.SoText2.RIGHT
        words.string = f"{share * limit:+.3g} mm"
        mark.addChild(translation)
        mark.addChild(words)
        legend.addChild(mark)
    return legend
