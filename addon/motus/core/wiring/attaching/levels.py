"""Find the order in which the entries of an owner's systems have to be solved, from what bones and objects depend on.

An entry is an item in an owner's list of settings; it reads some bones and objects, and drives others. The order follows from a graph
of nodes, each a tuple that names something that Blender evaluates (an object's transform, a bone, a geometry, the drivers of some
properties) or an entry. An entry depends on what it reads; a bone or object that an entry drives depends on that entry, whichever owner
has the entry. Parents, constraints, drivers and the modifiers that deform a geometry are followed through all objects.

The owner is the object whose settings are solved. A hub is a hidden object whose mesh carries the solver's driver and results; a sink
is a constraint that brings a result to a bone or object.
"""

import re

import bpy

from ...blender.poses import TO_BONE, bone_named
from ...declare import laid_beneath, of_owner, registered, systems
from ..hubs import marks, outbox
from ..sinks import proxy_sink
from . import waiting

TRANSFORM, BONE, POSE, GEOMETRY, DRIVERS, ENTRY = "transform", "bone", "pose", "geometry", "drivers", "entry"

_OWN_TRANSFORM = ("location", "rotation_", "scale", "delta_", "constraints[", "lock_")
_BONE_PATH = re.compile(rf"{TO_BONE}\.")
_EVALUATED = re.compile(rf"(?:matrix_world|matrix_local|{TO_BONE}\.(?:matrix|head|tail|length)\b)")
_CHANNEL = re.compile(rf"(?:{TO_BONE}\.)?(?:location|rotation_\w+|scale|delta_\w+)")
_ON_GEOMETRY = {'SHRINKWRAP', 'FOLLOW_PATH', 'CLAMP_TO', 'SPLINE_IK', 'GEOMETRY_ATTRIBUTE'}
_TARGETS = (
    ("target", "subtarget"),
    ("pole_target", "pole_subtarget"),
    ("space_object", "space_subtarget"),
    ("depth_object", ""),
    ("camera", ""),
)


def levels(owner):
    """Return {(name of the system, name of the entry): level} for all entries of an owner; entries of level 0 are solved first.

    An entry depends only on entries of lower levels, directly or through entries of different owners. The level is None if the entry
    depends on a bone or object that the entry itself drives.
    """
    graph = _Graph(owner)
    found = {}
    # The list is sorted: each component comes after the components on which it depends, whose depth is then known.
    depth = {}
    for component in _components(graph):
        entries = [node for node in component if node[0] == ENTRY]
        below = max((depth[other] for node in component for other in graph.depends_on(node) if other in depth), default=0)
        is_loop = bool(entries) and (len(component) > 1 or component[0] in graph.depends_on(component[0]))
        for node in component:
            depth[node] = below + (node[0] == ENTRY and not is_loop)
        for node in entries:
            found[node] = None if is_loop else below
    # The depth of an entry also counts the entries of different owners: otherwise the groups of two owners could wait for each other.
    # The depths of this owner's entries are then numbered without gaps.
    steps = sorted({found[node] for node in graph.roots()} - {None})  # type: ignore[type-var]
    return {node[2:]: None if found[node] is None else steps.index(found[node]) for node in graph.roots()}


def depends(obj, bone, rig, bones):
    """Whether an object, or one bone of the object, moves if some bones of a rig move.

    bone: name of the object's bone; "" for the object itself. bones: names of bones of the rig.
    """
    wanted = {(BONE, rig, name) for name in bones}
    return any(node in wanted for node in _all_from(_Graph(rig), _place(obj, bone)))


def hanging(rig, places):
    """Return {place: [the other places in `places` on which its transform depends]}.

    places: list of (object, name of a bone or ""). Dependencies through entries of the owner `rig` are included.
    """
    graph, found = _Graph(rig), {}
    nodes = {place: set(_place(*place)) for place in places}
    for place in places:
        below = set()
        for node in _all_from(graph, nodes[place]):
            below.add(node)
            if node[0] == DRIVERS and isinstance(node[1], bpy.types.Object):
                below.update(_of_channel(*node[1:]))
        found[place] = [other for other in places if other != place and not below.isdisjoint(nodes[other])]
    return found


