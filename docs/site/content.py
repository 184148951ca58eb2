"""The pages of the site as Markdown: those of the repository, whose links and pictures lead to what the site has, and pages made of its data.

pages(root) gives them by their addresses, anchors(root) the places in them that links and Blender may name. Plain Python, without other packages.
"""

import functools
import json
import posixpath
import re
import struct
from dataclasses import dataclass
from pathlib import Path

import markdown_text
import python_page
import settings_section

LANGUAGES = ("en", "es")
SYSTEMS = (
    "path",
    "layers",
    "ik",
    "limited_chains",
    "look_at",
    "walker",
    "dynamics",
    "chains",
    "tracks",
    "pull",
    "drivers",
    "lattice",
    "snow",
    "pendulums",
    "stereo",
    "chroma",
)
"""Pages of systems, and those that belong to one: docs/NAME.md, and in Spanish docs/es/NAME.md."""
ENGLISH = (
    ("Start here", ("docs/start.md", "docs/install.md", "docs/main_scene.md")),
    ("Systems", tuple(f"docs/{name}.md" for name in SYSTEMS)),
    ("How systems meet", ("docs/together.md", "docs/copying.md", "docs/hand_over.md", "docs/farm.md")),
    ("Scripts", ("docs/operators.md", "docs/python_module.md", "native/bindings/motus_native.pyi")),
    ("C++ library", ("docs/library.md", "docs/cpp/README.md", "docs/cpp/*.md", "docs/contracts.md")),
    (
        "Inside Motus",
        (
            "README.md",
            "CONTRIBUTING.md",
            "docs/architecture.md",
            "docs/systems.md",
            "docs/wiring.md",
            "docs/kept.md",
            "docs/tests.md",
            "docs/packages.md",
            "docs/gotchas.md",
            "docs/glossary.md",
        ),
    ),
    ("Release notes", ("CHANGELOG.md",)),
)
SPANISH = (
    ("Empezar", ("docs/es/start.md", "docs/es/install.md")),
    ("Sistemas", tuple(f"docs/es/{name}.md" for name in SYSTEMS)),
    ("Cómo se combinan", ("docs/es/together.md", "docs/es/copying.md", "docs/es/hand_over.md")),
    ("En inglés", ("docs/operators.md", "docs/python_module.md", "docs/glossary.md", "CHANGELOG.md")),
)
"""Sections of the site, and the files of their pages."""
ARTISTS = {"install", "main_scene", "together", "copying", "hand_over", "farm", "operators"}
"""Names of pages that artists look for beside those of systems."""
ADDRESSES = {
    "docs/start.md": "index.html",
    "docs/es/start.md": "es/index.html",
    "docs/cpp/README.md": "cpp/index.html",
    "native/bindings/motus_native.pyi": "python.html",
    "CHANGELOG.md": "changes.html",
}
"""Of files whose pages are not named after them."""
CARDS = re.compile(r"^(?:\|[^\n]*\n)*\|[^\n]*pictures/demo_[^\n]*\n(?:\|[^\n]*\n)*", re.MULTILINE)
"""A table of pictures of demo scenes."""

KEYWORDS = re.compile(r"^\| keyword \|[^\n]*\n(?:\|[^\n]*\n?)+", re.MULTILINE)
"""A table of an operator's keywords."""
HEADERS = re.compile(r"^\| topic \| header \|[^\n]*\n(?:\|[^\n]*\n?)+", re.MULTILINE)
"""The table of the library's headers."""
LOOKS = {CARDS: "motus-cards", KEYWORDS: "motus-rows", HEADERS: "motus-rows motus-headers"}
"""Tables, and the classes by which the site's style shows them."""


@dataclass
class Source:
    """A file of which a page is made."""

    path: str  # in the repository
    address: str  # in the site
    language: str
    text: str

    @functools.cached_property
    def headings(self):
        """The page's headings, as markdown_text.headings() has them."""
        return markdown_text.headings(self.text)

    @functools.cached_property
    def ids(self):
        """{anchor on a code host: anchor in the site}. That of an operator, class or function is its name, as Blender and Python write it."""
        named = {name: re.fullmatch(r"`([\w.]+)`", heading) for _, heading, name in self.headings}
        return {name: code[1] if code else name for name, code in named.items()}


def sources(root):
    """{path in the repository: Source} of all pages, in the order of the site. Those of Spanish pages that nobody has written are left out."""
    found = {}
    for language, sections in zip(LANGUAGES, (ENGLISH, SPANISH)):
        for path in (path for _, paths in sections for pattern in paths for path in _matching(root, pattern)):
            if path not in found:
                name = "README" if path == "README.md" else Path(path).stem.lower()
                folder = "es/" if language == "es" else "cpp/" if path.startswith("docs/cpp/") else ""
                text = (root / path).read_text(encoding="utf-8")
                text = python_page.page(text) if path.endswith(".pyi") else text
                found[path] = Source(path, ADDRESSES.get(path, f"{folder}{name.lower()}.html"), language, text)
    return found


