"""A system on bones, for the tests of groups, levels, relative sinks and guards: chains that bend towards a target.

Every bone of a chain turns about its own X axis, on top of its animation, by an angle that depends on all that an entry may
read: the target, the pose of the bone that the chain hangs on, and the chain's own animation. With stretch the bones grow
along Y, and the children of the chain (the guards) keep the scale that they would have without it.
"""

import bpy
from mathutils import Matrix, Quaternion

import support
import toy_system

core = support.addon("core.declare")
settings = support.addon("core.settings")
dependencies = support.addon("core.wiring.attaching.levels")

solve_calls = 0
"""How often solve() was called."""

EDITED = core.Problem("The bones are others than those that were wired")
NOBODY = core.Problem("No chain has a target")
LOOSE = core.Problem("A chain has no target", blocking=False)


class MOTUS_PG_bend_entry(bpy.types.PropertyGroup):
    """`name` is the first bone's."""

    length: bpy.props.IntProperty(default=2)
    target: bpy.props.PointerProperty(type=bpy.types.Object, update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})
    target_bone: bpy.props.StringProperty(update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})
    weight: bpy.props.FloatProperty(default=1.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    stretch: bpy.props.FloatProperty(update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})


class MOTUS_PG_bend(settings.SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(default=1.0, min=0.0, max=1.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    entries: bpy.props.CollectionProperty(type=MOTUS_PG_bend_entry, override={'LIBRARY_OVERRIDABLE', 'USE_INSERTION'})


class MOTUS_PG_nod(settings.SystemSettings, bpy.types.PropertyGroup):
    """The same for a second system on the same rigs."""

    influence: bpy.props.FloatProperty(default=1.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    entries: bpy.props.CollectionProperty(type=MOTUS_PG_bend_entry, override={'LIBRARY_OVERRIDABLE', 'USE_INSERTION'})


def angle(target, parent, basis, weight):
    """By how much the bones of a chain turn. target: world matrix. parent: pose matrix. basis: the first bone's."""
    own = basis.to_euler().x
    return weight * (0.3 * target.translation.x + 0.2 * parent.to_euler().z + 0.5 * own + 0.1)


def chain_of(rig, entry):
    """Bones of a chain, from the first one on along the first children."""
    bone = rig.data.bones.get(entry.name)
    found = []
    while bone and len(found) < entry.length:
        found.append(bone)
        bone = bone.children[0] if bone.children else None
    return found


def guards_of(chain):
    """Children of the chain that are not in it."""
    return [child for bone in chain for child in bone.children if child not in chain]


def own_pose(rig, bone, parent):
    """Pose matrix of an evaluated rig's bone by its animation, where its parent's is `parent`."""
    rest = bone.matrix_local if bone.parent is None else bone.parent.matrix_local.inverted() @ bone.matrix_local
    return parent @ rest @ rig.pose.bones[bone.name].matrix_basis


def bent(rig, entry, influence):
    """(turn, growth, {guard: pose matrix}) of an entry of an evaluated rig; None without a target."""
    chain = chain_of(rig, entry)
    target = entry.target
    if target is None or not chain:
        return None
    matrix = target.matrix_world
    if entry.target_bone:
        matrix = matrix @ target.pose.bones[entry.target_bone].matrix
    parent = chain[0].parent
    above = rig.pose.bones[parent.name].matrix if parent else Matrix()
    turn = angle(matrix, above, rig.pose.bones[chain[0].name].matrix_basis, entry.weight * influence)
    rotation = Quaternion((1.0, 0.0, 0.0), turn)
    guards = {}
    for bone in chain:
        above = own_pose(rig, bone, above) @ rotation.to_matrix().to_4x4()
        guards.update((child.name, own_pose(rig, child, above)) for child in bone.children if child not in chain)
    return rotation, 1.0 + entry.stretch * abs(turn), guards


def _solve(context, name):
    global solve_calls
    solve_calls += 1
    rig = context.owner
    settings = context.settings
    found = [settings.entries[index] for index in context.data["entries"]]
    row, guard_row = 0, sum(context.data["lengths"])
    if context.data["bones"] != "\n".join(rig.data.bones.keys()):
        return EDITED
    missing = 0
    for place, (entry, length) in enumerate(zip(found, context.data["lengths"])):
        result = bent(rig, entry, settings.influence)
        missing += result is None
        rotation, growth, guards = result or (Quaternion(), 1.0, {})
        context.rotations[row : row + length] = rotation
        context.scales[row : row + length, 1] = growth
        context.outputs[place] = rotation.angle
        row += length
        for matrix in guards.values() if entry.stretch else ():
            context.rotations[guard_row], context.scales[guard_row] = matrix.to_quaternion(), matrix.to_scale()
            guard_row += 1
    assert context.data["system"] == name
    return NOBODY if missing == len(found) else LOOSE if missing else core.OK


def _entries(owner, name):
    found = []
    for entry in getattr(owner.motus, name).entries:
        chain = chain_of(owner, entry)
        if chain:
            reads = [(owner, chain[0].parent.name)] if chain[0].parent else []
            reads += [(entry.target, entry.target_bone)] if entry.target else []
            driven = chain + (guards_of(chain) if entry.stretch else [])
            found.append(core.Entry(entry.name, tuple(reads), tuple(bone.name for bone in driven)))
    return found


def _groups(owner, name):
    levels = dependencies.levels(owner)
    by_level = {}
    for index, entry in enumerate(getattr(owner.motus, name).entries):
        level = levels.get((name, entry.name))
        if level is not None:
            by_level.setdefault(level, []).append((index, entry))
    return tuple(_group(owner, name, level, found) for level, found in sorted(by_level.items()))


def _group(owner, name, level, found):
    bones = owner.pose.bones
    chains = [(entry, chain_of(owner, entry)) for _, entry in found]
    on_chains = [
        core.Member(bones[bone.name], frozenset({"rotation", "scale"} if entry.stretch else {"rotation"}), 'LOCAL', is_relative=True)
        for entry, chain in chains
        for bone in chain
    ]
    guards = [bone for entry, chain in chains for bone in (guards_of(chain) if entry.stretch else ())]
    reads = [read for entry in _entries(owner, name) if entry.name in [one.name for one, _ in chains] for read in entry.reads]
    return core.Group(
        key=str(level) if level else "",
        members=(*on_chains, *(core.Member(bones[bone.name], frozenset({"rotation", "scale"}), 'POSE') for bone in guards)),
        inputs=(
            *(core.Transform(*read) for read in reads),
            *(core.BonesOwn(owner, bone.name) for _, chain in chains for bone in (*chain, *guards)),
        ),
        outputs=tuple(f"{entry.name}.angle" for entry, _ in chains),
        data={
            "entries": [index for index, _ in found],
            "lengths": [len(chain) for _, chain in chains],
            "system": name,
            "bones": "\n".join(owner.data.bones.keys()),
        },
    )


def _renamed(owner, name, old, new):
    for entry in getattr(owner.motus, name).entries:
        if entry.name == old:
            entry.name = new


def _system(name, settings, classes):
    return core.System(
        name=name,
        label=name.title(),
        settings=settings,
        classes=classes,
        solve=lambda context: _solve(context, name),
        problems=(NOBODY, LOOSE, EDITED),
        groups=lambda owner: _groups(owner, name),
        entries=lambda owner: _entries(owner, name),
        bone_renamed=lambda owner, rig, old, new: _renamed(owner, name, old, new),
    )


SYSTEM = _system("bend", MOTUS_PG_bend, (MOTUS_PG_bend_entry, MOTUS_PG_bend))
NOD = _system("nod", MOTUS_PG_nod, (MOTUS_PG_nod,))


def register():
    """Register the add-on once more, with these systems in its list."""
    support.register_systems(SYSTEM, NOD)


def unregister():
    """Leave the add-on as it was installed."""
    support.unregister_systems(SYSTEM, NOD)


def new_rig(name="Rig", chains=2, length=2):
    """An armature: a root, and chains "A.0", "A.1", ..., "B.0", ...

    on it, each bone connected but the first, each chain with a child "A.end" of its last bone and a child "A.side" of its
    first.
    """
    rig = toy_system.new_object(name, data=bpy.data.armatures.new(name))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    root = rig.data.edit_bones.new("root")
    root.head, root.tail, root.roll = (0.0, 0.0, 0.0), (0.0, 0.3, 0.4), 0.2
    for chain in range(chains):
        parent = root
        for index in range(length):
            bone = rig.data.edit_bones.new(f"{chain_name(chain)}.{index}")
            bone.head = parent.tail if index else (0.5 * chain, 0.2, 0.1)
            bone.tail = (0.5 * chain + 0.1 * index, 0.3, 0.8 * (index + 1))
            bone.roll, bone.parent, bone.use_connect = 0.3 * (index + chain), parent, index > 0
            parent = bone
        for part, above in (("end", parent), ("side", rig.data.edit_bones[f"{chain_name(chain)}.0"])):
            bone = rig.data.edit_bones.new(f"{chain_name(chain)}.{part}")
            bone.head, bone.tail, bone.parent = above.tail, (bone.head.x, bone.head.y + 0.3, bone.head.z), above
    bpy.ops.object.mode_set(mode='OBJECT')
    return rig


def chain_name(chain):
    """Name of a chain: "A", "B", ..., "A1", ..."""
    return chr(ord("A") + chain % 26) + (str(chain // 26) if chain >= 26 else "")


def bend(rig, targets, system=SYSTEM, **settings):
    """Attach a system with one entry a chain; targets: first bone -> object or (object, bone)."""
    group = getattr(rig.motus, system.name)
    for name, target in targets.items():
        entry = group.entries.add()
        entry.name = name
        for key, value in settings.items():
            setattr(entry, key, value)
        entry.target, entry.target_bone = target if isinstance(target, tuple) else (target, "")
    support.addon("core.wiring").attach(system, rig)
    return group


def animate(rig):
    """Keys on all bones: rotations in several modes, and moves."""
    modes = ('XYZ', 'QUATERNION', 'ZYX')
    for index, bone in enumerate(rig.pose.bones):
        bone.rotation_mode = modes[index % 3]
        for frame, factor in ((1, 0.2), (60, -0.4)):
            turn = Quaternion((0.5, 1.0, 0.3 * index), factor + 0.1 * index)
            path = "rotation_quaternion" if bone.rotation_mode == 'QUATERNION' else "rotation_euler"
            setattr(bone, path, turn if path == "rotation_quaternion" else turn.to_euler(bone.rotation_mode))
            bone.keyframe_insert(path, frame=frame)
            bone.location = (0.1 * factor, 0.0, 0.2 * factor)
            bone.keyframe_insert("location", frame=frame)
    return rig


def expected(rig, systems=(SYSTEM,)):
    """Pose matrices of all bones by name, at the present frame, from the evaluated channels and targets alone."""
    evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    turned, kept = {}, {}
    for system in systems:
        settings = getattr(evaluated.motus, system.name)
        for entry in settings.entries:
            result = bent(evaluated, entry, settings.influence)
            for bone in chain_of(evaluated, entry) if result else ():
                turned[bone.name] = result[:2]
            if result and entry.stretch:
                kept.update(result[2])
    poses = {}
    for bone in evaluated.data.bones:  # parents come before children
        pose = own_pose(evaluated, bone, poses[bone.parent.name] if bone.parent else Matrix())
        if bone.name in turned:
            rotation, growth = turned[bone.name]
            pose = pose @ rotation.to_matrix().to_4x4() @ Matrix.Diagonal((1.0, growth, 1.0, 1.0))
        if bone.name in kept:
            location, pose = pose.translation, kept[bone.name].copy()
            pose.translation = location
        poses[bone.name] = pose
    return poses
