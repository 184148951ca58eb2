"""A system on properties, for the tests of those that are driven: dials that show how far along X a target is."""

import bpy

import support

core = support.addon("core.declare")
settings = support.addon("core.settings")
NO_TARGET = core.Problem("The dials need a target")


class MOTUS_PG_dial_entry(bpy.types.PropertyGroup):
    """The property at `path` from `thing`, or from the owner without one."""

    thing: bpy.props.PointerProperty(type=bpy.types.Object, override={'LIBRARY_OVERRIDABLE'})
    path: bpy.props.StringProperty(override={'LIBRARY_OVERRIDABLE'})
    index: bpy.props.IntProperty(default=-1, override={'LIBRARY_OVERRIDABLE'})


class MOTUS_PG_dial(settings.SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(default=1.0, min=0.0, max=1.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    target: bpy.props.PointerProperty(type=bpy.types.Object, update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})
    entries: bpy.props.CollectionProperty(type=MOTUS_PG_dial_entry, override={'LIBRARY_OVERRIDABLE', 'USE_INSERTION'})


def shown(target, order):
    """What the dial at a place in the list shows. target: world matrix."""
    return 0.1 * (order + 1) + 0.05 * target.translation.x


def solve(context):
    target = context.settings.target
    if target is None:
        return NO_TARGET
    for order in range(len(context.outputs)):
        context.outputs[order] = shown(target.matrix_world, order)
    return core.OK


def _groups(owner):
    dials = owner.motus.dial
    if not dials.entries:
        return ()
    names = [f"{order}.value" for order, _ in enumerate(dials.entries)]
    return (
        core.Group(
            outputs=tuple(names),
            inputs=(core.Transform(dials.target),) if dials.target else (),
            properties=tuple(
                core.Property(name, entry.thing or owner, entry.path, entry.index) for name, entry in zip(names, dials.entries)
            ),
        ),
    )


SYSTEM = core.System(
    name="dial",
    label="Dial",
    settings=MOTUS_PG_dial,
    classes=(MOTUS_PG_dial_entry, MOTUS_PG_dial),
    solve=solve,
    problems=(NO_TARGET,),
    groups=_groups,
)


def dial(owner, target, *entries):
    """Attach the system; entries: (thing or None, path, index)."""
    for thing, path, index in entries:
        entry = owner.motus.dial.entries.add()
        entry.thing, entry.path, entry.index = thing, path, index
    owner.motus.dial.target = target
    support.addon("core.wiring").attach(SYSTEM, owner)
    return owner.motus.dial
