"""Summaries as plain text and as a cell of a notebook."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap

from mckibben.report.html import Html, html, tag
from mckibben.report.summary import Summary, Table

_WIDTH = 100  # of a sentence
_ASIDE = "Experiment of "  # tables that a notebook shows when they are opened
# Inside the page of a notebook: its own colours, light or dark.
_TABLE = "border-collapse:collapse;font-variant-numeric:tabular-nums;margin:4px 0 10px"
_CELL = "padding:2px 10px 2px 0;border:0;background:none"
_LINE = ";border-bottom:1px solid rgba(128,140,152,.5)"
_LEAD = "border-left:4px solid #1257b8;padding:4px 12px;margin:6px 0;max-width:52em"


def plain_text(summary: Summary) -> str:
    """Tables and sentences, one below the other."""
    return "\n".join(_table_text(part) if isinstance(part, Table) else _sentence(part) for part in summary)


def _sentence(text: str) -> str:
    return "\n".join(wrap(text, _WIDTH, break_long_words=False, break_on_hyphens=False))


def _table_text(table: Table) -> str:
    rows = [list(table.columns), *(list(row) for row in table.rows)]
    widths = [max(len(row[index]) for row in rows) for index in range(len(table.columns))]
    lines = [_line(row, widths) for row in rows]
    rule = "─" * (sum(widths) + 2 * (len(widths) - 1))
    return "\n".join(
        [table.title, f"  {lines[0]}".rstrip(), f"  {rule}", *(f"  {line}" for line in lines[1:]), ""]
    )


def _line(cells: Sequence[str], widths: Sequence[int]) -> str:
    first, *others = zip(cells, widths, strict=True)
    aligned = [first[0].ljust(first[1]), *(cell.rjust(width) for cell, width in others)]
    return "  ".join(aligned).rstrip()


def notebook_cell(title: str, lead: Sequence[str], summary: Summary) -> str:
    """HTML for a notebook: the lead, the tables, everything else folded away; all texts are escaped.

    Args:
        title: what it is.
        lead: the sentences to be read first.
        summary: tables and sentences.
    """
    tables = [part for part in summary if isinstance(part, Table)]
    shown = [table for table in tables if not table.title.startswith(_ASIDE)]
    aside = [table for table in tables if table.title.startswith(_ASIDE)]
    remarks = [part for part in summary if isinstance(part, str) and part not in lead]
    return str(
        tag(
            "div",
            tag("div", tag("b", title)),
            tag("div", *(tag("p", text, style="margin:2px 0") for text in lead), style=_LEAD)
            if lead
            else None,
            [_table_html(table) for table in shown],
            _folded("Experiment", [_table_html(table) for table in aside]) if aside else None,
            _folded("Remarks", [tag("ul", *(tag("li", text) for text in remarks))]) if remarks else None,
            class_="mckibben",
        )
    )


def _folded(title: str, content: Sequence[Html]) -> Html:
    return tag("details", tag("summary", title), *content)


def _table_html(table: Table) -> Html:
    def cell(name: str, text: str, index: int, line: str = "") -> Html:
        side = "left" if index == 0 else "right"
        return tag(name, text, style=f"{_CELL};text-align:{side}{line}")

    head = tag("tr", *(cell("th", text, index, _LINE) for index, text in enumerate(table.columns)))
    body = [tag("tr", *(cell("td", text, index) for index, text in enumerate(row))) for row in table.rows]
    return html(
        tag("div", table.title, style="opacity:.75"),
        tag("table", tag("thead", head), tag("tbody", *body), style=_TABLE),
    )
