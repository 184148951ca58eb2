"""IK against Blender's own: cost of many chains, long chains, and how often each reaches. Run by ./motus bench."""

import math
import statistics
import sys
import time
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from table import Column, Table, note  # noqa: E402

import support  # noqa: E402  (found by the line above)

CHAINS = 100
FRAMES = 60
FEWEST_ROUNDS, SECONDS = 5, 4.0
LIMITED_TARGETS = 10_000
PLACES = 200


def new_rig(chains, bones, bend=0.05, spacing=3.0, length=1.0):
    """A rig of separate chains "c<chain>.<bone>" along X, each a little bent (`bend` of a bone's length) upwards."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    root = rig.data.edit_bones.new("root")
    root.head, root.tail = (0.0, -1.0, 0.0), (0.0, -0.5, 0.0)
    for chain in range(chains):
        parent, place = root, Vector((spacing * chain, 0.0, 0.0))
        for index in range(bones):
            bone = rig.data.edit_bones.new(f"c{chain}.{index}")
            step = Vector((0.0, length / bones, bend * length / bones * math.cos(math.pi * (index + 0.5) / bones)))
            bone.head, bone.tail = place, place + step
            bone.parent, bone.use_connect = parent, index > 0
            parent, place = bone, place + step
    bpy.ops.object.mode_set(mode='OBJECT')
    for bone in rig.pose.bones:
        bone.rotation_mode = 'QUATERNION'
    return rig


def new_targets(chains, spacing=3.0, is_moving=True):
    """An empty for each chain, moving on its own ellipse within reach."""
    targets = []
    for chain in range(chains):
        target = bpy.data.objects.new(f"t{chain}", None)
        bpy.context.scene.collection.objects.link(target)
        target.location = (spacing * chain, 0.6, 0.2)
        if is_moving:
            for axis, expression in ((1, f"0.6+0.25*sin(frame*0.11+{chain})"), (2, f"0.2*cos(frame*0.07+{chain})")):
                target.driver_add("location", axis).driver.expression = expression
        targets.append(target)
    return targets


def add_blender_ik(rig, targets, bones):
    for chain, target in enumerate(targets):
        constraint = rig.pose.bones[f"c{chain}.{bones - 1}"].constraints.new('IK')
        constraint.target, constraint.chain_count = target, bones


def add_motus_ik(rig, targets, bones, **keywords):
    for chain, target in enumerate(targets):
        bpy.ops.motus.ik_add(object=rig.name, bone=f"c{chain}.{bones - 1}", target=target.name, chain_length=bones, **keywords)


SYSTEMS = {"none": lambda *_: None, "Motus IK": add_motus_ik, "Blender IK": add_blender_ik}


def frame_microseconds(scene):
    samples = []
    for frame in range(1, FRAMES + 6):
        start = time.perf_counter()
        scene.frame_set(frame)
        samples.append(time.perf_counter() - start)
    return statistics.median(samples[5:]) * 1e6


def animate(rig):
    """Key the rotation of every bone, as an animated character's are."""
    for bone in rig.pose.bones:
        for frame, turn in ((1, 0.0), (FRAMES + 5, 0.3)):
            bone.rotation_quaternion = (1.0, turn, 0.0, 0.0)
            bone.keyframe_insert("rotation_quaternion", frame=frame)


RIGS = ("animated", "animated, made last", "moved by its root", "moved, made last", "still")


def new_scene(chains, bones, kind, add):
    """One more scene, with a rig of `kind` (one of RIGS), its targets and the IK that `add` makes."""
    scene = bpy.context.window.scene = bpy.data.scenes.new("Bench")
    if kind.endswith("made last"):
        targets, rig = new_targets(chains), new_rig(chains, bones)
    else:
        rig, targets = new_rig(chains, bones), new_targets(chains)
    if kind.startswith("animated"):
        animate(rig)
    elif kind != "still":
        rig.pose.bones["root"].driver_add("location", 0).driver.expression = "0.01 * sin(frame)"
    add(rig, targets, bones)
    return scene


def costs(chains, bones, kind):
    """Frame times, us, (rounds, SYSTEMS).

    The scenes stand side by side and take turns, so that what changes the machine's speed for seconds (in a virtual one: how
    far apart its cores are) is the same for all that are compared.
    """
    support.empty_scene()
    scenes = [new_scene(chains, bones, kind, add) for add in SYSTEMS.values()]
    begin, rounds = time.perf_counter(), []
    while len(rounds) < FEWEST_ROUNDS or time.perf_counter() - begin < SECONDS:
        rounds.append([frame_microseconds(scene) for scene in scenes])
    return np.array(rounds)


