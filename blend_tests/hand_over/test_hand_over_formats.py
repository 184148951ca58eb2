"""motus.hand_over in formats for other programs: what a Blender without the add-on reads of the files is what the original shows."""

import json

import bpy
import numpy as np

import live_scenes
import support
from hand_over import hand_over_cases, test_hand_over_refusals

FRAMES = (1, 7, 16, 24)
READS = """
import json
import bpy, numpy
from hand_over import test_hand_over_formats
if not hasattr(numpy, "bool"):  # NumPy lacked it for some versions, and the importer of glTF of Blender 3.4 needs it
    numpy.bool = bool
found = {{}}
for name, path in {paths!r}.items():
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = 24
    test_hand_over_formats.IMPORTERS[name](path)
    found[name] = test_hand_over_formats.{what}()
print("FOUND", json.dumps(found))
"""
IMPORTERS = {
    'GLTF': lambda path: bpy.ops.import_scene.gltf(filepath=path),
    'USD': lambda path: bpy.ops.wm.usd_import(filepath=path),
    'ALEMBIC': lambda path: bpy.ops.wm.alembic_import(filepath=path, as_background_job=False),
    'FBX': lambda path: bpy.ops.import_scene.fbx(filepath=path, anim_offset=0.0),
}
NEAR = {'GLTF': 2e-5, 'USD': 2e-5, 'ALEMBIC': 2e-5, 'FBX': 2e-4}
"""Largest difference in metres; FBX has centimetres in single precision, and angles in degrees."""


def places():
    """{name of an object or bone, or of a mesh: places on FRAMES}: origins, heads of bones, and corners of meshes."""
    found = {}
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        for obj in bpy.context.scene.objects:
            evaluated = obj.evaluated_get(depsgraph)
            found.setdefault(obj.name, []).append(tuple(evaluated.matrix_world.translation))
            for bone in evaluated.pose.bones if evaluated.pose else ():
                found.setdefault(bone.name, []).append(tuple(evaluated.matrix_world @ bone.head))
            if obj.type == 'MESH':
                places = [evaluated.matrix_world @ vertex.co for vertex in evaluated.data.vertices]
                # Exporters split and order vertices as they like.
                sizes = [(min(one[axis] for one in places), max(one[axis] for one in places)) for axis in range(3)]
                found.setdefault(f"mesh {obj.name}", []).append([part for pair in sizes for part in pair])
    return found


def flakes():
    """Of an imported file, for each of FRAMES: points as sorted rows (place, radius, velocity), and the box around all meshes."""
    found = []
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        rows, places = [], []
        for obj in bpy.context.scene.objects:
            evaluated = obj.evaluated_get(depsgraph)
            if obj.type == 'POINTCLOUD' and len(evaluated.data.points):
                named = evaluated.data.attributes
                parts = (named["position"].data, "vector", 3), (named["radius"].data, "value", 1), (named["velocity"].data, "vector", 3)
                rows += np.hstack([numbers(*part) for part in parts]).tolist()
            elif obj.type == 'MESH':
                places += [evaluated.matrix_world @ vertex.co for vertex in evaluated.data.vertices]
        found.append((sorted(rows), box(places)))
    return found


def numbers(items, name, size):
    """Rows of a property of items."""
    rows = np.empty(size * len(items), np.float32)
    items.foreach_get(name, rows)
    return rows.reshape(-1, size)


def box(places):
    """Smallest and largest coordinates of places."""
    return [[float(min(one[axis] for one in places)), float(max(one[axis] for one in places))] for axis in range(3)] if places else []


def own_flakes(emitter):
    """What flakes() is to find of an emitter that stands in this file."""
    found = []
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        mesh = emitter.motus.snow.hub.evaluated_get(depsgraph).data
        rows = []
        if len(mesh.vertices):
            radius, velocity = (mesh.attributes[name].data for name in ("radius", "velocity"))
            parts = (mesh.vertices, "co", 3), (radius, "value", 1), (velocity, "vector", 3)
            rows = sorted(np.hstack([numbers(*part) for part in parts]).tolist())
        corners = [
            one.matrix_world @ vertex.co
            for one in depsgraph.object_instances
            if one.object.original == emitter or (one.is_instance and one.parent.original == emitter)
            for vertex in one.object.data.vertices
        ]
        found.append((rows, box(corners)))
    return found


