"""The operator that drags the end bob of a paused pendulum: the rods follow, and the motion starts from that pose, at rest."""

import math

import bpy
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

from ..core import native
from ..core.file.pointers import pointed
from ..core.interface.dragging.drag import PointDrag
from ..core.interface.operators import OBJECT_MODE, Operator, object_keyword
from ..core.interface.rows import Row, Rows, is_given
from ..core.lazy import numpy as np
from ..core.measures import scene_time
from ..core.refusals import Refused, check_evaluated, check_finite, named
from ..core.translations import tr
from . import build, clock, directions, parts, solve, targets

NEAR = 30.0
"""Greatest distance between the mouse and a bob that can be grabbed, in pixels at the interface's normal size."""
KEPT = ("angle1", "angle2", "heading", "velocity1", "velocity2", "velocity_sideways", "start_frame")


class Held:
    """The end bob of one pendulum while it is dragged. number: index of the pendulum in its fan."""

    def __init__(self, context, pivot, number=0):
        depsgraph = context.view_layer.depsgraph
        self._pivot, self._number = pivot, number
        self._each = parts.rods_each(self._settings)
        self._world = pivot.evaluated_get(depsgraph).matrix_world.copy()
        self._frame = scene_time.present(context.scene)
        self._before = {name: getattr(self._settings, name) for name in KEPT}
        self._swing, self._state = _state(context, pivot, number)
        self._offset = Vector((0.0, end_of(pivot, depsgraph, number, self._world).y, 0.0))
        self._end = _reach(self._settings, self._swing, self._state)
        self.point = self._world @ (self._offset + self._end)

    @property
    def _settings(self):
        return self._pivot.motus.pendulum

    def pull(self, place):
        """Set the starting angles so that the bob is at a place in the world, as near as the rods and their plane of motion allow."""
        if place == self.point:
            self.restore()
            return
        local = self._world.inverted_safe() @ place
        goal = Vector((local.x, 0.0, local.z))
        if self._swing.is_spherical:
            self._settings.heading, self._settings.velocity_sideways = math.atan2(local.y, local.x), 0.0
            goal.x = math.hypot(local.x, local.y)
        found = self._bent(goal) if self._each == 2 else (build.angle_of(goal),)
        self._settings.angle1 = found[0]
        if self._each == 2:
            self._settings.angle2 = found[1] - self._number * self._settings.angle_step  # type: ignore[misc]
            self._settings.velocity2 = 0.0
        self._settings.velocity1 = 0.0
        self._settings.start_frame = max(self._frame, self._before["start_frame"])

    @property
    def has_new_start(self):
        """Whether the drag has moved the start of the motion to a later frame, so that the motion before that frame is lost."""
        return self._settings.start_frame > self._before["start_frame"]

    def restore(self):
        """Restore the settings as they were before the drag."""
        for name, value in self._before.items():
            setattr(self._settings, name, value)

    def _bent(self, goal):
        lengths = parts.lengths(self._settings)
        # The joint between the rods stays on its side of the line from the pivot to the end.
        end, elbow = self._end, lengths[0] * Vector(directions.of_angles(self._state[0], 0.0))
        side = 1.0 if end.cross(elbow).y >= 0.0 else -1.0
        across = Vector((goal.z, 0.0, -goal.x)) * side
        if across.length == 0.0:
            across = elbow
        pole = 0.5 * goal + across
        found = native.module.solve_two_bone((0.0, 0.0, 0.0), tuple(goal), *lengths, tuple(pole))
        joint, tip = Vector(found.elbow.tolist()), Vector(found.tip.tolist())
        return build.angle_of(joint), build.angle_of(tip - joint)


def _reach(settings, swing, state):
    """Return the position of the end of the last rod in the pivot's space, in a state of the pendulum."""
    return Vector(directions.ends(swing, np.array([state]), parts.lengths(settings))[0])


def _state(context, pivot, number):
    """Return (Swing, state of one pendulum) at the present frame; refuses a pendulum whose motion cannot be computed."""
    settings, scene = pivot.motus.pendulum, context.scene
    swing = solve.swing_of(settings, scene)
    seconds = clock_at(context, pivot).seconds
    if not hasattr(swing, "at"):
        raise Refused(tr(swing.sentence))
    try:
        return swing, swing.at(seconds)[number]
    except ValueError:
        raise Refused(tr(solve.unknown(seconds, swing.count).sentence)) from None


