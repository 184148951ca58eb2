"""The pages of the manual that the add-on's zip has: small HTML files without pictures, in manual/en and manual/es of the add-on's folder.

Blender opens them, to the paragraph, from the right-click menu of a setting or an operator. Plain Python, since packaging has no other packages.
"""

import html
import posixpath
import re

import content
import markdown_text

OTHERS = ("index", "install", "together", "copying", "hand_over", "operators", "glossary")
"""Pages beside those of systems."""
FOR_PROGRAMMERS = {"limited_chains"}
REFERENCE = re.compile(r"^## (?:Reference|Referencia) \{#.*?(?=^## |\Z)", re.DOTALL | re.MULTILINE)
"""The part of a page that is for scripts and programmers, who have the site."""
ANCHOR = re.compile(r'\{#([^}\s]+)\}$|<a id="([^"]+)">', re.MULTILINE)
PICTURES = re.compile(r'<div class="motus-figure".*?</div>|<video\b.*?</video>|<img\b[^>]*>', re.DOTALL)
INLINE = re.compile(
    r"(?P<ticks>`+)(?P<code>.+?)(?P=ticks)"
    r"|\\(?P<escaped>[\\`*_{}\[\]()#+\-.!|>])"
    r"|(?P<html></?(?:a|br|sub|sup)\b[^>]*>|&\w+;)"
    r"|\[(?P<words>(?:[^\[\]`]|`[^`]*`)*)\]\((?P<link>[^)\s]+)\)"
    r"|\*\*(?P<bold>(?:`[^`]*`|\\.|\*[^*\s][^*]*\*|[^*`\\])+?)\*\*"
    r"|\*(?!\s)(?P<italic>(?:`[^`]*`|\\.|[^*`\\])+?)(?<!\s)\*",
    re.DOTALL,
)
CELL = re.compile(r"(?:`[^`]*`|\\.|[^|`\\])*")
ITEM = re.compile(r"(?:-|\d+\.) +")
PAGE = """<!DOCTYPE html>
<html lang="{language}">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{title} - Motus</title><link rel="stylesheet" href="../style.css"></head>
<body>
<nav>{navigation}</nav>
<main>
{body}
</main>
</body>
</html>
"""
STYLE = """:root { color-scheme: light dark; --line: #8886; --mark: #f2b63255; }
body { max-width: 52rem; margin: 0 auto; padding: 1rem; font: 16px/1.6 system-ui, sans-serif; }
nav { font-size: 0.85rem; border-bottom: 1px solid var(--line); padding-bottom: 0.6rem; }
nav a { margin-right: 0.8rem; display: inline-block; }
table { border-collapse: collapse; font-size: 0.9rem; display: block; overflow-x: auto; }
th, td { text-align: left; vertical-align: top; padding: 0.4rem 0.8rem 0.4rem 0; border-top: 1px solid var(--line); }
pre { overflow-x: auto; padding: 0.7rem; border: 1px solid var(--line); }
code { font-size: 0.9em; }
:target, tr:has(:target) { background: var(--mark); }
"""


def files(root):
    """{path below manual/: text} of all files."""
    pages = {address: REFERENCE.sub("", text) for address, text in content.pages(root).items() if _is_kept(address)}
    anchors = {address: {one or two for one, two in ANCHOR.findall(text)} for address, text in pages.items()}
    found = {_place(address): _page(address, pages, anchors) for address in pages}
    return {**found, "style.css": STYLE}


def write(root, folder):
    """Writes the files into a folder."""
    for name, text in files(root).items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def _is_kept(address):
    name = address.removeprefix("es/").removesuffix(".html")
    return name in {*content.SYSTEMS, *OTHERS} - FOR_PROGRAMMERS


def _place(address):
    return address if address.startswith("es/") else f"en/{address}"


