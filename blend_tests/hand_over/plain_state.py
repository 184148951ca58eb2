"""What a scene shows at some frames: transforms, bones, vertices, points, lattices, cameras. It imports nothing of the add-on."""

import math
import pickle
import re
from pathlib import Path

import bpy
import numpy as np

OURS = re.compile("motus", re.IGNORECASE)


def states(frames):
    """{"kind|object|part": [array for each frame]} of all that shows in the view layer, by Blender's own evaluation."""
    found = {}
    for frame in frames:
        whole = math.floor(frame)
        bpy.context.scene.frame_set(whole, subframe=frame - whole)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        for name, value in _state(depsgraph):
            found.setdefault(name, []).append(np.array(value, float))
    return found


def _state(depsgraph):
    for obj in sorted(bpy.context.view_layer.objects, key=lambda one: one.name):
        evaluated = obj.evaluated_get(depsgraph)
        yield f"matrix|{obj.name}|", evaluated.matrix_world
        for bone in evaluated.pose.bones if evaluated.pose else ():
            yield f"bone|{obj.name}|{bone.name}", evaluated.matrix_world @ bone.matrix
        if obj.type == 'LATTICE':
            yield f"lattice|{obj.name}|", [point.co_deform for point in evaluated.data.points]
        if obj.type == 'CAMERA':
            camera = evaluated.data
            yield f"camera|{obj.name}|", (camera.lens, camera.stereo.interocular_distance, camera.stereo.convergence_distance)
        if obj.type in {'MESH', 'CURVE'}:
            yield f"mesh|{obj.name}|", _vertices(evaluated)
    for name, rows in _instanced(depsgraph).items():
        yield f"points|{name}|", rows


def _vertices(evaluated):
    """Places of the vertices of an evaluated mesh object, or of the line or surface of a curve, in the world."""
    mesh = evaluated.to_mesh()
    places = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", places)
    evaluated.to_mesh_clear()
    return _placed(places.reshape(-1, 3), evaluated.matrix_world)


def _placed(places, matrix):
    matrix = np.array(matrix)
    return places @ matrix[:3, :3].T + matrix[:3, 3]


def _instanced(depsgraph):
    """{name of an object: (n, 4) place and size} of the points and instances that modifiers make on it, without those that have no size."""
    found = {}
    for one in depsgraph.object_instances:
        if not one.is_instance:
            continue
        rows = found.setdefault(one.parent.name, [])
        if one.object.type == 'POINTCLOUD':
            points = one.object.data.points
            places, sizes = np.empty(3 * len(points), np.float32), np.empty(len(points), np.float32)
            points.foreach_get("co", places)
            points.foreach_get("radius", sizes)
            rows.append(np.column_stack((_placed(places.reshape(-1, 3), one.matrix_world), sizes)))
        else:
            rows.append(np.array([[*one.matrix_world.translation, one.matrix_world.to_scale().x]]))
    sized = {name: np.concatenate(rows) for name, rows in found.items()}
    return {name: rows[rows[:, 3] > 1e-7] for name, rows in sized.items()}


def store(path, frames):
    """Write states() and leftovers() into a file."""
    Path(path).write_bytes(pickle.dumps((states(frames), leftovers())))


def stored(path):
    """What store() has written: (states, leftovers)."""
    return pickle.loads(Path(path).read_bytes())


def picture(path, frame):
    """Render a frame into a file, small and quick, in half floats without a view transform."""
    scene = bpy.context.scene
    scene.frame_set(frame)
    render = scene.render
    render.engine, render.resolution_x, render.resolution_y, render.resolution_percentage = 'CYCLES', 64, 36, 100
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.device = 4, False, 'CPU'
    render.use_motion_blur, render.use_multiview = True, False
    render.image_settings.file_format, render.filepath = 'OPEN_EXR', path
    bpy.ops.render.render(write_still=True)


def pixels(path):
    """The numbers of a picture."""
    image = bpy.data.images.load(path)
    found = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(found)
    bpy.data.images.remove(image)
    return found


def leftovers():
    """What has the name of the add-on in the file: datablocks, custom properties, drivers, constraints, modifiers."""
    found = []
    for prop in bpy.data.bl_rna.properties:
        if prop.type == 'COLLECTION':
            found += [text for one in getattr(bpy.data, prop.identifier) if isinstance(one, bpy.types.ID) for text in _of_datablock(one)]
    return found


def _of_datablock(one):
    texts = [one.name, *one.keys()]
    for holder in (one, getattr(one, "node_tree", None)):
        animation = getattr(holder, "animation_data", None)
        for curve in animation.drivers if animation else ():
            targets = [target.data_path for variable in curve.driver.variables for target in variable.targets]
            texts += [curve.data_path, curve.driver.expression, *targets]
    if isinstance(one, bpy.types.Object):
        things = (one, *(one.pose.bones if one.pose else ()))
        texts += [constraint.name for thing in things for constraint in thing.constraints] + [modifier.name for modifier in one.modifiers]
    if isinstance(one, bpy.types.NodeTree):
        texts += [socket.default_value for node in one.nodes for socket in node.inputs if socket.type == 'STRING']
    return [f"{one.name}: {text}" for text in texts if OURS.search(text)]
