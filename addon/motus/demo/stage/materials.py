"""Shader helpers of the demo, the same on every Blender, and the haze all outdoor materials share."""

import bpy

# The names one Principled input has had, newest first.
_PRINCIPLED_NAMES = {
    "specular": ("Specular IOR Level", "Specular"),
    "coat": ("Coat Weight", "Clearcoat"),
    "coat_roughness": ("Coat Roughness", "Clearcoat Roughness"),
    "color": ("Base Color",),
    "metallic": ("Metallic",),
    "roughness": ("Roughness",),
    "alpha": ("Alpha",),
    "normal": ("Normal",),
}
HAZE_GROUP = "Motus Haze"
SKY_GROUP = "Motus Sky"


class Shader:
    """A thin builder for node trees: every call adds a node and returns it."""

    def __init__(self, tree):
        self.tree = tree

    def add(self, kind, inputs=None, **attributes):
        """Add a node; `inputs` maps a socket's identifier, name or index to a value or to another node's socket."""
        node = self.tree.nodes.new(kind)
        node.location.x = 200.0 * len(self.tree.nodes)
        for name, value in attributes.items():
            setattr(node, name, value)
        for key, value in (inputs or {}).items():
            self.feed(find_socket(node.inputs, key), value)
        return node

    def feed(self, socket, value):
        """Link a socket to another, or set its value."""
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation, first, second=0.0, clamp=False):
        """The result socket of a Math node."""
        return self.add("ShaderNodeMath", {0: first, 1: second}, operation=operation, use_clamp=clamp).outputs[0]

    def mix(self, factor, first, second, blend="MIX"):
        """The colour socket of a Mix node."""
        node = self.add("ShaderNodeMix", data_type="RGBA", blend_type=blend)
        for key, value in (("Factor_Float", factor), ("A_Color", first), ("B_Color", second)):
            self.feed(find_socket(node.inputs, key), value)
        return find_socket(node.outputs, "Result_Color")

    def ramp(self, factor, stops, interpolation="EASE"):
        """The colour socket of a ColorRamp with (position, rgb) stops."""
        node = self.add("ShaderNodeValToRGB", {0: factor})
        ramp = node.color_ramp
        ramp.interpolation = interpolation
        while len(ramp.elements) < len(stops):
            ramp.elements.new(0.5)
        for element, (position, color) in zip(ramp.elements, stops):
            element.position = position
            element.color = (*color, 1.0)
        return node.outputs[0]

    def noise(self, vector, scale, detail=4.0):
        """The value socket of a Noise texture, about 0.5."""
        node = self.add("ShaderNodeTexNoise", {"Vector": vector, "Scale": scale, "Detail": detail})
        return find_socket(node.outputs, "Fac")

    def group(self, tree, inputs):
        """An instance of a node group, with its inputs by name."""
        node = self.add("ShaderNodeGroup", node_tree=tree)
        for key, value in inputs.items():
            self.feed(node.inputs[key], value)
        return node


def find_socket(sockets, key):
    """A socket by index, identifier or name (identifiers first: names repeat)."""
    if isinstance(key, int):
        return sockets[key]
    for socket in sockets:
        if socket.identifier == key:
            return socket
    for socket in sockets:
        if socket.name == key:
            return socket
    # 5.x calls the noise's value "Factor" where older ones say "Fac".
    if key == "Fac":
        return find_socket(sockets, "Factor")
    raise KeyError(key)


def new_group(name, inputs, outputs):
    """An empty shader node group with (name, socket type) inputs and outputs: its builder, input and output nodes."""
    tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
    for sockets, direction in ((inputs, "INPUT"), (outputs, "OUTPUT")):
        for socket_name, kind in sockets:
            if hasattr(tree, "interface"):
                tree.interface.new_socket(socket_name, in_out=direction, socket_type=kind)
            else:
                (tree.inputs if direction == "INPUT" else tree.outputs).new(kind, socket_name)
    shader = Shader(tree)
    return shader, shader.add("NodeGroupInput"), shader.add("NodeGroupOutput")


def set_principled(shader, node, **settings):
    """Set or link inputs of a Principled BSDF by the names of `_PRINCIPLED_NAMES`."""
    for setting, value in settings.items():
        socket = next(node.inputs[name] for name in _PRINCIPLED_NAMES[setting] if name in node.inputs)
        if setting == "color" and not isinstance(value, bpy.types.NodeSocket):
            value = (*value, 1.0)
        shader.feed(socket, value)


def new_material(name):
    """An empty node material: material, builder, output node."""
    material = bpy.data.materials.new(name)
    if not material.use_nodes:
        material.use_nodes = True
    material.node_tree.nodes.clear()
    shader = Shader(material.node_tree)
    return material, shader, shader.add("ShaderNodeOutputMaterial")


def principled(name, haze=None, **settings):
    """A Principled material, seen through the haze group when one is given; `settings` as in `set_principled`."""
    material, shader, output = new_material(name)
    node = shader.add("ShaderNodeBsdfPrincipled")
    set_principled(shader, node, **settings)
    finish(material, shader, output, node.outputs[0], haze)
    material.diffuse_color = (*settings.get("color", (0.8, 0.8, 0.8)), 1.0)
    return material


def wood(name, light, dark, stretch, on_skin=False, roughness=0.42):
    """Varnished wood; `stretch`: how often its grain repeats along each axis, least along the fibres.

    Per metre of the object; `on_skin`: per side of the undeformed mesh's bounding box, so that it goes with the bones.
    """
    material, shader, output = new_material(name)
    place = shader.add("ShaderNodeTexCoord").outputs["Generated" if on_skin else "Object"]
    fibres = shader.add("ShaderNodeVectorMath", {0: place, 1: stretch}, operation="MULTIPLY").outputs[0]
    wavy = shader.math(
        "ADD",
        shader.noise(fibres, 1.0, detail=2.0),
        shader.math("MULTIPLY", shader.math("SUBTRACT", shader.noise(fibres, 4.0, detail=3.0), 0.5), 0.35),
    )
    node = shader.add("ShaderNodeBsdfPrincipled")
    color = shader.ramp(wavy, ((0.32, dark), (0.60, light)))
    set_principled(shader, node, color=color, roughness=roughness, specular=0.35)
    finish(material, shader, output, node.outputs[0])
    material.diffuse_color = (*light, 1.0)
    return material


def finish(material, shader, output, surface, haze=None):
    """Connect a surface to the material's output, through the haze."""
    if haze is not None:
        surface = shader.group(haze, {"Surface": surface}).outputs[0]
        _keep_out_of_light_sampling(material)
    shader.feed(output.inputs["Surface"], surface)


def make_transparent(material):
    """Let EEVEE blend the material's alpha, in the older and in the newer engine."""
    if hasattr(material, "surface_render_method"):
        material.surface_render_method = "BLENDED"
    else:
        material.blend_method = "BLEND"
    cast_no_shadows(material)


def cast_no_shadows(material):
    """Leave a material out of the shadow maps of EEVEE before 4.2."""
    if hasattr(material, "shadow_method"):
        material.shadow_method = "NONE"


def _keep_out_of_light_sampling(material):
    """Haze is an emission that lights nothing: Cycles must not sample the whole terrain as a lamp."""
    cycles = getattr(material, "cycles", None)
    if cycles is None:
        return
    if hasattr(cycles, "emission_sampling"):
        cycles.emission_sampling = "NONE"
    elif hasattr(cycles, "sample_as_light"):
        cycles.sample_as_light = False
