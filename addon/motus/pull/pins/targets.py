"""Find the vertex and the settings of a new pin: from keywords, from the last pull, or from a pin to be mirrored."""

from ...core.lazy import numpy as np
from ...core.refusals import Refused
from ...core.translations import tr
from ..brush import AXIS_INDEX, Brush, Space, unit
from ..mesh import arrays, object_mesh, welding
from ..mesh.open_mesh import open_mesh
from ..properties import KEYWORDS

PULL_SETTINGS = ("radius", "falloff", "scale_factor", "distance", "weld", "mirror", "vertex_group")
LIMITS = ("use_minimum", "minimum", "use_maximum", "maximum", "clamp_axis")
AXIS_NAMES = tuple(AXIS_INDEX)


def checked(obj, positions, vertex):
    """Return the index of a vertex at which a pin can pull. Raises Refused if there is no such vertex or its position is not finite."""
    if not 0 <= vertex < len(positions):
        raise Refused(tr("{object} has no vertex {index}: it has {count}").format(object=obj.name, index=vertex, count=len(positions)))
    if not np.isfinite(positions[vertex]).all():
        raise Refused(tr("Vertex {index} is at no place: its coordinates are not finite").format(index=vertex))
    return vertex


def nearest(obj, positions, place, metric):
    """Index of the vertex nearest to a local position. metric: 3x3 matrix that measures lengths.

    Raises Refused if there is no vertex, or its position is not finite.
    """
    if not len(positions):
        raise Refused(tr("{object} has no vertices").format(object=obj.name))
    vertex, away = object_mesh.nearest(positions, place, metric)
    if not np.isfinite(away):
        raise Refused(tr("Vertex {index} is at no place: its coordinates are not finite").format(index=vertex))
    return vertex


def from_keywords(operator, context, obj):
    """Return (vertex to pull, settings) of a new pin from the operator's given keywords.

    The scene's brush gives the values of the remaining keywords.
    """
    given = {
        name: getattr(operator, name)
        for name in (*KEYWORDS, "curve")
        if name != "strength" and hasattr(operator, name) and operator.is_given(name)
    }
    brush = Brush.of(context.scene.motus.pull, given)
    space = Space(obj.evaluated_get(context.evaluated_depsgraph_get()).matrix_world)
    positions = arrays.positions(obj.data)
    if operator.vertex >= 0:
        vertex = checked(obj, positions, operator.vertex)
    else:
        vertex = nearest(obj, positions, _place(operator, context, brush, space), space.metric(brush.unit))
    if operator.properties.is_property_set("displacement"):
        way = np.array(operator.displacement, float)
        displacement = space.inverse @ way if brush.unit == 'WORLD' else way
    else:
        displacement = _displacement(obj.data, positions, vertex, brush, space)
    return vertex, settings_of(obj, brush, space) | {"displacement": displacement}


def settings_of(obj, brush, space):
    """Settings of a pin, {name: value}, from a Brush; the limits are converted to the object's space."""
    if brush.vertex_group and brush.vertex_group not in obj.vertex_groups:
        raise Refused(tr("{object} has no vertex group {group}").format(object=obj.name, group=brush.vertex_group))
    found = {name: getattr(brush, name) for name in PULL_SETTINGS}
    found["mirror"] = set(brush.mirror)
    found["metric"] = space.metric(brush.unit).ravel()
    if brush.curve:
        found["curve"] = brush.curve
    return found | _limits(brush, space)


def check_record(record, obj):
    """Raise Refused if nothing was pulled yet, or if the last pull was made on a different object."""
    if not record.object:
        raise Refused(tr("Nothing was pulled yet"))
    if record.object != obj.name:
        raise Refused(tr("The last pull was one of {object}").format(object=record.object))


def from_record(record, obj):
    """Return (vertex to pull, settings) of a pin that repeats the last pull.

    record: record of a stroke that pulled at a single vertex.
    """
    found = {name: getattr(record, name) for name in (*PULL_SETTINGS, "metric", "curve", "displacement")}
    found["mirror"] = set(record.mirror)
    limits = {name: getattr(record, name) for name in ("unit", *LIMITS)}
    return record.vertex, found | _limits(Brush(**limits), Space(obj.matrix_world))


