"""Rows: what a solver that computes several owners knows of each of them, as texts on the mesh of the hub that the owners share.

If the solver of a shared hub read the settings of the owners, the solver would have to wait for every owner. To avoid this, each row holds,
as a text in a custom property of the mesh, the settings that solve() reads and the owner's name. The text is written whenever the settings
are edited. The objects that the owners' settings point to are the same for all rows, and are in custom properties of the mesh too.
"""

import json
import math
from types import SimpleNamespace
from typing import Any, NamedTuple

import bpy

from ... import keeping
from ...declare import Setting, of_owner
from ...file import stored
from ...file.pointers import pointed
from ...file.stored import Damaged
from ...lazy import numpy as np

_known = keeping.OfFile(
    "parsed rows of hubs that several owners share (Row), or Damaged", "name of the system, and text of the row", most=4096
)


class Row(NamedTuple):
    """What the solver of a shared hub knows of one owner, parsed from the text of the owner's row.

    name: the owner's name. settings: namespace with the settings listed in System.shared. inputs: {name: value} of the inputs that are
    settings. member_data: array of the numbers that System.member_data has returned for the owner, or None. memo: dictionary in which
    Context.kept keeps values from one solve to the next, until the row's text changes.
    """

    name: str
    settings: Any
    inputs: dict
    member_data: Any
    memo: dict


def key(system, row):
    """Return the name of the custom property of a shared hub's mesh that holds the text of a row. row: index of the row."""
    return f"motus_{system.name}_row_{row}"


def pack(system, owner):
    """Return the text (JSON) for an owner's row of a shared hub, with its name and settings; None if a number in them is not finite."""
    settings = of_owner(system, owner)
    said = {
        "name": owner.name,
        "settings": _values(settings, system.shared),
        "inputs": {one.name: one.read(0.0, settings) for one in system.inputs if isinstance(one, Setting)},
        "member_data": None if system.member_data is None else list(map(float, system.member_data(owner))),
    }
    try:
        return json.dumps(said, allow_nan=False)
    except ValueError:
        return None


def _values(group, names):
    found = {}
    for name in names:
        value = getattr(group, name)
        if group.bl_rna.properties[name].type == 'COLLECTION':
            value = [_values(item, _plain(item)) for item in value]
        found[name] = value
    return found


def _plain(group):
    return [prop.identifier for prop in group.bl_rna.properties if prop.type in _FORMS or prop.type == 'ENUM']


def row(system, mesh, index):
    """Return the Row with this index, parsed from the text on a shared hub's mesh.

    Returns None if no owner has the row, or the class Damaged if the text does not have the form that pack() gives it.
    """
    text = mesh.get(key(system, index))
    if text is None:
        return None
    return _known.made((system.name, text), lambda: _parsed(system, text)) if isinstance(text, str) else Damaged


def _parsed(system, text):
    rna, inputs = system.settings.bl_rna, [one.name for one in system.inputs if isinstance(one, Setting)]
    form = {
        "name": str,
        "settings": lambda value: _fits(rna, system.shared, value, may_lack=True),
        "inputs": lambda value: _fits(rna, inputs, value, may_lack=True),
        "member_data": lambda value: value is None or stored.fits(value, [float]),
    }
    try:
        said = stored.parse(text, form)
    except Damaged:
        return Damaged
    data = said["member_data"]
    settings = _completed(rna, system.shared, said["settings"])
    return Row(said["name"], _namespace(settings), _completed(rna, inputs, said["inputs"]), None if data is None else np.array(data), {})


def _is_float(value):
    # Of a setting that is infinite, which Blender stores as a large number, solve() tells; the row is not damaged by it.
    return stored.fits(value, float) or (type(value) is float and math.isfinite(value))


_FORMS = {
    'FLOAT': _is_float,
    'INT': lambda value: type(value) is int and abs(value) <= stored.LARGEST_NUMBER,
    'BOOLEAN': bool,
    'STRING': str,
}


def _completed(rna, names, values):
    """Return {name: value} of all these settings: those that the text of an earlier version does not know have their defaults."""
    return {name: values[name] if name in values else _default(rna.properties[name]) for name in names}


def _default(prop):
    return [] if prop.type == 'COLLECTION' else prop.default


def _fits(rna, names, value, may_lack=False):
    """Whether a parsed value is a dictionary of exactly these settings, each with a value of its declared type.

    rna: bl_rna of the PropertyGroup that declares the settings. names: identifiers of the settings. may_lack: whether settings may be missing.
    """
    return (
        isinstance(value, dict)
        and (value.keys() <= set(names) if may_lack else value.keys() == set(names))
        and all(_fits_property(rna.properties[name], one) for name, one in value.items())
    )


def _fits_property(prop, value):
    if prop.type == 'ENUM':
        return value in prop.enum_items.keys()
    if prop.type == 'COLLECTION':
        names = [one.identifier for one in prop.fixed_type.properties if one.type in _FORMS or one.type == 'ENUM']
        return isinstance(value, list) and all(_fits(prop.fixed_type, names, one) for one in value)
    return stored.fits(value, _FORMS[prop.type])


def _namespace(values):
    return SimpleNamespace(
        **{name: [_namespace(one) for one in value] if isinstance(value, list) else value for name, value in values.items()}
    )


def names_in(rows):
    """Return the names of the owners in a list of Rows of a shared hub. Items None or Damaged, in place of a Row, are left out."""
    return [row.name for row in rows if isinstance(row, Row)]


def pointers(system, owner):
    """Return {name of a setting: object} for those pointer settings of an owner that the system's inputs read and that are set."""
    settings = of_owner(system, owner)
    found = {one.of: pointed(settings, one.of) for one in system.inputs if hasattr(one, "of")}
    return {name: target for name, target in found.items() if target}


def pointer_names(system):
    """Return {name of a setting: name of a custom property} for the pointer settings that the system's inputs read.

    The custom property, on a shared hub's mesh, holds the object to which the setting points.
    """
    return {one.of: target_key(one.of) for one in system.inputs if hasattr(one, "of")}


def targets(names, mesh):
    """Return {name of a setting: object or None} for the pointer settings that the inputs read, from a shared hub's mesh.

    names: result of pointer_names(). On an evaluated mesh the objects are evaluated copies. Raises Damaged if a stored value is no object.
    """
    found = {name: mesh.get(key) for name, key in names.items()}
    for target in found.values():
        if not isinstance(target, (bpy.types.Object, type(None))):
            raise Damaged("no object")
    return found


def target_key(name):
    """Return the name of the custom property, on a shared hub's mesh, that holds the object to which a setting points.

    name: name of the pointer setting.
    """
    return f"motus_of_{name}"
