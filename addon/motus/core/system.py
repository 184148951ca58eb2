"""What a system declares: its settings, inputs, outputs and solve function. The wiring does the rest."""

from dataclasses import dataclass, field
from typing import Any, Callable, Iterable, Optional

import bpy

from . import scene_time
from .file import choices
from .file.pointers import pointed


@dataclass(frozen=True)
class Problem:
    """A sentence for the artist. A blocking one leaves the driven objects at their own transforms.

    about: what it is about now, such as the name of a setting, for a system that says more than the declared sentence.
    """

    sentence: str
    blocking: bool = True
    about: str = field(default="", compare=False)


OK = None
"""What solve() returns when all is well."""


@dataclass(frozen=True)
class Variable:
    """One driver variable: whose property, and which; or the evaluated transform of an object or its bone."""

    id_type: str
    id: Any
    data_path: str = ""
    bone: str = ""

    @property
    def is_transform(self):
        """Whether it waits for a transform and reads one number of it, which is cheaper than a whole matrix."""
        return not self.data_path


@dataclass(frozen=True)
class Setting:
    """A number, boolean or enum of the owner's settings (an enum arrives as its index)."""

    name: str

    @staticmethod
    def variable(_owner, _settings):
        """None: the solver waits for all settings of the owner at once, and reads them itself."""

    def read(self, _value, settings):
        value = getattr(settings, self.name)
        if isinstance(value, str):
            return choices.number(settings, self.name)
        return value


@dataclass(frozen=True)
class Matrix:
    """World matrix of the object that the pointer setting `of` names; None without it."""

    name: str
    of: str

    def variable(self, owner, settings):
        target = pointed(settings, self.of)
        return target and Variable('OBJECT', target, "matrix_world")

    @staticmethod
    def read(value, _settings):
        # A variable whose target is gone arrives as 0.0.
        return value if hasattr(value, "translation") else None


@dataclass(frozen=True)
class OwnMatrix:
    """World matrix of the owner; None where the boolean setting `when`, if one is named, is off. The owner may not be driven itself."""

    name: str
    when: str = ""

    def variable(self, owner, settings):
        return Variable('OBJECT', owner, "matrix_world") if not self.when or getattr(settings, self.when) else None

    read = staticmethod(Matrix.read)


@dataclass(frozen=True)
class Splines:
    """The splines of the curve object that the pointer setting `of` names; None without it."""

    name: str
    of: str

    def variable(self, owner, settings):
        target = pointed(settings, self.of)
        if target is None or target.type != 'CURVE':
            return None
        return Variable('CURVE', target.data, "splines")

    @staticmethod
    def read(value, _settings):
        return value if hasattr(value, "active") else None


@dataclass(frozen=True)
class Vertices:
    """The evaluated mesh of the owner, as its datablock has it: without shape keys and modifiers; None without it.

    The solver runs again whenever that mesh is edited.
    """

    name: str

    def variable(self, owner, settings):
        return Variable('MESH', owner.data, "vertices") if owner.type == 'MESH' else None

    @staticmethod
    def read(value, _settings):
        return value.id_data if hasattr(value, "id_data") else None


@dataclass(frozen=True)
class Deformed:
    """Makes Blender evaluate the geometry of the object that `of` names first (hooks, shape keys, modifiers).

    The value tells nothing but that the geometry is there: None without it.
    """

    name: str
    of: str

    def objects(self, settings):
        """Those whose geometry comes first, as far as they are there."""
        return [pointed(settings, self.of)]

    def variable(self, owner, settings):
        # A driver cannot depend on another object's geometry, but on the transform of an object that does.
        proxy = pointed(settings, "order_proxy")
        return proxy and Variable('OBJECT', proxy, "matrix_world")

    read = staticmethod(Matrix.read)


@dataclass(frozen=True)
class Geometry(Deformed):
    """The evaluated mesh or curve object that `of` names, once its final geometry is there, modifiers included; None without it.

    The solver runs again whenever that geometry is edited. Not in a system whose owners share solvers (System.shared).
    """

    def read(self, value, settings):
        return pointed(settings, self.of) if Matrix.read(value, settings) is not None else None


