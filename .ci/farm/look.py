"""Run inside a Blender, with a shot open: look.py -- JSON tells what a farm has to know of the shot, and which of its pictures are whole.

JSON: {"output": pattern of the pictures' names, "frames": [numbers]}. The answer is a line that begins with MARK: {"format": what the pictures are
written as, "" for the scene's own format, "has_motus": whether anything in the file needs Motus, "pictures": {frame: paths}, "whole": [frames]}.
"""

import json
import re
import sys
from pathlib import Path

import bpy

MARK = "MOTUS-FARM "
OURS = re.compile(r"\bmotus(_\w+)?\b")
FILMS = {'FFMPEG', 'AVI_JPEG', 'AVI_RAW'}


def datablocks():
    """Everything in the file."""
    for kind in dir(bpy.data):
        collection = getattr(bpy.data, kind)
        if isinstance(collection, bpy.types.bpy_prop_collection):
            yield from (one for one in collection if isinstance(one, bpy.types.ID))


def needs_motus(datablock):
    """Whether a datablock has settings of Motus, or a driver that asks for it."""
    system = getattr(datablock, "bl_system_properties_get", lambda: None)()  # Blender 5 keeps settings of add-ons apart
    animation = getattr(datablock, "animation_data", None)
    drivers = [curve.driver.expression for curve in (animation.drivers if animation else ())]
    return any(OURS.search(text) for text in (*datablock.keys(), *(system or {}).keys(), *drivers))


def pictures(scene, frame):
    """Paths of the pictures of a frame; a scene with several views may have one for each."""
    render = scene.render
    if render.use_multiview and render.image_settings.views_format == 'INDIVIDUAL':
        return [render.frame_path(frame=frame, view=view.name) for view in render.views if view.use]
    return [render.frame_path(frame=frame)]


def is_whole(path):
    """Whether Blender can read a picture to its end."""
    if not Path(path).is_file():
        return False
    image = bpy.data.images.load(path)
    try:
        return len(image.pixels) > 0
    finally:
        bpy.data.images.remove(image)


def main():
    """Prints the answer."""
    given = json.loads(sys.argv[sys.argv.index("--") + 1])
    scene = bpy.context.scene
    settings = scene.render.image_settings
    is_film = settings.file_format in FILMS
    if is_film:
        if hasattr(settings, "media_type"):
            settings.media_type = 'IMAGE'
        settings.file_format = 'PNG'
    scene.render.filepath, scene.render.use_file_extension = given["output"], True
    named = {frame: pictures(scene, frame) for frame in given["frames"]}
    answer = {
        "format": 'PNG' if is_film else "",
        "has_motus": any(map(needs_motus, datablocks())),
        "pictures": named,
        "whole": [frame for frame, paths in named.items() if all(map(is_whole, paths))],
    }
    print(MARK + json.dumps(answer), flush=True)


main()
