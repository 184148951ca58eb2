"""A system for the tests of inputs over time: its owner stands where another object was ten frames ago."""

import bpy

import support

core = support.addon("core.declare")
settings = support.addon("core.settings")
tracks = support.addon("core.tracks")
AGO = 10.0

NO_TARGET = core.Problem("The echo needs a target")
NOT_RECORDED = core.Problem("The target's motion has to be recorded")


class MOTUS_PG_echo(settings.SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(default=1.0, min=0.0, max=1.0, update=settings.touch)
    target: bpy.props.PointerProperty(type=bpy.types.Object, update=settings.rewire)


def solve(context, target):
    if target is None:
        return NO_TARGET
    track = tracks.world_track(context.settings.target, context.depsgraph.scene)
    if not track.is_known:
        return NOT_RECORDED
    context.locations[0] = track.values([context.frame - AGO])[0, :3, 3]
    return core.OK


SYSTEM = core.System(
    name="echo",
    label="Echo",
    settings=MOTUS_PG_echo,
    classes=(MOTUS_PG_echo,),
    inputs=(core.Matrix("target", of="target"),),
    solve=solve,
    problems=(NO_TARGET, NOT_RECORDED),
    channels=lambda settings: frozenset({"location"}),
)


def register():
    """Register the add-on once more, with this system in its list."""
    support.register_systems(SYSTEM)


def unregister():
    """Leave the add-on as it was installed."""
    support.unregister_systems(SYSTEM)


def echo(owner, target):
    """Attach the system to an owner."""
    owner.motus.echo.target = target
    support.addon("core.wiring").attach(SYSTEM, owner)
