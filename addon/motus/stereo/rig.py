"""Set up and remove a stereo rig: the camera's properties that it drives, and the keywords that the library gets."""

import math

import bpy

from ..core import wiring
from ..core.blender import actions
from ..core.declare import Group, Property, registered
from ..core.declare.forgetting import forget
from ..core.interface.view import viewports
from ..core.translations import tr
from . import around, lens, results

PREFIX = "motus.stereo."
OUTPUTS = ("interocular", "convergence")
"""Outputs of the solver that drive the camera; lens.Lens.off_axis explains the factor on the convergence."""
MODES = {'OFFAXIS': "off_axis", 'PARALLEL': "parallel", 'TOE': "toe_in"}
CENTRE = 'CENTER'
ONE_EYE, BOTH_EYES = 'LEFT', 'S3D'
"""Values of a viewport's stereo_3d_camera: one eye, or both eyes."""


def system():
    """The registered System of the rigs. It cannot be imported at the top, since the package's __init__ imports this module."""
    return registered["stereo"]


def groups(owner):
    """Declare the driven properties: interocular and convergence distance of the camera's data."""
    if owner.type != 'CAMERA':
        return ()
    return (
        Group(
            outputs=OUTPUTS,
            properties=(
                Property("interocular", owner, "data.stereo.interocular_distance"),
                Property("convergence", owner, "data.stereo.convergence_distance"),
            ),
        ),
    )


def has_rig(obj):
    """Whether an object is a camera with a rig."""
    # Accessing obj.motus would create the settings.
    return obj.type == 'CAMERA' and obj.is_property_set("motus") and obj.motus.stereo.is_active


def add(scene, owner, mode, focus, keywords):
    """Add a rig to a camera. keywords: values of settings."""
    settings, stereo = owner.motus.stereo, owner.data.stereo
    settings.before_mode, settings.before_pivot = stereo.convergence_mode, stereo.pivot
    stereo.convergence_mode, stereo.pivot = mode, CENTRE
    begin_multiview(scene)
    for name, value in keywords.items():
        setattr(settings, name, value)
    settings.focus = focus
    results.forget(owner)  # results of a deleted camera with the same name
    wiring.attach(system(), owner)


def remove(owner):
    """Remove a rig: its wiring, keys of its settings, its changes to camera and scenes, and its settings."""
    settings, camera = owner.motus.stereo, owner.data
    before = settings.before_mode, settings.before_pivot
    around.end(settings, camera)
    wiring.detach(system(), owner)
    actions.remove(owner, (PREFIX,))
    forget(system(), owner)
    results.forget(owner)
    for name, value in zip(("convergence_mode", "pivot"), before):
        around.put(camera.stereo, name, value)
    for scene in bpy.data.scenes:
        _give_multiview_back(scene)


def renders_both_eyes(scene):
    """Whether the scene renders the views of both eyes."""
    render = scene.render
    return render.use_multiview and render.views_format == 'STEREO_3D' and all(view.use for view in render.stereo_views)


def one_eye():
    """Sentence for a scene that does not render both eyes."""
    return tr("The scene does not render a left and a right eye: Stereo Output lets it")


def begin_multiview(scene):
    """Switch multiview on in a scene without it, and store its previous settings."""
    render, noted = scene.render, scene.motus.stereo
    if render.use_multiview:
        return
    noted.before_views, noted.is_multiview_made = render.views_format, True
    render.use_multiview, render.views_format = True, 'STEREO_3D'
    _look_through(ONE_EYE, BOTH_EYES)


def _look_through(eye, before):
    """Replace one value of stereo_3d_camera by another in all viewports.

    With multiview switched on Blender would show both eyes on top of each other in every camera view.
    """
    for space in viewports.all_spaces():
        if space.stereo_3d_camera == before:
            space.stereo_3d_camera = eye


def _give_multiview_back(scene):
    """Switch multiview off in a scene if it was switched on for rigs and none is left."""
    noted = scene.motus.stereo
    if not noted.is_multiview_made or scene.library or any(has_rig(obj) for obj in scene.objects):
        return
    scene.render.use_multiview = False
    if not any(other.render.use_multiview for other in bpy.data.scenes):
        _look_through(BOTH_EYES, ONE_EYE)
    around.put(scene.render, "views_format", noted.before_views)
    scene.motus.property_unset("stereo")


def eyes(scene, owner, depsgraph):
    """(keywords of the library for the eyes that Blender renders with, the Lens); (None, None) if the camera is not perspective."""
    camera = owner.evaluated_get(depsgraph).data
    if camera.type != 'PERSP':
        return None, None
    seen, stereo = lens.of(camera, scene.render), camera.stereo
    mode = MODES[stereo.convergence_mode]
    distance = math.inf if mode == "parallel" else stereo.convergence_distance
    if mode == "off_axis":
        distance /= seen.off_axis
    return {
        "interaxial": stereo.interocular_distance,
        "focal_length": seen.focal_length,
        "sensor_width": seen.sensor_width,
        "convergence": distance,
        "mode": mode,
    }, seen


def axis_matrix(matrix):
    """World to camera, as Blender renders it: right, up and backward, in units of the world.

    The camera's scale has no effect, but what mirrors or shears the camera has: its axes are no rotation then.
    """
    return matrix.normalized().inverted_safe()


def width_in_pixels(render):
    """Width of the rendered image, in pixels."""
    return render.resolution_x * render.resolution_percentage // 100


def shown(scene, camera):
    """Camera of the present frame if markers bind cameras; otherwise the given camera."""
    return scene.camera if scene.camera and any(marker.camera for marker in scene.timeline_markers) else camera


def all_rigs():
    """All cameras of the file that have a rig."""
    return [obj for obj in bpy.data.objects if has_rig(obj)]
