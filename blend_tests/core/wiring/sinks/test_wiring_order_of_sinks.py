"""Where sinks come to stand among an object's own constraints."""

import math

import bpy
from mathutils import Vector

from path.path_cases import PathTestCase

SUBJECT = Vector((3.0, 6.0, 1.0))


class AimedTestCase(PathTestCase):
    """A camera that aims at a subject by a constraint of its own, before it is put on rails."""

    def setUp(self):
        super().setUp()
        self.points('POLY', [(0, 0, 0), (8, 8, 2)])
        self.subject = self.link("Subject")
        self.subject.location = SUBJECT

    def camera(self, kind='TRACK_TO', name="Camera"):
        camera = self.link(name, bpy.data.cameras.new(name))
        track = camera.constraints.new(kind)
        track.target, track.track_axis = self.subject, 'TRACK_NEGATIVE_Z'
        if kind == 'TRACK_TO':
            track.up_axis = 'UP_Y'
        return camera

    def off(self, camera, frame=None):
        """Degrees between where the camera looks and the subject."""
        world = self.at(camera, frame)
        return math.degrees((world.to_3x3() @ Vector((0, 0, -1))).angle(SUBJECT - world.translation))

    def kinds(self, obj):
        return ["Motus" if one.name.startswith("Motus") else one.type for one in obj.constraints]


class Aimed(AimedTestCase):
    def test_goes_on_to_aim(self):
        for kind in ('TRACK_TO', 'DAMPED_TRACK'):
            for orientation in ('NONE', 'WORLD_UP'):
                camera = self.camera(kind, f"{kind} {orientation}")
                self.follow(camera.name, timing='MANUAL', distance_factor=0.5, orientation=orientation)
                with self.subTest(kind=kind, orientation=orientation):
                    self.assertLess(self.off(camera), 0.01)
                    self.assertPlace(camera, (4.0, 4.0, 1.0) + 0 * self.place(camera))
                    self.assertEqual(self.kinds(camera)[-1], kind)

    def test_only_what_aims_last_stays_last(self):
        camera = self.camera()
        limit = camera.constraints.new('LIMIT_SCALE')
        camera.constraints.move(1, 0)
        locked = camera.constraints.new('LOCKED_TRACK')
        locked.target = self.subject
        self.follow("Camera")
        self.assertEqual([kind for kind in self.kinds(camera) if kind != "Motus"], ['LIMIT_SCALE', 'TRACK_TO', 'LOCKED_TRACK'])
        self.assertEqual(self.kinds(camera)[:2], ['LIMIT_SCALE', "Motus"])
        self.assertEqual(camera.constraints.active, locked)
        bpy.ops.motus.path_follow_remove(object="Camera")
        camera.constraints.move(camera.constraints.find(limit.name), len(camera.constraints) - 1)
        self.follow("Camera")
        self.assertEqual(self.kinds(camera)[:3], ['TRACK_TO', 'LOCKED_TRACK', 'LIMIT_SCALE'])

    def test_a_place_chosen_by_hand_is_kept(self):
        """Wired anew, as when a setting comes to be keyed: sinks stand where the artist has put them."""
        camera = self.camera()
        self.follow("Camera")
        camera.constraints.move(camera.constraints.find("Track To"), 0)
        wanted = self.kinds(camera)
        self.assertEqual(wanted[0], 'TRACK_TO')
        for _ in range(2):
            bpy.ops.motus.refresh(object="Camera", system="path")
            self.assertEqual(self.kinds(camera), wanted)
        camera.keyframe_insert("motus.path.offset", frame=1)
        self.at(camera, 5)
        self.at(camera, 6)
        self.assertEqual(self.kinds(camera), wanted)

    def test_wagons(self):
        self.camera(name="First")
        wagon = self.camera(name="Second")
        bpy.ops.motus.path_train_add(objects="First,Second", curve="Course", gap=2.0, speed=2.0)
        for frame in (30, 60):
            self.assertLess(self.off(wagon, frame), 0.01)

    def test_sway_in_place(self):
        """Dynamics of the location alone leave the aim be; a turn on top of it comes after it."""
        for channels, last in (({'LOCATION'}, 'TRACK_TO'), ({'ROTATION'}, "Motus")):
            camera = self.camera(name=f"Handheld {sorted(channels)}")
            for frame, x in ((1, 0.0), (10, 3.0), (20, 0.0)):
                camera.location.x = x
                camera.keyframe_insert("location", frame=frame)
            bpy.ops.motus.dynamics_add(object=camera.name, channels=channels)
            self.assertEqual(self.kinds(camera)[-1], last)
            if last == 'TRACK_TO':
                self.assertLess(self.off(camera, 15), 0.01)

    def test_on_an_override(self):
        self.camera()
        path = self.save()
        override = self.load(path, True, "Camera").override_create(remap_local_usages=True)
        self.scene = bpy.context.scene
        self.points('POLY', [(0, 0, 0), (8, 8, 2)], name="Rails")
        self.follow(override.name, "Rails", timing='MANUAL', distance_factor=0.5)
        self.assertIn('TRACK_TO', self.kinds(override))
        self.assertLess(self.off(override), 0.01)
        bpy.ops.wm.save_as_mainfile(filepath=path + "2.blend")
        bpy.ops.wm.open_mainfile(filepath=path + "2.blend")
        override, self.scene = next(obj for obj in bpy.data.objects if obj.override_library), bpy.context.scene
        self.assertLess(self.off(override), 0.01)
        self.assertPlace(override, self.place(override) * 0 + (4.0, 4.0, 1.0))
