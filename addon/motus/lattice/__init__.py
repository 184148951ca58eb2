"""Lattice: fitted around objects or vertices, and pulled by points of what it deforms."""

from ..core.declare import Feature
from . import operators, panel, properties, pull_operator

# Blender's own modifier does the deforming: nothing here is solved.
SYSTEM = Feature(
    name="lattice",
    label="Lattice",
    settings=properties.MOTUS_PG_lattice,
    classes=(properties.MOTUS_PG_lattice, *operators.classes, *pull_operator.classes, *panel.classes),
    add_menu=("motus.lattice_fit",),
    object_menu=("motus.lattice_fit", "motus.lattice_pull", "motus.lattice_remove"),
)
