"""What dynamics cost a frame: objects, each with its own, and a rig of 200 bones in ten chains. Run by ./motus bench.

Each row is the cost that they add to a frame of the same keyed things without any; the scenes take turns (costs.py).
"""

import sys
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import costs  # noqa: E402  (found by the line above)
from sample_scenes import new_object  # noqa: E402
from table import Table  # noqa: E402

import support  # noqa: E402

OBJECTS = 10
CHAINS, BONES = 10, 20


def new_objects(count):
    """Empties that keys move."""
    found = []
    for index in range(count):
        obj = new_object("Ball")
        for frame, place in ((1, 0.0), (20, 3.0), (40, 0.0)):
            obj.location = (place, 2.0 * index, 0.0)
            obj.keyframe_insert("location", frame=frame)
        found.append(obj)
    return found


def new_rig():
    """A rig whose root is moved by keys, and chains on it."""
    from dynamics import dynamics_cases

    return [dynamics_cases.rope(BONES, CHAINS)]


def follow(objects):
    for obj in objects:
        bpy.ops.motus.dynamics_add(object=obj.name, channels={'LOCATION'}, style='BOUNCY')


def trail(rigs):
    for rig in rigs:
        names = ",".join(f"Tail {chain} 0" for chain in range(CHAINS))
        bpy.ops.motus.dynamics_add(object=rig.name, bones=names, whole_chains=True, chain_delay=0.02, style='FLOPPY')


SCENES = (  # name, what is there, what is added to it, the wanted ms
    ("one object", lambda: new_objects(1), follow, 0.030),
    (f"{OBJECTS} objects", lambda: new_objects(OBJECTS), follow, 0.300),
    (f"{CHAINS * BONES} bones", new_rig, trail, 4.000),
)


if __name__ == "__main__":
    support.enable()
    costs.report(Table("Cost added to a frame by dynamics", *costs.COLUMNS), SCENES)
