"""The Spanish pages of the manual, docs/es/NAME.md, have all that docs/NAME.md has, and name what is in the interface as the add-on's Spanish does."""

import ast
import functools
import re
import unittest

from test_manual import DOCS, LINK, ROOT, SYSTEMS, spanish_pages, without_code

CATALOGUE = ROOT / "addon" / "motus" / "translations" / "es"
FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
INDENTED = re.compile(r"(?:^    .*\n)+", re.MULTILINE)
"""Formulas. The words in them are translated."""
PICTURE = re.compile(r"!\[[^\]]*\]\((?:\.\./)?([^)]+)\)")
TABLE = re.compile(r"(?:^\|.*\n)+", re.MULTILINE)
ELSEWHERE = re.compile(r"^\| (?:there|allí) \|.*\n(?:\|.*\n)+", re.MULTILINE)
"""Tables whose first columns have words of other programs."""
ITALIC = re.compile(r"(?<![*\w])\*([^*\n]+)\*(?![*\w])")
FIRST_CELL = re.compile(r"^\| ([^|*\n]+) \|", re.MULTILINE)


@functools.cache
def catalogue():
    """{text of the interface: its Spanish translations, one for each context in which the add-on has the text}."""
    found = {}
    for path in CATALOGUE.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            for english, spanish in zip(node.keys, node.values) if isinstance(node, ast.Dict) else ():
                if isinstance(english, ast.Constant) and isinstance(spanish, ast.Constant):
                    found.setdefault(english.value, set()).add(spanish.value)
    return found


@functools.cache
def text_of(path):
    return path.read_text(encoding="utf-8")


def tables(text):
    """(rows, {columns of each row}) of all tables; a bar after a backslash is no border."""
    found = [table.splitlines() for table in TABLE.findall(text)]
    return [(len(rows), {len(re.split(r"(?<!\\)\|", row)) for row in rows}) for rows in found]


def linked_files(text):
    """Names of the files that a page leads to, without their folders."""
    return sorted("".join(link).partition("#")[0].rpartition("/")[2] for link in LINK.findall(text))


def words(text):
    """What a page has in italics or in the first columns of its tables, the parts of menu paths, lists and "Setting: Choice" each by itself."""
    text = ELSEWHERE.sub(lambda table: re.sub(r"^\|[^|]*\|", "|", table[0], flags=re.MULTILINE), text)
    unwrapped = re.sub(r"(?<=[^\n])\n *(?=[^\n|#*-])", " ", re.sub(r"`[^`]*`", "", text))
    named = ITALIC.findall(unwrapped) + FIRST_CELL.findall(text)
    return {part.strip(" .,:") for name in named for part in re.split(r" > |: |, ", name)}


class SpanishPages(unittest.TestCase):
    def each_page(self, check):
        """Call check(English text, Spanish text), both without their code blocks, for each Spanish page."""
        for page in spanish_pages():
            with self.subTest(page.name):
                check(without_code(text_of(DOCS / page.name)), without_code(text_of(page)))

    def test_each_system_has_one(self):
        self.assertLessEqual(set(SYSTEMS), {page.stem for page in spanish_pages()})

    def test_code_is_that_of_the_english_page(self):
        for page in spanish_pages():
            with self.subTest(page.name):
                self.assertEqual(FENCED.findall(text_of(page)), FENCED.findall(text_of(DOCS / page.name)))

    def test_parts_are_those_of_the_english_page(self):
        def check(english, spanish):
            self.assertEqual(re.findall(r"^#+ ", spanish, re.MULTILINE), re.findall(r"^#+ ", english, re.MULTILINE))
            self.assertEqual(PICTURE.findall(spanish), PICTURE.findall(english))
            self.assertEqual(tables(spanish), tables(english))
            self.assertEqual(*([block.count("\n") for block in INDENTED.findall(text)] for text in (spanish, english)))
            self.assertEqual(linked_files(spanish), linked_files(english))

        self.each_page(check)

    def test_links_lead_to_spanish_pages_where_there_are_any(self):
        english_of_spanish = {f"../{page.name}" for page in spanish_pages()}

        def check(_, spanish):
            self.assertFalse(english_of_spanish & {"".join(link).partition("#")[0] for link in LINK.findall(spanish)})

        self.each_page(check)

    def test_words_of_the_interface_are_those_of_the_add_on(self):
        known = catalogue()
        translations = set().union(*known.values())

        def check(english, spanish):
            shown = words(spanish)
            for word in words(english) & known.keys():
                self.assertTrue(known[word] & shown, f"{word} is called {known[word]}")
            self.assertLessEqual(shown & known.keys(), translations, "words of the English interface")

        self.assertGreater(len(known), 2000)
        self.each_page(check)


if __name__ == "__main__":
    unittest.main()
