"""What a system declares: its settings, inputs, outputs and solve function. The wiring does the rest."""

from dataclasses import dataclass, field
from typing import Any, Callable, Iterable, Optional

import bpy


@dataclass(frozen=True)
class Problem:
    """A sentence for the artist. A blocking one leaves the driven objects at their own transforms."""

    sentence: str
    blocking: bool = True


OK = None
"""What solve() returns when all is well."""


@dataclass(frozen=True)
class Variable:
    """One single-property driver variable: whose property, and which."""

    id_type: str
    id: Any
    data_path: str


@dataclass(frozen=True)
class Setting:
    """A number, boolean or enum of the owner's settings (an enum arrives as its index)."""

    name: str

    def variable(self, owner, settings):
        return Variable('OBJECT', owner, f"{settings.path_from_id()}.{self.name}")

    def read(self, _value, settings):
        # Not the variable's value: where the owner carries the solver there is none (see wiring.attach).
        value = getattr(settings, self.name)
        if isinstance(value, str):
            return settings.bl_rna.properties[self.name].enum_items[value].value
        return value


@dataclass(frozen=True)
class Matrix:
    """World matrix of the object that the pointer setting `of` names; None without it."""

    name: str
    of: str

    def variable(self, owner, settings):
        target = getattr(settings, self.of)
        return target and Variable('OBJECT', target, "matrix_world")

    @staticmethod
    def read(value, _settings):
        # A variable whose target is gone arrives as 0.0.
        return value if hasattr(value, "translation") else None


@dataclass(frozen=True)
class Splines:
    """The splines of the curve object that the pointer setting `of` names; None without it."""

    name: str
    of: str

    def variable(self, owner, settings):
        target = getattr(settings, self.of)
        if target is None or target.type != 'CURVE':
            return None
        return Variable('CURVE', target.data, "splines")

    @staticmethod
    def read(value, _settings):
        return value if hasattr(value, "active") else None


@dataclass(frozen=True)
class Deformed:
    """Makes Blender evaluate the geometry of the object that `of` names first (hooks, shape keys, modifiers).

    The value tells nothing but that the geometry is there: None without it.
    """

    name: str
    of: str

    def variable(self, owner, settings):
        # A driver cannot depend on another object's geometry, but on the transform of an object that does.
        return settings.order_proxy and Variable('OBJECT', settings.order_proxy, "matrix_world")

    read = staticmethod(Matrix.read)


@dataclass(frozen=True)
class System:
    """One system; see docs/architecture.md."""

    name: str
    label: str
    settings: type
    classes: tuple
    inputs: tuple
    solve: Callable
    problems: tuple
    outputs: tuple = ()
    channels: Callable = lambda settings: frozenset({"location", "rotation"})
    members: Callable = lambda owner: [owner]
    member_data: Optional[Callable] = None
    space: str = 'WORLD'
    overlay: Optional[Callable] = None
    add_menu: tuple = ()
    object_menu: tuple = ()


@dataclass
class Context:
    """What solve() reads beyond its declared inputs, and what it fills; see docs/architecture.md."""

    settings: Any
    owner: Any
    frame: float
    depsgraph: Any
    locations: Any
    rotations: Any
    outputs: Any = field(default_factory=list)
    member_data: Any = None

    @property
    def fps(self):
        render = self.depsgraph.scene.render
        return render.fps / render.fps_base


registered = {}
"""The registered systems by name."""


class SystemSettings:
    """Mixin for every system's PropertyGroup: what the wiring itself keeps with the owner."""

    is_active: bpy.props.BoolProperty(
        name="Active", description="This system drives the object", options=set(),
        override={'LIBRARY_OVERRIDABLE'})
    is_baked: bpy.props.BoolProperty(
        name="Baked", description="The motion stands in keyframes and the live set-up is switched off", options=set(),
        override={'LIBRARY_OVERRIDABLE'})
    hub: bpy.props.PointerProperty(
        type=bpy.types.Object, name="Hub", description="Hidden object that computes for all members")
    order_proxy: bpy.props.PointerProperty(
        type=bpy.types.Object, name="Order Proxy",
        description="Hidden object that lets the curve's deformation be evaluated first")
    leader: bpy.props.PointerProperty(
        type=bpy.types.Object, name="Leader", description="Object whose settings drive this one")
    use_direct_drivers: bpy.props.BoolProperty(
        name="Direct Drivers",
        description="Compute in every driver by itself instead of once: slower, but without an outbox",
        options=set(), update=lambda settings, context: rewire(settings, context))


def _system_of(settings):
    return registered[settings.path_from_id().rpartition(".")[2]]


def rewire(settings, _context):
    """`update` of a property whose change needs other drivers or sinks (targets, members, channels)."""
    from . import wiring
    if settings.is_active:
        wiring.refresh(_system_of(settings), settings.id_data)


def touch(settings, _context):
    """`update` of a property whose change only needs a new evaluation."""
    from . import wiring
    if settings.is_active:
        wiring.touch(_system_of(settings), settings.id_data)


def of_owner(system, owner):
    """Settings of `system` on an object."""
    return getattr(owner.motus, system.name)


def input_variables(system, owner) -> Iterable:
    """(input, Variable or None) for each declared input."""
    settings = of_owner(system, owner)
    return [(declared, declared.variable(owner, settings)) for declared in system.inputs]
