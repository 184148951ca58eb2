"""What is recorded of points that systems move or make, and how it becomes meshes that Blender animates by caches.

A system's modifier reads the points from the mesh of a hidden object, the hub. In the file that is handed over the modifier reads a plain
object in its place: its vertices move by a Mesh Cache modifier, and nodes store what else the points have, from further such objects whose
vertices stand for numbers, three each.
"""

import heapq

import bpy

from ..core import wiring
from ..core.blender import node_groups
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import exchange

HUB, OURS = "Hub", "motus_"
_SIZES = {'FLOAT': 1, 'INT': 1, 'FLOAT_VECTOR': 3, 'FLOAT_COLOR': 4, 'QUATERNION': 4}
_NO_ID = "curve"


class Points:
    """Samples of the points of one owner, one for each frame. system: System with a modifier. owner: object that has the modifier."""

    def __init__(self, system, owner):
        self.system, self.owner = system, owner
        self._samples = []
        place = wiring.points_place(system, owner)
        if place is None:
            raise Refused(tr("{object} has lost its modifier of Motus: set it up again").format(object=owner.name))
        # By its name, since owners share a node group, which is no longer known as that of Motus once one of them is converted.
        self._modifier = owner.modifiers[place].name
        self._hub = node_groups.input_of(owner.modifiers[place], HUB)
        self._is_loose = system.makes_points is not None and system.makes_points.shape == 'POINTS'
        self._sizes = {"position": 3} | {one.name: _SIZES[one.data_type] for one in own_attributes(self._hub.data)}

    def record(self, depsgraph, _frame):
        """Append the points of the hub's evaluated mesh to the samples; frames have to come in their order."""
        mesh = self._hub.evaluated_get(depsgraph).data
        found = {"position": _read(mesh.vertices, "co", 3)} | {one.name: _of_attribute(one) for one in own_attributes(mesh)}
        # A mesh without points may have no attributes either.
        self._samples.append({name: found.get(name, np.empty((0, size), np.float32)) for name, size in self._sizes.items()})

    def convert(self, folder, times, per_frame):
        """Let the owner's modifier read a plain object with the points. folder: caches.Folder. times: of the samples, in the keys' time.

        per_frame: number of samples in a frame. Returns the exchange.Handed; None where points make no instances.
        """
        modifier = self.owner.modifiers[self._modifier]
        group = modifier.node_group
        obj = self.plain(folder, times, per_frame)
        _rename_read(group)
        for key in [key for key in group.keys() if key.startswith(OURS)]:
            del group[key]
        for one in (group, modifier):
            one.name = one.name.replace("Motus ", "")
        node_groups.set_input(modifier, HUB, obj)
        return exchange.Handed(self.owner, modifier.name, obj) if self._is_loose else None

    def plain(self, folder, times, per_frame):
        """Make the object that takes the hub's place. Arguments as for convert()."""
        kinds = {one.name: one.data_type for one in own_attributes(self._hub.data)}
        rows, is_there, edges = self._arranged(2 * per_frame + 2)
        for name in [name for name in kinds if OURS in name]:
            kinds[name.replace(OURS, "")], rows[name.replace(OURS, "")] = kinds.pop(name), rows.pop(name)
        return _Plain(f"{self.owner.name} Points", rows, is_there, kinds).made(edges, folder, times, per_frame)

    def _arranged(self, pause):
        """The samples with the same number of points in each: ({name: (n, points, size)}, (n, points) where a point is there, edges).

        pause: least number of samples between two points in one place.
        """
        counts = {len(one["position"]) for one in self._samples}
        names = self._samples[0].keys()
        if len(counts) == 1 and "id" not in names and _NO_ID not in names:
            rows = {name: np.stack([one[name] for one in self._samples]) for name in names}
            return rows, np.ones((len(self._samples), *counts), bool), []
        if _NO_ID in names:
            return _along_curves(self._samples)
        return (*_by_id(self._samples, pause), [])


def _rename_read(group):
    """Let the nodes that read attributes by their names read them by names without that of Motus."""
    for node in group.nodes:
        name = node.inputs.get("Name") if node.bl_idname == "GeometryNodeInputNamedAttribute" else None
        if name is not None:
            name.default_value = name.default_value.replace(OURS, "")


def own_attributes(mesh):
    """The attributes of a hub's mesh that its solver fills, besides positions."""
    return [
        one
        for one in mesh.attributes
        if one.domain == 'POINT' and one.data_type in _SIZES and one.name != "position" and not one.name.startswith(".")
    ]


def _of_attribute(attribute):
    name = {'FLOAT_VECTOR': "vector", 'FLOAT_COLOR': "color"}.get(attribute.data_type, "value")
    return _read(attribute.data, name, _SIZES[attribute.data_type], np.int32 if attribute.data_type == 'INT' else np.float32)


