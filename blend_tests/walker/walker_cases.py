"""Shared by the tests of walkers: spiders, bodies with feet that are objects, ground, and where the feet really are."""

import atexit
import math
import tempfile
from pathlib import Path

import bpy
import numpy as np

import support
from support import evaluated, go_to, key_places, link

OFF_THE_FRAMES = (30, 1, 57, 90, 3.25, 24.5, 5, 100, 57, 30)
STANDS, SWINGS = 0.0, 1.0
SINGLE = 2e-6
"""m: of places near the origin in single precision."""
_folder = tempfile.TemporaryDirectory(prefix="motus-test-")
atexit.register(_folder.cleanup)
_files = {}
"""What _once() has saved in this process: paths of files."""


def system():
    return support.addon("walker").SYSTEM


def plan_of(owner):
    """The plan of a walker, as its solver has it on this frame."""
    plan = support.addon("walker.plan")
    evaluated = owner.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return plan.of(evaluated, bpy.context.scene, plan.read(evaluated.motus.walker))


def spider(ahead=2.0, last=90, **keywords):
    """A spider at the origin; with `ahead` it is keyed to go so far along +Y from frame 10 on, and stands at the end.

    What is alone in its file is added once by a run, and opened from then on, which takes a tenth of the time.
    """
    return _once("alone", _added, ahead, last, **keywords)


def spider_on_waves(ahead=2.0, last=90, **keywords):
    """A spider on a mesh object Land, which is alone with it in its file."""
    return _once("on waves", _added_on_waves, ahead, last, **keywords)


def _once(kind, build, *arguments, **keywords):
    """The object that build() adds to a file in which nothing is; where an earlier call has added the same, its file is opened.

    kind: what build() adds, of these arguments.
    """
    scene = bpy.context.scene
    if len(bpy.data.objects) or len(bpy.data.collections):
        return build(*arguments, **keywords)
    render = scene.render
    times = scene.frame_start, scene.frame_end, scene.frame_current, render.fps, render.frame_map_new
    key = repr((kind, arguments, sorted(keywords.items()), times))
    if path := _files.get(key):
        bpy.ops.wm.open_mainfile(filepath=path)
        go_to(bpy.context.scene.frame_current)
        return bpy.context.object
    made = build(*arguments, **keywords)
    _files[key] = str(Path(_folder.name, f"{len(_files)}.blend"))
    bpy.ops.wm.save_as_mainfile(filepath=_files[key], copy=True)
    return made


def _added_on_waves(*way, **keywords):
    return _added(*way, ground=grid("Land", waves).name, **keywords)


def _added(ahead, last, **keywords):
    keywords.setdefault("location", (0.0, 0.0, 0.0))
    assert bpy.ops.motus.spider_add(**keywords) == {'FINISHED'}
    made = bpy.context.object
    if ahead:
        key_places(made, {10: (0.0, 0.0, 0.0), last: (0.0, ahead, 0.0)})
        go_to(bpy.context.scene.frame_current)
    return made


def grid(name, height, half=4.0, count=81):
    """A mesh object over a square, as high as height(x, y) says."""
    side = np.linspace(-half, half, count)
    x, y = (part.ravel() for part in np.meshgrid(side, side))
    mesh = bpy.data.meshes.new(name)
    corner = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    mesh.from_pydata(
        np.column_stack((x, y, height(x, y))).tolist(),
        [],
        np.column_stack((corner, corner + 1, corner + count + 1, corner + count)).tolist(),
    )
    return link(name, mesh)


def waves(x, y):
    return 0.08 * np.sin(2.1 * x + 0.3) * np.cos(1.7 * y) + 0.05 * np.sin(3.3 * y)


def cross(name="Body", legs=4):
    """A body, an empty, with a child and feet that are objects around it; (body, child, feet)."""
    body = link(name)
    shell = link(f"{name} Shell", location=(0.0, 0.0, 0.5), parent=body)
    feet = [
        link(f"{name} Foot {index}", location=(math.sin(turn), math.cos(turn), 0.0))
        for index, turn in enumerate(np.arange(legs) * 2.0 * math.pi / legs + 0.5)
    ]
    bpy.context.view_layer.update()
    return body, shell, feet


