"""What axe objects to in a page."""

from __future__ import annotations

from typing import Any

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page

from tests.frontend.views import marked

# What passed and what does not apply is not described: for a large page that is 80 % of the work.
# Two rules that axe leaves off unless asked: the visible label is part of the name (WCAG 2.5.3), and targets
# of 24 px or with room around them (2.5.8).
_ALL: dict[str, Any] = {
    "resultTypes": ["violations"],
    "rules": {"label-content-name-mismatch": {"enabled": True}, "target-size": {"enabled": True}},
}
_COLOURS: dict[str, Any] = {
    "resultTypes": ["violations"],
    "runOnly": {"type": "rule", "values": ["color-contrast", "link-in-text-block"]},
}
_NO_COLOURS = {rule: {"enabled": False} for rule in _COLOURS["runOnly"]["values"]}
# Reading the colours of every text is more than half of the work; texts of one kind have the same ones.
_SAMPLED = """() => {
  const seen = {};
  const kind = (element) => element && element.tagName + "." + element.getAttribute("class");
  for (const text of document.querySelectorAll("body *")) {
    if (![...text.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim())) continue;
    const { color, backgroundColor } = getComputedStyle(text), above = text.parentElement;
    const key = [kind(text), kind(above), kind(above.parentElement), color, backgroundColor].join();
    seen[key] = (seen[key] ?? 0) + 1;
    text.toggleAttribute("data-sampled", seen[key] <= 2);
  }
}"""
_UNSAMPLED = """() => {
  for (const text of document.querySelectorAll("[data-sampled]")) text.removeAttribute("data-sampled");
}"""


def violations(page: Page, within: str = "body", *, themes: int = 1) -> list[str]:
    """What axe objects to in the page as it stands.

    Args:
        within: the only part that is looked at, as a CSS selector: a dialog, a panel, a menu just opened.
        themes: 1: of the whole page, the colours of two texts of each kind. 2: the colours of all texts, in
            both themes; every view is looked at so by an examination (test_accessibility.py).
    """
    page.locator(within).filter(visible=True).first.wait_for()
    theme = page.locator("html").get_attribute("data-theme")
    if within == "body":
        page.evaluate("scrollTo(0, 0)")  # what lies half below the head of the page is no small target
    if within.startswith(
        "dialog"
    ):  # what lies below it is out of reach; axe would walk through it all the same
        hidden = page.add_style_tag(
            content=f"body > * {{ visibility: hidden }} {within} {{ visibility: visible }}"
        )
        found = _objections(page, _ALL, theme, within)
        hidden.evaluate("(style) => style.remove()")
        return found
    if themes == 1 and within == "body":
        found = _objections(page, _ALL | {"rules": _ALL["rules"] | _NO_COLOURS}, theme, within)
        page.evaluate(_SAMPLED)
        found += _objections(page, _COLOURS, theme, "[data-sampled]")
        page.evaluate(_UNSAMPLED)
        return found
    found = _objections(page, _ALL, theme, within)
    if themes == 2:
        other = "light" if theme == "dark" else "dark"
        page.emulate_media(color_scheme=other)
        marked(page, f'[data-theme="{other}"]')
        found += _objections(page, _COLOURS, other, within)
        page.emulate_media(color_scheme="dark" if theme == "dark" else "light")
        marked(page, f'[data-theme="{theme}"]')
    return found


def _objections(page: Page, options: dict[str, Any], theme: str | None, within: str) -> list[str]:
    """Each rule that is broken, with the first place where it is."""
    broken = Axe().run(page, context={"include": [[within]]}, options=options).response["violations"]
    return [f"{rule['id']} ({theme}): {rule['nodes'][0]['html'][:160]}" for rule in broken]
