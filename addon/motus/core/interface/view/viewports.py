"""3D viewports: the one under the mouse, its rays and its scale, and values and settings that are stored for each viewport."""

from typing import Any, NamedTuple

import bpy
from bpy.app.handlers import persistent
from bpy_extras.view3d_utils import location_3d_to_region_2d, region_2d_to_location_3d, region_2d_to_origin_3d, region_2d_to_vector_3d
from mathutils import Vector

from ...blender import handlers
from ...refusals import Refused
from ...translations import tr


class View(NamedTuple):
    """A 3D viewport; `data` is its RegionView3D.

    The user may close the viewport while something is dragged in it. Python's references to its area and region then point to freed memory.
    So each method first checks whether the viewport still exists; all but tell() raise Refused if it does not.
    """

    area: Any
    region: Any
    data: Any

    @property
    def is_there(self):
        """Whether the viewport still exists in a window."""
        return any(
            region == self.region
            for window in bpy.context.window_manager.windows
            for area in window.screen.areas
            if area == self.area
            for region in area.regions
        )

    def tell(self, text):
        """Show a text in the viewport's header; None shows Blender's own content again. Does nothing if the viewport was closed."""
        if self.is_there:
            self.area.header_text_set(text)

    def _check(self):
        if not self.is_there:
            raise Refused(tr("The viewport was closed"))

    def ray(self, x, y):
        """(origin, direction) of the ray through a pixel (x, y) of the window, in world space."""
        self._check()
        place = (x - self.region.x, y - self.region.y)
        return (region_2d_to_origin_3d(self.region, self.data, place), region_2d_to_vector_3d(self.region, self.data, place))

    def toward_viewer(self):
        """Unit vector in world space from the screen towards the viewer."""
        self._check()
        return self.data.view_rotation @ Vector((0.0, 0.0, 1.0))

    def place_at(self, x, y, point):
        """World point under a pixel (x, y) of the window, on the plane through `point` that faces the view."""
        self._check()
        return region_2d_to_location_3d(self.region, self.data, (x - self.region.x, y - self.region.y), point)

    def sight(self, point):
        """Unit vector in world space from the viewer towards a point; the direction of view if the view is orthographic."""
        self._check()
        viewer = self.data.view_matrix.inverted()
        if self.data.is_perspective:
            return (point - viewer.translation).normalized()
        return -viewer.col[2].to_3d().normalized()

    def up(self):
        """Unit vector in world space that points upwards on the screen."""
        self._check()
        return self.data.view_rotation @ Vector((0.0, 1.0, 0.0))

    def pixels_for(self, point, length):
        """Pixels that a length at a world point, across the view, has on the screen; 0 if the place is not in front of the viewer."""
        self._check()
        across = self.data.view_rotation @ Vector((length, 0.0, 0.0))
        ends = [location_3d_to_region_2d(self.region, self.data, place) for place in (point, point + across)]
        return (ends[1] - ends[0]).length if None not in ends else 0.0


def view_at(window, x, y):
    """The viewport (View) under a pixel (x, y) of the window; None if something different is there, such as its sidebar."""
    for area in window.screen.areas:
        if area.type != 'VIEW_3D' or not _contains(area, x, y):
            continue
        # The sidebar and the toolbar may lie over the viewport.
        found = [region for region in area.regions if _contains(region, x, y)]
        if found and all(region.type == 'WINDOW' for region in found):
            return View(area, found[0], found[0].data)
    return None


def _contains(part, x, y):
    return part.x <= x < part.x + part.width and part.y <= y < part.y + part.height


def redraw(kinds=('VIEW_3D',)):
    """Redraw all areas of some types, to show a change of which Blender does not know that it is visible there.

    kinds: types of areas; None for all types.
    """
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if kinds is None or area.type in kinds:
                area.tag_redraw()


def space_for(context):
    """SpaceView3D of the context, or else of the largest 3D viewport in the context's window; None if there is none."""
    if context.space_data is not None and context.space_data.type == 'VIEW_3D':
        return context.space_data
    areas = [area for area in context.window.screen.areas if area.type == 'VIEW_3D'] if context.window else []
    return max(areas, key=lambda area: area.width * area.height).spaces.active if areas else None


def all_spaces():
    """List of the SpaceView3D of all 3D viewports in the file, in all workspaces."""
    return [space for screen in bpy.data.screens for area in screen.areas for space in area.spaces if space.type == 'VIEW_3D']


AHEAD = 10.0
"""Distance from a camera, in m, at which the point that its viewport looks at is assumed: the camera does not tell one."""


