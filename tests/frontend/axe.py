"""What axe objects to in a page."""

from __future__ import annotations

from typing import Any

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page

from tests.frontend.views import marked, run

# What passed and what does not apply is not described: for a large page that is 80 % of the work.
# Two rules that axe leaves off unless asked: the visible label is part of the name (WCAG 2.5.3), and targets
# of 24 px or with room around them (2.5.8).
_COLOURS = ("color-contrast", "link-in-text-block")
_ALL: dict[str, Any] = {
    "resultTypes": ["violations"],
    "rules": {"label-content-name-mismatch": {"enabled": True}, "target-size": {"enabled": True}}
    | {rule: {"enabled": False} for rule in _COLOURS},
}
# Rows of a table, points of a plot, lines of a list are coloured by one pattern each: the colours of two of
# each kind are looked at. All of them were two thirds of the work.
_REPEATED = """
for (const child of document.querySelectorAll("[data-repeated]")) child.removeAttribute("data-repeated");
for (const parent of document.querySelectorAll("main, main *, dialog *")) {
  const seen = {};
  for (const child of parent.children) {
    const kind = child.tagName + "." + child.getAttribute("class");
    seen[kind] = (seen[kind] ?? 0) + 1;
    if (seen[kind] > 2) child.setAttribute("data-repeated", "");
  }
}
"""
_REPEATED_ONES = [["[data-repeated]"]]


def violations(page: Page, within: str = "body") -> list[str]:
    """What axe objects to in the page as it stands, and to its colours in the other theme.

    Args:
        within: the only part that is looked at, as a CSS selector: a dialog, a panel, a menu just opened.
    """
    page.locator(within).filter(visible=True).first.wait_for()
    theme = page.locator("html").get_attribute("data-theme")
    found = _objections(page, _ALL, theme, {"include": [[within]]}) + _colours(page, theme, within)
    other = "light" if theme == "dark" else "dark"
    page.emulate_media(color_scheme=other)
    marked(page, f'[data-theme="{other}"]')
    found += _colours(page, other, within)
    page.emulate_media(color_scheme="dark" if theme == "dark" else "light")
    marked(page, f'[data-theme="{theme}"]')
    return found


def _colours(page: Page, theme: str | None, within: str) -> list[str]:
    options = {"resultTypes": ["violations"], "runOnly": {"type": "rule", "values": [*_COLOURS]}}
    run(page, _REPEATED)
    return _objections(page, options, theme, {"include": [[within]], "exclude": _REPEATED_ONES})


def _objections(page: Page, options: dict[str, Any], theme: str | None, context: dict[str, Any]) -> list[str]:
    """Each rule that is broken, with the first place where it is."""
    broken = Axe().run(page, context=context, options=options).response["violations"]
    return [f"{rule['id']} ({theme}): {rule['nodes'][0]['html'][:160]}" for rule in broken]
