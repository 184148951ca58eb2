"""Geometry Nodes modifiers as sinks, for systems that move or make points: the modifier brings in the geometry of the hub's mesh.

The hub is a hidden object; its mesh has no points in the file. The solver adds points and attributes to the *evaluated* mesh.
moved_points.py and made_points.py define these attributes and the nodes that use them. Without the add-on there are no points, and the
owner has its own shape. The modifier is off in Edit Mode, where points are added and removed before the solver is told.

The owner is the object whose settings are solved, and whose geometry the modifier changes.
"""

import bpy

from ...blender import datablocks, node_groups
from ..hubs import hub_lookup, traits
from . import made_points, moved_points

KEY = "motus_system"
"""Custom property of the modifier's node group: name of the system whose sinks use the group."""
HUB = "Hub"


def prepare(system, mesh, settings):
    """Add to a hub's mesh the attributes that the solver fills. settings: the owner's settings, which say what attributes are needed."""
    _kind(system).prepare(system, mesh, settings)


def add(system, owner, hub):
    """Give the owner a modifier that brings in the geometry of a hub; if the owner has the modifier, make it read this hub."""
    found = modifier(system, owner)
    if found is not None:
        if _form_of(system, found.node_group) is None:
            found.node_group = _node_group(system)
        node_groups.set_input(found, HUB, hub)
        return
    active = getattr(owner.modifiers, "active", None)
    found = owner.modifiers.new(f"Motus {system.label}", 'NODES')
    if found is None:
        return  # objects of this type have no modifiers: the settings were copied from an object of a different type
    found.node_group = _node_group(system)
    found.show_in_editmode = found.show_on_cage = found.show_expanded = False
    # The input is set before the modifier is moved: if an operator moves it, Blender evaluates at once and later ignores a new hub.
    node_groups.set_input(found, HUB, hub)
    if _kind(system).IS_FIRST:
        datablocks.move_modifier(owner, found, 0)
    if active:
        owner.modifiers.active = active  # the modifier that the user has made active stays active


def modifier(system, owner):
    """Return the owner's modifier that is the sink of the system; None if there is none."""
    return next((one for one in owner.modifiers if _is_sink(system, one)), None)


def points_place(system, owner):
    """Return the index, in the owner's modifier stack, of the modifier by which the system makes or moves points; None if there is none."""
    return next((index for index, one in enumerate(owner.modifiers) if _is_sink(system, one)), None)


def remove(system, owner):
    """Remove the system's modifiers from the owner, and the modifiers' node groups if nothing else uses the node groups."""
    for found in [one for one in owner.modifiers if _is_sink(system, one)]:
        group = found.node_group
        node_groups.let_go(found)
        owner.modifiers.remove(found)
        _drop_unused(group)


def is_stale(system, owner):
    """Whether the owner has been given a different mesh datablock since its solver's driver, which reads that mesh, was made."""
    hub = hub_lookup.hub_of(system, owner)
    if hub is None or not hub.data.animation_data or owner.type != 'MESH':
        return False
    targets = [
        target
        for curve in hub.data.animation_data.drivers
        for variable in curve.driver.variables
        for target in variable.targets
        if target.id_type == 'MESH'
    ]
    return any(target.id != owner.data for target in targets)


def is_cut_off(system, owner):
    """Whether the owner has a modifier as sink that does not read the owner's hub.

    In Blender 5.2 a library override loses the input of a modifier whose node group it replaces. The result is False if sockets of the node
    group were removed.
    """
    found = modifier(system, owner)
    return (
        found is not None
        and _form_of(system, found.node_group) is not None
        and (node_groups.input_of(found, HUB) != hub_lookup.hub_of(system, owner))
    )


def room(system, carrier, inputs, context):
    """Return a Room for one call of the solver: it holds the arrays for points that solve() gets through its argument `context`.

    write(weight) of the Room then stores the results in the evaluated hub's mesh (carrier). inputs: {name: value} of the system's inputs.
    context: Context of this call.
    """
    return _kind(system).Room(system, carrier, inputs, context)


def write_nothing(system, carrier):
    """Make the evaluated hub's mesh (carrier) hold no points and no motion of points, so that the owner has its own shape."""
    _kind(system).write_nothing(system, carrier)


def set_points_material(system, owner, material):
    """Set the material of the points that a system makes on an owner, or of the curves, tubes or faces made of these points."""
    _set_form(system, owner, made_points.MATERIAL, material)


def set_points_object(system, owner, instanced):
    """Put an instance of an object on each point that a system makes on an owner.

    The instance is scaled by the point's radius and rotated by its quaternion.
    """
    _set_form(system, owner, made_points.OBJECT, instanced)


def set_points_collection(system, owner, instanced):
    """Put an instance of an object of a collection on each point that a system makes on an owner.

    The point's id determines which object of the collection is instanced.
    """
    _set_form(system, owner, made_points.COLLECTION, instanced)


def _set_form(system, owner, form, value):
    found = modifier(system, owner)
    if found is None:
        return  # the modifier was removed
    group = found.node_group
    if _form_of(system, group) != form:
        node_groups.let_go(found)
        found.node_group = _node_group(system, form)
        node_groups.set_input(found, HUB, hub_lookup.hub_of(system, owner))
        _drop_unused(group)
    node_groups.set_input(found, form, value)


def _drop_unused(group):
    if group.users == 0:
        bpy.data.node_groups.remove(group)


def _kind(system):
    return moved_points if traits.moves_points(system) else made_points


def _is_sink(system, one):
    return one.type == 'NODES' and one.node_group is not None and one.node_group.get(KEY) == system.name


def _form_of(system, group):
    """Return the variant, a key of FORMS, of the system's node group `group`; None if input sockets were removed from the group.

    The variants differ in their input sockets.
    """
    return next(
        (
            form
            for form in _kind(system).FORMS
            if node_groups.has_inputs(group, {name for name, way, _ in _sockets(system, form) if way == 'INPUT'})
        ),
        None,
    )


def _sockets(system, form):
    return (
        ("Geometry", 'INPUT', "NodeSocketGeometry"),
        (HUB, 'INPUT', "NodeSocketObject"),
        *_kind(system).FORMS[form],
        ("Geometry", 'OUTPUT', "NodeSocketGeometry"),
    )


def _node_group(system, form=None):
    """Return the node group for all sinks of a system in this file; the node group is created if the file has none.

    form: variant of the node group, a key of FORMS; None for the first variant.
    """
    first = next(iter(_kind(system).FORMS))
    form = first if form is None else form
    for group in bpy.data.node_groups:
        if group.get(KEY) == system.name and group.library is None and _form_of(system, group) == form:
            return group
    name = f"Motus {system.label}" if form == first else f"Motus {system.label} {form}"
    group = bpy.data.node_groups.new(name, 'GeometryNodeTree')
    group[KEY] = system.name
    node_groups.add_sockets(group, _sockets(system, form))
    start, end = (node_groups.add_node(group, kind) for kind in ("NodeGroupInput", "NodeGroupOutput"))
    group.links.new(_kind(system).add_nodes(system, group, start, form), end.inputs["Geometry"])
    end.location.x = 200.0 * len(group.nodes)
    return group
