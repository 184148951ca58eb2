"""Insert the nodes of a chroma key into a scene's compositor tree, before its output node, and remove them again."""

import bpy

from ..core.blender import actions, capabilities, node_groups
from ..core.refusals import Refused
from ..core.translations import tr
from . import footage, group, settings

FOREGROUND, BACKGROUND, MASK, RENDER, VIEWER = "Footage", "Background", settings.MASK, "Render", "Viewer"
"""Roles of nodes (values of the custom property group.KEY): footage, background, mask, render, and the viewer of the result."""
_KEY, _ANOTHER = "Key", "Another Key"
"""Roles of key nodes: the key whose picture is rendered, and keys of further colours, which the footage passes first."""


def tree_of(scene):
    """Compositor tree of a scene; None if there is none. Before Blender 5 the tree may exist while nodes are switched off."""
    return scene.compositing_node_group if capabilities.has_compositing_group() else scene.node_tree


def key_of(scene):
    """The compositor node of the key whose picture the scene renders; None if the scene has no key."""
    return next(iter(keys_of(scene)), None)


def keys_of(scene):
    """Return the nodes of all keys of a scene: the key whose picture is rendered, then the remaining keys in the order of adding."""
    tree = tree_of(scene)
    found = [node for node in tree.nodes if node.type == 'GROUP' and group.is_group(node.node_tree)] if tree else []
    return sorted(found, key=lambda node: group.role(node) == _ANOTHER)


def active_key(scene):
    """Node of the key that the panel shows; None if the scene has no key."""
    found = keys_of(scene)
    return found[min(max(scene.motus.chroma.active_key, 0), len(found) - 1)] if found else None


def show(scene, view):
    """Make the keys of a scene output a view, one of group.VIEWS.

    Further keys output their composite; for the view SOURCE they pass the footage through unchanged.
    """
    for node in keys_of(scene):
        is_rendered = group.role(node) != _ANOTHER
        group.show(node.node_tree, view if is_rendered or view == group.SOURCE else group.COMPOSITE)


def node_of(scene, role):
    """The node that was added to the scene's compositor tree with this role; None if there is none."""
    tree = tree_of(scene)
    return next((node for node in tree.nodes if group.role(node) == role), None) if tree else None


def prepared(scene, noted):
    """Return the compositor tree of a scene; create it, or switch nodes on, if necessary.

    noted: settings of the scene, which store what was created. Raises Refused if the tree is linked from a different file.
    """
    tree = tree_of(scene)
    if tree is not None and tree.library:
        raise Refused(tr("The compositor's nodes are linked from another file"))
    if not capabilities.has_compositing_group():
        if not scene.use_nodes:
            noted.is_switched_on, noted.is_tree_made = True, tree is None or _is_as_made(scene, tree)
            scene.use_nodes = True
            if tree is None:
                _leave_render_and_output(scene.node_tree)
        return scene.node_tree
    if tree is not None:
        return tree
    noted.is_tree_made = True
    tree = scene.compositing_node_group = bpy.data.node_groups.new(f"{scene.name} Compositor", 'CompositorNodeTree')
    node_groups.add_sockets(tree, [("Image", 'OUTPUT', "NodeSocketColor")])
    node_groups.add_node(tree, "NodeGroupOutput").location.x = 300.0
    _show_render(scene, tree)
    return tree


def _is_as_made(scene, tree):
    """Whether a tree only has a Composite node and a Render Layers node for the scene, as Blender creates it."""
    kinds = sorted(node.bl_idname for node in tree.nodes)
    return kinds == ["CompositorNodeComposite", "CompositorNodeRLayers"] and all(
        node.scene == scene and node.layer == scene.view_layers[0].name for node in tree.nodes if node.type == 'R_LAYERS'
    )


