"""Run by test_installed_again.py in other Blenders: a scene with all systems, and what there is of it."""

import json
from pathlib import Path

import bpy
import numpy as np

import live_scenes
import support
from chroma import chroma_cases
from saved import saved_cases

FRAMES = (37, 5, 22.25)


def build(folder):
    """All systems in one scene, saved as scene.blend."""
    live_scenes.build()
    picture = np.ones((24, 32, 4)) * (*chroma_cases.GREEN, 1.0)
    footage = bpy.data.images.load(chroma_cases.written(picture, Path(folder, "footage.png")))
    footage.pack()
    bpy.ops.motus.chroma_key_setup(clip=footage.name, black=0.1, white=0.8)
    save(folder)


def save(folder):
    """Save the file in place."""
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(folder, "scene.blend")))


def open_again(folder):
    """As a user opens it."""
    bpy.ops.wm.open_mainfile(filepath=str(Path(folder, "scene.blend")))


def use(folder):
    """What an artist does who has not the add-on: looks, adds something, and saves."""
    open_again(folder)
    for frame in (10, 40, 2):
        bpy.context.scene.frame_set(frame)
    support.link("Artist's Own")
    save(folder)


def write(folder, name):
    """Write what is set and what is seen into a file."""
    support.go_to(FRAMES[0])  # animated settings are those of a frame
    found = {"settings": saved_cases.settings(), "frames": {f"{frame:g}": saved_cases.numbers(frame) for frame in FRAMES}}
    Path(folder, name).write_text(json.dumps(found), encoding="utf-8")
