"""Add and remove a stereo rig: the properties of the camera that the rig drives, and the eyes as arguments of native functions."""

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
"""Names of the solver's results that drive the camera: interocular and convergence distance."""
MODES = {'OFFAXIS': "off_axis", 'PARALLEL': "parallel", 'TOE': "toe_in"}
CENTRE = 'CENTER'
ONE_EYE, BOTH_EYES = 'LEFT', 'S3D'
"""Values of SpaceView3D.stereo_3d_camera: one eye, and both eyes."""


def system():
    """The registered System of stereo rigs. A top-level import is impossible, since the package's __init__ imports this module."""
    return registered["stereo"]


def groups(owner):
    """Declare the driven properties to the registry: interocular and convergence distance of the camera's data."""
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
    """Whether an object is a camera that has a stereo rig."""
    # Accessing obj.motus would create the settings.
    return obj.type == 'CAMERA' and obj.is_property_set("motus") and obj.motus.stereo.is_active


def add(scene, owner, mode, focus, keywords):
    """Add a stereo rig to a camera.

    mode: Blender's convergence mode. focus: object that lies on the screen, or None. keywords: {name: value} of the rig's settings.
    """
    settings, stereo = owner.motus.stereo, owner.data.stereo
    settings.before_mode, settings.before_pivot = stereo.convergence_mode, stereo.pivot
    stereo.convergence_mode, stereo.pivot = mode, CENTRE
    begin_multiview(scene)
    for name, value in keywords.items():
        setattr(settings, name, value)
    settings.focus = focus
    results.forget(owner)  # a deleted camera with the same name may have left results
    wiring.attach(system(), owner)


def remove(owner):
    """Remove a camera's stereo rig: its drivers, its settings with their keys, and its changes to the camera and the scenes."""
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


def writes_pair(scene):
    """Whether the scene writes a file for each eye."""
    return renders_both_eyes(scene) and scene.render.image_settings.views_format == 'INDIVIDUAL'


def one_eye():
    """Return the sentence that reports a scene that does not render both eyes."""
    return tr("The scene does not render a left and a right eye: Stereo Output lets it")


def begin_multiview(scene):
    """Switch on stereoscopy (multiview) in a scene that has it off, and store the scene's previous views format."""
    render, noted = scene.render, scene.motus.stereo
    if render.use_multiview:
        return
    noted.before_views, noted.is_multiview_made = render.views_format, True
    render.use_multiview, render.views_format = True, 'STEREO_3D'
    _look_through(ONE_EYE, BOTH_EYES)


def _look_through(eye, before):
    """Change SpaceView3D.stereo_3d_camera from `before` to `eye` in all viewports that have the value `before`.

    Otherwise Blender would show both eyes on top of each other in every camera view when multiview is switched on.
    """
    for space in viewports.all_spaces():
        if space.stereo_3d_camera == before:
            space.stereo_3d_camera = eye


def _give_multiview_back(scene):
    """Switch off multiview in a scene if a rig has switched it on and no camera of the scene has a rig any more."""
    noted = scene.motus.stereo
    if not noted.is_multiview_made or scene.library or any(has_rig(obj) for obj in scene.objects):
        return
    scene.render.use_multiview = False
    if not any(other.render.use_multiview for other in bpy.data.scenes):
        _look_through(BOTH_EYES, ONE_EYE)
    around.put(scene.render, "views_format", noted.before_views)
    scene.motus.property_unset("stereo")


def eyes(scene, owner, depsgraph):
    """Describe the eyes with which Blender renders: (keyword arguments of the native functions, Lens).

    Returns (None, None) if the camera is not perspective.
    """
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


def window(owner, depsgraph):
    """Parallax of the left and right edge of a camera's floating window, fractions of the image's width; 0 without a rig."""
    if not has_rig(owner):
        return 0.0, 0.0
    settings = owner.evaluated_get(depsgraph).motus.stereo
    return 0.01 * settings.window_left, 0.01 * settings.window_right


def axis_matrix(matrix):
    """Matrix from the world to the camera's axes as Blender renders: x right, y up, z backward, in world units.

    The camera's scale is ignored. A mirrored or sheared camera keeps its mirrored or sheared axes, so that the matrix is no rotation.
    """
    return matrix.normalized().inverted_safe()


def width_in_pixels(render):
    """Width of the rendered image, in pixels."""
    return render.resolution_x * render.resolution_percentage // 100


def shown(scene, camera):
    """Return the scene's camera if timeline markers bind cameras to frames; otherwise return the given camera."""
    return scene.camera if scene.camera and any(marker.camera for marker in scene.timeline_markers) else camera


def all_rigs():
    """Return all cameras of the file that have a stereo rig."""
    return [obj for obj in bpy.data.objects if has_rig(obj)]
