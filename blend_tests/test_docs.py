"""The manual: its examples run, its generated page is up to date, and its links lead somewhere."""

import math
import re
import sys

import bpy

import support
import test_translations

DOCS = support.CLONE / "docs"
sys.path.insert(0, str(DOCS / "scripts"))


def examples(page):
    """The Python blocks of a page."""
    return re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


class ExamplesTest(support.SceneTestCase):
    def test_the_scripted_example_follows_the_path(self):
        (scripted,) = [code for code in examples(DOCS / "path.md") if "bpy.ops.motus" in code]
        seen = []
        # A copy: Blender's vector would change with the object.
        scope = {"print": lambda place: seen.append(tuple(place))}
        exec(compile(scripted, "path.md", "exec"), scope)
        # The course is symmetric about its middle, which an eased motion reaches at half of the time.
        (place,) = seen
        for value, expected in zip(place, (4.0, 4.0, 1.0)):
            self.assertAlmostEqual(value, expected, places=5)
        self.assertFalse(scope["glider"].constraints)
        self.assertEqual(tuple(scope["glider"].location), (0.0, 0.0, 0.0))

    def test_the_scripted_example_of_dynamics_overshoots_and_settles(self):
        (scripted,) = [code for code in examples(DOCS / "dynamics.md") if "bpy.ops.motus" in code]
        seen = []
        scope = {"print": seen.append}
        exec(compile(scripted, "dynamics.md", "exec"), scope)
        overshoot, arriving, beyond, resting = seen
        self.assertAlmostEqual(overshoot, 0.372, places=3)
        self.assertLess(abs(arriving - 4.0), 1.0)
        self.assertGreater(beyond, 4.2)
        self.assertAlmostEqual(resting, 4.0, places=2)
        self.assertFalse(scope["crate"].constraints)

    def test_the_scripted_example_of_chains_hangs(self):
        (scripted,) = [code for code in examples(DOCS / "chains.md") if "bpy.ops.motus" in code]
        seen = []
        scope = {"print": seen.append}
        exec(compile(scripted, "chains.md", "exec"), scope)
        self.assertEqual(len(seen), 4)
        for height in seen:
            self.assertAlmostEqual(height, 0.8, places=2)
        self.assertFalse(scope["rig"].pose.bones["Tail 1"].constraints)

    def test_the_scripted_example_reaches_the_goal(self):
        (scripted,) = [code for code in examples(DOCS / "ik.md") if "bpy.ops.motus" in code]
        seen = []
        # Run up to the removal first, to look at the other frame too.
        reaching, removal, rest = scripted.partition("bpy.ops.motus.ik_remove")
        scope = {"print": lambda place: seen.append(tuple(place))}
        exec(compile(reaching, "ik.md", "exec"), scope)
        (tip,) = seen
        rig = scope["rig"]
        self.assert_place(tip, (0.3, 0.2, 0.4), 1e-6)
        bpy.context.scene.frame_set(1)
        self.assert_animated(rig)

        exec(compile(removal + rest, "ik.md", "exec"), scope)
        bpy.context.scene.frame_set(20)
        self.assert_animated(rig)
        self.assertFalse(rig.motus.ik.entries)
        self.assertFalse(any(bone.constraints for bone in rig.pose.bones))
        self.assertIsNone(rig.animation_data)
        self.assertEqual([key for key in rig.keys() if key.startswith("motus_")], [])
        self.assertEqual({obj.name for obj in bpy.data.objects}, {"Arm", "Goal"})

    def test_the_scripted_example_of_layers_throws_while_it_walks(self):
        (scripted,) = [code for code in examples(DOCS / "layers.md") if "bpy.ops.motus" in code]
        seen = []
        scope = {"print": seen.append}
        exec(compile(scripted, "layers.md", "exec"), scope)
        leg, arm = seen
        self.assertAlmostEqual(leg, 0.5, places=5)
        self.assertAlmostEqual(arm, 2.5, places=5)
        puppet = scope["puppet"]
        self.assertFalse(puppet.motus.layers.entries)
        self.assertFalse(any(bone.constraints for bone in puppet.pose.bones))
        self.assertEqual(puppet.animation_data.action.name, "Puppet Flattened")
        bpy.context.scene.frame_set(13)
        self.assertAlmostEqual(puppet.pose.bones["Arm"].rotation_euler.x, 2.5, places=5)

    @support.in_one_blender
    def test_the_native_example_of_layers_runs(self):
        self.run_native("layers.md")

    def test_the_scripted_example_of_walkers_stands_on_the_ground(self):
        scripted, own, by_hand = [code for code in examples(DOCS / "walker.md") if "bpy.ops.motus" in code]
        seen = []
        scope = {"print": lambda place: seen.append(tuple(place))}
        exec(compile(scripted, "walker.md", "exec"), scope)
        self.assertEqual(len(seen), 2)
        for x, y, z in seen:
            self.assertAlmostEqual(z, 0.1 * math.sin(3.0 * x) * math.cos(2.0 * y), delta=2e-3)
            self.assertLess(abs(y - 2.0), 0.6)
        spider = scope["spider"]
        self.assertFalse(spider.motus.walker.is_active)
        self.assertFalse(spider.pose.bones["foot 1.L"].constraints)
        exec(compile(own, "walker.md", "exec"), scope)
        self.assertEqual(len(scope["carrier"].motus.walker.legs), 4)
        exec(compile(by_hand, "walker.md", "exec"), scope)
        for number, wanted in zip(seen[2], (-0.5, 1.4, 0.1)):
            self.assertAlmostEqual(number, wanted, places=6)

    @support.in_one_blender
    def test_the_native_example_of_walkers_runs(self):
        scope = self.run_native("walker.md")
        self.assertEqual(scope["walker"].feet(2.0).shape, (6, 3))

    def test_the_scripted_example_pulls_and_pins(self):
        (scripted,) = [code for code in examples(DOCS / "pull.md") if "bpy.ops.motus" in code]
        seen = []
        pinning, applying, rest = scripted.partition("bpy.ops.motus.pin_apply")
        scope = {"print": lambda *heights: seen.append(heights)}
        exec(compile(pinning, "pull.md", "exec"), scope)
        ((hill, plateau),) = seen
        self.assertAlmostEqual(hill, 1.5, places=5)
        self.assertAlmostEqual(plateau, 1.0, places=5)
        land, scene = scope["land"], bpy.context.scene
        top = scope["middle"] + 20
        self.assertEqual(land.data.vertices[top].co.z, 0.0)
        heights = [self.height_of(land, top, frame) for frame in (1, 7, 13)]
        self.assertAlmostEqual(heights[0], 0.0, places=6)
        self.assertTrue(0.0 < heights[1] < heights[2] <= 1.0, heights)

        exec(compile(applying + rest, "pull.md", "exec"), scope)
        self.assertFalse(land.motus.pull.pins)
        self.assertFalse(land.modifiers)
        self.assertAlmostEqual(self.height_of(land, top, 1), 0.0, places=6)
        self.assertAlmostEqual(self.height_of(land, top, 25), 1.0, places=5)
        self.assertEqual(scene.frame_current, 25)

    def test_the_scripted_example_drives_the_lamp(self):
        (scripted,) = [code for code in examples(DOCS / "drivers.md") if "bpy.ops.motus" in code]
        seen = []
        scope = {"print": seen.append}
        exec(compile(scripted, "drivers.md", "exec"), scope)
        swing = support.addon("core.native").module.pendulum_angle(1.0, 0.5, length=2.0)
        self.assertAlmostEqual(seen[0], swing, places=6)
        lamp = scope["lamp"]
        self.assertAlmostEqual(lamp.rotation_euler[0], swing, places=6)
        self.assertFalse(lamp.animation_data and lamp.animation_data.drivers)
        self.assertEqual([curve.data_path for curve in lamp.data.animation_data.drivers], ["energy"])

    def test_the_scripted_example_snows(self):
        _, scripted = [code for code in examples(DOCS / "snow.md") if "motus.snow_add" in code and "snow_cover" not in code]
        seen = []
        scope = {"print": seen.append}
        before = set(bpy.data.objects)
        exec(compile(scripted, "snow.md", "exec"), scope)
        # 500 a second, for 9 seconds more or less.
        self.assertAlmostEqual(seen[0], 4500, delta=100)
        self.assertEqual(set(bpy.data.objects), before)

    def test_the_scripted_example_lets_snow_lie(self):
        (scripted,) = [code for code in examples(DOCS / "snow.md") if "snow_cover_add" in code]
        seen = []
        exec(compile(scripted, "snow.md", "exec"), {"print": lambda *numbers: seen.extend(numbers)})
        # 220 a second on 12 m x 12 m for some 10 seconds and 3.4 litres each: 5 cm, more or less.
        self.assertTrue(0.04 < seen[1] < 0.2, seen[1])
        self.assertGreater(seen[0], 3000)

    def test_the_scripted_example_hands_flakes_on(self):
        exported, _ = [code for code in examples(DOCS / "snow.md") if "motus.snow_add" in code and "snow_cover" not in code]
        seen = []
        exec(compile(exported, "snow.md", "exec"), {"print": seen.append})
        # Some 450 flakes of 43 faces.
        self.assertGreater(seen[0], 15000)

    def test_the_native_example_of_snow_runs(self):
        scope = self.run_native("snow.md")
        self.assertEqual(scope["flakes"]["position"].shape, (5000, 3))

    def test_the_scripted_example_drags_the_pendulum(self):
        (scripted,) = [code for code in examples(DOCS / "pendulums.md") if "bpy.ops.motus" in code]
        seen = []
        scope = {"print": lambda place: seen.append(tuple(place))}
        before = set(bpy.data.objects)
        exec(compile(scripted, "pendulums.md", "exec"), scope)
        dragged, swung = seen
        self.assert_place(dragged, (1.0, 0.0, 2.0), 2e-6)
        self.assertGreater(sum((a - b) ** 2 for a, b in zip(dragged, swung)), 0.01)
        self.assertEqual(set(bpy.data.objects), before)

    def test_the_scripted_example_of_stereo_takes_its_budget(self):
        (scripted,) = [code for code in examples(DOCS / "stereo.md") if "bpy.ops.motus" in code]
        scene = bpy.context.scene
        scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        scene.camera.data.lens = 35.0
        scene.collection.objects.link(scene.camera)
        bpy.ops.mesh.primitive_plane_add(size=60.0, location=(0.0, 0.0, -12.0))
        seen = []
        scope = {"print": lambda *numbers: seen.extend(numbers)}
        exec(compile(scripted, "stereo.md", "exec"), scope)
        for found, wanted in zip(seen, (0.0771, 2.7273)):
            self.assertAlmostEqual(found, wanted, places=4)
        self.assertEqual(support.addon("stereo.results").of(scene.camera).sentences, ())
        self.assertEqual(scene.render.image_settings.stereo_3d_format.display_mode, 'ANAGLYPH')

    def height_of(self, land, vertex, frame):
        """Height of a vertex on a frame, as it is seen."""
        bpy.context.scene.frame_set(frame)
        return land.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices[vertex].co.z

    def assert_animated(self, rig):
        """The arm of ik.md stands as it was made, which is its animation."""
        posed = rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones
        self.assert_place(posed["lower"].head, (0.0, -0.1, 0.5), 1e-6)
        self.assert_place(posed["lower"].tail, (0.0, 0.0, 0.0), 1e-6)

    def assert_place(self, place, expected, within):
        for value, wanted in zip(place, expected):
            self.assertAlmostEqual(value, wanted, delta=within)

    def test_the_native_example_of_paths_runs(self):
        scope = self.run_native("path.md")
        self.assertEqual(scope["attitude"].shape, (1, 4))
        self.assertAlmostEqual(scope["halfway"][0], 4.0, places=9)

    def test_the_native_example_of_chains_reaches(self):
        scope = self.run_native("ik.md")
        arm, tentacle = scope["arm"], scope["tentacle"]
        self.assert_place(arm.tip, (0.3, 0.2, 0.4), 1e-12)
        self.assertLess(arm.elbow[1], 0.2 * arm.elbow[0] / 0.3, "the elbow is not on the pole's side")
        self.assert_place(tentacle.joints[-1], (0.8, 0.3, 0.9), 2e-6)
        self.assertEqual(tentacle.joints.shape, (21, 3))

    def test_the_native_example_of_pulling_pulls(self):
        scope = self.run_native("pull.md")
        flat, hill = scope["flat"], scope["hill"]
        self.assert_place(hill[5100], (0.0, 0.0, 0.4), 1e-6)
        far = (flat**2).sum(axis=1) >= 0.2501
        self.assertTrue((hill[far] == flat[far]).all(), "what is beyond the radius has moved")
        near = scope["indices"].tolist()
        self.assertEqual(near, [index for index, place in enumerate(flat) if float((place**2).sum()) ** 0.5 <= 0.25])
        self.assertEqual(scope["triangle"], 0)
        self.assert_place(scope["place"], (-0.995, -0.995, 0.0), 1e-6)
        self.assertAlmostEqual(scope["away"], 1.0, places=6)

    def run_native(self, page):
        """What the example without Blender of a page leaves."""
        (native_example,) = [code for code in examples(DOCS / page) if "import motus_native" in code]
        sys.modules["motus_native"] = support.addon("core.native").module
        self.addCleanup(sys.modules.pop, "motus_native")
        scope = {}
        exec(compile(native_example, page, "exec"), scope)
        return scope