def _leave_render_and_output(tree):
    """Remove from a tree that Blender has just created what Blender 4.5 puts beside the Render Layers and the output: a Viewer and a Reroute."""
    for node in [node for node in tree.nodes if node.bl_idname not in {"CompositorNodeComposite", "CompositorNodeRLayers"}]:
        tree.nodes.remove(node)
    render = next(node for node in tree.nodes if node.type == 'R_LAYERS')
    node_groups.link(tree, render.outputs["Image"], outlet(tree))
    _drop_viewed()


def _show_render(scene, tree):
    """Add a Render Layers node to a new tree if it has none, and connect it with the tree's output."""
    if not any(node.type == 'R_LAYERS' for node in tree.nodes):
        node = tree.nodes.new("CompositorNodeRLayers")
        node.scene = scene
        node_groups.link(tree, node.outputs["Image"], outlet(tree))


def insert(scene, tree, key_group, image, background, wanted, mask, noted):
    """Insert a key into a compositor tree before its output; returns the key's node.

    key_group: node group of the key. image: the footage. wanted: what lies behind the keyed footage: 'RENDER', 'FOOTAGE' or 'NOTHING'.
    background: image behind it if wanted is 'FOOTAGE'. mask: garbage mask, or None. noted: settings of the scene, which store the previous
    source of the output.
    """
    target = _target(tree)
    if noted.is_tree_made and wanted != 'RENDER':
        # Nothing uses the Render Layers node, and it could not be rendered without a camera.
        for node in [node for node in tree.nodes if node.type == 'R_LAYERS']:
            tree.nodes.remove(node)
    before = next((link.from_socket for link in tree.links if link.to_socket == target), None)
    noted.before_node, noted.before_socket = (before.node.name, before.identifier) if before else ("", "")
    right = max((node.location.x for node in tree.nodes), default=0.0)
    frame = _mark(tree.nodes.new("NodeFrame"), "Frame", "Chroma Key")
    key = _mark(tree.nodes.new("CompositorNodeGroup"), _KEY, "Chroma Key")
    key.node_tree, key.width = key_group, 220.0
    key.parent, key.location = frame, (right + 260.0 + _COLUMNS[_KEY][0], _COLUMNS[_KEY][1])
    _link_image(scene, tree, FOREGROUND, image, 'FIT', key.inputs["Image"])
    _lay(scene, tree, key, wanted, background, noted)
    if mask is not None:
        add_mask(scene, key, MASK, mask)
    node_groups.link(tree, key.outputs["Image"], target)
    for viewed in _viewers_of(tree, before):
        node_groups.link(tree, key.outputs["Image"], viewed)
    if not any(node.bl_idname == "CompositorNodeViewer" for node in tree.nodes):
        # The viewer shows the key in the backdrop and the image editor without a render.
        viewer = _mark(tree.nodes.new("CompositorNodeViewer"), VIEWER, "")
        node_groups.link(tree, key.outputs["Image"], viewer.inputs["Image"])
    _arrange(tree, key)
    target.node.location.x = max(target.node.location.x, right + 960.0)
    return key


def _viewers_of(tree, source):
    """Input sockets of the Viewer nodes that show a socket; none for None."""
    return [link.to_socket for link in tree.links if link.from_socket == source and link.to_node.bl_idname == "CompositorNodeViewer"]


def add_mask(scene, key, name, mask):
    """Connect a Mask datablock, or the picture of an image, to the input `name` of a key's node; a previous mask is removed."""
    tree = tree_of(scene)
    remove_mask(scene, key, name)
    if isinstance(mask, bpy.types.Image):
        _link_image(scene, tree, name, mask, 'FIT', key.inputs[name])
    else:
        # In Blender 4.3 a Mask node without a mask is white everywhere.
        node = _mark(tree.nodes.new("CompositorNodeMask"), name, name)
        node.mask = mask
        node_groups.link(tree, node.outputs[0], key.inputs[name])
    _arrange(tree, key)


