"""Setting a rig up and taking it back; what of the camera it drives; and what the native module is told of it."""

import math

import bpy

from ..core import actions, wiring
from ..core.system import Group, Property, forget, registered
from ..core.translations import tr
from . import around, lens, results

PREFIX = "motus.stereo."
OUTPUTS = ("interocular", "convergence")
"""What Blender's camera is given; see lens.Lens.off_axis."""
MODES = {'OFFAXIS': "off_axis", 'PARALLEL': "parallel", 'TOE': "toe_in"}
CENTRE = 'CENTER'


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
    settings, stereo, render = owner.motus.stereo, owner.data.stereo, scene.render
    settings.before_mode, settings.before_pivot = stereo.convergence_mode, stereo.pivot
    stereo.convergence_mode, stereo.pivot = mode, CENTRE
    if not render.use_multiview:
        begin_multiview(render, settings)
    for name, value in keywords.items():
        setattr(settings, name, value)
    settings.focus = focus
    results.forget(owner)  # of a deleted camera that had its name
    wiring.attach(system(), owner)


def remove(scene, owner):
    """Take a rig back: wiring, keys of its settings, what it has set in camera and scene, and the settings themselves."""
    settings, camera = owner.motus.stereo, owner.data
    before = settings.before_mode, settings.before_pivot
    is_multiview_made, views = settings.is_multiview_made, settings.before_views
    around.end(settings, camera)
    wiring.detach(system(), owner)
    actions.remove(owner, (PREFIX,))
    forget(system(), owner)
    results.forget(owner)
    for name, value in zip(("convergence_mode", "pivot"), before):
        around.put(camera.stereo, name, value)
    if is_multiview_made:
        _give_multiview_back(scene, views)


def renders_both_eyes(scene):
    """Whether Blender renders what the eyes of a camera see."""
    render = scene.render
    return render.use_multiview and render.views_format == 'STEREO_3D' and all(view.use for view in render.stereo_views)


def one_eye():
    """What is to be said where Blender does not."""
    return tr("The scene does not render a left and a right eye: Stereo Output lets it")


def begin_multiview(render, settings):
    """Switch multiview on, and note how it has been. settings: of the rig that does."""
    settings.before_views, settings.is_multiview_made = render.views_format, True
    render.use_multiview, render.views_format = True, 'STEREO_3D'


def _give_multiview_back(scene, views):
    """Switch multiview off, unless another rig of the scene needs it, which is then the one that has it. views: their format before."""
    heir = next((obj for obj in scene.objects if has_rig(obj)), None)
    if heir is None:
        scene.render.use_multiview = False
        around.put(scene.render, "views_format", views)
    else:
        heir.motus.stereo.is_multiview_made, heir.motus.stereo.before_views = True, views


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
    """World to camera, without the camera's scale: right, up, backward."""
    place, turn, _ = matrix.decompose()
    found = turn.to_matrix().to_4x4()
    found.translation = place
    return found.inverted()


def width_in_pixels(render):
    """Of the rendered image."""
    return render.resolution_x * render.resolution_percentage // 100


def all_rigs():
    """The cameras with a rig in the file."""
    return [obj for obj in bpy.data.objects if has_rig(obj)]
