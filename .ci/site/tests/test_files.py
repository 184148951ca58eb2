"""The files of the site: every link leads somewhere, nothing is loaded from elsewhere, every picture has a text, no page is heavy."""

import unittest

import reader

HEAVIEST = 1_000_000
"""Bytes of a page with all that is loaded along with it, but for the index of the search."""
FEWEST = 50
"""Pages that the site has at least."""


class Files(unittest.TestCase):
    def test_all_pages_are_there(self):
        self.assertGreater(len(reader.pages()), FEWEST)

    def test_links_lead_somewhere(self):
        for address, page in reader.pages().items():
            for link in page.links:
                if not (target := page.target(link)):
                    continue
                path, anchor = target
                with self.subTest(page=address, link=link):
                    self.assertTrue(path.is_file())
                    if anchor and path.suffix == ".html":
                        self.assertIn(anchor, reader.page(path).anchors)

    def test_nothing_is_loaded_from_elsewhere(self):
        for address, page in reader.pages().items():
            for load in page.loads:
                with self.subTest(page=address, load=load):
                    target = page.target(load)
                    self.assertTrue((target and target[0].is_file()) or load.startswith("data:"))

    def test_pictures_have_a_text(self):
        for address, page in reader.pages().items():
            with self.subTest(page=address):
                self.assertFalse(page.without_text)

    def test_no_page_is_heavy(self):
        for address, page in reader.pages().items():
            loaded = {page.target(load)[0] for load in page.loads if page.target(load)}
            with self.subTest(page=address):
                self.assertLess(sum(path.stat().st_size for path in {page.path, *loaded} if path.suffix != ".webm"), HEAVIEST)