def seen_place(context, place):
    """Copy of a world point if the context's 3D viewport sees the point; otherwise the world point that the viewport looks at.

    If there is no viewport, the copy is returned too.
    """
    space = space_for(context)
    view = space.region_3d if space else None
    if view is None:
        return place.copy()
    x, y, _, depth = view.perspective_matrix @ place.to_4d()
    if max(abs(x), abs(y)) < depth:
        return place.copy()
    if view.view_perspective != 'CAMERA':
        return view.view_location.copy()
    viewer = view.view_matrix.inverted()
    return viewer.translation - AHEAD * viewer.col[2].to_3d().normalized()


class PerViewport:
    """Storage of one value for each 3D viewport. A value is removed after its viewport was closed.

    The key is the memory address of the SpaceView3D, which stays the same while the area is maximised. Blender may reuse the address of a
    closed viewport. Values of closed viewports are therefore removed before each access, and after a file was loaded: Blender creates the
    viewports of a new file before it frees the old ones.
    """

    _all = []

    def __init__(self):
        self._kept = {}
        self._all.append(self)

    def get(self, space):
        """The value that is stored for a viewport; None if there is none. space: the viewport's SpaceView3D."""
        self.drop_gone()
        return self._kept.get(space.as_pointer())

    def put(self, space, value):
        """Store a value for a viewport. space: the viewport's SpaceView3D."""
        self._kept[space.as_pointer()] = value

    def take(self, space):
        """Remove the value that is stored for a viewport, and return it; None if there is none."""
        self.drop_gone()
        return self._kept.pop(space.as_pointer(), None)

    def drop_gone(self):
        """Remove the values that are stored for viewports that were closed."""
        if self._kept:
            there = {space.as_pointer() for space in all_spaces()}
            for gone in self._kept.keys() - there:
                del self._kept[gone]

    def clear(self):
        """Remove the values that are stored for all viewports."""
        self._kept.clear()

    @classmethod
    def of_all(cls, do):
        """Call do(storage) for every PerViewport that exists."""
        for one in cls._all:
            do(one)


@persistent
def _loaded(*_):
    PerViewport.of_all(PerViewport.drop_gone)


def _watched():
    return ((bpy.app.handlers.load_post, _loaded),)


def register():
    """Add the handler that removes values of closed viewports after a file was loaded."""
    handlers.add(_watched())


def unregister():
    """Remove the handler, and the values that are stored for all viewports."""
    handlers.remove(_watched())
    PerViewport.of_all(PerViewport.clear)


class _Named(NamedTuple):
    """Reference to the object in a setting of a viewport, such as its camera, by name: the object may be deleted meanwhile.

    library: path of the library file that the object is linked from; None for a local object.
    """

    name: str
    library: Any

    def object(self):
        """The object with this name and library; None if it was deleted or renamed."""
        return bpy.data.objects.get((self.name, self.library))


_before = PerViewport()
"""{data path of a setting: its value before change()}, stored for each viewport."""
_PERSPECTIVE = "region_3d.view_perspective"
_VIEW = "region_3d.view_location", "region_3d.view_rotation", "region_3d.view_distance"
"""Settings of a viewport that Blender changes together with its perspective."""


def change(space, values):
    """Set settings of a viewport, {data path: value}, and store their values before for restore()."""
    if _PERSPECTIVE in values and not has(space, {_PERSPECTIVE: values[_PERSPECTIVE]}):
        for path in _VIEW:
            _keep(space, path)
    for path, value in values.items():
        is_new = not has(space, {path: value})
        # restore() also sets a setting that has the value already, unless an earlier change has set the value.
        if is_new or path not in (_before.get(space) or {}):
            _keep(space, path)
        if is_new:
            _set(space, path, value)


def has(space, values):
    """Whether settings of a viewport have these values. values: {data path: value}."""
    return all(getattr(*_place(space, path)) == value for path, value in values.items())


def restore(space, values):
    """Set settings of a viewport to the values that they had before change().

    values: {data path: value to set if the value before change() is unknown}.
    """
    kept = _before.get(space) or {}
    for path, value in values.items():
        _set(space, path, kept.pop(path, value))
    for path in _VIEW:
        if path in kept:
            _set(space, path, kept.pop(path))


def _keep(space, path):
    kept = _before.get(space)
    if kept is None:
        kept = {}
        _before.put(space, kept)
    value = getattr(*_place(space, path))
    if isinstance(value, bpy.types.ID):
        value = _Named(value.name, value.library and value.library.filepath)
    kept[path] = value.copy() if hasattr(value, "copy") else value


def _set(space, path, value):
    owner, name = _place(space, path)
    setattr(owner, name, value.object() if isinstance(value, _Named) else value)


def _place(space, path):
    holder, _, name = path.rpartition(".")
    return (space.path_resolve(holder) if holder else space), name
