"""Wired scenes in other files and other Blenders.

Reopened, appended, linked, overridden, without Auto Run, without the add-on, rendered.
"""

import json
import subprocess
from unittest import mock

import bpy

import support
import toy_system
from core.wiring.wiring_cases import KINDS, WiringTestCase, build_followers, build_object, each_kind, frame_set

FRAMES = (12, 40.5)
MARK = "RESULT "


def build_all():
    """Every kind in one scene: kind -> (owner, things)."""
    target = toy_system.new_target()
    return {build.__name__: build(target) for build in KINDS}


def address(thing):
    return [thing.id_data.name, thing.name if isinstance(thing, bpy.types.PoseBone) else ""]


def find(place):
    name, bone = place
    return bpy.data.objects[name].pose.bones[bone] if bone else bpy.data.objects[name]


def matrices(addresses):
    """Evaluated matrices of all addresses at all FRAMES, as plain lists."""
    collected = []
    for frame in FRAMES:
        frame_set(frame)
        collected.append([[list(row) for row in toy_system.world_matrix(find(place))] for place in addresses])
    return collected


def print_matrices(path, addresses, use_scripts):
    """In another Blender: open a file and print what matrices() finds."""
    bpy.ops.wm.open_mainfile(filepath=path, use_scripts=use_scripts)
    print(MARK + json.dumps(matrices(addresses)), flush=True)


