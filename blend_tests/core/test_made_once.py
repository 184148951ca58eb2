"""What solvers make of the native library, and keep, while each setting that may be keyed is keyed: once, not on each frame."""

import collections
import contextlib
import itertools

import bpy

import live_scenes
import support

FIRST, LAST = 2, 40
WARM = 6
ROUNDS = tuple((frame, frame + 1) for frame in range(WARM + 1, WARM + 17, 2))
EXPENSIVE = frozenset(
    (
        "Bezier",
        "BSpline",
        "Chain",
        "IkPlan",
        "Lattice",
        "LayerClip",
        "LayerStack",
        "LookAtPlan",
        "Picker",
        "PolyLine",
        "RotationTrack",
        "SecondOrder",
        "SecondOrder.from_mass_spring",
        "SecondOrder.from_overshoot",
        "Snow",
        "SnowCollider",
        "SnowCover",
        "SnowLayer",
        "Spline",
        "StrandMotion",
        "TailPlan",
        "Timing.pins",
        "Timing.speeds",
        "Track",
        "Walker",
        "WalkerGround",
        "layer_mask",
        "layer_moments",
        "pivot_accelerations",
        "refine",
        "smooth_ahead",
    )
)
"""What solvers make of the native module and keep."""

MADE_ANEW = {
    ("path", "lag_rate"): "a follower that lags behind keyed speeds or places reads those of the last seconds: another table on each frame",
}
"""(system, setting) that has things of the library made on each frame -> why."""


KEPT_ANEW = {
    "results that the first solver of a walker hands to its second solver: (moment, group, results, keys that were read)": "once an evaluation",
    "transforms that systems lay over a rig's bones: {key: (rows, (n, 16) float32)}, written by lay()": "other ones on each frame",
    "scratch arrays, whose content is undefined": "another shape for each rig that a thread solves",
    "plans of rigs, the results of analyzing a rig's bones for a solver": "a thread makes its own, when it solves a rig for the first time",
}
"""Rows of docs/kept.md that are kept anew on each frame -> why. All other rows are counted."""


class _Counting:
    """The native module, or a class of it, which counts what is made."""

    def __init__(self, wrapped, counts, prefix=""):
        self._wrapped, self._counts, self._prefix = wrapped, counts, prefix

    def __getattr__(self, name):
        found = getattr(self._wrapped, name)
        full = self._prefix + name
        if full in EXPENSIVE or any(one.startswith(f"{full}.") for one in EXPENSIVE):
            return _Counting(found, self._counts, full if not isinstance(found, type) else f"{full}.")
        return found

    def __call__(self, *arguments, **keywords):
        name = self._prefix.rstrip(".")
        if name in EXPENSIVE:
            self._counts[name] += 1
        return self._wrapped(*arguments, **keywords)


@contextlib.contextmanager
def counting():
    """{name of a class or an expensive function of the library: how often it was called}, from here to the end of the block."""
    native, counts = support.addon("core.native"), collections.Counter()
    module = native.module
    native.module = _Counting(module, counts)
    try:
        yield counts
    finally:
        native.module = module


@contextlib.contextmanager
def counting_kept():
    """{what a declaration of core/keeping.py keeps: how often something was kept by it}, from here to the end of the block."""
    keeping, counts = support.addon("core.keeping"), collections.Counter()

    def added(self, key, value):
        of_threads = {id(latest): one.what for mine in list(keeping._threads.values()) for one, latest in list(mine.items())}
        what = getattr(self, "what", of_threads.get(id(self)))
        if what is not None:
            counts[what] += 1
        return add(self, key, value)

    def stored(self, key, value):
        counts[self.declaration.what] += 1
        dict.__setitem__(self, key, value)

    add, keeping.Latest.add, keeping.Room.__setitem__ = keeping.Latest.add, added, stored
    try:
        yield counts
    finally:
        keeping.Latest.add = add
        del keeping.Room.__setitem__


def owners():
    """(system, owner) of the file."""
    declared = support.addon("core.declare")
    for system in declared.registered.values():
        if isinstance(system, declared.System):
            for obj in bpy.data.objects:
                if declared.is_owner(system, obj):
                    yield system, obj


