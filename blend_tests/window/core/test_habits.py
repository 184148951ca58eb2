"""What every system shares in the interface, as an artist sees it: menus, the redo panel, what is baked, and a narrow sidebar."""

import types

import bpy
import numpy as np

import live_scenes
import support
from layers import layer_cases
from window import window_support

TOOLTIP = 1.5
"""Seconds after which Blender surely shows the tooltip of what is under the mouse."""
JOINTS = ((0.0, 0.0, 2.0), (0.0, -0.2, 1.0), (0.0, 0.0, 0.0))


def build():
    """A curve and an object that follows it, and a rig with one chain."""
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    data = bpy.data.curves.new("Course", 'CURVE')
    data.dimensions = '3D'
    spline = data.splines.new('POLY')
    spline.points.add(1)
    spline.points[1].co = (4.0, 1.0, 1.0, 1.0)
    glider, course = bpy.data.objects.new("Glider", None), bpy.data.objects.new("Course", data)
    rig = bpy.data.objects.new("Figure", bpy.data.armatures.new("Figure"))
    for obj in (course, glider, rig):
        bpy.context.scene.collection.objects.link(obj)
    choose(rig)
    bpy.ops.object.mode_set(mode='EDIT')
    parent = None
    for name, head, tail in zip(("thigh", "shin"), JOINTS, JOINTS[1:]):
        bone = rig.data.edit_bones.new(name)
        bone.head, bone.tail, bone.parent, bone.use_connect = head, tail, parent, parent is not None
        parent = bone
    rig.data.edit_bones.active = parent
    bpy.ops.object.mode_set(mode='OBJECT')
    return glider, course, rig


def choose(*objects):
    for obj in bpy.context.scene.objects:
        obj.select_set(obj in objects)
    bpy.context.view_layer.objects.active = objects[0] if objects else None


def menu(kind, picture):
    """Generator: opens a menu of Motus, and takes a picture of it."""
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    with window_support.override():
        bpy.ops.wm.call_menu(name=f"MOTUS_MT_{kind}")
    yield
    for step in range(3):
        window_support.move(x - step, y)
        yield
    yield TOOLTIP
    yield from window_support.picture(picture)
    window_support.press('ESC', x, y)
    yield


def test_menus():
    """Grouped by system; what the selection cannot have is grey, and the tooltip says why."""
    glider, _, rig = build()
    for kind in ("add", "object"):
        choose(glider)
        yield from menu(kind, f"menu_{kind}")
    choose(rig)
    bpy.ops.object.mode_set(mode='POSE')
    yield from menu("pose", "menu_pose")
    bpy.ops.object.mode_set(mode='OBJECT')


def redo(picture):
    """Generator: opens the panel Adjust Last Operation under the mouse, and takes a picture of it."""
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    with window_support.override():
        bpy.ops.screen.redo_last('INVOKE_DEFAULT')
    yield
    yield from window_support.picture(picture)
    window_support.press('ESC', x, y)
    yield


def test_redo_panel():
    glider, course, rig = build()
    for name, objects, keywords in (
        ("path_follow_add", (glider, course), {"orientation": 'BANKING'}),
        ("ik_add", (rig,), {"make_pole": True}),
        ("look_at_add", (rig,), {"bone": "shin"}),
        ("grid_add", (), {}),
    ):
        choose(*objects)
        with window_support.override():
            assert getattr(bpy.ops.motus, name)('INVOKE_DEFAULT', True, **keywords) == {'FINISHED'}
        yield
        yield from redo(f"redo_{name}")
        bpy.ops.motus.ik_remove(object=rig.name) if name == "ik_add" else None


def last():
    """The properties of the last operator, which the redo panel shows."""
    return bpy.context.window_manager.operators[-1].properties


def test_redo_panel_shows_the_numbers_that_were_used():
    """By the legs' size, by a preset, by the curve's ends, and by where bobs were placed."""
    glider, course, _ = build()
    course.data.splines[0].use_cyclic_u = True
    with window_support.override():
        bpy.ops.motus.spider_add('INVOKE_DEFAULT', True, size=0.5)
    yield
    spider = bpy.context.object.motus.walker
    for name in ("stride", "clearance", "reach_up", "reach_down"):
        assert abs(getattr(last(), name) - getattr(spider, name)) < 1e-6, (name, getattr(last(), name), getattr(spider, name))
    assert spider.stride < 0.4, spider.stride
    with window_support.override():
        bpy.ops.motus.snow_add('INVOKE_DEFAULT', True, preset='BLIZZARD')
    yield
    assert last().rate == bpy.context.object.motus.snow.rate == 4000.0, last().rate
    choose(glider, course)
    with window_support.override():
        bpy.ops.motus.path_follow_add('INVOKE_DEFAULT', True, duration=3.0)
    yield
    assert (last().extend, last().duration) == (glider.motus.path.extend, 3.0) and last().extend == 'LOOP', last().extend
    # What was found for the last spider is no wish for the next one.
    with window_support.override():
        bpy.ops.motus.spider_add('INVOKE_DEFAULT', True, size=5.0)
    yield
    assert bpy.context.object.motus.walker.stride > 5.0 * spider.stride, bpy.context.object.motus.walker.stride


