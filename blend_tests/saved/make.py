"""Makes a folder of saved files, one for each system, with the numbers that the files give.

./motus blender --version 3.4 -b --factory-startup --python-exit-code 1 --python blend_tests/saved/make.py -- FOLDER [NAME...]

A folder that exists is never made again: its files stand for the version of Motus that saved them (docs/tests.md).
"""

import sys
import tarfile
import tempfile
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import support
from chroma import chroma_cases
from dynamics import dynamics_cases
from ik import ik_cases
from lattice import lattice_cases
from layers import layer_cases
from look_at import look_at_cases
from path import path_cases
from pull.pins import pin_cases
from saved import saved_cases
from support import key, link
from walker import walker_cases

motus = bpy.ops.motus


def course(name="Course"):
    data = path_cases.curve_data(name)
    path_cases.add_bezier(data, path_cases.cubic_knots(path_cases.CLIMB))
    return link(name, data)


def rig(name, build_bones, place=(0.0, 0.0, 0.0)):
    made = link(name, bpy.data.armatures.new(name), place)
    bpy.context.view_layer.objects.active = made
    bpy.ops.object.mode_set(mode='EDIT')
    build_bones(made.data.edit_bones)
    bpy.ops.object.mode_set(mode='OBJECT')
    for bone in made.pose.bones:
        bone.rotation_mode = 'QUATERNION'
    return made


def floor(name, place, half=1.0):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(-half, -half, 0.0), (half, -half, 0.2), (half, half, 0.0), (-half, half, 0.1)], [], [(0, 1, 2, 3)])
    return link(name, mesh, place)


# --- A scene for each system ----------------------------------------------------------------------------------------------


def path():
    """Followers with every kind of timing and orientation, a hooked curve, and a property that an output drives."""
    curve = course()
    curve.rotation_euler.z = 0.3
    for name in ("Eased", "Speeding", "Stopping", "Keyed", "Leaning", "Gauge"):
        link(name)
    motus.path_follow_add(object="Eased", curve="Course", duration=4.0, ease_in=0.3, ease_out=0.2)
    motus.path_follow_add(object="Speeding", curve="Course", timing='SPEED', extend='PING_PONG', orientation='MINIMAL')
    key(bpy.data.objects["Speeding"].motus.path, "speed", {1: 0.5, 20: 3.0, 60: -1.0})
    motus.path_follow_add(object="Stopping", curve="Course", timing='PINS', orientation='TILT')
    for frame, fraction in ((1, 0.0), (40, 0.7), (110, 0.2)):
        motus.path_pin_add(object="Stopping", frame=frame, fraction=fraction)
    motus.path_follow_add(object="Keyed", curve="Course", timing='MANUAL', orientation='CURVATURE', influence=0.75)
    key(bpy.data.objects["Keyed"].motus.path, "distance_factor", {1: 0.1, 50: 0.8})
    motus.path_follow_add(
        object="Leaning", curve="Course", timing='SPEED', speed=2.0, orientation='BANKING', bank_strength=0.8, extend='LOOP', lag_rate=0.5
    )
    driver = bpy.data.objects["Gauge"].driver_add("location", 0).driver
    variable = driver.variables.new()
    variable.name = "v"
    variable.targets[0].id, variable.targets[0].data_path = bpy.data.objects["Eased"], '["motus_path_out"][3]'
    driver.expression = "v"


def train():
    """A train, whose wagons have no settings, and followers of the same curve that share a solver."""
    course()
    names = ["Engine", *(f"Wagon {index}" for index in range(1, 4))]
    for name in (*names, *(f"Follower {index}" for index in range(4))):
        link(name, None, (1.0, 2.0, 3.0))
    motus.path_train_add(objects=",".join(names), curve="Course", gap=0.7, speed=0.5, timing='SPEED', orientation='BANKING')
    for index in range(4):
        motus.path_follow_add(object=f"Follower {index}", curve="Course", timing='SPEED', speed=1.0 + 0.1 * index, extend='LOOP')


