"""Rows of a snow cover's settings, as the panel and the operator's redo panel draw them."""

from ...core.interface.rows import Rows

SNOW = Rows(("lump", "repose", "smoothing", "depth_group", "influence"), title="Snow")
LAYER = Rows(("resolution", "viewport_resolution", "thinnest"), title="Snow Layer")
ALL = (SNOW, LAYER)
