"""Tails by Motus, by Blender's soft bodies, and by a peer, if there is one: a frame, an edit, and the first frame of a farm's task.

Run by ./motus bench. The environment variable MOTUS_PEER may name the file of Wiggle 2 (wiggle_2.py of shteeve3d/blender-wiggle-2, which
is not part of Motus). Each contender has the same keyed rig, or meshes that are keyed in the same way, and is asked for the same:

frame       of playback, once the shot has been played to its end
edit        from a change of stiffness until the shot's last frame is right
task        from a file that is opened in a process without any cache until a frame late in the shot is right, as farms do it
"""

import importlib.util
import os
import sys
import tempfile
import time
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from table import Column, Table  # noqa: E402  (found by the line above)

import support  # noqa: E402

CHAINS, BONES = 10, 8
LAST, LATE = 250, 200
ROUNDS = 5
COLUMNS = (Column("frame", "ms", "9.3f", True), Column("edit", "ms", "9.1f", True), Column("task", "ms", "9.1f", True))


def keyed(obj):
    """Keys that pull an object to and fro."""
    for frame in range(1, LAST + 1, 25):
        obj.location.x = 0.5 * (frame // 25 % 2)
        obj.keyframe_insert("location", frame=frame)


def new_rig():
    from chains import chain_cases

    rig = chain_cases.rope(BONES, CHAINS)
    keyed(rig)
    return rig


class Motus:
    """Whatever frame is asked for, all before it is solved."""

    name = "Motus"

    def make(self):
        self.rig = new_rig()
        names = ",".join(f"Tail {chain} 0" for chain in range(CHAINS))
        bpy.ops.motus.chains_add(object=self.rig.name, bones=names, frequency=1.0)

    def edit(self, turn):
        for entry in bpy.data.objects[self.rig.name].motus.chains.entries:
            entry.frequency = 1.0 + 0.1 * turn
        bpy.context.view_layer.update()

    @staticmethod
    def right(frame):
        """Have a frame be right."""
        bpy.context.scene.frame_set(frame)


class Played:
    """What is only right on a frame if all frames before have been played."""

    @staticmethod
    def right(frame):
        for one in range(1, frame + 1):
            bpy.context.scene.frame_set(one)


class SoftBodies(Played):
    """A row of vertices for each tail, whose first one is held."""

    name = "Blender's soft bodies"

    def make(self):
        self.tails = []
        for chain in range(CHAINS):
            mesh = bpy.data.meshes.new("Tail")
            mesh.from_pydata([(chain, 0.3 * index, 0.0) for index in range(BONES + 1)], [(one, one + 1) for one in range(BONES)], [])
            tail = support.link("Tail", mesh)
            tail.vertex_groups.new(name="Held").add([0], 1.0, 'REPLACE')
            keyed(tail)
            body = tail.modifiers.new("Softbody", 'SOFT_BODY')
            body.settings.vertex_group_goal = "Held"
            body.point_cache.frame_end = LAST
            self.tails.append(tail.name)

    def edit(self, turn):
        for name in self.tails:
            bpy.data.objects[name].modifiers["Softbody"].settings.pull = 0.5 + 0.01 * turn


class Wiggle(Played):
    name = "Wiggle 2"

    def __init__(self, path):
        spec = importlib.util.spec_from_file_location("wiggle_2", path)
        self.module = importlib.util.module_from_spec(spec)
        sys.modules["wiggle_2"] = self.module
        spec.loader.exec_module(self.module)
        self.module.register()

    def make(self):
        self.rig = new_rig()
        for bone in self.rig.pose.bones:
            bone["wiggle_tail"] = int(bone.name.startswith("Tail "))
        self.module.build_list()
        bpy.context.scene.wiggle_enable = True
        self.right(10)
        if all(bone.matrix_basis == bone.matrix_basis.Identity(4) for bone in self.rig.pose.bones if bone.name.startswith("Tail ")):
            raise RuntimeError("Wiggle 2 moves nothing in this Blender")

    def edit(self, turn):
        for bone in bpy.data.objects[self.rig.name].pose.bones:
            bone["wiggle_stiff"] = 400.0 + turn


def milliseconds(act):
    begin = time.perf_counter()
    act()
    return 1e3 * (time.perf_counter() - begin)


def measured(contender, folder):
    """(frames, edits, tasks) of a contender, in ms: ROUNDS numbers each."""
    support.empty_scene()
    bpy.context.scene.frame_end = LAST
    contender.make()
    path = str(Path(folder, f"{contender.name}.blend"))
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    contender.right(LAST)
    frames, edits, tasks = [], [], []
    for turn in range(ROUNDS):
        frames.append(milliseconds(lambda: Played.right(LAST)) / LAST)
        bpy.context.scene.frame_set(1)

        def edited(turn=turn):
            contender.edit(turn + 1)
            contender.right(LAST)

        edits.append(milliseconds(edited))
    for _ in range(ROUNDS):
        support.empty_scene()

        def opened():
            bpy.ops.wm.open_mainfile(filepath=path)
            contender.right(LATE)

        tasks.append(milliseconds(opened))
    return frames, edits, tasks


if __name__ == "__main__":
    support.enable()
    table = Table(f"{CHAINS} tails of {BONES} bones, {LAST} frames", *COLUMNS)
    with tempfile.TemporaryDirectory(prefix="motus-bench-") as made:
        contenders = [Motus(), SoftBodies()]
        if os.environ.get("MOTUS_PEER"):
            contenders.append(Wiggle(os.environ["MOTUS_PEER"]))
        for one in contenders:
            with table.guarded(one.name):
                table.row(one.name, *measured(one, made))
