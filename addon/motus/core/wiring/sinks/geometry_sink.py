"""The sink of systems that move or make points: a Geometry Nodes modifier of the owner that brings in what the hub holds.

The hub's mesh is empty in the file. The solver gives the *evaluated* one points and attributes, of which moved_points and
made_points say what they are, and what the nodes do with them. Without the add-on there are none, and the owner stands as
it is. In Edit Mode, where the points of a mesh come and go before the solver hears of it, the modifier is switched off.
"""

import bpy

from ...blender import capabilities, node_groups
from ..hubs import hub_lookup
from . import made_points, moved_points

KEY = "motus_system"
"""Custom property of the node group: name of the system whose sinks have it."""
HUB = "Hub"


def prepare(system, mesh, settings):
    """Give a hub's mesh the attributes that the solver fills for an owner with these settings."""
    _kind(system).prepare(system, mesh, settings)


def add(system, owner, hub):
    """Let the owner's points be moved by what the hub holds, by the modifier that is there already or a new one."""
    found = modifier(system, owner)
    if found is not None:
        if _form_of(system, found.node_group) is None:
            found.node_group = _node_group(system)
        node_groups.set_input(found, HUB, hub)
        return
    active = getattr(owner.modifiers, "active", None)
    found = owner.modifiers.new(f"Motus {system.label}", 'NODES')
    if found is None:
        return  # objects of its type have no modifiers: what it holds came with a copy from another one
    found.node_group = _node_group(system)
    found.show_in_editmode = found.show_on_cage = found.show_expanded = False
    # Before it is moved: where that is done by an operator, Blender evaluates, and takes no notice of the hub later.
    node_groups.set_input(found, HUB, hub)
    if _kind(system).IS_FIRST:
        _move_first(owner, found)
    if active:
        owner.modifiers.active = active  # the user's, which stays so


def modifier(system, owner):
    """The owner's sink of the system; None where it has none."""
    return next((one for one in owner.modifiers if _is_sink(system, one)), None)


def points_place(system, owner):
    """Place of the sink in the owner's stack of modifiers; None where it has none."""
    return next((index for index, one in enumerate(owner.modifiers) if _is_sink(system, one)), None)


def remove(system, owner):
    """Take the sink away, and what it was made of where nobody else needs that."""
    for found in [one for one in owner.modifiers if _is_sink(system, one)]:
        group = found.node_group
        node_groups.let_go(found)
        owner.modifiers.remove(found)
        _drop_unused(group)


def is_stale(system, owner):
    """Whether the hub waits for another mesh than the owner has now."""
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
    """Whether the owner's Geometry Nodes modifier reads a hub object that is not the owner's own.

    In Blender 5.2 a library override loses the input of a modifier whose node group it replaces.
    """
    found = modifier(system, owner)
    return (
        found is not None
        and _form_of(system, found.node_group) is not None
        and (node_groups.input_of(found, HUB) != hub_lookup.hub_of(system, owner))
    )


def room(system, carrier, inputs, context):
    """What the solver fills, in the context too. Its write(weight) lets the evaluated hub hold that."""
    return _kind(system).Room(system, carrier, inputs, context)


def write_nothing(system, carrier):
    """Let the owner be what it is by itself."""
    _kind(system).write_nothing(system, carrier)


def set_points_material(system, owner, material):
    """Give the points that the system makes on an owner, or what their shape is, a material."""
    _set_form(system, owner, made_points.MATERIAL, material)


def set_points_object(system, owner, instanced):
    """Let the owner have an instance of an object on each point, scaled by its radius and turned by its quaternion."""
    _set_form(system, owner, made_points.OBJECT, instanced)


def set_points_collection(system, owner, instanced):
    """Let the owner have an instance of an object of a collection on each point, which chooses one by its id."""
    _set_form(system, owner, made_points.COLLECTION, instanced)


def _set_form(system, owner, form, value):
    found = modifier(system, owner)
    if found is None:
        return  # somebody has removed it
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
    return moved_points if system.moves_points else made_points


def _is_sink(system, one):
    return one.type == 'NODES' and one.node_group is not None and one.node_group.get(KEY) == system.name


def _move_first(owner, found):
    if len(owner.modifiers) == 1:
        return  # in 3.4 the operator refuses overrides
    if capabilities.has_modifier_order():
        owner.modifiers.move(len(owner.modifiers) - 1, 0)
        return
    with bpy.context.temp_override(object=owner, active_object=owner):
        bpy.ops.object.modifier_move_to_index(modifier=found.name, index=0)


def _form_of(system, group):
    """Variant of the system's node group to which `group` belongs, told by its input sockets; None if sockets were removed."""
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
    """The node group of all the system's sinks of a form in this file; without one of the first."""
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
