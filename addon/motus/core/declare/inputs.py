"""Declarations of a solver's inputs: values that Blender evaluates before it calls the solver, and transforms that the solver waits for.

A solver is called by a scripted driver. `variable(owner, settings)` of an input returns the variable of that driver, by which the
dependency graph knows the order; `read(value, settings)` turns the variable's value into the argument of solve(). owner: object whose
settings are solved. settings: property group of the system on it.
"""

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

    id_type, id, data_path: of the DriverTarget. If data_path is "", the variable reads the transform of the object `id`, or of its bone.
    bone: name of the bone, or "".
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
    """Input: a number, boolean or enum property of the settings; solve() gets the number of an enum's item. name: of the property."""

    name: str

    @staticmethod
    def variable(_owner: Any, _settings: Any) -> None:
        """None, since the solver waits for all settings of the owner by one common variable, and reads them itself."""

    def read(self, _value: Any, settings: Any) -> Any:
        value = getattr(settings, self.name)
        if isinstance(value, str):
            return choices.number(settings, self.name)
        return value


@dataclass(frozen=True)
class Matrix:
    """Input: world matrix of the object to which the pointer property `of` of the settings points; None if it points to none."""

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
    """Input: world matrix of the owner, the object whose settings are solved. It must not be driven by the solver itself.

    when: name of a boolean setting; if it is off, the input is None and the solver does not wait. "" always reads the matrix.
    """

    name: str
    when: str = ""

    def variable(self, owner: Any, settings: Any) -> Variable | None:
        return Variable('OBJECT', owner, "matrix_world") if not self.when or getattr(settings, self.when) else None

    read = staticmethod(Matrix.read)


@dataclass(frozen=True)
class Splines:
    """Input: the splines of the curve object to which the pointer property `of` of the settings points; None if it points to none."""

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
    """Input: the evaluated Mesh of the owner, with the points of the datablock, before shape keys and modifiers; None if it is no mesh.

    Blender calls the solver again whenever the mesh is edited.
    """

    name: str

    def variable(self, owner: Any, settings: Any) -> Variable | None:
        return Variable('MESH', owner.data, "vertices") if owner.type == 'MESH' else None

    @staticmethod
    def read(value: Any, _settings: Any) -> Any:
        return value.id_data if hasattr(value, "id_data") else None


@dataclass(frozen=True)
class Deformed:
    """Input by which Blender evaluates the geometry (hooks, shape keys, modifiers) of the object in the setting `of` before the solver.

    The argument of solve() is not the geometry: it is None if there is no such geometry, and a matrix without meaning otherwise.
    """

    name: str
    of: str

    def objects(self, settings: Any) -> list[Any]:
        """Objects whose geometry is evaluated before the solver; None in the place of one that is missing."""
        return [pointed(settings, self.of)]

    def variable(self, owner: Any, settings: Any) -> Variable | None:
        # A driver cannot depend on another object's geometry, but on the transform of an object that does.
        proxy = pointed(settings, "order_proxy")
        return proxy and Variable('OBJECT', proxy, "matrix_world")

    read = staticmethod(Matrix.read)


@dataclass(frozen=True)
class Geometry(Deformed):
    """Input: the mesh or curve object in the setting `of`, with its geometry evaluated, modifiers included; None if there is none.

    Blender calls the solver again whenever that geometry is edited. Not allowed in a system whose owners share solvers (System.shared).
    """

    def read(self, value: Any, settings: Any) -> Any:
        return pointed(settings, self.of) if Matrix.read(value, settings) is not None else None


@dataclass(frozen=True)
class Geometries(Deformed):
    """Input by which Blender evaluates the geometry of several objects before the solver, which reads them by wiring.waited_for().

    of: function of the settings that returns the objects.
    """

    of: Callable[[Any], list[Any]]  # type: ignore[assignment]

    def objects(self, settings: Any) -> list[Any]:
        return self.of(settings)


@dataclass(frozen=True)
class Transform:
    """Input of a Group: Blender calls the solver after it has evaluated the transform of an object, or of one of its bones.

    bone: name of the bone, or "". The transform is no argument of solve(), which reads it from the evaluated object.
    """

    object: Any
    bone: str = ""

    def variable(self) -> Variable:
        """Driver variable that makes the solver wait for the evaluated transform of the object or bone."""
        return Variable('OBJECT', self.object, bone=self.bone)


@dataclass(frozen=True)
class BonesOwn:
    """Input of a Group: Blender calls the solver after the drivers of a pose bone's own location, rotation and scale.

    object, bone: the rig, and the name of its bone. The input is no argument of solve().
    """

    object: Any
    bone: str

    def variable(self) -> Variable:
        """Driver variable that makes the solver wait for the drivers of the bone's channels."""
        return Variable('OBJECT', self.object, f'pose.bones["{bpy.utils.escape_identifier(self.bone)}"].location[0]')
