"""Show the chroma key in a viewport: by the viewport's compositor if this Blender has one, otherwise on a plane before the camera."""

from ..core.blender import capabilities
from ..core.file.pointers import pointed
from ..core.interface.view import viewports
from . import setup

_COMPOSITOR = "shading.use_compositor"


def _values(scene):
    """Return {data path: value} of the settings of a viewport that shows the chroma key."""
    found = {"shading.type": 'MATERIAL', "overlay.show_overlays": False}
    if scene.camera is not None:
        found["region_3d.view_perspective"] = 'CAMERA'
    if capabilities.has_compositor_in_viewport():
        found[_COMPOSITOR] = 'ALWAYS' if scene.camera is None else 'CAMERA'
    return found


def is_shown(context):
    """Whether the context's viewport shows the chroma key."""
    space = viewports.space_for(context)
    return space is not None and space.region_3d is not None and viewports.has(space, _values(context.scene))


def show(context):
    """Show the scene's chroma key in the context's viewport.

    If this Blender has no viewport compositor, a plane in front of the camera shows the key; it is created if there is none.
    """
    scene, space = context.scene, viewports.space_for(context)
    if space is None or space.region_3d is None:
        return
    plane = pointed(scene.motus.chroma, "plane")
    is_there = plane is not None and bool(plane.users_collection)  # the PointerProperty still points to an object that was deleted
    if not capabilities.has_compositor_in_viewport() and scene.camera is not None and not is_there:
        setup.add_plane(scene)
    viewports.change(space, _values(scene))


def hide(context):
    """Restore the viewport settings from before show(); defaults if they are unknown."""
    otherwise = {"shading.type": 'SOLID', "overlay.show_overlays": True, "region_3d.view_perspective": 'PERSP', _COMPOSITOR: 'DISABLED'}
    viewports.restore(viewports.space_for(context), {path: otherwise[path] for path in _values(context.scene)})
