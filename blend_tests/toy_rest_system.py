"""A system that waits for a mesh with its modifiers, for the tests of such inputs: its owner rests on the highest point of a ground."""

import bpy

import support

core = support.addon("core.declare")
settings = support.addon("core.settings")
NO_GROUND = core.Problem("There is no ground to rest on")

solve_calls = 0
"""How often solve() was called."""


class MOTUS_PG_rest(settings.SystemSettings, bpy.types.PropertyGroup):
    influence: bpy.props.FloatProperty(default=1.0, min=0.0, max=1.0, update=settings.touch, override={'LIBRARY_OVERRIDABLE'})
    ground: bpy.props.PointerProperty(type=bpy.types.Object, update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})
    other: bpy.props.PointerProperty(type=bpy.types.Object, update=settings.rewire, override={'LIBRARY_OVERRIDABLE'})


def highest(*grounds):
    """The highest point of evaluated objects, in world space."""
    return max((one.matrix_world @ vertex.co for one in grounds for vertex in one.data.vertices), key=lambda point: point.z)


def solve(context, ground, other):
    global solve_calls
    solve_calls += 1
    if ground is None or not ground.data.vertices:
        return NO_GROUND
    context.locations[0] = highest(*filter(None, (ground, other)))
    return core.OK


SYSTEM = core.System(
    name="rest",
    label="Rest",
    settings=MOTUS_PG_rest,
    classes=(MOTUS_PG_rest,),
    solve=solve,
    problems=(NO_GROUND,),
    inputs=(core.Geometry("ground", of="ground"), core.Geometry("other", of="other")),
    channels=lambda settings: frozenset({"location"}),
)


def rest(owner, ground, other=None):
    """Attach the system to an owner."""
    owner.motus.rest.ground, owner.motus.rest.other = ground, other
    support.addon("core.wiring").attach(SYSTEM, owner)
    return owner.motus.rest
