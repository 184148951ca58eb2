"""Plane in front of the camera that shows the keyed footage in the viewport; the plane is not rendered."""

from typing import NamedTuple

import bpy

from ..core.blender import capabilities
from . import footage, group


class Key(NamedTuple):
    """Values of a chroma key that the plane's material needs."""

    color: tuple
    black: float
    white: float
    balance: float
    gain: float


DISTANCE = 10.0
"""Default distance from the camera to the plane, in metres."""


def add(scene, camera, image, key, distance):
    """Add a plane that fills the camera's view at a distance, as a child of the camera; returns the object.

    image: the footage. key: a Key.
    """
    mesh = bpy.data.meshes.new("Chroma Key")
    obj = bpy.data.objects.new("Chroma Key", mesh)
    scene.collection.objects.link(obj)
    corners = [_at(corner, distance, camera.data.type) for corner in camera.data.view_frame(scene=scene)]
    # view_frame() gives the corners clockwise from the upper right one.
    mesh.from_pydata(corners, [], [(0, 3, 2, 1)])
    layer = mesh.uv_layers.new()
    places = {0: (1.0, 1.0), 1: (1.0, 0.0), 2: (0.0, 0.0), 3: (0.0, 1.0)}
    for loop, data in zip(mesh.loops, layer.data):
        data.uv = places[loop.vertex_index]
    mesh.materials.append(_material(scene, image, key))
    obj.parent = camera
    _ignore_scale(obj)
    obj.hide_render = True
    obj[group.KEY] = True
    return obj


def _ignore_scale(obj):
    """Keep the world scale of a child of the camera at 1 if the camera or its parents are scaled, since renders ignore the camera's scale."""
    limit = obj.constraints.new('LIMIT_SCALE')
    limit.owner_space = 'WORLD'
    for axis in "xyz":
        for end in ("min", "max"):
            setattr(limit, f"use_{end}_{axis}", True)
            setattr(limit, f"{end}_{axis}", 1.0)


def update(obj, key):
    """Set the values in a plane's material to those of a Key."""
    material = next((one for one in obj.data.materials if one is not None), None) if obj.type == 'MESH' else None
    if material is not None and material.node_tree is not None:
        _set(material.node_tree, key)


def _at(corner, distance, kind):
    return (corner.x, corner.y, -distance) if kind == 'ORTHO' else corner * (distance / -corner.z)


def _material(scene, image, key):
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
    footage.play(image, texture.image_user, scene)
    screen = add_node("ShaderNodeRGB")
    screen.name = _COLOR
    matte = _math(tree, 'MULTIPLY', _matte(tree, texture.outputs["Color"], screen.outputs[0]), texture.outputs["Alpha"])
    rest = _math(tree, 'SUBTRACT', 1.0, matte)
    # The picture without the screen's light is added, as emission, to the transparent background.
    taken, least = (add_node("ShaderNodeMixRGB") for _ in range(2))
    taken.blend_type, least.blend_type = 'SUBTRACT', 'LIGHTEN'
    least.inputs["Fac"].default_value, least.inputs["Color2"].default_value = 1.0, (0.0, 0.0, 0.0, 1.0)
    emission, clear, both, end = (
        add_node(kind) for kind in ("ShaderNodeEmission", "ShaderNodeBsdfTransparent", "ShaderNodeAddShader", "ShaderNodeOutputMaterial")
    )
    for source, target in (
        (rest, taken.inputs["Fac"]),
        (texture.outputs["Color"], taken.inputs["Color1"]),
        (screen.outputs[0], taken.inputs["Color2"]),
        (taken.outputs[0], least.inputs["Color1"]),
        (least.outputs[0], emission.inputs["Color"]),
        (texture.outputs["Alpha"], emission.inputs["Strength"]),
        (rest, clear.inputs["Color"]),
        (emission.outputs[0], both.inputs[0]),
        (clear.outputs[0], both.inputs[1]),
        (both.outputs[0], end.inputs["Surface"]),
    ):
        links.new(source, target)
    _set(tree, key)
    return material


# Names of the nodes that hold the colour and the levels.
_COLOR, _LEVELS, _IS_BLUE, _BALANCE, _GAIN = "Screen Color", "Levels", "Is Blue", "Balance", "Screen Gain"


def _matte(tree, color, screen):
    """Add the nodes of the matte to a material: 1 - gain m(pixel) / m(screen), mapped by the clip levels, as in chroma/group.py."""
    is_blue, balance, gain = (_value(tree, name) for name in (_IS_BLUE, _BALANCE, _GAIN))
    amount = _math(tree, 'DIVIDE', *(_difference(tree, one, is_blue, balance) for one in (color, screen)))
    matte = _math(tree, 'SUBTRACT', 1.0, _math(tree, 'MULTIPLY', amount, gain))
    levels = tree.nodes.new("ShaderNodeMapRange")
    levels.name, levels.clamp = _LEVELS, True
    tree.links.new(matte, levels.inputs["Value"])
    return levels.outputs[0]


def _value(tree, name):
    node = tree.nodes.new("ShaderNodeValue")
    node.name = name
    return node.outputs[0]


def _difference(tree, color, is_blue, balance):
    """Add the nodes of the colour difference m: the screen's channel minus a mixture of the two remaining channels."""
    parts = tree.nodes.new("ShaderNodeSeparateColor")
    tree.links.new(color, parts.inputs[0])
    red, green, blue = parts.outputs[:3]
    # With is_blue = 1 green and blue are exchanged.
    change = _math(tree, 'MULTIPLY', _math(tree, 'SUBTRACT', blue, green), is_blue)
    own, other = _math(tree, 'ADD', green, change), _math(tree, 'SUBTRACT', blue, change)
    larger, smaller = (_math(tree, operation, red, other) for operation in ('MAXIMUM', 'MINIMUM'))
    mixture = _math(tree, 'ADD', larger, _math(tree, 'MULTIPLY', balance, _math(tree, 'SUBTRACT', smaller, larger)))
    return _math(tree, 'SUBTRACT', own, mixture)


def _math(tree, operation, first, second):
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    for socket, value in zip(node.inputs, (first, second)):
        if isinstance(value, bpy.types.NodeSocket):
            tree.links.new(value, socket)
        else:
            socket.default_value = value
    return node.outputs[0]


def _set(tree, key):
    nodes = {name: tree.nodes.get(name) for name in (_COLOR, _IS_BLUE, _LEVELS)}
    if None in nodes.values():
        return
    nodes[_COLOR].outputs[0].default_value = (*key.color, 1.0)
    nodes[_IS_BLUE].outputs[0].default_value = float(key.color[2] > key.color[1])
    for name, level in (("From Min", key.black), ("From Max", key.white)):
        nodes[_LEVELS].inputs[name].default_value = level
    for name, value in ((_BALANCE, key.balance), (_GAIN, key.gain)):
        if name in tree.nodes:  # planes of older versions have no nodes for balance and gain
            tree.nodes[name].outputs[0].default_value = value
