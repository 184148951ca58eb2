"""Declarations of a folder of the add-on: Feature for its interface, System for settings that are solved while Blender evaluates.

From a System, core/wiring makes the drivers, constraints and modifiers on the scene's objects.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from .inputs import Geometries, Vertices
from .members import Points


@dataclass(frozen=True)
class Feature:
    """Declaration of what a folder of the add-on adds to Blender's interface: settings, operators, panels, menus; see docs/systems.md.

    name: of the folder. label: name for users, in English. page: name of its page in the manual, if it is not `name`. classes: all classes
    that Blender registers, in the order of registration.
    settings: PropertyGroup that becomes Object.motus.<name>, or None. scene_settings: PropertyGroup that becomes Scene.motus.<name>.
    extras: modules or objects whose register() and unregister() are called too. overlay: Overlay that the viewport shows for
    selected objects (core/interface/overlay.py), or None. offers: module or object with the functions that different systems may call,
    by registry.offered(). add_menu, object_menu, pose_menu: identifiers of operators in Blender's menus.
    hand_over: how motus.hand_over makes plain Blender of it in a copy of the file. 'KEYS': of the objects, bones and properties that it
    drives. 'POINTS': of what its modifier moves or makes, 'FACES': of a surface that it makes. 'PLAIN': nothing is left to do but to
    forget its settings. "": it cannot, so that files in which it is used are refused.
    """

    name: str
    label: str
    classes: tuple[Any, ...]
    settings: type[Any] | None = None
    scene_settings: type[Any] | None = None
    extras: tuple[Any, ...] = ()
    overlay: Callable[..., Any] | None = None
    offers: Any = None
    hand_over: str = ""
    page: str = ""
    add_menu: tuple[Any, ...] = ()
    object_menu: tuple[Any, ...] = ()
    pose_menu: tuple[Any, ...] = ()


@dataclass(frozen=True, kw_only=True)
class System(Feature):
    """Declaration of a Feature whose settings, a SystemSettings, are solved while Blender evaluates the scene.

    The owner is the object that has the settings; its members are the objects and bones that the solver drives. A sink is a constraint,
    driver or modifier that brings a result to a member.

    solve: function (context, **inputs) that fills the Context and returns a Problem or None. problems: each Problem that solve() returns.
    inputs: what Blender evaluates before the solver, from core/declare/inputs.py. outputs: names of the numbers that solve() sets.
    channels: function of the settings that returns a subset of {"location", "rotation", "scale"}. members: function of the owner that
    returns the driven objects and bones. member_data: function of the owner that returns one number for each member, or None.
    space: 'WORLD' or the space of a constraint in which solve() gives transforms. is_relative: whether solve() gives moves and turns on
    top of a member's own transform, and applies the influence itself; not used if `groups` are declared (see Member).
    same_bits: whether members have the same matrices, bit by bit, in every version of Blender; only some kinds of sinks allow that.
    lays_pose: whether the members are bones posed by their own transforms, as by keys. Their sinks come before all other constraints, and
    other systems start from the resulting pose, which solve() passes to rigs.lay().
    reads_keys: whether solve() reads keys of other frames, or a function of the settings that says so (core/evaluated/read_keys.py).
    groups: function of the owner that returns Groups, in place of `channels` and `members`. entries: function of the owner that returns an
    Entry for each item in the owner's list of settings. copied_settings, shot_settings: names (core/settings/copied.py). adder: operator
    that sets the system up given `object`, or `object` and `bones`, alone; "" for none. bone_renamed: called with the owner, a rig, and
    the old and the new name of a bone of the rig that the owner drives or reads. moves_points: whether solve() moves the points of the
    owner's mesh, by a modifier; there are no members then. makes_points: Points that solve() makes, by a modifier; None if it makes none.
    dress: called with the owner if Blender has lost what the modifier was given, such as by wiring.set_points_material(). prepare: called
    with the owner before it is wired, to make what its groups need, such as objects that are members of it alone. take_over: called with
    the owner after edits of node groups, undo and loading, to keep what was drawn (core/settings/drawn_curves.py). settle: called with the
    owner after an evaluation in which solve() has set Context.wants_to_settle. rebuild: called with the owner by *Refresh*, in place of
    wiring.refresh(). over_time: called with the owner, a driven object and the scene; returns the object's motion at any times, for
    core/tracks/solved.py, or None. unbakeable: sentence that says why there is nothing to bake, or "". load: function of the settings that
    returns how many things of about equal work solve() may have to compute at once, at most; None if its work needs no limit. All owners
    in a scene share the limit in proportion to it (core/evaluated/shares.py). shared: names of the settings that solve() reads in addition
    to its inputs. If solve() reads nothing else, one solver computes all owners with equal inputs whose settings are not animated, by
    solve_rows: function (context, rows, **inputs) that does for all of them what solve() does for one. rows: of each owner the Row
    (core/wiring/hubs/rows.py), which has its settings; None for a row to be left alone. The context's arrays have an item for each row. It
    returns a tuple with a Problem, an exception or None for each row, and the same tuple again as long as none of them can have changed.
    owner_of: called with an object that may belong to an owner without being driven; returns that owner or None. owner_types: types of the
    objects that can be owners; empty allows all. Settings on an object of a different type have no effect. former_names: {former name:
    present name} of settings that were renamed (core/file/former_names.py).
    """

    solve: Callable[..., Any]
    problems: tuple[Any, ...]
    inputs: tuple[Any, ...] = ()
    outputs: tuple[Any, ...] = ()
    channels: Callable[..., Any] = lambda settings: frozenset[str]({"location", "rotation"})
    members: Callable[..., Any] = lambda owner: [owner]
    member_data: Callable[..., Any] | None = None
    space: str = 'WORLD'
    is_relative: bool = False
    same_bits: bool = False
    lays_pose: bool = False
    reads_keys: bool | Callable[[Any], bool] = False
    groups: Callable[..., Any] | None = None
    entries: Callable[..., Any] | None = None
    bone_renamed: Callable[..., Any] | None = None
    moves_points: bool = False
    makes_points: Points | None = None
    dress: Callable[..., Any] | None = None
    settle: Callable[..., Any] | None = None
    rebuild: Callable[..., Any] | None = None
    prepare: Callable[..., Any] | None = None
    take_over: Callable[..., Any] | None = None
    over_time: Callable[..., Any] | None = None
    unbakeable: str = ""
    load: Callable[[Any], float] | None = None
    shared: tuple[Any, ...] = ()
    solve_rows: Callable[..., Any] | None = None
    copied_settings: tuple[str, ...] = ()
    shot_settings: frozenset[str] = frozenset()
    adder: str = ""
    owner_of: Callable[..., Any] | None = None
    owner_types: frozenset[str] = frozenset()
    former_names: Mapping[str, str] = field(default_factory=dict, hash=False)

    @property
    def has_modifier(self) -> bool:
        """Whether the result reaches the scene by a modifier of the owner, and the system drives no members."""
        return self.moves_points or self.makes_points is not None

    @property
    def reads_several(self) -> bool:
        """Whether the solver waits for objects of a collection, which may change although no setting is edited."""
        return any(isinstance(declared, Geometries) for declared in self.inputs)

    @property
    def reads_mesh(self) -> bool:
        """Whether the solver waits for the owner's own mesh."""
        return any(isinstance(declared, Vertices) for declared in self.inputs)
