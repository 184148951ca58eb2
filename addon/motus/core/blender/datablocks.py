"""Datablocks of any type and their properties: how operators and scripts name them, safe references, lists of all of them; the order of modifiers."""

import re
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import bpy

from ..refusals import Refused
from ..translations import tr
from . import capabilities


class OfADatablock:
    """Mixin of an operator with the keywords that name a property of a datablock of any type."""

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
        """Find the datablock that the operator's keywords `datablock` and `collection` name. Raises Refused if there is none.

        If `datablock` is empty, the active object is meant.
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
    """Reference to an Object or PoseBone that is safe to keep while scripts may remove the thing.

    bone: name of the PoseBone; "" for the object itself. Python's reference to a removed Object raises ReferenceError when used. Python's
    reference to a removed PoseBone would point to freed memory, so a bone is kept by its name.
    """

    object: Any
    bone: str

    @classmethod
    def of(cls, thing: Any) -> "Named":
        """Make a safe reference (Named) to an Object or PoseBone from the thing itself."""
        return cls(thing.id_data, thing.name if isinstance(thing, bpy.types.PoseBone) else "")

    @property
    def thing(self) -> Any:
        """The Object or PoseBone that the reference names. Raises ReferenceError if a bone or its rig was removed.

        A removed Object itself raises ReferenceError only when it is used.
        """
        if not self.bone:
            return self.object
        found = self.object.pose.bones.get(self.bone)
        if found is None:
            raise ReferenceError(f"{self.object.name} has no bone {self.bone} any more")
        return found


def _collections() -> list[Any]:
    """RNA properties of the collections in bpy.data, each of one type of datablock.

    Blender 5.2's collection of all datablocks is left out.
    """
    properties: Any = bpy.data.bl_rna.properties
    return [prop for prop in properties if prop.type == 'COLLECTION' and prop.fixed_type.identifier != 'ID']


def everything() -> Iterator[Any]:
    """Yield all datablocks of the file, node trees that are embedded in datablocks included."""
    for collection in _collections():
        for datablock in getattr(bpy.data, collection.identifier):
            yield datablock
            tree = getattr(datablock, "node_tree", None)
            if tree is not None and tree.is_embedded_data:
                yield tree


def collection_of(datablock: Any) -> str:
    """Name of the collection in bpy.data that holds a datablock, such as "objects". Raises ValueError if there is none."""
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
    """Type of a datablock, by the identifier that DriverTarget.id_type has for it."""
    kind = next(one for one in type(datablock).__mro__ if one.__base__ is bpy.types.ID)
    name = kind.__name__.upper()
    return _ID_TYPES.get(name, name)


def named_by(datablock: Any, path: str) -> tuple[Any, str]:
    """Find a datablock that has a name in bpy.data, and convert a data path to begin there: (datablock, data path).

    An embedded node tree has no name in bpy.data: the datablock that contains the tree is returned, with a path that begins with
    "node_tree.". For all different datablocks, the datablock and the path are returned unchanged.
    """
    if not isinstance(datablock, bpy.types.NodeTree) or not datablock.is_embedded_data:
        return datablock, path
    for prop in _collections():
        for one in getattr(bpy.data, prop.identifier):
            if getattr(one, "node_tree", None) == datablock:
                return one, f"node_tree.{path}"
    return datablock, path


def label_of(id_data: Any, data_path: str, index: int = -1) -> str:
    """Name of a property in the interface, in the user's language; the data path if it has no name.

    index: of the component of an array property; -1 for a property that is no array.
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
"""Matches the end of the data path of a custom property. Group "name" is the property's escaped name."""
_SHOWN = {"rotation_euler": "Rotation"}
"""{name of a property: label in Blender's panels}, for properties whose RNA name is different, here "Euler Rotation"."""

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


def is_used(block: Any) -> bool:
    """Whether anything in the file points to a datablock, or it has a fake user.

    Blender 5.2 counts one user too many, for each saving, of objects and materials that an input of a Geometry Nodes modifier points to: `users`
    does not tell of these whether they are used.
    """
    return block.use_fake_user or bool(bpy.data.user_map(subset=[block]).get(block))


def remove_objects(objects: Iterable[bpy.types.Object]) -> None:
    """Remove objects, and those of their data and materials that nothing else uses.

    Children that are not removed keep their world matrix.
    """
    objects = list(dict.fromkeys(objects))
    for child in [child for obj in objects for child in obj.children if child not in objects]:
        place = child.matrix_world.copy()
        child.parent = None
        child.matrix_world = place
    used = dict.fromkeys(data for obj in objects for data in (obj.data, *(slot.material for slot in obj.material_slots)) if data)
    for obj in objects:
        bpy.data.objects.remove(obj)
    # Meshes use materials, so materials come last.
    for data in sorted(used, key=lambda one: isinstance(one, bpy.types.Material)):
        if data.users == 0:
            getattr(bpy.data, collection_of(data)).remove(data)


def move_modifier(owner: Any, modifier: Any, place: int) -> None:
    """Move a modifier of an object to a place in the stack. Nothing is called if it stands there."""
    now = owner.modifiers.find(modifier.name)
    if now == place:
        return  # in Blender 3.4 the operator refuses overrides
    if capabilities.has_modifier_order():
        owner.modifiers.move(now, place)
        return
    override: Any = bpy.context.temp_override(object=owner, active_object=owner)
    with override:
        bpy.ops.object.modifier_move_to_index(modifier=modifier.name, index=place)
