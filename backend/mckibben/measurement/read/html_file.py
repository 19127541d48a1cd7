"""The text of a web page with its tables as lines of cells."""

from __future__ import annotations

from html.parser import HTMLParser

_LINES = frozenset(
    (
        "p",
        "br",
        "div",
        "li",
        "h1",
        "h2",
        "h3",
        "h4",
        "h5",
        "h6",
        "tr",
        "table",
        "caption",
        "title",
        "dt",
        "dd",
        "pre",
    )
)
_SILENT = frozenset(("script", "style", "svg", "template"))
_MOST_SPANNED = 60  # columns


def text_of_html(text: str) -> str:
    """Lines of text; the cells of a row stand in one line, with tabs between them.

    >>> text_of_html("<table><tr><th>p</th><th>F</th></tr><tr><td>1</td><td>2</td></tr></table>")
    'p\\tF\\n1\\t2'
    """
    page = _Page()
    page.feed(text)
    page.close()
    return page.text()


class _Page(HTMLParser):
    """Collects the lines of a page."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self._lines: list[str] = []
        self._piece: list[str] = []
        self._row: list[str] | None = None
        self._span = 1
        self._silent = 0

    def text(self) -> str:
        """All lines that are not empty."""
        self._break()
        return "\n".join(line for line in self._lines if line.strip())

    def _flushed(self) -> str:
        words = " ".join("".join(self._piece).split())
        self._piece.clear()
        return words

    def _break(self) -> None:
        words = self._flushed()
        if words:
            self._lines.append(words)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """A tag opens."""
        if tag in _SILENT:
            self._silent += 1
        elif tag == "tr":
            self._end_row()
            self._break()
            self._row = []
        elif tag in ("td", "th"):
            self._end_cell()
            span = dict(attrs).get("colspan") or "1"
            self._span = min(int(span), _MOST_SPANNED) if span.isdigit() else 1
            self._row = [] if self._row is None else self._row
            self._piece = []
        elif tag in _LINES and self._row is None:
            self._break()
        elif tag == "br":
            self._piece.append(" ")

    def handle_endtag(self, tag: str) -> None:
        """A tag closes."""
        if tag in _SILENT:
            self._silent = max(0, self._silent - 1)
        elif tag in ("td", "th"):
            self._end_cell(closing=True)
        elif tag in ("tr", "table"):
            self._end_row()
        elif tag in _LINES and self._row is None:
            self._break()

    def handle_data(self, data: str) -> None:
        """Text."""
        if not self._silent:
            self._piece.append(data)

    def _end_cell(self, *, closing: bool = False) -> None:
        words = self._flushed()
        if self._row is not None and (closing or words):
            self._row += [words, *[""] * (self._span - 1)]
            self._span = 1

    def _end_row(self) -> None:
        self._end_cell()
        if self._row:
            self._lines.append("\t".join(self._row))
        self._row = None