@dataclass(frozen=True)
class Geometries(Deformed):
    """The same of the objects that the function `of` gives for settings: wiring.waited_for() has them then."""

    of: Callable  # type: ignore[assignment]

    def objects(self, settings):
        return self.of(settings)


@dataclass(frozen=True)
class Transform:
    """Waits for an object, or a bone of it, to stand where it is evaluated to stand. No argument of solve."""

    object: Any
    bone: str = ""

    def variable(self):
        """The driver variable that waits."""
        return Variable('OBJECT', self.object, bone=self.bone)


@dataclass(frozen=True)
class BonesOwn:
    """Waits for the drivers of a bone's own location, rotation and scale. No argument of solve."""

    object: Any
    bone: str

    def variable(self):
        """The driver variable that waits."""
        return Variable('OBJECT', self.object, f'pose.bones["{bpy.utils.escape_identifier(self.bone)}"].location[0]')


@dataclass(frozen=True)
class Member:
    """An Object or PoseBone that is driven, and how.

    space: of what solve() fills, unless is_relative: then location, rotation and scale act on top of the thing's own, channel by
    channel and in the axes of these; neutral values (no move, no rotation, scale 1) leave it alone.
    """

    thing: Any
    channels: frozenset = frozenset({"location", "rotation"})
    space: str = 'WORLD'
    is_relative: bool = False

    @property
    def owner_space(self):
        """Owner space of the sinks' constraints."""
        if not self.is_relative:
            return self.space
        # The Local Space of an object without a parent is turned as the object is.
        stands_alone = isinstance(self.thing, bpy.types.Object) and self.thing.parent is None
        return 'WORLD' if stands_alone else 'LOCAL'


@dataclass(frozen=True)
class Property:
    """A decimal number that is driven by one of a group's outputs, in the place of its own value and keys.

    path: from the object, as object.path_resolve() takes it, through its data, materials, ...; index: in an array.
    """

    output: str
    object: Any
    path: str
    index: int = -1


@dataclass(frozen=True)
class Group:
    """What one solver computes at once, where a system needs several on one owner.

    key: letters and digits, "" for the first. inputs: Transform and BonesOwn that the solver waits for. outputs: names of
    numbers. properties: driven by outputs, on top of which solve() leaves the influence to the wiring; what solve() does not set
    is the property's own. data: what solve needs to know and is known when wired: strings, numbers, and lists of numbers by name.
    """

    key: str = ""
    members: tuple = ()
    inputs: tuple = ()
    outputs: tuple = ()
    properties: tuple = ()
    data: dict = field(default_factory=dict)

    @property
    def reads(self):
        """(object, bone or "") of the transforms that the solver waits for."""
        return [(one.object, one.bone) for one in dict.fromkeys(self.inputs) if isinstance(one, Transform)]


@dataclass(frozen=True)
class Entry:
    """One of an owner's settings that drives bones of it or objects, for the order among them (core/dependencies.py).

    reads: (object, bone or "") whose evaluated transform it needs. drives: names of the owner's bones, and objects.
    """

    name: str
    reads: tuple = ()
    drives: tuple = ()


@dataclass(frozen=True)
class Points:
    """What a system makes on its owner: points with a position and `attributes`, which are pairs of name and kind.

    kind: 'FLOAT', 'INT', 'VECTOR', 'COLOR', or 'QUATERNION' (w, x, y, z), which before Blender 4.0 arrives as Euler angles.
    Names that Blender knows: the FLOAT "radius" of points and curves; the VECTOR "velocity", in metres a second, of which
    motion blur is made; the INT "id", by which instances on the points are the same from one frame to the next.
    shape: 'POINTS'; 'CURVES', along points that follow each other and have the same INT "curve"; or 'TUBES' around such.
    space: 'WORLD', in which the points stay where they are while the owner moves, or 'LOCAL', the owner's.
    capacity: more points than that there never are.
    unneeded: says of settings which attributes' names there is no need for: points have them neither, nor the time that they
    take. It may depend on settings alone whose change wires anew (settings.rewire).
    """

    attributes: tuple = ()
    shape: str = 'POINTS'
    space: str = 'WORLD'
    capacity: int = 1 << 22
    unneeded: Callable = lambda _settings: ()


