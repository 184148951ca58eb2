"""The pictures of the Pick & Pull page, made through the add-on's own operators."""

import math

import bpy
import numpy as np
from mathutils import Vector

import stage

CLAY = (0.60, 0.22, 0.10, 1.0)
STEEL, RED = (0.75, 0.75, 0.78, 1.0), (0.72, 0.03, 0.03, 1.0)
PAPER = (0.90, 0.92, 0.94)

# Falloff, its name, and keywords besides.
FALLOFFS = (
    ('SMOOTH', "Smooth", {}),
    ('SPHERE', "Sphere", {}),
    ('ROOT', "Root", {}),
    ('LINEAR', "Linear", {}),
    ('SHARP', "Sharp", {}),
    ('CONSTANT', "Constant", {}),
    ('GAUSSIAN', "Gaussian", {}),
    ('CLASSIC', "Classic, k = 0", {}),
    (
        'CURVE',
        "Curve",
        {"curve": [(0.62 + 0.38 * math.cos(3.0 * math.pi * (1.0 - t))) * min(1.0, 4.0 * t) for t in np.linspace(0.0, 1.0, 32)]},
    ),
)
CELL = Vector((2.75, 1.82))
HEIGHT = 0.9

DISTANCES = (('STRAIGHT', "straight", 0.62), ('SURFACE', "surface", 0.62), ('EDGES', "edges", 14.0))
SHEET_DEPTH, SHEET_LENGTH, FOLD = 0.9, 0.75, 0.15  # of the sheet that is folded; half the distance of its layers
SHEET_ROOT, SHEET_LIFT = (0.42, 0.0, FOLD), 0.62
SHEET_SPACING = 2.3

# Name, place on Suzanne, way, radius, mirrored.
PINS = (
    ("Nose", (0.0, -0.83, -0.21), (0.0, -0.55, 0.12), 0.34, False),
    ("Ears", (1.30, 0.30, 0.30), (0.30, -0.05, 0.34), 0.80, True),
    ("Brows", (0.34, -0.76, 0.66), (0.0, -0.03, 0.36), 0.46, True),
    ("Chin", (0.0, -0.70, -0.94), (0.0, -0.16, -0.34), 0.55, False),
)
STRENGTHS = (0.0, 0.5, 1.0, -0.5)
HEAD_SPACING = 3.2


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    return [
        _render_falloffs(folder / "pull_falloffs.png"),
        _render_distances(folder / "pull_distances.png"),
        _render_pins(folder / "pull_pins.png"),
        _render_welded(folder / "pull_welded.png"),
    ]


# --- welding ---------------------------------------------------------------------------------------------------------


def _render_welded(file):
    """A ball of loose triangles, pulled along its surface without and with a weld distance."""
    scene = _new_scene()
    clay = stage.glossy_material("Clay", CLAY, 0.6)
    for column, (weld, name) in enumerate(((0.0, "weld distance 0"), (0.001, "1 mm"))):
        ball = _loose_ball()
        ball.data.materials.append(clay)
        ball.location.x = (column - 0.5) * 3.0
        bpy.context.view_layer.update()
        bpy.ops.motus.pick_pull(
            object=ball.name,
            location=(0.35, -0.65, 0.68),
            displacement=(0.25, -0.45, 0.5),
            radius=1.0,
            unit='LOCAL',
            falloff='SMOOTH',
            distance='SURFACE',
            mirror=set(),
            weld=weld,
        )
        stage.add_text(name, ball.location + Vector((0.0, -0.4, -1.22)), 0.22)
    stage.add_camera(scene, (0.0, -9.0, 2.2), (0.0, 0.0, 0.0), width=6.4)
    return stage.render(scene, file, (1280, 560), samples=64)


