"""What Motus keeps in a file and reads back, with values that somebody else has put there.

Nothing raises, in no solver, panel, overlay or operator; what cannot be read is as by default, or the panel says so.
"""

import json
import math

import bpy
import numpy as np

import support
from chroma import chroma_setup_cases
from core.file import test_wrong_kinds as wrong_kinds
from core.wiring.hubs import damaged_cases
from lattice import lattice_cases

PREFIX = "motus_"
DEEP = "[" * 100_000
TEXTS = (
    "x",
    DEEP,
    DEEP + "]" * 100_000,
    '{"a":' * 100_000,
    "5",
    "null",
    "[[1e999]]",
    "nan",
    "9" * 5000,
    "-1.2.3-4..5",
    "0-",
    '"' + '\\"' * 9,
)
"""Texts that are none of those which Motus writes."""


def values(before):
    """Other values for a custom property: of another type or length, with numbers that are not finite or huge. before: the value."""
    count = len(before) if hasattr(before, "typecode") else 3
    return [
        5,
        -2.5,
        1e300,
        math.nan,
        -math.inf,
        "",
        *TEXTS[:3],
        b"\x00\xff\x00",
        {},
        {"a": {"b": [1.0, 2.0]}},
        [{"a": 1}, {"b": 2}],
        [1, 2, 3],
        [0.5] * (count + 1),
        [math.nan] * count,
        [math.inf] * count,
        [1e300] * count,
        bpy.data.scenes[0],
    ]


COUNT = 19
"""How many values() are."""


def put(holder, name, value):
    """Give a custom property another value; returns whether Blender takes it."""
    del holder[name]
    try:
        holder[name] = value
    except (TypeError, ValueError, OverflowError):
        return False
    return True


def holders():
    """All that has custom properties of ours in the file: datablocks, and nodes."""
    blocks = [block for kind in dir(bpy.data) for block in datablocks(kind)]
    trees = [block for block in blocks if isinstance(block, bpy.types.NodeTree)]
    trees += [tree for tree in map(chroma_setup_cases.compositor.tree_of, bpy.data.scenes) if tree and tree not in trees]
    nodes = [node for tree in trees for node in tree.nodes]
    return [one for one in (*blocks, *nodes) if any(name.startswith(PREFIX) for name in one.keys())]


def datablocks(kind):
    """The datablocks in a list of bpy.data of this name; nothing for what is no such list."""
    found = getattr(bpy.data, kind)
    return [one for one in found if isinstance(one, bpy.types.ID)] if isinstance(found, bpy.types.bpy_prop_collection) else []


def kept():
    """(holder, name) of all custom properties of ours in the file, those of one name after another."""
    return sorted(((one, name) for one in holders() for name in one.keys() if name.startswith(PREFIX)), key=lambda pair: pair[1])


class KeptValues(wrong_kinds.LiveFile):
    """Each custom property, and each text among the settings, in a scene with every system."""

    def test_custom_properties(self):
        names = list(dict.fromkeys(name for _, name in kept()))
        self.assertGreater(len(names), 30)
        for turn in range(COUNT):
            with self.subTest(turn=turn), damaged_cases.raised() as errors:
                self.reopen()
                for holder, name in kept():
                    number = (names.index(name) + turn) % COUNT
                    put(holder, name, values(holder[name])[number])
                self.look()
                self.assertEqual(errors, [])

    @support.in_one_blender
    def test_texts(self):
        def is_text(prop):
            return prop.type == 'STRING' and not prop.is_skip_save

        for number in range(len(TEXTS)):
            with self.subTest(text=TEXTS[number][:20]), damaged_cases.raised() as errors:
                self.reopen()
                for kind in wrong_kinds.places(is_text).values():
                    for turn, (name, found) in enumerate(kind.items()):
                        self.write(name, found, [TEXTS[(number + turn) % len(TEXTS)]])
                self.look()
                self.assertEqual(errors, [])


