"""Lattice: fits a lattice around objects or vertices, and moves its points by pulling the deformed surface."""

from ..core.declare import Feature
from . import operators, panel, properties, pull_operator

# Blender's Lattice modifier deforms the objects: this Feature solves nothing.
SYSTEM = Feature(
    name="lattice",
    label="Lattice",
    hand_over='PLAIN',
    settings=properties.MOTUS_PG_lattice,
    classes=(properties.MOTUS_PG_lattice, *operators.classes, *pull_operator.classes, *panel.classes),
    add_menu=("motus.lattice_fit",),
    object_menu=("motus.lattice_fit", "motus.lattice_pull", "motus.lattice_rest", "motus.lattice_keep", "motus.lattice_remove"),
)
