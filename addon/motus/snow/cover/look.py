"""What lying snow looks like: its material."""

import bpy

from ...core import wiring
from ...core.file.pointers import pointed
from ...core.system import registered

KEY = "motus_snow_cover"
"""Custom property of the material that is made here, by which it is found again."""
NAME = "Motus Snow Cover"
COLOR = 0.86, 0.90, 0.96, 1.0
GRAIN, BUMP = 22.0, 0.25
CLOSED = 0.035
"""m: thinner snow leaves gaps, as far as its grain is uneven."""


def dress(cover):
    """Give the snow its material: the one that was chosen, or one of ours, which somebody may have changed and so stays."""
    _set(cover, pointed(cover.motus.snow_cover, "material") or _own() or _new())


def drop(cover):
    """Take it back."""
    _set(cover, None)
    cover.motus.snow_cover.property_unset("material")
    found = _own()
    if found is not None and found.users == 0:
        bpy.data.materials.remove(found)


def _set(cover, material):
    wiring.set_points_material(registered["snow_cover"], cover, material)


def _own():
    return next((one for one in bpy.data.materials if KEY in one and one.library is None), None)


def _new():
    """White, a little blue, and grainy; thin snow has gaps. Few nodes, for the file's sake."""
    material = bpy.data.materials.new(NAME)
    material[KEY] = True
    if not material.use_nodes:
        material.use_nodes = True
    if hasattr(material, "blend_method"):
        material.blend_method = 'CLIP'
    if hasattr(material, "shadow_method"):
        material.shadow_method = 'OPAQUE'
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    place, noise, bump, shader, depth, share, lies, clear, mix, output = (nodes.new(kind) for kind in (
        "ShaderNodeNewGeometry", "ShaderNodeTexNoise", "ShaderNodeBump", "ShaderNodeBsdfPrincipled", "ShaderNodeAttribute",
        "ShaderNodeMath", "ShaderNodeMath", "ShaderNodeBsdfTransparent", "ShaderNodeMixShader", "ShaderNodeOutputMaterial"))
    for index, node in enumerate(nodes):
        node.location.x = 200.0 * index
    noise.inputs["Scale"].default_value = GRAIN
    noise.inputs["Detail"].default_value = 4.0
    bump.inputs["Strength"].default_value = BUMP
    bump.inputs["Distance"].default_value = 0.02
    shader.inputs["Base Color"].default_value = material.diffuse_color = COLOR
    shader.inputs["Roughness"].default_value = 0.65
    depth.attribute_name = "depth"
    share.operation, share.inputs[1].default_value = 'DIVIDE', CLOSED
    lies.operation = 'GREATER_THAN'
    for source, target in (
            (place.outputs["Position"], noise.inputs["Vector"]), (noise.outputs[0], bump.inputs["Height"]),
            (bump.outputs["Normal"], shader.inputs["Normal"]), (depth.outputs["Fac"], share.inputs[0]),
            (share.outputs[0], lies.inputs[0]), (noise.outputs[0], lies.inputs[1]), (lies.outputs[0], mix.inputs[0]),
            (clear.outputs[0], mix.inputs[1]), (shader.outputs[0], mix.inputs[2]), (mix.outputs[0], output.inputs["Surface"])):
        links.new(source, target)
    return material
