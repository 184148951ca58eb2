"""What a stranger would type into the search finds the page that answers."""

import contextlib
import functools

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

SPANISH = {
    "inclinar la cámara": ("path",),
    "vagones de tren": ("path",),
    "los pies deslizan": ("walker", "ik"),
    "codo": ("ik",),
    "parpadeo": ("look_at", "drivers"),
    "pelo y cola": ("chains",),
    "nieve en el tejado": ("snow",),
    "pantalla verde": ("chroma",),
    "péndulo doble": ("pendulums",),
    "capa aditiva": ("layers",),
    "granja de render": ("farm", "together"),
    "instalar": ("install", "index"),
}


LANGUAGES = {"en": ("index.html", QUESTIONS), "es": ("es/index.html", SPANISH)}
"""Of each language the first page, and what is asked there."""


@pytest.fixture(scope="module")
def opened(browser):
    """A function that gives a window on the first page of a language, the same one each time."""
    with contextlib.ExitStack() as stack:

        @functools.cache
        def window(language):
            one = stack.enter_context(reader.Window(browser, viewport={"width": 1440, "height": 900}))
            one.open(LANGUAGES[language][0])
            return one

        yield window


@pytest.mark.parametrize(("language", "question"), [(language, one) for language, (_, asked) in LANGUAGES.items() for one in asked])
def test_finds(opened, language, question):
    """The page that answers is among the first results."""
    answers = LANGUAGES[language][1][question]
    assert set(found(opened(language).page, question)) & set(answers)


def found(page, question):
    """Names of the pages that the first results of a search are on."""
    field = page.locator("input.md-search__input")
    field.click()
    # Each key that is let go begins a search; the list is empty again before the next question.
    field.fill("")
    field.press("Backspace")
    page.wait_for_function("!document.querySelector('.md-search-result__item')")
    field.fill(question[:-1])
    field.press(question[-1])
    page.locator("a.md-search-result__link").first.wait_for(timeout=60_000)
    addresses = page.locator(".md-search-result__item > a.md-search-result__link").evaluate_all("all => all.map(one => one.pathname)")
    return [address.split("/")[-1].removesuffix(".html") for address in addresses[:FIRST]]
