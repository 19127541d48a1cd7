"""The page of a report and its building blocks: sections, tables, facts, callouts, figures."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from mckibben.report.html import Child, Html, html, tag
from mckibben.report.style import CSS

Tone = Literal["plain", "good", "warn", "bad"]
_SHORT = 4  # most rows of a table that is kept on one page
# Nothing is loaded and no script runs, whatever text a user put in.
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"


@dataclass(frozen=True)
class Section:
    """A numbered part of the report."""

    title: str
    content: Html


def document(
    *, kind: str, title: str, made: datetime, versions: Mapping[str, str], sections: Iterable[Section]
) -> str:
    """The whole HTML file.

    Args:
        kind: what sort of report this is.
        title: of this report.
        made: date and time.
        versions: program -> version that computed the numbers.
        sections: numbered in this order.
    """
    programs = ", ".join(f"{name} {version}" for name, version in versions.items())
    when = made.isoformat(" ", "minutes")
    body = [
        tag(
            "header",
            tag("div", f"mckibben · {kind}", class_="kind"),
            tag("h1", title),
            tag("p", tag("time", when, datetime=made.isoformat()), f" · {programs}"),
        ),
        *(
            tag("section", tag("h2", f"{number} {section.title}"), section.content)
            for number, section in enumerate(sections, 1)
        ),
    ]
    head = [
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", http_equiv="Content-Security-Policy", content=_POLICY),
        tag("meta", name="generator", content=f"mckibben {versions.get('mckibben', '')}"),
        tag("title", f"{title} – {kind}"),
        tag("style", Html(CSS)),
    ]
    return f"<!DOCTYPE html>\n{tag('html', tag('head', head), tag('body', body), lang='en')}\n"


@dataclass(frozen=True)
class Head:
    """Head of a table column; numbers are right-aligned, wide columns and bars keep a minimum width."""

    title: Child
    number: bool = False
    wide: bool = False
    bar: bool = False

    @property
    def kind(self) -> str | None:
        """CSS class of the cells."""
        return "number" if self.number else "wide" if self.wide else "bar" if self.bar else None


def table(
    columns: Sequence[Head],
    rows: Iterable[Sequence[Child]],
    *,
    caption: Child = None,
    whole: bool = True,
) -> Html:
    """A table; its head repeats on every printed page.

    Args:
        columns: heads and cell styles.
        rows: of cells.
        caption: above the table.
        whole: keep a table of up to 4 rows on one page; False if its cells are long.
    """
    kinds = [column.kind for column in columns]
    head = tag("tr", [tag("th", c.title, class_=k, scope="col") for c, k in zip(columns, kinds, strict=True)])
    body = [
        tag("tr", [tag("td", cell, class_=k) for cell, k in zip(row, kinds, strict=True)]) for row in rows
    ]
    top = None if caption is None else tag("caption", caption)
    short = "short" if whole and len(body) <= _SHORT else None
    whole_table = tag("table", top, tag("thead", head), tag("tbody", body), class_=short)
    return tag("div", whole_table, class_="scroll")  # on a narrow screen the table scrolls, not the page


def facts(pairs: Iterable[tuple[Child, Child]]) -> Html:
    """A list of names and values."""
    return tag("dl", [html(tag("dt", name), tag("dd", value)) for name, value in pairs])


def tiles(pairs: Iterable[tuple[Child, Child]]) -> Html:
    """The most important figures, in large type."""
    return tag(
        "div",
        [tag("div", tag("small", name), tag("strong", value), class_="tile") for name, value in pairs],
        class_="tiles",
    )


def callout(title: Child, *text: Child, tone: Tone = "plain") -> Html:
    """A highlighted box."""
    return tag("div", tag("b", title), [tag("p", one) for one in text], class_=f"callout {tone}")


def figure_of(drawing: Html, caption: Child, *, panels: bool = False) -> Html:
    """A drawing with its caption; one of many panels may continue on the next printed page."""
    return tag("figure", drawing, tag("figcaption", caption), class_="panels" if panels else None)


def bullets(items: Iterable[Child]) -> Html:
    """A list."""
    return tag("ul", [tag("li", item) for item in items])


def paragraph(*content: Child, note: bool = False, long: bool = False) -> Html:
    """A paragraph; a note is smaller, and in a table a long one may continue on the next printed page."""
    return tag("p", *content, class_=("note long" if long else "note") if note else None)


def heading(text: Child) -> Html:
    """A heading inside a section."""
    return tag("h3", text)


def code(text: str) -> Html:
    """Preformatted text to copy."""
    return tag("pre", text)


def mark(text: str) -> Html:
    """A highlighted remark, such as "not verified"."""
    return tag("span", text, class_="mark")
