"""Adding and removing pendulums: what is made, what placed objects give, what is restored, and what is refused."""

import math

import bpy
import numpy as np

import support
from path.test_path_setup import state
from pendulum.pendulum_cases import PendulumTestCase, place, world
from support import go_to


class Add(PendulumTestCase):
    def test_keywords_become_settings(self):
        given = {
            "length1": 2.0,
            "length2": 3.0,
            "mass1": 0.5,
            "mass2": 0.25,
            "angle1": 0.5,
            "angle2": 0.25,
            "angle_step": 0.125,
            "velocity1": 1.0,
            "velocity2": 2.0,
            "use_scene_gravity": False,
            "gravity": 2.0,
            "damping": 0.5,
            "use_limits": True,
            "most_velocity": 8.0,
            "most_acceleration": 16.0,
            "use_pivot_motion": True,
            "start_frame": 12.0,
            "speed": 2.0,
            "is_playing": False,
            "influence": 0.5,
        }
        settings = self.add(**given).motus.pendulum
        self.assertEqual({name: getattr(settings, name) for name in given}, given)
        self.assertEqual((settings.kind, settings.count), ('DOUBLE', 1))

    def test_the_outliner_is_tidy(self):
        pivot = self.add(kind='DOUBLE')
        rod, lower = self.rods(pivot)
        self.assertEqual([rod.parent, lower.parent, *(bob.parent for bob in self.bobs(pivot))], [pivot, rod, rod, lower])
        self.assertEqual(list(pivot.children), [rod])
        self.assertEqual(bpy.context.object, pivot)

    def test_colours_go_around(self):
        pivot = self.add(kind='FAN', count=6)
        colors = {tuple(rod.material_slots[0].material.diffuse_color) for rod in self.rods(pivot)}
        self.assertEqual(len(colors), 6)

    def test_demonstration(self):
        self.add(kind='CHAOS', count=9)
        fan, alone, other = (bpy.data.objects[name].motus.pendulum for name in ("Fan", "Alone", "Other Angles"))
        self.assertEqual((fan.count, alone.count, other.count), (9, 1, 1))
        self.assertEqual((fan.angle1, fan.angle2), (alone.angle1, alone.angle2))
        self.assertGreater(abs(fan.angle1 - other.angle1), 1.0)

    def test_from_placed_objects(self):
        pivot, first, second = (
            self.link(name, location)
            for name, location in (("Hook", (1.0, 2.0, 5.0)), ("Ball", (2.0, 2.0, 4.0)), ("Weight", (4.0, 2.0, 4.0)))
        )
        second.rotation_euler = (0.1, 0.2, 0.3)
        first.scale = (2.0, 1.0, 1.0)
        bpy.context.view_layer.update()
        before = [(state(obj), world(obj)) for obj in (pivot, first, second)]
        for obj in (first, second, pivot):
            obj.select_set(True)
        bpy.context.view_layer.objects.active = pivot
        bpy.ops.motus.pendulum_add(take='PLACED')
        settings = pivot.motus.pendulum
        self.assertEqual(settings.kind, 'DOUBLE')
        np.testing.assert_allclose(
            (settings.length1, settings.length2, settings.angle1, settings.angle2),
            (math.sqrt(2.0), 2.0, math.pi / 4, math.pi / 2),
            rtol=1e-6,
        )
        for obj, (_, matrix) in zip((first, second), before[1:]):
            np.testing.assert_allclose(world(obj), matrix, atol=2e-6)
        go_to(20)
        self.assertGreater(np.linalg.norm(place(second) - (4.0, 2.0, 4.0)), 0.1)
        go_to(1)
        settings.length2 = 1.0
        self.assertPlace(second, (3.0, 2.0, 4.0))
        bpy.ops.motus.pendulum_remove(object="Weight")
        bpy.context.view_layer.update()
        for obj, (found, matrix) in zip((pivot, first, second), before):
            self.assertEqual(state(obj), found)
            self.assertEqual(world(obj).tobytes(), matrix.tobytes())
            self.assertIsNone(obj.parent)
        self.assertEqual(set(bpy.data.objects), {pivot, first, second})
        self.assertEqual(len(bpy.data.meshes), 0)

    def test_by_names(self):
        self.link("Hook")
        self.link("Ball", (0.0, 0.0, -3.0))
        bpy.ops.motus.pendulum_add(object="Hook", bobs="Ball")
        settings = bpy.data.objects["Hook"].motus.pendulum
        self.assertEqual((settings.kind, settings.length1, settings.angle1), ('SINGLE', 3.0, 0.0))

    def test_refusals(self):
        add = bpy.ops.motus.pendulum_add
        for keywords, sentence in (
            ({"length1": 0.0}, "length1 must be greater than 0"),
            ({"length2": -1.0}, "length2 must be greater than 0"),
            ({"mass1": 0.0}, "mass1 must be greater than 0"),
            ({"mass2": -2.0}, "mass2 must be greater than 0"),
            ({"angle1": math.nan}, "angle1 is not a finite number"),
            ({"length1": math.inf}, "length1 is not a finite number"),
            ({"gravity": -1.0}, "gravity must not be less than 0"),
            ({"damping": -1.0}, "damping must not be less than 0"),
            ({"kind": 'FAN', "count": 0}, "A fan has 1 to"),
            ({"kind": 'FAN', "count": 100000}, "A fan has 1 to"),
            ({"object": "Nobody"}, "There is no object Nobody"),
            ({"take": 'ACTIVE'}, "Select the object"),
            ({"take": 'PLACED'}, "Select the bobs"),
        ):
            self.assertRefused(sentence, add, **keywords)
        pivot, ball, _ = self.link("Hook"), self.link("Ball", (0.0, 1.0, -1.0)), self.link("Other")
        self.assertRefused("beside the plane", add, object="Hook", bobs="Ball")
        self.assertRefused("one bob or two", add, object="Hook", bobs="Hook")
        self.assertRefused("one bob or two", add, object="Hook", bobs="Ball,Ball")
        for kind, bobs in (('FAN', "Ball"), ('DOUBLE', "Ball"), ('SINGLE', "Ball,Other")):
            self.assertRefused("a double one two, and a fan none", add, object="Hook", bobs=bobs, kind=kind)
        self.assertRefused("pivots of its own", add, object="Hook", kind='CHAOS')
        ball.location = (0.0, 0.0, 0.0)
        self.assertRefused("lies on what", add, object="Hook", bobs="Ball")
        ball.parent = pivot
        self.assertRefused("has a parent", add, object="Hook", bobs="Ball")
        ball.parent = None
        bpy.ops.motus.pendulum_add(object="Hook")
        self.assertRefused("has a pendulum", add, object="Hook")
        self.assertRefused("part of a pendulum", add, object=self.rods(pivot)[0].name)
        self.assertEqual(len([obj for obj in bpy.data.objects if obj.motus.pendulum.is_active]), 1)

    def test_preset(self):
        pivot = self.add(length1=2.0, damping=0.25)
        take_up = self.keep_preset("pendulum")
        pivot.motus.pendulum.length1, pivot.motus.pendulum.damping = 1.0, 0.0
        take_up()
        self.assertEqual((pivot.motus.pendulum.length1, pivot.motus.pendulum.damping), (2.0, 0.25))


