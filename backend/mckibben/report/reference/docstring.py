"""Docstrings as HTML: paragraphs, code, examples, and the sections Args, Returns, Raises and the like."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator

from mckibben.report.html import Child, Html, html, tag

SECTIONS = ("Args", "Returns", "Yields", "Raises", "Attributes", "Example", "Examples")
_HEAD = re.compile(rf"^({'|'.join(SECTIONS)}):$")
_ITEM = re.compile(r"^(\*{0,2}[A-Za-z_][\w.]*(?:, \*{0,2}[A-Za-z_][\w.]*)*): (.*)$")
_CODE = re.compile(r"``(.+?)``|:math:`(.+?)`|`(.+?)`")

#: A name in a docstring -> the anchor of its entry, or None.
Anchors = Callable[[str], str | None]


def rendered(text: str, anchors: Anchors) -> Html:
    """A docstring as HTML; a name in backquotes that has an entry becomes a link to it.

    >>> rendered("Tension [N] of ``force``.", lambda name: None)
    '<p>Tension [N] of <code>force</code>.</p>'
    """
    parts: list[Child] = []
    section, lines = "", []
    for line in [*inspect.cleandoc(text).split("\n"), "Args:"]:
        head = _HEAD.match(line)
        if head is None:
            lines.append(line)
            continue
        parts.append(_section(section, lines, anchors))
        section, lines = head[1], []
    return html(parts)


def words(text: str, anchors: Anchors) -> Html:
    """Text of one paragraph with its code and links."""
    parts: list[Child] = []
    end = 0
    for found in _CODE.finditer(text):
        parts.append(text[end : found.start()])
        name = found[1] or found[2] or found[3]
        anchor = anchors(name) if found[3] else None
        code = tag("code", name)
        parts.append(code if anchor is None else tag("a", code, href=f"#{anchor}"))
        end = found.end()
    return html(parts, text[end:])


def _section(name: str, lines: list[str], anchors: Anchors) -> Html | None:
    """The body of a section; the first one, without a name, is the text itself."""
    # What is not indented after a section is text again, e.g. an example of the prompt.
    inside = [index for index, line in enumerate(lines) if line and not line.startswith(" ")]
    cut = inside[0] if name and inside else len(lines)
    body, rest = lines[:cut], lines[cut:]
    after = _blocks(rest, anchors)
    if not name:
        return html(_blocks(body, anchors), after)
    inner = inspect.cleandoc("\n".join(["", *body])).split("\n")
    items = list(_items(inner))
    content = _definitions(items, anchors) if items else html(_blocks(inner, anchors))
    return html(tag("div", tag("p", name, class_="label"), content, class_="section"), after)


def _items(lines: list[str]) -> Iterator[tuple[str, str]]:
    """``name: text`` with continuation lines, of a section; nothing if it has another form."""
    found: list[tuple[str, list[str]]] = []
    for line in lines:
        item = _ITEM.match(line)
        if item is not None:
            found.append((item[1], [item[2]]))
        elif line.startswith(" ") and found:
            found[-1][1].append(line.strip())
        elif line.strip():
            return
    yield from ((name, " ".join(text)) for name, text in found)


def _definitions(items: list[tuple[str, str]], anchors: Anchors) -> Html:
    return tag(
        "dl",
        *(html(tag("dt", tag("code", name)), tag("dd", words(text, anchors))) for name, text in items),
    )


def _blocks(lines: list[str], anchors: Anchors) -> list[Html]:
    """Paragraphs, lists, indented blocks and examples, which blank lines separate."""
    blocks: list[list[str]] = [[]]
    for line in lines:
        if line.strip():
            blocks[-1].append(line)
        elif blocks[-1]:
            blocks.append([])
    return [_block(block, anchors) for block in blocks if block]


def _block(block: list[str], anchors: Anchors) -> Html:
    if block[0].lstrip().startswith(">>>") or all(line.startswith("    ") for line in block):
        return tag("pre", inspect.cleandoc("\n".join(["", *block])), tabindex="0")
    if block[0].startswith("- "):
        items = re.split(r"^- ", "\n".join(block), flags=re.MULTILINE)[1:]
        return tag("ul", *(tag("li", words(" ".join(item.split()), anchors)) for item in items))
    return tag("p", words(" ".join(line.strip() for line in block), anchors))