def shown_and_used(settings, names):
    """{keyword: (what the redo panel shows, what the settings have)} of those that differ."""
    found = {}
    for name in names:
        shown, used = (support.addon("core.interface.operators")._plain(getattr(one, name)) for one in (last(), settings))
        differ = abs(shown - used) > 1e-6 if isinstance(shown, float) else shown != used
        if differ:
            found[name] = shown, used
    return found


def test_every_add_shows_the_values_that_its_settings_have():
    """Found from the rig, the view, the scene's unit, a style or the brush: nothing but what was given differs from the defaults."""
    bpy.context.scene.unit_settings.scale_length = 0.5
    bpy.context.scene.motus.pull.radius = 0.37
    live_scenes.build()
    things = bpy.data.objects
    arm, figure, puppet, braid = (things[name] for name in ("Arm", "Figure", "Puppet", "Braid"))
    bpy.ops.motus.ik_remove(object=arm.name, bone="Bone 1")
    bpy.ops.motus.look_at_remove(object=figure.name, bone="Head")
    bpy.ops.motus.chains_remove(object=braid.name)
    bpy.ops.mesh.primitive_plane_add(size=2.0)
    ground = bpy.context.object
    camera = things.new("Eye", bpy.data.cameras.new("Eye"))
    camera.location = (0.0, -8.0, 1.0)
    camera.rotation_euler.x = 1.57
    bpy.context.scene.collection.objects.link(camera)
    cases = (
        ("ik", "ik_add", (arm,), {"bone": "Bone 1"}, lambda: arm.motus.ik.entries["Bone 1"]),
        ("look_at", "look_at_add", (figure,), {"bone": "Head"}, lambda: figure.motus.look_at.entries["Head"]),
        ("dynamics", "dynamics_add", (ground,), {"style": 'BOUNCY'}, lambda: ground.motus.dynamics.entries[0]),
        ("chains", "chains_add", (braid,), {"bones": "Tail 0 0"}, lambda: braid.motus.chains.entries[0]),
        ("layers", "layer_add", (puppet,), {"action": "Wave"}, lambda: puppet.motus.layers.entries[-1]),
        ("snow.cover", "snow_cover_add", (ground,), {}, lambda: bpy.context.object.motus.snow_cover),
        ("stereo", "stereo_rig_add", (camera,), {}, lambda: camera.motus.stereo),
        ("pull.pins", "pin_add", (ground,), {}, lambda: bpy.context.scene.motus.pull),
    )
    for system, name, objects, keywords, settings in cases:
        choose(*objects)
        with window_support.override():
            assert getattr(bpy.ops.motus, name)('INVOKE_DEFAULT', True, **keywords) == {'FINISHED'}, name
        yield
        where = "operators" if system == "pull.pins" else "properties"
        names = support.addon(f"{system}.{where}").KEYWORDS
        assert not shown_and_used(settings(), names), (name, shown_and_used(settings(), names))
    assert last().radius == bpy.context.scene.motus.pull.radius and abs(last().radius - 0.37) < 1e-6
    bpy.context.scene.unit_settings.scale_length = 1.0


def test_bake_says_what_it_bakes():
    """The dialog names the object and all of its systems, whichever panel the button stands in."""
    _, _, rig = build()
    bpy.ops.motus.ik_add(object=rig.name, bone="shin")
    choose(rig)
    x, y = window_support.centre()
    window_support.move(x, y)
    yield
    with window_support.override():
        bpy.ops.motus.bake('INVOKE_DEFAULT')
    yield
    yield from window_support.picture("bake_dialog")
    window_support.press('ESC', x, y)
    yield
    assert not rig.motus.ik.is_baked


def test_a_panels_bake_button_bakes_all_systems_of_the_armature():
    """It stands in the panel of each system; the pose stays as it was seen, and Unbake gives back what was live."""
    _, _, rig = build()
    layer_cases.turning("Nod", {"thigh": (0.3, 0.0, 0.0)})
    bpy.ops.motus.layer_add(object=rig.name, action="Nod", mask='ALL')
    bpy.ops.motus.ik_add(object=rig.name, bone="shin")
    rig.motus.ik.entries["shin"].target.location.x += 0.3
    choose(rig)
    scene, drawn = bpy.context.scene, []
    scene.frame_start, scene.frame_end = 1, 12
    ui = support.addon("core.interface.ui")
    own = ui.draw_bake

    def noting(layout):
        own(
            types.SimpleNamespace(
                operator=lambda identifier, **_keywords: drawn.append(types.SimpleNamespace(button=identifier)) or drawn[-1]
            )
        )
        own(layout)

    ui.draw_bake = noting
    try:
        yield from window_support.open_tab("Motus")
    finally:
        ui.draw_bake = own
    keywords = {"system": ""}
    assert len(drawn) >= 2 and all(vars(button) == {"button": "motus.bake", **keywords} for button in drawn), drawn

    def pose():
        bpy.context.view_layer.update()
        return np.array([rig.pose.bones[name].matrix for name in ("thigh", "shin")])

    before = pose()
    for step in ("bake", "unbake"):
        with window_support.override():
            assert getattr(bpy.ops.motus, step)('EXEC_DEFAULT', True, **keywords) == {'FINISHED'}
        yield
        assert rig.motus.ik.is_baked == rig.motus.layers.is_baked == (step == "bake"), step
        np.testing.assert_allclose(pose(), before, atol=1e-5, err_msg=step)


