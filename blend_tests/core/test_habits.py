"""What every system shares in the interface: each test goes over all that is registered, so that a new system is held to it."""

import types
from unittest import mock

import bpy

import live_scenes
import support

core = support.addon("core.interface.operators")
offering = support.addon("core.interface.view.offering")
panels = support.addon("core.interface.panels")
system = support.addon("core.declare")
over_frames = support.addon("core.interface.over_frames")
package = support.addon().__name__


def operators():
    """The registered operators that a user can call."""
    return [
        cls
        for cls in bpy.types.Operator.__subclasses__()
        if cls.__module__.startswith(f"{package}.") and getattr(cls, "is_registered", False) and 'INTERNAL' not in cls.bl_options
    ]


def keywords(operator):
    """RNA properties of an operator."""
    rna = getattr(bpy.ops.motus, operator.bl_idname.partition(".")[2]).get_rna_type()
    return [prop for prop in rna.properties if prop.is_runtime]


def live_objects():
    """The objects of a scene with every system at work."""
    live_scenes.opened()
    return list(bpy.context.scene.objects)


def system_panels():
    return [panel for one in system.registered.values() for panel in panels.described(one)]


def classes_of(panel):
    return [cls for cls in bpy.types.Panel.__subclasses__() if getattr(cls, "of_system", None) is panel]


class Properties:
    """An operator's keywords, or what a button is given: all at their defaults, until they are set."""

    def __init__(self, operator=None):
        rna = keywords(operator) if operator else ()
        self.bl_rna = types.SimpleNamespace(properties={prop.identifier: prop for prop in rna})

    @property
    def properties(self):
        return self

    def is_given(self, name):
        return name in vars(self)

    def given(self, names):
        return {name: getattr(self, name) for name in names if self.is_given(name)}

    def __getattr__(self, name):
        prop = vars(self)["bl_rna"].properties.get(name)
        if prop is None:
            raise AttributeError(name)
        if getattr(prop, "is_array", False):
            return tuple(prop.default_array)
        if prop.type == 'COLLECTION':
            return ()
        return set(prop.default_flag) if prop.type == 'ENUM' and prop.is_enum_flag else prop.default


class Layout:
    """Notes what is drawn, in its order: (kind, name, whether it is enabled)."""

    def __init__(self, drawn=None, above=None):
        self.drawn = [] if drawn is None else drawn
        self.enabled, self.use_property_split, self._above = True, False, above

    @property
    def is_enabled(self):
        return self.enabled and (self._above is None or self._above.is_enabled)

    def _inner(self, *_arguments, **_options):
        return Layout(self.drawn, self)

    row = column = box = split = grid_flow = column_flow = _inner

    def _note(self, kind, name):
        self.drawn.append((kind, name, self.is_enabled))

    def prop(self, _data, name, *_arguments, **_options):
        self._note("prop", name)

    prop_search = prop

    def template_list(self, _kind, _name, _data, name, *_arguments, **_options):
        self._note("list", name)

    def template_icon(self, *_arguments, **_options):
        self._note("icon", "")

    def operator(self, name, *_arguments, **_options):
        self._note("operator", name)
        return Properties()

    operator_menu_enum = operator

    def label(self, text="", **_options):
        self._note("label", text)

    def menu(self, name, **_options):
        self._note("menu", name)

    def separator(self, *_arguments, **_options):
        pass

    context_pointer_set = template_curve_mapping = separator

    def named(self, kind):
        return [name for of, name, _ in self.drawn if of == kind]


def drawn(cls, context=None):
    """What a panel's class draws, where it is there at all; None where it is not."""
    context = context or bpy.context
    if hasattr(cls, "poll") and not cls.poll(context):
        return None
    layout = Layout()
    cls.draw(types.SimpleNamespace(layout=layout), context)
    return layout


OTHER = {'BOOLEAN': None, 'STRING': "Course", 'INT': 1, 'FLOAT': 1.0}
"""Values that are no defaults, by the type of the keyword; of a switch it is the other one."""


