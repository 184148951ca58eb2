"""Operator motus.pick_pull, as scripts run it by keywords; window/modal.py adds the mouse."""

import bpy

from ..core.interface.operators import Operator, object_keyword
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import keywords, properties, rows
from .falloff_curve import CURVE_SAMPLES
from .mesh import object_mesh
from .properties import BrushKeywords
from .session import history
from .session.dab import Session
from .session.history import Done
from .window import modal


class MOTUS_OT_pick_pull(modal.PickPullModal, Operator, BrushKeywords, bpy.types.Operator):
    bl_idname = "motus.pick_pull"
    bl_label = "Pick & Pull"
    bl_description = "Pull the surface at a vertex; the vertices near it follow"

    object: object_keyword("Name of the mesh object; empty takes the active one")
    vertex: bpy.props.IntProperty(
        name="Vertex",
        description="Index of the vertex that is pulled; -1 takes the vertex nearest to the location",
        default=-1,
        min=-1,
        options={'SKIP_SAVE'},
    )
    location: bpy.props.FloatVectorProperty(
        name="Location",
        description="Place that is pulled, in the space that Unit names: of the world or of the object",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    displacement: bpy.props.FloatVectorProperty(
        name="Displacement",
        description="Displacement of the vertex, instead of a direction and a strength",
        size=3,
        subtype='XYZ',
        unit='LENGTH',
        options={'SKIP_SAVE'},
    )
    curve: bpy.props.FloatVectorProperty(
        name="Curve",
        description="Forces of the falloff Curve at equal steps from the radius to the root; empty takes the scene's curve",
        size=CURVE_SAMPLES,
        options={'HIDDEN', 'SKIP_SAVE'},
    )
    dabs: bpy.props.CollectionProperty(
        type=properties.MOTUS_PG_dab, name="Dabs", description="Dabs of the strokes, which Redo repeats", options={'HIDDEN', 'SKIP_SAVE'}
    )

    redo = rows.PULL

    @classmethod
    def check_offer(cls, context):
        if sentence := object_mesh.problem(context.object):
            raise Refused(sentence)

    def run(self, context):
        session = start(self, context)
        has_acted = replay(session, self.dabs) if self.dabs else self._pull_once(context, session)
        if not session.finish() and has_acted:
            raise Refused(modal.why_cancelled(session) or tr("Nothing moved: what is in reach is hidden, masked or held by a limit"))
        self.remember(context, session, with_dabs=False)
        if session.mesh.share_seen() == 0.0:
            self.report({'WARNING'}, object_mesh.not_seen(session.mesh.key))

    def start(self, context):
        """Create a Session from the operator's keywords. Raises Refused if the mesh or the keywords do not suit."""
        return start(self, context)

    def remember(self, context, session, with_dabs=True):
        """Store what a Session did: the dabs in the operator for Redo, and the last stroke in the scene as the last pull.

        with_dabs: whether the dabs are stored.
        """
        keywords.show(self, session.brush)
        self.object = session.object_name
        if with_dabs:
            keep_dabs(self.dabs, session)
        if session.last is not None:
            keep_last(context.scene.motus.pull.last, session)

    def _pull_once(self, context, session):
        vertex = self._root(session)
        session.begin_stroke()
        if self.is_given("displacement"):
            displacement = session.to_world_vector(self.displacement)
        else:
            displacement = session.displacement(vertex, view=toward_viewer(context))
        return session.pull(vertex, displacement)

    def _root(self, session):
        """Index of the vertex to pull (the root), by the keywords `vertex` or `location`. Raises Refused if there is none."""
        if self.vertex >= 0:
            if self.vertex >= len(session.current):
                raise no_such_vertex(session, self.vertex)
            hidden = session.mesh.hidden()
            if hidden is not None and hidden[self.vertex]:
                raise Refused(tr("Vertex {index} is hidden").format(index=self.vertex))
            return self.vertex
        if not self.is_given("location"):
            raise Refused(tr("Say where: a location or a vertex"))
        found, away = session.nearest(session.to_world_point(self.location))
        if not away < session.reach_radius and session.brush.distance != 'EDGES':
            raise Refused(tr("No vertex lies within the radius of this location"))
        return found


def start(operator, context):
    """Create a Session with the operator's given keywords, and values of the scene's brush for the remaining ones.

    Raises Refused if the mesh or the keywords do not suit.
    """
    return Session(context, keywords.object_of(operator, context), keywords.brush_of(operator, context))


def replay(session, dabs):
    """Repeat recorded dabs in a Session with the brush's present radius and strength; returns whether anything was done.

    dabs: items that keep_dabs() has written. Raises Refused if the mesh has fewer vertices than a dab needs.
    """
    brush = session.brush
    has_acted = False
    for dab in dabs:
        if dab.is_first:
            session.begin_stroke(is_drag=dab.kind == 'DRAG')
        if dab.vertex >= len(session.current):
            raise no_such_vertex(session, dab.vertex)
        displacement = _length_of_dab(dab, brush) * np.array(dab.displacement, float)
        done = Done(dab.kind, dab.vertex, displacement, dab.radius * brush.radius, dab.strength)
        has_acted = session.repeat(done) or has_acted
    session.flush()
    return has_acted


def keep_dabs(items, session):
    """Store the dabs of a Session in a collection property, for replay().

    Lengths are stored as shares of the brush's radius and strength. Displacements of drags are stored in full, since the mouse gave them.
    """
    items.clear()
    radius = session.brush.radius
    for dab in session.dabs:
        item = items.add()
        item.kind, item.vertex, item.is_first = dab.kind, dab.vertex, dab.is_first
        strength = _length_of_dab(dab, session.brush) or 1.0
        item.displacement = [part / strength for part in dab.displacement]
        item.radius, item.strength = dab.radius / radius, dab.strength


def _length_of_dab(dab, brush):
    return 1.0 if dab.kind == 'DRAG' else brush.strength


def keep_last(record, session):
    """Store the last stroke of a Session in the scene's record of the last pull."""
    pulled = session.last
    keywords.copy(pulled.brush, record)
    record.radius = pulled.dab.radius
    record.object, record.vertex = session.object_name, pulled.dab.vertex
    record.is_shape = not session.is_last_like_a_pin
    record.welded = session.welded
    record.place, record.displacement = pulled.place, pulled.dab.displacement
    record.metric = session.space.metric(pulled.brush.unit).ravel().tolist()
    if pulled.brush.curve:
        record.curve = pulled.brush.curve
    history.last_shapes = session.object_name, *session.shapes_of_last()


def no_such_vertex(session, vertex):
    """Return the Refused that reports that a Session's mesh has no vertex of this index."""
    return Refused(
        tr("{object} has no vertex {index}: it has {count}").format(object=session.object_name, index=vertex, count=len(session.current))
    )


def toward_viewer(context):
    """World direction towards the viewer of the 3D viewport in which the operator runs; None outside of a 3D viewport."""
    view = getattr(context, "region_data", None)
    if view is None or not hasattr(view, "view_rotation"):
        return None
    return tuple(view.view_matrix.inverted().to_3x3().col[2])


classes = (MOTUS_OT_pick_pull,)
