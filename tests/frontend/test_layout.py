"""Nothing scrolls sideways, results come before inputs on a phone, targets are large enough."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page

from tests.frontend.guard import PageGuard
from tests.frontend.views import SIZES, open_catalogue, open_compare, open_compared, open_design, run

pytestmark = pytest.mark.kept_page

OPENERS = {
    "design": open_design,
    "catalogue": open_catalogue,
    "compare, empty": open_compare,
    "compare": open_compared,
}


SIDEWAYS = """
const clips = (el) => el.closest(".scroll, .plot, nav, dialog, [hidden], .unseen, .equation");
const out = [...document.querySelectorAll("#main *")].filter((el) =>
  !clips(el) && el.checkVisibility() && el.getBoundingClientRect().right > innerWidth + 1);
return { page: document.documentElement.scrollWidth - innerWidth,
  out: out.slice(0, 5).map((el) => el.outerHTML.slice(0, 90)) };
"""


# Whether the boxes of two neighbours in a head cross.
OVERLAPS = """
const found = [];
for (const head of document.querySelectorAll(".card-head, .field-head, .effect-head")) {
  const boxes = [...head.children].filter((el) => el.checkVisibility())
    .map((el) => [el.getBoundingClientRect(), el]).filter(([b]) => b.width > 0);
  boxes.forEach(([a, one], i) => boxes.slice(i + 1).forEach(([b]) => {
    const aside = a.left > b.right - 1 || b.left > a.right - 1;
    const above = a.top > b.bottom - 1 || b.top > a.bottom - 1;
    if (!aside && !above) found.push(one.textContent);
  }));
}
return found;
"""

TOO_SMALL = """
const all = document.querySelectorAll("button, select, input, summary, a[href], label.switch");
return [...all].filter((el) => el.checkVisibility() && !el.matches(".skip, label input"))
  .map((el) => [el.getBoundingClientRect(), el.outerHTML.slice(0, 90)])
  .filter(([box]) => box.width < 23.5 || box.height < 23.5).map(([, html]) => html);
"""


# Boxes that scroll sideways; the first rows of a file and a long equation have no other way.
SCROLLS = """
return [...document.querySelectorAll("#main .scroll")]
  .filter((el) => el.checkVisibility() && el.scrollWidth > el.clientWidth + 2).map((el) => el.ariaLabel);
"""

# From the legend of the case's plot to its axes [px].
GAP = """
const axes = document.querySelector("#overlay-force .bglayer"), card = axes?.closest(".card");
if (!card?.checkVisibility()) return null;
return axes.getBoundingClientRect().top - card.querySelector(".legend").getBoundingClientRect().bottom;
"""

# Decimals of the numbers along the axes of the map; a 0 has none.
MAP_DECIMALS = """
const texts = [...document.querySelectorAll(".heat .foot-row th")].map((el) => el.textContent);
return [...new Set(texts.filter((text) => Number(text)).map((text) => text.split(".")[1]?.length ?? 0))];
"""


@pytest.mark.parametrize("view", OPENERS)
def test_every_width(page: Page, page_guard: PageGuard, view: str) -> None:
    """No sideways scroll, no overlaps, targets of at least 24 px."""
    OPENERS[view](page)
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_timeout(300)  # Plotly draws again at the new size
        wide = run(page, SIDEWAYS)
        assert wide["page"] <= 0, width
        assert wide["out"] == [], width
        assert run(page, OVERLAPS) == [], width
        assert run(page, TOO_SMALL) == [], width
        if width < 700:
            assert run(page, SCROLLS) == [], width
        gap = run(page, GAP)
        assert gap is None or gap <= 40, width
        assert len(run(page, MAP_DECIMALS)) <= 1, width


def test_the_answer_comes_first_on_a_phone_and_plots_follow_the_width(page: Page) -> None:
    page.set_viewport_size({"width": 1440, "height": 1000})
    open_design(page)
    page.set_viewport_size({"width": 390, "height": 844})
    tops = run(
        page,
        """
        const top = (what) => document.querySelector(what).getBoundingClientRect().top;
        return [".answer-card", "#force", "#rmse", ".tables"].map(top);
        """,
    )
    assert tops == sorted(tops)
    assert tops[0] < 500  # the answer is in sight without scrolling
    page.wait_for_timeout(300)
    sizes = run(
        page,
        """
        const host = document.querySelector("#force"), svg = host.querySelector(".main-svg");
        return [host.clientWidth, svg.getBoundingClientRect().width];
        """,
    )
    assert abs(sizes[0] - sizes[1]) <= 1