def ik():
    """An arm with a pole, keyed weights and two targets; and a long chain that stretches, on a rig that is turned and scaled."""

    def bones(edit_bones):
        ik_cases.add_chain(edit_bones, "Arm", ik_cases.ARM, None)
        ik_cases.add_chain(edit_bones, "Tentacle", ik_cases.tentacle(8, 0.2), None)

    made = rig("Rig", bones)
    made.rotation_euler, made.scale = (0.1, 0.2, 0.3), (1.5, 1.5, 1.5)
    for name, places in (
        ("Target", {1: (0.9, 0.5, 2.0), 60: (0.3, 1.0, 1.5)}),
        ("Second", {1: (1.4, 0.0, 1.0)}),
        ("Far", {1: (0.5, 0.0, 1.5), 50: (2.0, 1.0, 2.5)}),
    ):
        key(link(name), "location", places)
    link("Pole", None, (0.5, -2.0, 1.5))
    motus.ik_add(object="Rig", bone="Arm 1", target="Target", pole="Pole", softness=0.1)
    motus.ik_target_add(object="Rig", bone="Arm 1", target="Second")
    motus.ik_add(object="Rig", bone="Tentacle 7", target="Far", chain_length=0, stretch=1.0, rotation_weight=0.5)
    key(made.motus.ik.entries["Arm 1"], "position_weight", {1: 1.0, 50: 0.4})
    key(made.motus.ik.entries["Arm 1"], "target_blend", {1: 0.0, 100: 1.0})
    made.pose.bones["Arm 0"].keyframe_insert("rotation_quaternion", frame=1)
    made.pose.bones["Arm 0"].rotation_quaternion = (0.9, 0.1, 0.4, 0.0)
    made.pose.bones["Arm 0"].keyframe_insert("rotation_quaternion", frame=80)


def look_at():
    figure = look_at_cases.build_rig(name="Figure")
    figure.location.x = 1.0
    key(link("Target"), "location", {1: (2.0, -3.0, 2.0), 60: (-3.0, -2.0, 1.0)})
    motus.look_at_add(object="Figure", bone="Head", target="Target", eyes_weight=0.8, body_weight=0.4, clamp=0.2)
    key(figure.motus.look_at.entries["Head"], "weight", {1: 1.0, 90: 0.5})


def layers():
    puppet = look_at_cases.build_rig(name="Puppet")
    layer_cases.play(puppet, layer_cases.turning("Walk", layer_cases.WALKING))
    layer_cases.turning("Wave", layer_cases.THROWING)
    motus.layer_add(object="Puppet", action="Wave", bones="Chest", start=5.0, after='REPEAT', in_armature=True, feather=1)
    motus.layer_add(
        object="Puppet", action="Walk", layer="More", mode='ADDITIVE', start=1.0, after='HOLD', speed=0.5, mask='ALL', blend_in=4.0
    )
    key(puppet.motus.layers.entries[0], "weight", {1: 0.3, 40: 1.0})


def dynamics():
    parcel = dynamics_cases.moved("Parcel")
    motus.dynamics_add(object="Parcel", style='BOUNCY', channels={'LOCATION', 'ROTATION', 'SCALE'})
    link("Ribbon", None, (0.0, 1.0, 0.0)).parent = parcel
    motus.dynamics_add(object="Ribbon", style='FLOPPY', follow='WORLD', delay=0.1)
    rope = dynamics_cases.rope(3)
    motus.dynamics_add(object=rope.name, bones="Tail 0 0", whole_chains=True, chain_delay=0.05)
    key(link("Balloon"), "scale", {1: (1.0, 1.0, 1.0), 20: (2.0, 0.5, 1.5)})
    motus.dynamics_add(object="Balloon", data_path="scale", style='JELLY')
    turning = link("Turning")
    key(turning, "rotation_euler", {1: (0.0, 0.0, 0.0), 13: (0.5, 0.0, 1.0), 25: (0.0, 0.0, 0.0)})
    motus.dynamics_add(object="Turning", style='HEAVY', use_loop=True, loop_start=1, loop_end=25)


def pull():
    """Pins that are keyed, mirrored, and measured along the surface, on a mesh that a shape key deforms too."""
    grid = pin_cases.new_grid(13)
    middle = pin_cases.centre(grid)
    pin_cases.key_strength(pin_cases.add(grid, middle, (0.1, 0.0, 1.0)), {1: 0.0, 40: 1.0})
    pin_cases.add(grid, pin_cases.vertex_at(grid, 0.7, 0.7), (0.0, 0.0, -0.5), 0.6, falloff='SPHERE', distance='SURFACE')
    pin_cases.add(grid, pin_cases.vertex_at(grid, -0.7, 0.3), (0.0, 0.3, 0.5), 0.5, falloff='SHARP', mirror={'Y'})
    key(grid.motus.pull, "influence", {1: 1.0, 100: 0.5})


