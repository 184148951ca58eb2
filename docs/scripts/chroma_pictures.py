"""The picture of the Chroma Key page: what is filmed, its matte, and what becomes of it, side by side."""

import tempfile
from pathlib import Path

import bpy
import numpy as np

FRAME, TILE, GAP = 44, (480, 270), 8
VIEWS = ('SOURCE', 'MATTE', 'COMPOSITE')
SAMPLES = 8


def render_all(folder):
    """Render every picture into `folder`; returns the files."""
    folder.mkdir(exist_ok=True)
    bpy.ops.motus.demo_scene(system='CHROMA')
    scene = bpy.context.window.scene
    scene.render.engine = next(
        item.identifier for item in scene.render.bl_rna.properties["engine"].enum_items if "EEVEE" in item.identifier
    )
    scene.eevee.taa_render_samples = SAMPLES
    scene.render.resolution_x, scene.render.resolution_y = TILE
    scene.frame_set(FRAME)
    with tempfile.TemporaryDirectory() as temporary:
        tiles = [_render(scene, view, Path(temporary, f"{view}.png")) for view in VIEWS]
    return [_side_by_side(tiles, folder / "chroma_views.png")]


def _render(scene, view, file):
    """(rows, columns, 4) of a view, as it is shown."""
    scene.motus.chroma.view = view
    scene.render.image_settings.file_format, scene.render.image_settings.color_mode = 'PNG', 'RGBA'
    scene.render.filepath = str(file)
    shown = scene.view_settings
    kept = shown.view_transform, shown.look, shown.exposure
    if view == 'MATTE':  # white and black, whatever a film would make of it
        shown.view_transform, shown.look, shown.exposure = 'Standard', 'None', 0.0
    bpy.ops.render.render(write_still=True)
    shown.view_transform, shown.look, shown.exposure = kept
    image = bpy.data.images.load(str(file))
    found = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(found)
    bpy.data.images.remove(image)
    return found.reshape(TILE[1], TILE[0], 4)


def _side_by_side(tiles, file):
    """All of them with white between, in one file."""
    between = np.ones((TILE[1], GAP, 4), np.float32)
    parts = [part for tile in tiles for part in (tile, between)][:-1]
    sheet = np.concatenate(parts, axis=1)
    image = bpy.data.images.new("Views", sheet.shape[1], sheet.shape[0], alpha=False)
    image.pixels.foreach_set(sheet.ravel())
    image.file_format, image.filepath_raw = 'PNG', str(file)
    image.save()
    bpy.data.images.remove(image)
    return file
