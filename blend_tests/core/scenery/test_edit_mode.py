"""What systems read of a mesh or curve is followed while it is edited in Edit Mode, not first when Edit Mode is left."""

import bmesh
import bpy
import numpy as np

import live_scenes
import support
from path.path_cases import CLIMB, PathTestCase, add_points, curve_data

FRAMES = (13, 25.5)


def begin(obj):
    """Enter Edit Mode with all of an object selected."""
    bpy.ops.object.select_all(action='DESELECT')
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode='EDIT')
    (bpy.ops.curve if obj.type == 'CURVE' else bpy.ops.mesh).select_all(action='SELECT')


def end():
    bpy.ops.object.mode_set(mode='OBJECT')


class EverySystem(support.SceneTestCase):
    """Each edit shows in Edit Mode what it shows after Edit Mode; the first one by a tool, the second by a script."""

    def test_what_is_read_is_edited(self):
        live_scenes.opened()
        for name in ("Course", "Meadow", "Land"):
            obj, before = bpy.data.objects[name], live_scenes.states(FRAMES)
            begin(obj)
            for edit in (self._move, self._bend):
                edit(obj)
                edited = live_scenes.states(FRAMES)
                end()
                left = live_scenes.states(FRAMES)
                self.assertAlike(edited, left, name)
                begin(obj)
            end()
            changed = {key[0] for frame in FRAMES for key in before[frame] if self._off(before[frame][key], left[frame][key]) > 0.01}
            self.assertGreater(len(changed - {name}), 0, f"nothing reads {name}")

    def _move(self, _obj):
        bpy.ops.transform.translate(value=(0.0, 0.0, 0.4))

    def _bend(self, obj):
        if obj.type == 'CURVE':
            obj.data.splines[0].bezier_points[0].handle_right.x += 1.0
            obj.data.update_tag()
        else:
            mesh = bmesh.from_edit_mesh(obj.data)
            for vertex in mesh.verts:
                vertex.co.z += 0.1 * vertex.co.y + 0.05
            bmesh.update_edit_mesh(obj.data)

    def assertAlike(self, edited, left, name):
        for frame, numbers in edited.items():
            for key, found in numbers.items():
                if key != (name, "mesh"):  # in Edit Mode Blender keeps it elsewhere
                    self.assertLess(self._off(found, left[frame][key]), 1e-4, (name, frame, key))

    def _off(self, one, other):
        return np.inf if len(one) != len(other) else float(np.abs(one - other).max(initial=0.0))


class Curves(PathTestCase):
    """A follower at the half of curves of all kinds, while all their points are moved up by 2 m, twice."""

    def assertFollows(self, curve, **keywords):
        car = self.follow(curve=curve.name, timing='MANUAL', distance_factor=0.5, **keywords)
        before = self.place(car)
        begin(curve)
        for height in (2.0, 4.0):
            bpy.ops.transform.translate(value=(0.0, 0.0, 2.0))
            np.testing.assert_allclose(self.place(car), before + (0.0, 0.0, height), atol=1e-4)
        end()
        np.testing.assert_allclose(self.place(car), before + (0.0, 0.0, 4.0), atol=1e-4)
        return car

    def test_kinds(self):
        self.assertFollows(self.cubic(name="Bezier"))
        self.assertFollows(self.points('NURBS', CLIMB, "Nurbs", use_endpoint_u=True))
        self.assertFollows(self.points('POLY', CLIMB, "Poly", use_cyclic_u=True))
        degree = self.points('POLY', CLIMB, "Degree")
        degree.data["motus_bezier"] = True
        self.assertFollows(degree)

    def test_keyed_and_hidden(self):
        curve = self.line(9.0)
        curve.data.keyframe_insert("splines[0].bezier_points[0].radius", frame=1)
        self.follow(curve=curve.name).keyframe_insert("motus.path.offset", frame=1)
        self.assertFollows(curve)

    def test_shape_keys(self):
        curve = self.line(9.0)
        curve.shape_key_add(name="Basis")
        curve.shape_key_add(name="Other").value = 1.0
        curve.active_shape_key_index = 1
        self.assertFollows(curve)

    def test_hooks(self):
        """The line that is drawn counts, and the splines of it that are chosen."""
        data = curve_data()
        add_points(data, 'POLY', [(0, 0, 0), (0, 4, 0)])
        add_points(data, 'POLY', [(0, 0, 0), (4, 0, 0), (4, 4, 0)], use_cyclic_u=True)
        curve, hook = self.link("Course", data), self.link("Hook")
        modifier = curve.modifiers.new("Hook", 'HOOK')
        modifier.object, modifier.show_in_editmode = hook, True
        modifier.vertex_indices_set(list(range(5)))
        bpy.context.view_layer.update()
        hook.location.y = 1.0
        for spline in (0, 1, -1):
            self.assertFollows(curve, spline=spline)
            self.assertGreater(self.place(bpy.data.objects["Car"])[1], 0.9)

    def test_bevel_below_a_modifier(self):
        curve = self.line(9.0)
        curve.data.bevel_depth = 0.1
        curve.modifiers.new("Wave", 'WAVE').show_viewport = False
        self.assertFollows(curve)

    def test_a_point_that_comes_and_goes(self):
        curve = self.points('POLY', [(0, 0, 0), (4, 0, 0)])
        car = self.follow(timing='MANUAL', distance_factor=1.0)
        begin(curve)
        bpy.ops.curve.select_all(action='DESELECT')
        curve.data.splines[0].points[1].select = True
        bpy.ops.curve.extrude_move(TRANSFORM_OT_translate={"value": (0.0, 3.0, 0.0)})
        self.assertPlace(car, np.array((4.0, 3.0, 0.0)))
        bpy.ops.curve.delete(type='VERT')
        self.assertPlace(car, np.array((4.0, 0.0, 0.0)))
        bpy.ops.curve.select_all(action='SELECT')
        bpy.ops.curve.delete(type='VERT')
        self.assertIn("no splines", self.sentence(car) or "")
        end()

    def test_overlay(self):
        curve = self.line(9.0)
        self.follow()
        for name in ("control_points", "tangents", "frames", "speed"):
            setattr(self.scene.motus, f"show_{name}", False)
        begin(curve)
        for height in (2.0, 4.0):
            bpy.ops.transform.translate(value=(0.0, 0.0, 2.0))
            (lines,) = support.addon("core.interface.overlay").batches(bpy.context)
            np.testing.assert_allclose(lines.points[:, 2], height, atol=1e-5)
        end()

    def test_what_is_not_edited_is_read_once(self):
        """Playing on in Object Mode reads a curve once for each copy of it, as before."""
        curves = support.addon("path.curves")
        self.line(9.0)
        car, read = self.follow(timing='SPEED', speed=1.0), []
        self.at(car, 1)
        original = curves._read
        curves._read = lambda *arguments: read.append(1) or original(*arguments)
        self.addCleanup(setattr, curves, "_read", original)
        for frame in range(2, 12):
            self.at(car, frame)
        self.assertEqual(read, [])