def keyable(group, path):
    """(group of settings, name, path from the object) of all that may be keyed in a group and in those that it holds."""
    for declared in group.bl_rna.properties:
        name = declared.identifier
        if name == "rna_type":
            continue
        if declared.type == 'COLLECTION':
            for index, entry in enumerate(getattr(group, name)):
                yield from keyable(entry, f"{path}.{name}[{index}]")
        elif declared.type == 'POINTER' and isinstance(getattr(group, name), bpy.types.PropertyGroup):
            yield from keyable(getattr(group, name), f"{path}.{name}")
        elif declared.is_animatable and not declared.is_readonly and declared.type in {'FLOAT', 'INT', 'BOOLEAN', 'ENUM'}:
            yield group, name, f"{path}.{name}"


def values(group, name):
    """Two values of a setting."""
    declared, present = group.bl_rna.properties[name], getattr(group, name)
    if declared.type == 'ENUM':
        return present, next(one for one in declared.enum_items.keys() if one != present)
    step = 0.1 * (min(declared.soft_max, 10.0) - max(declared.soft_min, -10.0)) if declared.type == 'FLOAT' else 1

    def other(value):
        if declared.type == 'BOOLEAN':
            return not value
        return value + step if value + step <= declared.hard_max else value - step

    return (tuple(present), tuple(map(other, present))) if declared.is_array else (present, other(present))


def is_keyed(owner, path):
    """Whether the scene keys a setting already."""
    actions = support.addon("core.blender.actions")
    return any(curve.data_path == path for player in actions.players(owner) for curve in actions.curves_of(player))


@contextlib.contextmanager
def keyed(owner, group, name, path):
    """A setting has another value on each frame, or one of two in turns where there is nothing between them, until the block ends."""
    present, other = values(group, name)
    is_number = group.bl_rna.properties[name].type == 'FLOAT'
    frames = {present: (FIRST,), other: (LAST,)} if is_number else {present: range(FIRST, LAST, 2), other: range(FIRST + 1, LAST, 2)}
    for value, its in frames.items():
        setattr(group, name, value)
        for frame in its:
            owner.keyframe_insert(path, frame=frame)
    try:
        yield
    finally:
        for frame in itertools.chain(*frames.values()):
            owner.keyframe_delete(path, frame=frame)
        setattr(group, name, present)


def made_in_steady_state():
    """({name: how often it was called}, {what is kept: how often something was kept}) while the frames of one of ROUNDS are gone through.

    Some things are kept for a thread, and which thread evaluates an object is left to chance. So the next two are gone through if something
    was made: what a thread makes when it solves something for the first time is there then, and what each frame makes is made again. No frame
    comes twice, as what one frame makes may still be kept when the frame comes again.
    """
    for frames in ROUNDS:
        with counting() as counts, counting_kept() as kept:
            for frame in frames:
                bpy.context.scene.frame_set(frame)
        unexpected = {what: times for what, times in kept.items() if what not in KEPT_ANEW}
        if not counts and not unexpected:
            break
    return dict(counts), unexpected


def made_while_keyed(settings):
    """made_in_steady_state() while settings are keyed: [(name of the owner, name, path from the owner)], of different owners."""
    with contextlib.ExitStack() as stack:
        for owner_name, name, path in settings:
            owner = bpy.data.objects[owner_name]
            if not is_keyed(owner, path):
                stack.enter_context(keyed(owner, owner.path_resolve(path.rpartition(".")[0]), name, path))
        bpy.context.view_layer.update()
        bpy.context.scene.frame_set(WARM)
        return made_in_steady_state()


class MadeOnce(support.SceneTestCase):
    @support.in_one_blender
    def test_while_any_setting_is_keyed(self):
        live_scenes.opened()
        found = [
            (system.name, owner.name, name, path)
            for system, owner in owners()
            for _, name, path in keyable(getattr(owner.motus, system.name), f"motus.{system.name}")
        ]
        self.assertGreater(len({(system, name) for system, _, name, _ in found}), 60)
        by_owner = collections.defaultdict(list)
        for system, owner_name, name, path in found:
            if (system, name) not in MADE_ANEW:
                by_owner[owner_name].append((owner_name, name, path))
        # A setting of each owner at once; each alone where something is made.
        for together in itertools.zip_longest(*by_owner.values()):
            settings = [one for one in together if one]
            if made_while_keyed(settings) == ({}, {}):
                continue
            for one in settings:
                with self.subTest(one):
                    self.assertEqual(made_while_keyed([one]), ({}, {}))