class Remove(PendulumTestCase):
    def test_nothing_is_left(self):
        bpy.context.view_layer.update()
        before = {name: len(getattr(bpy.data, name)) for name in ("objects", "meshes", "materials", "actions")}
        pivot = self.add(kind='FAN', count=3)
        bpy.ops.motus.pendulum_remove(object=self.bobs(pivot)[0].name)
        self.assertEqual({name: len(getattr(bpy.data, name)) for name in before}, before)

    def test_an_own_pivot_is_as_before(self):
        hook = self.link("Hook", (1.0, 2.0, 3.0))
        hook.keyframe_insert("location", frame=1)
        before = state(hook)
        self.add(kind='DOUBLE', object="Hook")
        go_to(5)
        bpy.ops.motus.pendulum_play()
        bpy.ops.motus.pendulum_remove(object="Hook")
        bpy.context.view_layer.update()
        self.assertEqual(state(hook), before)
        self.assertEqual(set(bpy.data.objects), {hook})

    def test_objects_can_be_kept(self):
        pivot = self.add(kind='DOUBLE', location=(0.0, 0.0, 0.0))
        made = {pivot, *self.rods(pivot), *self.bobs(pivot)}
        lower = self.bobs(pivot)[1]
        go_to(30)
        bpy.ops.motus.pendulum_remove(object=pivot.name, keep_objects=True)
        self.assertEqual(set(bpy.data.objects), made)
        self.assertFalse(any(obj.constraints or obj.animation_data or obj.is_property_set("motus") for obj in made))
        self.assertPlace(lower, (0.0, 0.0, -2.0))

    def test_children_of_others_stay_where_they_stand(self):
        pivot = self.add(kind='SINGLE', location=(0.0, 0.0, 0.0), angle1=0.0)
        hat = self.link("Hat", (0.0, 0.0, 1.0))
        hat.parent = self.bobs(pivot)[0]
        before = place(hat)
        bpy.ops.motus.pendulum_remove(object=pivot.name)
        self.assertPlace(hat, before)

    def test_refusals(self):
        self.link("Cube")
        self.assertRefused("Nothing here", bpy.ops.motus.pendulum_remove, object="Cube")
        self.assertRefused("There is no object", bpy.ops.motus.pendulum_remove, object="Nobody")
        pivot = self.add(kind='SINGLE')
        bpy.ops.motus.bake(object=pivot.name, frame_start=1, frame_end=3)
        self.assertRefused("unbake it first", bpy.ops.motus.pendulum_remove, object=pivot.name)


