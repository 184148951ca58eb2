"""Writes docs/pictures/figure_NAME.svg, the stills of the manual's figures that move: `./motus docs figures`, or figure_stills.py MODULE with motus.wasm.

Each is what the figure draws first, in a Chromium without a window, with its style in it.
"""

import re
import shutil
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "docs" / "pictures"
SOURCES = ROOT / "docs" / "site" / "figures"
WIDTH = 680
PAGE = """<!doctype html><html lang="{language}"><meta charset="utf-8"><title>Figures</title><body data-md-color-scheme="{scheme}">
<script src="{figures}/figures.js"></script>
{elements}"""
ELEMENT = '<div class="motus-figure" data-figure="{name}" style="max-width: {width}px"><img alt="A still of {name}" src="data:,"></div>'


def names():
    """The figures that there are."""
    return sorted(path.stem for path in SOURCES.glob("*.js") if path.stem != "figures")


def page(figures, shown, language="en", scheme="default", width=WIDTH):
    """The text of a page that shows some figures, with `figures`, the address of their folder in a site."""
    elements = "\n".join(ELEMENT.format(name=name, width=width) for name in shown)
    return PAGE.format(language=language, scheme=scheme, figures=figures, elements=elements)


def moving(tab, path):
    """Opens a page in a tab of Chromium, and waits until its figures move."""
    tab.goto(path.as_uri())
    tab.wait_for_function("document.documentElement.dataset.motusFigures")


def style():
    """The rules of figures.css for what is drawn, which stand before those for what is in a page alone."""
    text = (SOURCES / "figures.css").read_text(encoding="utf-8")
    return text.partition("/* In a page. */")[0].strip()


def stills(tab, folder, figures):
    """{name: picture as SVG} of all figures, drawn in a page in `folder`."""
    path = folder / "stills.html"
    path.write_text(page(figures, names()), encoding="utf-8")
    tab.set_viewport_size({"width": WIDTH + 200, "height": 900})
    moving(tab, path)
    found = {}
    for name in names():
        element = tab.locator(f'[data-figure="{name}"] svg')
        height, drawing = element.get_attribute("height"), element.inner_html()
        drawing = re.sub(r' (?:tabindex|role|aria-\w+|data-value|style)="[^"]*"', "", drawing)
        found[name] = (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="motus-figure" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}">'
            f'<style>{style()}</style><rect width="100%" height="100%" rx="8" fill="var(--paper)"/>{drawing}</svg>\n'
        )
    return found


def main(module):
    """Writes the stills."""
    from playwright import sync_api

    sys.path.insert(0, str(ROOT / "docs" / "site"))
    import figure_files

    with tempfile.TemporaryDirectory() as temporary, sync_api.sync_playwright() as player:
        folder = Path(temporary)
        figure_files.copy(Path(module), folder / "figures")
        browser = player.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox", "--disable-gpu"])
        for name, text in stills(browser.new_page(), folder, "figures").items():
            (PICTURES / f"figure_{name}.svg").write_text(text, encoding="utf-8")
        browser.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
