"""What walkers cost a frame: spiders whose feet stand on a mesh, beside the same spiders whose feet nobody moves. Run by ./motus bench.

The scenes take turns (costs.py). Planning a shot anew, as after an edit of a setting, is a row of its own.
"""

import sys
import time
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import costs  # noqa: E402  (found by the line above)
from sample_scenes import new_curve  # noqa: E402
from table import Column, Table  # noqa: E402

import support  # noqa: E402

SPIDERS = 10
STONES = 50
PLANNING, FRAMES = 50.0, 250  # ms, of so many frames
ROUNDS = 20


def new_spiders(count):
    """Spiders of eight legs, keyed, that do not walk."""
    from walker import walker_cases

    found = []
    for index in range(count):
        land = walker_cases.grid("Land", walker_cases.waves, half=3.0)
        spider = walker_cases.spider(ahead=0.0, location=(0.0, 0.0, 0.0))
        bpy.ops.motus.walker_remove(object=spider.name)
        x = land.location.x = 8.0 * index
        support.key_places(spider, {1: (x, -2.0, 0.0), FRAMES: (x, 2.0, 0.0)})
        found.append((spider, land))
    return found


def new_on_stones():
    """One whose ground is a collection."""
    ((spider, land),) = new_spiders(1)
    stones = bpy.data.collections.new("Stones")
    bpy.context.scene.collection.children.link(stones)
    for index in range(STONES):
        stone = bpy.data.objects.new("Stone", land.data)
        stone.location = (index % 10 - 5.0, index // 10 - 3.0, 0.0)
        stones.objects.link(stone)
    return [(spider, stones)]


def new_on_path():
    """One that follows a path, which has to be asked where it is over time."""
    found = new_spiders(1)
    for spider, _ in found:
        spider.animation_data_clear()
        bpy.ops.motus.path_follow_add(object=spider.name, curve=new_curve().name, duration=10.0)
    return found


def walk(spiders):
    for spider, land in spiders:
        key = "ground" if isinstance(land, bpy.types.Object) else "grounds"
        bpy.ops.motus.walker_add(object=spider.name, **{key: land.name})


SCENES = (  # name, what is there, what is added to it, the wanted ms
    ("one spider", lambda: new_spiders(1), walk, 0.300),
    (f"{SPIDERS} spiders", lambda: new_spiders(SPIDERS), walk, 3.000),
    (f"on {STONES} stones", new_on_stones, walk, 1.500),
    ("on a path", new_on_path, walk, 1.000),
)


def report():
    costs.report(Table("Cost added to a frame by walkers", *costs.COLUMNS), SCENES)
    table = Table(f"Planning the steps of {FRAMES} frames, the least", Column("planning", "ms"), Column("goal"))
    with table.guarded("one spider"):
        table.row("one spider", planning(), PLANNING)


def planning():
    """ms that the steps of a spider take to be planned, its motion and its ground being read; the least."""
    support.empty_scene()
    ((spider, _),) = spiders = new_spiders(1)
    walk(spiders)
    plan, scene = support.addon("walker.plan"), bpy.context.scene
    owner = spider.evaluated_get(bpy.context.evaluated_depsgraph_get())
    numbers, poses = plan.read(owner.motus.walker), plan.body(owner, scene, 24.0)[0]
    placed = support.addon("walker.ground").parts(owner.motus.walker, scene)[0]
    bodies = plan.carrying.moved(owner, poses.seconds * 24.0, poses.digest)[0] if any(numbers.lengths) else None
    read = numbers, poses, placed, bodies
    found = []
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        plan._made(*read)
        found.append(1e3 * (time.perf_counter() - begin))
    return min(found)


if __name__ == "__main__":
    support.enable()
    report()
