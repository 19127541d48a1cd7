"""Files inside the report: each is a link whose target holds the content, so nothing is loaded or run."""

from __future__ import annotations

from base64 import b64encode

from mckibben.report.html import Html, html, tag

_KILO = 1000


def attachment(name: str, text: str) -> Html:
    """A JSON file inside the report: its name, which a browser saves on a click, and its size.

    Args:
        name: under which it is saved.
        text: its content; UTF-8 in the file.
    """
    content = text.encode()
    size = f"{len(content)} bytes" if len(content) < _KILO else f"{len(content) / _KILO:.3g} kB"
    target = f"data:application/json;base64,{b64encode(content).decode()}"
    return html(tag("a", name, download=name, href=target), f" ({size})")