class PagesTest(support.SceneTestCase):
    def test_the_page_of_what_is_kept_is_that_of_the_declarations(self):
        import kept_page

        page = (DOCS / "kept.md").read_text(encoding="utf-8")
        self.assertEqual(page, kept_page.text(), "run ./motus docs kept")

    def test_the_table_of_settings_is_that_of_the_classes(self):
        import settings_page

        self.assertTrue(
            (DOCS / "settings.json").read_text(encoding="utf-8") == settings_page.text(),
            "run ./motus docs settings",
        )

    def test_the_operator_page_names_every_operator_and_keyword(self):
        import operator_page

        page = (DOCS / "operators.md").read_text(encoding="utf-8")
        for identifier in operator_page.identifiers():
            self.assertTrue(f"## `{identifier}`\n" in page, f"run ./motus docs operators: {identifier} is missing")
            rna = getattr(bpy.ops.motus, identifier.partition(".")[2]).get_rna_type()
            section = page.partition(f"## `{identifier}`")[2].partition("\n## ")[0]
            for prop in rna.properties:
                if prop.identifier != "rna_type" and not prop.is_hidden:
                    self.assertIn(f"| `{prop.identifier}` |", section, f"run ./motus docs operators: {identifier}")

    @support.in_one_blender
    def test_links_and_pictures_exist(self):
        for page in [*DOCS.glob("*.md"), DOCS.parent / "README.md"]:
            prose = re.sub(r"^ {4}.*$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE)  # the rest is code
            for link in re.findall(r"\]\(([^)#]+)", prose):
                if "://" not in link:
                    self.assertTrue((page.parent / link).exists(), f"{page.name}: {link}")

    @support.in_one_blender
    def test_the_programmers_pages_name_every_module(self):
        core = support.CLONE / "addon" / "motus" / "core"
        for page, folder in (("architecture.md", core), ("wiring.md", core / "wiring")):
            words = set(re.findall(r"\w+", (DOCS / page).read_text(encoding="utf-8")))
            missing = (
                {path.stem for path in folder.iterdir() if path.suffix == ".py" or (path / "__init__.py").exists()} - words - {"__init__"}
            )
            self.assertEqual(sorted(missing), [], page)


LABELLED = {"slider", "setting", "option", "mode", "falloff", "preset", "style"}
"""What the first column of a table is called whose cells are labels of the interface."""
SYMBOLS = {"X", "Y", "Z"}
"""Labels that are the same in every language."""


SYSTEMS = tuple(sorted(page.stem for page in DOCS.glob("*.md") if "\n### In five steps\n" in page.read_text(encoding="utf-8")))
"""Pages for artists, whose words in italics are labels of the interface."""
OF_BLENDER = {
    "Add",
    "Object",
    "Pose",
    "Motus",
    "OK",
    "Auto Run Python Scripts",
    "Use Self",
    "Keying",
    "Standard",
    "Sensor Fit",
    "Vertical",
    "Views Format",
    "Multi-View",
    "Convergence Distance",
    "Attribute",
    "Instancer",
    "Render",
    "Output",
    "Placeholders",
    "Overwrite",
    "Realize Instances",
    "Material Preview",
    "Viewer",
    "Image Sequence",
    "Field of View",
}
ROWS = (
    ("path", "path", "path"),
    ("layers", "layers", "layers"),
    ("ik", "ik", "ik"),
    ("look_at", "look_at", "look_at"),
    ("pull", "pull", "pull"),
    ("dynamics", "dynamics", "dynamics"),
    ("chains", "chains", "chains"),
    ("pendulums", "pendulum", "pendulum"),
    ("pendulums", "pendulum", "pendulum_trail"),
    ("snow", "snow", "snow"),
    ("snow", "snow.cover", "snow_cover"),
    ("stereo", "stereo", "stereo"),
    ("walker", "walker", "walker"),
)
"""Page, folder in the add-on, and settings of a system whose panels have rows."""
OTHER_PAGES = {"pendulum": "pendulums", "snow_cover": "snow"}
"""Of systems whose page has another name."""
NAMES = {"Motus Green Screen", "Motus Trail", "Motus Flake", "Motus Spark"}
"""What is no label: datablocks that are made."""


class LabelsTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        self.shown = {text for _, text in test_translations.english_texts()} | SYMBOLS

    @support.in_one_blender
    def test_what_the_tables_name_is_in_the_interface(self):
        unknown = [f"{page.name}: {label}" for page in sorted(DOCS.glob("*.md")) for label in labels_of(page) if label not in self.shown]
        self.assertEqual(unknown, [])

    @support.in_one_blender
    def test_what_stands_in_italics_is_in_the_interface(self):
        unknown = [
            f"{name}: {label}"
            for name in SYSTEMS
            for label in italics_of(DOCS / f"{name}.md")
            if label not in self.shown | OF_BLENDER | NAMES
        ]
        self.assertEqual(unknown, [])

    @support.in_one_blender
    def test_what_the_panels_show_is_on_the_pages(self):
        """A row of a panel is a label in a table of its system's page, or stands there in italics."""
        missing = []
        for name, folder, settings in ROWS:
            explained = {*labels_of(DOCS / f"{name}.md"), *italics_of(DOCS / f"{name}.md")}
            missing += [f"{name}.md: {label}" for label in sorted(labels_shown(folder, settings) - explained)]
        self.assertEqual(missing, [])

    @support.in_one_blender
    def test_presets_are_on_the_pages(self):
        missing = []
        for operator in (name for name in dir(bpy.ops.motus) if name.endswith("_preset_use")):
            name = operator.removesuffix("_preset_use")
            page = DOCS / f"{OTHER_PAGES.get(name, name)}.md"
            text = page.read_text(encoding="utf-8")
            presets = getattr(bpy.ops.motus, operator).get_rna_type().properties["preset"].enum_items
            missing += [f"{page.name}: {preset.name}" for preset in presets if preset.name not in text]
        self.assertEqual(missing, [])


def labels_shown(folder, settings):
    """What the rows of a system's panels call the settings below bpy.types.Object.motus; what is an operator's alone is left out."""
    core, rows, groups = support.addon("core.interface.rows"), [], {}

    def gather_rows(thing):
        if isinstance(thing, tuple):
            for part in thing:
                gather_rows(part)
        elif isinstance(thing, core.Rows):
            gather_rows(tuple(core.Row(part) if isinstance(part, str) else part for part in thing.rows))
        elif isinstance(thing, core.Row):
            rows.append(thing)

    def gather_groups(rna):
        if rna.identifier.startswith("MOTUS_PG_") and rna.identifier not in groups:
            groups[rna.identifier] = rna.properties
            for prop in rna.properties:
                if prop.type in {'POINTER', 'COLLECTION'}:
                    gather_groups(prop.fixed_type)

    gather_rows(tuple(vars(support.addon(f"{folder}.rows")).values()))
    gather_groups(bpy.types.Object.bl_rna.properties["motus"].fixed_type.properties[settings].fixed_type)
    texts = {row.name: row.text for row in rows if row.text}
    return {texts.get(row.name, properties[row.name].name) for row in rows for properties in groups.values() if row.name in properties}


def labels_of(page):
    """What stands in the first column of a page's tables, if that holds labels."""
    is_labelled = was_row = False
    for line in page.read_text(encoding="utf-8").splitlines():
        is_row = line.startswith("| ")
        first = line.strip("| ").partition(" |")[0]
        if is_row and not was_row:
            is_labelled = first.lower() in LABELLED
        elif is_row and is_labelled:
            yield from first.replace("\\|", "|").strip("*").split(", ")
        was_row = line.startswith("|")


def italics_of(page):
    """What stands in italics and begins with a capital: labels, and each part of a way through menus. Without the labels of other programs."""
    prose = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    before, title, others = prose.partition("### Coming from another program\n")
    prose = before + title + re.sub(r"^\| [^|]* \|", "|", others, flags=re.MULTILINE)
    for found in re.findall(r"(?<![*\w])\*([A-Z][^*0-9()]{2,})\*(?![*\w])", prose):
        yield from re.split(" > |: ", " ".join(found.split()))
