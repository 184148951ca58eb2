"""The manual's figures that move: their numbers are the native module's, keys and the mouse move them, and stills stand where they cannot run."""

import base64
import json
import math
import re
import sys

import numpy as np
import pytest
import reader

import motus_native as motus

sys.path.insert(0, str(reader.ROOT / "docs" / "scripts"))
import figure_stills

FIGURES = reader.SITE / "figures"
NAMES = ("bezier", "births", "budget", "falloff", "gait", "key", "pendulum", "reach", "step")
LARGEST = 400 << 10
"""Bytes of the module, compressed."""


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


def source(name):
    """The text of a figure."""
    return (figure_stills.SOURCES / f"{name}.js").read_text(encoding="utf-8")


def test_each_figure_is_short():
    """So is what a reader has to understand of one."""
    assert tuple(figure_stills.names()) == NAMES
    for name in NAMES:
        assert len(source(name).splitlines()) < 150, name


def test_each_label_is_there_in_both_languages():
    """Sentences are, since a figure gives them as pairs too."""
    for name in NAMES:
        for label in re.findall(r"label: *(\[[^\]]*\])", source(name)):
            assert len(json.loads(label)) == 2, f"{name}: {label}"


def test_each_figure_stands_on_a_page_in_both_languages():
    """As a still, which a code host shows."""
    pages = {
        folder: "".join(path.read_text(encoding="utf-8") for path in (reader.ROOT / folder).glob("*.md")) for folder in ("docs", "docs/es")
    }
    for name in NAMES:
        for folder, text in pages.items():
            assert f"pictures/figure_{name}.svg)" in text, (folder, name)


@pytest.fixture
def window(browser):
    """A page of Chromium."""
    if not (FIGURES / "motus.js").exists():
        pytest.skip("the module for browsers could not be built")
    with reader.Window(browser, viewport={"width": 820, "height": 900}) as opened:
        yield opened


def show(window, folder, *names, **options):
    """Opens a page with these figures from disk, and waits until they move; returns it."""
    path = folder / "page.html"
    path.write_text(figure_stills.page(FIGURES.as_uri(), names, width=1400, **options), encoding="utf-8")
    window.complaints.clear()
    figure_stills.moving(window.page, path)
    return window.page


def numbers_of(page, name, count, arguments):
    """What a function of the module gives."""
    given = json.dumps([np.ravel(one).tolist() if isinstance(one, (list, np.ndarray)) else one for one in arguments])
    return [float(one) for one in page.evaluate(f"Array.from(MotusFigures.figures[0].core.call('{name}', {count}, ...{given}), String)")]


def test_numbers_are_the_native_modules(window, tmp_path):
    """Of all functions, more than 200 of them."""
    page = show(window, tmp_path, "step")
    compared = 0
    for name, arguments, expected, error in calls():
        found = numbers_of(page, name, len(expected), arguments)
        np.testing.assert_allclose(found, np.asarray(expected, float), rtol=error, atol=error, err_msg=name)
        compared += len(expected)
    assert compared >= 200


def test_what_the_library_refuses_is_said(window, tmp_path):
    """By the library's sentence; nothing is left of the call."""
    page = show(window, tmp_path, "step")
    stack = "MotusFigures.figures[0].core.exports.__stack_pointer.value"
    before = page.evaluate(stack)
    for _ in range(3):
        with pytest.raises(Exception, match="frequency"):
            numbers_of(page, "step_response", 1, ([1.0], -1.0, 0.5, 0.0))
    assert page.evaluate(stack) == before
    assert numbers_of(page, "step_response", 1, ([1.0], 1.0, 0.5, 0.0)) == [motus.step_response(1.0, 1.0, 0.5, 0.0)]


def test_the_module_is_small(window):
    """As it is sent: packed."""
    text = (FIGURES / "motus.js").read_text(encoding="utf-8")
    assert len(base64.b64decode(text.split('"')[1])) < LARGEST