def _all_from(graph, nodes):
    """Yield nodes of a dependency graph, and all nodes on which they depend directly or indirectly, each once.

    graph: a _Graph. nodes: tuples that name what Blender evaluates, such as (BONE, object, name of the bone).
    """
    seen, waiting = set(), list(nodes)
    while waiting:
        node = waiting.pop()
        if node not in seen:
            seen.add(node)
            yield node
            waiting += graph.depends_on(node)


def _of_channel(obj, path):
    """Yield (BONE, object, name) or (TRANSFORM, object) if a data path leads to a location, rotation or scale; else nothing.

    path: data path from the object `obj`, as of a driver.
    """
    match = _CHANNEL.match(path)
    if match:
        yield from _place(obj, bone_named(obj, match))


class _Graph:
    """Graph of the dependencies between transforms, bones, geometries, drivers and entries.

    A node is a tuple of its kind and of what identifies it, such as (TRANSFORM, object) or (BONE, object, name of the bone). The
    dependencies of a node are computed when they are first needed. owner: object whose entries are the roots of the graph.
    """

    def __init__(self, owner):
        self._owner = owner
        self._known = {}
        self._drivers = {}
        self._solved = {}
        self._slots = [outbox.slot_pattern(system) for system in _with_entries()]
        self._entries, self._entries_on, self._owners = {}, {}, set()
        self._add(owner)

    def _add(self, owner):
        """Add to the graph an owner's entries, and which bones and objects they drive, unless the owner was added before.

        An entry is an item in an owner's list of settings.
        """
        if owner in self._owners:
            return
        self._owners.add(owner)
        for system in _with_entries():
            for entry in system.entries(owner):
                place = ENTRY, owner, system.name, entry.name
                self._entries[place] = entry
                for thing in entry.drives:
                    node = (BONE, owner, thing) if isinstance(thing, str) else (TRANSFORM, thing)
                    self._entries_on.setdefault(node, []).append(place)

    def roots(self):
        """Return the nodes of the owner's entries (items in its lists of settings), from which the dependency graph is searched."""
        return [node for node in self._entries if node[1] == self._owner]

    def depends_on(self, node):
        """Return the nodes on which a node of the dependency graph depends directly, as a list of tuples such as (BONE, object, name)."""
        if node not in self._known:
            self._known[node] = list(dict.fromkeys(getattr(self, "_of_" + node[0])(*node[1:])))
        return self._known[node]

    def _of_entry(self, owner, system, name):
        entry = self._entries[ENTRY, owner, system, name]
        for obj, bone in entry.reads:
            yield from _place(obj, bone)
        for obj in waiting.geometries(registered[system], of_owner(registered[system], owner)):
            yield GEOMETRY, obj
        # The solver reads a driven bone's own transform, which comes after the bone's own drivers.
        for bone in [thing for thing in entry.drives if isinstance(thing, str)]:
            for path, driver in self._of_bone_paths(owner, bone):
                if ".constraints[" not in path:
                    yield from _read_by(driver)
        # In Blender's dependency graph all plain settings of an object are one node.
        yield DRIVERS, owner, "motus."
        if any(isinstance(thing, str) for thing in entry.drives):
            beneath = [one.name for one in laid_beneath(registered[system])]
            yield from (place for place in self._entries if place[1] == owner and place[2] in beneath)

    def _of_transform(self, obj):
        yield from self._of_parent(obj)
        for constraint in obj.constraints:
            if not self._is_sink(obj, constraint):
                yield from _targets(constraint)
        for path, driver in self._all_drivers(obj):
            if path.startswith(_OWN_TRANSFORM) and not self._is_of_sink(obj, path, driver):
                yield from _read_by(driver)
        yield from self._entries_on.get((TRANSFORM, obj), ())

    @staticmethod
    def _of_parent(obj):
        if obj.parent is None:
            return
        if obj.parent_type == 'BONE':
            yield from _place(obj.parent, obj.parent_bone)
        elif obj.parent_type in {'VERTEX', 'VERTEX_3'}:
            yield GEOMETRY, obj.parent
        yield TRANSFORM, obj.parent

    def _of_bone(self, obj, name):
        bone = obj.pose.bones[name]
        yield TRANSFORM, obj
        if bone.parent:
            yield BONE, obj, bone.parent.name
        for constraint in bone.constraints:
            if not self._is_sink(obj, constraint):
                yield from _targets(constraint)
        for path, driver in self._of_bone_paths(obj, name):
            if not self._is_of_sink(obj, path, driver):
                yield from _read_by(driver)
        for constraint in self._solved_by(obj).get(name, ()):
            yield from _targets(constraint)
        yield from self._entries_on.get((BONE, obj, name), ())

    @staticmethod
    def _of_pose(obj):
        for bone in obj.pose.bones:
            yield BONE, obj, bone.name

    def _of_geometry(self, obj):
        yield TRANSFORM, obj
        if obj.parent and obj.parent_type in {'ARMATURE', 'LATTICE', 'CURVE'}:
            yield from _deforming(obj.parent)
        for modifier in obj.modifiers:
            for prop in modifier.bl_rna.properties:
                if prop.type == 'POINTER' and prop.fixed_type.identifier == "Object":
                    deforming = getattr(modifier, prop.identifier)
                    yield from _deforming(deforming) if deforming else ()
            if getattr(modifier, "subtarget", "") and modifier.object:
                yield from _place(modifier.object, modifier.subtarget)
        for block in (obj.data, getattr(obj.data, "shape_keys", None)):
            if block:
                yield DRIVERS, block, ""

    def _of_drivers(self, block, prefix):
        for path, driver in self._all_drivers(block):
            if path.startswith(prefix):
                yield from _read_by(driver)

    def _all_drivers(self, block):
        """Return the list of (data path, driver) for all drivers of a datablock."""
        if block not in self._drivers:
            animation = getattr(block, "animation_data", None)
            self._drivers[block] = [(curve.data_path, curve.driver) for curve in animation.drivers] if animation else []
        return self._drivers[block]

    def _of_bone_paths(self, obj, name):
        key = obj, BONE
        if key not in self._drivers:
            by_bone = self._drivers[key] = {}
            for path, driver in self._all_drivers(obj):
                bone = bone_named(obj, _BONE_PATH.match(path))
                if bone:
                    by_bone.setdefault(bone, []).append((path, driver))
        return self._drivers[key].get(name, ())

    def _solved_by(self, obj):
        """Return {name of a bone: [IK and Spline IK constraints that turn the bone as part of their chain]} for an armature object.

        The constraints are on the bone itself or on its descendants.
        """
        if obj not in self._solved:
            turned = self._solved[obj] = {}
            for bone in obj.pose.bones:
                for constraint in bone.constraints:
                    if constraint.type in {'IK', 'SPLINE_IK'}:
                        chain = ([bone] if getattr(constraint, "use_tail", True) else []) + bone.parent_recursive
                        for one in chain[: constraint.chain_count or None]:
                            turned.setdefault(one.name, []).append(constraint)
        return self._solved[obj]

    def _is_sink(self, obj, constraint):
        """Whether a constraint of an object, or of its bone, is a sink: a constraint that applies a solver's result.

        The targets of a sink are hidden objects, so they are not followed. What a sink depends on is taken from the entry whose result it
        applies.
        """
        found = (marks.read(system, constraint) for system in _with_entries())
        if any(self._has_entries(mesh) for mesh, _ in filter(None, found)):
            return True
        proxy = proxy_sink.proxy_of(constraint) if obj == self._owner else None
        return proxy is not None and proxy[marks.PROXY_KEY] == obj

    def _is_of_sink(self, obj, path, driver):
        """Whether a driver on an object belongs to the wiring, because it reads a solver's result from an outbox.

        path: data path of the driven property. On the owner itself the property can be any. On a different object the driver must be on a
        constraint.
        """
        targets = [
            target
            for variable in driver.variables
            for target in variable.targets
            if any(pattern.match(target.data_path) for pattern in self._slots)
        ]
        if obj == self._owner:
            return len(targets) > 0
        return "constraints[" in path and any(target.id and self._has_entries(target.id) for target in targets)

    def _has_entries(self, hub):
        """Whether a hub, given by its mesh, has an owner with Motus settings; if so, add that owner's entries to the graph."""
        owner = hub.get(outbox.OWNER_KEY)
        if not isinstance(owner, bpy.types.Object) or not owner.is_property_set("motus"):
            return False
        self._add(owner)
        return True