def lattice():
    ball = lattice_cases.ball(points=60)
    motus.lattice_fit(objects=ball.name, use_parent=False, resolution=(3, 3, 3))
    fitted = bpy.context.object
    fitted.data.points[0].co_deform.z += 0.4
    fitted.data.points[26].co_deform.x -= 0.3
    key(fitted, "location", {1: (0.0, 0.0, 0.0), 40: (0.5, 0.0, 0.2)})


def pendulum():
    hook = link("Hook", None, (0.0, -5.0, 3.0))
    motus.pendulum_add(object="Hook", kind='DOUBLE', length2=0.7, mass2=1.5)
    key(hook.motus.pendulum, "speed", {1: 0.5, 40: 0.8})
    key(link("Crane"), "location", {1: (5.0, -5.0, 3.0), 20: (6.0, -5.0, 3.0), 40: (8.0, -5.0, 3.5)})
    motus.pendulum_add(object="Crane", kind='SINGLE', use_pivot_motion=True, damping=0.2)
    motus.pendulum_add(kind='FAN', count=3, use_trails=True, location=(0.0, -8.0, 3.0), angle1=1.0)


def drivers():
    for index, function in enumerate(('PENDULUM', 'DOUBLE_PENDULUM', 'EASE', 'NOISE')):
        link(function.title(), None, (index, 0.0, 0.0))
        motus.driver_add(datablock=function.title(), data_path="location", index=2, function=function, amplitude=1.5)
    sprung = link("Sprung")
    key(sprung, "location", {1: (0.0, -2.0, 0.0), 10: (1.0, -2.0, 0.0), 40: (0.0, -2.0, 1.0)})
    motus.driver_add(datablock="Sprung", data_path="location", index=0, function='SECOND_ORDER', response=2.0)
    dial = link("Dial")
    dial["level"] = 1.0
    motus.driver_add(datablock="Dial", data_path='["level"]', function='NOISE', seed=3, speed=2.0)


def snow():
    """Snow that is blown about and lands on a mesh that moves, shown as flakes; and bare points of an emitter that moves."""
    ground = floor("Ground", (0.0, 0.0, 0.0))
    key(ground, "location", {1: (0.0, 0.0, 0.0), 50: (0.5, 0.0, 0.3)})
    motus.snow_add(preset='GENTLE', rate=30.0, lifetime=3.0, collider="Ground", collision='SLIDE', location=(0.0, 0.0, 2.5))
    cloud = bpy.context.object
    motus.snow_colliders_record(object=cloud.name)
    key(cloud.motus.snow, "wind", {1: (0.0, 0.0, 0.0), 40: (1.0, 0.5, 0.0)})
    motus.snow_add(preset='SPARKS', rate=40.0, lifetime=1.0, look='POINTS', burst=20, location=(5.0, 0.0, 1.0))
    key(bpy.context.object, "location", {1: (5.0, 0.0, 1.0), 60: (5.0, 3.0, 2.0)})


def snow_cover():
    meadow = floor("Meadow", (0.0, 0.0, 0.0))
    motus.snow_add(preset='GENTLE', rate=40.0, lifetime=2.0, location=(0.0, 0.0, 1.5))
    motus.snow_cover_add(surfaces=meadow.name, emitters=bpy.context.object.name, lump=0.2, resolution=0.25)
    key(bpy.context.object.motus.snow_cover, "influence", {1: 1.0, 100: 0.5})


def stereo():
    for name, convergence in (("Eyes", 'BUDGET'), ("Looking", 'OBJECT')):
        camera = link(name, bpy.data.cameras.new(name), (2.0, -20.0, 1.0))
        camera.rotation_euler.x = 1.5
        keywords = {"focus": link("Focus", None, (2.0, -3.0, 1.0)).name} if convergence == 'OBJECT' else {}
        motus.stereo_rig_add(object=name, convergence=convergence, **keywords)
    bpy.context.scene.camera = bpy.data.objects["Eyes"]
    key(bpy.data.objects["Eyes"].motus.stereo, "near", {1: 2.0, 40: 5.0})
    key(bpy.data.objects["Eyes"].data, "lens", {1: 35.0, 100: 60.0})
    key(bpy.data.objects["Focus"], "location", {1: (2.0, -3.0, 1.0), 50: (2.0, -10.0, 1.0)})


