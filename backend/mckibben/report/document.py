"""The page of a report, its style, and its building blocks: sections, tables, facts, callouts, figures."""

from __future__ import annotations

import platform
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from importlib.metadata import version
from typing import Literal

from mckibben.report.html import Child, Html, html, tag
from mckibben.version import __version__

Tone = Literal["plain", "good", "warn", "bad"]
_SHORT = 4  # most rows of a table that is kept on one page
# Nothing is loaded and no script runs, whatever text a user put in.
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"

CSS = """
@page { size: A4; margin: 16mm 15mm 17mm;
  @bottom-right { content: counter(page) " / " counter(pages); font: 8pt sans-serif; color: #4d5b6a; } }
:root { color-scheme: light; --ink: #17212b; --soft: #4d5b6a; --line: #d5dce3; --tint: #f3f5f8;
  --accent: #1257b8; --good: #0c6b40; --good-tint: #e5f4ec; --warn: #7d4e00; --warn-tint: #fdf2dc;
  --bad: #ad1f1f; --bad-tint: #fcebea; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 28px 32px 56px; max-width: 860px; background: #fff; color: var(--ink);
  font: 14px/1.5 Inter, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif;
  font-variant-numeric: tabular-nums; }
header { border-bottom: 2px solid var(--ink); padding-bottom: 12px; margin-bottom: 18px; }
.kind { color: var(--soft); font-size: 12px; letter-spacing: 0.06em; text-transform: uppercase; }
h1 { font-size: 25px; line-height: 1.2; margin: 3px 0 6px; overflow-wrap: anywhere; }
header p { margin: 0; color: var(--soft); font-size: 12.5px; }
section { margin-top: 28px; }
h2 { font-size: 17px; margin: 0 0 8px; padding-bottom: 3px; border-bottom: 1px solid var(--line); }
h3 { font-size: 14.5px; margin: 18px 0 4px; }
p, ul { margin: 6px 0; }
ul { padding-left: 20px; }
li { margin: 2px 0; overflow-wrap: anywhere; }
.note { color: var(--soft); font-size: 12.5px; }
.callout { border-left: 4px solid var(--accent); background: var(--tint);
  padding: 10px 14px; margin: 10px 0; }
.callout b { display: block; }
.callout p { margin: 2px 0; }
.good { border-color: var(--good); background: var(--good-tint); }
.warn { border-color: #b97700; background: var(--warn-tint); }
.bad { border-color: var(--bad); background: var(--bad-tint); }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(126px, 1fr));
  gap: 10px; margin: 12px 0; }
.tile { border: 1px solid var(--line); border-radius: 6px; padding: 8px 12px; }
.tile small { display: block; color: var(--soft); font-size: 12px; }
.tile strong { font-size: 20px; font-weight: 650; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 3px 16px; margin: 8px 0; }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; }
table { border-collapse: collapse; width: 100%; margin: 8px 0 12px; font-size: 12.5px; line-height: 1.4; }
caption { text-align: left; color: var(--soft); font-size: 12.5px; padding-bottom: 3px; }
th, td { padding: 4px 8px; border-bottom: 1px solid var(--line); vertical-align: top; text-align: left; }
th { font-weight: 600; border-bottom-color: #8b98a6; vertical-align: bottom; }
th.number, td.number { text-align: right; }
td.number { white-space: nowrap; }
td.wide { min-width: 15em; width: 62%; }
td.bar { width: 25%; min-width: 100px; vertical-align: middle; }
.mark { color: var(--warn); font-weight: 600; }
figure { margin: 10px 0 14px; }
figcaption { color: var(--soft); font-size: 12.5px; }
svg { display: block; width: 100%; height: auto; font: 11.5px Inter, "Segoe UI", Roboto, Arial, sans-serif; }
.beside { display: grid; grid-template-columns: 450fr 270fr; align-items: end; }
.equation { margin: 6px 0; padding: 6px 12px; background: var(--tint); overflow-x: auto;
  text-align: center; }
.equation math { display: inline math; margin: 2px 10px; }
math { font-size: 1.05em; }
code, pre { font: 12px/1.5 ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; }
code { overflow-wrap: anywhere; }
.hash { font-size: 11px; color: var(--soft); }
pre { background: var(--tint); padding: 8px 12px; white-space: pre-wrap;
  overflow-wrap: anywhere; margin: 6px 0; }
.scroll { overflow-x: auto; }
@media screen and (max-width: 700px) {
  body { padding: 18px 14px 40px; }
  figure { overflow-x: auto; }
  figure svg { min-width: 560px; }
  .beside { grid-template-columns: 1fr; }
  .beside svg { min-width: 420px; }
  dl { grid-template-columns: 1fr; }
  dd { margin-bottom: 4px; }
}
@media print {
  body { padding: 0; max-width: none; font-size: 9.5pt; }
  table, .note, caption, figcaption { font-size: 8.5pt; }
  .tiles { grid-template-columns: repeat(auto-fit, minmax(100px, 1fr)); gap: 7px; }
  .tile { padding: 6px 9px; }
  .tile small { font-size: 8pt; line-height: 1.3; }
  .tile strong { font-size: 16px; }
  section { margin-top: 20px; }
  h2, h3, caption { break-after: avoid; }
  figure, .callout, .tiles, tr, .equation, dd, li { break-inside: avoid; }
  /* A tall stack would leave a third of a page white: it may break, with two panels on either side. */
  figure.panels { break-inside: auto; }
  figure.panels svg { break-inside: avoid; }
  figure.panels svg:first-of-type { break-after: avoid; }
  figure.panels svg:last-of-type, figcaption { break-before: avoid; }
  table.short { break-inside: avoid; }
  .law .note { break-before: avoid; } /* the equations of a law may part */
  /* A row with reasons or a long remark is tall: it may break, with two of its lines on either side. */
  tr:has(td .long), tr:has(td.wide) { break-inside: auto; }
  td.wide { orphans: 2; widows: 2; }
  td .note { orphans: 2; widows: 2; padding-top: 4px;
    box-decoration-break: clone; -webkit-box-decoration-break: clone; }
  /* A head never stands alone at the foot of a page. */
  thead { display: table-header-group; break-after: avoid; }
  .scroll { overflow: visible; }
  .callout, .equation, pre, svg { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
"""


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


def versions() -> dict[str, str]:
    """Program -> version."""
    return {
        "mckibben": __version__,
        "Python": platform.python_version(),
        # Read from the package metadata: importing scipy would delay the start of the server.
        **{name: version(name) for name in ("numpy", "scipy")},
    }