class Operators(support.SceneTestCase):
    def test_refusals_are_reported_in_one_place(self):
        for operator in operators():
            with self.subTest(operator.bl_idname):
                own = {
                    name
                    for cls in operator.__mro__
                    if cls.__module__.startswith(f"{package}.") and cls.__module__ not in {core.__name__, over_frames.__name__}
                    for name in vars(cls)
                }
                self.assertFalse(own & {"execute", "poll", "draw"})


class RedoPanel(support.SceneTestCase):
    """The panel Adjust Last Operation."""

    def test_every_operator_says_what_it_draws(self):
        self.assertGreater(len(operators()), 35)
        for operator in operators():
            with self.subTest(operator.bl_idname):
                self.assertTrue(issubclass(operator, core.Operator))
                rows = [name for group in operator.redo for name in group.names]
                for prop in keywords(operator):
                    is_said = prop.identifier in rows or prop.identifier in operator.for_scripts
                    self.assertTrue(is_said or core.is_for_scripts(prop), f"{prop.identifier}: in no row, nor for scripts")
                self.assertEqual(set(rows) & set(operator.for_scripts), set())
                self.assertLessEqual({*rows, *operator.for_scripts}, {prop.identifier for prop in keywords(operator)})

    def draw(self, operator, **choices):
        layout, made = Layout(), Properties(operator)
        vars(made).update(choices, layout=layout, redo=operator.redo, for_scripts=operator.for_scripts, draw_below=lambda _context: None)
        core.Operator.draw(made, bpy.context)
        return layout

    def each_choice(self, operator):
        """What is drawn with the defaults, and with each item of each choice and another value of each keyword."""
        yield {}, self.draw(operator)
        for prop in keywords(operator):
            if prop.type == 'ENUM' and not prop.is_enum_flag:
                for item in prop.enum_items:
                    yield {prop.identifier: item.identifier}, self.draw(operator, **{prop.identifier: item.identifier})
            elif prop.type in OTHER and not getattr(prop, "is_array", False):
                value = not prop.default if prop.type == 'BOOLEAN' else OTHER[prop.type]
                yield {prop.identifier: value}, self.draw(operator, **{prop.identifier: value})

    def test_no_names_indices_and_places_that_are_not_given(self):
        for operator in operators():
            for choices, layout in self.each_choice(operator):
                if any(core.is_for_scripts(prop) for prop in keywords(operator) if prop.identifier in choices):
                    continue  # what is given may be drawn
                with self.subTest(operator.bl_idname, **choices):
                    for prop in keywords(operator):
                        # A name that is chosen from a list is no riddle.
                        is_chosen = prop.identifier in {
                            row.name for group in operator.redo for row in group.rows if getattr(row, "search", None)
                        }
                        if core.is_for_scripts(prop) and not is_chosen:
                            self.assertNotIn(prop.identifier, layout.named("prop"))

    def test_only_what_matters(self):
        """Rows that a choice has nothing to do with are not there."""
        # What is shown of a pin depends on the active follower.
        bpy.context.view_layer.objects.active = next(one for one in live_objects() if one.motus.path.is_active)
        for operator in operators():
            conditional = {
                name for group in operator.redo for row in group.rows for name in getattr(row, "names", ()) if getattr(row, "when", None)
            }
            shown = [set(layout.named("prop")) for _, layout in self.each_choice(operator)]
            always = conditional & set.intersection(*shown)
            with self.subTest(operator.bl_idname):
                self.assertLess(len(always), len(conditional) or 1, "conditions that never hide a row")


