"""The presets that come with Motus: each one's settings are as it says, and none goes beyond what it may change."""

import bpy

import live_scenes
import support

OWNERS = {"path": "Car", "ik": "Arm", "look_at": "Figure", "layers": "Puppet", "dynamics": "Parcel", "pendulum": "Hook", "pull": "Grid"}


def brought(name):
    """(the Presets of a system, function that gives the settings they change)."""
    operator = getattr(bpy.types, f"MOTUS_OT_{name}_preset_use")
    return operator.brought, operator.settings_of


def values_of(settings, names):
    found = {name: getattr(settings, name) for name in names}
    return {name: tuple(value) if hasattr(value, "to_tuple") else value for name, value in found.items()}


class BroughtPresets(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        live_scenes.opened()

    def settings(self, name):
        bpy.context.view_layer.objects.active = bpy.data.objects.get(OWNERS[name])
        found = brought(name)[1](bpy.context)
        return found[0] if isinstance(found, list) else found

    def test_every_preset_of_every_system(self):
        for name in OWNERS:
            presets, settings = brought(name)[0], self.settings(name)
            touched = {key for preset in presets for key in preset.values}
            for preset in presets:
                with self.subTest(system=name, preset=preset.identifier):
                    self.assertEqual(getattr(bpy.ops.motus, f"{name}_preset_use")(preset=preset.identifier), {'FINISHED'})
                    present = values_of(settings, touched)
                    for key, value in preset.values.items():
                        if isinstance(value, float):
                            self.assertAlmostEqual(present[key], value, delta=1e-6 * max(1.0, abs(value)))
                        else:
                            self.assertEqual(present[key], value)
            self.assertGreater(len(presets), 3)

    def test_all_settings_of_one_are_gone_with_the_next(self):
        settings = self.settings("path")
        bpy.ops.motus.path_preset_use(preset='BIRD')
        self.assertEqual((settings.lag_rate, settings.timing), (4.0, 'SPEED'))
        bpy.ops.motus.path_preset_use(preset='CAR')
        self.assertEqual((settings.lag_rate, settings.timing, settings.orientation), (0.0, 'DURATION', 'WORLD_UP'))

    def test_what_belongs_to_the_shot_stays(self):
        settings = self.settings("path")
        settings.offset, settings.start_frame, curve = 0.25, 7.0, settings.curve
        bpy.ops.motus.path_preset_use(preset='AIRCRAFT')
        self.assertEqual((settings.offset, settings.start_frame, settings.curve), (0.25, 7.0, curve))

    def test_an_object_without_the_system(self):
        bpy.context.view_layer.objects.active = bpy.data.objects["Target"]
        for name in ("path", "ik", "look_at", "layers", "dynamics", "pendulum"):
            with self.assertRaisesRegex(RuntimeError, "no settings here"):
                getattr(bpy.ops.motus, f"{name}_preset_use")()
