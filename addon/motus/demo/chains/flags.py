"""Prayer flags: lines between the posts of the bridge and on to stones, with coloured flags that hang from them in the wind.

A line is one chain: the bones of the flags branch off from those of the line, which is pinned at its far end.
"""

import numpy as np

from ..stage import materials, shapes
from . import bones, gorge, pinning

FLAG = (0.20, 0.26)  # width and height, m
FLAG_BONES = 3
COLORS = ((0.03, 0.12, 0.50), (0.85, 0.83, 0.78), (0.62, 0.03, 0.03), (0.03, 0.30, 0.09), (0.88, 0.55, 0.04))
# Of each line: name, places of its ends, sag as a share of their distance, number of its bones.
LINES = (
    ("Flags", (0.16, 0.55, 2.10), (-gorge.SPAN - 0.16, 0.55, 2.10), 0.085, 30),
    ("Near Flags", (0.16, 0.55, 2.10), (4.1, 0.05, 0.62), 0.07, 19),
)
SETTINGS = {"drag": 3.2, "bend_limit": 3.1416}


def build(context, collection, ends, wind):
    """Build the lines of flags with their chains. ends: collection of the empties that their far ends are pinned to. Returns the rigs."""
    slots = [materials.principled("Flag Line", color=(0.55, 0.48, 0.36), roughness=0.9), *(_cloth(index, color) for index, color in enumerate(COLORS))]
    rigs = []
    for name, start, end, sag, count in LINES:
        share = np.linspace(0.0, 1.0, 9)[:, None]
        line = np.array(start) + share * np.subtract(end, start) - np.array((0.0, 0.0, 4.0 * sag * np.linalg.norm(np.subtract(end, start)))) * share * (1.0 - share)
        rigs.append(_build_line(context, collection, name, bones.along(line, count + 1), slots))
        pinning.hang(rigs[-1], [bones.names(name, count)], ends, wind, **SETTINGS)
    return rigs


def _build_line(context, collection, name, places, slots):
    """Build a line with a flag at every joint. places: of its bones in rest pose, (count + 1, 3)."""
    armature, skin = bones.Armature(context, collection, name), bones.Skin()
    with armature:
        row = armature.add_row(name, "", places)
        hung = []
        for index in range(1, len(row)):
            down = places[index] - np.array((0.0, 0.0, FLAG[1] / FLAG_BONES)) * np.arange(FLAG_BONES + 1)[:, None]
            hung.append(armature.add_row(f"{name} {index} Flag", row[index - 1], down))
    part, at = bones.tube(places, 0.006, sides=6, across=(0.0, 1.0, 0.0), rings=2)
    skin.add(part, 0, bones.shares_along(row, at))
    for index, carriers in enumerate(hung, 1):
        along = (places[index + 1] - places[index - 1]) / np.linalg.norm(places[index + 1] - places[index - 1])
        _add_flag(skin, places[index], along, carriers, 1 + index % len(COLORS))
    return_to = skin.finish(collection, f"{name} Cloth", armature.object, slots)
    return_to.modifiers.new("Thickness", "SOLIDIFY").thickness = 0.004
    return armature.object


def _add_flag(skin, top, along, carriers, slot):
    """Add a flag below a place of the line. along: direction of the line. carriers: names of the flag's bones."""
    columns, rows = 5, 3 * FLAG_BONES + 1
    across, down = np.linspace(-0.5, 0.5, columns), np.linspace(0.0, 1.0, rows)
    places = top + FLAG[0] * across[None, :, None] * along - FLAG[1] * down[:, None, None] * np.array((0.0, 0.0, 1.0))
    skin.add(shapes.loft(places, closed=False), slot, bones.shares_along(carriers, np.repeat(down * FLAG_BONES, columns)))


def _cloth(index, color):
    """Make a cloth through which the sun shines a little."""
    material, shader, output = materials.new_material(f"Flag Cloth {index + 1}")
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=0.9, specular=0.1)
    through = shader.add("ShaderNodeBsdfTranslucent", {"Color": (*color, 1.0)})
    mixed = shader.add("ShaderNodeMixShader", {0: 0.35, 1: node.outputs[0], 2: through.outputs[0]})
    materials.finish(material, shader, output, mixed.outputs[0])
    material.diffuse_color = (*color, 1.0)
    return material
