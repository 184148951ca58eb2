"""Spiders: any number of legs, of any size, whose knees are up."""

import bpy
import numpy as np

import support
from walker import walker_cases as cases


class Spider(cases.WalkerTestCase):
    def test_any_number_of_legs(self):
        for count in (2, 3, 4, 6, 7, 8, 11, 20, 64):
            with self.subTest(count):
                support.empty_scene()
                spider = cases.spider(legs=count)
                self.assertEqual(len(spider.motus.walker.legs), count)
                self.assertEqual(len(spider.motus.ik.entries), count)
                support.go_to(47)
                self.assertWell(spider)
                np.testing.assert_allclose(cases.tips(spider), cases.places(spider), atol=1e-4)

    def test_no_leg_is_too_many(self):
        self.assertEqual(bpy.ops.motus.spider_add(legs=1), {'FINISHED'})
        self.assertEqual(len(bpy.context.object.motus.walker.legs), 2)

    def test_the_span_scales_all(self):
        small, large = (cases.spider(ahead=0.0, size=size, location=(10.0 * size, 0.0, 0.0)) for size in (0.5, 2.0))
        for name in ("stride", "clearance", "reach_up", "reach_down"):
            self.assertAlmostEqual(getattr(large.motus.walker, name), 4.0 * getattr(small.motus.walker, name), places=5)
        np.testing.assert_allclose(
            [tuple(leg.rest) for leg in large.motus.walker.legs],
            4.0 * np.array([tuple(leg.rest) for leg in small.motus.walker.legs]),
            atol=1e-5,
        )

    def test_knees_are_up_and_legs_do_not_cross(self):
        spider = cases.spider_on_waves()
        rest = np.array([tuple(leg.rest) for leg in spider.motus.walker.legs])
        for frame in range(1, 110, 9):
            support.go_to(frame)
            seen = support.evaluated(spider)
            for name, foot, place in zip(cases.foot_bones(spider), cases.places(spider), rest):
                knee = seen.matrix_world @ seen.pose.bones[name.replace("foot", "lower")].head
                hip = seen.matrix_world @ seen.pose.bones[name.replace("foot", "upper")].head
                self.assertGreater(knee.z, max(foot[2], hip.z), (name, frame))
                self.assertGreater(foot[0] * place[0], 0.0, (name, frame))

    def test_every_part_is_on_a_bone(self):
        spider = cases.spider(ahead=0.0)
        skin = bpy.data.objects["Spider Mesh"]
        self.assertEqual(skin.parent, spider)
        groups = {group.index: group.name for group in skin.vertex_groups}
        self.assertTrue(set(groups.values()) <= set(spider.data.bones.keys()))
        for vertex in skin.data.vertices:
            (only,) = vertex.groups
            self.assertEqual(only.weight, 1.0)
        self.assertEqual(
            {slot.material.name.partition(".")[0] for slot in skin.material_slots},
            {"Spider Fur", "Spider Bands", "Spider Eyes", "Spider Glint"},
        )
        self.assertEqual({polygon.material_index for polygon in skin.data.polygons}, {0, 1, 2, 3})
        self.assertFalse(skin.data.validate())

    def test_faces_look_outwards(self):
        cases.spider(ahead=0.0)
        mesh = bpy.data.objects["Spider Mesh"].data
        # Signed volume of all closed parts.
        mesh.calc_loop_triangles()
        volume = (
            sum(
                float(np.dot(a, np.cross(b, c)))
                for a, b, c in ([np.array(mesh.vertices[index].co) for index in triangle.vertices] for triangle in mesh.loop_triangles)
            )
            / 6.0
        )
        self.assertGreater(volume, 0.0)

    def test_names_of_a_second_one(self):
        first, second = cases.spider(), cases.spider(location=(3.0, 0.0, 0.0))
        self.assertNotEqual(first.name, second.name)
        support.go_to(50)
        for one in (first, second):
            self.assertWell(one)