def skinned_arm():
    """An arm that reaches for a moving target, and a mesh on its bones."""
    target = support.link("Target", location=(0.6, 0.3, 1.4))
    support.key_places(target, {1: (0.6, 0.3, 1.4), 24: (0.2, 0.7, 1.2)})
    live_scenes._rigs()
    for name in ("Figure", "Puppet"):
        bpy.data.objects.remove(bpy.data.objects[name])
    arm = bpy.data.objects["Arm"]
    bpy.ops.mesh.primitive_cube_add(size=0.2)
    skin = bpy.context.object
    skin.name = skin.data.name = "Skin"
    skin.parent = arm
    skin.vertex_groups.new(name="Bone 1").add(range(8), 1.0, 'REPLACE')
    skin.modifiers.new("Armature", 'ARMATURE').object = arm


class TestFormats(support.SceneTestCase):
    def test_what_is_read_back_is_where_it_was(self):
        bpy.context.scene.render.fps = 24
        test_hand_over_refusals.follower()
        bpy.ops.mesh.primitive_cube_add(size=0.5)
        body = bpy.context.object
        body.name = body.data.name = "Body"
        body.parent = bpy.data.objects["Car"]
        skinned_arm()
        expected = places()
        formats = support.addon("hand_over.formats")
        there = {name for name in formats.FORMATS if self.is_there(formats, name)}
        path = hand_over_cases.handed_over(self, end=24, formats=there)
        files = {name: str(path.with_suffix(formats.FORMATS[name].suffix)) for name in sorted(there)}
        self.assertEqual({one.name for one in self.folder.iterdir()}, {path.name, *(f"out{formats.FORMATS[one].suffix}" for one in there)})
        status, output = support.run_beside(READS.format(paths=files, what="places"), enabled=False)
        self.assertEqual(status, 0, output)
        found = json.loads(output.partition("FOUND ")[2].splitlines()[0])
        for name in sorted(there):
            for thing in self.carried_by(name):
                with self.subTest(format=name, thing=thing):
                    is_spaced = name == 'USD' and not thing.startswith("mesh ")  # USD's names have no spaces
                    known = thing.replace(" ", "_") if is_spaced else thing
                    self.assertIn(known, found[name])
                    error = np.abs(np.array(found[name][known]) - np.array(expected[thing])).max()
                    self.assertLess(error, NEAR[name])

    def test_flakes(self):
        formats = support.addon("hand_over.formats")
        there = {name for name in ("ALEMBIC", "USD") if self.is_there(formats, name)}
        if not there:
            self.skipTest("this Blender has no exporter of a format with flakes")
        bpy.context.scene.render.fps = 24
        bpy.ops.motus.snow_add(rate=40.0, lifetime=0.7, location=(1.0, 2.0, 5.0))
        emitter = bpy.context.object
        path = hand_over_cases.handed_over(self, end=24, formats=there)
        emitter.motus.snow.all_attributes = True
        expected = own_flakes(emitter)
        self.assertGreater(len(expected[-1][0]), 10)
        files = {name: str(path.with_suffix(formats.FORMATS[name].suffix)) for name in sorted(there)}
        status, output = support.run_beside(READS.format(paths=files, what="flakes"), enabled=False)
        self.assertEqual(status, 0, output)
        found = json.loads(output.partition("FOUND ")[2].splitlines()[0])
        for index, (rows, corners) in enumerate(expected[1:], 1):  # there are no flakes on the first frame
            with self.subTest(frame=FRAMES[index]):
                points, _ = found["USD"][index]
                self.assertEqual(len(points), len(rows))
                self.assertLess(np.abs(np.array(points) - np.array(rows)).max(), 1e-5)
                _, around = found["ALEMBIC"][index]
                self.assertLess(np.abs(np.array(around) - np.array(corners)).max(), 1e-5)

    @staticmethod
    def carried_by(name):
        """Names of what a format carries: Alembic has no skeletons."""
        return ("Body", "mesh Body", "mesh Skin") if name == 'ALEMBIC' else ("Body", "Bone 0", "Bone 1", "mesh Body", "mesh Skin")

    @staticmethod
    def is_there(formats, name):
        try:
            formats.check({name})
        except support.addon("core.refusals").Refused:
            return False
        return True

    def test_what_this_blender_has_no_exporter_for(self):
        formats = support.addon("hand_over.formats")
        lacking = [name for name in formats.FORMATS if not self.is_there(formats, name)]
        if not lacking:
            self.skipTest("this Blender has all exporters")
        test_hand_over_refusals.follower()
        self.assertRefused(
            "has no exporter for", bpy.ops.motus.hand_over, filepath=str(self.folder / "out.blend"), start=1, end=9, formats=set(lacking)
        )