def report_costs():
    note("A still rig is not evaluated at all without IK: there the cost of its pose is counted too.")
    note("Without IK Blender evaluates the same scene faster where the rig was made before the targets: it then begins with")
    note("the rig, and the targets fill the other threads. A rig whose custom properties point to the targets loses that too.")
    table = Table(
        "Frame time of a chain above that of the same rig without IK, targets move: medians of rounds in which the scenes take turns",
        Column("a chain", "us", "9.2f", True),
        Column("of Blender", "x"),
        width=56,
    )
    for chains, bones in ((CHAINS, 2), (10, 5), (10, 20), (10, 100)):
        for kind in RIGS:
            rig = f"{chains} chains of {bones} bones, {kind}"
            with table.guarded(rig):
                rounds = costs(chains, bones, kind)
                extra = dict(zip(SYSTEMS, ((rounds - rounds[:, :1]) / chains).T))
                for name in ("Blender IK", "Motus IK"):
                    table.row(f"{rig}: {name}", extra[name], np.median(extra[name] / extra["Blender IK"]))


def tips(rig, chains, bones):
    """Tips of all chains as evaluated, (chains, 3)."""
    bpy.context.view_layer.update()
    evaluated = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return np.array([evaluated.pose.bones[f"c{chain}.{bones - 1}"].tail[:] for chain in range(chains)], float)


def residuals(add, bones, places, bend, limits=None):
    """Distance of the tips from `places` (rounds, chains, 3), which lie relative to the roots; (rounds, chains)."""
    support.empty_scene()
    chains = places.shape[1]
    rig, targets = new_rig(chains, bones, bend), new_targets(chains, is_moving=False)
    if limits is not None:
        set_limits(rig, bones, limits)
    if add is add_motus_ik:
        add(rig, targets, bones, use_limits=limits is not None)
    else:
        add(rig, targets, bones)
    found = np.empty(places.shape[:2])
    roots = np.array([[3.0 * chain, 0.0, 0.0] for chain in range(chains)])
    for row, wanted in enumerate(places):
        for target, place in zip(targets, wanted + roots):
            target.location = place
        found[row] = np.linalg.norm(tips(rig, chains, bones) - (wanted + roots), axis=1)
    return found


def set_limits(rig, bones, limits):
    """limits: (chains, bones, 3) largest angles about X, Y, Z to both sides."""
    for chain, rows in enumerate(limits):
        for index, row in enumerate(rows):
            bone = rig.pose.bones[f"c{chain}.{index}"]
            for axis, angle in zip("xyz", row):
                setattr(bone, f"use_ik_limit_{axis}", True)
                setattr(bone, f"ik_min_{axis}", -angle)
                setattr(bone, f"ik_max_{axis}", angle)


def random_places(generator, rounds, chains, nearest, farthest):
    """Points in a shell about the root."""
    directions = generator.normal(size=(rounds, chains, 3))
    directions /= np.linalg.norm(directions, axis=2, keepdims=True)
    return directions * generator.uniform(nearest, farthest, size=(rounds, chains, 1))


def report_limits():
    generator = np.random.default_rng(5)
    chains, bones = 50, 3
    limits = np.radians(generator.uniform(10.0, 120.0, size=(chains, bones, 3)))
    places = random_places(generator, LIMITED_TARGETS // chains, chains, 0.1, 1.05)
    blender = residuals(add_blender_ik, bones, places, 0.05, limits)
    motus = residuals(add_motus_ik, bones, places, 0.05, limits)
    within = np.mean(motus <= blender + 1e-4)
    columns = [Column(name, "", "9.2e") for name in ("median", "mean", "largest")]
    count = places.shape[0] * chains
    table = Table(
        f"{count} random targets, three bones with random limits; residuals of the chain's length", *columns, Column("NaN", "", "9.0f")
    )
    for name, found in (("Blender IK", blender), ("Motus IK", motus)):
        table.row(name, np.median(found), found.mean(), found.max(), np.isnan(found).sum())
    note(
        f"Motus within Blender's residual + 1e-4: {100.0 * within:.2f} %; "
        f"better by more than 1e-4: {100.0 * np.mean(motus < blender - 1e-4):.2f} %"
    )


def report_reaching():
    generator = np.random.default_rng(7)
    table = Table(
        "Share of targets that are missed by more than 1e-4 of the chain's length, though within reach",
        Column("Blender IK", "%", "9.2f"),
        Column("Motus IK", "%", "9.2f"),
        Column("largest, Motus", "", "9.1e"),
        width=56,
    )
    for bones in (2, 5, 20, 40):
        cases = {
            "straight rest pose, anywhere within reach": (0.0, random_places(generator, PLACES, 10, 0.05, 0.999)),
            "targets within 2 % of the root": (0.05, random_places(generator, PLACES, 10, 0.001, 0.02)),
            "targets at 0.999 to 1 of the reach": (0.05, random_places(generator, PLACES, 10, 0.999, 1.0)),
        }
        for case, (bend, places) in cases.items():
            found = [residuals(add, bones, places, bend) for add in (add_blender_ik, add_motus_ik)]
            missed = [100.0 * np.mean(~(one <= 1e-4)) for one in found]
            table.row(f"{bones} bones, {case}", *missed, found[1].max())


if __name__ == "__main__":
    support.enable()
    report_costs()
    report_limits()
    report_reaching()