def mask_of(scene, key, name):
    """Mask or Image node that is connected to the input `name` of a key's node, directly or through nodes; None if there is none."""
    socket = key.inputs.get(name)
    node = next((link.from_node for link in tree_of(scene).links if link.to_socket == socket), None)
    while node is not None and not (hasattr(node, "mask") or hasattr(node, "image")):
        node = next((socket.links[0].from_node for socket in node.inputs if socket.is_linked), None)
    return node


def remove_mask(scene, key, name):
    """Disconnect the input `name` of a key's node, and remove the nodes that were added for its mask."""
    tree = tree_of(scene)
    node, socket = mask_of(scene, key, name), key.inputs.get(name)
    for link in [link for link in tree.links if link.to_socket == socket]:
        tree.links.remove(link)
    while node is not None and group.role(node).startswith(name):
        behind = next((link.to_node for link in tree.links if link.from_node == node), None)
        tree.nodes.remove(node)
        node = behind


def add_key(scene, key_group):
    """Insert a further key between the footage and the key whose picture is rendered; returns the new key's node."""
    tree, first = tree_of(scene), key_of(scene)
    count = len(keys_of(scene))
    source = next((link.from_socket for link in tree.links if link.to_socket == first.inputs["Image"]), None)
    node = _mark(tree.nodes.new("CompositorNodeGroup"), _ANOTHER, "Another Chroma Key")
    node.node_tree, node.width, node.parent = key_group, 220.0, first.parent
    node.location = first.location.x - 300.0 * count, first.location.y + 620.0
    if source is not None:
        node_groups.link(tree, source, node.inputs["Image"])
    node_groups.link(tree, node.outputs["Image"], first.inputs["Image"])
    return node


def remove_key(scene, key):
    """Remove one of several keys with its masks, and connect the nodes before it with the nodes behind it."""
    tree = tree_of(scene)
    for name in (settings.MASK, settings.CORE_MASK):
        remove_mask(scene, key, name)
    source = next((link.from_socket for link in tree.links if link.to_socket == key.inputs["Image"]), None)
    targets = [link.to_socket for link in tree.links if link.from_socket == key.outputs["Image"]]
    for target in targets if source is not None else ():
        node_groups.link(tree, source, target)
    key_group = key.node_tree
    tree.nodes.remove(key)
    drop_group(key_group)


def exchange(scene, key, key_group):
    """Replace the node group of a key's node, and restore links to sockets whose names both groups have.

    The old group is not removed; drop_group() removes it.
    """
    tree = tree_of(scene)
    sources = [(link.from_socket, link.to_socket.name) for link in tree.links if link.to_node == key]
    targets = [(link.from_socket.name, link.to_socket) for link in tree.links if link.from_node == key]
    key.node_tree = key_group
    for source, name in sources:
        if name in key.inputs:
            node_groups.link(tree, source, key.inputs[name])
    for name, target in targets:
        if name in key.outputs:
            node_groups.link(tree, key.outputs[name], target)


def drop_group(key_group):
    """Remove a key's node group from the file if no node uses it any more."""
    if key_group.users == 0:
        bpy.data.node_groups.remove(key_group)


def underneath(scene):
    """What lies behind the keyed footage of a scene: 'RENDER', 'FOOTAGE' or 'NOTHING'."""
    key = key_of(scene)
    link = next((link for link in tree_of(scene).links if link.to_node == key and link.to_socket.name == "Background"), None)
    if link is None:
        return 'NOTHING'
    return 'FOOTAGE' if group.role(link.from_node) == f"{BACKGROUND} Size" else 'RENDER'


def lay_underneath(scene, wanted, noted):
    """Change what lies behind the keyed footage of a scene. wanted: 'RENDER', 'FOOTAGE' or 'NOTHING'.

    For 'FOOTAGE' the new Image node has no image: the user chooses one in the panel.
    """
    tree, key = tree_of(scene), key_of(scene)
    if "Background" in key.inputs:
        _lay(scene, tree, key, wanted, None, noted)
        _arrange(tree, key)


