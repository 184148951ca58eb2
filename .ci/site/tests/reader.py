"""A reader of the site: its pages as files, and a Chromium without a network that opens them from disk."""

import functools
import html.parser
import os
import shutil
from pathlib import Path
from urllib.parse import unquote, urlsplit

ROOT = Path(__file__).resolve().parents[3]
SITE = Path(os.environ.get("MOTUS_SITE", ROOT / "out" / "site"))
LOADED = {("script", "src"), ("img", "src"), ("source", "src"), ("video", "src"), ("video", "poster"), ("link", "href"), ("iframe", "src")}
"""Attributes that name what a browser loads along with a page."""
NOT_LOADED = {"canonical", "alternate", "next", "prev", "edit"}
"""Relations of a link that lead on, and load nothing."""


class Page(html.parser.HTMLParser):
    """A page's anchors, links and what it loads, as they are written."""

    def __init__(self, path):
        super().__init__()
        self.path = path
        self.anchors = set()
        self.links = []
        self.loads = []
        self.without_text = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        """Notes what the tag names."""
        named = dict(attrs)
        self.anchors.update(value for key in ("id", "name") if (value := named.get(key)))
        if tag == "a" and named.get("href"):
            self.links.append(named["href"])
        if tag == "img" and not (named.get("alt") or "").strip():
            self.without_text.append(named.get("src"))
        if not set((named.get("rel") or "").split()) & NOT_LOADED:
            self.loads += [value for key, value in attrs if (tag, key) in LOADED and value]

    def target(self, link):
        """(the file that a link leads to, its anchor), or None for one to another site."""
        parts = urlsplit(link)
        if parts.scheme or parts.netloc:
            return None
        return ((self.path.parent / unquote(parts.path)).resolve() if parts.path else self.path), unquote(parts.fragment)


@functools.cache
def page(path):
    """The page of a file, read once."""
    return Page(path)


def pages():
    """All pages of the site, by their addresses."""
    return {path.relative_to(SITE).as_posix(): page(path.resolve()) for path in sorted(SITE.rglob("*.html")) if path.name != "404.html"}


def chromium():
    """The program of a Chromium, or None."""
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


class Window:
    """A page in Chromium, with what it has complained of; `with` opens and closes it."""

    def __init__(self, browser, **options):
        self._context = browser.new_context(offline=True, **options)
        self.page = self._context.new_page()
        self.complaints = []
        self.asked = []
        self.page.on("console", lambda message: self.complaints.append(message.text) if message.type in {"error", "warning"} else None)
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._context.close()

    def open(self, address):
        """Opens a page of the site."""
        self.complaints.clear()
        self.asked.clear()
        self.page.goto((SITE / address).as_uri(), wait_until="load")
        # what slides or fades is where it comes to rest at once
        self.page.add_style_tag(content="*, ::before, ::after { transition: none !important; animation: none !important }")
        return self.page