class BadInput(PendulumTestCase):
    def test_sentences(self):
        pivot = self.add(kind='DOUBLE', damping=0.1)
        settings = pivot.motus.pendulum
        rest = [world(rod).tobytes() for rod in self.rods(pivot)]
        for name, value, sentence in (
            ("length1", 0.0, "lengths"),
            ("length2", -1.0, "lengths"),
            ("mass1", 0.0, "masses"),
            ("mass2", -1.0, "masses"),
            ("angle1", math.nan, "finite"),
            ("gravity", math.inf, "finite"),
            ("start_frame", math.nan, "finite"),
        ):
            before = getattr(settings, name)
            setattr(settings, name, value)
            self.assertIn(sentence, self.sentence(pivot), name)
            self.assertTrue(all(np.isfinite(world(bob)).all() for bob in self.bobs(pivot)))
            setattr(settings, name, before)
            self.assertEqual(self.sentence(pivot), "")
        self.assertEqual([world(rod).tobytes() for rod in self.rods(pivot)], rest)

    def test_a_time_of_thirty_years(self):
        for keywords in (
            {"kind": 'DOUBLE'},
            {"kind": 'DOUBLE', "use_limits": True},
            {"kind": 'FAN', "count": 3},
            {"kind": 'SINGLE', "damping": 0.1},
        ):
            pivot = self.add(**keywords)
            pivot.motus.pendulum.speed = 1e9
            go_to(25)
            self.assertIn("not known so far from its start", self.sentence(pivot), keywords)
            self.assertTrue(np.isfinite(world(self.bobs(pivot)[0])).all())

    def test_a_fan_too_large_for_its_time(self):
        """Of a few it is known how they swing so late, but of more not all could be kept from frame to frame."""
        for is_moved, speed in ((False, 7000.0), (True, 4000.0)):
            for count, sentence in ((2, ""), (64, "so many pendulums")):
                pivot = self.add(kind='FAN', count=count, use_trails=True)
                if is_moved:
                    for frame in (1, 3):
                        pivot.location.x = frame
                        pivot.keyframe_insert("location", frame=frame)
                pivot.motus.pendulum.use_pivot_motion = is_moved
                pivot.motus.pendulum.speed = speed
                go_to(26)
                self.assertIn(sentence, self.sentence(pivot), (is_moved, count))
                self.assertEqual(bool(self.sentence(pivot)), bool(sentence), (is_moved, count))
                go_to(1)
                bpy.ops.motus.pendulum_remove(object=pivot.name)  # all pendulums of a scene share the time of a frame

    def test_numbers_too_extreme_from_the_start(self):
        for keywords in ({"damping": 1e9}, {"mass1": 1e30, "length1": 1e-6, "damping": 1e9}):
            pivot = self.add(kind='DOUBLE', use_trails=True, **keywords)
            go_to(30)
            self.assertIn("too large or too small", self.sentence(pivot), keywords)
            go_to(1)

    def test_a_deleted_pivot(self):
        pivot = self.add(kind='SINGLE', angle1=1.0)
        (rod,) = self.rods(pivot)
        bpy.data.objects.remove(pivot)
        go_to(10)
        self.assertTrue(np.isfinite(world(rod)).all())
        bpy.ops.motus.pendulum_remove(object=rod.name, keep_objects=True)
        self.assertFalse(rod.constraints)
        other = self.add(kind='SINGLE', angle1=1.0)
        rod, name = self.rods(other)[0], other.name
        for collection in other.users_collection:
            collection.objects.unlink(other)
        go_to(11)
        self.assertIn("in no collection", self.sentence(bpy.data.objects[name]))

    def test_what_is_left_without_the_pivot_is_removed(self):
        counted = "objects", "meshes", "materials", "actions"
        hat = self.link("Hat")
        other = self.add(kind='DOUBLE', use_trails=True)
        before = {name: len(getattr(bpy.data, name)) for name in counted}
        for part in ("Rod 2", "Bob 1", "Trail"):
            pivot = self.add(kind='DOUBLE', use_trails=True, location=(0.0, 0.0, 0.0))
            name, lower = pivot.name, self.bobs(pivot)[1]
            hat.parent = lower
            bpy.data.objects.remove(pivot)
            go_to(2)
            bpy.ops.motus.pendulum_remove(object=f"{name} {part}")
            self.assertEqual({name: len(getattr(bpy.data, name)) for name in counted}, before)
            self.assertIsNone(hat.parent)
        pivot = self.add(kind='DOUBLE', use_trails=True)
        rods, bobs = self.rods(pivot), self.bobs(pivot)
        bpy.data.objects.remove(pivot)
        for obj in bpy.data.objects:
            obj.select_set(obj in rods or obj in bobs)
        bpy.ops.motus.pendulum_remove(keep_objects=True)
        self.assertFalse(any(obj.constraints or obj.is_property_set("motus") for obj in (*rods, *bobs)))
        self.assertEqual(len(bpy.data.objects), before["objects"] + 4)
        self.assertEqual(self.sentence(other), "")
        self.assertIsNotNone(other.motus.pendulum.trail)

    def test_a_copy_of_a_rod_is_freed_and_stays(self):
        pivot = self.add(kind='DOUBLE')
        copy = self.copy_alone(self.rods(pivot)[0])
        bpy.ops.motus.pendulum_remove(object=copy.name)
        self.assertFalse(copy.constraints)
        self.assertEqual(len([rod for rod in self.rods(pivot) if rod.constraints]), 2)

    def test_deleted_rods_and_bobs(self):
        pivot = self.add(kind='DOUBLE', angle1=1.0, angle2=1.0, location=(0.0, 0.0, 0.0))
        upper, lower = self.rods(pivot)
        bpy.data.objects.remove(self.bobs(pivot)[0])
        go_to(2)
        self.assertEqual(self.sentence(pivot), "")
        bpy.data.objects.remove(lower)
        pivot.motus.pendulum.angle1 = 0.5
        self.assertEqual(self.sentence(pivot), "")
        go_to(1)
        self.assertPlace(upper, (0.0, 0.0, 0.0))
        np.testing.assert_allclose(world(upper)[:3, 2], (-math.sin(0.5), 0.0, math.cos(0.5)), atol=1e-6)
        bpy.data.objects.remove(upper)
        pivot.motus.pendulum.angle1 = 0.25
        self.assertIn("no rods", self.sentence(pivot))
        bpy.ops.motus.pendulum_remove(object=pivot.name)
        self.assertEqual([obj.name for obj in bpy.data.objects if obj.is_property_set("motus")], [])

    def test_linked(self):
        self.add(kind='SINGLE', angle1=1.0)
        path = str(self.folder / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        support.empty_scene()
        with bpy.data.libraries.load(path, link=True) as (source, target):
            target.objects = source.objects
        for obj in target.objects:
            if not obj.hide_viewport:
                bpy.context.scene.collection.objects.link(obj)
        pivot = next(obj for obj in bpy.data.objects if obj.motus.pendulum.is_active)
        go_to(20)
        moved = place(self.bobs(pivot)[0])
        go_to(1)
        self.assertGreater(np.linalg.norm(place(self.bobs(pivot)[0]) - moved), 0.1)
        self.assertRefused("linked from another file", bpy.ops.motus.pendulum_remove, object=pivot.name)

    def test_overridden_and_opened_again(self):
        collection = bpy.data.collections.new("Pendulums")
        bpy.context.scene.collection.children.link(collection)
        bpy.context.view_layer.active_layer_collection = bpy.context.view_layer.layer_collection.children["Pendulums"]
        pivot = self.add(kind='DOUBLE', location=(0.0, 0.0, 0.0))
        go_to(30)
        expected = [world(bob).tobytes() for bob in self.bobs(pivot)]
        library, path = (str(self.folder / name) for name in ("library.blend", "user.blend"))
        bpy.ops.wm.save_as_mainfile(filepath=library)
        support.empty_scene()
        with bpy.data.libraries.load(library, link=True) as (_, target):
            target.collections = ["Pendulums"]
        scene = bpy.context.scene
        scene.collection.children.link(target.collections[0])
        target.collections[0].override_hierarchy_create(scene, bpy.context.view_layer)
        for _ in range(2):
            bpy.ops.wm.save_as_mainfile(filepath=path)
            bpy.ops.wm.open_mainfile(filepath=path)
            pivot = next(obj for obj in bpy.data.objects if obj.motus.pendulum.is_active and not obj.library)
            go_to(30)
            self.assertEqual(self.sentence(pivot), "")
            self.assertEqual([world(bob).tobytes() for bob in self.bobs(pivot)], expected)
