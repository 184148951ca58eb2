"""The manual's figures that move, in a browser: their numbers are the native module's, keys and the mouse move them, and stills stand where they cannot run."""

import json
import math
import re
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

import chromium
import motus_native as motus

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "site"))
import figure_files  # noqa: E402

MODULE = ROOT / "build" / "wasm32" / "motus.wasm"
NAMES = ("bezier", "births", "budget", "falloff", "gait", "key", "pendulum", "reach", "step")
LARGEST = 400 << 10
"""Bytes of the module, compressed."""


def page(names, language="en", scheme="default", before=""):
    """A page with some figures, as the site has them."""
    elements = "".join(f'<div class="motus-figure" data-figure="{name}"><img alt="A still of {name}" src="data:,"></div>' for name in names)
    return (
        f'<!doctype html><html lang="{language}"><meta charset="utf-8"><title>Figures</title><body data-md-color-scheme="{scheme}">'
        f'<script>{before}</script><script src="figures/figures.js"></script>{elements}'
    )


def random():
    """The same numbers each time."""
    return np.random.default_rng(1)


def ride(points, times, ease_in, ease_out, strength):
    """What bezier_ride writes."""
    curve = motus.Bezier(points)
    timing = motus.Timing.eased(4.0, curve.length(), ease_in, ease_out)
    for time in times:
        (place,), (rotation,) = motus.follow(curve, timing, time, [0.0], "banking", strength=strength)
        w, x, y, z = rotation
        right = (1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y))
        up = (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))
        yield from (*place, *right, *up, timing.distance(time), timing.speed(time))


def keyed_picture():
    """Rows of pixels: an uneven green screen, and something red before it."""
    numbers = random()
    picture = np.ones((12, 16, 4))
    picture[..., :3] = (0.05, 0.4, 0.1) * (1.0 + 0.2 * numbers.random((12, 16, 1)))
    picture[4:9, 5:11, :3] = (0.6, 0.2, 0.1)
    return picture.astype(np.float32).astype(float)