def _lay(scene, tree, key, wanted, background, noted):
    """Connect the wanted background to the key's node, after the nodes of the previous background are removed."""
    target = key.inputs["Background"]
    for link in [link for link in tree.links if link.to_socket == target]:
        tree.links.remove(link)
    for node in [node for node in tree.nodes if group.role(node) in (BACKGROUND, f"{BACKGROUND} Alpha", f"{BACKGROUND} Size", RENDER)]:
        tree.nodes.remove(node)
    if wanted == 'FOOTAGE':
        _link_image(scene, tree, BACKGROUND, background, 'CROP', target)
    elif wanted == 'RENDER':
        source = _noted_source(tree, noted)
        if source is None:
            render = _mark(tree.nodes.new("CompositorNodeRLayers"), RENDER, "")
            render.scene = scene
            source = render.outputs["Image"]
        node_groups.link(tree, source, target)


def remove(scene, noted):
    """Remove all key nodes from a scene's compositor tree, and connect its output with the source that it had before."""
    tree = _own_tree(scene)
    groups = {node.node_tree for node in keys_of(scene)}
    if tree is not None:
        _show_what_was_before(scene, tree, noted)
        for node in [node for node in tree.nodes if group.KEY in node]:
            actions.remove(tree, (f"{node.path_from_id()}.",))
            tree.nodes.remove(node)
        _take_back_tree(scene, tree, noted)
    for one in groups:
        drop_group(one)
    _drop_viewed()


def _show_what_was_before(scene, tree, noted):
    """Connect a tree's output, if a key's node leads to it, and the Viewers of the key's picture with the source that the output had before."""
    source, target, key = _noted_source(tree, noted), outlet(tree), key_of(scene)
    if source is None or key is None:
        return
    was_ours = any(group.KEY in link.from_node for link in tree.links if link.to_socket == target)
    for socket in [*([target] if was_ours else ()), *_viewers_of(tree, key.outputs["Image"])]:
        node_groups.link(tree, source, socket)


def _drop_viewed():
    """Remove the image datablock of Viewer nodes, if no Viewer node of the file remains.

    Blender 3.4 counts one user too many for this image.
    """
    trees = [tree for tree in map(tree_of, bpy.data.scenes) if tree is not None]
    if any(node.bl_idname == "CompositorNodeViewer" for tree in trees for node in tree.nodes):
        return
    for image in [image for image in bpy.data.images if image.type == 'COMPOSITING' and image.users <= 1]:
        bpy.data.images.remove(image)


def _own_tree(scene):
    """Return a scene's compositor tree; if scenes share the tree (copied scenes do from Blender 5 on), give this scene a copy."""
    tree = tree_of(scene)
    if tree is not None and any(other != scene and tree_of(other) == tree for other in bpy.data.scenes):
        tree = scene.compositing_node_group = tree.copy()
    return tree


def _take_back_tree(scene, tree, noted):
    """Remove a compositor tree that was created for the key, unless it has more nodes now; switch nodes off if they were off before."""
    if noted.is_tree_made:
        if len(tree.nodes) > 2 or outlet(tree) is None:
            return
        _show_render(scene, tree)
    if noted.is_switched_on:
        scene.use_nodes = False
    elif noted.is_tree_made and capabilities.has_compositing_group():
        scene.compositing_node_group = None
        if tree.users == 0:
            bpy.data.node_groups.remove(tree)


def _noted_source(tree, noted):
    node = tree.nodes.get(noted.before_node)
    found = [socket for socket in node.outputs if socket.identifier == noted.before_socket] if node else []
    return found[0] if found else None


def outlet(tree):
    """Input socket of the tree's active output node; None if there is none."""
    kind = "NodeGroupOutput" if capabilities.has_compositing_group() else "CompositorNodeComposite"
    ends = [node for node in tree.nodes if node.bl_idname == kind]
    ends.sort(key=lambda node: not getattr(node, "is_active_output", True))
    sockets = [socket for socket in ends[0].inputs if socket.type == 'RGBA'] if ends else []
    return sockets[0] if sockets else None