class Panels(support.SceneTestCase):
    def test_all_are_made_of_what_the_system_declares(self):
        made = {cls for panel in system_panels() for cls in classes_of(panel)}
        for cls in bpy.types.Panel.__subclasses__():
            is_ours = cls.__module__.startswith(f"{package}.") and getattr(cls, "is_registered", False)
            if is_ours and not cls.__name__.endswith("_presets"):
                self.assertIn(cls, made | set(panels.classes_of_core))
        for one in system.registered.values():
            self.assertTrue(panels.described(one), one.name)

    def owners(self):
        """(SystemPanel, object that uses the system) for each of them."""
        for one in live_objects():
            bpy.context.view_layer.objects.active = one
            for panel in system_panels():
                if panel.is_used and panel.is_shown(bpy.context):
                    yield panel, one

    def test_settings_then_readouts_then_actions(self):
        for panel in system_panels():
            actions = {part.name for part in panel.parts if part.is_action} | {"actions"}
            for end, editor in panel.editors.items():
                shown = [cls for cls in classes_of(panel) if issubclass(cls, editor) and hasattr(cls, "bl_parent_id")]
                parts = [cls.__name__.removeprefix(f"{panel.prefix}{end}_") for cls in shown]
                kinds = [2 if part in actions else 1 if part == "readouts" else 0 for part in parts]
                with self.subTest(panel.prefix + end):
                    self.assertEqual(kinds, sorted(kinds), parts)

    def test_nothing_but_settings_above_the_parts(self):
        """Buttons within the first part of a panel belong to its lists, or to what is wrong."""
        for panel, owner in self.owners():
            bpy.context.view_layer.objects.active = owner
            layout = Layout()
            panel.draw(layout, bpy.context)
            found = [name for name in layout.named("operator") if name in ("motus.bake", "motus.unbake")]
            with self.subTest(panel.prefix, owner=owner.name):
                self.assertEqual(found, [])

    def test_refresh_in_a_menu(self):
        for panel, owner in self.owners():
            bpy.context.view_layer.objects.active = owner
            for cls in classes_of(panel):
                layout = drawn(cls)
                with self.subTest(cls.__name__):
                    self.assertFalse([name for name in layout.named("operator") if name.endswith("_refresh")] if layout else [])
            if panel.refresh:
                menu = getattr(bpy.types, f"{panel.prefix.replace('_PT_', '_MT_')}_more")
                layout = Layout()
                menu.draw(types.SimpleNamespace(layout=layout), bpy.context)
                copying = (
                    [panels.COPY, panels.PASTE, panels.KEEP, "motus.to_selected"]
                    if getattr(system.registered[panel.name], "copied_settings", ())
                    else []
                )
                self.assertEqual(layout.named("operator"), [*copying, panel.refresh, "motus.manual"])
        for one in system.systems():
            self.assertTrue(any(panel.refresh for panel in panels.described(one)), f"{one.name} has no Refresh")

    def test_settings_are_copied_as_text_and_pasted(self):
        copied, copying = support.addon("core.settings.copied"), support.addon("core.interface.any_system.copying")
        found = {panel.name: owner for panel, owner in self.owners() if getattr(system.registered[panel.name], "copied_settings", ())}
        self.assertGreaterEqual(len(found), 11)

        def taken(one, owner):
            """Values of the settings that have no keys, and the keys of the others."""
            values, keys = copied.take(one, copying.found_item(bpy.context, one, owner.name, ""))[1:]
            return {name: value for name, value in values.items() if name not in keys}, keys

        for name, owner in found.items():
            with self.subTest(name):
                before = taken(system.registered[name], owner)
                bpy.ops.motus.settings_copy(object=owner.name, system=name)
                bpy.ops.motus.settings_paste(object=owner.name, system=name, with_keys=True, with_shot=True)
                self.assertEqual(taken(system.registered[name], owner), before)

    def test_what_is_not_used_is_only_in_the_short_panel(self):
        for kind in (None, 'MESH', 'ARMATURE', 'CURVE', 'LATTICE'):
            data = {'MESH': bpy.data.meshes, 'ARMATURE': bpy.data.armatures, 'LATTICE': bpy.data.lattices}.get(kind)
            made = data.new("Data") if data else bpy.data.curves.new("Data", 'CURVE') if kind else None
            obj = bpy.data.objects.new("Fresh", made)
            bpy.context.scene.collection.objects.link(obj)
            bpy.context.view_layer.objects.active = obj
            short = drawn(panels.MOTUS_PT_sidebar)
            for panel in system_panels():
                is_used = panel.is_used is not None and panel.suits(obj) and bool(panel.is_used(obj))
                shown = [cls for cls in classes_of(panel) if drawn(cls) is not None]
                with self.subTest(panel.prefix, kind=kind):
                    if panel.is_used is None:
                        self.assertTrue(all('DEFAULT_CLOSED' in cls.bl_options for cls in shown if not hasattr(cls, "bl_parent_id")))
                    else:
                        self.assertEqual(bool(shown), is_used)
                    adding = Layout()
                    if panel.suits(obj) and not is_used:
                        panels.draw_add(panel, adding, bpy.context)
                        self.assertTrue(adding.named("operator"), "nothing adds it")
                    self.assertLessEqual(set(adding.named("operator")), set(short.named("operator")))

    def test_buttons_that_add_keep_their_places(self):
        """Whatever is selected, the same buttons stand in the same order, and some of them work without anything."""

        def buttons():
            layout = drawn(panels.MOTUS_PT_sidebar)
            found = [(of, name) for of, name, _ in layout.drawn if of in {"operator", "menu"}]
            return found[: found.index(("menu", "MOTUS_MT_demo")) + 1]

        bpy.context.view_layer.objects.active = None
        wanted = buttons()
        for name in ("motus.path_new_bezier", "motus.snow_add", "motus.pendulum_add", "motus.stereo_rig_add"):
            self.assertIn(("operator", name), wanted)
        self.assertGreater(len(wanted), 15)
        for one in live_objects():
            bpy.context.view_layer.objects.active = one
            for is_selected in (True, False):
                one.select_set(is_selected)
                with self.subTest(one.name, is_selected=is_selected):
                    self.assertEqual(buttons(), wanted)

    def test_no_two_buttons_that_add_have_the_same_label(self):
        def noted(_layout, name, text="", **_options):
            labels.append(text or _rna(name).name)
            return Properties()

        with mock.patch.object(Layout, "operator", noted):
            for one in (None, *live_objects()):
                labels = []
                bpy.context.view_layer.objects.active = one
                drawn(panels.MOTUS_PT_sidebar)
                with self.subTest(one and one.name):
                    self.assertEqual(sorted(set(labels)), sorted(labels))


