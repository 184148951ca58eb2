"""Find the camera that an operator works on, and raise Refused if it does not suit."""

import math

import bpy
from mathutils import Matrix

from ..core import wiring
from ..core.refusals import Refused, check_evaluated, check_local, check_unbaked, named
from ..core.translations import tr
from . import rig

IN_FRONT = Matrix.Translation((0.0, -10.0, 1.5)) @ Matrix.Rotation(math.radians(90.0), 4, 'X')
"""World matrix of a new camera if there is no viewport whose view it could take: in front of the origin, looking along +Y."""


def camera_for(context, name):
    """The camera of this name, the active camera, or the scene's camera. Raises Refused if there is none."""
    active = context.object if context.object and context.object.type == 'CAMERA' else context.scene.camera
    found = named(name) if name else active
    if found is None:
        raise Refused(tr("Select a camera, or give the scene one"))
    if found.type != 'CAMERA':
        raise Refused(tr("{object} is no camera").format(object=found.name))
    return found


def lacks_camera(context):
    """Whether no object of the scene is a camera."""
    return not any(obj.type == 'CAMERA' for obj in context.scene.objects)


def new_camera(context):
    """Create the scene's camera with the viewport's view; if there is no viewport, in front of the origin."""
    camera = bpy.data.objects.new(tr("Camera"), bpy.data.cameras.new(tr("Camera")))
    context.scene.collection.objects.link(camera)
    view = context.region_data
    camera.matrix_world = view.view_matrix.inverted() if view else IN_FRONT
    context.scene.camera = camera
    context.view_layer.update()


def rig_for(context, name):
    """Return the camera of this name, the active camera, or the scene's camera, if it has a stereo rig.

    Raises Refused if there is no such camera, or it has no rig.
    """
    found = camera_for(context, name)
    if not rig.has_rig(found):
        raise Refused(tr("{object} has no stereo rig").format(object=found.name))
    return found


def focus_for(context, camera, name):
    """Return the object of this name; without a name the only selected object except the camera; None if there is not exactly one."""
    if name:
        return named(name)
    others = [obj for obj in context.selected_objects if obj != camera]
    return others[0] if len(others) == 1 else None


def check_free(camera):
    """Raise Refused if a camera cannot get a stereo rig."""
    check_local(camera)
    check_local(camera.data)
    if camera.motus.bake.is_baked:
        check_unbaked(camera, camera.motus.stereo)
    if rig.has_rig(camera):
        raise Refused(tr("{object} has a stereo rig: remove that first").format(object=camera.name))
    other = next((one for one in rig.all_rigs() if one.data == camera.data), None)
    if other:
        raise Refused(
            tr("{object} has its lens in common with {other}, which has a stereo rig").format(object=camera.name, other=other.name)
        )
    if camera.data.type != 'PERSP':
        raise Refused(tr("{object} is no perspective camera").format(object=camera.name))
    for distance in ("interocular_distance", "convergence_distance"):
        wiring.check_property(camera, f"data.stereo.{distance}")


def check_removable(camera):
    """Raise Refused if a camera's stereo rig must not be changed, since the camera is linked or baked."""
    check_local(camera)
    check_local(camera.data)
    check_unbaked(camera, camera.motus.stereo)


def check_solved(context, camera):
    """Raise Refused if the solver of a camera's rig does not set the eye distances at present."""
    check_evaluated(camera, context.view_layer)
    problem = wiring.problem(rig.system(), camera, context.view_layer.depsgraph)
    if problem and problem.blocking:
        raise Refused(tr(problem.sentence))
    if camera.data.type != 'PERSP':
        raise Refused(tr("{object} is no perspective camera").format(object=camera.name))