def _page(address, pages, anchors):
    """A page's HTML, with links to all pages of its language. anchors: {address: names of the places that the page has}."""
    language = "es" if address.startswith("es/") else "en"
    shown = {other: markdown_text.title(one) for other, one in pages.items() if other.startswith("es/") == (language == "es")}

    def link(words, target):
        path, _, anchor = target.partition("#")
        other = posixpath.normpath(posixpath.join(posixpath.dirname(address), path)) if path else address
        if "://" in target:
            return f'<a href="{html.escape(target)}">{words}</a>'
        if other not in pages:
            return words
        place = f"#{anchor}" if anchor in anchors[other] else ""
        return f'<a href="{content.relative(_place(address), _place(other)) if path else ""}{place}">{words}</a>'

    return PAGE.format(
        language=language,
        title=html.escape(_without_anchor(shown[address])),
        navigation="\n".join(
            f'<a href="{posixpath.basename(other)}">{html.escape(_without_anchor(name))}</a>' for other, name in shown.items()
        ),
        body=rendered(PICTURES.sub("", pages[address]), link),
    )


def _without_anchor(heading):
    return re.sub(r" \{#[^}]*\}$", "", heading)


def rendered(text, link):
    """HTML of Markdown, as far as the pages use it; link(HTML of its words, target) gives that of a link."""
    lines, at, parts = text.splitlines(), 0, []

    def block(belongs):
        """The lines from here on that belong together."""
        nonlocal at
        first = at
        while at < len(lines) and belongs(lines[at]):
            at += 1
        return lines[first:at]

    while at < len(lines):
        line = lines[at]
        if line.startswith("```"):
            at += 1
            parts.append(_code(block(lambda one: not one.startswith("```"))))
            at += 1
        elif line.startswith("#"):
            parts.append(_heading(line, link))
            at += 1
        elif line.startswith("|"):
            parts.append(_table(block(lambda one: one.startswith("|")), link))
        elif line.startswith("    "):
            parts.append(_code(one[4:] for one in block(lambda one: one.startswith("    ") or not one)))
        elif ITEM.match(line):
            parts.append(_list(block(lambda one: ITEM.match(one) or one.startswith("  ")), link))
        elif not line or line.startswith(("<div", "</div")):
            at += 1
        else:
            paragraph = block(lambda one: one and not one.startswith(("|", "#", "```", "<div", "</div")))
            parts.append(f"<p>{inline(' '.join(paragraph), link)}</p>")
    return "\n".join(parts)


def inline(text, link):
    """HTML of a paragraph's text."""
    parts, at = [], 0
    for token in INLINE.finditer(text):
        parts.append(html.escape(text[at : token.start()], quote=False))
        at = token.end()
        if token["code"]:
            parts.append(f"<code>{html.escape(token['code'], quote=False)}</code>")
        elif token["link"]:
            parts.append(link(inline(token["words"], link), token["link"]))
        elif token["bold"]:
            parts.append(f"<b>{inline(token['bold'], link)}</b>")
        elif token["italic"]:
            parts.append(f"<i>{inline(token['italic'], link)}</i>")
        else:
            parts.append(token["html"] or html.escape(token["escaped"], quote=False))
    return "".join((*parts, html.escape(text[at:], quote=False)))


def _code(lines):
    return f"<pre><code>{html.escape(chr(10).join(lines).rstrip(), quote=False)}</code></pre>"


def _heading(line, link):
    marks, heading, name = re.match(r"(#+) (.*?)(?: \{#([^}]*)\})?$", line).groups()
    return f'<h{len(marks)} id="{name}">{inline(heading, link)}</h{len(marks)}>'


def _list(lines, link):
    """A list, of which each item may go on in lines that are indented."""
    kind = "ul" if lines[0].startswith("-") else "ol"
    items = re.split(r"(?m)^(?:-|\d+\.) +", "\n".join(lines))[1:]
    inner = "".join(f"<li>{inline(' '.join(item.split()), link)}</li>" for item in items)
    return f"<{kind}>{inner}</{kind}>"


def _table(lines, link):
    """A table; a head without words is left out."""
    rows = [[cell.strip() for cell in CELL.findall(line.strip()[1:-1]) if cell] for line in lines if not re.fullmatch(r"[|\-: ]+", line)]
    rows = rows if any(map(any, rows[:1])) else rows[1:]
    cells = [[inline(re.sub(r"^(?:<br>)+", "", cell), link) for cell in row] for row in rows]
    return f"<table>{''.join('<tr>' + ''.join(f'<td>{cell}</td>' for cell in row) + '</tr>' for row in cells)}</table>"