def _with_entries():
    return [system for system in systems() if system.entries]


def _place(obj, bone):
    """Yield the node (BONE, object, name) of a bone; if `bone` is "" or no bone of the object, the node (TRANSFORM, object)."""
    if bone and obj.pose and bone in obj.pose.bones:
        yield BONE, obj, bone
    else:
        yield TRANSFORM, obj


def _deforming(obj):
    """Yield the nodes on which a geometry depends if the object `obj` deforms the geometry.

    These are (TRANSFORM, obj), and (POSE, obj) for an armature or (GEOMETRY, obj) for an object with points.
    """
    yield TRANSFORM, obj
    if obj.type == 'ARMATURE':
        yield POSE, obj
    elif obj.type in {'MESH', 'CURVE', 'SURFACE', 'LATTICE'}:
        yield GEOMETRY, obj


def _targets(constraint):
    """Yield the targets of a constraint as nodes of the dependency graph.

    A node is (BONE, object, name of the bone), (TRANSFORM, object) or (GEOMETRY, object).
    """
    for target in getattr(constraint, "targets", ()):
        if target.target:
            yield from _place(target.target, target.subtarget)
    for name, sub in _TARGETS:
        target = getattr(constraint, name, None)
        if not isinstance(target, bpy.types.Object):
            continue
        bone = getattr(constraint, sub, "") if sub else ""
        yield from _place(target, bone)
        if target.type != 'ARMATURE' and (bone or constraint.type in _ON_GEOMETRY):
            yield GEOMETRY, target