def calls():
    """(function, arguments, what the native module says, relative error): all functions that the figures call.

    With Debian 12's C library all are the same to the bit but angles of the limited chain, which its acos rounds otherwise than WebAssembly's,
    and births, of which the module shows ages in single precision alone.
    """
    numbers = random()
    points = np.array([(-5, -1.6, 0), (-3.4, 3.4, 0), (1.2, -4, 0), (5, 1.8, 0)], float)
    curve, shares, times = motus.Bezier(points), np.linspace(0, 1, 7), np.linspace(0, 4, 6)
    places = np.ravel(curve.position_at_length(shares * curve.length()))
    yield "bezier_length", (points,), [curve.length()], 1e-12
    yield "bezier_places", (points, shares), places, 1e-12
    yield "bezier_ride", (points, times, 4.0, 0.3, 0.2, 1.0), list(ride(points, times, 0.3, 0.2, 1.0)), 1e-12

    for damping in (0.0, 0.35, 1.0, 1.8):
        moments = numbers.uniform(-0.2, 3.0, 6)
        yield "step_response", (moments, 1.5, damping, 0.5), motus.step_response(moments, 1.5, damping, 0.5), 1e-12

        filter_ = motus.SecondOrder(1.5, damping, 0.5)
        yield "step_measures", (1.5, damping, 0.5), (filter_.overshoot, filter_.settling_time()), 1e-12

    moments = np.linspace(0.0, 5.0, 6)
    states = motus.double_pendulum(moments, 2.0, 1.3, mass2=0.7, length2=1.2)
    yield "double_pendulum", (moments, 2.0, 1.3, 0.7, 1.2), np.ravel(states), 1e-12
    # The library's own sines, and no other function that C libraries round differently: chaos has nothing to grow from.
    far = motus.double_pendulum([55.0], 2.0, 1.3, mass2=0.7, length2=1.2)
    yield "double_pendulum", ([55.0], 2.0, 1.3, 0.7, 1.2), np.ravel(far), 1e-12

    for target in numbers.uniform(-1.5, 1.5, (3, 3)) * (1, 1, 0):
        found = motus.solve_two_bone((0, 0, 0), target, 1.0, 0.8, (1, -9, 0), softness=0.1)
        expected = (*found.elbow, *found.tip, found.scale, found.residual, found.reason)
        yield "two_bone", (target, [1, -9, 0], 1.0, 0.8, 0.1, 0.0), expected, 1e-12
        joints = np.array([(0, 0, 0), (1, 0, 0), (1.8, 0, 0)], float)
        limits = np.array([(0, 0, -math.inf, 0, 0, math.inf), (0, 0, 0.3, 0, 0, 1.9)])
        solved = motus.solve_chain(joints, target, limits=limits)
        yield "limited_chain", (joints, target, limits), (*np.ravel(solved.joints), solved.residual, solved.reason), 1e-12

    distances = numbers.uniform(0.0, 1.6, 5)
    for kind, name in enumerate(("classic", "smooth", "sphere", "root", "linear", "sharp", "constant", "gaussian")):
        forces = motus.pull_forces(distances.astype(np.float32), 1.5, name, 2.0)
        yield "pull_forces", (distances, 1.5, kind, 2.0), forces.astype(float), 1e-12

    feet = np.array([(x, y, 0) for x in (-1, 1) for y in (2, 0, -2)], float)
    gaits = ("tripod", "tetrapod", "ripple", "wave", "trot", "pace", "walk", "run", "canter", "gallop", "hop")
    for kind, name in enumerate(gaits):
        phases, duty = motus.walker_gait(name, feet)
        yield "gait_pattern", (feet, kind), (*phases, duty), 1e-12
    yield "natural_stride", (1.4, 0.9), [motus.walker_natural_stride(1.4, 0.9)], 1e-12

    keys, rates = np.array([0.4, 2.0, 3.4, 5.2]), np.array([1.0, 14.0, 3.0, 9.0])
    snow = motus.Snow(rate_times=keys, rate_values=rates, lifetime=100.0)
    moments = np.linspace(0.5, 6.0, 6)
    yield "birth_counts", (keys, rates, moments), [len(snow.evaluate(moment, ["id"])["id"]) for moment in moments], 0.0
    ages = snow.evaluate(6.0, ["age"])["age"]
    yield "birth_times", (keys, rates, 8), 6.0 - ages[:8].astype(float), 1e-6  # ages are in single precision

    near, far = motus.comfortable_parallax(12.0, 15.0)
    yield "comfortable_parallax", (12.0, 15.0), (near, far, motus.divergence_limit(12.0)), 1e-12
    interaxial, convergence = motus.solve_depth_budget(3.0, 14.0, near, far, 50.0, 36.0)
    yield "fit_budget", (3.0, 14.0, near, far, 50.0), (interaxial, convergence), 1e-12
    depths = np.linspace(3.0, 14.0, 4)
    parallax = motus.parallax(depths, interaxial, 50.0, 36.0, convergence)
    seen = motus.seen_distance(parallax, 12.0, 15.0)
    round_ = motus.roundness(depths, interaxial, 50.0, 36.0, convergence, 12.0, 15.0)
    comfort = [0.0 if -near <= one <= far else 1.0 for one in parallax]
    rows = np.ravel(np.transpose((parallax, seen, round_, comfort)))
    yield "seen_depths", (depths[1:3], interaxial, convergence, 50.0, 12.0, 15.0), rows[4:12], 1e-12

    picture = keyed_picture()
    color = motus.screen_color(picture)
    yield "screen_color", (picture, 16), color, 1e-12
    yield "screen_matte", (picture, color, 0.3, 1.1), np.ravel(motus.screen_matte(picture, color, 0.3, 1.1)), 1e-12
    report = motus.screen_report(picture, color, 0.3, 1.1)
    yield "screen_report", (picture, 16, color, 0.3, 1.1), [report[name] for name in ("share", "black", "white")], 1e-12