def _matching(root, pattern):
    """Paths of the repository that fit, in order of their names; one without a star has to be there, but for Spanish ones."""
    if "*" in pattern or pattern.startswith("docs/es/"):
        return sorted(path.relative_to(root).as_posix() for path in root.glob(pattern) if path.name != "README.md")
    return [pattern]


def navigation(root, language):
    """[(title of a section, [(title of a page, its address)])] of one language's site."""
    known = sources(root)
    return [
        (title, [(_label(known[path]), known[path].address) for pattern in paths for path in _matching(root, pattern)])
        for title, paths in (ENGLISH if language == "en" else SPANISH)
    ]


def _label(source):
    return markdown_text.title(source.text).replace("`", "")


def counterpart(root, address):
    """Address of the same page in the other language; None if there is none."""
    addresses = {source.address for source in sources(root).values()}
    other = address.removeprefix("es/") if address.startswith("es/") else f"es/{address}"
    return other if other in addresses else None


def boost(address):
    """How far up search lists a page: those for artists above those for programmers."""
    name = Path(address).stem
    return 2.0 if name in {"index", *SYSTEMS} and not address.startswith("cpp/") else 1.0 if name in ARTISTS else 0.3


def settings(root):
    """What `./motus docs settings` has written: {page: groups of settings}."""
    return json.loads((root / "docs" / "settings.json").read_text(encoding="utf-8"))["systems"]


def pages(root):
    """{address: Markdown} of all pages."""
    known, groups = sources(root), settings(root)
    return {source.address: _page(root, source, known, groups.get(Path(source.path).stem, ())) for source in known.values()}


def anchors(root):
    """All places in pages that a link may name: address#anchor."""
    groups = settings(root)
    found = set()
    for source in sources(root).values():
        names = {*source.ids.values(), *settings_section.anchors(groups.get(Path(source.path).stem, ()))}
        found |= {f"{source.address}#{name}" for name in names}
    return found


def _page(root, source, known, groups):
    """A page's Markdown."""
    text = markdown_text.with_anchors(source.text, source.ids.values())
    for tables, classes in LOOKS.items():
        text = tables.sub(rf'<div class="{classes}" markdown>\n\n\g<0>\n</div>\n', text)
    text = markdown_text.with_links(
        text,
        lambda words, target: _link(source, known, words, target),
        lambda words, target: _picture(root, source, words, target),
    )
    return text + settings_section.section(groups, source.language) if groups else text


def relative(address, other):
    """How a page links another address of the site."""
    return posixpath.relpath(other, posixpath.dirname(address) or ".")


def _target(source, target):
    """Path in the repository of what a page's link names."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(source.path), target)) if target else source.path


def _link(source, known, words, target):
    """A link to another page, or for a file that the site has not the words alone."""
    if re.match(r"[a-z]+:", target):
        return f"[{words}]({target})"
    path, _, anchor = target.partition("#")
    path = _target(source, path)
    if path not in known:
        return words if path in words else f"{words} (`{path}`)"
    other = known[path]
    place = f"#{other.ids.get(anchor, anchor)}" if anchor else ""
    return f"[{words}]({'' if other is source and place else relative(source.address, other.address)}{place})"


def _picture(root, source, words, target):
    """A picture of docs/pictures; with a film of the same name, that film over it; a figure's still in what brings it to life."""
    path = _target(source, target)
    name = Path(path).stem
    shown = relative(source.address, picture_address(path))
    sizes = "".join(f' {side}="{size}"' for side, size in zip(("width", "height"), _size(root / path)))
    still = f'<img src="{shown}" alt="{_attribute(words)}"{sizes} loading="lazy">'
    if name.startswith("figure_"):
        return f'<div class="motus-figure" data-figure="{name.removeprefix("figure_")}">{still}</div>'
    film = Path(path).with_suffix(".webm")
    if (root / film).exists():
        film = relative(source.address, picture_address(film.as_posix()))
        return (
            f'<video class="motus-film" poster="{shown}" aria-label="{_attribute(words)}"{sizes} '
            f'muted loop playsinline preload="none" data-film="{film}"></video>'
        )
    return still


def picture_address(path):
    """Where the site has a picture of docs/pictures: PNG pictures become WebP, which are a tenth as large."""
    return f"pictures/{Path(path).name}".replace(".png", ".webp")


def _size(path):
    """Width and height of a PNG picture, in pixels; nothing for another one, or one that is not there, which a test finds."""
    if not path.exists():
        return ()
    with open(path, "rb") as file:
        head = file.read(24)
    return struct.unpack(">II", head[16:24]) if head[1:4] == b"PNG" else ()


def _attribute(text):
    return text.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;").replace("*", "").replace("`", "")
