"""One small scene of each system, all of it at work, and where everything in it really is."""

import atexit
import tempfile
from pathlib import Path

import bpy
import numpy as np

import support
from chains import chain_cases
from dynamics import dynamics_cases
from ik import ik_cases
from lattice import lattice_cases
from layers import layer_cases
from look_at import look_at_cases
from path import path_cases
from pull.pins import pin_cases
from walker import walker_cases

FRAMES = (1, 13, 25.5, 40)
_folder = tempfile.TemporaryDirectory(prefix="motus-test-")
atexit.register(_folder.cleanup)
FILE = Path(_folder.name, "live scenes.blend")
"""What saved() has saved in this process."""


def build():
    """Something of every system, and users' drivers.

    A follower, a train, an arm, a figure that looks, one with a layer, things with dynamics, a chain, pins, a pulled lattice, pendulums, snow, a stereo
    camera, walkers.
    """
    build_paths()
    _rigs()
    _dynamics()
    _chains()
    _meshes()
    _pendulums()
    _snow()
    _stereo()
    _walkers()
    bpy.ops.motus.driver_add(datablock=support.link("Swing").name, data_path="location", index=2, function='PENDULUM')
    sprung = support.link("Sprung", location=(0.0, -2.0, 0.0))
    support.key_places(sprung, {1: (0.0, -2.0, 0.0), 10: (1.0, -2.0, 0.0), 40: (0.0, -2.0, 1.0)})
    bpy.ops.motus.driver_add(datablock=sprung.name, data_path="location", index=0, function='SECOND_ORDER')
    bpy.context.view_layer.update()


def saved():
    """Path of a file with what build() makes, which the first call makes from the open scene; later ones leave that scene as it is."""
    if not FILE.exists():
        build()
        bpy.ops.wm.save_as_mainfile(filepath=str(FILE), copy=True)
    return str(FILE)


def opened():
    """What build() makes, as it is when it was saved and opened again."""
    bpy.ops.wm.open_mainfile(filepath=saved())
    bpy.context.view_layer.update()


def build_paths():
    """Of what build() makes the target, and what is on paths, alone."""
    target = support.link("Target", location=(0.6, 0.3, 1.4))
    support.key_places(target, {1: (0.6, 0.3, 1.4), 40: (0.2, 0.7, 1.2)})
    course = path_cases.curve_data("Course")
    path_cases.add_bezier(course, path_cases.cubic_knots(path_cases.CLIMB))
    support.link("Course", course)
    for name in ("Car", "Keyed", "Driven", "Engine", "Wagon 1", "Wagon 2"):
        support.link(name)
    bpy.ops.motus.path_follow_add(object="Car", curve="Course", duration=4.0)
    keyed = bpy.data.objects["Keyed"]
    bpy.ops.motus.path_follow_add(object="Keyed", curve="Course", timing='MANUAL')
    for frame, value in ((1, 0.1), (40, 0.8)):
        keyed.motus.path.distance_factor = value
        keyed.keyframe_insert("motus.path.distance_factor", frame=frame)
    bpy.ops.motus.path_follow_add(object="Driven", curve="Course", timing='MANUAL')
    _drive(bpy.data.objects["Driven"], "motus.path.distance_factor", "v", target, "location.x")
    racer = support.link("Racer")
    bpy.ops.motus.path_follow_add(object="Racer", curve="Course", timing='SPEED')
    for frame, speed in ((1, 0.1), (20, 0.4), (40, 0.9)):
        racer.motus.path.speed = speed
        racer.keyframe_insert("motus.path.speed", frame=frame)
    bpy.ops.motus.path_train_add(objects="Engine,Wagon 1,Wagon 2", curve="Course", gap=0.7, speed=0.5, wheelbase=0.4, side=0.2)
    # What users' own drivers read of Motus: an output, and a setting.
    _drive(support.link("Gauge"), "location", "v", bpy.data.objects["Car"], '["motus_path_out"][3]', 0)
    _drive(support.link("Shadow"), "location", "v", keyed, "motus.path.distance_factor", 1)
    bpy.context.view_layer.update()


