"""HTML and SVG from Python values: everything that is not `Html` is escaped."""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape

# Characters XML does not allow: a report is also valid XHTML.
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")


class Html(str):
    """Text that is HTML already."""

    __slots__ = ()


Child = str | Html | int | float | None | Iterable["Child"]


def html(*children: Child) -> Html:
    """The children, joined; plain text is escaped, None is skipped."""
    parts: list[str] = []
    for child in children:
        if child is None:
            continue
        if isinstance(child, Html):
            parts.append(child)
        elif isinstance(child, str | int | float):
            parts.append(escape(_FORBIDDEN.sub("\ufffd", str(child)), quote=False))
        else:
            parts.append(html(*child))
    return Html("".join(parts))


def tag(name: str, /, *children: Child, **attributes: str | float | None) -> Html:
    """An element; ``class_`` is the attribute class, ``stroke_width`` stroke-width; None leaves one out."""
    words = "".join(
        f' {key.rstrip("_").replace("_", "-")}="{escape(_FORBIDDEN.sub(chr(0xFFFD), str(value)))}"'
        for key, value in attributes.items()
        if value is not None
    )
    if not children:
        return Html(f"<{name}{words}/>" if name in _EMPTY else f"<{name}{words}></{name}>")
    return Html(f"<{name}{words}>{html(*children)}</{name}>")


_EMPTY = frozenset({"meta", "link", "br", "path", "line", "rect", "circle"})