def _loose_ball():
    """A ball whose triangles have corners of their own, as in a file of a scanner."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4, location=(0.0, 0.0, 0.0))
    whole = bpy.context.object
    places = [whole.data.vertices[index].co[:] for polygon in whole.data.polygons for index in polygon.vertices]
    faces = [tuple(range(3 * number, 3 * number + 3)) for number in range(len(whole.data.polygons))]
    loose = bpy.data.meshes.new("Scan")
    loose.from_pydata(places, [], faces)
    whole.data = loose
    return whole


# --- falloffs --------------------------------------------------------------------------------------------------------


def _render_falloffs(file):
    """What each falloff makes of a flat grid, cut open at the root."""
    scene = _new_scene()
    clay, line = stage.glossy_material("Clay", CLAY, 0.6), stage.flat_material("Cut", RED)
    for index, (falloff, name, more) in enumerate(FALLOFFS):
        row, column = divmod(index, 3)
        place = Vector(((column - 1) * CELL.x, 0.0, (1 - row) * CELL.y))
        grid = _half_grid(place, clay)
        bpy.ops.motus.pick_pull(
            object=grid.name,
            location=(0.0, 0.0, 0.0),
            displacement=(0.0, 0.0, HEIGHT),
            radius=1.0,
            unit='LOCAL',
            falloff=falloff,
            distance='STRAIGHT',
            mirror=set(),
            scale_factor=0.0,
            **more,
        )
        edge = sorted(tuple(vertex.co) for vertex in grid.data.vertices if vertex.co.y < 1e-6)
        stage.add_tube([place + Vector(point) + Vector((0.0, -0.01, 0.0)) for point in edge], 0.016, line)
        stage.add_text(name, place + Vector((0.0, -0.4, -0.33)), 0.22)
    stage.add_camera(scene, (0.0, -11.0, 3.30), (0.0, 0.0, 0.32), width=3.0 * CELL.x + 0.25)
    return stage.render(scene, file, (1280, 820), samples=64)


def _half_grid(place, material):
    """The half of a flat grid that lies behind its middle."""
    bpy.ops.motus.grid_add(width=121, height=61, sizing='SIZE', size=(2.4, 1.2), location=(0.0, 0.0, 0.0))
    grid = bpy.context.object
    for vertex in grid.data.vertices:
        vertex.co.y += 0.6
    grid.data.materials.append(material)
    grid.location = place
    bpy.context.view_layer.update()
    return grid


# --- distances -------------------------------------------------------------------------------------------------------


def _render_distances(file):
    """A folded sheet, cut open where it is pulled up at its upper layer by each kind of distance."""
    scene = _new_scene()
    line = stage.flat_material("Cut", (0.03, 0.05, 0.08, 1.0))
    for index, (distance, name, radius) in enumerate(DISTANCES):
        sheet = _folded_sheet()
        sheet.location.x = (index - 1) * SHEET_SPACING
        bpy.context.view_layer.update()
        before = _places(sheet)
        bpy.ops.motus.pick_pull(
            object=sheet.name,
            location=SHEET_ROOT,
            displacement=(0.0, 0.0, SHEET_LIFT),
            radius=radius,
            unit='LOCAL',
            falloff='SMOOTH',
            distance=distance,
            mirror=set(),
        )
        after = _places(sheet)
        moved = np.linalg.norm(after - before, axis=1) / SHEET_LIFT
        sheet.data.attributes.new("moved", 'FLOAT', 'POINT').data.foreach_set("value", moved.astype(np.float32))
        sheet.data.materials.append(_moved_material())
        cut = [sheet.location + Vector(place) for place in after[before[:, 1] == 0.0].tolist()]
        stage.add_tube([place + Vector((0.0, -0.01, 0.0)) for place in cut], 0.014, line)
        stage.add_text(name, sheet.location + Vector((0.0, -0.4, -0.52)), 0.22)
    stage.add_camera(scene, (0.0, -9.0, 3.0), (0.0, 0.0, 0.17), width=3.0 * SHEET_SPACING + 0.1)
    return stage.render(scene, file, (1280, 330), samples=64)


def _folded_sheet():
    """A sheet that is folded once about an axis along Y: the upper layer lies over the lower one."""
    turn = np.linspace(-0.5 * math.pi, 0.5 * math.pi, 16)
    flat = np.linspace(-SHEET_LENGTH, SHEET_LENGTH, 37)[:-1]
    x = np.concatenate((flat, SHEET_LENGTH + FOLD * np.cos(turn), flat[::-1]))
    z = np.concatenate((np.full(len(flat), -FOLD), FOLD * np.sin(turn), np.full(len(flat), FOLD)))
    y = np.linspace(0.0, SHEET_DEPTH, 25)
    places = np.stack(np.broadcast_arrays(x[:, None], y[None, :], z[:, None]), axis=-1).reshape(-1, 3)
    rows, columns = len(x), len(y)
    first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)[None, :]).reshape(-1)
    faces = np.stack((first, first + columns, first + columns + 1, first + 1), axis=1)
    mesh = bpy.data.meshes.new("Sheet")
    mesh.from_pydata(places.tolist(), [], faces.tolist())
    mesh.polygons.foreach_set("use_smooth", np.ones(len(faces), bool))
    mesh.update()
    return stage.link(bpy.data.objects.new("Sheet", mesh))


def _places(obj):
    found = np.empty(3 * len(obj.data.vertices), np.float32)
    obj.data.vertices.foreach_get("co", found)
    return found.reshape(-1, 3)


def _moved_material():
    """Grey where nothing has moved, red at the root."""
    material = stage.glossy_material("Moved", (0.5, 0.5, 0.5, 1.0), 0.6)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    attribute = nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = "moved"
    ramp = nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].color = (0.36, 0.42, 0.48, 1.0)
    ramp.color_ramp.elements[1].color = (0.80, 0.10, 0.03, 1.0)
    ramp.color_ramp.elements.new(0.02).color = (0.72, 0.55, 0.28, 1.0)
    links.new(attribute.outputs["Fac"], ramp.inputs[0])
    links.new(ramp.outputs[0], nodes["Principled BSDF"].inputs["Base Color"])
    return material


# --- pins ------------------------------------------------------------------------------------------------------------


def _render_pins(file):
    """Suzanne with four pins at several strengths."""
    scene = _new_scene()
    clay = stage.glossy_material("Clay", CLAY, 0.55)
    for index, strength in enumerate(STRENGTHS):
        head = _head(clay)
        head.location.x = (index - 0.5 * (len(STRENGTHS) - 1)) * HEAD_SPACING
        head.rotation_euler.z = math.radians(24.0)
        bpy.context.view_layer.update()
        for name, place, way, radius, is_mirrored in PINS:
            bpy.ops.motus.pin_add(
                object=head.name,
                name=name,
                location=place,
                displacement=way,
                radius=radius,
                unit='LOCAL',
                falloff='SMOOTH',
                distance='SURFACE',
                strength=strength,
                mirror={'X'} if is_mirrored else set(),
            )
        bpy.context.view_layer.update()
        seen = head.evaluated_get(bpy.context.evaluated_depsgraph_get())
        for pin in head.motus.pull.pins:
            vertex = seen.data.vertices[pin.vertex]
            _add_pin(seen.matrix_world @ vertex.co, seen.matrix_world.to_3x3() @ vertex.normal)
        stage.add_text(f"strength {strength:g}", head.location + Vector((0.0, -1.2, -1.85)), 0.30)
    stage.add_camera(scene, (0.0, -16.0, 2.0), (0.0, 0.0, -0.12), width=len(STRENGTHS) * HEAD_SPACING + 0.3)
    return stage.render(scene, file, (1280, 420), samples=64)


def _head(material):
    bpy.ops.mesh.primitive_monkey_add()
    head = bpy.context.object
    modifier = head.modifiers.new("Subdivision", 'SUBSURF')
    modifier.levels = 2
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    bpy.ops.object.shade_smooth()
    head.data.materials.append(material)
    return head


def _add_pin(root, normal):
    """A needle with a red ball, stuck into a root."""
    needle = stage.add_tube([root, root + 0.30 * normal], 0.014, _kept("Needle", STEEL, 0.2))
    needle.name = "Needle"
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.075, location=root + 0.33 * normal)
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    ball.data.materials.append(_kept("Ball", RED, 0.25))


def _kept(name, color, roughness):
    return bpy.data.materials.get(name) or stage.glossy_material(name, color, roughness)


def _new_scene():
    scene = stage.new_scene(PAPER, 0.82)
    stage.add_sun((math.radians(50), math.radians(-18), math.radians(-28)), 2.0, softness=12.0)
    return scene
