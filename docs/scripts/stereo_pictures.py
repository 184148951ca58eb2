"""The picture of the Stereo page: what each warning is about, as an anaglyph with the check's own sentence below."""

import tempfile
import textwrap
from pathlib import Path

import bpy
import numpy as np

import stage
import support

SKY = (0.72, 0.80, 0.90)
TILE = (480, 270)
LAST = 24
WALL = 14.0
COLUMNS, ACROSS, DOWN, WIDE = 3, 3.4, 2.62, 3.2
LINE, SIZE = 38, 0.145
PAPER = (1.0, 1.0, 1.0)
# Depth, place to the right and height of a ball and a pillar, and the rig.
BALL, PILLAR = (4.6, 0.0, 1.5), (6.5, -1.6, 1.5)
TILES = (
    (BALL, PILLAR, {"interocular": 0.065, "distance": 5.0, "screen": 'TELEVISION'}),
    (BALL, PILLAR, {"interocular": 0.12, "distance": 4.0, "screen": 'CINEMA'}),
    ((5.5, 0.0, 1.5), PILLAR, {"interocular": 0.3, "distance": 5.0, "screen": 'MONITOR'}),
    ((2.0, 0.0, 1.5), PILLAR, {"interocular": 0.12, "distance": 5.2, "screen": 'MONITOR'}),
    (BALL, (3.2, -1.62, 1.5), {"interocular": 0.08, "distance": 5.2, "screen": 'TELEVISION'}),
    ((4.6, 1.95, 2.45), PILLAR, {"interocular": 0.23, "distance": 4.6, "screen": 'TELEVISION', "mode": 'TOE'}),
)
WELL = "All is well"


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        tiles = [_render_tile(Path(temporary, f"tile_{index}.png"), *tile) for index, tile in enumerate(TILES)]
        return [_render_sheet(folder / "stereo_warnings.png", tiles)]


def _render_tile(file, ball, pillar, keywords):
    """(file, sentence): both eyes as an anaglyph, and what the check says first."""
    scene = stage.new_scene(SKY, 0.5)
    scene.frame_end = LAST
    stage.add_sun((0.7, -0.35, 0.5), 1.5, softness=4.0)
    stage.add_floor(stage.glossy_material("Floor", (0.50, 0.46, 0.40, 1.0), 0.9))
    for add, (depth, aside, height), color, size in (
        (bpy.ops.mesh.primitive_cylinder_add, pillar, (0.70, 0.62, 0.48, 1.0), (0.22, 0.22, 1.6)),
        (bpy.ops.mesh.primitive_uv_sphere_add, ball, (0.55, 0.30, 0.22, 1.0), (0.07 * ball[0],) * 3),
        (bpy.ops.mesh.primitive_cube_add, (WALL, 0.0, 3.0), (0.40, 0.46, 0.52, 1.0), (20.0, 0.1, 4.0)),
        (bpy.ops.mesh.primitive_cylinder_add, (10.0, 2.2, 2.0), (0.36, 0.46, 0.40, 1.0), (0.3, 0.3, 2.2)),
    ):
        add(location=(aside, depth, height))
        obj = bpy.context.object
        obj.scale = size
        obj.data.materials.append(stage.glossy_material("Body", color, 0.6))
    camera = stage.add_camera(scene, (0.0, 0.0, 1.5), (0.0, 10.0, 1.5), lens=35.0)
    bpy.ops.motus.stereo_rig_add(object=camera.name, **keywords)
    bpy.ops.motus.stereo_output(object=camera.name, format='ANAGLYPH')
    bpy.ops.motus.stereo_check(object=camera.name, frame_start=1, frame_end=LAST)
    sentences = support.addon("stereo.results").of(camera).sentences
    stage.render(scene, file, TILE, samples=24)
    return file, sentences[0] if sentences else WELL


def _render_sheet(file, tiles):
    """All of them on one sheet."""
    scene = stage.new_scene(PAPER)
    high = WIDE * TILE[1] / TILE[0]
    for index, (tile, sentence) in enumerate(tiles):
        left, top = ACROSS * (index % COLUMNS), -DOWN * (index // COLUMNS)
        corners = np.array(((0.0, -high), (WIDE, -high), (WIDE, 0.0), (0.0, 0.0))) + (left, top)
        mesh = bpy.data.meshes.new("Tile")
        mesh.from_pydata([(x, 0.0, z) for x, z in corners], [], [(0, 1, 2, 3)])
        for corner, place in zip(mesh.uv_layers.new().data, ((0, 0), (1, 0), (1, 1), (0, 1))):
            corner.uv = place
        mesh.materials.append(_picture(tile))
        stage.link(bpy.data.objects.new("Tile", mesh))
        for number, line in enumerate(textwrap.wrap(sentence, LINE)):
            stage.add_text(line, (left + 0.5 * WIDE, 0.0, top - high - 0.22 - 1.25 * SIZE * number), SIZE)
    rows = -(-len(tiles) // COLUMNS)
    middle = (0.5 * (ACROSS * (COLUMNS - 1) + WIDE), 0.0, -0.5 * DOWN * rows + 0.04)
    stage.add_camera(scene, (middle[0], -10.0, middle[2]), middle, width=ACROSS * COLUMNS + 0.1)
    return stage.render(scene, file, (1280, round(1280 * DOWN * rows / (ACROSS * COLUMNS))), samples=16)


def _picture(file):
    """A material that shows a file's picture as it is."""
    material = stage.flat_material("Picture", (1.0, 1.0, 1.0, 1.0))
    nodes = material.node_tree.nodes
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = bpy.data.images.load(str(file))
    emission = next(node for node in nodes if node.type == 'EMISSION')
    material.node_tree.links.new(texture.outputs["Color"], emission.inputs["Color"])
    return material
