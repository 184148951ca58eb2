"""Rows of a snow cover's settings, as the panel and the operator's redo panel draw them."""

import bpy

from ...core.file.pointers import pointed
from ...core.interface.rows import Row, Rows


def _groups(settings):
    """Return (object, name of its collection of vertex groups) to choose from: the first surface that has any, or else the cover."""
    cover = settings.id_data if isinstance(settings, bpy.types.PropertyGroup) else bpy.context.object
    listed = [pointed(entry, "object") for entry in cover.motus.snow_cover.surfaces] if cover else []
    return next((one for one in listed if one is not None and one.vertex_groups), cover), "vertex_groups"


SNOW = Rows(("lump", "repose", "smoothing", Row("depth_group", search=_groups), "influence"), title="Snow")
MARKS = Rows(("packed",), title="Marks")
LAYER = Rows(("resolution", "viewport_resolution", "thinnest"), title="Snow Layer")
ALL = (SNOW, MARKS, LAYER)