def _rigs():
    arm = _rig("Arm", lambda bones: ik_cases.add_chain(bones, "Bone", ik_cases.ARM, None))
    bpy.ops.motus.ik_add(object=arm.name, bone="Bone 1", target="Target")
    figure = look_at_cases.build_rig(name="Figure")
    figure.location.x = 3.0
    bpy.ops.motus.look_at_add(object=figure.name, bone="Head", target="Target")
    puppet = look_at_cases.build_rig(name="Puppet")
    puppet.location.x = 6.0
    layer_cases.turning("Wave", layer_cases.THROWING)
    bpy.ops.motus.layer_add(object=puppet.name, action="Wave", bones="Chest", after='REPEAT', in_armature=True)
    for frame, weight in ((1, 0.3), (40, 1.0)):
        puppet.motus.layers.entries[0].weight = weight
        puppet.keyframe_insert("motus.layers.entries[0].weight", frame=frame)


def _dynamics():
    parcel = dynamics_cases.moved("Parcel")
    bpy.ops.motus.dynamics_add(object="Parcel", style='BOUNCY', channels={'LOCATION', 'ROTATION', 'SCALE'})
    support.link("Ribbon").parent = parcel
    bpy.ops.motus.dynamics_add(object="Ribbon", style='FLOPPY')
    rope = dynamics_cases.rope(3)
    bpy.ops.motus.dynamics_add(object=rope.name, bones="Tail 0 0", whole_chains=True, chain_delay=0.05)
    balloon = support.link("Balloon")
    dynamics_cases.key(balloon, "scale", {1: (1.0, 1.0, 1.0), 20: (2.0, 0.5, 1.5)})
    bpy.ops.motus.dynamics_add(object="Balloon", data_path="scale", style='JELLY')
    pendant = support.link("Pendant")
    pendant.parent, pendant.parent_type, pendant.parent_bone = bpy.data.objects["Arm"], 'BONE', "Bone 1"
    bpy.ops.motus.dynamics_add(object="Pendant", style='BOUNCY')


def _chains():
    braid = chain_cases.rope(3, name="Braid")
    bpy.ops.motus.chains_add(object=braid.name, bones="Tail 0 0", frequency=1.0)
    braid.motus.chains.inherit = 0.5
    bpy.ops.motus.chains_pin(object=braid.name, weight=0.3)
    beads = [support.link(f"Bead {index}", location=(0.3 * index, 5.0, 1.0)) for index in range(3)]
    bpy.ops.motus.chains_add(objects=", ".join(bead.name for bead in beads), frequency=1.0)
    cord = bpy.data.curves.new("Cord", 'CURVE')
    cord.splines.new('BEZIER').bezier_points.add(2)
    for index, point in enumerate(cord.splines[0].bezier_points):
        point.co = point.handle_left = point.handle_right = (0.3 * index, 6.0, 1.0)
    support.link("Cord", cord)
    bpy.ops.motus.chains_add(object="Cord", frequency=1.0)


def _rig(name, build_bones):
    rig = support.link(name, bpy.data.armatures.new(name))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    build_bones(rig.data.edit_bones)
    bpy.ops.object.mode_set(mode='OBJECT')
    return rig


def _meshes():
    grid = pin_cases.new_grid()
    pin_cases.key_strength(pin_cases.add(grid, pin_cases.centre(grid)), {1: 0.0, 40: 1.0})
    ball = lattice_cases.ball(place=(0.0, 5.0, 0.0))
    bpy.ops.motus.lattice_fit(objects=ball.name, use_parent=False)
    lattice = bpy.context.object
    lattice.data.points[0].co_deform.z += 0.4
    lattice.keyframe_insert("location", frame=1)
    lattice.location.x += 0.5
    lattice.keyframe_insert("location", frame=40)


def _pendulums():
    hook = support.link("Hook", location=(0.0, -5.0, 3.0))
    bpy.ops.motus.pendulum_add(object=hook.name, kind='DOUBLE')
    for frame, speed in ((1, 0.5), (40, 0.8)):
        hook.motus.pendulum.speed = speed
        hook.keyframe_insert("motus.pendulum.speed", frame=frame)
    crane = support.link("Crane", location=(5.0, -5.0, 3.0))
    bpy.ops.motus.pendulum_add(object=crane.name, kind='SINGLE', use_pivot_motion=True)
    support.key_places(crane, {1: (5.0, -5.0, 3.0), 20: (6.0, -5.0, 3.0), 40: (8.0, -5.0, 3.5)})
    bpy.ops.motus.pendulum_add(kind='FAN', count=3, use_trails=True, location=(0.0, -8.0, 3.0))
    bpy.context.object.select_set(False)


