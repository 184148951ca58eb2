"""Builds the manual's site, by Material for MkDocs: build.py MODULE COPIES SITE. `./motus docs site` runs it.

MODULE is what figures compute with, motus.wasm; where it could not be built, their stills stay.
A language is a site of its own, with its own search: English in the folder SITE itself, Spanish in its es/. Both are made from COPIES of the pages.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from PIL import Image

import content
import figure_files
import search_words

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
NAMES = {"en": "English", "es": "Español"}
WIDEST = 1600
"""Most pixels of a picture's width."""


def folder_of(language):
    """Where a language's site is within the whole."""
    return "" if language == "en" else f"{language}/"


def head(address):
    """What MkDocs is told of a page: its counterpart in the other language, how far up search lists it, and by which words it finds it."""
    prefix = "es/" if address.startswith("es/") else ""
    other = content.counterpart(ROOT, address)
    lines = [f"other: {content.relative(prefix + 'index.html', other)}"] if other else []
    lines += [f"search: {{boost: {content.boost(address)}}}", f"tags: {json.dumps(search_words.words(address))}"]
    return "\n".join(("---", *lines, "---", "", ""))


def write_pages(pages, language, folder):
    """Writes the Markdown of a language's pages."""
    shutil.rmtree(folder, ignore_errors=True)
    prefix = folder_of(language)
    for address, text in pages.items():
        if address.startswith("es/") != (language == "es"):
            continue
        path = folder / Path(address.removeprefix(prefix)).with_suffix(".md")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(head(address) + text, encoding="utf-8")


def configuration(language, pages, folder, site):
    """What MkDocs is told of a language beside mkdocs.yml."""
    prefix = folder_of(language)
    other = "es" if language == "en" else "en"

    def entry(address):
        if address.startswith("es/") == (language == "es"):
            return str(Path(address.removeprefix(prefix)).with_suffix(".md"))
        return content.relative(prefix + "index.html", address)

    both = f"{folder_of('es')}index.html" in pages
    return {
        "INHERIT": str(HERE / "mkdocs.yml"),
        "docs_dir": str(folder),
        "site_dir": str(site / prefix),
        "theme": {"language": language, "custom_dir": str(HERE / "theme")},
        "plugins": [{"search": {"lang": language, "pipeline": ["stopWordFilter", "trimmer"]}}, "offline"],
        "extra_javascript": ["motus/films.js", content.relative(f"{prefix}index.html", "figures/figures.js")],
        "extra": {
            "alternate": both,
            "other": {
                "lang": other,
                "name": NAMES[other],
                "first": content.relative(prefix + "index.html", folder_of(other) + "index.html"),
            },
        },
        "nav": [
            {title: [{label: entry(address)} for label, address in found]} for title, found in content.navigation(ROOT, language) if found
        ],
    }


def write_pictures(site):
    """Copies pictures, PNG ones as WebP of at most WIDEST pixels."""
    (site / "pictures").mkdir(parents=True)
    for path in sorted((ROOT / "docs" / "pictures").iterdir()):
        target = site / content.picture_address(path.as_posix())
        if path.suffix != ".png":
            shutil.copy2(path, target)
            continue
        with Image.open(path) as picture:
            if picture.width > WIDEST:
                picture = picture.resize((WIDEST, round(picture.height * WIDEST / picture.width)), Image.Resampling.LANCZOS)
            picture.save(target, quality=76, method=4)


def main(module, work, site):
    """Builds the site anew."""
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    pages = content.pages(ROOT)
    shutil.rmtree(site, ignore_errors=True)
    for language in content.LANGUAGES:
        if f"{folder_of(language)}index.html" not in pages:
            continue
        folder = work / language
        write_pages(pages, language, folder)
        settings = work / f"{language}.json"  # JSON is YAML
        settings.write_text(json.dumps(configuration(language, pages, folder, site), indent=1), encoding="utf-8")
        subprocess.run(
            [sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict", "--config-file", settings], check=True, env=environment
        )
        for name in ("404.html", "sitemap.xml", "sitemap.xml.gz"):  # they name places from the root of a server
            (site / folder_of(language) / name).unlink(missing_ok=True)
    write_pictures(site)
    figure_files.copy(module, site / "figures")
    print(site / "index.html")


if __name__ == "__main__":
    main(*(Path(folder).resolve() for folder in sys.argv[1:]))
