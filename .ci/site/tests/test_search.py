"""What a stranger would type into the search finds the page that answers."""

import pytest
import reader

FIRST = 5
"""Results among which the answer has to be."""
QUESTIONS = {
    "bank the camera": ("path",),
    "camera roll in curves": ("path",),
    "constant speed along curve": ("path",),
    "train wagons": ("path",),
    "foot slides": ("walker",),
    "footprints": ("walker", "snow"),
    "gallop": ("walker",),
    "six legs": ("walker",),
    "bake for Unity": ("hand_over", "together"),
    "export to game engine": ("hand_over", "together"),
    "bake keyframes": ("hand_over", "together", "operators"),
    "render farm": ("farm",),
    "elbow flips": ("ik",),
    "pole angle": ("ik",),
    "stretch limb": ("ik",),
    "eyes follow": ("look_at",),
    "blink": ("look_at",),
    "hair physics": ("chains",),
    "tail wobble": ("chains", "dynamics"),
    "jiggle": ("dynamics", "chains"),
    "overshoot": ("dynamics",),
    "double pendulum": ("pendulums",),
    "snowfall": ("snow",),
    "snow on roof": ("snow",),
    "green screen": ("chroma",),
    "3D glasses anaglyph": ("stereo",),
    "VR180": ("stereo",),
    "additive layer": ("layers",),
    "deform with lattice": ("lattice",),
    "sound drives": ("tracks", "drivers"),
    "blink a light": ("drivers",),
    "install": ("install", "start"),
    "uninstall": ("install",),
    "sculpt pin": ("pull",),
}


@pytest.fixture(scope="module")
def window(browser):
    """A window that is open on the first page."""
    with reader.Window(browser, viewport={"width": 1440, "height": 900}) as opened:
        opened.open("index.html")
        yield opened


@pytest.mark.parametrize("question", QUESTIONS)
def test_finds(window, question):
    """The page that answers is among the first results."""
    page = window.page
    field = page.locator("input.md-search__input")
    field.click()
    # Each key that is let go begins a search; the list is empty again before the next question.
    field.fill("")
    field.press("Backspace")
    page.wait_for_function("!document.querySelector('.md-search-result__item')")
    field.fill(question[:-1])
    field.press(question[-1])
    page.locator("a.md-search-result__link").first.wait_for(timeout=60_000)
    found = page.locator(".md-search-result__item > a.md-search-result__link").evaluate_all("all => all.map(one => one.pathname)")
    first = [address.split("/")[-1].removesuffix(".html") for address in found[:FIRST]]
    assert set(QUESTIONS[question]) & set(first), first
