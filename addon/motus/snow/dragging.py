"""Operator motus.snow_drag: dragging a handle of an emitter in the viewport sets the setting that the handle shows."""

import bpy
from mathutils import Vector

from ..core.interface.dragging.drag import PointDrag
from ..core.interface.operators import Operator, object_keyword
from ..core.interface.rows import Row, Rows, is_given
from ..core.interface.view import drawing
from ..core.lazy import numpy as np
from ..core.refusals import Refused, check_finite, check_local
from ..core.translations import tr
from . import handles
from .build import is_emitter

SETTINGS = (
    (handles.RADIUS, "Radius", "Half the width of the emitter"),
    (handles.ANGLE, "Cone Angle", "How far flakes lean outwards at the edge"),
    (handles.SPEED, "Speed", "How fast flakes leave"),
)


class Held:
    """A handle of an emitter while it is dragged: pull() sets its setting, restore() sets the old value again."""

    def __init__(self, emitter, setting):
        self._emitter, self.setting = emitter, setting
        self._before = getattr(emitter.motus.snow, setting)

    def pull(self, place):
        """Drag the handle to a place in the world, and set its setting accordingly. Raises Refused if the emitter has a scale of 0."""
        settings = self._emitter.motus.snow
        setattr(settings, self.setting, handles.value(settings, self.setting, self._inverse() @ Vector(place)))

    def restore(self):
        """Set the setting to its value from before the drag."""
        setattr(self._emitter.motus.snow, self.setting, self._before)

    def _inverse(self):
        matrix = self._emitter.matrix_world
        if matrix.determinant() == 0.0:
            raise Refused(tr("{object} is scaled to nothing in a direction").format(object=self._emitter.name))
        return matrix.inverted()


def places(emitter):
    """Return (names of the settings that an emitter's handles set, places (n, 3) of the handles in the world)."""
    found = handles.of(emitter.motus.snow)
    matrix = np.array(emitter.matrix_world)
    points = np.array([one.place for one in found], float).reshape(-1, 3)
    return [one.setting for one in found], points @ matrix[:3, :3].T + matrix[:3, 3]


def pick(emitter, region, matrix, mouse, near):
    """Return (setting, place in the world, place in the region) of the handle nearest to the mouse.

    None if no handle is within `near` pixels of the mouse. mouse: place in the region, pixels. matrix: perspective matrix of the view.
    """
    settings, points = places(emitter)
    best = None
    for setting, point in zip(settings, points):
        seen = drawing.project(matrix, point[None])
        if seen is None:
            continue
        place = (seen[0] + 1.0) * (region.width / 2.0, region.height / 2.0)
        away = float(np.hypot(*(place - np.array(mouse[:2]))))
        if away <= near and (best is None or away < best[0]):
            best = away, setting, Vector(point), Vector(place)
    return best and best[1:]


class MOTUS_OT_snow_drag(PointDrag, Operator, bpy.types.Operator):
    bl_idname = "motus.snow_drag"
    bl_label = "Drag Emitter's Handle"
    bl_description = "Set the size, the cone angle or the speed of an emitter by its handles"
    bl_options = {'REGISTER', 'UNDO'}

    object: object_keyword("Name of the emitter; empty takes the active object")
    setting: bpy.props.EnumProperty(name="Setting", description="Handle that is dragged", items=SETTINGS, options={'SKIP_SAVE'})
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Place in the world that the handle is dragged to",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    redo = (Rows(("setting", Row("location", when=is_given("location")))),)

    @classmethod
    def check_offer(cls, context):
        _emitter(context, "")

    def run(self, context):
        emitter = _emitter(context, self.object)
        if not self.is_given("location"):
            raise Refused(tr("Say where to: location is missing"))
        check_finite(self, ("location",))
        if self.setting not in [one.setting for one in handles.of(emitter.motus.snow)]:
            raise Refused(tr("The emitter has no such handle"))
        context.view_layer.update()
        Held(emitter, self.setting).pull(self.location)

    def invoke(self, context, event):
        if context.window is None or self.is_given("location"):
            return self.execute(context)
        try:
            self.object = _emitter(context, self.object).name
            return self._begin(context, event)
        except Refused as refusal:
            return self.refuse(refusal)

    def _show_keys(self, context):
        context.workspace.status_text_set(
            tr("Press the left mouse button on a handle of the emitter and drag it; Esc or the right button cancels")
        )

    def _hold(self, context, region, view, mouse):
        emitter = _emitter(context, self.object)  # the emitter may have been removed while the operator waited for the mouse
        found = pick(emitter, region, view.perspective_matrix, mouse, handles.NEAR * context.preferences.system.ui_scale)
        if found is None:
            return None
        self.setting, point, seen = found
        self._held = Held(emitter, self.setting)
        return point, seen

    def _move(self, place):
        self.location = place
        self._held.pull(place)


def _emitter(context, name):
    found = bpy.data.objects.get(name) if name else context.object
    if found is None or not is_emitter(found):
        raise Refused(tr("Nothing here snows"))
    check_local(found)
    return found


classes = (MOTUS_OT_snow_drag,)
