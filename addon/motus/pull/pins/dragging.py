"""Operator motus.pin_drag: moves the vertex that a pin pulls (its root) to a position.

The user drags the pin's handle in the viewport, or a script gives the position.
"""

import bpy
from mathutils import Matrix, Vector

from ...core.interface.dragging.drag import PointDrag
from ...core.interface.rows import Row, Rows, is_given
from ...core.lazy import numpy as np
from ...core.refusals import Refused, check_finite
from ...core.translations import tr
from .. import keywords
from ..mesh import arrays
from . import binding, handles, setup, solve
from .operators import PinOperator, index_keyword, mesh_keyword

PROBE = 0.01
"""Distance by which a root is moved to measure its response, as a share of the mesh's size."""
LEAST_VOLUME = 1e-6
"""Least determinant of the measured response, as a share of the determinant of the plain response.

Below it the plain response (world matrix times the pin's share) is used.
"""


class Held:
    """A pin that is being dragged: pull() moves the vertex that it pulls (its root).

    point: world position at which the user saw the root at the start of the drag.
    """

    def __init__(self, context, obj, index):
        self._context, self._object, self.index = context, obj, index
        self._before = Vector(self._pin.displacement)
        self._active = obj.motus.pull.active_pin
        self._inverse = None
        self.point, self._is_broken = self._seen()
        obj.motus.pull.active_pin = index

    @property
    def _pin(self):
        pins = self._object.motus.pull.pins
        if self.index >= len(pins):
            raise ReferenceError(f"{self._object.name} has no such pin any more")
        return pins[self.index]

    @property
    def has_chosen(self):
        """Whether a different pin was active before the drag, so that the drag has changed the active pin."""
        return self._active != self.index

    def pull(self, place):
        """Change the pin's displacement so that the user sees its root at a world position.

        Later pins and modifiers may hold the root back.
        """
        if self._inverse is None:
            self._inverse = self._ways().inverted()
        self._pin.displacement = self._before + self._inverse @ (Vector(place) - self.point)

    def restore(self):
        """Restore the pin's displacement and the active pin from before the drag."""
        self._pin.displacement = self._before
        self._object.motus.pull.active_pin = self._active

    def _ways(self):
        """3x3 matrix: change of the root's visible world position for a change of the pin's displacement.

        Later modifiers, vertex groups and shape keys rotate and shorten the root's path. So the matrix is measured by small steps. Raises
        Refused if the pin does not act.
        """
        if self._is_broken:
            raise Refused(tr(solve.BROKEN.sentence))
        depsgraph = self._context.view_layer.depsgraph
        share = handles.share(self._object, depsgraph, self.index)
        if share == 0.0:
            raise Refused(tr("{pin} does not pull now: it is muted, or its strength or the influence is 0").format(pin=self._pin.name))
        plain = share * self._object.evaluated_get(depsgraph).matrix_world.to_3x3()
        if plain.determinant() == 0.0:
            raise Refused(tr("{object} is scaled to nothing in a direction").format(object=self._object.name))
        step = PROBE * binding.diagonal(arrays.positions(self._object.data)) / abs(share)
        tried = [(self._tried(step * axis) - self.point) / step for axis in Matrix.Identity(3)] if step > 0.0 else []
        self._pin.displacement = self._before
        found = Matrix(tried).transposed() if tried else plain
        return found if abs(found.determinant()) > LEAST_VOLUME * abs(plain.determinant()) else plain

    def _tried(self, more):
        self._pin.displacement = self._before + more
        return self._seen()[0]

    def _seen(self):
        """Return (world position at which the user sees the root, whether the pin has lost its root)."""
        self._context.view_layer.update()
        found = handles.read(self._object, self._context.view_layer.depsgraph)
        rows = np.flatnonzero(found.indices == self.index)
        if not len(rows):
            raise Refused(tr(solve.UNUSABLE.sentence))
        return Vector(found.places[rows[0]]), bool(found.is_broken[rows[0]])


class MOTUS_OT_pin_drag(PointDrag, PinOperator, bpy.types.Operator):
    bl_idname = "motus.pin_drag"
    bl_label = "Drag Pin"
    bl_description = "Move the root of a pin; a click makes the pin the active one"

    object: mesh_keyword()
    index: index_keyword()
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Place in the world that the root is dragged to",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    redo = (Rows((Row("location", when=is_given("location")),)),)

    def change(self, context, obj):
        if not self.is_given("location"):
            raise Refused(tr("Say where to: location is missing"))
        check_finite(self, ("location",))
        index = setup.pin_at(obj, self.index)
        setup.check_rooted(obj.motus.pull.pins[index])
        Held(context, obj, index).pull(self.location)

    def invoke(self, context, event):
        if context.window is None or self.is_given("location"):
            return self.execute(context)
        try:
            obj = keywords.object_of(self, context)
            setup.check(obj)
            self.object = obj.name
            return self._begin(context, event)
        except Refused as refusal:
            return self.refuse(refusal)

    def _show_keys(self, context):
        context.workspace.status_text_set(
            tr("Press the left mouse button on the handle of a pin and drag it; Esc or the right button cancels")
        )

    def _hold(self, context, region, view, mouse):
        obj = bpy.data.objects[self.object]
        found = handles.read(obj, context.view_layer.depsgraph)
        near = handles.NEAR * context.preferences.system.ui_scale
        row = handles.pick(found, region, view.perspective_matrix, mouse, near)
        if row is None:
            return None
        self.index = int(found.indices[row])
        self._held = Held(context, obj, self.index)
        seen, _ = handles.on_screen(found.places[row : row + 1], region, view.perspective_matrix)
        return self._held.point, Vector(seen[0])

    def _move(self, place):
        self.location = place
        self._held.pull(place)

    def _click(self, _context):
        return {'FINISHED'} if self._held.has_chosen else {'CANCELLED'}


classes = (MOTUS_OT_pin_drag,)
