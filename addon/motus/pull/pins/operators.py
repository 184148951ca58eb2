"""Operators on the list of pins: add, remove, reorder, mirror, and bind again to a vertex."""

import bpy

from ...core.interface.operators import OBJECT_MODE, FindsValues, Operator, object_keyword
from ...core.interface.rows import Row, Rows
from ...core.lazy import numpy as np
from ...core.refusals import Refused, check_finite
from ...core.translations import tr
from .. import keywords, rows
from ..falloff_curve import CURVE_SAMPLES
from ..mesh import arrays
from ..properties import BrushKeywords
from ..session import history
from . import setup, targets

AXES = (('X', "X", ""), ('Y', "Y", ""), ('Z', "Z", ""))
DIRECTIONS = (
    ('UP', "Up", "Let the pin act earlier"),
    ('DOWN', "Down", "Let the pin act later"),
)
KEYWORDS = (
    "radius",
    "unit",
    "falloff",
    "scale_factor",
    "distance",
    "weld",
    "direction",
    "mirror",
    "use_minimum",
    "minimum",
    "use_maximum",
    "maximum",
    "clamp_axis",
    "vertex_group",
)
"""Keywords of the brush that a pin has too. The scene's brush gives the values that the caller leaves out."""


def mesh_keyword():
    """Create the string property by which scripts name the mesh object."""
    return object_keyword("Name of the mesh object; empty takes the active one")


def index_keyword():
    """Create the integer property that holds the index of a pin."""
    return bpy.props.IntProperty(
        name="Index", description="Index of the pin; -1 is the active one", default=-1, min=-1, options={'SKIP_SAVE'}
    )


class PinOperator(Operator):
    """Mixin of the operators on an object's pins.

    run() checks the object, and then calls change(context, obj), which subclasses define.
    """

    modes = OBJECT_MODE

    @classmethod
    def check_offer(cls, context):
        if context.object is None:
            raise Refused(tr("Select a mesh"))
        setup.check(context.object)

    def run(self, context):
        obj = keywords.object_of(self, context)
        setup.check(obj)
        self.change(context, obj)


class PinKeywords:
    """Mixin with the properties of the brush that a pin has too."""

    __annotations__ = {name: BrushKeywords.__annotations__[name] for name in KEYWORDS}


class MOTUS_OT_pin_add(FindsValues, PinOperator, PinKeywords, bpy.types.Operator):
    bl_idname = "motus.pin_add"
    bl_label = "Add Pull Pin"
    bl_description = "Add a pin: a pull in the object's list, which can be keyed, muted and removed"

    object: mesh_keyword()
    vertex: bpy.props.IntProperty(
        name="Vertex",
        description="Index of the root; -1 takes the vertex that is nearest to the location",
        default=-1,
        min=-1,
        options={'SKIP_SAVE'},
    )
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Place that is pulled, in the space that Unit names; without vertex and location the place of the 3D cursor",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    displacement: bpy.props.FloatVectorProperty(
        name="Displacement",
        description="Displacement of the root, instead of the brush's direction and strength",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    strength: bpy.props.FloatProperty(
        name="Strength",
        description="How much of its displacement the pinned vertex moves by: 0 nothing, 1 all of it; negative moves it the other way",
        default=1.0,
        soft_min=-2.0,
        soft_max=2.0,
        options={'SKIP_SAVE'},
    )
    curve: bpy.props.FloatVectorProperty(
        name="Curve",
        description="Forces of the falloff Curve at equal steps from the radius to the root; empty takes the scene's curve",
        size=CURVE_SAMPLES,
        options={'HIDDEN', 'SKIP_SAVE'},
    )
    name: bpy.props.StringProperty(name="Name", description="Name of the pin", options={'SKIP_SAVE'})
    from_last: bpy.props.BoolProperty(
        name="From Last Pull",
        description="Turn the last pull, or all of the last stroke, into a pin: the mesh goes back to what it was before",
        options={'SKIP_SAVE'},
    )
    redo = rows.PIN
    for_scripts = ("from_last",)

    def change(self, context, obj):
        check_finite(self, ("location", "displacement", "strength"))
        name, own = self.name or tr("Pin"), {"strength": self.strength}
        if self.from_last:
            record = context.scene.motus.pull.last
            targets.check_record(record, obj)
            if record.is_shape:
                setup.add_shape(obj, targets.take_back(history.last_shapes, obj), name, own)
                self.report({'INFO'}, tr("Pinned the last stroke on {object}").format(object=obj.name))
                return
            vertex, values = targets.from_record(record, obj)
            targets.take_back(history.last_shapes, obj)
        else:
            vertex, values = targets.from_keywords(self, context, obj)
            self.show_used(context.scene.motus.pull, KEYWORDS)
        setup.add(obj, vertex, name, values | own)
        self.report({'INFO'}, tr("Pinned at vertex {index} of {object}").format(index=vertex, object=obj.name))