def take_back(shapes, obj):
    """Restore the mesh to its shape before the last stroke.

    Returns how far the user saw the stroke move each vertex, float32 (n, 3). shapes: (object's name, shape before, shape after), or None.
    Raises Refused if the mesh no longer has the shape after the stroke.
    """
    mesh = open_mesh(obj)
    _, before, after = shapes if shapes and shapes[0] == obj.name else (None, None, None)
    if after is None or not np.array_equal(mesh.positions(), after):
        raise Refused(tr("The mesh has changed since the last pull, so that it cannot be taken out of it"))
    share = mesh.share_seen()
    if share == 0.0:
        raise Refused(object_mesh.not_seen(mesh.key))
    mesh.write(before)
    mesh.finish()
    return np.float32(share) * (after - before)


def mirrored(obj, pin, axis):
    """Return (vertex to pull, settings) of the mirror image of a pin across an axis of the object. axis: 0, 1 or 2."""
    turn = np.ones(3)
    turn[axis] = -1.0
    positions = arrays.positions(obj.data)
    metric = np.reshape(pin.metric, (3, 3)) * turn
    vertex = nearest(obj, positions, turn * np.array(pin.place), metric)
    names = ("strength", "is_muted", *PULL_SETTINGS, "curve", *LIMITS)
    found = {name: getattr(pin, name) for name in names}
    found |= {"displacement": turn * np.array(pin.displacement), "metric": metric.ravel()}
    if pin.clamp_axis == AXIS_NAMES[axis]:
        found |= {"use_minimum": pin.use_maximum, "minimum": -pin.maximum, "use_maximum": pin.use_minimum, "maximum": -pin.minimum}
    return vertex, found


def _place(operator, context, brush, space):
    """Local position at which the new pin is to pull: the keyword `location`, or the 3D cursor."""
    if not operator.properties.is_property_set("location"):
        return space.point_to_local(context.scene.cursor.location)
    return space.point_to_local(operator.location) if brush.unit == 'WORLD' else np.array(operator.location, float)


def _displacement(mesh, positions, vertex, brush, space):
    """Displacement of the pulled vertex by the brush's direction and strength, in the object's space."""
    if brush.direction == 'VIEW':
        raise Refused(tr("A pin has no view to pull towards: choose another direction or give a displacement"))
    if brush.direction == 'CURSOR':
        raise Refused(tr("A pin has no cursor to go along with: choose another direction or give a displacement"))
    if brush.direction in AXIS_INDEX:
        axis = np.eye(3)[AXIS_INDEX[brush.direction]]
        way = space.inverse @ axis if brush.unit == 'WORLD' else axis
    else:
        welded = welding.weld(positions, brush.weld, space.metric(brush.unit))
        corners = welding.leaders_of(welded, arrays.corners(mesh))
        normal = arrays.vertex_normal(mesh, corners, positions, welding.leaders_of(welded, vertex))
        if not normal.any():
            raise Refused(tr("Vertex {index} has no normal: choose another direction").format(index=vertex))
        way = space.inverse @ space.normal_to_world(normal) if brush.unit == 'WORLD' else unit(normal)
    return brush.strength * way / np.linalg.norm(space.metric(brush.unit) @ way)


def _limits(brush, space):
    """Settings of a pin's limits, {name: value}, from the limits of the brush, along an axis of the object.

    Raises Refused if no axis of the object is parallel to the axis of the limits.
    """
    if not (brush.use_minimum or brush.use_maximum):
        return dict.fromkeys(("use_minimum", "use_maximum"), False)
    found = space.limits(brush)
    if found is None:
        raise Refused(tr("The object is turned, and a pin's limits are along its own axes: choose Local as the unit"))
    axis, low, high = found
    return {
        "clamp_axis": AXIS_NAMES[axis],
        "use_minimum": bool(np.isfinite(low)),
        "use_maximum": bool(np.isfinite(high)),
        "minimum": low if np.isfinite(low) else 0.0,
        "maximum": high if np.isfinite(high) else 0.0,
    }