def test_all_come_to_life_in_both_languages(window, tmp_path):
    """Without a complaint, in windows of three widths."""
    for language in ("en", "es"):
        for width in (390, 820, 1440):
            window.page.set_viewport_size({"width": width, "height": 900})
            page = show(window, tmp_path, *NAMES, language=language)
            assert not window.complaints
            told = page.locator(".told").all_text_contents()
            assert len(told) == len(NAMES)
            for name, text in zip(NAMES, told):
                assert re.search(r"\d|objetivo|target", text), f"{name}: {text}"
                assert not re.search("NaN|undefined", text), f"{name}: {text}"
            assert "NaN" not in page.inner_html("body")
            assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_keys_move_a_slider(window, tmp_path):
    """And what is told changes."""
    page = show(window, tmp_path, "step")
    before = page.text_content(".told")
    page.focus("input")
    page.keyboard.press("ArrowRight")
    assert page.text_content(".told") != before


def middle(page, index=0):
    """Where a handle is."""
    box = page.locator(".grip").nth(index).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page, start, end):
    """By the mouse."""
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(*end)
    page.mouse.up()


def test_keys_and_the_mouse_move_a_handle(window, tmp_path):
    """It stays under the mouse."""
    page = show(window, tmp_path, "reach")
    value = "MotusFigures.figures[0].values.target"
    before = page.evaluate(value)
    page.focus(".handle")
    page.keyboard.press("ArrowLeft")
    after = page.evaluate(value)
    assert after[0] < before[0]
    assert after[1] == pytest.approx(before[1])
    x, y = middle(page)
    drag(page, (x, y), (x - 60, y + 40))
    assert middle(page) == pytest.approx((x - 60, y + 40), abs=1.0)


def test_a_depth_moves_along_its_curve(window, tmp_path):
    """The handle keeps to the curve, whatever the height of the mouse."""
    page = show(window, tmp_path, "budget")
    x, y = middle(page, 1)
    drag(page, (x, y), (x - 40, y + 90))
    assert middle(page, 1)[0] == pytest.approx(x - 40, abs=1.0)
    assert abs(middle(page, 1)[1] - y) < 40


def test_reset_undoes_all(window, tmp_path):
    """To the same drawing."""
    for name in NAMES:
        page = show(window, tmp_path, name)
        before = page.text_content(".told"), page.locator("svg").inner_html()
        page.evaluate(
            "document.querySelectorAll('input').forEach((one) => { one.value = one.max; one.dispatchEvent(new Event('input')); })"
        )
        page.click(".said button")
        assert (page.text_content(".told"), page.locator("svg").inner_html()) == before, name


def test_without_webassembly_the_still_stays(window, tmp_path):
    """And nothing is complained of."""
    window.page.add_init_script("delete window.WebAssembly")
    path = tmp_path / "still.html"
    path.write_text(figure_stills.page(FIGURES.as_uri(), NAMES), encoding="utf-8")
    window.page.goto(path.as_uri())
    assert window.page.locator(".motus-figure > img").count() == len(NAMES)
    assert not window.complaints


def test_stills_are_what_figures_draw(window, tmp_path):
    """`./motus docs figures` makes them again. How a picture in a still is packed is the browser's."""
    packed = re.compile(r"data:image/png;base64,[^\"]*")
    for name, text in figure_stills.stills(window.page, tmp_path, FIGURES.as_uri()).items():
        kept = (figure_stills.PICTURES / f"figure_{name}.svg").read_text(encoding="utf-8")
        assert packed.sub("", kept) == packed.sub("", text), name


def light(color):
    """Relative luminance of a colour that CSS gives as rgb()."""
    parts = [int(one) / 255 for one in re.findall(r"\d+", color)[:3]]
    linear = [one / 12.92 if one <= 0.04045 else ((one + 0.055) / 1.055) ** 2.4 for one in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def test_words_can_be_read_in_light_and_dark(window, tmp_path):
    """By the contrast of WCAG, 4.5 for words; also those in drawings, which axe-core passes over."""
    script = """[...document.querySelectorAll('.motus-figure text, .motus-figure label span, .told, .motus-figure button')].map((one) => {
        const style = getComputedStyle(one), ground = getComputedStyle(document.querySelector('.moves')).backgroundColor;
        return [one.ownerSVGElement ? style.fill : style.color, ground]; })"""
    for scheme in ("default", "slate"):
        page = show(window, tmp_path, *NAMES, scheme=scheme)
        for color, ground in page.evaluate(script):
            dark, bright = sorted((light(color), light(ground)))
            assert (bright + 0.05) / (dark + 0.05) > 4.5, f"{scheme}: {color} on {ground}"
