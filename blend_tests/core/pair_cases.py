"""Owners that every two systems may meet on, how each system is put there, and all that can be seen of what they do."""

import bpy
import numpy as np

import support
from layers import layer_cases
from look_at import look_at_cases
from path import path_cases
from support import go_to, key, link

BONES = look_at_cases.BONES | {"Foot.L": ("", (0.1, -0.1, 0.0), (0.1, -0.3, 0.0)), "Foot.R": ("", (-0.1, -0.1, 0.0), (-0.1, -0.3, 0.0))}
FRAMES = (5, 14, 26.5, 40)
KINDS = {
    "object": ("path", "pull", "lattice", "pendulum", "snow", "snow_cover", "drivers", "walker", "dynamics"),
    "rig": ("path", "layers", "ik", "look_at", "pendulum", "drivers", "walker", "dynamics", "dynamics own", "dynamics object", "chains"),
    "camera": ("path", "pendulum", "drivers", "dynamics", "stereo", "chroma"),
    "scene": ("drivers", "stereo", "chroma"),
}
"""Kinds of owners, and the systems that each can have; dynamics in the ways in which they follow, pendulums with their trails."""
SEVERAL = {
    "object": ("pull", "lattice", "snow", "drivers"),
    "rig": ("layers", "ik", "look_at", "drivers", "dynamics", "chains"),
    "camera": ("drivers",),
    "scene": ("drivers",),
}
"""Systems of which an owner can have several entries. The second is named "<system> again", and drives something different."""
IN_ORDER = {"pull", "lattice", "walker", "snow again"}
"""Systems that are put where things stand at that moment, or whose objects are named in the order in which they are made."""
BONES_OF = {
    "layers": "UpperArm.L,LowerArm.L",
    "chains": "Head,Chest",
    "ik": "LowerArm.L,UpperArm.L",
    "look_at": "Head,Neck",
    "walker": "Hips",
}
"""Bones with dynamics, beside another system: those that it moves."""


def pairs():
    """(kind, first system, second one) of all that can meet, several entries of one system among them."""
    for kind, names in KINDS.items():
        for index, first in enumerate(names):
            for second in names[index + 1 :]:
                if first.split()[0] != second.split()[0]:
                    yield kind, first, second
    for kind, names in SEVERAL.items():
        for name in names:
            yield kind, name, f"{name} again"
    yield "rig", "dynamics", "dynamics object"


def build(kind):
    """A scene with an owner of the kind that keys move, and what systems need beside it. Returns the owner."""
    owner = _OWNERS[kind]()
    key(owner, "location", {1: (0.0, 0.0, 0.0), 12: (0.3, -0.2, 0.0), 40: (0.5, -1.5, 0.1)})
    key(owner, "rotation_euler", {1: (0.0, 0.0, 0.0), 20: (0.0, 0.2, 0.4), 40: (0.1, 0.0, 0.2)})
    key(link("Target"), "location", {1: (0.6, -0.6, 1.4), 20: (0.3, -0.5, 1.6), 40: (0.6, -1.8, 1.2)})
    course = path_cases.curve_data("Course")
    path_cases.add_bezier(course, path_cases.cubic_knots(path_cases.CLIMB))
    link("Course", course)
    for name, x in (("Left", 0.3), ("Right", -0.3)):
        link(name).location = (x, 0.0, 0.0)
    layer_cases.turning("Wave", layer_cases.THROWING, 1, 40)
    layer_cases.turning("Nod", {"Neck": (0.4, 0.0, 0.1), "Head": (0.2, 0.3, 0.0)}, 1, 40)
    bpy.context.view_layer.objects.active = owner
    bpy.context.view_layer.update()
    return owner


