"""Driven rigs in other files and other Blenders.

Reopened, appended, linked, overridden, without Auto Run, without the add-on.
"""

import json

import bpy

import support
import toy_bone_system
from core.wiring.bone_cases import KINDS, LASTING_KINDS, BoneTestCase, each_lasting_kind, poses
from core.wiring.wiring_cases import frame_set

wiring = support.addon("core.wiring")
SYSTEM = toy_bone_system.SYSTEM
FRAMES = (12, 40.5)
MARK = "RESULT "


def rows(name="Rig"):
    """Evaluated pose matrices of a rig at all FRAMES, as plain lists."""
    collected = []
    for frame in FRAMES:
        frame_set(frame)
        collected.append([[list(row) for row in matrix] for _, matrix in sorted(poses(bpy.data.objects[name]).items())])
    return collected


class FileTest(BoneTestCase):
    def save(self, name="rig"):
        path = str(self.folder / f"{name}.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        return path

    def link(self, path):
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (_, wanted):
            wanted.objects = ["Rig"]
        bpy.context.scene.collection.objects.link(wanted.objects[0])
        return wanted.objects[0]

    def assert_same(self, found, wanted, tolerance=1e-5):
        for frame, wanted_frame in zip(found, wanted):
            self.assertEqual(len(frame), len(wanted_frame))
            for matrix, wanted_matrix in zip(frame, wanted_frame):
                self.assert_same_matrix(matrix, wanted_matrix, tolerance)

    def in_another_blender(self, paths, use_scripts=True, enabled=True):
        """What rows() finds in each of the files, which another Blender opens one after the other."""
        lines = [
            "import json, bpy",
            "import toy_bone_system; toy_bone_system.register()" if enabled else "",
            f"for path in {paths!r}:",
            f"    bpy.ops.wm.open_mainfile(filepath=path, use_scripts={use_scripts!r})",
            "    found = []",
            f"    for frame in {FRAMES!r}:",
            "        bpy.context.scene.frame_set(int(frame), subframe=frame - int(frame))",
            "        rig = bpy.data.objects['Rig'].evaluated_get(bpy.context.evaluated_depsgraph_get())",
            "        found.append([[list(row) for row in bone.matrix]",
            "                      for _, bone in sorted(rig.pose.bones.items())])",
            f"    print({MARK!r} + json.dumps(found), flush=True)",
        ]
        status, output = support.run_beside("\n".join(lines), enabled=enabled)
        self.assertEqual(status, 0, output)
        found = [json.loads(part.splitlines()[0]) for part in output.split(MARK)[1:]]
        self.assertEqual(len(found), len(paths), output)
        return found

    @each_lasting_kind
    def test_reopened(self, build):
        build()
        live = rows()
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        self.assert_same(rows(), live, 0.0)
        self.assert_alive(bpy.data.objects["Rig"])
        bpy.ops.wm.open_mainfile(filepath=self.save())
        self.assert_same(rows(), live, 0.0)

    def test_in_another_blender(self):
        wanted = {}
        for build in KINDS:
            support.empty_scene()
            build()
            live = rows()
            wanted[self.save(build.__name__)] = live
        for use_scripts in (True, False):
            for path, found in zip(wanted, self.in_another_blender(list(wanted), use_scripts)):
                with self.subTest(path, use_scripts=use_scripts):
                    self.assert_same(found, wanted[path])

    def test_without_the_add_on(self):
        wanted = {}
        for build in KINDS:
            support.empty_scene()
            rig = build()
            frame_set(20)
            path = self.save(build.__name__)
            rig.motus.bend.influence = 0.0
            wanted[path] = rows()
        for path, found in zip(wanted, self.in_another_blender(list(wanted), enabled=False)):
            with self.subTest(path):
                self.assert_same(found, wanted[path])

    @each_lasting_kind
    def test_appended_twice(self, build):
        build()
        live = rows()
        folder = f"{self.save()}/Object/"
        support.empty_scene()
        for _ in range(2):
            bpy.ops.wm.append(filepath=folder + "Rig", directory=folder, filename="Rig")
        for name in ("Rig", "Rig.001"):
            self.assert_same(rows(name), live)
            self.assert_alive(bpy.data.objects[name])
        bpy.data.objects["Rig"].motus.bend.entries[0].target.location.y = 5.0
        self.assert_alive(bpy.data.objects["Rig"])

    @each_lasting_kind
    def test_linked(self, build):
        build()
        live = rows()
        rig = self.link(self.save())
        self.assertIsNotNone(rig.library)
        self.assert_same(rows(), live)
        bpy.data.libraries[0].reload()
        self.assert_same(rows(), live)
        self.assertEqual([obj.name for obj in bpy.data.objects if obj.library is None], [])

    def overridden(self, path, by_hierarchy):
        rig = self.link(path)
        frame_set(2)
        if by_hierarchy:
            made = rig.override_hierarchy_create(bpy.context.scene, bpy.context.view_layer)
        else:
            made = rig.override_create(remap_local_usages=True)
        frame_set(3)
        return made

    def test_overridden(self):
        for build in LASTING_KINDS:
            for by_hierarchy in (False, True):
                with self.subTest(build.__name__, by_hierarchy=by_hierarchy):
                    support.empty_scene()
                    build()
                    live = rows()
                    override = self.overridden(self.save(), by_hierarchy)
                    name = override.name
                    self.assert_same(rows(name), live)
                    override.motus.bend.entries[-1].weight = 0.3
                    self.assert_bent_everywhere(override)
                    changed = rows(name)
                    for _ in range(2):
                        bpy.ops.wm.open_mainfile(filepath=self.save("override"))
                        override = next(one for one in bpy.data.objects if one.type == 'ARMATURE' and one.override_library)
                        if "all_driven" not in build.__name__:
                            self.assertAlmostEqual(override.motus.bend.entries[-1].weight, 0.3)
                        self.assert_same(rows(override.name), changed)
                        self.assert_bent_everywhere(override)
                        linked = override.override_library.reference
                        self.assertNotAlmostEqual(linked.motus.bend.entries[-1].weight, 0.3, places=3)

    def test_overridden_and_wired_otherwise(self):
        for build in LASTING_KINDS:
            with self.subTest(build.__name__):
                support.empty_scene()
                build()
                override = self.overridden(self.save(), by_hierarchy=False)
                entries = override.motus.bend.entries
                entries[0].stretch, entries[-1].stretch = 0.0, 0.5
                changed, counts = rows(override.name), []
                self.assert_bent_everywhere(override)
                for _ in range(3):
                    bpy.ops.wm.open_mainfile(filepath=self.save("override"))
                    override = next(one for one in bpy.data.objects if one.type == 'ARMATURE' and one.override_library)
                    self.assert_same(rows(override.name), changed)
                    self.assert_bent_everywhere(override)
                    counts.append([len(bone.constraints) for bone in override.pose.bones])
                self.assertEqual(counts, counts[:1] * 3)

    def assert_bent_everywhere(self, rig):
        for frame in FRAMES:
            frame_set(frame)
            self.assert_bent(rig)
