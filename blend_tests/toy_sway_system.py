"""A system on objects and bones, for the tests of relative locations and of levels of objects: things that sway with others.

Each entry moves, turns and scales one thing on top of its own animation, by where the entry's target is.
"""

import bpy
from mathutils import Matrix, Quaternion, Vector

import support

core = support.addon("core.declare")
settings = support.addon("core.settings")
dependencies = support.addon("core.wiring.attaching.levels")
NO_TARGET = core.Problem("Nothing to sway with")


class MOTUS_PG_sway_entry(bpy.types.PropertyGroup):
    """What is driven: `thing`, the owner without one, or a bone of it."""

    thing: bpy.props.PointerProperty(type=bpy.types.Object, update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})
    bone: bpy.props.StringProperty(update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})
    target: bpy.props.PointerProperty(type=bpy.types.Object, update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})


class MOTUS_PG_sway(settings.SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(default=1.0, min=0.0, max=1.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    entries: bpy.props.CollectionProperty(type=MOTUS_PG_sway_entry, override={'LIBRARY_OVERRIDABLE', 'USE_INSERTION'})


def offset(target, influence):
    """(move, turn, factors) for a target's world matrix."""
    x, y, z = target.translation * influence
    return Vector((0.1 * x, 0.2 * y, 0.3 * z)), Quaternion((0.6, 0.0, 0.8), 0.2 * x + 0.1 * y), Vector((1.0, 1.0 + 0.1 * y * y, 1.0))


def on_top(basis, move, turn, factors):
    """The matrix of channels that are changed one by one."""
    location, rotation, scale = basis.decompose()
    return Matrix.LocRotScale(location + move, rotation @ turn, scale * factors)


def solve(context):
    for row, index in enumerate(context.data["entries"]):
        target = context.settings.entries[index].target
        if target is None:
            return NO_TARGET
        context.locations[row], context.rotations[row], context.scales[row] = offset(target.matrix_world, context.settings.influence)
    return core.OK


def driven(owner, entry):
    """The Object or PoseBone of an entry."""
    thing = entry.thing or owner
    return thing.pose.bones[entry.bone] if entry.bone else thing


def _entries(owner):
    return [
        core.Entry(str(index), ((entry.target, ""),) if entry.target else (), (entry.bone or entry.thing or owner,))
        for index, entry in enumerate(owner.motus.sway.entries)
    ]


def _groups(owner):
    by_level = {}
    levels = dependencies.levels(owner)
    for index, entry in enumerate(owner.motus.sway.entries):
        by_level.setdefault(levels["sway", str(index)], []).append((index, entry))
    by_level.pop(None, None)
    channels = frozenset({"location", "rotation", "scale"})
    return tuple(
        core.Group(
            key=str(level or ""),
            data={"entries": [index for index, _ in found]},
            members=tuple(core.Member(driven(owner, entry), channels, is_relative=True) for _, entry in found),
            inputs=tuple(core.Transform(entry.target) for _, entry in found if entry.target),
        )
        for level, found in sorted(by_level.items())
    )


SYSTEM = core.System(
    name="sway",
    label="Sway",
    settings=MOTUS_PG_sway,
    classes=(MOTUS_PG_sway_entry, MOTUS_PG_sway),
    solve=solve,
    problems=(NO_TARGET,),
    groups=_groups,
    entries=_entries,
)


def sway(owner, *entries):
    """Attach the system; entries: (thing, or name of a bone, or None; target)."""
    for thing, target in entries:
        entry = owner.motus.sway.entries.add()
        setattr(entry, "bone" if isinstance(thing, str) else "thing", thing)
        entry.target = target
    support.addon("core.wiring").attach(SYSTEM, owner)
    return owner.motus.sway
