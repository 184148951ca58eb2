"""Assets that hold copied settings: each is an empty object with the text (core/settings/copied.py) in a custom property.

An object is what does least harm if somebody drags such an asset as any other: a materials or world asset would replace a material or the
scene's world, a node group would add a modifier, and an action would stand among the poses of the pose library.
"""

from pathlib import Path
from typing import NamedTuple

import bpy

from ...refusals import Refused
from ...translations import tr

TAG = "Motus"
"""Tag of the assets, by which the asset shelf and the menus know them."""
TEXT = "motus_settings"
"""Name of the custom property that has the text."""


class Place(NamedTuple):
    """Where an asset is. name: of its object. path: of the file that has it; "" for the current file."""

    name: str
    path: str = ""


def make(name, text, system, catalogue):
    """Make an asset that holds a text; returns its object. Raises Refused if the name is taken.

    name: of the asset. system: whose settings the text has. catalogue: identifier of the asset's catalogue (catalogues.py).
    """
    if (name, None) in bpy.data.objects:
        raise Refused(tr("There is an object {object} in this file: choose a different name").format(object=name))
    holder = bpy.data.objects.new(name, None)
    holder[TEXT] = text
    holder.asset_mark()
    holder.asset_data.catalog_id = catalogue
    holder.asset_data.description = tr("Settings of {system}").format(system=bpy.app.translations.pgettext_iface(system.label))
    for tag in (TAG, system.label):
        holder.asset_data.tags.new(tag, skip_if_exists=True)
    return holder


def read(place):
    """The text that an asset holds, of which nothing is checked yet. place: of the asset. Raises Refused if there is no such asset.

    The asset of a different file is linked for a moment, and all that has come with it is removed again.
    """
    if not place.path or _is_current(place.path):
        return _text(bpy.data.objects.get((place.name, None)), place.name)
    libraries, objects = set(bpy.data.libraries), set(bpy.data.objects)
    try:
        with bpy.data.libraries.load(place.path, link=True) as (there, wanted):  # type: ignore[func-returns-value]
            wanted.objects = [name for name in there.objects if name == place.name]
        return _text(next(iter(wanted.objects), None), place.name)
    except OSError:
        raise Refused(tr("The file {file} cannot be read").format(file=place.path)) from None
    finally:
        for library in set(bpy.data.libraries) - libraries:
            bpy.data.libraries.remove(library)
        for obj in set(bpy.data.objects) - objects:  # of a library that was there
            bpy.data.objects.remove(obj)


def _is_current(path):
    """Whether a path is that of the current file, from which Blender 3.4 cannot link."""
    return bool(bpy.data.filepath) and Path(path).resolve() == Path(bpy.data.filepath).resolve()


def _text(holder, name):
    text = None if holder is None else holder.get(TEXT)
    if not isinstance(text, str):
        refuse(name)
    return text


def refuse(name):
    """Raise Refused, because an asset holds no settings. name: of the asset."""
    raise Refused(tr("{asset} holds no settings of Motus").format(asset=name))


def shown(context):
    """The asset of the context, such as the active one of an asset browser; None if there is none.

    It is an AssetRepresentation, before Blender 4.0 the FileSelectEntry of the asset browser.
    """
    return getattr(context, "asset", None) or getattr(context, "asset_file_handle", None)


def is_held(asset):
    """Whether an asset seems to hold settings, as its tags say. asset: as shown() returns it."""
    described = asset.metadata if hasattr(asset, "metadata") else asset.asset_data
    return asset.id_type == 'OBJECT' and any(tag.name == TAG for tag in described.tags)


def place_of(asset, context):
    """Place of an asset. asset: as shown() returns it for the context."""
    if asset.local_id:
        return Place(asset.local_id.name)
    if hasattr(asset, "full_library_path"):
        return Place(asset.name, asset.full_library_path)
    return Place(asset.name, bpy.types.AssetHandle.get_full_library_path(asset, context.asset_library_ref))
