"""Chroma key: lays footage that was filmed in front of a green or blue screen over a background, by nodes of the compositor."""

from ..core.declare import Feature
from . import operators, panel, properties

# Nodes of Blender's compositor compute the key: this Feature solves nothing.
FEATURE = Feature(
    name="chroma",
    label="Chroma Key",
    hand_over='PLAIN',
    scene_settings=properties.MOTUS_PG_chroma,
    classes=(properties.MOTUS_PG_chroma, *operators.classes, *panel.classes),
    add_menu=("motus.chroma_key_setup",),
    object_menu=(
        "motus.chroma_key_setup",
        "motus.chroma_key_measure",
        "motus.chroma_key_add",
        "motus.chroma_key_show",
        "motus.chroma_key_remove",
    ),
)
