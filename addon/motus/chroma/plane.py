"""A plane before the camera that shows the footage keyed in the viewport, where it takes the place of the render's key."""

import bpy
from mathutils import Matrix

from ..core import capabilities
from . import footage, group

DISTANCE = 10.0
"""From the camera to the plane, where nobody says otherwise."""


def add(scene, camera, image, color, levels, distance):
    """A plane that fills the camera's view, so far away, in the space of the camera. levels: clip black and white."""
    mesh = bpy.data.meshes.new("Chroma Key")
    obj = bpy.data.objects.new("Chroma Key", mesh)
    scene.collection.objects.link(obj)
    corners = [_at(corner, distance, camera.data.type) for corner in camera.data.view_frame(scene=scene)]
    # view_frame() goes round from the upper right corner, clockwise.
    mesh.from_pydata(corners, [], [(0, 3, 2, 1)])
    layer = mesh.uv_layers.new()
    places = {0: (1.0, 1.0), 1: (1.0, 0.0), 2: (0.0, 0.0), 3: (0.0, 1.0)}
    for loop, data in zip(mesh.loops, layer.data):
        data.uv = places[loop.vertex_index]
    mesh.materials.append(_material(image, color, levels))
    obj.parent = camera
    obj.matrix_parent_inverse = Matrix()
    obj.hide_render = True
    obj[group.KEY] = True
    return obj


def update(obj, color, levels):
    """Give a plane another colour and levels."""
    material = next((one for one in obj.data.materials if one is not None), None) if obj.type == 'MESH' else None
    if material is not None and material.node_tree is not None:
        _set(material.node_tree, color, levels)


def _at(corner, distance, kind):
    return (corner.x, corner.y, -distance) if kind == 'ORTHO' else corner * (distance / -corner.z)


def _material(image, color, levels):
    material = bpy.data.materials.new("Chroma Key")
    if not material.use_nodes:
        material.use_nodes = True
    if capabilities.has_blended_surfaces():
        material.surface_render_method = 'BLENDED'
    else:
        material.blend_method, material.shadow_method = 'BLEND', 'NONE'
    tree = material.node_tree
    tree.nodes.clear()
    add_node, links = tree.nodes.new, tree.links
    texture = add_node("ShaderNodeTexImage")
    texture.image = image
    footage.play(image, texture.image_user)
    matte = _matte(tree, texture.outputs["Color"])
    emission, clear, mixed, end = (
        add_node(kind) for kind in ("ShaderNodeEmission", "ShaderNodeBsdfTransparent", "ShaderNodeMixShader", "ShaderNodeOutputMaterial"))
    alpha = _math(tree, 'MULTIPLY', matte, texture.outputs["Alpha"])
    for source, target in ((texture.outputs["Color"], emission.inputs["Color"]), (alpha, mixed.inputs[0]),
                           (clear.outputs[0], mixed.inputs[1]), (emission.outputs[0], mixed.inputs[2]),
                           (mixed.outputs[0], end.inputs["Surface"])):
        links.new(source, target)
    _set(tree, color, levels)
    return material


# Names of the nodes that a colour and levels are given to.
_COLOR, _LEVELS, _IS_BLUE = "Screen Color", "Levels", "Is Blue"


def _matte(tree, color):
    """1 - s(pixel) / s(screen) between the levels, as the node Keying has it."""
    screen = tree.nodes.new("ShaderNodeRGB")
    screen.name = _COLOR
    is_blue = tree.nodes.new("ShaderNodeValue")
    is_blue.name = _IS_BLUE
    shares = [_saturation(tree, one, is_blue.outputs[0]) for one in (color, screen.outputs[0])]
    matte = _math(tree, 'SUBTRACT', 1.0, _math(tree, 'DIVIDE', *shares))
    levels = tree.nodes.new("ShaderNodeMapRange")
    levels.name, levels.clamp = _LEVELS, True
    tree.links.new(matte, levels.inputs["Value"])
    return levels.outputs[0]


def _saturation(tree, color, is_blue):
    parts = tree.nodes.new("ShaderNodeSeparateColor")
    tree.links.new(color, parts.inputs[0])
    red, green, blue = parts.outputs[:3]
    # is_blue exchanges the two channels.
    change = _math(tree, 'MULTIPLY', _math(tree, 'SUBTRACT', blue, green), is_blue)
    own, other = _math(tree, 'ADD', green, change), _math(tree, 'SUBTRACT', blue, change)
    mixture = _math(tree, 'MULTIPLY', _math(tree, 'ADD', red, other), 0.5)
    rest = _math(tree, 'ABSOLUTE', _math(tree, 'SUBTRACT', 1.0, mixture), 0.0)
    return _math(tree, 'MULTIPLY', _math(tree, 'SUBTRACT', own, mixture), rest)


def _math(tree, operation, first, second):
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    for socket, value in zip(node.inputs, (first, second)):
        if isinstance(value, bpy.types.NodeSocket):
            tree.links.new(value, socket)
        else:
            socket.default_value = value
    return node.outputs[0]


def _set(tree, color, levels):
    nodes = {name: tree.nodes.get(name) for name in (_COLOR, _IS_BLUE, _LEVELS)}
    if None in nodes.values():
        return
    nodes[_COLOR].outputs[0].default_value = (*color, 1.0)
    nodes[_IS_BLUE].outputs[0].default_value = float(color[2] > color[1])
    for name, level in zip(("From Min", "From Max"), levels):
        nodes[_LEVELS].inputs[name].default_value = level