@dataclass(frozen=True)
class Feature:
    """What a folder adds to the interface: settings of objects, operators, panels, menus; see docs/systems.md.

    settings: a PropertyGroup that becomes Object.motus.<name>. scene_settings: one that becomes Scene.motus.<name>.
    extras: with register() and unregister() of their own.
    """

    name: str
    label: str
    classes: tuple
    settings: Optional[type] = None
    scene_settings: Optional[type] = None
    extras: tuple = ()
    overlay: Optional[Callable] = None
    add_menu: tuple = ()
    object_menu: tuple = ()
    pose_menu: tuple = ()


@dataclass(frozen=True, kw_only=True)
class System(Feature):
    """A Feature whose settings, SystemSettings, are solved while Blender evaluates the scene.

    moves_points: the solver moves the points of the owner's mesh, by a modifier, and has no members. makes_points: the solver
    makes these, by a modifier too. dress: called with the owner where Blender has lost what the modifier was given by
    wiring.set_points_material() and the like. unbakeable: a sentence that says why there is nothing to bake. settle: called after an
    evaluation in which solve() has asked for it (Context.wants_to_settle), with the owner. over_time: called with the owner,
    a driven object and the scene; gives what core/tracks/solved.py asks of it, or None. bone_renamed: called with the owner,
    a rig, and the old and the new name of a bone of it that the owner drives or reads. shared: names of the settings that
    solve() reads beside its inputs; if it reads nothing else, owners with the same inputs are solved by one solver as long as
    their settings are still. is_relative: of the members, where no groups are declared: see Member; solve() applies the
    influence then. same_bits: the members have the same matrices in every Blender, to the last bit, by sinks that all Blenders
    have. lays_pose: its members, bones of the owner, are posed by their own transforms alone, as keys pose them: its sinks come
    before all other constraints, and all other systems start from what it makes of the bones, which solve() tells rigs.lay().
    reads_keys: its solver reads keys of other frames, and is called again when these are edited (core/read_keys.py). entry_settings: names of
    the settings of a bone's entry that *To All Selected* copies (core/bone_entries.py). owner_of: called with an object
    that may belong to an owner without being driven; gives that owner or None. owner_types: types of objects that can be owners, all
    if there are none; settings that a script has given to an object of another type count for nothing.
    """

    solve: Callable
    problems: tuple
    inputs: tuple = ()
    outputs: tuple = ()
    channels: Callable = lambda settings: frozenset({"location", "rotation"})
    members: Callable = lambda owner: [owner]
    member_data: Optional[Callable] = None
    space: str = 'WORLD'
    is_relative: bool = False
    same_bits: bool = False
    lays_pose: bool = False
    reads_keys: bool = False
    groups: Optional[Callable] = None
    entries: Optional[Callable] = None
    bone_renamed: Optional[Callable] = None
    moves_points: bool = False
    makes_points: Optional[Points] = None
    dress: Optional[Callable] = None
    settle: Optional[Callable] = None
    over_time: Optional[Callable] = None
    unbakeable: str = ""
    shared: tuple = ()
    entry_settings: tuple = ()
    owner_of: Optional[Callable] = None
    owner_types: frozenset = frozenset()

    @property
    def has_modifier(self):
        """Whether its sink is a modifier of the owner, and it drives no members."""
        return self.moves_points or self.makes_points is not None

    @property
    def reads_several(self):
        """Whether its solver waits for objects that may come and go without its settings being edited."""
        return any(isinstance(declared, Geometries) for declared in self.inputs)

    @property
    def reads_mesh(self):
        """Whether its solver waits for the mesh that the owner has."""
        return any(isinstance(declared, Vertices) for declared in self.inputs)