class RestOfALattice(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.ball = lattice_cases.ball()
        bpy.ops.motus.lattice_fit(objects="Ball", margin=0.2)
        self.lattice = bpy.context.object
        self.lattice_name = self.lattice.name
        self.regular = lattice_cases.points_of(self.lattice)
        lattice_cases.displace(self.lattice, 0.08)
        bpy.ops.motus.lattice_rest(object="Ball")
        self.path = str(self.folder / "rest.blend")
        bpy.ops.wm.save_as_mainfile(filepath=self.path)

    def each(self, holder_of):
        """Yields (ball, lattice) with each other value of the custom property of what holder_of(ball, lattice) returns."""
        name = self.lattice.name
        for number in range(COUNT):
            bpy.ops.wm.open_mainfile(filepath=self.path)
            ball, lattice = bpy.data.objects["Ball"], bpy.data.objects[name]
            self.assertNotIn("does not fit any more", self.said(lattice))
            holder = holder_of(ball, lattice)
            if put(holder, "motus_rest", values(holder["motus_rest"])[number]):
                with self.subTest(number=number):
                    self.assertIn("does not fit any more", self.said(lattice))
                    yield ball, lattice

    def said(self, lattice):
        """All sentences of the panel of a lattice."""
        bpy.context.view_layer.objects.active = lattice
        layout = damaged_cases._Layout()
        support.addon("lattice.panel").draw_main(layout, bpy.context)
        return " ".join(layout.texts)

    def test_points(self):
        for _ball, lattice in self.each(lambda _ball, lattice: lattice.data):
            self.assertEqual(bpy.ops.motus.lattice_reset(object=lattice.name), {'FINISHED'})
            np.testing.assert_array_equal(lattice_cases.points_of(lattice), self.regular)
            self.assertEqual(bpy.ops.motus.lattice_rest(object=lattice.name), {'FINISHED'})
            self.assertNotIn("does not fit any more", self.said(lattice))
            self.assertEqual(bpy.ops.motus.lattice_rest(object=lattice.name, use_regular=True), {'FINISHED'})
            self.assertNotIn("motus_rest", lattice.data)

    def test_shape_key(self):
        def mesh_of(ball, _lattice):
            del ball.data["motus_rest_places"]  # by which the key would be found
            return ball.data

        for _ball, lattice in self.each(mesh_of):
            self.assertEqual(bpy.ops.motus.lattice_reset(object=lattice.name), {'FINISHED'})
            self.assertEqual(bpy.ops.motus.lattice_rest(object=lattice.name), {'FINISHED'})
            self.assertNotIn("does not fit any more", self.said(lattice))
            self.assertEqual(bpy.ops.motus.lattice_remove(objects="Ball"), {'FINISHED'})

    def test_places_of_the_shape_key(self):
        """By which it is found when it was renamed."""
        for number in range(COUNT):
            bpy.ops.wm.open_mainfile(filepath=self.path)
            mesh, lattice = bpy.data.objects["Ball"].data, bpy.data.objects[self.lattice_name]
            mesh.shape_keys.key_blocks[mesh["motus_rest"]].name = "Mine"
            self.assertNotIn("does not fit any more", self.said(lattice))
            if put(mesh, "motus_rest_places", values("")[number]):
                with self.subTest(number=number):
                    self.assertIn("does not fit any more", self.said(lattice))


class OfOneSystem(chroma_setup_cases.SetUpTestCase):
    """What is read by operators of a single system."""

    def test_roles_of_nodes(self):
        self.set_up(filepath=str(chroma_setup_cases.footage(self.folder)))
        path = self.save()
        for number in range(COUNT):
            bpy.ops.wm.open_mainfile(filepath=path)
            tree = chroma_setup_cases.compositor.tree_of(bpy.context.scene)
            for node in [node for node in tree.nodes if "motus_chroma" in node]:
                put(node, "motus_chroma", values("")[number])
            with self.subTest(number=number), damaged_cases.raised() as errors:
                wrong_kinds.draw_panels(wrong_kinds.panels())
                self.assertRefused("has lost its footage", bpy.ops.motus.chroma_key_add, color=(0.1, 0.1, 0.8))
                bpy.ops.motus.chroma_key_remove()
                self.assertEqual(errors, [])

    def test_lengths_of_rods(self):
        for number in range(COUNT):
            support.empty_scene()
            bpy.ops.motus.pendulum_add(kind='SINGLE')
            pivot = bpy.context.object
            entry = pivot.motus.pendulum.rods[0]
            rod, bob = entry.object, entry.bob
            put(rod.data, "motus_pendulum", values(1.0)[number])
            entry.rest = [math.nan] * 16
            with self.subTest(number=number), damaged_cases.raised() as errors:
                pivot.motus.pendulum.length1 = 2.0
                self.assertTrue(np.isfinite([vertex.co for vertex in rod.data.vertices]).all())
                bpy.context.view_layer.update()
                self.assertTrue(np.isfinite(bob.matrix_world).all())
                bpy.ops.motus.pendulum_remove(object=pivot.name)
                self.assertEqual(errors, [])

    def test_values_before_baking(self):
        states, keys = support.addon("core.bake.state"), support.addon("core.bake.keys")
        material = bpy.data.materials.new("Paint")
        material["motus_bake"] = {}
        expected = {name: default for name, (_, default) in states._FORMS.items()}
        for value in values([0.0]):
            with self.subTest(value=str(value)[:20]):
                if put(material, "motus_bake", value):
                    found = states.of(material)
                    self.assertEqual({name: getattr(found, name) for name in expected}, expected)
                    found.is_baked = True
                    self.assertEqual((found.is_baked, material["motus_bake"]["is_baked"]), (True, True))
        self.assertNotIn("is_baked", bpy.data.scenes[0])
        for text in (*TEXTS, json.dumps({"values": {"location": [1e300, 0.0, 0.0]}, "muted": {"constraints": [], "drivers": []}})):
            with self.subTest(text=text[:20]):
                found, constraints, drivers, is_whole = keys._kept(text)
                self.assertEqual((found, constraints, drivers, is_whole), ({}, [], [], False))
                self.assertEqual(keys._numbers(text, None)[0], [])

    def test_values_that_an_operator_has_found(self):
        support.link("Cloud")
        for text in TEXTS:
            with self.subTest(text=text[:20]):
                self.assertEqual(bpy.ops.motus.snow_add(found_values=text, rate=3.0), {'FINISHED'})
                self.assertEqual(bpy.context.object.motus.snow.rate, 3.0)

    def test_checks_of_chains(self):
        rig = damaged_cases.chain()
        entry, results = rig.motus.ik.entries[0], support.addon("ik.checking.results")
        results.store(entry, [1, 2, 3, 4], 1.0, [2, 3], 0.5, 'FAR')
        self.assertTrue(results.contradicts(entry, 2.0, 'NONE'))
        self.assertFalse(results.contradicts(entry, 2.0, 'FAR'))
        for text in (*TEXTS, "1-1e9", "-" + "9" * 5000 + "-5"):
            for step in (1.0, 0.0, -1.0, 1e-45, math.nan, math.inf):
                for name in ("check_range", "check_frames"):
                    results.store(entry, [1, 2, 3, 4], 1.0, [2, 3], 0.5, 'FAR')
                    entry.check_step = step
                    setattr(entry, name, text)
                    with self.subTest(text=text[:20], step=step, name=name):
                        results.contradicts(entry, 2.0, 'NONE')
                        self.assertIsInstance(results.sentence(entry, str), str)


class Forms(support.SceneTestCase):
    """The readers themselves."""

    def test_readers(self):
        stored, holder = support.addon("core.file.stored"), bpy.data.meshes.new("Holder")
        readers = {
            "group": lambda: stored.group(holder.get("x")),
            "text": lambda: stored.text(holder.get("x")),
            "number": lambda: stored.number(holder.get("x")),
            "numbers": lambda: stored.finite_doubles(holder.get("x"), 3),
        }
        fits = {"": {"text"}, **{text: {"text"} for text in TEXTS[:3]}, 5: {"number"}, -2.5: {"number"}}
        for value in (*values([0.0] * 3), [1.0, 2.0, 3.0], None):
            if value is not None:
                holder["x"] = 0
                if not put(holder, "x", value):
                    continue
            elif "x" in holder:
                del holder["x"]
            known = {"group"} if isinstance(value, dict) else {"numbers"} if repr(value) == "[1.0, 2.0, 3.0]" else set()
            if isinstance(value, (str, int, float)):
                known = fits.get(value, set())
            found = set()
            for name, reader in readers.items():
                try:
                    reader()
                except stored.Damaged:
                    continue
                found.add(name)
            self.assertEqual(found, known, str(value)[:30])

    def test_huge_numbers(self):
        stored = support.addon("core.file.stored")
        for text, is_read in (
            ("[1e37]", True),
            ("[-1e37]", True),
            ("[1e39]", False),
            ("[-1e300]", False),
            ("[NaN]", False),
            ("[Infinity]", False),
        ):
            with self.subTest(text=text):
                if is_read:
                    self.assertEqual(stored.parse(text, [float]), json.loads(text))
                else:
                    self.assertRaises(stored.Damaged, stored.parse, text, [float])