def chroma():
    """Footage that is packed into the file, with keyed levels and a mask."""
    picture = np.ones((24, 32, 4)) * (*chroma_cases.GREEN, 1.0)
    picture[6:-6, 10:-10, :3] = 0.4
    written = bpy.data.images.load(chroma_cases.written(picture, Path(bpy.app.tempdir, "footage.png")))
    written.name = "Footage"
    written.pack()
    motus.chroma_key_setup(clip="Footage", black=0.1, white=0.8, smooth=1, feather=2, despill=0.7, light_wrap=0.2)
    motus.chroma_mask_add(kind='GARBAGE')


def walker():
    land = walker_cases.grid("Land", walker_cases.waves, half=2.0, count=9)
    spider = walker_cases.spider(ahead=0.0, legs=4, ground=land.name)
    # Nothing of the spider's skin is computed by Motus, and it is most of the file.
    bpy.data.objects.remove(bpy.data.objects["Spider Mesh"])
    support.key_places(spider, {1: (0.0, 0.0, 0.0), 60: (0.5, 1.0, 0.1)})
    body, shell, feet = walker_cases.cross("Robot")
    motus.walker_add(object=body.name, feet=walker_cases.names(feet), body=shell.name, gait='TROT')
    support.key_places(body, {1: (9.0, 0.0, 0.0), 40: (9.0, 1.0, 0.0)})


def together():
    """What comes before what among the bones of one rig: layers, a chain on top of these, a head, and a tail that follows."""
    layers()
    puppet = bpy.data.objects["Puppet"]
    key(link("Target"), "location", {1: (1.5, -2.0, 1.6), 60: (-2.0, -2.0, 1.2)})
    motus.look_at_add(object="Puppet", bone="Head", target="Target")
    link("Hold", None, (0.5, -0.2, 1.4)).parent = puppet
    motus.ik_add(object="Puppet", bone="LowerArm.L", target="Hold", chain_length=2, softness=0.05)
    motus.dynamics_add(object="Puppet", bones="Thigh.L", style='BOUNCY')
    course()
    motus.path_follow_add(object="Puppet", curve="Course", duration=6.0)


def baked():
    """What was baked, with its live set-up put aside."""
    course()
    link("Car", None, (1.0, 2.0, 3.0))
    motus.path_follow_add(object="Car", curve="Course", duration=4.0, ease_in=0.5)
    motus.bake(object="Car", frame_start=1, frame_end=60, step=4)
    arm = rig("Arm", lambda bones: ik_cases.add_chain(bones, "Bone", ik_cases.ARM, None))
    key(link("Target"), "location", {1: (0.6, 0.3, 1.4), 60: (0.2, 0.7, 1.2)})
    motus.ik_add(object=arm.name, bone="Bone 1", target="Target")
    motus.bake(object=arm.name, frame_start=1, frame_end=60, step=4)


SCENES = (
    path,
    train,
    ik,
    look_at,
    layers,
    dynamics,
    pull,
    lattice,
    pendulum,
    drivers,
    snow,
    snow_cover,
    stereo,
    chroma,
    walker,
    together,
    baked,
)


def make(build, blend):
    """Build and save one scene; returns all that is kept of it, as the opened file gives it."""
    support.empty_scene()
    bpy.context.scene.render.fps = 24
    bpy.context.scene.frame_set(1)
    build()
    bpy.context.view_layer.update()
    # Not compressed: the archive is, and finds what is the same in all files, which is most of each.
    bpy.ops.wm.save_as_mainfile(filepath=str(blend), compress=False)
    saved_cases.open_file(blend)
    return saved_cases.whole(build.__name__)


def main(folder, *names):
    support.enable()
    folder = saved_cases.HERE / folder
    folder.mkdir()
    with (
        tempfile.TemporaryDirectory(prefix="motus-saved-") as place,
        tarfile.open(folder / saved_cases.ARCHIVE, "w:xz", preset=9) as archive,
    ):
        for build in SCENES:
            if not names or build.__name__ in names:
                blend = Path(place, f"{build.__name__}.blend")
                saved_cases.write(folder / f"{build.__name__}.json", make(build, blend))
                archive.add(blend, blend.name)


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