@dataclass
class Context:
    """What solve() reads beyond its declared inputs, and what it fills; see docs/systems.md.

    common: kept by solve() itself for all owners that are solved at once, from the same inputs at the same frame.
    points(count): arrays for so many points by the names of their attributes, of a system that makes points. All of them are
    to be filled; they are shorter where there is no room for so many, and Blender's own memory, valid until solve() returns.
    """

    settings: Any
    owner: Any
    frame: float = 0.0
    depsgraph: Any = None
    locations: Any = None
    rotations: Any = None
    scales: Any = None
    outputs: Any = field(default_factory=list)
    member_data: Any = None
    group: str = ""
    data: Any = field(default_factory=dict)
    offsets: Any = None
    points: Any = None
    wants_to_settle: bool = False
    memo: Any = None
    targets: Any = None
    common: dict = field(default_factory=dict)

    def begin(self, frame, depsgraph, memo, common=None, targets=None):
        """Go to a frame."""
        self.frame, self.depsgraph, self.memo, self.targets = frame, depsgraph, memo, targets
        self.common = {} if common is None else common
        self.wants_to_settle = False

    def target(self, name):
        """The evaluated object that a pointer setting names."""
        return pointed(self.settings, name) if self.targets is None else self.targets[name]

    @property
    def is_still(self):
        """Whether nothing animates the settings: they are the same until somebody edits them."""
        return self.memo is not None

    def kept(self, name, key, make):
        """What `make()` gives, which depends on settings and `key` alone; where they are still it is made once for a key."""
        if self.memo is None:
            return make()
        found = self.memo.get(name)
        if found is None or found[0] != key:
            found = self.memo[name] = key, make()
        return found[1]

    @property
    def fps(self):
        """Frames a second."""
        found = self.common.get("fps")
        if found is None:
            found = self.common["fps"] = scene_time.fps(self.depsgraph.scene)
        return found


registered = {}
"""The registered features by name, systems among them."""


def systems():
    """The registered systems: of all features those that are solved."""
    return [feature for feature in registered.values() if isinstance(feature, System)]


def of_owner(system, owner):
    """Settings of `system` on an object."""
    return getattr(owner.motus, system.name)


def has_settings(system, obj):
    """Whether an object has settings of the system; to ask it for them gives it some."""
    return obj.is_property_set("motus") and obj.motus.is_property_set(system.name)


def is_owner(system, obj):
    """Whether the system is wired on an object as its owner (members of others' are not)."""
    return has_settings(system, obj) and can_own(system, obj) and of_owner(system, obj).is_active


def can_own(system, obj):
    """Whether an object is of a type that the system works on."""
    return not system.owner_types or obj.type in system.owner_types


def leader_of(system, obj):
    """The object whose settings of the system drive this one; None where it has its own, or none."""
    return pointed(of_owner(system, obj), "leader") if has_settings(system, obj) else None


def groups_of(system, owner) -> tuple:
    """The groups of members that the system drives for an owner: one, where the system declares none."""
    if not can_own(system, owner):
        return ()
    if system.groups is not None:
        return tuple(system.groups(owner))
    if system.has_modifier:
        return (Group(outputs=system.outputs),)
    channels = system.channels(of_owner(system, owner))
    members = tuple(Member(thing, channels, system.space, system.is_relative) for thing in system.members(owner))
    return (Group(members=members, outputs=system.outputs),)


def input_variables(system, owner) -> Iterable:
    """(input, Variable or None) for each declared input that is an argument of solve."""
    settings = of_owner(system, owner)
    return [(declared, declared.variable(owner, settings)) for declared in system.inputs]


def described(system):
    """The SystemPanels (core/panels.py) that the classes of a system are of."""
    found = (getattr(cls, "of_system", None) for cls in system.classes)
    return list(dict.fromkeys(one for one in found if one is not None))


def title(system):
    """(label, context of its translation) under which a system stands in menus, panels and dialogs."""
    panel = next(iter(described(system)), None)
    return (panel.label, panel.translation_context) if panel and panel.label == system.label else (system.label, "*")
