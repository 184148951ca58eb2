"""Prayer flags: lines between the posts of the bridge and on to stones, with coloured flags that hang from them in the wind.

A line is one chain: the bones of the flags branch off from those of the line, which is pinned at its far end.
"""

import numpy as np

from ..stage import bones, materials, shapes
from . import gorge, pinning

FLAG = (0.34, 0.36)  # width and height, m
FLAG_BONES = 2
COLORS = ((0.03, 0.12, 0.50), (0.85, 0.83, 0.78), (0.62, 0.03, 0.03), (0.03, 0.30, 0.09), (0.88, 0.55, 0.04))
# Of each line: name, places of its ends, sag as a share of their distance, number of its bones.
LINES = (
    ("Line", (0.03, 0.55, 2.08), (-gorge.SPAN - 0.03, 0.55, 2.08), 0.085, 15),
    ("Near Line", (0.03, 0.55, 2.08), (4.1, 0.05, 0.62), 0.07, 8),
)
RIPPLE = 0.06  # m
SETTINGS = {"drag": 2.6}


def build(context, collection, ends, wind):
    """Build the lines of flags with their chains. ends: collection of the empties that their far ends are pinned to. Returns the rig."""
    armature, skin = bones.Armature(context, collection, "Flags"), bones.Skin()
    rows = []
    with armature:
        for name, start, end, sag, count in LINES:
            places = _line(start, end, sag, count + 1)
            rows.append(armature.add_row(name, "", places))
            part, at = bones.tube(places, 0.006, sides=6, rings=2)
            skin.add(part, 0, bones.shares_along(rows[-1], at))
            for index in range(1, count):
                down = places[index] - np.array((0.0, 0.0, FLAG[1] / FLAG_BONES)) * np.arange(FLAG_BONES + 1)[:, None]
                carriers = armature.add_row(f"{name} {index} Flag", rows[-1][index - 1], down)
                along = (places[index + 1] - places[index - 1]) / np.linalg.norm(places[index + 1] - places[index - 1])
                _add_flag(skin, places[index], along, carriers, 1 + index % len(COLORS))
    line = materials.principled("Flag Line", color=(0.55, 0.48, 0.36), roughness=0.9)
    cloth = skin.finish(collection, "Flag Cloth", [line, *(_cloth(index, color) for index, color in enumerate(COLORS, 1))])
    _flutter(cloth)
    bones.carry(cloth, armature.object)
    pinning.hang(armature.object, rows, ends, wind, **SETTINGS)
    return armature.object


def _line(start, end, sag, count):
    """Return `count` places at equal distances on a parabola from start to end. sag: as a share of their distance."""
    start, end, share = np.array(start), np.array(end), np.linspace(0.0, 1.0, 9)[:, None]
    low = np.array((0.0, 0.0, 4.0 * sag * np.linalg.norm(end - start)))
    return bones.along(start + share * (end - start) - low * share * (1.0 - share), count)


def _flutter(cloth):
    """Let ripples run through the flags, before bones move them."""
    flags = cloth.vertex_groups.new(name="Ripples")
    line = {vertex for face in cloth.data.polygons if face.material_index == 0 for vertex in face.vertices}
    flags.add([vertex.index for vertex in cloth.data.vertices if vertex.index not in line], 1.0, "REPLACE")
    ripples = cloth.modifiers.new("Ripples", "WAVE")
    ripples.use_y, ripples.use_x, ripples.use_normal = False, True, True
    ripples.use_cyclic, ripples.height, ripples.width, ripples.narrowness, ripples.speed = True, RIPPLE, 0.11, 9.0, 0.045
    ripples.time_offset, ripples.vertex_group = -400.0, flags.name


def _add_flag(skin, top, along, carriers, slot):
    """Add a flag below a place of the line. along: direction of the line. carriers: names of the flag's bones."""
    columns, rows = 9, 5 * FLAG_BONES + 1
    across, down = np.linspace(-0.5, 0.5, columns), np.linspace(0.0, 1.0, rows)
    places = top + FLAG[0] * across[None, :, None] * along - FLAG[1] * down[:, None, None] * np.array((0.0, 0.0, 1.0))
    skin.add(shapes.loft(places, closed=False), slot, bones.shares_along(carriers, np.repeat(down * FLAG_BONES, columns)))


def _cloth(index, color):
    """Make a cloth through which the sun shines a little."""
    material, shader, output = materials.new_material(f"Flag Cloth {index}")
    node = shader.add("ShaderNodeBsdfPrincipled")
    materials.set_principled(shader, node, color=color, roughness=0.9, specular=0.1)
    through = shader.add("ShaderNodeBsdfTranslucent", {"Color": (*color, 1.0)})
    mixed = shader.add("ShaderNodeMixShader", {0: 0.35, 1: node.outputs[0], 2: through.outputs[0]})
    materials.finish(material, shader, output, mixed.outputs[0])
    material.diffuse_color = (*color, 1.0)
    return material
