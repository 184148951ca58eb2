"""Lattice: fitted around objects or vertices, and pulled by points of what it deforms."""

from ..core.system import System
from . import operators, panel, properties, pull_operator

# Blender's own modifier does the deforming: nothing here is solved, so that the settings are never active.
SYSTEM = System(
    name="lattice",
    label="Lattice",
    settings=properties.MOTUS_PG_lattice,
    classes=(properties.MOTUS_PG_lattice, *operators.classes, *pull_operator.classes, *panel.classes),
    solve=None,
    problems=(),
    members=lambda owner: [],
    add_menu=("motus.lattice_fit",),
    object_menu=("motus.lattice_fit", "motus.lattice_pull", "motus.lattice_remove"),
)