def add(system, kind, beside=""):
    """Put a system on the owner; raises what refuses it. beside: the other system."""
    name, _, how = system.partition(" ")
    operators, owner, is_first = bpy.ops.motus, "Owner", how != "again"
    if name == "path":
        operators.path_follow_add(object=owner, curve="Course", duration=2.0)
    elif name == "layers":
        mask = {"action": "Wave"} if is_first else {"action": "Nod", "bones": "Neck"}
        operators.layer_add(object=owner, start=1.0, after='HOLD', blend_in=8.0, **mask)
    elif name == "ik":
        operators.ik_add(object=owner, bone="LowerArm.L" if is_first else "Shin.L", target="Target")
    elif name == "look_at":
        operators.look_at_add(object=owner, bone="Head" if is_first else "Shin.L", target="Target")
    elif name == "pull":
        operators.pin_add(object=owner, vertex=0 if is_first else 24, displacement=(0.0, 0.0, 0.4))
    elif name == "lattice":
        operators.lattice_fit(objects=owner)
        bpy.context.object.data.points[0].co_deform.z += 0.4
    elif name == "pendulum":
        operators.pendulum_add(object=owner, kind='SINGLE', use_pivot_motion=True, use_trails=True)
    elif name == "snow":
        rate = 30.0 if is_first else 20.0
        operators.snow_add(surface=owner, shape='SURFACE', look='POINTS', lifetime=1.0, rate=rate, location=(0.0, 0.0, 0.0))
    elif name == "snow_cover":
        operators.snow_add(look='POINTS', lifetime=4.0, rate=15.0, location=(0.0, 0.0, 2.0))
        bpy.context.object.name = "Cloud"
        operators.snow_cover_add(surfaces=owner, emitters="Cloud", lump=0.2, resolution=0.25)
    elif name == "stereo":
        operators.stereo_rig_add(object=owner, distance=3.0)
    elif name == "chroma":
        image = bpy.data.images.new("Screen", 8, 8)
        image.pixels = [0.1, 0.6, 0.1, 1.0] * 64
        operators.chroma_key_setup(clip="Screen", camera=owner, use_plane=True)
    elif name == "drivers":
        of = {"datablock": bpy.context.scene.name, "collection": "scenes"} if kind == "scene" else {"datablock": owner}
        path, *indices = _DRIVEN.get(kind, ("scale", 2, 0))
        operators.driver_add(**of, data_path=path, index=indices[0 if is_first else 1], function='PENDULUM')
    elif name == "walker":
        more = {"feet": "Foot.L,Foot.R", "body": "Hips"} if kind == "rig" else {"feet": "Left,Right"}
        operators.walker_add(object=owner, **more)
    elif name == "chains":
        operators.chains_add(object=owner, bones="UpperArm.L" if is_first else "Thigh.L", frequency=1.0)
    elif kind == "rig" and how != "object":
        bones = bones_beside(system, kind, beside)
        operators.dynamics_add(object=owner, bones=bones, style='FLOPPY', follow='OWN' if how == "own" else 'WORLD')
    else:
        operators.dynamics_add(object=owner, style='BOUNCY')


def bones_beside(system, kind, beside):
    """The bones that are given dynamics beside another system, which is all that add() does otherwise beside another one; "" for other systems."""
    name, _, how = system.partition(" ")
    if name != "dynamics" or kind != "rig" or how == "object":
        return ""
    return BONES_OF.get(beside, "UpperArm.L,Chest") if how != "again" else "Thigh.L,Shin.L"


def sentences(owner):
    """What panels say is wrong: all problems of the owner's systems."""
    wiring, registered = support.addon("core.wiring"), support.addon("core.declare").registered
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = [
        wiring.problem(system, owner, depsgraph)
        for name, system in registered.items()
        if hasattr(system, "solve") and getattr(getattr(owner.motus, name, None), "is_active", False)
    ]
    return [str(problem) for problem in found if problem]


def seen(frames=FRAMES):
    """{(what, frame): numbers} of all that shows in the scene."""
    found = {}
    for frame in frames:
        go_to(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        scene = depsgraph.scene_eval
        found["Scene", frame] = np.array((*scene.gravity, scene.render.resolution_x, scene.render.resolution_y))
        for obj in bpy.context.scene.objects:
            evaluated = obj.evaluated_get(depsgraph)
            found[obj.name, frame] = np.array(evaluated.matrix_world)
            if obj.pose:
                for bone in evaluated.pose.bones:
                    found[f"{obj.name}: {bone.name}", frame] = np.array(evaluated.matrix_world @ bone.matrix)
            if obj.type == 'MESH':
                mesh = evaluated.to_mesh()
                places = np.empty(3 * len(mesh.vertices), np.float32)
                mesh.vertices.foreach_get("co", places)
                found[f"{obj.name}: points", frame] = places
                evaluated.to_mesh_clear()
            if obj.type == 'CAMERA':
                found[f"{obj.name}: colour", frame] = np.array(evaluated.color)
                found[f"{obj.name}: eyes", frame] = np.array(evaluated.data.stereo.convergence_distance)
    return found


def _mesh():
    mesh = bpy.data.meshes.new("Owner")
    side = [(x / 4 - 0.5, y / 4 - 0.5, 0.0) for y in range(5) for x in range(5)]
    faces = [(row * 5 + x, row * 5 + x + 1, row * 5 + x + 6, row * 5 + x + 5) for row in range(4) for x in range(4)]
    mesh.from_pydata(side, [], faces)
    return link("Owner", mesh)


def _rig():
    rig = look_at_cases.build_rig(BONES, "Owner")
    walk = layer_cases.turning("Walk", layer_cases.WALKING, 1, 40)
    actions = support.addon("core.blender.actions")
    actions.assign(rig, walk, actions.slots_for_objects(walk)[0].identifier if hasattr(walk, "slots") else "")
    return rig


def _camera():
    camera = link("Owner", bpy.data.cameras.new("Owner"))
    bpy.context.scene.camera = camera
    return camera


_OWNERS = {"object": _mesh, "rig": _rig, "camera": _camera, "scene": _camera}
_DRIVEN = {"rig": ('pose.bones["Spine"].rotation_quaternion', 1, 2), "scene": ("gravity", 2, 0)}
"""By kind the property that drivers are put on: its path, and the indices of a first and a second number."""
