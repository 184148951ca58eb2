"""Hand Over in the window: the second Blender works while the window goes on, and Esc ends it."""

import tempfile
from pathlib import Path

import bpy

from hand_over.test_hand_over_refusals import BEFORE, follower
from window import window_support


def start(path):
    """Generator: begins to hand a file over, as the file browser does once a name is chosen."""
    window_support.move(*window_support.centre())
    yield
    with window_support.override():
        bpy.ops.motus.hand_over('INVOKE_DEFAULT', filepath=str(path), start=1, end=20)
    yield


def test_the_window_goes_on_until_the_file_is_there():
    follower()
    with tempfile.TemporaryDirectory(prefix="motus-test-") as folder:
        path = Path(folder, "out.blend")
        yield from start(path)
        assert not path.exists(), "the window was blocked"
        yield from window_support.until(path.exists)
        assert [one.name for one in Path(folder).iterdir()] == ["out.blend"], list(Path(folder).iterdir())


def test_escape_leaves_the_file_that_was_there():
    follower()
    with tempfile.TemporaryDirectory(prefix="motus-test-") as folder:
        path = Path(folder, "out.blend")
        path.write_bytes(BEFORE)
        yield from start(path)
        assert len(list(Path(folder).iterdir())) > 1
        window_support.press('ESC', *window_support.centre())
        yield from window_support.until(lambda: len(list(Path(folder).iterdir())) == 1)
        assert path.read_bytes() == BEFORE
        assert bpy.data.objects["Car"].constraints
