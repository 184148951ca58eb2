"""Which 3D viewport the mouse is over, what its ray and scale are there, and what is kept of viewports as they were."""

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

    It may be closed while something is dragged in it. Python's references to its area and region are to freed memory then, so
    each method looks first whether it is there, and raises Refused where it is not.
    """

    area: Any
    region: Any
    data: Any

    @property
    def is_there(self):
        """Whether a window still has it."""
        return any(
            region == self.region
            for window in bpy.context.window_manager.windows
            for area in window.screen.areas
            if area == self.area
            for region in area.regions
        )

    def tell(self, text):
        """Show a text in the header; None shows what else is there."""
        if self.is_there:
            self.area.header_text_set(text)

    def _check(self):
        if not self.is_there:
            raise Refused(tr("The viewport was closed"))

    def ray(self, x, y):
        """Origin and direction, in the world, of the ray through a place of the window."""
        self._check()
        place = (x - self.region.x, y - self.region.y)
        return (region_2d_to_origin_3d(self.region, self.data, place), region_2d_to_vector_3d(self.region, self.data, place))

    def toward_viewer(self):
        """World direction from the screen to whoever looks at it."""
        self._check()
        return self.data.view_rotation @ Vector((0.0, 0.0, 1.0))

    def place_at(self, x, y, point):
        """The world point under a place of the window on the plane through a point that faces the view."""
        self._check()
        return region_2d_to_location_3d(self.region, self.data, (x - self.region.x, y - self.region.y), point)

    def sight(self, point):
        """World direction in which the viewer looks at a point."""
        self._check()
        viewer = self.data.view_matrix.inverted()
        if self.data.is_perspective:
            return (point - viewer.translation).normalized()
        return -viewer.col[2].to_3d().normalized()

    def up(self):
        """World direction upwards on the screen."""
        self._check()
        return self.data.view_rotation @ Vector((0.0, 1.0, 0.0))

    def pixels_for(self, point, length):
        """How many pixels a length at a point of the world is on the screen, across the view."""
        self._check()
        across = self.data.view_rotation @ Vector((length, 0.0, 0.0))
        ends = [location_3d_to_region_2d(self.region, self.data, place) for place in (point, point + across)]
        return (ends[1] - ends[0]).length if None not in ends else 0.0


def view_at(window, x, y):
    """The viewport at a place of the window; None where there is another thing."""
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
    """Let all areas of some kinds, or of all kinds where they are None, be drawn anew, for what Blender does not know to be seen there."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if kinds is None or area.type in kinds:
                area.tag_redraw()


def space_for(context):
    """The space of the context's 3D viewport, or of the largest one in the window; None without."""
    if context.space_data is not None and context.space_data.type == 'VIEW_3D':
        return context.space_data
    areas = [area for area in context.window.screen.areas if area.type == 'VIEW_3D'] if context.window else []
    return max(areas, key=lambda area: area.width * area.height).spaces.active if areas else None


def all_spaces():
    """The spaces of all 3D viewports in the file, of all workspaces."""
    return [space for screen in bpy.data.screens for area in screen.areas for space in area.spaces if space.type == 'VIEW_3D']


AHEAD = 10.0
"""m before a camera that a viewport looks through, where nothing says what it looks at."""


def seen_place(context, place):
    """A place of the world, if the context's 3D viewport sees it or there is none; else the one that the viewport looks at."""
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
    """Storage of one value for each 3D viewport, removed when the viewport is closed.

    The key is the memory address of the SpaceView3D, which stays the same while the area is maximised. Blender may reuse the address
    of a closed viewport. Values of closed viewports are therefore removed before each access, and after a file was loaded: Blender
    creates the viewports of a new file before it frees the old ones.
    """

    _all = []

    def __init__(self):
        self._kept = {}
        self._all.append(self)

    def get(self, space):
        """The kept state of a viewport; None without one."""
        self.drop_gone()
        return self._kept.get(space.as_pointer())

    def put(self, space, value):
        """Keep something of a viewport."""
        self._kept[space.as_pointer()] = value

    def take(self, space):
        """Take the kept state of a viewport out of the store; None without one."""
        self.drop_gone()
        return self._kept.pop(space.as_pointer(), None)

    def drop_gone(self):
        """Remove the stored values of viewports that were closed."""
        if self._kept:
            there = {space.as_pointer() for space in all_spaces()}
            for gone in self._kept.keys() - there:
                del self._kept[gone]

    def clear(self):
        """Drop all."""
        self._kept.clear()

    @classmethod
    def of_all(cls, do):
        """Call do(one) for everything that keeps something of viewports."""
        for one in cls._all:
            do(one)


@persistent
def _loaded(*_):
    PerViewport.of_all(PerViewport.drop_gone)


def _watched():
    return ((bpy.app.handlers.load_post, _loaded),)


def register():
    """Forget viewports that go when a file is opened."""
    handlers.add(_watched())


def unregister():
    """Forget all viewports."""
    handlers.remove(_watched())
    PerViewport.of_all(PerViewport.clear)


class _Named(NamedTuple):
    """An object that a setting of a viewport is, which may be deleted in the meantime."""

    name: str
    library: Any

    def object(self):
        """The object with this name and library; None if it was deleted or renamed."""
        return bpy.data.objects.get((self.name, self.library))


_before = PerViewport()
"""{path of a setting: what it was before the viewport was given another value}."""
_PERSPECTIVE = "region_3d.view_perspective"
_VIEW = "region_3d.view_location", "region_3d.view_rotation", "region_3d.view_distance"
"""What Blender changes along with the perspective."""


def change(space, values):
    """Give settings of a viewport other values, by their paths. `restore` gives back what they were."""
    if _PERSPECTIVE in values and not has(space, {_PERSPECTIVE: values[_PERSPECTIVE]}):
        for path in _VIEW:
            _keep(space, path)
    for path, value in values.items():
        is_new = not has(space, {path: value})
        # A setting that has the value already is given it back too, unless the value comes from an earlier change.
        if is_new or path not in (_before.get(space) or {}):
            _keep(space, path)
        if is_new:
            _set(space, path, value)


def has(space, values):
    """Whether settings of a viewport, by their paths, are at these values."""
    return all(getattr(*_place(space, path)) == value for path, value in values.items())


def restore(space, values):
    """Give settings of a viewport, by their paths, what they were before, or these values where that is not known."""
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