class Sources(unittest.TestCase):
    def test_each_figure_is_short(self):
        self.assertEqual({path.stem for path in figure_files.SOURCES.glob("*.js")}, {*NAMES, "figures"})
        for name in NAMES:
            lines = (figure_files.SOURCES / f"{name}.js").read_text(encoding="utf-8").splitlines()
            self.assertLess(len(lines), 150, name)

    def test_each_label_is_there_in_both_languages(self):
        for name in NAMES:
            text = (figure_files.SOURCES / f"{name}.js").read_text(encoding="utf-8")
            for label in re.findall(r"label: *(\[[^\]]*\])", text):
                self.assertEqual(len(json.loads(label)), 2, f"{name}: {label}")


@unittest.skipUnless(chromium.PROGRAM, "no Chromium here")
@unittest.skipUnless(MODULE.exists(), "the module for browsers is not built: ./motus build wasm32 motus_web")
class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        figure_files.copy(MODULE, cls.folder / "figures")
        cls.browser = chromium.Chromium()
        cls.addClassCleanup(cls.browser.close)

    def open(self, *names, **options):
        """Opens a page with these figures from disk, and waits until they move."""
        self.browser.problems.clear()
        path = self.folder / "page.html"
        path.write_text(page(names, **options), encoding="utf-8")
        self.browser.open(path.as_uri())
        self.browser.run(
            "new Promise((done) => { const look = () => document.documentElement.dataset.motusFigures ? done() : setTimeout(look, 20); look(); })"
        )

    def told(self):
        """What the page's only figure says."""
        return self.browser.run("document.querySelector('.told').textContent")

    def test_numbers_are_the_native_modules(self):
        self.open("step")
        compared = 0
        for name, arguments, expected, error in calls():
            given = json.dumps([np.ravel(one).tolist() if isinstance(one, (list, np.ndarray)) else one for one in arguments])
            found = self.browser.run(f"Array.from(MotusFigures.figures[0].core.call('{name}', {len(expected)}, ...{given}), String)")
            with self.subTest(name, arguments=given[:200]):
                np.testing.assert_allclose([float(one) for one in found], np.asarray(expected, float), rtol=error, atol=error)
            compared += len(expected)
        self.assertGreaterEqual(compared, 200)

    def test_what_the_library_refuses_is_said(self):
        self.open("step")
        call = "MotusFigures.figures[0].core.call('step_response', 1, [1], {}, 0.5, 0)"
        for _ in range(3):
            with self.assertRaisesRegex(RuntimeError, "frequency"):
                self.browser.run(call.format(-1))
        stack = "MotusFigures.figures[0].core.exports.__stack_pointer.value"
        before = self.browser.run(stack)
        with self.assertRaises(RuntimeError):
            self.browser.run(call.format(-1))
        self.assertEqual(self.browser.run(stack), before)
        self.assertIsInstance(self.browser.run(call.format(1) + "[0]"), float)

    def test_it_is_small(self):
        self.assertLess(len(zlib.compress(MODULE.read_bytes(), 9)), LARGEST)

    def test_all_figures_come_to_life_in_both_languages(self):
        for language in ("en", "es"):
            for width in (390, 1440):
                with self.subTest(language=language, width=width):
                    self.browser.show(width)
                    self.open(*NAMES, language=language)
                    self.assertEqual(self.browser.problems, [])
                    told = self.browser.run("[...document.querySelectorAll('.told')].map((one) => one.textContent)")
                    self.assertEqual(len(told), len(NAMES))
                    for name, text in zip(NAMES, told):
                        self.assertRegex(text, r"\d|objetivo|target", f"{name}: {text}")
                        self.assertNotRegex(text, "NaN|undefined", name)
                    drawn = self.browser.run("document.body.innerHTML")
                    self.assertNotIn("NaN", drawn)
                    self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), width)

    def test_keys_move_a_slider(self):
        self.open("step")
        before = self.told()
        self.browser.run("document.querySelector('input').focus()")
        self.browser.press("ArrowRight")
        self.assertNotEqual(self.told(), before)

    def test_keys_and_the_mouse_move_a_handle(self):
        self.browser.show(820)
        self.open("reach")
        value = "MotusFigures.figures[0].values.target"
        place = "(() => { const box = document.querySelector('.grip').getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; })()"
        before = self.browser.run(value)
        self.browser.run("document.querySelector('.handle').focus()")
        self.browser.press("ArrowLeft")
        after = self.browser.run(value)
        self.assertLess(after[0], before[0])
        self.assertAlmostEqual(after[1], before[1])
        start = self.browser.run(place)
        self.browser.drag(start, (start[0] - 60, start[1] + 40))
        end = self.browser.run(place)
        self.assertAlmostEqual(end[0], start[0] - 60, delta=1.0)
        self.assertAlmostEqual(end[1], start[1] + 40, delta=1.0)

    def test_a_depth_stays_under_the_mouse(self):
        self.open("budget")
        far = "MotusFigures.figures[0].values.far[0]"
        place = "(() => { const box = document.querySelectorAll('.grip')[1].getBoundingClientRect(); return [box.x + 8, box.y + 8]; })()"
        start, before = self.browser.run(place), self.browser.run(far)
        self.browser.drag(start, (start[0] - 40, start[1]))
        self.assertLess(self.browser.run(far), before)
        self.assertAlmostEqual(self.browser.run(place)[0], start[0] - 40, delta=1.0)

    def test_reset_undoes_all(self):
        for name in NAMES:
            with self.subTest(name):
                self.open(name)
                before = self.told(), self.browser.run("document.querySelector('svg').innerHTML")
                self.browser.run(
                    "document.querySelectorAll('input').forEach((one) => { one.value = one.max; one.dispatchEvent(new Event('input')); })"
                )
                self.browser.run("[...document.querySelectorAll('.said button')].at(-1).click()")
                self.assertEqual((self.told(), self.browser.run("document.querySelector('svg').innerHTML")), before)

    def test_without_webassembly_the_still_stays(self):
        path = self.folder / "still.html"
        path.write_text(page(NAMES, before="delete window.WebAssembly"), encoding="utf-8")
        self.browser.problems.clear()
        self.browser.open(path.as_uri())
        self.assertEqual(self.browser.run("document.querySelectorAll('.motus-figure > img').length"), len(NAMES))
        self.assertEqual(self.browser.problems, [])

    def test_words_can_be_read_in_light_and_dark(self):
        """By the contrast of WCAG: 4.5 for words."""
        script = """[...document.querySelectorAll('.motus-figure text, .motus-figure label span, .told, .motus-figure button')].map((one) => {
            const style = getComputedStyle(one), inside = one.ownerSVGElement;
            return [inside ? style.fill : style.color, getComputedStyle(document.querySelector('.moves')).backgroundColor]; })"""

        def light(color):
            parts = [int(one) / 255 for one in re.findall(r"\d+", color)[:3]]
            linear = [one / 12.92 if one <= 0.04045 else ((one + 0.055) / 1.055) ** 2.4 for one in parts]
            return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

        for scheme in ("default", "slate"):
            self.open(*NAMES, scheme=scheme)
            grounds = set()
            for color, ground in self.browser.run(script):
                dark, bright = sorted((light(color), light(ground)))
                self.assertGreater((bright + 0.05) / (dark + 0.05), 4.5, f"{scheme}: {color} on {ground}")
                grounds.add(ground)
            self.assertEqual(len(grounds), 1)


if __name__ == "__main__":
    unittest.main()
