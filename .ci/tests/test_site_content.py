"""The pages of the manual's site, and those of the add-on's zip: all are there, and links and Blender's right-click menu lead to places in them."""

import html.parser
import json
import posixpath
import re
import sys
import unittest
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "docs" / "site"))

import content  # noqa: E402  (found by the line above)
import markdown_text  # noqa: E402
import plain  # noqa: E402
import python_page  # noqa: E402

MOST = 250_000
"""Bytes that the zip's pages may take, compressed."""
STUB = '''
"""What the module is."""
import typing
def ease(u: numpy.typing.ArrayLike, ease_in: float = 0.0) -> typing.Any:
    """Ease at u.

    u: a number or (m,).  Raises ValueError if `u` is not finite; |x_i| < 1.
    """
class Curve:
    """A curve."""
    def __init__(self, points: numpy.typing.NDArray[numpy.float64], names: tuple[str, str]) -> None:
        ...
    def _hidden(self) -> int:
        """Nobody's business."""
    @property
    def length(self) -> float:
        """Its length."""
'''


class Places(html.parser.HTMLParser):
    """What a page names: `ids`, `links` and the `tags` that it has."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.tags = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.tags.add(tag)
        if "id" in given:
            self.ids.append(given["id"])
        if tag == "a" and "href" in given:
            self.links.append(given["href"])


def leads(address, link):
    """Address and anchor of what a page's link names."""
    path, _, anchor = link.partition("#")
    return posixpath.normpath(posixpath.join(posixpath.dirname(address), path)) if path else address, anchor


def wanted():
    """{page: places that Blender's menu may open in it}."""
    settings = json.loads((ROOT / "docs" / "settings.json").read_text(encoding="utf-8"))["systems"]
    return {
        page: {f"{group['struct']}.{setting['id']}".lower() for group in groups for setting in group["settings"]}
        for page, groups in settings.items()
    }


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pages, cls.anchors = content.pages(ROOT), content.anchors(ROOT)

    def test_every_page_of_the_repository_is_in_the_navigation_once(self):
        files = [
            *ROOT.glob("*.md"),
            *(ROOT / "docs").glob("*.md"),
            *(ROOT / "docs" / "cpp").glob("*.md"),
            *(ROOT / "docs" / "es").glob("*.md"),
        ]
        self.assertEqual({path.relative_to(ROOT).as_posix() for path in files} - content.sources(ROOT).keys(), set())
        shown = [address for _, found in content.navigation(ROOT, "en") for _, address in found]
        self.assertEqual(sorted(shown), sorted(address for address in self.pages if not address.startswith("es/")))

    def test_links_lead_to_places_of_the_site(self):
        for address, text in self.pages.items():
            links = []
            markdown_text.with_links(text, lambda words, target, links=links: links.append(target) or words, lambda words, _: words)
            for link in links:
                if "://" in link:
                    continue
                page, anchor = leads(address, link)
                with self.subTest(page=address, link=link):
                    self.assertTrue(page in self.pages)
                    if anchor:
                        self.assertTrue(f"{page}#{anchor}" in self.anchors)

    def test_pictures_are_there(self):
        seen = 0
        for address, text in self.pages.items():
            for name in re.findall(r'(?:src|poster)="([^"]+)"', text):
                page, _ = leads(address, name)
                seen += 1
                with self.subTest(page=address, name=name):
                    files = [ROOT / "docs" / page, (ROOT / "docs" / page).with_suffix(".png")]
                    self.assertTrue(any(file.exists() for file in files))
        self.assertGreater(seen, 50)

    def test_anchors_are_unlike_each_other(self):
        for address, text in self.pages.items():
            names = re.findall(r'\{#([^}\s]+)\}$|<a id="([^"]+)">', text, re.MULTILINE)
            names = [one or two for one, two in names]
            with self.subTest(address):
                self.assertEqual(len(names), len(set(names)))
                self.assertEqual({f"{address}#{name}" for name in names}, {one for one in self.anchors if one.startswith(f"{address}#")})

    def test_operators_and_settings_have_their_places(self):
        operators = re.findall(r"^## `(motus\.\w+)`", (ROOT / "docs" / "operators.md").read_text(encoding="utf-8"), re.MULTILINE)
        self.assertGreater(len(operators), 100)
        self.assertEqual({f"operators.html#{name}" for name in operators} - self.anchors, set())
        for page, names in wanted().items():
            self.assertEqual({f"{page}.html#{name}" for name in names} - self.anchors, set())
            if (ROOT / "docs" / "es" / f"{page}.md").exists():
                self.assertEqual({f"es/{page}.html#{name}" for name in names} - self.anchors, set())

    def test_settings_speak_the_pages_language(self):
        self.assertRegex(self.pages["path.html"], r"\*\*Duration\*\*<br>`duration` \| Time for the whole path \|")
        if "es/path.html" in self.pages:
            self.assertRegex(self.pages["es/path.html"], r"\*\*Duración\*\*<br>`duration` \| Tiempo para la trayectoria entera \|")
            self.assertEqual(content.counterpart(ROOT, "path.html"), "es/path.html")
            self.assertEqual(content.counterpart(ROOT, "es/path.html"), "path.html")
        self.assertIsNone(content.counterpart(ROOT, "gotchas.html"))