def _snow():
    bpy.ops.motus.snow_add(preset='GENTLE', rate=20.0, lifetime=2.0, look='POINTS', location=(0.0, 8.0, 5.0))
    cloud = bpy.context.object
    for frame, place in ((1, -1.0), (40, 1.0)):
        cloud.location.x = place
        cloud.keyframe_insert("location", frame=frame)
    for frame, wind in ((1, (0.0, 0.0, 0.0)), (40, (1.0, 2.0, 0.0))):
        cloud.motus.snow.wind = wind
        cloud.keyframe_insert("motus.snow.wind", frame=frame)
    cloud.select_set(False)
    meadow = support.link("Meadow", bpy.data.meshes.new("Meadow"), (0.0, 8.0, 4.0))
    meadow.data.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    bpy.ops.motus.snow_cover_add(surfaces=meadow.name, emitters=cloud.name, lump=0.2, resolution=0.3)
    cover = bpy.context.object
    for frame, influence in ((1, 1.0), (40, 0.5)):
        cover.motus.snow_cover.influence = influence
        cover.keyframe_insert("motus.snow_cover.influence", frame=frame)
    cover.select_set(False)


def _stereo():
    camera = support.link("Eyes", bpy.data.cameras.new("Eyes"), (2.0, -20.0, 1.0))
    camera.rotation_euler.x = 1.5
    bpy.ops.motus.stereo_rig_add(object=camera.name, convergence='BUDGET')
    for frame, near in ((1, 2.0), (40, 5.0)):
        camera.motus.stereo.near = near
        camera.keyframe_insert("motus.stereo.near", frame=frame)


def _walkers():
    land = walker_cases.grid("Land", walker_cases.waves, count=21)
    land.location = (0.0, 20.0, 0.0)
    spider = walker_cases.spider(ahead=0.0, legs=4, location=(0.0, 20.0, 0.0), ground="Land")
    support.key_places(spider, {1: (0.0, 20.0, 0.0), 40: (0.5, 21.0, 0.1)})
    spider.select_set(False)
    body, shell, feet = walker_cases.cross("Robot")
    bpy.ops.motus.walker_add(object=body.name, feet=walker_cases.names(feet), body=shell.name, gait='TROT')
    support.key_places(body, {1: (9.0, 0.0, 0.0), 40: (9.0, 1.0, 0.0)})


def _drive(obj, path, expression, source, source_path, index=-1):
    curve = obj.driver_add(path, index)
    variable = curve.driver.variables.new()
    variable.name = "v"
    variable.targets[0].id = source
    variable.targets[0].data_path = source_path
    curve.driver.expression = expression


def states(frames=FRAMES):
    """Frame -> state() on it."""
    return {frame: _state_on(frame) for frame in frames}


def _state_on(frame):
    support.go_to(frame)
    return state()


def state():
    """(object, bone or "mesh") -> numbers: the evaluated transforms and shapes of all that shows, as they are now."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = {}
    for obj in bpy.context.view_layer.objects:
        evaluated = obj.evaluated_get(depsgraph)
        found[obj.name, ""] = np.array(evaluated.matrix_world).ravel()
        for bone in evaluated.pose.bones if evaluated.pose else ():
            found[obj.name, bone.name] = np.array(evaluated.matrix_world @ bone.matrix).ravel()
        if obj.type == 'MESH':
            points = pin_cases.evaluated(obj)
            # What a system makes has another number of points on each frame.
            found[obj.name, "mesh"] = points.ravel() if len(obj.data.vertices) else _measured(points)
    return found


def _measured(points):
    """Numbers that say how many points there are, and where."""
    if len(points) == 0:
        return np.zeros(7)
    return np.array([len(points), *points.min(axis=0), *points.max(axis=0)])