def _read(items, name, size, kind=None):
    found = np.empty(len(items) * size, kind or np.float32)
    items.foreach_get(name, found)
    return found.reshape(-1, size).astype(np.float32)


def _by_id(samples, pause):
    """Give each point a place for as long as it lives; a place that gets free is used again after a pause, in which it has no size.

    pause: least number of samples that a place stays free.

    Returns ({name: (n, places, size)}, (n, places) where a point is there).
    """
    first, last = {}, {}
    for index, sample in enumerate(samples):
        for one in sample["id"][:, 0].astype(int).tolist():
            first.setdefault(one, index)
            last[one] = index
    place_of, free, count = {}, [], 0
    for one in sorted(first, key=first.__getitem__):
        if free and free[0][0] <= first[one] - pause:
            place = heapq.heappop(free)[1]
        else:
            place, count = count, count + 1
        place_of[one] = place
        heapq.heappush(free, (last[one], place))
    rows = {name: np.zeros((len(samples), count, value.shape[1]), np.float32) for name, value in samples[0].items()}
    is_there = np.zeros((len(samples), count), bool)
    for index, sample in enumerate(samples):
        places = [place_of[one] for one in sample["id"][:, 0].astype(int).tolist()]
        is_there[index, places] = True
        for name, value in sample.items():
            rows[name][index, places] = value
    _fill_pauses(rows, is_there, pause)
    return rows, is_there


