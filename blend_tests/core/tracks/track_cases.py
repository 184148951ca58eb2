"""What the tests of inputs over time share: things with random keys, and what Blender makes of them."""

import random
import time

import bpy
import numpy as np

import support

INTERPOLATIONS = ('CONSTANT', 'LINEAR', 'BEZIER', 'SINE', 'QUAD', 'CUBIC', 'QUART', 'QUINT', 'EXPO', 'CIRC', 'BACK', 'BOUNCE', 'ELASTIC')
EASINGS = ('AUTO', 'EASE_IN', 'EASE_OUT', 'EASE_IN_OUT')
FRAMES = (-40.0, 1.0, 7.25, 12.0, 19.9, 30.0, 33.3, 48.5, 61.0, 300.0)


class TrackTestCase(support.SceneTestCase):
    """An empty scene, and numbers that are the same in every run."""

    def setUp(self):
        super().setUp()
        self.scene = bpy.context.scene
        self.tracks = support.addon("core.tracks")
        self.track_panel = support.addon("core.interface.tracks.panel")
        self.random = random.Random(20)

    def evaluated(self, id_data):
        return id_data.evaluated_get(bpy.context.evaluated_depsgraph_get())

    def key(self, id_data, path, index=-1, frames=(1, 12, 30, 60), low=-2.0, high=2.0):
        """Random keys on a number or on all of an array, of random kinds."""
        holder, _, name = path.rpartition(".")
        holder = id_data.path_resolve(holder) if holder else id_data
        for frame in frames:
            size = len(getattr(holder, name)) if hasattr(getattr(holder, name), "__len__") else 0
            value = [self.random.uniform(low, high) for _ in range(size)] if size else self.random.uniform(low, high)
            setattr(holder, name, value)
            id_data.keyframe_insert(path, index=index, frame=frame + self.random.choice((0.0, 0.25)))
        for curve in support.addon("core.blender.actions").fcurves(id_data):
            if curve.data_path == path:
                for point in curve.keyframe_points:
                    point.interpolation = self.random.choice(INTERPOLATIONS)
                    point.easing = self.random.choice(EASINGS)
                curve.update()

    def rig(self, name="Rig", count=4):
        """A chain of bones "Bone.0", "Bone.1", ..., each turned at rest."""
        rig = self.link(name, bpy.data.armatures.new(name))
        bpy.context.view_layer.objects.active = rig
        bpy.ops.object.mode_set(mode='EDIT')
        parent = None
        for index in range(count):
            bone = rig.data.edit_bones.new(f"Bone.{index}")
            bone.head, bone.tail = (0.1 * index, 0.0, index), (0.3, 0.2 * index, index + 0.8)
            bone.roll = 0.4 * index
            bone.parent, parent = parent, bone
        bpy.ops.object.mode_set(mode='OBJECT')
        return rig

    def world(self, thing, frame):
        """Blender's matrix of an Object or PoseBone."""
        self.go_to(frame)
        evaluated = self.evaluated(thing.id_data)
        if isinstance(thing, bpy.types.PoseBone):
            return np.array(evaluated.matrix_world @ evaluated.pose.bones[thing.name].matrix)
        return np.array(evaluated.matrix_world)

    def assertWorld(self, thing, frames=FRAMES, tolerance=3e-6):
        """The thing's world track is exact, and says what Blender makes."""
        track = self.tracks.world_track(thing, self.scene)
        self.assertEqual(track.kind, self.tracks.Kind.EXACT, track.sentence)
        wanted = np.array([self.world(thing, frame) for frame in frames])
        found = track.values(frames)
        self.assertLessEqual(np.abs(found - wanted).max(), tolerance * max(1.0, np.abs(wanted).max()))
        # From another frame, and of what is evaluated there, it says the same.
        np.testing.assert_array_equal(self.tracks.world_track(thing, self.scene).values(frames), found)
        evaluated = self.evaluated(thing.id_data)
        thing = evaluated.pose.bones[thing.name] if isinstance(thing, bpy.types.PoseBone) else evaluated
        np.testing.assert_array_equal(self.tracks.world_track(thing, self.scene).values(frames), found)

    def assertNumber(self, id_data, path, index=-1, frames=FRAMES, tolerance=0.0):
        """The number's track is exact, and says what Blender makes."""
        track = self.tracks.property_track(id_data, path, index)
        self.assertEqual(track.kind, self.tracks.Kind.EXACT, track.sentence)
        wanted = []
        for frame in frames:
            self.go_to(frame)
            value = self.evaluated(id_data).path_resolve(path)
            wanted.append(float(value[index] if index >= 0 else value))
        found = track.values(frames)
        np.testing.assert_allclose(found, wanted, rtol=tolerance, atol=tolerance)
        np.testing.assert_array_equal(self.tracks.property_track(self.evaluated(id_data), path, index).values(frames), found)


def seconds_of(call):
    """What a call takes of the processor."""
    started = time.thread_time()
    call()
    return time.thread_time() - started
