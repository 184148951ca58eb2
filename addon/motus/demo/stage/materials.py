"""Helpers that build shader nodes in all Blender versions, and materials with the haze that all outdoor materials share."""

import bpy

# Names that each input of the Principled BSDF node has in Blender's versions, newest first.
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
    """Builder of a node tree: its methods add a node and return the node or its output socket."""

    def __init__(self, tree):
        self.tree = tree

    def add(self, kind, inputs=None, **attributes):
        """Add a node. inputs: {identifier, name or index of an input: value, or output socket to link}. attributes: of the node."""
        node = self.tree.nodes.new(kind)
        node.location.x = 200.0 * len(self.tree.nodes)
        for name, value in attributes.items():
            setattr(node, name, value)
        for key, value in (inputs or {}).items():
            self.feed(find_socket(node.inputs, key), value)
        return node

    def feed(self, socket, value):
        """Link an input socket to an output socket, or set its value."""
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation, first, second=0.0, clamp=False):
        """Add a Math node; returns its output socket."""
        return self.add("ShaderNodeMath", {0: first, 1: second}, operation=operation, use_clamp=clamp).outputs[0]

    def mix(self, factor, first, second, blend="MIX"):
        """Add a Mix node for colours; returns its output socket. blend: blending mode."""
        node = self.add("ShaderNodeMix", data_type="RGBA", blend_type=blend)
        for key, value in (("Factor_Float", factor), ("A_Color", first), ("B_Color", second)):
            self.feed(find_socket(node.inputs, key), value)
        return find_socket(node.outputs, "Result_Color")

    def ramp(self, factor, stops, interpolation="EASE"):
        """Add a Color Ramp node; returns its colour socket. stops: (position, rgb) rows."""
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
        """Add a Noise Texture node; returns its value socket, 0.5 on average."""
        node = self.add("ShaderNodeTexNoise", {"Vector": vector, "Scale": scale, "Detail": detail})
        return find_socket(node.outputs, "Fac")

    def group(self, tree, inputs):
        """Add a node for a node group; returns the node. inputs: {name of an input: value or output socket}."""
        node = self.add("ShaderNodeGroup", node_tree=tree)
        for key, value in inputs.items():
            self.feed(node.inputs[key], value)
        return node


def find_socket(sockets, key):
    """Return a socket by its index, identifier or name. Identifiers are tried before names, because several sockets can have one name."""
    if isinstance(key, int):
        return sockets[key]
    for socket in sockets:
        if socket.identifier == key:
            return socket
    for socket in sockets:
        if socket.name == key:
            return socket
    # Blender 5 names the noise's output "Factor", older versions name it "Fac".
    if key == "Fac":
        return find_socket(sockets, "Factor")
    raise KeyError(key)


def new_group(name, inputs, outputs):
    """Make a shader node group. Returns (Shader, Group Input node, Group Output node). inputs, outputs: (name, socket type) rows."""
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
    """Set or link inputs of a Principled BSDF node. settings: {key of _PRINCIPLED_NAMES: value or output socket}."""
    for setting, value in settings.items():
        socket = next(node.inputs[name] for name in _PRINCIPLED_NAMES[setting] if name in node.inputs)
        if setting == "color" and not isinstance(value, bpy.types.NodeSocket):
            value = (*value, 1.0)
        shader.feed(socket, value)


def new_material(name):
    """Make a material with only an output node. Returns (material, Shader, output node)."""
    material = bpy.data.materials.new(name)
    if not material.use_nodes:
        material.use_nodes = True
    material.node_tree.nodes.clear()
    shader = Shader(material.node_tree)
    return material, shader, shader.add("ShaderNodeOutputMaterial")


def principled(name, haze=None, **settings):
    """Make a material with a Principled BSDF node. settings: for set_principled(). haze: node group of the haze, or None for no haze."""
    material, shader, output = new_material(name)
    node = shader.add("ShaderNodeBsdfPrincipled")
    set_principled(shader, node, **settings)
    finish(material, shader, output, node.outputs[0], haze)
    material.diffuse_color = (*settings.get("color", (0.8, 0.8, 0.8)), 1.0)
    return material


def wood(name, light, dark, stretch, on_skin=False, roughness=0.42):
    """Make a material of varnished wood.

    stretch: repetitions of the grain along each axis, fewest along the fibres. They are per metre of the object; if `on_skin` is set,
    they are per side of the undeformed mesh's bounding box, so that the grain moves with the bones.
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
    """Connect a surface's shader socket to the material's output, through the node group of the haze if it is not None."""
    if haze is not None:
        surface = shader.group(haze, {"Surface": surface}).outputs[0]
        _keep_out_of_light_sampling(material)
    shader.feed(output.inputs["Surface"], surface)


def make_transparent(material):
    """Let EEVEE blend the material's alpha, before and since Blender 4.2."""
    if hasattr(material, "surface_render_method"):
        material.surface_render_method = "BLENDED"
    else:
        material.blend_method = "BLEND"
    cast_no_shadows(material)


def cast_no_shadows(material):
    """Exclude a material from the shadow maps of EEVEE before Blender 4.2."""
    if hasattr(material, "shadow_method"):
        material.shadow_method = "NONE"


def _keep_out_of_light_sampling(material):
    """Exclude a material with haze from Cycles' light sampling: the haze is an emission, but it must not count as a lamp."""
    cycles = getattr(material, "cycles", None)
    if cycles is None:
        return
    if hasattr(cycles, "emission_sampling"):
        cycles.emission_sampling = "NONE"
    elif hasattr(cycles, "sample_as_light"):
        cycles.sample_as_light = False
