"""What Markdown says, as far as the manual's pages use it: code apart from prose, headings and their anchors, links and pictures."""

import re

FENCE = re.compile(r"^```[^\n]*\n.*?^```$", re.DOTALL | re.MULTILINE)
TOKEN = re.compile(
    r"(?P<fence>^```[^\n]*\n.*?^```$)"
    r"|(?P<indented>^ {4}[^\n]*$)"
    r"|(?P<code>(?P<ticks>`+)[^\n]+?(?P=ticks))"
    r"|!\[(?P<alt>[^\]]*)\]\((?P<picture>[^)\s]+)\)"
    r"|(?<!!)\[(?P<text>[^\]]*)\]\((?P<link>[^)\s]+)\)",
    re.DOTALL | re.MULTILINE,
)
"""Code, which is left as it is, a picture or a link."""
HEADING = re.compile(r"^(#+) (.*)$", re.MULTILINE)


def slug(heading):
    """The anchor that code hosts give a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def outside_fences(text, change):
    """`text` with change(part) in place of each part that is no block of code."""
    parts, at = [], 0
    for fence in FENCE.finditer(text):
        parts += [change(text[at : fence.start()]), fence[0]]
        at = fence.end()
    return "".join((*parts, change(text[at:])))


def headings(text):
    """[(level, heading, the anchor that code hosts give it)] of a page. An anchor that is there already gets a number behind it."""
    found, seen = [], {}
    for marks, heading in HEADING.findall(FENCE.sub("", text)):
        name = slug(heading)
        count = seen[name] = seen.get(name, -1) + 1
        found.append((len(marks), heading, f"{name}-{count}" if count else name))
    return found


def with_anchors(text, names):
    """`text` whose headings say their anchors, the next of `names` each."""
    following = iter(names)
    return outside_fences(text, lambda part: HEADING.sub(lambda heading: f"{heading[0]} {{#{next(following)}}}", part))


def with_links(text, link, picture):
    """`text` with link(words, target) in place of each link, and picture(words, target) of each picture, outside of code."""

    def changed(token):
        if token["link"]:
            return link(token["text"], token["link"])
        return picture(token["alt"], token["picture"]) if token["picture"] else token[0]

    return TOKEN.sub(changed, text)


def escaped(text):
    """Plain text, in which only `code` means something, as Markdown that shows it; within tables too."""
    pieces = re.split(r"(`[^`]+`)", text)
    return "".join(piece if at % 2 else re.sub(r"([\\*_\[\]|#`])", r"\\\1", piece).replace("<", "&lt;") for at, piece in enumerate(pieces))


def title(text):
    """The page's first heading."""
    return HEADING.search(text)[2]
