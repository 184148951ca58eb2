"""The moving pictures of the demo scenes in the manual: a few seconds of each, which begin again at their end.

docs/make.py runs it inside Blender for `./motus docs moving [NAME...]`; NAME: of a scene, such as flight.
"""

import shutil
import tempfile
import time
from pathlib import Path

import bpy

import demo_film
import demo_plan

WIDTH = 480
SAMPLES = 2  # of EEVEE; a frame takes two to eight seconds of a processor
PER_SECOND = 12
LARGEST = 160_000  # bytes of a film: twelve of them together have less than 2 MB
EASING = 0.8  # of the bit rate, if a film has become too large


def render_all(pictures, names=()):
    """Render the loops of these scenes, or of all, into the folder; yields the files."""
    for demo in demo_plan.SCENES:
        if not names or demo.name in names:
            yield _render(demo, pictures / f"demo_{demo.name}.webm")


def _render(demo, file):
    progress = demo_film.Progress(time.time())
    scene = demo_film.build(demo, progress)
    step = round(scene.render.fps / PER_SECOND)
    with tempfile.TemporaryDirectory() as folder:
        frames = demo_film.render_loop(demo, scene, Path(folder), WIDTH, SAMPLES, step, progress)
        kilobits = 8.0 * LARGEST / 1000.0 * PER_SECOND / len(frames)
        film = Path(folder) / file.name
        _encode(frames, film, kilobits)
        while film.stat().st_size > LARGEST:
            kilobits *= EASING
            _encode(frames, film, kilobits)
        shutil.move(film, file)
    progress.say(f"{file}: {len(frames)} frames, {file.stat().st_size} bytes")
    return file


def _encode(frames, file, kilobits):
    """Write numbered pictures as a film of so many kilobits a second (VP9 in WebM, which all browsers play)."""
    scene = bpy.data.scenes.new("Moving Picture")
    editor = scene.sequence_editor_create()
    strips = editor.strips if hasattr(editor, "strips") else editor.sequences  # before 4.4
    strip = strips.new_image("Frames", str(frames[0]), channel=1, frame_start=1)
    for frame in frames[1:]:
        strip.elements.append(frame.name)
    scene.frame_start, scene.frame_end = 1, len(frames)
    scene.view_settings.view_transform = "Standard"  # the pictures have their look already
    render = scene.render
    render.fps, render.filepath = PER_SECOND, str(file)
    demo_film.set_size(scene, WIDTH)
    demo_film.set_format(scene, "FFMPEG")
    settings = render.ffmpeg
    settings.format, settings.codec, settings.audio_codec = "WEBM", "WEBM", "NONE"
    settings.constant_rate_factor, settings.ffmpeg_preset = "NONE", "BEST"
    settings.video_bitrate = round(kilobits)
    settings.minrate = settings.maxrate = 0  # no limits: with one, the pictures after the first are blurred
    settings.gopsize = len(frames)
    bpy.ops.render.render(animation=True, scene=scene.name)
    bpy.data.scenes.remove(scene)
