"""The rows of a cover's settings: in the panel, and for the keywords in the redo panel."""

from ...core.interface.rows import Rows

SNOW = Rows(("lump", "repose", "smoothing", "influence"), title="Snow")
LAYER = Rows(("resolution", "thinnest"), title="Snow Layer")
ALL = (SNOW, LAYER)
