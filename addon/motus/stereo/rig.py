"""Setting a rig up and taking it back; what of the camera it drives; and what the native module is told of it."""

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
"""What Blender's camera is given; see lens.Lens.off_axis."""
MODES = {'OFFAXIS': "off_axis", 'PARALLEL': "parallel", 'TOE': "toe_in"}
CENTRE = 'CENTER'
ONE_EYE, BOTH_EYES = 'LEFT', 'S3D'
"""What a viewport that looks through a camera shows in a scene with multiview."""


def system():
    """The registered System: the package's __init__ imports this module, not the other way round."""
    return registered["stereo"]


def groups(owner):
    """Both distances of the camera's eyes."""
    if owner.type != 'CAMERA':
        return ()
    return (Group(outputs=OUTPUTS, properties=(
        Property("interocular", owner, "data.stereo.interocular_distance"),
        Property("convergence", owner, "data.stereo.convergence_distance"))),)


def has_rig(obj):
    """Whether an object is a camera with a rig."""
    # To ask an object for its settings gives it some.
    return obj.type == 'CAMERA' and obj.is_property_set("motus") and obj.motus.stereo.is_active


def add(scene, owner, mode, focus, keywords):
    """Give a camera a rig. keywords: settings."""
    settings, stereo = owner.motus.stereo, owner.data.stereo
    settings.before_mode, settings.before_pivot = stereo.convergence_mode, stereo.pivot
    stereo.convergence_mode, stereo.pivot = mode, CENTRE
    begin_multiview(scene)
    for name, value in keywords.items():
        setattr(settings, name, value)
    settings.focus = focus
    results.forget(owner)  # of a deleted camera that had its name
    wiring.attach(system(), owner)


def remove(owner):
    """Take a rig back: wiring, keys of its settings, what it has set in camera and scenes, and the settings themselves."""
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
    """Whether Blender renders what the eyes of a camera see."""
    render = scene.render
    return render.use_multiview and render.views_format == 'STEREO_3D' and all(view.use for view in render.stereo_views)


def one_eye():
    """What is to be said where Blender does not."""
    return tr("The scene does not render a left and a right eye: Stereo Output lets it")


def begin_multiview(scene):
    """Switch multiview on in a scene without it, and note there how it has been."""
    render, noted = scene.render, scene.motus.stereo
    if render.use_multiview:
        return
    noted.before_views, noted.is_multiview_made = render.views_format, True
    render.use_multiview, render.views_format = True, 'STEREO_3D'
    _look_through(ONE_EYE, BOTH_EYES)


def _look_through(eye, before):
    """Let the viewports that look through a camera in one way look in another way.

    With multiview alone Blender would show both eyes on top of each other in every camera view, without being asked to.
    """
    for space in viewports.all_spaces():
        if space.stereo_3d_camera == before:
            space.stereo_3d_camera = eye


def _give_multiview_back(scene):
    """Switch multiview off where it was switched on for rigs, and none is left."""
    noted = scene.motus.stereo
    if not noted.is_multiview_made or scene.library or any(has_rig(obj) for obj in scene.objects):
        return
    scene.render.use_multiview = False
    if not any(other.render.use_multiview for other in bpy.data.scenes):
        _look_through(BOTH_EYES, ONE_EYE)
    around.put(scene.render, "views_format", noted.before_views)
    scene.motus.property_unset("stereo")


def eyes(scene, owner, depsgraph):
    """Keywords of the native module for the eyes that Blender renders with, and the Lens; (None, None) of no perspective camera."""
    camera = owner.evaluated_get(depsgraph).data
    if camera.type != 'PERSP':
        return None, None
    seen, stereo = lens.of(camera, scene.render), camera.stereo
    mode = MODES[stereo.convergence_mode]
    distance = math.inf if mode == "parallel" else stereo.convergence_distance
    if mode == "off_axis":
        distance /= seen.off_axis
    return {
        "interaxial": stereo.interocular_distance, "focal_length": seen.focal_length, "sensor_width": seen.sensor_width,
        "convergence": distance, "mode": mode}, seen


def axis_matrix(matrix):
    """World to camera, as Blender renders it: right, up and backward, in units of the world.

    The camera's scale has no effect, but what mirrors or shears the camera has: its axes are no rotation then.
    """
    return matrix.normalized().inverted_safe()


def width_in_pixels(render):
    """Of the rendered image."""
    return render.resolution_x * render.resolution_percentage // 100


def shown(scene, camera):
    """The camera that the scene renders on its present frame if markers choose cameras; else the given one."""
    return scene.camera if scene.camera and any(marker.camera for marker in scene.timeline_markers) else camera


def all_rigs():
    """The cameras with a rig in the file."""
    return [obj for obj in bpy.data.objects if has_rig(obj)]