def clock_at(context, pivot):
    """Return the clock.Clock of a pendulum at the present frame."""
    scene = context.scene
    return clock.read(pivot, pivot.motus.pendulum, scene_time.present(scene), scene_time.fps(scene))


def end_of(pivot, depsgraph, number, world):
    """Return the upper end of a pendulum's first rod in the pivot's space; zero if the rod does not exist.

    number: index of the pendulum in its fan. world: world matrix of the pivot.
    """
    settings = pivot.motus.pendulum
    rod = next((pointed(entry, "object") for entry in parts.own_rods(pivot) if entry.number == number * parts.rods_each(settings)), None)
    return world.inverted_safe() @ rod.evaluated_get(depsgraph).matrix_world.translation if rod else Vector()


def check_stands_still(context, pivot):
    """Refuse a pendulum that is playing at the present frame."""
    settings = pivot.motus.pendulum
    if settings.is_playing and scene_time.present(context.scene) > settings.start_frame:
        raise Refused(tr("The pendulum is playing: pause it first, or go to its start"))


class MOTUS_OT_pendulum_drag(PointDrag, Operator, bpy.types.Operator):
    bl_idname = "motus.pendulum_drag"
    bl_label = "Drag Pendulum"
    bl_description = "Take a paused pendulum's end bob elsewhere; the motion starts from there, at rest, and replaces the earlier one"

    object: object_keyword("Name of the pivot, or of a rod or bob; empty takes the active one")
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Place in the world that the end bob is dragged to",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    number: bpy.props.IntProperty(
        name="Number",
        description="Index of the pendulum in its fan; the other pendulums keep their angles to it",
        default=0,
        min=0,
        options={'SKIP_SAVE'},
    )

    modes = OBJECT_MODE
    needs_native = True
    redo = (Rows((Row("location", when=is_given("location")), Row("number", when=is_given("number")))),)

    @classmethod
    def check_offer(cls, context):
        check_stands_still(context, targets.pivot_for(context, ""))

    def run(self, context):
        pivot = self._pivot(context)
        if not self.is_given("location"):
            raise Refused(tr("Say where to: location is missing"))
        check_finite(self, ("location",))
        if self.number >= pivot.motus.pendulum.count:
            raise Refused(tr("The fan has {count} pendulums").format(count=pivot.motus.pendulum.count))
        self._held = Held(context, pivot, self.number)
        self._held.pull(Vector(self.location))
        context.view_layer.update()
        self._finish(context)

    def invoke(self, context, event):
        if context.window is None or self.is_given("location"):
            return self.execute(context)
        try:
            self.object = self._pivot(context).name
            return self._begin(context, event)
        except Refused as refusal:
            return self.refuse(refusal)

    def _pivot(self, context):
        pivot = targets.pivot_for(context, self.object)
        check_evaluated(pivot, context.view_layer)
        check_stands_still(context, pivot)
        return pivot

    def _show_keys(self, context):
        context.workspace.status_text_set(tr("Press the left mouse button on the end bob and drag it; Esc or the right button cancels"))

    def _hold(self, context, region, view, mouse):
        pivot = named(self.object)
        least, found = NEAR * context.preferences.system.ui_scale, None
        for number in range(pivot.motus.pendulum.count):
            held = Held(context, pivot, number)
            seen = location_3d_to_region_2d(region, view, held.point)
            if seen is not None and (seen - mouse).length < least:
                least, found = (seen - mouse).length, (held, seen, number)
        if found is None:
            return None
        self._held, seen, number = found
        if pivot.motus.pendulum.count > 1:
            self.number = number
        return self._held.point, seen

    def _move(self, place):
        self.location = place
        self._held.pull(Vector(place))

    def _finish(self, context):
        if self._held.has_new_start:
            self.report(
                {'INFO'},
                tr("The motion starts at frame {frame} now: the earlier motion is replaced").format(
                    frame=f"{scene_time.present(context.scene):g}"
                ),
            )


classes = (MOTUS_OT_pendulum_drag,)