class Text(unittest.TestCase):
    def test_code_is_left_as_it_is(self):
        text = "# Title\n\n`[a](b.md)` [c](d.md)\n\n```python\n# no heading\n[e](f.md)\n```\n## Title\n"
        self.assertEqual(markdown_text.headings(text), [(1, "Title", "title"), (2, "Title", "title-1")])
        named = markdown_text.with_anchors(text, ("one", "two"))
        self.assertIn("# Title {#one}\n", named)
        self.assertIn("\n# no heading\n", named)
        self.assertTrue(named.endswith("## Title {#two}\n"))
        linked = markdown_text.with_links(text, lambda words, target: f"<{words}:{target}>", lambda *_: "")
        self.assertIn("`[a](b.md)` <c:d.md>", linked)
        self.assertIn("\n[e](f.md)\n", linked)

    def test_texts_of_the_add_on_show_what_they_say(self):
        said = "a|b <c> *d* _e_ [f] `g_h`"
        shown = plain.inline(markdown_text.escaped(said), lambda words, _: words)
        self.assertEqual(shown, "a|b &lt;c&gt; *d* _e_ [f] <code>g_h</code>")

    def test_page_of_a_stub(self):
        page = python_page.page(STUB)
        self.assertIn("### `ease`\n\n```python\nease(u: ArrayLike, ease_in: float=0.0) -> Any\n```", page)
        self.assertIn("u: a number or (m,).<br>\nRaises ValueError if `u` is not finite; \\|x\\_i\\| &lt; 1.", page)
        self.assertIn("Curve(points: NDArray[float64], names: tuple[str, str])", page)
        self.assertIn("### `Curve.length`\n\n```python\nCurve.length: float", page)
        self.assertNotIn("_hidden", page)


class Zip(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.files = plain.files(ROOT)
        cls.places = {name: Places(text) for name, text in cls.files.items() if name.endswith(".html")}

    def test_links_lead_to_places_in_the_zip(self):
        for name, places in self.places.items():
            for link in places.links:
                if "://" in link:
                    continue
                page, anchor = leads(name, link)
                with self.subTest(page=name, link=link):
                    self.assertTrue(page in self.places)
                    if anchor:
                        self.assertTrue(anchor in self.places[page].ids)

    def test_operators_and_settings_have_their_places(self):
        operators = re.findall(r"^## `(motus\.\w+)`", (ROOT / "docs" / "operators.md").read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual(set(operators) - set(self.places["en/operators.html"].ids), set())
        for page, names in wanted().items():
            for language in ("en", "es"):
                if f"{language}/{page}.html" in self.places:
                    self.assertEqual(names - set(self.places[f"{language}/{page}.html"].ids), set())
            self.assertIn(f"en/{page}.html", self.places)

    def test_pages_are_small_and_ask_for_nothing_else(self):
        self.assertLess(sum(len(zlib.compress(text.encode())) for text in self.files.values()), MOST)
        for name, places in self.places.items():
            with self.subTest(name):
                self.assertEqual(len(places.ids), len(set(places.ids)))
                self.assertEqual(places.tags & {"img", "video", "script", "iframe"}, set())
                self.assertEqual(re.findall(r'<link rel="stylesheet" href="([^"]+)"', self.files[name]), ["../style.css"])

    def test_markdown_becomes_what_it_means(self):
        page = "# A `b` {#a}\n\nOne **two *three***, [**four** `|`](x.md)\nfive.\n\n- six\n  seven\n- eight\n\n| a | b |\n|---|---|\n| `c|d` | e \\| f |\n"
        shown = plain.rendered(page, lambda words, target: f"({words}:{target})")
        self.assertEqual(
            shown,
            '<h1 id="a">A <code>b</code></h1>\n<p>One <b>two <i>three</i></b>, (<b>four</b> <code>|</code>:x.md) five.</p>\n'
            "<ul><li>six seven</li><li>eight</li></ul>\n"
            "<table><tr><td>a</td><td>b</td></tr><tr><td><code>c|d</code></td><td>e | f</td></tr></table>",
        )


if __name__ == "__main__":
    unittest.main()
