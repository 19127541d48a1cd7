"""What the tests of the pages share: opening a view, waiting for a drawing, asking the page."""

from __future__ import annotations

import base64
import json
import re
import zlib
from collections.abc import Callable
from typing import Any
from urllib.parse import urlsplit
from weakref import WeakSet

from playwright.sync_api import Locator, Page, expect

from tests.frontend.diagnoses import remember

SIZES = ((1440, 1000), (1024, 800), (390, 844))
REFUSED = "status of 422"  # what the console says when the server refuses an input

# The page's modules lie under the name of the state of all files; by another path they would be others.
_IMPORTED = """
const main = document.querySelector("script[type=module]");
const imported = (path) => import(main ? new URL(main.src).pathname.replace("/js/main.js", path) : path);
"""


def marked(page: Page, mark: str, within: float = 10_000) -> None:
    """Wait until the root of the page bears a mark.

    Not by ``expect``, which at each look describes all that is in the element to be ready to say what it saw
    instead; for the whole page that keeps a core busy.

    Args:
        mark: an attribute as a CSS selector, like ``[data-diagnosis="done"]``.
        within: ms.
    """
    page.locator(f"html{mark}").wait_for(state="attached", timeout=within)


#: Pages that the tests of a module share.
KEPT: WeakSet[Page] = WeakSet()
#: What the links hold that `link_to` made.
_DOCUMENTS: dict[str, object] = {}
# As after loading, as far as tests see it; ends when nothing is asked or drawn any more.
_EMPTIED = """
for (const dialog of document.querySelectorAll("dialog[open]")) dialog.close();
for (const fold of document.querySelectorAll(".all-inputs, .tables, .notes")) fold.open = false;
document.activeElement?.blur();
localStorage.clear();
for (const part of document.querySelectorAll("*")) if (part.scrollTop) part.scrollTop = 0;
const state = await import("/js/state.js");
state.edit(() => (argument ? state.readDoc(argument) : state.defaultDoc()), "empty");
[state.past.value, state.future.value] = [[], []];
const root = document.documentElement;
const seen = () => [performance.getEntriesByType("resource").length, root.dataset.drawn, root.dataset.ran,
  document.querySelectorAll("[aria-busy=true]").length].join();
for (let before; before !== seen(); await new Promise((resolve) => setTimeout(resolve, 150))) before = seen();
"""


def link_to(document: object) -> str:
    """The hash of the address that holds this document: deflate-raw, base64url."""
    packer = zlib.compressobj(wbits=-15)
    packed = packer.compress(json.dumps(document).encode()) + packer.flush()
    link = "#v1." + base64.urlsafe_b64encode(packed).decode().rstrip("=")
    _DOCUMENTS[link] = document
    return link


def load(page: Page, link: str = "") -> None:
    """The page of the server, loaded anew; one that a module of tests keeps is emptied instead.

    Args:
        link: a hash that holds a state, with its ``#``.
    """
    if page in KEPT and urlsplit(page.url).path == "/" and (link in _DOCUMENTS or not link):
        run(page, _EMPTIED, _DOCUMENTS.get(link))
        return
    if page.url != "about:blank":  # a goto to another hash of the same page would not load it anew
        page.goto("about:blank")
    page.goto(f"/{link}")


def open_design(page: Page, link: str = "") -> None:
    """The Design view with its plots drawn and the model's error known.

    Args:
        link: a hash that holds a state, with its ``#``.
    """
    load(page, link)
    marked(page, "[data-drawn]")


def open_inputs(page: Page, link: str = "") -> None:
    """The Design view with all its inputs in sight: geometry, curves, conditions."""
    open_design(page, link)
    page.get_by_text("Geometry, curves, conditions").click()


def add_effect(page: Page, name: str) -> Locator:
    """Add the first effect that is found by a name; its chip."""
    page.keyboard.press("Control+k")
    expect(page.get_by_role("dialog").get_by_role("combobox")).to_be_focused()
    page.keyboard.type(f"add effect {name}")
    title = page.locator("#commands [role=option] span").first.inner_text()
    page.keyboard.press("Enter")
    return page.locator("[data-effect]:visible", has_text=title.partition(" (")[0])


def open_catalogue(page: Page) -> None:
    """The Catalogue view with its table filled and the small plot drawn."""
    load(page, link_to({"schema": 1, "view": "catalogue", "design": {}}))
    expect(page.get_by_role("button", name="Festo DMSP-20", exact=True)).to_be_visible()
    expect(page.locator(".detail .js-line").first).to_be_attached()


def open_compare(page: Page) -> None:
    """The Compare & diagnose view before there are data; the Design view is not even built."""
    load(page, link_to({"schema": 1, "view": "compare", "design": {}}))
    expect(page.get_by_role("button", name="Example measurement")).to_be_visible(timeout=20_000)


def open_compared(page: Page) -> None:
    """The Compare & diagnose view with a built-in measurement and its diagnosis."""
    open_compare(page)
    remember(page)
    page.locator(".tile", has_text="DMSP-20-300").click()
    marked(page, '[data-diagnosis="done"]', 180_000)
    expect(page.locator("#overlay-force .js-line").first).to_be_attached(timeout=20_000)


def redo(page: Page) -> None:
    """One step forward again."""
    page.keyboard.press("Control+Shift+z")


def drawings(page: Page) -> int:
    """How often the plots of the Design view were drawn."""
    return int(page.locator("html").get_attribute("data-drawn") or 0)


def redrawn(page: Page, act: Callable[[], object]) -> None:
    """Do something and wait until the plots are drawn with its answer."""
    with page.expect_response("**/api/curves"):
        before = drawings(page)
        act()
    marked(page, f':not([data-drawn="{before}"])')


def settled(page: Page) -> None:
    """Wait until the model's error is that of what is set."""
    expect(page.locator("#rmse")).to_have_attribute("aria-busy", "false")


def field(page: Page, name: str) -> Locator:
    """The number field of this name, the first on the page."""
    return page.get_by_role("textbox", name=name, exact=True).first


def enter(page: Page, name: str, text: str) -> None:
    """Type into a number field and take it."""
    field(page, name).fill(text)
    field(page, name).press("Enter")


def rmse(page: Page) -> float:
    """The error of the model as set, in the shown unit."""
    settled(page)
    text = page.locator("#rmse .rmse.first b").inner_text()
    found = re.match(r"[\d.]+", text)
    assert found, text
    return float(found[0])


def run(page: Page, script: str, argument: Any = None) -> Any:
    """Run the body of an async function in the page; its modules are there by ``await import('/js/…')``."""
    script = script.replace("import(", "imported(")
    return page.evaluate(f"async (argument) => {{ {_IMPORTED} {script} }}", argument)


def link_of(page: Page) -> str:
    """The hash of the address once it holds the newest state."""
    page.wait_for_timeout(400)
    return str(page.evaluate("location.hash"))
