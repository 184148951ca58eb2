"""How operators name a datablock of any type, and one of its properties."""

import re
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import bpy

from ..refusals import Refused
from ..translations import tr


class OfADatablock:
    """Mixin of an operator: the keywords that name a property of a datablock."""

    datablock: bpy.props.StringProperty(
        name="Datablock", description="Name of the object or other datablock; empty takes the active object", options={'SKIP_SAVE'}
    )
    collection: bpy.props.StringProperty(
        name="Collection",
        description="Collection of the file that the datablock is in, such as materials",
        default="objects",
        options={'SKIP_SAVE'},
    )
    data_path: bpy.props.StringProperty(name="Data Path", description="Path of a property from the datablock", options={'SKIP_SAVE'})
    index: bpy.props.IntProperty(
        name="Index",
        description="Index of a number in an array property; -1 for a property that is no array, or all",
        default=-1,
        min=-1,
        options={'SKIP_SAVE'},
    )

    def id_data(self, context: Any) -> Any:
        """Datablock that the operator's keywords `datablock` and `collection` name; the active object if `datablock` is empty.

        Raises Refused if there is no such datablock.
        """
        if not self.datablock:
            if context.object is None:
                raise Refused(tr("Select an object, or name one"))
            return context.object
        listed = bpy.data.bl_rna.properties.get(self.collection)
        found = getattr(bpy.data, self.collection).get(self.datablock) if listed and listed.type == 'COLLECTION' else None
        if found is None:
            raise Refused(tr("There is no {object} in {collection}").format(object=self.datablock, collection=self.collection))
        return found


class Named(NamedTuple):
    """An Object, or a bone of it by its name, "" for the object itself: for what is kept while scripts may run.

    Of an object that is gone Python's reference raises ReferenceError; a reference to a PoseBone would be to freed memory.
    """

    object: Any
    bone: str

    @classmethod
    def of(cls, thing: Any) -> "Named":
        """Make the reference to an Object or PoseBone that stays safe if the thing is removed: its object, and its bone's name."""
        return cls(thing.id_data, thing.name if isinstance(thing, bpy.types.PoseBone) else "")

    @property
    def thing(self) -> Any:
        """The Object or PoseBone. Raises ReferenceError where it is gone."""
        if not self.bone:
            return self.object
        found = self.object.pose.bones.get(self.bone)
        if found is None:
            raise ReferenceError(f"{self.object.name} has no bone {self.bone} any more")
        return found


def _collections() -> list[Any]:
    """The file's collections of datablocks, each of one type; 5.2's collection of all datablocks is left out."""
    properties: Any = bpy.data.bl_rna.properties
    return [prop for prop in properties if prop.type == 'COLLECTION' and prop.fixed_type.identifier != 'ID']


def everything() -> Iterator[Any]:
    """All datablocks of the file, and the node trees that lie within others."""
    for collection in _collections():
        for datablock in getattr(bpy.data, collection.identifier):
            yield datablock
            tree = getattr(datablock, "node_tree", None)
            if tree is not None and tree.is_embedded_data:
                yield tree


def collection_of(datablock: Any) -> str:
    """Name of the file's collection that a datablock stands in."""
    for prop in _collections():
        if isinstance(datablock, getattr(bpy.types, prop.fixed_type.identifier)):
            return prop.identifier
    raise ValueError(f"{datablock!r} stands in no collection")


_ID_TYPES = {
    "LIGHTPROBE": 'LIGHT_PROBE',
    "METABALL": 'META',
    "VECTORFONT": 'FONT',
    "FREESTYLELINESTYLE": 'LINESTYLE',
    "PARTICLESETTINGS": 'PARTICLE',
}


def id_type(datablock: Any) -> str:
    """Type of a datablock, as targets of drivers' variables name it."""
    kind = next(one for one in type(datablock).__mro__ if one.__base__ is bpy.types.ID)
    name = kind.__name__.upper()
    return _ID_TYPES.get(name, name)


def named_by(datablock: Any, path: str) -> tuple[Any, str]:
    """A datablock that can be found by its name, and the path from there: node trees lie within others."""
    if not isinstance(datablock, bpy.types.NodeTree) or not datablock.is_embedded_data:
        return datablock, path
    for prop in _collections():
        for one in getattr(bpy.data, prop.identifier):
            if getattr(one, "node_tree", None) == datablock:
                return one, f"node_tree.{path}"
    return datablock, path


def label_of(id_data: Any, data_path: str, index: int = -1) -> str:
    """Name of a property in the interface, in the user's language; the data path if it has no name.

    index: in an array, -1 for a property that is none.
    """
    custom = _CUSTOM.search(data_path)
    if custom:
        name = bpy.utils.unescape_identifier(custom["name"])
        return name if index < 0 else f"{name} {index}"
    owner, _, name = data_path.rpartition(".")
    try:
        struct = id_data.path_resolve(owner) if owner else id_data
        declared = struct.bl_rna.properties[name]
    except (ValueError, KeyError, AttributeError):
        return data_path if index < 0 else f"{data_path}[{index}]"
    label = bpy.app.translations.pgettext_iface(_SHOWN.get(name, declared.name))
    if index >= 0:
        axes = _AXES.get(declared.subtype, "")
        label = f"{label} {axes[index]}" if index < len(axes) else f"{label} {index}"
    above = "" if struct == id_data else getattr(struct, "name", "")
    return f"{above}: {label}" if above else label


_CUSTOM = re.compile(r'\["(?P<name>(?:[^"\\]|\\.)*)"\]$')
"""The end of a custom property's data path."""
_SHOWN = {"rotation_euler": "Rotation"}
"""Labels that Blender's panels give to properties whose RNA name is a different one, here "Euler Rotation"."""

_AXES = {
    'TRANSLATION': "XYZ",
    'EULER': "XYZ",
    'XYZ': "XYZ",
    'XYZ_LENGTH': "XYZ",
    'DIRECTION': "XYZ",
    'VELOCITY': "XYZ",
    'ACCELERATION': "XYZ",
    'QUATERNION': "WXYZ",
    'AXISANGLE': "WXYZ",
    'COLOR': "RGBA",
    'COLOR_GAMMA': "RGBA",
}


def remove_objects(objects: Iterable[bpy.types.Object]) -> None:
    """Remove objects, with those of their data and materials that nothing else uses; other children stay where they stand."""
    objects = list(dict.fromkeys(objects))
    for child in [child for obj in objects for child in obj.children if child not in objects]:
        place = child.matrix_world.copy()
        child.parent = None
        child.matrix_world = place
    used = dict.fromkeys(data for obj in objects for data in (obj.data, *(slot.material for slot in obj.material_slots)) if data)
    for obj in objects:
        bpy.data.objects.remove(obj)
    # Meshes use materials.
    for data in sorted(used, key=lambda one: isinstance(one, bpy.types.Material)):
        if data.users == 0:
            getattr(bpy.data, collection_of(data)).remove(data)
