"""Rigs as solvers of bones read them: bones as arrays, plans that are kept between frames, and world matrices of several objects."""

from .arrays import (
    HAS_LOCAL_LOCATION,
    INHERITS_ROTATION,
    Arrays,
    Still,
    basis,
    bytes_of,
    columns,
    is_laid,
    is_still,
    laid_bones,
    lay,
    names_of,
    own_basis,
    parents,
    poses,
    read,
    still,
)
from .plans import fingerprint, plan, source
from .world_matrices import WorldMatrixReader, world_matrices

__all__ = (
    "HAS_LOCAL_LOCATION",
    "INHERITS_ROTATION",
    "Arrays",
    "Still",
    "WorldMatrixReader",
    "basis",
    "bytes_of",
    "columns",
    "fingerprint",
    "is_laid",
    "is_still",
    "laid_bones",
    "lay",
    "names_of",
    "own_basis",
    "parents",
    "plan",
    "poses",
    "read",
    "source",
    "still",
    "world_matrices",
)