def _fill_pauses(rows, is_there, pause):
    """Continue points beyond their first and last sample, so that straight lines between samples lead on as the points move.

    Their radius is 0 there. rows: {name: (n, places, size)}, changed in place.
    """
    position = rows["position"]
    for way in (1, -1):  # after the last sample forwards, before the first one backwards
        there, place = is_there[::way], position[::way]
        speed = np.zeros_like(place[0])
        since = np.full(there.shape[1], pause)
        for index in range(1, len(there)):
            both = there[index] & there[index - 1]
            speed = np.where(both[:, None], place[index] - place[index - 1], speed)
            since = np.where(there[index], 0, since + 1)
            continued = (since > 0) & (since < pause // 2)
            for name, value in rows.items():
                turned = value[::way]
                if name == "position":
                    turned[index] = np.where(continued[:, None], turned[index - 1] + speed, turned[index])
                elif name != "radius":
                    turned[index] = np.where(continued[:, None], turned[index - 1], turned[index])


def _along_curves(samples):
    """Give each curve as many points as it has at most, and let those that it lacks lie on its last point.

    Returns ({name: (n, places, size)}, (n, places) where a point is there, edges (first, second) between places).
    """
    most = {}
    for sample in samples:
        for curve, count in zip(*np.unique(sample[_NO_ID][:, 0].astype(int), return_counts=True)):
            most[int(curve)] = max(most.get(int(curve), 0), int(count))
    starts, total = {}, 0
    for curve in sorted(most):
        starts[curve], total = total, total + most[curve]
    rows = {name: np.zeros((len(samples), total, value.shape[1]), np.float32) for name, value in samples[0].items()}
    is_there = np.zeros((len(samples), total), bool)
    for index, sample in enumerate(samples):
        of_curve = sample[_NO_ID][:, 0].astype(int)
        for curve, start in starts.items():
            found = np.flatnonzero(of_curve == curve)
            for name, value in sample.items():
                if len(found):
                    chosen = found[np.minimum(np.arange(most[curve]), len(found) - 1)]
                    rows[name][index, start : start + most[curve]] = value[chosen]
            rows[_NO_ID][index, start : start + most[curve]] = curve
            is_there[index, start : start + len(found)] = True
    edges = [(place, place + 1) for curve, start in starts.items() for place in range(start, start + most[curve] - 1)]
    return rows, is_there, edges


class _Plain:
    """The plain object that takes a hub's place. rows, is_there: as Points arranges them. kinds: {name of an attribute: its data type}."""

    def __init__(self, name, rows, is_there, kinds):
        self._name, self._rows, self._is_there, self._kinds = name, rows, is_there, kinds

    def made(self, edges, folder, times, per_frame):
        """Make the object with its caches; returns it. It is in no collection, as it only gives its points to the owner's modifier."""
        places = self._rows["position"]
        obj = _object(self._name, places.shape[1], edges)
        if places.size == 0:
            return obj
        if np.ptp(places, axis=0).max() == 0.0:
            obj.data.vertices.foreach_set("co", places[0].ravel())
        else:
            folder.add(obj, self._name, places, times, per_frame, self._is_there)
        changing = []
        for name, kind in self._kinds.items():
            values = _eulers(self._rows[name]) if kind == 'QUATERNION' else self._rows[name]
            if np.ptp(values, axis=0).max() == 0.0:
                store(obj.data, name, kind, values[0])
            else:
                changing.append((name, values))
        if changing:
            self._animate(obj, changing, folder, times, per_frame)
        return obj

    def _animate(self, obj, changing, folder, times, per_frame):
        """Let nodes store the attributes whose numbers change: three of these are the places of a vertex of a further object.

        changing: (name, (n, points, size) values) of each.
        """
        group = bpy.data.node_groups.new(f"{self._name} Attributes", 'GeometryNodeTree')
        node_groups.add_sockets(group, (("Geometry", 'INPUT', "NodeSocketGeometry"), ("Geometry", 'OUTPUT', "NodeSocketGeometry")))
        start, end = (node_groups.add_node(group, kind) for kind in ("NodeGroupInput", "NodeGroupOutput"))
        geometry = start.outputs["Geometry"]
        for name, values in changing:
            numbers = []
            for first in range(0, values.shape[2], 3):
                part = values[:, :, first : first + 3]
                samples = np.zeros((*part.shape[:2], 3), np.float32)
                samples[:, :, : part.shape[2]] = part
                source = _object(f"{self._name} {name}", samples.shape[1], [])
                # A size changes from and to 0 as points come and go, and the other numbers count only while a point is there.
                folder.add(source, source.name, samples, times, per_frame, None if name == "radius" else self._is_there)
                numbers += _sampled(group, source)[: part.shape[2]]
            geometry = _stored(group, geometry, name, self._kinds[name], numbers)
        group.links.new(geometry, end.inputs["Geometry"])
        obj.modifiers.new("Attributes", 'NODES').node_group = group


def _object(name, count, edges):
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(count)
    if edges:
        mesh.edges.add(len(edges))
        mesh.edges.foreach_set("vertices", np.array(edges, np.int32).ravel())
    return bpy.data.objects.new(name, mesh)


def store(mesh, name, kind, values):
    """Give a mesh an attribute of its points. kind: data type. values: (points, size)."""
    made = mesh.attributes.new(name, kind, 'POINT')
    if kind == 'INT':
        made.data.foreach_set("value", np.rint(values[:, 0]).astype(np.int32))
    else:
        made.data.foreach_set({'FLOAT_VECTOR': "vector", 'FLOAT_COLOR': "color"}.get(kind, "value"), values.astype(np.float32).ravel())


def _sampled(group, source):
    """Add the nodes that read the places of a source's vertices; returns the sockets of their three numbers."""
    info = node_groups.add_node(group, "GeometryNodeObjectInfo")
    info.inputs["Object"].default_value = source
    sample = node_groups.add_node(group, "GeometryNodeSampleIndex", data_type='FLOAT_VECTOR', domain='POINT')
    position, index = (node_groups.add_node(group, kind) for kind in ("GeometryNodeInputPosition", "GeometryNodeInputIndex"))
    parts = node_groups.add_node(group, "ShaderNodeSeparateXYZ")
    group.links.new(info.outputs["Geometry"], sample.inputs["Geometry"])
    group.links.new(position.outputs[0], node_groups.enabled(sample.inputs, "Value"))
    group.links.new(index.outputs[0], sample.inputs["Index"])
    group.links.new(node_groups.enabled(sample.outputs), parts.inputs[0])
    return list(parts.outputs)


def _stored(group, geometry, name, kind, numbers):
    """Add the nodes that store an attribute made of numbers; returns the geometry. kind: data type of the attribute."""
    store = node_groups.add_node(group, "GeometryNodeStoreNamedAttribute", data_type=kind, domain='POINT')
    store.inputs["Name"].default_value = name
    group.links.new(geometry, store.inputs["Geometry"])
    group.links.new(_joined(group, kind, numbers), node_groups.enabled(store.inputs, "Value"))
    return store.outputs["Geometry"]


def _joined(group, kind, numbers):
    if kind == 'FLOAT':
        return numbers[0]
    if kind == 'INT':
        node = node_groups.add_node(group, "FunctionNodeFloatToInt", rounding_mode='ROUND')
    elif kind == 'FLOAT_COLOR':
        node = node_groups.add_node(group, "FunctionNodeCombineColor")
    else:
        node = node_groups.add_node(group, "ShaderNodeCombineXYZ")
    for number, socket in zip(numbers, node.inputs):
        group.links.new(number, socket)
    if kind != 'QUATERNION':
        return node.outputs[0]
    turn = node_groups.add_node(group, "FunctionNodeEulerToRotation")
    group.links.new(node.outputs[0], turn.inputs[0])
    return turn.outputs[0]


def _eulers(quaternions):
    """Euler angles (n, places, 3) of quaternions (n, places, 4; w, x, y, z), without jumps from one sample to the next."""
    w, x, y, z = np.moveaxis(quaternions.astype(float), 2, 0)
    angles = (
        np.arctan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)),
        np.arcsin(np.clip(2.0 * (w * y - z * x), -1.0, 1.0)),
        np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)),
    )
    return np.unwrap(np.stack(angles, axis=2), axis=0).astype(np.float32)
