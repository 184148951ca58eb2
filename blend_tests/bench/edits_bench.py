"""How long an artist waits after an edit: from the edit to the evaluated scene; and for the add-on to be switched on. Run by ./motus bench.

Each edit of a row is another value, so that nothing of the edit before can be used again. What switches the add-on on for the
first time in a Blender is measured in a Blender of its own, with Python's byte code in place.
"""

import sys
import time
from pathlib import Path

import addon_utils
import bpy

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import dynamics_bench  # noqa: E402  (found by the line above)
import typical_bench  # noqa: E402
from table import Column, Table  # noqa: E402

import support  # noqa: E402
from dynamics import dynamics_cases  # noqa: E402

EDITS, BEFORE = 60, 5
"""Edits that are measured, and those before, by which Blender and the add-on come to their steady state."""

BEADS, LAMPS = 8, 4
"""Objects of a row that hangs, and objects with dynamics on them."""
OWNERS = 200
STARTS = 5


def on_curve():
    pairs = typical_bench.new_followers(typical_bench.FOLLOWERS, 1)
    typical_bench.follow_by_motus(pairs)
    return pairs


def control_point():
    """A control point of the curve that all followers are on."""
    point = on_curve()[0][1].data.splines[0].bezier_points[1]

    def edit(value):
        point.co.z = value

    return edit


def offset():
    """A setting of one of many followers that share a curve."""
    return _setting(on_curve()[0][0].motus.path, "offset")


def target(count):
    """The target of a limb, in a scene with this many rigs."""
    characters = typical_bench.new_characters(count)
    typical_bench.reach_by_motus(characters)
    goal = characters[0][1][0]
    goal.animation_data_clear()

    def edit(value):
        goal.location.z = value

    return edit


def weight():
    """How far a limb of a rig reaches."""
    characters = typical_bench.new_characters(1)
    typical_bench.reach_by_motus(characters)
    return _setting(characters[0][0].motus.ik.entries[0], "position_weight")


def frequency():
    objects = dynamics_bench.new_objects(dynamics_bench.OBJECTS)
    dynamics_bench.follow(objects)
    return _setting(objects[0].motus.dynamics.entries[0], "frequency")


def bones_frequency():
    rigs = dynamics_bench.new_rig()
    dynamics_bench.trail(rigs)
    return _setting(rigs[0].motus.dynamics.entries[0], "frequency")


def layer_weight():
    characters = typical_bench.new_characters(1)
    typical_bench.layer(characters)
    return _setting(characters[0][0].motus.layers.entries[0], "weight")


def angle():
    typical_bench.pendulums_by_motus(None)
    return _setting(next(obj for obj in bpy.data.objects if obj.motus.pendulum.is_active).motus.pendulum, "angle1")


def hanging():
    """(object of a row that hangs as a chain, whose root is keyed; objects with dynamics that are parented to others of the row)."""
    beads = [dynamics_cases.link(f"Bead {index}") for index in range(BEADS)]
    for index, bead in enumerate(beads):
        bead.location = 0.0, 0.3 * index, 2.0
    dynamics_cases.key(beads[0], "location", {1: (0.0, 0.0, 2.0), 40: (2.0, 0.0, 2.0), 80: (-1.0, 0.0, 2.0)})
    bpy.ops.motus.chains_add(objects=", ".join(bead.name for bead in beads), frequency=1.0)
    followers = [dynamics_cases.link(f"Lamp {index}") for index in range(LAMPS)]
    for index, follower in enumerate(followers):
        follower.parent = beads[1 + index]
        dynamics_cases.add(follower, follow='WORLD')
    return beads[0], followers


def below_a_chain():
    return _setting(hanging()[1][0].motus.dynamics.entries[0], "frequency")


def chain_above():
    return _setting(hanging()[0].motus.chains.entries[0], "frequency")


def _setting(group, name):
    def edit(value):
        setattr(group, name, value)

    return edit


EDITED = {  # what makes the scene and returns the edit
    f"control point of a curve with {typical_bench.FOLLOWERS} followers": control_point,
    f"offset of one of {typical_bench.FOLLOWERS} followers": offset,
    "target of one of 4 limbs, one rig": lambda: target(1),
    "target of one of 4 limbs, 10 rigs": lambda: target(typical_bench.RIGS),
    "weight of a limb": weight,
    f"frequency of one of {dynamics_bench.OBJECTS} objects": frequency,
    f"frequency of {dynamics_bench.CHAINS * dynamics_bench.BONES} bones": bones_frequency,
    "frequency of an object on a row that hangs": below_a_chain,
    f"frequency of a row that {LAMPS} objects follow": chain_above,
    "weight of a layer": layer_weight,
    f"first angle of one of {typical_bench.OWNERS} pendulums": angle,
}
GOAL = 10.0
"""Milliseconds that an artist does not notice."""


def waited(edit):
    """Milliseconds from each of EDITS edits to the evaluated scene."""
    found = []
    for index in range(BEFORE + EDITS):
        begin = time.perf_counter()
        edit(0.5 + 0.4 * (index + 1) / (BEFORE + EDITS))
        bpy.context.view_layer.update()
        found.append(1e3 * (time.perf_counter() - begin))
    return found[BEFORE:]


def new_owners():
    """OWNERS objects with a system each: followers of one curve, pendulums, and objects with dynamics."""
    pairs = typical_bench.new_followers(OWNERS // 2, 1)
    typical_bench.follow_by_motus(pairs)
    for _ in range(OWNERS // 4 // typical_bench.OWNERS):
        typical_bench.pendulums_by_motus(None)
    dynamics_bench.follow(dynamics_bench.new_objects(OWNERS // 4))


def switched_on():
    """Seconds that the add-on takes to be switched on again, and the scene to be evaluated."""
    found = []
    for _ in range(STARTS):
        addon_utils.disable(support.module_name())
        begin = time.perf_counter()
        support.enable()
        bpy.context.view_layer.update()
        found.append(time.perf_counter() - begin)
    return found


def first_time():
    """Seconds of importing and registering the add-on in a Blender that has not done so."""
    found = []
    for _ in range(STARTS):
        status, said = support.run_blender(
            "import time, support\nbegin = time.perf_counter()\nsupport.enable()\nprint('TOOK', time.perf_counter() - begin)\n",
            enabled=False,
        )
        took = [float(line.split()[1]) for line in said.splitlines() if line.startswith("TOOK ")]
        if status or not took:
            raise RuntimeError(f"Blender ended with status {status}: {said[-300:]}")
        found += took
    return found


def report(wanted):
    edits = Table("From an edit to the evaluated scene", Column("wait", "ms", has_rounds=True), Column("goal", ""), rows="edit", width=52)
    for name, make in EDITED.items():
        if not wanted or any(part in name for part in wanted):
            with edits.guarded(name):
                support.empty_scene()
                edits.row(name, waited(make()), GOAL)
    starts = Table("Switching the add-on on", Column("time", "s", has_rounds=True), Column("goal", ""), rows="where", width=52)
    with starts.guarded("import and registration"):
        starts.row("import and registration", first_time(), 0.15)
    with starts.guarded(f"in a file of {OWNERS} owners"):
        support.empty_scene()
        new_owners()
        starts.row(f"in a file of {OWNERS} owners", switched_on(), 0.5)


if __name__ == "__main__":
    support.enable()
    report(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