class Menus(support.SceneTestCase):
    KINDS = ("add", "object", "pose")

    def setUp(self):
        super().setUp()
        self.menus = support.addon("core.interface.menus")

    def draw(self, kind):
        layout = Layout()
        getattr(self.menus, f"MOTUS_MT_{kind}").draw(types.SimpleNamespace(layout=layout), bpy.context)
        return layout

    def test_grouped_by_system(self):
        for kind in self.KINDS:
            layout = self.draw(kind)
            for one in system.registered.values():
                wanted = [name for name in getattr(one, f"{kind}_menu") if name]
                if not wanted:
                    continue
                with self.subTest(kind, system=one.name):
                    label, _ = panels.title(one)
                    names = [(of, name) for of, name, _ in layout.drawn]
                    first = names.index(("label", label)) + 1
                    self.assertEqual([name for _, name in names[first : first + len(wanted)]], wanted)

    def test_grey_ones_say_why(self):
        """For nothing, for an object of each kind and for each that a system drives: offered, or a sentence."""
        objects = [None, *live_objects()]
        names = {name for kind in self.KINDS for name in self.menus.entries(kind)}
        classes = {cls.bl_idname: cls for cls in operators()}
        refused = 0
        for obj in objects:
            for other in bpy.context.scene.objects:
                other.select_set(other == obj)
            bpy.context.view_layer.objects.active = obj
            for name in sorted(names):
                with self.subTest(name, object=obj and obj.name):
                    refused += not self.poll(classes[name])
        self.assertGreater(refused, len(names))

    def poll(self, cls):
        """Whether a class may run, asked from a menu; a refusal has to have a sentence."""
        said = []

        class Watched(cls):
            poll_message_set = said.append

        context = _Offering(bpy.context, _rna(cls.bl_idname).identifier)
        is_possible = Watched.poll.__func__(Watched, context)
        self.assertTrue(is_possible or (said and said[0].strip()), cls.bl_idname)
        return is_possible

    def test_a_button_that_adds_leaves_a_redo_panel(self):
        """Blender asks a pressed operator once more, though it would refuse what it has made; until buttons are drawn again."""

        class Adding(core.Operator):
            bl_idname = "motus.adding"
            is_there = False

            @classmethod
            def poll_message_set(cls, _sentence):
                pass

            @classmethod
            def check_offer(cls, _context):
                if cls.is_there:
                    raise core.Refused("is there already")

            def run(self, _context):
                type(self).is_there = True

        context, other = _Offering(bpy.context, "MOTUS_OT_adding"), bpy.context
        offering.offer(Layout())
        self.assertTrue(Adding.poll(context))
        self.assertEqual(Adding().execute(context), {'FINISHED'})
        self.assertTrue(Adding.poll(context))
        offering.offer(Layout())
        self.assertFalse(Adding.poll(context))
        Adding().execute(other)  # by a script
        self.assertFalse(Adding.poll(context))

    def test_an_offer_is_for_one_operator_alone(self):
        """An operator that is pressed hands its context on to those that it calls, ours or a user's, and these to others."""
        bpy.context.view_layer.objects.active = None
        bpy.ops.object.select_all(action='DESELECT')
        for cls in operators():
            if cls.bl_idname == "motus.demo_scene":
                continue
            offered = _rna("motus.bake" if cls.bl_idname != "motus.bake" else "motus.unbake")
            with self.subTest(cls.bl_idname), bpy.context.temp_override(**{offering.OFFER: offered}):
                self.assertTrue(getattr(bpy.ops.motus, cls.bl_idname.partition(".")[2]).poll())
        with bpy.context.temp_override(**{offering.OFFER: _rna("motus.bake")}):
            self.assertFalse(bpy.ops.motus.bake.poll(), "the offered operator itself is asked what is selected")

    def test_each_button_has_an_offer_of_its_own(self):
        """What is drawn after an offered button is not offered along with it: a user's entry in our menu, for one."""
        offers = []

        class Noting(Layout):
            def _inner(self, *_arguments, **_options):
                return Noting(self.drawn, self)

            row = column = _inner

            def context_pointer_set(self, name, offered):
                offers.append((self, name, offered.identifier))

        root = Noting()
        column = offering.offer(root).column(align=True)
        column.operator("motus.bake")
        column.operator("motus.unbake")
        self.assertEqual([offer[1:] for offer in offers], [(offering.OFFER, "MOTUS_OT_bake"), (offering.OFFER, "MOTUS_OT_unbake")])
        self.assertEqual(len({id(root), id(column), *(id(layout) for layout, *_ in offers)}), 4)

    def test_scripts_name_what_they_mean(self):
        """Outside of menus nothing that is selected counts."""
        bpy.context.view_layer.objects.active = None
        for cls in operators():
            with self.subTest(cls.bl_idname):
                if cls.bl_idname != "motus.demo_scene":
                    self.assertTrue(getattr(bpy.ops.motus, cls.bl_idname.partition(".")[2]).poll())


def _rna(identifier):
    return getattr(bpy.ops.motus, identifier.partition(".")[2]).get_rna_type()


class _Offering:
    """The context of a button that offers an operator. identifier: of its RNA type."""

    def __init__(self, context, identifier):
        self._context = context
        setattr(self, offering.OFFER, types.SimpleNamespace(identifier=identifier))

    def __getattr__(self, name):
        return getattr(self._context, name)
