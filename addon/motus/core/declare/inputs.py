"""What a solver reads: values that Blender evaluates before the solver, and transforms that the solver waits for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import bpy

from ..file import choices
from ..file.pointers import pointed


@dataclass(frozen=True)
class Variable:
    """Description of a driver variable: a property of a datablock, or the evaluated transform of an object or bone.

    id_type, id, data_path: as those of a DriverTarget. Without data_path the variable reads the transform of the object or its bone.
    """

    id_type: str
    id: Any
    data_path: str = ""
    bone: str = ""

    @property
    def is_transform(self) -> bool:
        """Whether the variable reads a transform channel of an object or bone; reading one float is cheaper than a whole matrix."""
        return not self.data_path


@dataclass(frozen=True)
class Setting:
    """A number, boolean or enum of the owner's settings (an enum arrives as its index)."""

    name: str

    @staticmethod
    def variable(_owner: Any, _settings: Any) -> None:
        """None: the solver waits for all settings of the owner at once, and reads them itself."""

    def read(self, _value: Any, settings: Any) -> Any:
        value = getattr(settings, self.name)
        if isinstance(value, str):
            return choices.number(settings, self.name)
        return value


@dataclass(frozen=True)
class Matrix:
    """World matrix of the object that the pointer setting `of` names; None without it."""

    name: str
    of: str

    def variable(self, owner: Any, settings: Any) -> Variable | None:
        target = pointed(settings, self.of)
        return target and Variable('OBJECT', target, "matrix_world")

    @staticmethod
    def read(value: Any, _settings: Any) -> Any:
        # A variable whose target is gone arrives as 0.0.
        return value if hasattr(value, "translation") else None


@dataclass(frozen=True)
class OwnMatrix:
    """World matrix of the owner; None where the boolean setting `when`, if one is named, is off. The owner may not be driven itself."""

    name: str
    when: str = ""

    def variable(self, owner: Any, settings: Any) -> Variable | None:
        return Variable('OBJECT', owner, "matrix_world") if not self.when or getattr(settings, self.when) else None

    read = staticmethod(Matrix.read)


@dataclass(frozen=True)
class Splines:
    """The splines of the curve object that the pointer setting `of` names; None without it."""

    name: str
    of: str

    def variable(self, owner: Any, settings: Any) -> Variable | None:
        target = pointed(settings, self.of)
        if target is None or target.type != 'CURVE':
            return None
        return Variable('CURVE', target.data, "splines")

    @staticmethod
    def read(value: Any, _settings: Any) -> Any:
        return value if hasattr(value, "active") else None


@dataclass(frozen=True)
class Vertices:
    """The evaluated mesh of the owner, as its datablock has it: without shape keys and modifiers; None without it.

    The solver runs again whenever that mesh is edited.
    """

    name: str

    def variable(self, owner: Any, settings: Any) -> Variable | None:
        return Variable('MESH', owner.data, "vertices") if owner.type == 'MESH' else None

    @staticmethod
    def read(value: Any, _settings: Any) -> Any:
        return value.id_data if hasattr(value, "id_data") else None


@dataclass(frozen=True)
class Deformed:
    """Makes Blender evaluate the geometry (hooks, shape keys, modifiers) of the object that setting `of` points to before the solver.

    The input's value is not the geometry: it is None if there is no such geometry, and a matrix without meaning otherwise.
    """

    name: str
    of: str

    def objects(self, settings: Any) -> list[Any]:
        """The objects whose geometry is evaluated first, as far as they exist."""
        return [pointed(settings, self.of)]

    def variable(self, owner: Any, settings: Any) -> Variable | None:
        # A driver cannot depend on another object's geometry, but on the transform of an object that does.
        proxy = pointed(settings, "order_proxy")
        return proxy and Variable('OBJECT', proxy, "matrix_world")

    read = staticmethod(Matrix.read)


@dataclass(frozen=True)
class Geometry(Deformed):
    """The evaluated mesh or curve object that `of` names, once its final geometry is there, modifiers included; None without it.

    The solver runs again whenever that geometry is edited. Not in a system whose owners share solvers (System.shared).
    """

    def read(self, value: Any, settings: Any) -> Any:
        return pointed(settings, self.of) if Matrix.read(value, settings) is not None else None


@dataclass(frozen=True)
class Geometries(Deformed):
    """Evaluates the geometry of several objects first. `of(settings)` returns them; read them with wiring.waited_for()."""

    of: Callable[[Any], list[Any]]  # type: ignore[assignment]

    def objects(self, settings: Any) -> list[Any]:
        return self.of(settings)


@dataclass(frozen=True)
class Transform:
    """Makes the solver run after Blender has evaluated the transform of an object, or of a bone of it. It is not passed to solve()."""

    object: Any
    bone: str = ""

    def variable(self) -> Variable:
        """Driver variable that makes the solver wait for the evaluated transform of the object or bone."""
        return Variable('OBJECT', self.object, bone=self.bone)


@dataclass(frozen=True)
class BonesOwn:
    """Waits for the drivers of a bone's own location, rotation and scale. No argument of solve."""

    object: Any
    bone: str

    def variable(self) -> Variable:
        """The driver variable that waits."""
        return Variable('OBJECT', self.object, f'pose.bones["{bpy.utils.escape_identifier(self.bone)}"].location[0]')