def baked_follower():
    glider, course, _ = build()
    bpy.ops.motus.path_follow_add(object=glider.name, curve=course.name)
    choose(glider)
    bpy.ops.motus.bake(object=glider.name, frame_start=1, frame_end=50)
    return glider


def test_baked():
    baked_follower()
    drawn = yield from window_support.open_tab("Motus")
    path = yield from window_support.picture("baked_sidebar")
    assert "MOTUS_PT_path" in drawn and "MOTUS_PT_path_readouts" not in drawn, drawn
    assert path.exists()
    bpy.ops.motus.unbake(object="Glider")
    window_support.draw_all()
    yield
    yield from window_support.until(lambda: "MOTUS_PT_path_readouts" in drawn)
    assert "MOTUS_PT_path_readouts" in drawn, drawn


def drag(start, end):
    """Generator: drags with the left button from one place of the window to another."""
    window, ((x, y), (to_x, to_y)) = window_support.window(), (start, end)
    window_support.move(x, y)
    yield
    window.event_simulate(type='LEFTMOUSE', value='PRESS', x=x, y=y)
    yield
    for share in (0.1, 0.4, 0.7, 1.0):
        window_support.move(round(x + share * (to_x - x)), round(y + share * (to_y - y)))
        yield
    window.event_simulate(type='LEFTMOUSE', value='RELEASE', x=to_x, y=to_y)
    yield


edges = [0, 3, 6, -3, -6]
"""Pixels beside the sidebar's left end where its edge may be taken hold of, not the same in all Blenders; what has worked last is the first."""


def widen(sidebar, by):
    """Generator: drags the sidebar's edge so that it becomes wider by some pixels, or narrower where these are negative."""
    before, x, y = sidebar.width, sidebar.x, sidebar.y + sidebar.height // 2
    for beside in tuple(edges):
        yield from drag((x + beside, y), (x + beside - by, y))
        if sidebar.width != before:
            edges.remove(beside)
            edges.insert(0, beside)
            return


def test_narrow_sidebar():
    """A rig's systems, what an object can be given, and the overlay's switches, in a sidebar that was made narrow."""
    glider, _, rig = build()
    bpy.ops.motus.ik_add(object=rig.name, bone="shin", make_pole=True)
    choose(rig)
    with window_support.drawn_settings([support.addon("core.interface.panels").MOTUS_PT_overlay]) as drawn:
        yield from window_support.open_tab("Motus")
        sidebar = window_support.region('UI')
        before = sidebar.width
        yield from widen(sidebar, -75)
        yield from window_support.picture("narrow_sidebar")
        width = sidebar.width
        choose(glider)
        window_support.draw_all()
        yield from window_support.picture("narrow_sidebar_add")
        yield from widen(sidebar, before - width)
    assert width < before - 40 and abs(sidebar.width - before) < 10, (before, width, sidebar.width)
    wanted = {"show_path", "show_curve", "show_ik", "show_reach", "show_look_at"}
    assert wanted <= drawn["MOTUS_PT_overlay"], drawn


def test_labels_fit_at_the_default_width():
    """Of all systems' rows, in both languages: beside fields where there is room, else within them."""
    rows, widths = support.addon("core.interface.rows"), support.addon("core.interface.view.widths")
    live_scenes.build()
    view, own_draw, noted = bpy.context.preferences.view, rows.Row.draw, {}

    def noting(row, layout, settings):
        if layout.use_property_split and bpy.context.region.type == 'UI' and not row.expand:
            prop = getattr(settings, "properties", settings).bl_rna.properties[row.name]
            label = bpy.app.translations.pgettext_iface(
                prop.name if row.text is None else row.text, row.text_ctxt or prop.translation_context
            )
            noted[view.language, label] = prop.type == 'BOOLEAN'
        own_draw(row, layout, settings)

    rows.Row.draw = noting
    view.use_translate_interface = True
    scale = bpy.context.preferences.system.ui_scale
    try:
        yield from window_support.open_tab("Motus")
        yield from window_support.lower_the_viewport()
        for view.language in ("en_US", "es"):
            for obj in [obj for obj in bpy.context.scene.objects if not obj.name.startswith("Motus")]:
                choose(obj)
                window_support.area().tag_redraw()
                yield
        room = window_support.region('UI').width - widths.MARGINS * scale
    finally:
        rows.Row.draw = own_draw
        view.language = "en_US"
    assert len(noted) > 60, len(noted)
    for (language, label), is_switch in noted.items():
        share = (1.0 - widths.LABELS) * room - widths.BOX * scale if is_switch else widths.LABELS * room - widths.PADDING * scale
        assert window_support.text_width(label) <= share + 2.0, (language, label, window_support.text_width(label), share)
