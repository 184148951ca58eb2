"""What a folder declares: its interface (Feature), and how its settings are solved (System). The wiring does the rest."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from .inputs import Geometries, Vertices
from .members import Points


@dataclass(frozen=True)
class Feature:
    """What a folder adds to the interface: settings of objects, operators, panels, menus; see docs/systems.md.

    settings: a PropertyGroup that becomes Object.motus.<name>. scene_settings: one that becomes Scene.motus.<name>.
    offers: a module or object with what other systems may call, which they have by registry.offered().
    extras: with register() and unregister() of their own.
    """

    name: str
    label: str
    classes: tuple[Any, ...]
    settings: type[Any] | None = None
    scene_settings: type[Any] | None = None
    extras: tuple[Any, ...] = ()
    overlay: Callable[..., Any] | None = None
    offers: Any = None
    add_menu: tuple[Any, ...] = ()
    object_menu: tuple[Any, ...] = ()
    pose_menu: tuple[Any, ...] = ()


@dataclass(frozen=True, kw_only=True)
class System(Feature):
    """A Feature whose settings, SystemSettings, are solved while Blender evaluates the scene.

    moves_points: the solver moves the points of the owner's mesh, by a modifier, and has no members. makes_points: the solver
    makes these, by a modifier too. dress: called with the owner where Blender has lost what the modifier was given by
    wiring.set_points_material() and the like. unbakeable: a sentence that says why there is nothing to bake. settle: called after an
    evaluation in which solve() has asked for it (Context.wants_to_settle), with the owner. rebuild: called with the owner by *Refresh*,
    in place of wiring.refresh(). over_time: called with the owner, a driven object
    and the scene; gives what core/tracks/solved.py asks of it, or None. bone_renamed: called with the owner,
    a rig, and the old and the new name of a bone of it that the owner drives or reads. shared: names of the settings that
    solve() reads beside its inputs; if it reads nothing else, owners with the same inputs are solved by one solver as long as
    their settings are still. is_relative: of the members, where no groups are declared: see Member; solve() applies the
    influence then. same_bits: the members have the same matrices in every Blender, to the last bit, by sinks that all Blenders
    have. lays_pose: its members, bones of the owner, are posed by their own transforms alone, as keys pose them: its sinks come
    before all other constraints, and all other systems start from what it makes of the bones, which solve() tells rigs.lay().
    reads_keys: its solver reads keys of other frames, and is called again when these are edited (core/evaluated/read_keys.py). entry_settings: names of
    the settings of a bone's entry that *To All Selected* copies (core/interface/bone_entries.py). owner_of: called with an object
    that may belong to an owner without being driven; gives that owner or None. owner_types: types of objects that can be owners, all
    if there are none; settings that a script has given to an object of another type count for nothing.
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
    reads_keys: bool = False
    groups: Callable[..., Any] | None = None
    entries: Callable[..., Any] | None = None
    bone_renamed: Callable[..., Any] | None = None
    moves_points: bool = False
    makes_points: Points | None = None
    dress: Callable[..., Any] | None = None
    settle: Callable[..., Any] | None = None
    rebuild: Callable[..., Any] | None = None
    over_time: Callable[..., Any] | None = None
    unbakeable: str = ""
    shared: tuple[Any, ...] = ()
    entry_settings: tuple[Any, ...] = ()
    owner_of: Callable[..., Any] | None = None
    owner_types: frozenset[str] = frozenset()
    former_names: Mapping[str, str] = field(default_factory=dict)

    @property
    def has_modifier(self) -> bool:
        """Whether its sink is a modifier of the owner, and it drives no members."""
        return self.moves_points or self.makes_points is not None

    @property
    def reads_several(self) -> bool:
        """Whether its solver waits for objects that may come and go without its settings being edited."""
        return any(isinstance(declared, Geometries) for declared in self.inputs)

    @property
    def reads_mesh(self) -> bool:
        """Whether its solver waits for the mesh that the owner has."""
        return any(isinstance(declared, Vertices) for declared in self.inputs)
