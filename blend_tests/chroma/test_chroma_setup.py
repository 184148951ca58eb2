"""What setting up a key adds to a scene, what it refuses, and that removing it takes all back."""

import unittest

import bpy
import numpy as np

import support
from chroma import chroma_cases as cases
from chroma.chroma_setup_cases import SetUpTestCase, footage, state

compositor = support.addon("chroma.compositor")
actions = support.addon("core.blender.actions")
settings = support.addon("chroma.settings")
capabilities = support.addon("core.blender.capabilities")
nodes = support.addon("core.blender.node_groups")


class SetUp(SetUpTestCase):
    def test_one_labelled_group(self):
        key = self.set_up(clip=footage(self.folder))
        self.assertEqual((key.label, key.node_tree.name), ("Chroma Key", "Chroma Key"))
        for name in ("Image", "Background", "Screen Color", "Garbage Mask", "Core Mask", "Light Wrap"):
            self.assertIn(name, key.inputs)
        np.testing.assert_allclose(key.inputs["Screen Color"].default_value[:3], cases.GREEN, atol=0.01)
        for one in settings.OF_KEYING:
            self.assertIsNotNone(settings.place(key, one), one.keyword)
        render = bpy.context.scene.render
        self.assertEqual((render.resolution_x, render.resolution_y, render.resolution_percentage), (60, 40, 100))
        self.assertEqual(bpy.context.scene.view_settings.view_transform, 'Standard')

    def test_keywords(self):
        key = self.set_up(
            clip=footage(self.folder),
            color=(0.1, 0.5, 0.2),
            black=0.2,
            white=0.7,
            balance=0.3,
            smooth=2,
            grow=-1,
            feather=3,
            despill=0.5,
            gain=1.5,
            core=0.4,
            despill_limit='AVERAGE',
            luminance=0.25,
            light_wrap=0.25,
            view='MATTE',
        )
        for keyword, wanted in (
            ("gain", 1.5),
            ("core", 0.4),
            ("limit", 0.5),
            ("luminance", 0.25),
            ("black", 0.2),
            ("white", 0.7),
            ("balance", 0.3),
            ("smooth", 2),
            ("grow", -1),
            ("feather", 3),
            ("despill", 0.5),
        ):
            self.assertAlmostEqual(self.value(key, keyword), wanted, 5, keyword)
        self.assertAlmostEqual(key.inputs["Light Wrap"].default_value, 0.25)
        np.testing.assert_allclose(key.inputs["Screen Color"].default_value[:3], (0.1, 0.5, 0.2), atol=1e-6)
        self.assertEqual(bpy.context.scene.motus.chroma.view, 'MATTE')

    def test_views(self):
        key = self.set_up(clip=footage(self.folder))
        chroma = bpy.context.scene.motus.chroma
        self.assertEqual(chroma.view, 'COMPOSITE')
        for view in ('SOURCE', 'MATTE', 'STATUS', 'COMPOSITE'):
            chroma.view = view
            self.assertEqual(chroma.view, view)
        del key.node_tree["motus_chroma"]
        self.assertEqual(chroma.view, 'COMPOSITE')
        chroma.view = 'MATTE'  # there is no key any more: nothing happens

    def test_screen_is_measured(self):
        self.set_up(clip=footage(self.folder))
        chroma = bpy.context.scene.motus.chroma
        self.assertGreater(chroma.share, 0.6)
        self.assertLess(chroma.luminance_spread, 0.02)
        self.assertLess(chroma.spill, 0.01)

    def test_screen_is_measured_again(self):
        key = self.set_up(clip=footage(self.folder), color=(0.1, 0.3, 0.2), black=0.5)
        self.assertEqual(bpy.ops.motus.chroma_key_measure(keep_color=True), {'FINISHED'})
        np.testing.assert_allclose(key.inputs["Screen Color"].default_value[:3], (0.1, 0.3, 0.2), atol=1e-6)
        self.assertLess(self.value(key, "black"), 0.2)
        self.assertEqual(bpy.ops.motus.chroma_key_measure(), {'FINISHED'})
        np.testing.assert_allclose(key.inputs["Screen Color"].default_value[:3], cases.GREEN, atol=0.01)

    def test_named_images_and_clips(self):
        path = footage(self.folder)
        image = bpy.data.images.load(path)
        image.name = "Own"
        self.set_up(clip="Own")
        self.assertEqual(compositor.node_of(bpy.context.scene, "Footage").image, image)
        bpy.ops.motus.chroma_key_remove()
        self.assertIn("Own", bpy.data.images, "what was there before stays")
        bpy.data.movieclips.load(path).name = "Clip"
        self.set_up(clip="Clip")

    def test_what_is_underneath_is_played(self):
        self.set_up(clip=footage(self.folder))
        bpy.context.scene.motus.chroma.underneath = 'FOOTAGE'
        node = compositor.node_of(bpy.context.scene, "Background")
        self.assertTrue(node.use_auto_refresh)
        self.assertGreater(node.frame_duration, 100000)

    def test_the_picture_of_another_viewer_stays(self):
        other = bpy.data.scenes.new("Other")
        tree = compositor.prepared(other, other.motus.chroma)
        tree.nodes.new("CompositorNodeViewer")
        self.set_up(clip=footage(self.folder))
        viewed = [image.name for image in bpy.data.images if image.type == 'COMPOSITING']
        bpy.ops.motus.chroma_key_remove()
        self.assertEqual([image.name for image in bpy.data.images if image.type == 'COMPOSITING'], viewed)

    def test_what_lies_underneath_can_be_changed(self):
        key = self.set_up(clip=footage(self.folder))
        scene = bpy.context.scene
        chroma, before = scene.motus.chroma, state(scene)
        source = key.inputs["Background"].links[0].from_node.name
        self.assertEqual(chroma.underneath, 'RENDER')
        for wanted in ('FOOTAGE', 'NOTHING', 'FOOTAGE', 'RENDER'):
            chroma.underneath = wanted
            self.assertEqual(chroma.underneath, wanted)
            self.assertEqual(compositor.node_of(scene, "Background") is not None, wanted == 'FOOTAGE')
            self.assertEqual(len(key.inputs["Background"].links), int(wanted != 'NOTHING'))
        self.assertEqual(key.inputs["Background"].links[0].from_node.name, source)
        self.assertEqual(state(scene), before)

    def test_a_viewer_shows_what_comes_out(self):
        key = self.set_up(clip=footage(self.folder))
        (viewer,) = (node for node in compositor.tree_of(bpy.context.scene).nodes if node.bl_idname == "CompositorNodeViewer")
        self.assertEqual(viewer.inputs["Image"].links[0].from_node, key)

    def test_a_viewer_of_the_users_shows_it_too(self):
        """A Viewer of what is rendered, such as Blender 4.5 puts into new trees; one of another node shows that as before."""
        scene, tree = bpy.context.scene, self.own_tree()
        rendered, blurred = (tree.nodes.new("CompositorNodeViewer") for _ in range(2))
        source = compositor.outlet(tree).links[0].from_socket
        nodes.link(tree, source, rendered.inputs["Image"])
        nodes.link(tree, source.node.inputs["Image"].links[0].from_socket, blurred.inputs["Image"])
        before = state(scene)
        key = self.set_up(clip=footage(self.folder))
        self.assertEqual(rendered.inputs["Image"].links[0].from_node, key)
        self.assertEqual(blurred.inputs["Image"].links[0].from_node.type, 'R_LAYERS')
        self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})
        self.assertEqual(state(scene), before)

    # --- several keys, and masks ---------------------------------------------------------------------------------------

    def test_a_color_is_added_and_removed(self):
        first = self.set_up(clip=footage(self.folder))
        scene = bpy.context.scene
        tree = compositor.tree_of(scene)
        source = first.inputs["Image"].links[0].from_node
        before = state(scene)
        for color in ((0.05, 0.1, 0.5), (0.02, 0.2, 0.05)):
            self.assertEqual(bpy.ops.motus.chroma_key_add(color=color), {'FINISHED'})
        self.assertEqual(compositor.key_of(scene), first)
        keys = compositor.keys_of(scene)
        self.assertEqual(len(keys), 3)
        self.assertEqual(compositor.active_key(scene), keys[2])
        np.testing.assert_allclose(keys[2].inputs["Screen Color"].default_value[:3], (0.02, 0.2, 0.05), atol=1e-6)
        self.assertEqual([node.inputs["Image"].links[0].from_node for node in keys], [keys[2], source, keys[1]])
        self.assertEqual(compositor.outlet(tree).links[0].from_node, first)
        bpy.ops.motus.chroma_key_choose(index=1)
        self.assertEqual(bpy.ops.motus.chroma_key_drop(), {'FINISHED'})
        self.assertEqual(first.inputs["Image"].links[0].from_node.inputs["Image"].links[0].from_node, source)
        with self.assertRaisesRegex(RuntimeError, "goes with the whole"):
            bpy.ops.motus.chroma_key_drop()
        bpy.ops.motus.chroma_key_choose(index=1)
        bpy.ops.motus.chroma_key_drop()
        self.assertEqual(state(scene), before)
        bpy.ops.motus.chroma_key_add(color=(0.05, 0.1, 0.5))
        bpy.ops.motus.chroma_key_remove()
        self.assertEqual((compositor.keys_of(scene), len(bpy.data.node_groups)), ([], 0))

    def test_masks_are_added_and_removed(self):
        key = self.set_up(clip=footage(self.folder))
        scene = bpy.context.scene
        picture = bpy.data.images.load(footage(self.folder, name="mask.png"))
        before = len(compositor.tree_of(scene).nodes)
        for kind, name in (('GARBAGE', "Garbage Mask"), ('CORE', "Core Mask")):
            self.assertEqual(bpy.ops.motus.chroma_mask_add(kind=kind), {'FINISHED'})
            self.assertEqual(compositor.mask_of(scene, key, name).mask.name, name)
            self.assertEqual(bpy.ops.motus.chroma_mask_add(kind=kind, picture="mask.png"), {'FINISHED'})
            self.assertEqual(compositor.mask_of(scene, key, name).image, picture)
            self.assertEqual(bpy.ops.motus.chroma_mask_remove(kind=kind), {'FINISHED'})
            self.assertIsNone(compositor.mask_of(scene, key, name))
            self.assertEqual(len(compositor.tree_of(scene).nodes), before)
        with self.assertRaisesRegex(RuntimeError, "There is no mask"):
            bpy.ops.motus.chroma_mask_add(mask="Nobody")
        with self.assertRaisesRegex(RuntimeError, "not both"):
            bpy.ops.motus.chroma_mask_add(mask="Garbage Mask", picture="mask.png")

    def test_a_group_that_an_artist_reads(self):
        """Every node stands in a frame with a label, and those that compute say what."""
        key = self.set_up(clip=footage(self.folder))
        for node in key.node_tree.nodes:
            if node.bl_idname == "NodeFrame":
                self.assertTrue(node.label)
            else:
                self.assertIsNotNone(node.parent, node.name)

    # --- groups of older versions ----------------------------------------------------------------------------------------

    def as_older(self, key):
        """Give the key's node a group with Blender's node Keying, as versions before made it."""
        old = bpy.data.node_groups.new("Chroma Key", 'CompositorNodeTree')
        old["motus_chroma"] = True
        sockets = [
            (name, 'INPUT', kind)
            for name, kind in (
                ("Image", "NodeSocketColor"),
                ("Background", "NodeSocketColor"),
                ("Screen Color", "NodeSocketColor"),
                ("Garbage Mask", "NodeSocketFloat"),
                ("Light Wrap", "NodeSocketFloat"),
            )
        ]
        nodes.add_sockets(old, [*sockets, ("Image", 'OUTPUT', "NodeSocketColor"), ("Matte", 'OUTPUT', "NodeSocketFloat")])
        start, end, keying, view = (
            nodes.add_node(old, kind) for kind in ("NodeGroupInput", "NodeGroupOutput", "CompositorNodeKeying", "NodeReroute")
        )
        keying.name, view.name = "Key", 'COMPOSITE'
        nodes.link(old, start.outputs["Image"], keying.inputs["Image"])
        nodes.link(old, start.outputs["Screen Color"], keying.inputs["Key Color"])
        nodes.link(old, keying.outputs["Image"], view.inputs[0])
        nodes.link(old, view.outputs[0], end.inputs["Image"])
        color = tuple(key.inputs["Screen Color"].default_value)
        compositor.exchange(bpy.context.scene, key, old)
        key.inputs["Screen Color"].default_value = color

    def test_an_older_group_goes_on_and_is_upgraded(self):
        key = self.set_up(clip=footage(self.folder))
        tree, scene = compositor.tree_of(bpy.context.scene), bpy.context.scene
        links = sorted((link.from_node.name, link.to_node.name) for link in tree.links)
        self.as_older(key)
        key.inputs["Screen Color"].default_value = (0.07, 0.4, 0.1, 1.0)
        for keyword, wanted in (("despill", 0.5), ("feather", 3), ("grow", -2)):
            settings.assign(key, settings.BY_KEYWORD[keyword], wanted)
            self.assertEqual(self.value(key, keyword), wanted)
        self.assertEqual(bpy.ops.motus.chroma_key_measure(keep_color=True), {'FINISHED'})
        self.assertIn("Key", key.node_tree.nodes, "it goes on as it was")
        self.assertEqual(bpy.ops.motus.chroma_key_refresh(), {'FINISHED'})
        self.assertFalse(any(node.bl_idname == "CompositorNodeKeying" for node in key.node_tree.nodes))
        for keyword, wanted in (("despill", 0.5), ("feather", 3), ("grow", -2)):
            self.assertEqual(self.value(key, keyword), wanted)
        np.testing.assert_allclose(key.inputs["Screen Color"].default_value[:3], (0.07, 0.4, 0.1), atol=1e-6)
        self.assertEqual(sorted((link.from_node.name, link.to_node.name) for link in tree.links), links)
        self.assertEqual(scene.motus.chroma.view, 'COMPOSITE')

    def test_keys_and_drivers_of_an_older_group_go_along(self):
        key = self.set_up(clip=footage(self.folder))
        self.as_older(key)
        holder, name = settings.place(key, settings.BY_KEYWORD["despill"])
        for frame, value in ((1, 0.2), (11, 0.8)):
            setattr(holder, name, value)
            holder.keyframe_insert(name, frame=frame)
        for point in actions.find(holder.id_data, f"{holder.path_from_id()}.{name}").keyframe_points:
            point.interpolation = 'LINEAR'
        holder, name = settings.place(key, settings.BY_KEYWORD["feather"])
        holder.driver_add(name).driver.expression = "4"
        self.assertEqual(bpy.ops.motus.chroma_key_refresh(), {'FINISHED'})
        holder, name = settings.place(key, settings.BY_KEYWORD["despill"])
        curve = actions.find(holder.id_data, f"{holder.path_from_id()}.{name}")
        np.testing.assert_allclose([curve.evaluate(frame) for frame in (1, 6, 11)], (0.2, 0.5, 0.8), atol=1e-6)
        holder, name = settings.place(key, settings.BY_KEYWORD["feather"])
        driver = holder.id_data.animation_data.drivers.find(f"{holder.path_from_id()}.{name}")
        self.assertEqual(driver.driver.expression, "4")

    # --- what is there already ---------------------------------------------------------------------------------------

    def own_tree(self):
        """A compositor of the user's: the render through a blur."""
        scene = bpy.context.scene
        tree = compositor.prepared(scene, scene.motus.chroma)
        scene.motus.property_unset("chroma")
        target = compositor.outlet(tree)
        source = next(link.from_socket for link in tree.links if link.to_socket == target)
        blur = tree.nodes.new("CompositorNodeBlur")
        blur.name = "Own Blur"
        nodes.link(tree, source, blur.inputs["Image"])
        nodes.link(tree, blur.outputs["Image"], target)
        return tree

    def test_nodes_that_are_there_stay(self):
        tree = self.own_tree()
        before = state(bpy.context.scene)
        key = self.set_up(clip=footage(self.folder))
        self.assertEqual(compositor.tree_of(bpy.context.scene), tree)
        self.assertEqual(key.inputs["Background"].links[0].from_node.name, "Own Blur")
        self.assertEqual(compositor.outlet(tree).links[0].from_node, key)
        self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})
        self.assertEqual(state(bpy.context.scene), before)

    def test_all_is_taken_back(self):
        scene = bpy.context.scene
        scene.render.resolution_x, scene.frame_end, scene.render.fps = 1234, 77, 25
        view = scene.view_settings
        view.exposure, view.gamma, view.use_curve_mapping = 0.5, 1.2, True
        scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        scene.collection.objects.link(scene.camera)
        path, behind = footage(self.folder), footage(self.folder, name="behind.png")
        for keywords in ({}, {"background": behind}, {"underneath": 'NOTHING'}, {"use_plane": True}, {"use_scene": False}):
            with self.subTest(**keywords):
                before = state(scene)
                self.set_up(clip=path, **keywords)
                self.assertNotEqual(state(scene), before)
                self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})
                self.assertEqual(state(scene), before)

    @unittest.skipIf(capabilities.has_compositing_group(), "Blender has no nodes that are switched off")
    def test_nodes_that_were_switched_off_stay(self):
        scene = bpy.context.scene
        tree = self.own_tree()
        scene.use_nodes = False
        before = state(scene)
        self.assertIn("Own Blur", str(before))
        path = footage(self.folder)
        for underneath in ('NOTHING', 'RENDER'):
            key = self.set_up(clip=path, underneath=underneath)
            self.assertTrue(scene.use_nodes)
            self.assertEqual(compositor.outlet(tree).links[0].from_node, key)
            self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})
            self.assertEqual(state(scene), before)
        # So does a key that is switched off: there is no second one.
        self.set_up(clip=path)
        scene.use_nodes = False
        self.refused("has a chroma key already", clip=path)
        self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})
        self.assertEqual(state(scene), before)

    def test_a_scene_without_a_camera_is_keyed_twice(self):
        path = footage(self.folder)
        for _ in range(2):
            self.set_up(clip=path, underneath='NOTHING')
            self.assertEqual([node.name for node in compositor.tree_of(bpy.context.scene).nodes if node.type == 'R_LAYERS'], [])
            bpy.ops.motus.chroma_key_remove()

    def test_nodes_that_were_added_since_stay(self):
        self.set_up(clip=footage(self.folder))
        tree = compositor.tree_of(bpy.context.scene)
        tree.nodes.new("CompositorNodeBlur").name = "Later"
        bpy.ops.motus.chroma_key_remove()
        self.assertIn("Later", compositor.tree_of(bpy.context.scene).nodes)

    def test_tree_without_an_output(self):
        tree = self.own_tree()
        tree.nodes.remove(compositor.outlet(tree).node)
        key = self.set_up(clip=footage(self.folder))
        self.assertEqual(compositor.outlet(tree).links[0].from_node, key)
        self.assertEqual(key.inputs["Background"].links[0].from_node.type, 'R_LAYERS')

    def test_saved_and_opened(self):
        self.set_up(clip=footage(self.folder), grow=2, view='STATUS')
        path = self.save()
        bpy.ops.wm.open_mainfile(filepath=path)
        scene = bpy.context.scene
        self.assertEqual(self.value(compositor.key_of(scene), "grow"), 2)
        self.assertEqual(scene.motus.chroma.view, 'STATUS')
        self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})

    def test_a_group_that_somebody_has_taken_apart(self):
        key = self.set_up(clip=footage(self.folder))
        key.node_tree.nodes.clear()
        for one in settings.OF_KEYING:
            settings.assign(key, one, one.default)
        bpy.context.scene.motus.chroma.view = 'MATTE'
        self.assertEqual(bpy.ops.motus.chroma_key_measure(), {'FINISHED'})
        self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})

    # --- the plane ---------------------------------------------------------------------------------------------------

    def test_the_copy_of_a_scene_leaves_the_first_one_its_key(self):
        scene = bpy.context.scene
        scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        self.set_up(clip=footage(self.folder), use_plane=True)
        before, plane = state(scene), scene.motus.chroma.plane
        bpy.context.window.scene = scene.copy()
        self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})
        self.assertIsNone(compositor.key_of(bpy.context.scene))
        bpy.data.scenes.remove(bpy.context.scene)
        self.assertEqual((state(bpy.context.scene), scene.motus.chroma.plane), (before, plane))
        self.assertEqual(bpy.ops.motus.chroma_key_remove(), {'FINISHED'})
        self.assertEqual([obj.type for obj in bpy.data.objects], ['CAMERA'])

    # --- what is refused ---------------------------------------------------------------------------------------------

    def test_missing_files(self):
        self.refused("no clip, no image and no file", clip=str(self.folder / "none.mp4"))
        self.refused("no clip, no image and no file", clip=footage(self.folder), background="none.png")
        self.refused("Name a clip")
        self.refused("Name the clip or image that is laid underneath", clip=footage(self.folder), underneath='FOOTAGE')
        self.refused("There is no mask", clip=footage(self.folder), mask="Nobody")
        self.refused("needs a camera", clip=footage(self.folder), use_plane=True)
        broken = self.folder / "broken.png"
        broken.write_text("no picture", encoding="utf-8")
        self.refused("cannot be read as a picture", clip=str(broken))

    def test_pictures_without_a_screen(self):
        self.refused("no green or blue screen", clip=footage(self.folder, color=(0.4, 0.3, 0.2)))
        self.refused("no green or blue screen", clip=footage(self.folder, color=(0.4, 0.4, 0.4), size=(1, 1), name="one.png"))
        for color, hue in (
            ((0.5, 0.4, 0.1), "yellow"),
            ((0.7, 0.1, 0.8), "magenta"),
            ((0.8, 0.1, 0.7), "magenta"),
            ((0.9, 0.95, 0.9), "grey or white"),
            ((0.0, 0.0, 0.0), "grey or white"),
            ((0.5, 0.1, 0.08), "red"),
        ):
            self.refused(f"A screen is green or blue: this colour is {hue}", clip=footage(self.folder), color=color)

    def test_a_screen_as_green_as_it_is_blue_takes_a_balance(self):
        cyan = (0.05, 0.6, 0.6)
        clip = footage(self.folder, color=cyan)
        for color in ({}, {"color": cyan}):
            self.refused("as green as it is blue, which takes a Balance above 0", clip=clip, **color)
        key = self.set_up(clip=clip, color=cyan, balance=0.5)
        noted = bpy.context.scene.motus.chroma
        self.assertTrue(np.isfinite([noted.share, noted.luminance_spread, noted.chroma_spread, noted.spill]).all())
        self.assertGreater(noted.share, 0.5)
        key.inputs["Balance"].default_value = 0.0
        with self.assertRaisesRegex(RuntimeError, "as green as it is blue"):
            bpy.ops.motus.chroma_key_measure()
        # A key by such a colour makes nothing transparent: the further key is for the same screen.
        with self.assertRaisesRegex(RuntimeError, "as green as it is blue"):
            bpy.ops.motus.chroma_key_add()

    def test_footage_of_one_pixel(self):
        key = self.set_up(clip=footage(self.folder, size=(1, 1)))
        np.testing.assert_allclose(key.inputs["Screen Color"].default_value[:3], cases.GREEN, atol=0.01)

    def test_second_key_setup_is_refused(self):
        self.set_up(clip=footage(self.folder))
        self.refused("has a chroma key already", clip=footage(self.folder))

    def test_nothing_to_remove(self):
        for operator in (bpy.ops.motus.chroma_key_remove, bpy.ops.motus.chroma_key_measure):
            with self.assertRaisesRegex(RuntimeError, "has no chroma key"):
                operator()

    def test_linked_scene(self):
        path = self.save()
        with bpy.data.libraries.load(path, link=True) as (there, wanted):
            wanted.scenes = there.scenes[:1]
        own = bpy.context.window.scene
        bpy.context.window.scene = wanted.scenes[0]
        try:
            self.refused("linked from another file", clip=footage(self.folder))
        finally:
            bpy.context.window.scene = own