def _read_by(driver):
    """Yield what a driver reads, as nodes of the dependency graph.

    A node is (BONE, object, name of the bone), (TRANSFORM, object), or (DRIVERS, datablock, data path without array index).
    """
    for variable in driver.variables:
        for target in variable.targets:
            if target.id is None:
                continue
            if variable.type != 'SINGLE_PROP':
                yield from _place(target.id, target.bone_target)
                continue
            evaluated = _EVALUATED.match(target.data_path) if isinstance(target.id, bpy.types.Object) else None
            if evaluated:
                yield from _place(target.id, bone_named(target.id, evaluated))
            elif target.data_path:
                yield DRIVERS, target.id, re.sub(r"\[\d+\]$", "", target.data_path)


def _components(graph):
    """Return the strongly connected components of a dependency graph, as lists of nodes that all depend on each other.

    Each component comes after the components on which it depends. The algorithm is Tarjan's, without recursion.
    """
    places, low, on_stack, stack, found = {}, {}, set(), [], []
    for root in graph.roots():
        if root in places:
            continue
        work = [(root, iter(graph.depends_on(root)))]
        places[root] = low[root] = len(places)
        stack.append(root)
        on_stack.add(root)
        while work:
            node, others = work[-1]
            for other in others:
                if other not in places:
                    places[other] = low[other] = len(places)
                    stack.append(other)
                    on_stack.add(other)
                    work.append((other, iter(graph.depends_on(other))))
                    break
                if other in on_stack:
                    low[node] = min(low[node], places[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == places[node]:
                    component = [stack.pop()]
                    while component[-1] != node:
                        component.append(stack.pop())
                    on_stack.difference_update(component)
                    found.append(component)
    return found
