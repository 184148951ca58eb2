"""Operator that applies pins to the mesh or to shape keys.

Shape keys can take over the strengths of the pins: as their values, with keys and drivers.
"""

import bpy

from ...core.blender import copied_animation
from ...core.interface.rows import Rows
from ...core.lazy import numpy as np
from ...core.refusals import Refused
from ...core.translations import tr
from ..mesh import arrays
from . import keys, setup, solve, table
from .operators import PinOperator, mesh_keyword

TARGETS = (
    ('MESH', "Mesh", "Move the vertices themselves, by the strengths of this frame"),
    ('KEY', "One Shape Key", "One shape key for all pins, by the strengths of this frame"),
    ('KEYS', "Shape Keys", "A shape key for each pin, whose value is keyed or driven as the strength was"),
)
SLIDER_LIMIT = 10.0
"""Largest absolute value that Blender allows for the value of a shape key."""


class MOTUS_OT_pin_apply(PinOperator, bpy.types.Operator):
    bl_idname = "motus.pin_apply"
    bl_label = "Apply Pins"
    bl_description = "Make the deformation by the pins a part of the mesh, and remove the pins"

    object: mesh_keyword()
    to: bpy.props.EnumProperty(name="To", description="Form that the pins are applied in", items=TARGETS, default='MESH')
    index: bpy.props.IntProperty(
        name="Index", description="Index of the pin; -1 means all of them", default=-1, min=-1, options={'SKIP_SAVE'}
    )
    redo = (Rows(("to",)),)

    def change(self, context, obj):
        indices = list(range(len(obj.motus.pull.pins))) if self.index < 0 else [setup.pin_at(obj, self.index)]
        _check(obj, indices, self.to)
        evaluated = obj.evaluated_get(context.evaluated_depsgraph_get()).motus.pull
        rows = [table.read(evaluated.pins)[index] for index in indices]
        if self.to == 'MESH':
            _to_mesh(obj, _offsets(obj, rows, evaluated.influence))
        elif self.to == 'KEY':
            _add_key(obj, tr("Pins"), _offsets(obj, rows, evaluated.influence)).value = 1.0
        else:
            self._to_keys(obj, indices, rows, evaluated.influence)
        setup.remove(obj, set(indices))

    def _to_keys(self, obj, indices, rows, influence):
        if any(row.limits for row in rows):
            self.report({'WARNING'}, tr("Limits act on each shape key by itself now, no longer on all pins together"))
        if keys.is_animated(obj, "motus.pull.influence"):
            self.report({'WARNING'}, tr("The influence is animated: the shape keys have that of this frame"))
        for index, row in zip(indices, rows):
            pin = obj.motus.pull.pins[index]
            if keys.has_strips(obj, index):
                self.report(
                    {'WARNING'}, tr("Strips of the NLA move {pin}: its shape key has the strength of this frame").format(pin=pin.name)
                )
            full = row._replace(strength=1.0, is_muted=False)
            key = _add_key(obj, pin.name, _offsets(obj, [full], influence))
            key.mute = row.is_muted
            lowest, highest = _set_value(key, index, obj, row.strength)
            if lowest < -SLIDER_LIMIT or highest > SLIDER_LIMIT:
                self.report({'WARNING'}, tr("The strength of {pin} is beyond what a shape key allows").format(pin=pin.name))


def _check(obj, indices, to):
    mesh = obj.data
    if not indices:
        raise Refused(tr("{object} has no pins").format(object=obj.name))
    if mesh.library or mesh.override_library:
        raise Refused(tr("The mesh of {object} is linked from another file: make it local first").format(object=obj.name))
    if mesh.users - mesh.use_fake_user > 1:
        raise Refused(tr("The mesh of {object} is used by others too: make it single-user first").format(object=obj.name))
    if to != 'MESH' and mesh.shape_keys and not mesh.shape_keys.use_relative:
        raise Refused(tr("The shape keys of {object} are absolute: make them relative first").format(object=obj.name))


def _offsets(obj, rows, influence):
    """Displacement of each vertex by these pins, float32 (n, 3).

    rows: table.Row of each pin. influence: factor on all displacements. Raises Refused if the displacements cannot be determined.
    """
    offsets = np.zeros((len(obj.data.vertices), 3), np.float32)
    done = solve.displace(obj, obj.data, rows, offsets)
    if done is None:
        raise Refused(tr(solve.NOT_FINITE_MESH.sentence))
    bad = [solve.PROBLEM_OF[state] for state in done[0] if state != solve.OK]
    if bad:
        raise Refused(tr(bad[0].sentence))
    if influence != 1.0:
        offsets *= np.float32(influence)
    return offsets


def _to_mesh(obj, offsets):
    # Every shape key gets the displacements, so that the visible mix of the shape keys gets them too.
    for key in obj.data.shape_keys.key_blocks if obj.data.shape_keys else ():
        arrays.set_key_positions(key, (arrays.key_positions(key) + offsets).reshape(-1))
    arrays.set_positions(obj.data, (arrays.positions(obj.data) + offsets).reshape(-1))
    obj.data.update()


def _add_key(obj, name, offsets):
    active = obj.active_shape_key_index
    if obj.data.shape_keys is None:
        obj.shape_key_add(name=tr("Basis"), from_mix=False)
    basis = obj.data.shape_keys.reference_key
    key = obj.shape_key_add(name=name, from_mix=False)
    key.relative_key = basis
    arrays.set_key_positions(key, (arrays.key_positions(basis) + offsets).reshape(-1))
    obj.active_shape_key_index = active
    obj.data.update()
    return key


def _set_value(key, index, obj, strength):
    """Give a shape key the strength of a pin as its value, with keys and drivers; returns the (least, largest) value.

    index: of the pin.
    """
    strengths = keys.curve(obj, index, "strength")
    points = [point.co.y for point in strengths.keyframe_points] if strengths else []
    driver = keys.driver(obj, index, "strength")
    reach = (-SLIDER_LIMIT, SLIDER_LIMIT) if driver or (strengths and strengths.modifiers) else ()
    lowest, highest = min(0.0, strength, *points, *reach), max(1.0, strength, *points, *reach)
    # Add a margin, since an F-curve may exceed its keyframes because of their handles.
    room = 0.5 * (highest - lowest) if points else 0.0
    key.slider_min, key.slider_max = max(lowest - room, -SLIDER_LIMIT), min(highest + room, SLIDER_LIMIT)
    key.value = strength
    for name, field in (("strength", "value"), ("is_muted", "mute")):
        source, driven = keys.curve(obj, index, name), keys.driver(obj, index, name)
        if source:
            copied_animation.copy_curve(source, key, field)
        if driven:
            copied_animation.copy_driver(driven, key, field)
    return lowest, highest


classes = (MOTUS_OT_pin_apply,)