class FileTest(WiringTestCase):
    def save(self):
        path = str(self.folder / "wired.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        return path

    def assert_same(self, found, wanted, tolerance=1e-5):
        self.assertEqual(len(found), len(wanted))
        for frame, wanted_frame in zip(found, wanted):
            for matrix, wanted_matrix in zip(frame, wanted_frame):
                self.assert_same_matrix(matrix, wanted_matrix, tolerance)

    def in_another_blender(self, path, addresses, use_scripts=True, enabled=True):
        register = "import toy_system\ntoy_system.register()" if enabled else ""
        tests = "healing.test_wiring_files" if enabled else "bare"
        status, output = support.run_beside(
            f"{register}\nimport core.wiring.{tests} as tests\ntests.print_matrices({path!r}, {addresses!r}, {use_scripts!r})\n",
            enabled=enabled,
        )
        self.assertEqual(status, 0, output)
        return json.loads(output.split(MARK)[1].splitlines()[0])

    def test_reopened(self):
        things = [thing for _, driven in build_all().values() for thing in driven]
        addresses = [address(thing) for thing in things]
        live = matrices(addresses)
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        self.assert_same(matrices(addresses), live, 0.0)
        found = self.in_another_blender(path, addresses)
        self.assert_same(found, live)

    @each_kind
    def test_wired_by_another_version(self, build):
        """Healing wires such an owner anew after the first evaluation, as it does with any other signature."""
        owner, things = build(toy_system.new_target())
        name, addresses, wired = owner.name, [address(thing) for thing in things], owner.motus.orbit.wired
        live = matrices(addresses)
        owner.motus.orbit.wired = f"1 {wired.split()[1]}"
        with mock.patch.object(support.addon("core.wiring.attaching.attach"), "refresh_changed"):
            path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        self.assert_same(matrices(addresses), live, 0.0)
        self.assertEqual(bpy.data.objects[name].motus.orbit.wired.split()[0], wired.split()[0])

    def test_without_auto_run(self):
        kinds = {name: [address(thing) for thing in things] for name, (_, things) in build_all().items()}
        addresses = [one for driven in kinds.values() for one in driven]
        live = matrices(addresses)
        found = self.in_another_blender(self.save(), addresses, use_scripts=False)
        for name, driven in kinds.items():
            with self.subTest(name):
                places = [addresses.index(one) for one in driven]
                self.assert_same(*([[frame[place] for place in places] for frame in frames] for frames in (found, live)))

    def test_without_the_add_on(self):
        kinds = build_all()
        addresses = [address(thing) for _, driven in kinds.values() for thing in driven]
        path = self.save()
        for owner, _ in kinds.values():
            owner.motus.orbit.influence = 0.0
        own = matrices(addresses)
        found = self.in_another_blender(path, addresses, enabled=False)
        self.assert_same(found, own)

    def test_appended(self):
        for build in KINDS:
            with self.subTest(build.__name__):
                support.empty_scene()
                _, things = build(toy_system.new_target())
                addresses = [address(thing) for thing in things]
                live = matrices(addresses)
                folder = f"{self.save()}/Object/"
                support.empty_scene()
                # One driven thing alone: Blender brings what it needs.
                name = addresses[0][0]
                bpy.ops.wm.append(filepath=folder + name, directory=folder, filename=name)
                self.assert_same(matrices(addresses), live)

    def test_linked(self):
        for build in KINDS:
            with self.subTest(build.__name__):
                support.empty_scene()
                _, things = build(toy_system.new_target())
                addresses = [address(thing) for thing in things]
                live = matrices(addresses)
                path = self.save()
                support.empty_scene()
                with bpy.data.libraries.load(path, link=True) as (_, wanted):
                    wanted.objects = sorted({name for name, _ in addresses})
                for one in wanted.objects:
                    self.assertIsNotNone(one.library)
                    bpy.context.scene.collection.objects.link(one)
                self.assert_same(matrices(addresses), live)
                bpy.data.libraries[0].reload()
                self.assert_same(matrices(addresses), live)

    def test_linked_original_stays_untouched(self):
        build_followers(toy_system.new_target())
        path = self.save()
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.objects = ["Owner", "Follower.1"]
        for one in wanted.objects:
            bpy.context.scene.collection.objects.link(one)
        hub = wanted.objects[0].motus.orbit.hub
        saved = self.attribute_values(hub)
        frame_set(20)
        self.assertEqual(self.attribute_values(hub), saved)

    @staticmethod
    def attribute_values(hub):
        return [
            [tuple(row) for row in item.value]
            for attribute in hub.data.attributes
            if attribute.data_type == 'FLOAT4X4'
            for item in attribute.data
        ]

    def test_overridden(self):
        for build in KINDS:
            with self.subTest(build.__name__):
                support.empty_scene()
                owner, things = build(toy_system.new_target())
                name, addresses = owner.name, [address(thing) for thing in things]
                path = self.save()
                support.empty_scene()
                with bpy.data.libraries.load(path, link=True) as (_, wanted):
                    wanted.objects = sorted({name, *(one for one, _ in addresses)})
                for one in wanted.objects:
                    bpy.context.scene.collection.objects.link(one)
                owner = bpy.data.objects[name].override_create(remap_local_usages=True)
                if all(one == name for one, _ in addresses):
                    owner.motus.orbit.radius = 6.0
                    addresses = [[owner.name, bone] for _, bone in addresses]
                for frame in FRAMES:
                    frame_set(frame)
                    things = [owner if one == owner.name and not bone else find((one, bone)) for one, bone in addresses]
                    self.assert_follows(owner, [self._local(owner, thing) for thing in things])

    @staticmethod
    def _local(owner, thing):
        """The thing of the override, not its linked namesake."""
        if thing.id_data.name != owner.name:
            return thing
        return owner.pose.bones[thing.name] if isinstance(thing, bpy.types.PoseBone) else owner


class RenderTest(WiringTestCase):
    """Pictures of two squares, seen from above, that move along X by 2 a frame: one alone, one with others."""

    SIZE, WIDTH = 80, 20.0

    def setUp(self):
        super().setUp()
        target = toy_system.new_object("Target")
        target.driver_add("location", 0).driver.expression = "2.0*frame - 20.0"
        square = self._square()
        for build, y in ((build_object, 5.0), (build_followers, -5.0)):
            _, things = build(target, radius=0.0, use_rotation=False)
            things[0].delta_location = (0.0, 0.0, 0.0)
            place = toy_system.new_object("Square", (0.0, y, 0.0), square)
            place.parent = things[0]
            things[0].scale = (1.0, 1.0, 1.0)
            things[0].rotation_euler = (0.0, 0.0, 0.0)
        self._camera()
        scene = bpy.context.scene
        scene.render.engine = 'CYCLES'
        scene.cycles.samples = 64
        scene.cycles.use_denoising = False
        scene.render.resolution_x = scene.render.resolution_y = self.SIZE
        scene.render.film_transparent = True
        scene.view_settings.view_transform = 'Raw'
        scene.render.image_settings.file_format = 'PNG'
        scene.render.image_settings.color_mode = 'RGBA'

    @staticmethod
    def _square():
        mesh = bpy.data.meshes.new("Square")
        mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
        return mesh

    def _camera(self):
        data = bpy.data.cameras.new("Camera")
        data.type, data.ortho_scale = 'ORTHO', self.WIDTH
        bpy.context.scene.camera = toy_system.new_object("Camera", (0.0, 0.0, 10.0), data)

    def spans(self, path):
        """(left, right) of what is opaque in the lower and the upper half of a picture, in scene units."""
        import numpy as np

        image = bpy.data.images.load(str(path))
        alpha = np.array(image.pixels[:]).reshape(self.SIZE, self.SIZE, 4)[:, :, 3]
        half = self.SIZE // 2
        found = []
        for part in (alpha[:half], alpha[half:]):
            columns = np.flatnonzero(part.max(axis=0) > 0.01)
            self.assertGreater(len(columns), 0)
            scale = self.WIDTH / self.SIZE
            found.append((columns[0] * scale - self.WIDTH / 2, (columns[-1] + 1) * scale - self.WIDTH / 2))
        return found

    def assert_spans(self, path, left, right):
        for found in self.spans(path):
            self.assertAlmostEqual(found[0], left, delta=0.3)
            self.assertAlmostEqual(found[1], right, delta=0.3)

    def render(self, frame):
        frame_set(frame)
        path = self.folder / f"{frame}.png"
        bpy.context.scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True)
        return path

    def test_still(self):
        self.assert_spans(self.render(11), 1.0, 3.0)
        self.assert_spans(self.render(8), -5.0, -3.0)

    def test_motion_blur_in_cycles(self):
        bpy.context.scene.render.use_motion_blur = True
        bpy.context.scene.render.motion_blur_shutter = 1.0
        self.assert_spans(self.render(11), 0.0, 4.0)

    @support.needs_drawing
    def test_motion_blur_in_eevee(self):
        scene = bpy.context.scene
        support.use_eevee(scene, support.addon("core.blender.capabilities").eevee_engine(), samples=2)
        for owner in (scene.render, scene.eevee):
            if hasattr(owner, "use_motion_blur"):
                owner.use_motion_blur = True
            if hasattr(owner, "motion_blur_shutter"):
                owner.motion_blur_shutter = 1.0
        for found in self.spans(self.render(11)):
            self.assertLess(found[0], 0.6)
            self.assertGreater(found[1], 3.4)
            self.assertGreater(found[0], -0.6)
            self.assertLess(found[1], 4.6)

    def test_command_line(self):
        path = str(self.folder / "wired.blend")
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = 9, 10
        scene.frame_current = 1
        bpy.ops.wm.save_as_mainfile(filepath=path)
        register = self.folder / "register.py"
        register.write_text(
            f"import sys; sys.path.insert(0, {str(support.TESTS)!r})\nimport toy_system; toy_system.register()\n", encoding="utf-8"
        )
        out = {option: str(self.folder / f"{option}-####.png") for option in ("-f", "-a")}
        done = subprocess.run(
            [
                *support.program(),
                "-b",
                "--factory-startup",
                "--python-exit-code",
                "1",
                "--addons",
                support.module_name(),
                "--python",
                str(register),
                path,
                "-o",
                out["-f"],
                "-f",
                "12",
                "-o",
                out["-a"],
                "-a",
            ],
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=300,
            check=False,
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        for option, frame in (("-f", 12), ("-a", 9), ("-a", 10)):
            middle = 2.0 * frame - 20.0
            self.assert_spans(out[option].replace("####", f"{frame:04}"), middle - 1.0, middle + 1.0)