class MOTUS_OT_pin_remove(PinOperator, bpy.types.Operator):
    bl_idname = "motus.pin_remove"
    bl_label = "Remove Pull Pin"
    bl_description = "Remove a pin, and what it did to the mesh"

    object: mesh_keyword()
    index: index_keyword()
    all: bpy.props.BoolProperty(name="All", description="Remove all pins", options={'SKIP_SAVE'})
    redo = (Rows(("all",)),)

    def change(self, context, obj):
        indices = set(range(len(obj.motus.pull.pins))) if self.all else set()
        setup.remove(obj, indices or {setup.pin_at(obj, self.index)})


class MOTUS_OT_pin_move(PinOperator, bpy.types.Operator):
    bl_idname = "motus.pin_move"
    bl_label = "Move Pin"
    bl_description = "Let a pin act earlier or later than others; the order matters if heights are limited"

    object: mesh_keyword()
    index: index_keyword()
    direction: bpy.props.EnumProperty(
        name="Direction", description="Direction in which the item moves in the list", items=DIRECTIONS, default='UP'
    )
    place: bpy.props.IntProperty(
        name="Place", description="New index of the pin, instead of a direction", default=-1, min=-1, options={'SKIP_SAVE'}
    )
    redo = (Rows((Row("direction", when=lambda operator: operator.place < 0),)),)

    def change(self, context, obj):
        index, last = setup.pin_at(obj, self.index), len(obj.motus.pull.pins) - 1
        place = self.place if self.place >= 0 else index + (1 if self.direction == 'DOWN' else -1)
        if not 0 <= place <= last:
            raise Refused(tr("The pin is at the end of the list already"))
        setup.reorder(obj, index, place)


class MOTUS_OT_pin_mirror(PinOperator, bpy.types.Operator):
    bl_idname = "motus.pin_mirror"
    bl_label = "Mirror Pin"
    bl_description = "Add a pin like this one on the other side of the object, with a strength of its own"

    object: mesh_keyword()
    index: index_keyword()
    axis: bpy.props.EnumProperty(name="Axis", description="Axis of the object across which the pin is mirrored", items=AXES, default='X')
    redo = (Rows(("axis",)),)

    def change(self, context, obj):
        pin = obj.motus.pull.pins[setup.pin_at(obj, self.index)]
        setup.check_rooted(pin)
        vertex, values = targets.mirrored(obj, pin, targets.AXIS_INDEX[self.axis])
        setup.add(obj, vertex, pin.name, values)


class MOTUS_OT_pin_rebind(PinOperator, bpy.types.Operator):
    bl_idname = "motus.pin_rebind"
    bl_label = "Bind Pin Again"
    bl_description = "Give a pin that has lost its root a new root: the vertex nearest to the old place, or a given one"

    object: mesh_keyword()
    index: index_keyword()
    vertex: bpy.props.IntProperty(
        name="Vertex",
        description="Index of the new root; -1 takes the vertex that is nearest to the location",
        default=-1,
        min=-1,
        options={'SKIP_SAVE'},
    )
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Position of the new root, in the object; by default the position of the old root",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )

    def change(self, context, obj):
        check_finite(self, ("location",))
        pin = obj.motus.pull.pins[setup.pin_at(obj, self.index)]
        setup.check_rooted(pin)
        positions = arrays.positions(obj.data)
        place = self.location if self.is_given("location") else pin.place
        vertex = (
            targets.checked(obj, positions, self.vertex)
            if self.vertex >= 0
            else targets.nearest(obj, positions, np.array(place), np.reshape(pin.metric, (3, 3)))
        )
        setup.bind(obj, pin, vertex)
        setup.rewire(obj)


class MOTUS_OT_pin_restore(PinOperator, bpy.types.Operator):
    bl_idname = "motus.pin_restore"
    bl_label = "Restore Modifier"
    bl_description = "Restore the modifier of the pins, in front of all other modifiers"

    object: mesh_keyword()

    def change(self, context, obj):
        setup.pin_at(obj, 0)
        setup.rewire(obj)


classes = (MOTUS_OT_pin_add, MOTUS_OT_pin_remove, MOTUS_OT_pin_move, MOTUS_OT_pin_mirror, MOTUS_OT_pin_rebind, MOTUS_OT_pin_restore)
