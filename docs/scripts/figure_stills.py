"""Writes docs/pictures/figure_NAME.svg, the stills of the manual's figures that move: figure_stills.py NAME...; without a NAME all of them.

Each is what the figure draws first, in a headless Chromium (`./motus build wasm32 motus_web` makes what it computes with), with its style in it.
"""

import re
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / ".ci"), str(ROOT / "docs" / "site")]

import chromium  # noqa: E402
import figure_files  # noqa: E402

WIDTH = 680
PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><script src="figures/figures.js"></script>
<div class="motus-figure" data-figure="{name}" style="width: {width}px"><img alt=""></div>"""
READY = (
    "new Promise((done) => { const look = () => document.documentElement.dataset.motusFigures ? done() : setTimeout(look, 20); look(); })"
)


def style():
    """The rules of figures.css for what is drawn, which stand before those for what is in a page alone."""
    text = (figure_files.SOURCES / "figures.css").read_text(encoding="utf-8")
    return text.partition("/* In a page. */")[0].strip()


def still(browser, folder, name):
    """The picture of a figure as SVG."""
    page = folder / f"{name}.html"
    page.write_text(PAGE.format(name=name, width=WIDTH), encoding="utf-8")
    browser.open(page.as_uri())
    browser.run(READY)
    height, drawing = browser.run(
        "(() => { const one = document.querySelector('svg'); return [one.getAttribute('height'), one.innerHTML]; })()"
    )
    drawing = re.sub(r' (?:tabindex|role|aria-\w+|data-value|style)="[^"]*"', "", drawing)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="motus-figure" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}">'
        f'<style>{style()}</style><rect width="100%" height="100%" rx="8" fill="var(--paper)"/>{drawing}</svg>\n'
    )


def main(names):
    """Writes the stills."""
    names = names or sorted(path.stem for path in figure_files.SOURCES.glob("*.js") if path.stem != "figures")
    with tempfile.TemporaryDirectory() as temporary, chromium.Chromium() as browser:
        folder = Path(temporary)
        figure_files.copy(ROOT / "build" / "wasm32" / "motus.wasm", folder / "figures")
        browser.show(WIDTH + 40)
        for name in names:
            (ROOT / "docs" / "pictures" / f"figure_{name}.svg").write_text(still(browser, folder, name), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
