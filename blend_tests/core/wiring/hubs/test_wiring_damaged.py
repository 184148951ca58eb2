"""Files in which what Motus keeps was changed by somebody else.

Nothing crashes, nothing raises, the panel says so, and Refresh and Remove repair it.
"""

import random

import bpy
import numpy as np

import support
from core.wiring.hubs.damaged_cases import (
    CASES,
    INFO,
    OUTBOX,
    are_same,
    carrier_of,
    chain,
    damages,
    drawn,
    evaluated,
    long_chain,
    problem,
    raised,
)

SHARE, LINKED_SHARE = 26, 6
"""How many of the damages of each set-up are tried, beside those that would be written outside of arrays."""


class DamagedTest(support.SceneTestCase):
    def each(self, share):
        """Yields (case, damages of it, what is evaluated without damage, path of its file), with the set-up in the scene."""
        for case in CASES:
            support.empty_scene()
            owner = case.build()
            live = evaluated()
            self.assertIsNone(problem(case, owner))
            path = str(self.folder / f"{case.system}.blend")
            bpy.ops.wm.save_as_mainfile(filepath=path)
            every = list(damages(case, owner))
            some = random.Random(case.build.__name__).sample(every, min(share, len(every)))
            yield case, [one for one in every if one in some or one.is_outside], live, path

    def spoil(self, damage):
        owner = bpy.data.objects["Owner"]
        damage.act(owner)
        for block in (*bpy.data.objects, *bpy.data.meshes):
            block.update_tag()
        bpy.context.view_layer.update()
        return owner

    def test_said_and_repaired(self):
        for case, some, live, path in self.each(SHARE):
            for number, damage in enumerate(some):
                with self.subTest(case=case.build.__name__, damage=damage.name):
                    is_removed = number % 4 == 3
                    try:
                        with raised() as errors:
                            self.check(case, damage, live, is_removed)
                        self.assertEqual(errors, [])
                    except Exception:
                        bpy.ops.wm.open_mainfile(filepath=path)
                        raise
                    if is_removed:
                        bpy.ops.wm.open_mainfile(filepath=path)

    def check(self, case, damage, live, is_removed):
        owner = self.spoil(damage)
        found, said = evaluated(), problem(case, owner)
        self.assertTrue(all(np.isfinite(one).all() for one in found))
        if said is None and not are_same(found, live):
            # The first evaluation after a file was opened has it wired again by itself.
            self.assertTrue(are_same(evaluated(), live), "neither said nor harmless")
        elif said is not None and said.blocking:
            self.assertIn(said.sentence.split()[0], drawn(case, owner))
        support.addon("core.wiring.sinks.attribute_sink").store_own_poses()
        act = case.remove if is_removed else case.refresh
        self.assertEqual(act(object="Owner"), {'FINISHED'})
        found = evaluated()
        if not is_removed:
            self.assertIsNone(problem(case, owner))
            self.assertTrue(are_same(found, live), "not repaired")
            return
        self.assertFalse(getattr(owner.motus, case.system).is_active)
        self.assertEqual([name for name in owner.keys() if name.startswith("motus_")], [])
        drivers = owner.animation_data.drivers if owner.animation_data else ()
        self.assertEqual([curve.data_path for curve in drivers], [])

    def test_linked(self):
        """Libraries that are damaged: Blender writes the results of linked solvers into memory by another way."""
        spoilt = []
        for case, some, live, path in self.each(LINKED_SHARE):
            for damage in some:
                bpy.ops.wm.open_mainfile(filepath=path)
                self.spoil(damage)
                library = str(self.folder / f"{len(spoilt)}.blend")
                names = bpy.context.scene.collection.objects.keys()
                bpy.ops.wm.save_as_mainfile(filepath=library, copy=True)
                spoilt.append((case, damage, live, library, names))
        support.empty_scene()
        with raised() as errors:
            for case, damage, live, library, names in spoilt:
                with self.subTest(case=case.build.__name__, damage=damage.name):
                    owner = self.link(library, names)
                    found, said = evaluated(), problem(case, owner)
                    self.assertTrue(all(np.isfinite(one).all() for one in found))
                    self.assertTrue(said is not None or are_same(found, live), "neither said nor harmless")
                    for obj in list(bpy.context.scene.collection.objects):
                        bpy.context.scene.collection.objects.unlink(obj)
        self.assertEqual(errors, [])

    def link(self, library, names):
        with bpy.data.libraries.load(library, link=True) as (_, wanted):
            wanted.objects = list(names)
        for one in wanted.objects:
            self.assertIsNotNone(one.library)
            bpy.context.scene.collection.objects.link(one)
        return wanted.objects[names.index("Owner")]

    def test_override_of_a_damaged_library(self):
        for build in (chain, long_chain):
            support.empty_scene()
            case = next(case for case in CASES if case.build is build)
            owner = build()
            live = evaluated()
            carrier_of(case, owner)[INFO.format("ik")] = 5
            library = str(self.folder / f"{build.__name__}.blend")
            bpy.ops.wm.save_as_mainfile(filepath=library)
            support.empty_scene()
            linked = self.link(library, ["Owner", "Target"])
            with raised() as errors:
                owner = linked.override_create(remap_local_usages=True)
                bpy.context.view_layer.objects.active = owner
                evaluated()
                if linked.users_collection:
                    bpy.context.scene.collection.objects.unlink(linked)
                support.addon("core.wiring").refresh(support.addon("ik").SYSTEM, owner)
                self.assertTrue(are_same(evaluated(), live))
                self.assertIsNone(problem(case, owner))
            self.assertEqual(errors, [])

    def test_the_driver_lives_on(self):
        """What is put right again is solved again, without anything being wired."""
        for case in CASES:
            for name in (OUTBOX, INFO):
                with self.subTest(case=case.build.__name__, name=name):
                    support.empty_scene()
                    owner = case.build()
                    live = evaluated()
                    key = name.format(case.system)
                    if key not in carrier_of(case, owner):
                        continue
                    kept = carrier_of(case, owner)[key]
                    kept = kept.to_dict() if name == INFO else list(kept)
                    carrier_of(case, owner)[key] = {"digest": "zz"} if name == INFO else [0] * len(kept)
                    carrier_of(case, owner).update_tag()
                    with raised() as errors:
                        evaluated()
                    self.assertEqual(errors, [])
                    self.assertIsNotNone(problem(case, owner))
                    carrier_of(case, owner)[key] = kept
                    carrier_of(case, owner).update_tag()
                    self.assertTrue(are_same(evaluated(), live))

    def test_at_rest(self):
        """Where what is known of the group is damaged, all stands as if the influence were 0."""
        for case in CASES:
            support.empty_scene()
            owner = case.build()
            getattr(owner.motus, case.system).influence = 0.0
            rest = evaluated()
            getattr(owner.motus, case.system).influence = 1.0
            self.assertFalse(are_same(evaluated(), rest))
            for name in (OUTBOX, INFO):
                key, carrier = name.format(case.system), carrier_of(case, owner)
                if key in carrier:
                    with self.subTest(case=case.build.__name__, name=name):
                        carrier[key] = 5 if name == INFO else [7.0] * len(carrier[key]) + [7.0]
                        carrier.update_tag()
                        self.assertTrue(are_same(evaluated(), rest))
                        case.refresh(object="Owner")

    def test_newer(self):
        for build in (chain, long_chain):
            support.empty_scene()
            case = next(case for case in CASES if case.build is build)
            owner = build()
            carrier_of(case, owner)[INFO.format("ik")]["version"] = 2
            carrier_of(case, owner).update_tag()
            evaluated()
            self.assertIn("newer version of Motus", problem(case, owner).sentence)
            self.assertIn("newer version of Motus", drawn(case, owner))

    def test_a_text_is_known_by_what_it_says(self):
        """Whatever name a file gives it."""
        first = chain()
        second = first.copy()
        bpy.context.scene.collection.objects.link(second)
        second.motus.ik.entries[0].chain_length = 2
        live = evaluated()
        for obj in (first, second):
            mesh = obj.motus.ik.hub.data
            mesh["motus_ik_info"] = {"digest": "zz", "text": mesh["motus_ik_info"]["text"]}
            mesh.update_tag()
        self.assertTrue(are_same(evaluated(), live))