def select(owner, others):
    """Select these alone, the owner as the active one."""
    for obj in bpy.context.scene.objects:
        obj.select_set(obj in others or obj == owner)
    bpy.context.view_layer.objects.active = owner


def names(feet):
    return ",".join(foot.name for foot in feet)


def foot_bones(owner):
    return [leg.name for leg in owner.motus.walker.legs]


def places(owner):
    """(legs, 3): where the feet are in the world."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    seen = owner.evaluated_get(depsgraph)
    return np.array(
        [
            leg.foot.evaluated_get(depsgraph).matrix_world.translation
            if leg.foot
            else (seen.matrix_world @ seen.pose.bones[leg.name].matrix).translation
            for leg in owner.motus.walker.legs
        ]
    )


def tips(owner):
    """(legs, 3): where the ends of a spider's legs are in the world."""
    seen = evaluated(owner)
    return np.array([seen.matrix_world @ seen.pose.bones[name.replace("foot", "lower")].tail for name in foot_bones(owner)])


def rests(owner):
    """(legs, 3): where the feet belong, in the world."""
    matrix = np.array(evaluated(owner).matrix_world)
    rest = np.array([tuple(leg.rest) for leg in owner.motus.walker.legs])
    return rest @ matrix[:3, :3].T + matrix[:3, 3]


def body_of(owner):
    """World matrix of what rises and leans."""
    seen = evaluated(owner)
    if seen.pose:
        return np.array(seen.matrix_world @ seen.pose.bones["body"].matrix)
    return np.array(evaluated(owner.motus.walker.body).matrix_world)


def set_raw(owner, name, number):
    """Write into a walker's settings what Blender itself would not take, as a file may hold it."""
    apart = support.addon("core.blender.capabilities").keeps_settings_apart()
    (owner.bl_system_properties_get() if apart else owner)["motus"]["walker"][name] = number
    owner.update_tag()


def over(frames, read):
    """Values of read() on frames."""
    found = []
    for frame in frames:
        go_to(frame)
        found.append(read())
    return np.array(found)


def seconds(frame):
    render = bpy.context.scene.render
    return frame * render.fps_base / render.fps


class WalkerTestCase(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.scene.frame_start, self.scene.frame_end = 1, 120

    @property
    def scene(self):
        return bpy.context.scene

    def sentence(self, owner):
        """What the panel says is wrong; None where all is well."""
        bpy.context.view_layer.update()
        found = support.addon("core.wiring").problem(system(), owner, bpy.context.view_layer.depsgraph)
        return found and support.addon("walker.told").sentence(bpy.context, owner, found)

    def assertWell(self, owner):
        self.assertIsNone(self.sentence(owner))

    def assertStands(self, owner, frames, tolerance=SINGLE):
        """Between the frames feet that the plan lets stand do not move, and some feet step."""
        walker = plan_of(owner).walker
        found = over(frames, lambda: places(owner))
        swings = walker.swing(seconds(np.array(frames, float)))
        still = (swings[1:] == 0.0) & (swings[:-1] == 0.0)
        # A foot that is lifted and put down between two frames has stood on both.
        touches = walker.steps["touch"][walker.steps["touch"] > walker.steps["lift"]]
        moved = np.abs(np.diff(found, axis=0)).max(axis=2)
        for leg in range(found.shape[1]):
            down = walker.steps["touch"][walker.steps["leg"] == leg]
            for row in np.flatnonzero(still[:, leg]):
                first, last = seconds(frames[row]), seconds(frames[row + 1])
                if not ((down > first) & (down <= last)).any():
                    self.assertLessEqual(moved[row, leg], tolerance, (leg, frames[row]))
        self.assertGreater(len(touches), 0)
        return found, swings
