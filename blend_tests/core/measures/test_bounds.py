"""What no number of a file may do: hand on what is not finite, or have Blender wait."""

import logging
import math

import bpy
import numpy as np

import live_scenes
import support

WRONG = {'FLOAT': (math.nan, math.inf, -1e30), 'INT': (2**31 - 1, -(2**31))}
"""Values that a setting's limits would not let in, by its type."""


def stored(owner):
    """The custom properties in which Blender keeps an object's Motus settings, where limits do not count."""
    read = getattr(owner, "bl_system_properties_get", None)
    return (read() if read else owner)["motus"]


def numbers(group, stands, path=""):
    """(path, where it is stored, name, type, size of an array or 0) of all numbers in a group of settings that the file holds."""
    for declared in group.bl_rna.properties:
        name = declared.identifier
        if name not in stands:
            continue
        value = getattr(group, name)
        if declared.type == 'COLLECTION':
            for index, entry in enumerate(value):
                yield from numbers(entry, stands[name][index], f"{path}.{name}[{index}]")
        elif isinstance(value, bpy.types.PropertyGroup):
            yield from numbers(value, stands[name], f"{path}.{name}")
        elif declared.type in WRONG:
            yield f"{path}.{name}", stands, name, declared.type, declared.array_length if declared.is_array else 0


def owners():
    """(system, owner) of the file."""
    declared = support.addon("core.declare")
    return [(system, obj) for system in declared.systems() for obj in bpy.data.objects if declared.is_owner(system, obj)]


def not_finite():
    """Names of what has a transform or a shape that is no number."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = {name for name, values in live_scenes.state().items() if not np.isfinite(values).all()}
    return found | {
        one.parent.name for one in depsgraph.object_instances if one.is_instance and not np.isfinite(np.array(one.matrix_world)).all()
    }


class _Errors(logging.Handler):
    def __init__(self):
        super().__init__(logging.ERROR)
        self.found = []

    def emit(self, record):
        self.found.append(record.getMessage() + str(record.exc_info and record.exc_info[1]))


class WrongNumbersTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        live_scenes.opened()
        bpy.context.scene.frame_set(13)
        self.assertFalse(not_finite())
        self.errors = _Errors()
        log = logging.getLogger(support.addon("core.wiring").__name__)
        log.addHandler(self.errors)
        self.addCleanup(log.removeHandler, self.errors)

    def test_nothing_in_a_file_reaches_a_sink_that_is_no_number(self):
        """Of each owner one setting after the other, those of all owners at once, with each wrong value."""
        waiting = [
            (system, owner, list(numbers(getattr(owner.motus, system.name), stored(owner)[system.name], f"{owner.name} {system.name}")))
            for system, owner in owners()
        ]
        self.assertGreater(sum(len(of_owner) for *_, of_owner in waiting), 100)
        for place in range(max(len(of_owner) for *_, of_owner in waiting)):
            # Those too whose last setting has been given its value back.
            touched = [(system, owner) for system, owner, of_owner in waiting if place <= len(of_owner)]
            for which in range(3):
                self._check([of_owner[place] for *_, of_owner in waiting if place < len(of_owner)], which, touched)

    def _check(self, settings, which, touched):
        kept = []
        for _, stands, name, kind, size in settings:
            wrong = WRONG[kind][which % len(WRONG[kind])]
            kept.append((stands, name, list(stands[name]) if size else stands[name]))
            stands[name] = [wrong] * size if size else wrong
        for system, owner in touched:
            owner.update_tag()
            support.addon("core.wiring").touch(system, owner)
        bpy.context.view_layer.update()
        self.assertFalse(not_finite(), [path for path, *_ in settings])
        self.assertFalse(self.errors.found, [path for path, *_ in settings])
        for stands, name, value in kept:
            stands[name] = value

    def test_the_panel_says_so(self):
        wiring, system = support.addon("core.wiring"), support.addon("core.declare").registered["layers"]
        puppet = bpy.data.objects["Puppet"]
        puppet.motus.layers.entries[0].feather = 1
        entry = stored(puppet)["layers"]["entries"][0]
        for value, is_told in ((1, False), (-(2**31), True), (2, False)):
            entry["feather"] = value
            puppet.update_tag()
            wiring.touch(system, puppet)
            bpy.context.view_layer.update()
            found = wiring.problem(system, puppet, bpy.context.evaluated_depsgraph_get())
            self.assertEqual(found is not None and "is no number" in found.sentence, is_told, found)


class FiniteTest(support.SceneTestCase):
    @support.in_one_blender
    def test_arrays(self):
        finite = support.addon("core.measures.finite")
        for dtype in (np.float32, np.float64):
            self.assertTrue(finite.is_finite(np.full((3, 4), 1e30, dtype)))
            self.assertTrue(finite.is_finite(np.zeros((0, 3), dtype)))
            for wrong in (math.nan, math.inf, -math.inf):
                numbers = np.ones((3, 4), dtype)
                numbers[2, 1] = wrong
                self.assertFalse(finite.is_finite(numbers))
        self.assertFalse(finite.is_finite(np.array([1e39])))  # infinite in Blender's single precision

    @support.in_one_blender
    def test_influences(self):
        share = support.addon("core.measures.finite").share
        self.assertEqual([share(value) for value in (math.nan, -1.0, 0.25, 7.0, math.inf)], [0.0, 0.0, 0.25, 1.0, 1.0])
