"""The site in Chromium, as readers see it: on a phone, a tablet and a desk, by day and by night."""

import reader

WIDTHS = (390, 820, 1440)
"""Pixels of a phone, a tablet and a window on a desk."""
THEMES = ("default", "slate")
RULES = ("heading-order", "image-alt", "link-name", "button-name", "label", "document-title", "html-has-lang", "duplicate-id-aria")
"""Of axe-core, the checks of which a reader with poor sight or without a mouse would miss the most, beside contrast."""
SHORTEN = """
    document.querySelectorAll('.md-content__inner > :nth-child(n + 60), tr:nth-child(n + 5), li:nth-child(n + 8)').forEach((one) => one.remove())
"""
"""Looking at the contrast of each word takes seconds; what follows in a long table is coloured as its first rows are."""


def test_pages_fit_and_say_nothing(browser):
    """No page is wider than its window or complains, at no width and in neither theme; nothing is asked of a network."""
    wrong = []
    with reader.Window(browser, viewport={"width": WIDTHS[-1], "height": 900}) as window:
        for address in reader.pages():
            page = window.open(address)
            for width in WIDTHS:
                page.set_viewport_size({"width": width, "height": 900})
                for theme in THEMES:
                    page.evaluate("theme => document.body.setAttribute('data-md-color-scheme', theme)", theme)
                    wide = page.evaluate("document.documentElement.scrollWidth - window.innerWidth")
                    if wide > 0:
                        wrong.append(f"{address} is {wide} pixels wider than {width} ({theme})")
            wrong += [f"{address}: {complaint}" for complaint in window.complaints]
            wrong += [f"{address} asks for {asked}" for asked in window.asked if not asked.startswith(("file:", "data:", "blob:"))]
    assert not wrong, "\n".join(wrong)


def test_pages_can_be_read_by_everyone(browser):
    """Contrast, texts of pictures, order of headings, names of links and buttons."""
    from axe_playwright_python.sync_playwright import Axe

    axe, wrong = Axe(), []

    def look(page, address, *rules):
        options = {"runOnly": {"type": "rule", "values": rules}, "resultTypes": ["violations"]}
        for fault in axe.run(page, options=options).response["violations"]:
            first = fault["nodes"][0]
            wrong.append(f"{address}: {fault['id']}, {len(fault['nodes'])} times: {first['html'][:200]} {first['failureSummary'][:200]}")

    with reader.Window(browser, viewport={"width": WIDTHS[-1], "height": 900}) as window:
        for address in reader.pages():
            page = window.open(address)
            look(page, address, *RULES)
            page.evaluate(SHORTEN)
            for theme in THEMES:
                page.evaluate("theme => document.body.setAttribute('data-md-color-scheme', theme)", theme)
                look(page, f"{address} ({theme})", "color-contrast")
    assert not wrong, "\n".join(wrong)