def _target(tree):
    """Return the input socket of the tree's active output node; create the node and the socket if they are missing."""
    found = outlet(tree)
    if found is not None:
        return found
    if capabilities.has_compositing_group():
        if not any(
            item.in_out == 'OUTPUT' and item.socket_type == "NodeSocketColor"
            for item in tree.interface.items_tree
            if item.item_type == 'SOCKET'
        ):
            node_groups.add_sockets(tree, [("Image", 'OUTPUT', "NodeSocketColor")])
        if not any(node.bl_idname == "NodeGroupOutput" for node in tree.nodes):
            _mark(tree.nodes.new("NodeGroupOutput"), "Output", "")
    else:
        _mark(tree.nodes.new("CompositorNodeComposite"), "Output", "")
    return outlet(tree)


def _mark(node, role, label):
    node[group.KEY] = role
    node.name = role
    node.label = label
    return node


def show_image(scene, node, image):
    """Assign an image to an Image node; a film plays at its own frame rate."""
    node.image = image
    if image is None:
        node.frame_duration, node.frame_start, node.use_auto_refresh = footage.LAST_FRAME, 1, True
    elif image.source in {'MOVIE', 'SEQUENCE'}:
        footage.play(image, node, scene)
    straight = next((other for other in node.id_data.nodes if group.role(other) == f"{group.role(node)} Alpha"), None)
    if straight is not None:
        straight.mute = image is None or image.is_float


def _link_image(scene, tree, role, image, framing, target):
    """Add an Image node and the nodes that scale it to the render size, and connect them to the socket `target`.

    role: name for the new nodes. framing: 'FIT' or 'CROP'.
    """
    node = _mark(tree.nodes.new("CompositorNodeImage"), role, role)
    source = node.outputs["Image"]
    if not capabilities.has_premultiplied_images():
        straight = _mark(tree.nodes.new("CompositorNodePremulKey"), f"{role} Alpha", "")
        node_groups.link(tree, source, straight.inputs["Image"])
        source = straight.outputs["Image"]
    show_image(scene, node, image)
    scale = _mark(tree.nodes.new("CompositorNodeScale"), f"{role} Size", "")
    if capabilities.has_compositor_menus():
        scale.inputs["Type"].default_value = 'Render Size'
        scale.inputs["Frame Type"].default_value = framing.title()
    else:
        scale.space, scale.frame_method = 'RENDER_SIZE', framing
    node_groups.link(tree, source, scale.inputs["Image"])
    node_groups.link(tree, scale.outputs["Image"], target)


_COLUMNS = {
    FOREGROUND: (-180.0, 200.0),
    f"{FOREGROUND} Alpha": (0.0, 200.0),
    f"{FOREGROUND} Size": (200.0, 200.0),
    BACKGROUND: (-180.0, -180.0),
    RENDER: (0.0, -180.0),
    f"{BACKGROUND} Alpha": (0.0, -180.0),
    f"{BACKGROUND} Size": (200.0, -180.0),
    MASK: (0.0, -560.0),
    f"{MASK} Alpha": (100.0, -560.0),
    f"{MASK} Size": (200.0, -560.0),
    settings.CORE_MASK: (0.0, -900.0),
    f"{settings.CORE_MASK} Alpha": (100.0, -900.0),
    f"{settings.CORE_MASK} Size": (200.0, -900.0),
    _KEY: (420.0, 60.0),
    VIEWER: (700.0, -60.0),
}
"""Positions of nodes in the key's frame, by role."""


def _arrange(tree, key):
    """Move new nodes into the frame of a key's node, to the positions that belong to their roles."""
    left, low = key.location.x - _COLUMNS[_KEY][0], key.location.y - _COLUMNS[_KEY][1]
    for node in tree.nodes:
        if group.role(node) in _COLUMNS and node != key and node.parent is None:
            x, y = _COLUMNS[group.role(node)]
            node.parent, node.location = key.parent, (left + x, low + y)
