"""The pictures of the demo scenes: each has a still and a moving picture, and none of them is large."""

import struct
import sys
import unittest
from pathlib import Path

CLONE = Path(__file__).resolve().parents[2]
PICTURES = CLONE / "docs" / "pictures"
sys.path.insert(0, str(CLONE / "docs" / "scripts"))

import demo_plan  # noqa: E402  (found by the line above)

SIZE, STILL = (480, 270), (960, 540)  # pixels
LARGEST, ALL = 250_000, 2_000_000  # bytes of one moving picture, and of all
LARGEST_STILL = 1_000_000
INSIDE = {0x18538067: "Segment", 0x1549A966: "Info", 0x1654AE6B: "Tracks", 0xAE: "TrackEntry", 0xE0: "Video"}
"""Elements of WebM that have the wanted ones in them."""
WANTED = {0x2AD7B1: "nanoseconds", 0x4489: "duration", 0x86: "codec", 0xB0: "width", 0xBA: "height"}


def number(data, start, is_size):
    """Read a WebM number of one to eight bytes, whose leading zero bits say how many; returns it and where it ends."""
    length = 9 - data[start].bit_length()
    value = int.from_bytes(data[start : start + length], "big")
    return value & (1 << 7 * length) - 1 if is_size else value, start + length


def webm(data):
    """The wanted elements of a WebM file, as {name: bytes}. Each element is its number, its size and its content."""
    found, at = {}, 0
    while at < len(data):
        kind, at = number(data, at, is_size=False)
        size, at = number(data, at, is_size=True)
        if kind in WANTED:
            found[WANTED[kind]] = data[at : at + size]
        at += 0 if kind in INSIDE else size
    return found


class Pictures(unittest.TestCase):
    def test_each_scene_has_a_still(self):
        for scene in demo_plan.SCENES:
            with self.subTest(scene=scene.name):
                data = (PICTURES / f"demo_{scene.name}.png").read_bytes()
                self.assertEqual(struct.unpack(">II", data[16:24]), STILL)
                self.assertLess(len(data), LARGEST_STILL)

    def test_each_scene_has_a_moving_picture_of_its_loop(self):
        for scene in demo_plan.SCENES:
            with self.subTest(scene=scene.name):
                data = (PICTURES / f"demo_{scene.name}.webm").read_bytes()
                film = webm(data)
                self.assertEqual(film["codec"], b"V_VP9")
                self.assertEqual(tuple(int.from_bytes(film[name], "big") for name in ("width", "height")), SIZE)
                seconds = struct.unpack(">d", film["duration"])[0] * int.from_bytes(film["nanoseconds"], "big") / 1e9
                start, end = scene.loop
                self.assertAlmostEqual(seconds, end - start, delta=0.1)
                self.assertLess(len(data), LARGEST)

    def test_all_together_are_small_enough_for_one_page(self):
        self.assertLess(sum(path.stat().st_size for path in PICTURES.glob("demo_*.webm")), ALL)

    def test_no_moving_picture_is_left_of_a_scene_that_is_gone(self):
        names = {f"demo_{scene.name}" for scene in demo_plan.SCENES}
        self.assertEqual({path.stem for path in PICTURES.glob("demo_*.webm")} - names, set())


if __name__ == "__main__":
    unittest.main()
