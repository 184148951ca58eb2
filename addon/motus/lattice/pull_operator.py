"""Operator that pulls a lattice by a point of the surface that it deforms."""

import bpy
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

from ..core.interface.dragging.drag import PointDrag
from ..core.interface.operators import OBJECT_MODE, Operator
from ..core.interface.rows import Row, Rows, is_given
from ..core.interface.ui import length
from ..core.refusals import Refused, check_finite
from ..core.translations import tr
from . import picking, pulling, removal, targets

REACHED = 1e-3
"""Share of the displacement: a point that ends nearer to its goal counts as brought there."""


def _objects(context, name=""):
    """Objects that are deformed by the lattice that the operator pulls."""
    obj = targets.named_or_active(context, name)
    if obj.type != 'LATTICE' or any(one.type == 'LATTICE' for one in obj.modifiers):
        return [obj]
    found = [one for one in removal.deformed_by(obj) if one.visible_get(view_layer=context.view_layer)]
    if not found:
        raise Refused(tr("{object} deforms nothing that is shown").format(object=obj.name))
    return found


class MOTUS_OT_lattice_pull(PointDrag, Operator, bpy.types.Operator):
    bl_idname = "motus.lattice_pull"
    bl_label = "Pull Lattice"
    bl_description = "Drag any point of a surface that a lattice deforms; the lattice's points move so that the point follows the mouse"

    object: bpy.props.StringProperty(
        name="Object",
        options={'SKIP_SAVE'},
        description="Name of the object that the lattice deforms; empty takes the active one, or those of the active lattice",
    )
    modifier: bpy.props.StringProperty(
        name="Modifier", description="Name of the lattice's modifier; empty takes the last lattice modifier", options={'SKIP_SAVE'}
    )
    vertex: bpy.props.IntProperty(
        name="Vertex",
        description="Index of the pulled vertex, on the object with all its modifiers",
        default=-1,
        min=-1,
        options={'SKIP_SAVE'},
    )
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Place in the world; the vertex nearest to it is pulled if no vertex is given",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    displacement: bpy.props.FloatVectorProperty(
        name="Displacement",
        description="Displacement of the vertex, in the world",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    held: bpy.props.StringProperty(
        name="Held", description="Indices, with commas between, of vertices that stay where they are", options={'SKIP_SAVE'}
    )
    mirror: bpy.props.EnumProperty(
        name="Mirror",
        description="Axes of the lattice across whose middle the pull is repeated",
        default=set(),
        options={'ENUM_FLAG'},
        items=(('X', "X", ""), ('Y', "Y", ""), ('Z', "Z", "")),
    )

    modes = OBJECT_MODE
    needs_native = True
    redo = (Rows((Row("displacement", when=is_given("displacement")), Row("mirror", expand=True))),)

    @classmethod
    def check_offer(cls, context):
        for obj in _objects(context):
            pulling.check_pullable(pulling.modifier_of(obj).object)

    def run(self, context):
        held = self._held_by_name(context)
        wanted = Vector(self.displacement)
        left = held.pull(wanted)
        context.view_layer.update()
        if left > REACHED * wanted.length:
            self.report({'WARNING'}, tr("The point stays {length} away").format(length=length(context, left)))

    def _held_by_name(self, context):
        check_finite(self, ("displacement", "location"))
        if not self.is_given("displacement"):
            raise Refused(tr("Say how far: displacement is missing"))
        objects = _objects(context, self.object)
        if len(objects) > 1:
            raise Refused(tr("Say which object is pulled: the lattice deforms several"))
        shape = pulling.Shape(context, objects[0], pulling.modifier_of(objects[0], self.modifier))
        if self.vertex >= 0:
            vertex = self.vertex
        elif self.is_given("location"):
            vertex = shape.nearest(self.location)
        else:
            raise Refused(tr("Say where: vertex or location is missing"))
        corners = [(self._checked(shape, vertex), 1.0)]
        return pulling.Held(context, shape, corners, self._held_vertices(shape), self.mirror)

    def _held_vertices(self, shape):
        try:
            return [self._checked(shape, int(word)) for word in self.held.split(",") if word.strip()]
        except ValueError:
            raise Refused(tr("{keyword} is not a list of whole numbers").format(keyword="held")) from None

    @staticmethod
    def _checked(shape, vertex):
        if not 0 <= vertex < len(shape.after):
            raise Refused(tr("{object} has no vertex {number}").format(object=shape.object.name, number=vertex))
        return vertex

    def invoke(self, context, event):
        if context.window is None or self.is_given("displacement"):
            return self.execute(context)
        try:
            objects = _objects(context, self.object)
            for obj in objects:
                pulling.check_pullable(pulling.modifier_of(obj, self.modifier).object)
            self.object = objects[0].name if len(objects) == 1 else self.object
            return self._begin(context, event)
        except Refused as refusal:
            return self.refuse(refusal)

    def _press(self, event):
        if event.type not in {'X', 'Y', 'Z'} or event.value != 'PRESS' or event.ctrl or event.alt or event.oskey:
            return False
        self.mirror ^= {event.type}
        return True

    def _show_keys(self, context):
        context.workspace.status_text_set(
            tr("Press the left mouse button on the surface and drag it; X, Y, Z: mirror ({axes}); Esc or the right button cancels").format(
                axes=", ".join(sorted(self.mirror)) or "-"
            )
        )

    def _hold(self, context, region, view, mouse):
        shapes = [pulling.Shape(context, obj, pulling.modifier_of(obj, self.modifier)) for obj in _objects(context, self.object)]
        picked = picking.pick(shapes, region, view, mouse, picking.NEAR * context.preferences.system.ui_scale)
        if picked is None:
            return None
        shape, corners = picked
        self._held = pulling.Held(context, shape, corners, self._held_vertices(shape), self.mirror)
        # Adjust Last Operation pulls a vertex: the one with the largest share of the point.
        self.object, self.vertex = shape.object.name, max(corners, key=lambda corner: corner[1])[0]
        point = picking.place_of(shape, corners)
        return point, location_3d_to_region_2d(region, view, point)

    def _move(self, place):
        self.displacement = place - self._point
        self._held.pull(self.displacement)


classes = (MOTUS_OT_lattice_pull,)
