"""A figure is computed by the server: what arithmetic of figures the page still has is listed here."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

APP = Path(__file__).parents[2] / "frontend" / "app" / "js"

#: What makes a figure of numbers: roots, sums, means, percentages of a quotient; a share in percent is none.
MAKES = re.compile(
    r"Math\.(?:sqrt|hypot)\("
    r"|\.reduce\([^;]{0,60}?=> *\w+ \+"
    r"|\b(?:sum|squares|total)\w* \+="
    r"|\b100 \* \(?[^;,{}=`]{1,30}\)? / "
    r"|/ \w+(?:\.\w+)*\.length\b"
)
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)

#: File -> how often it does so, and for what.
DRAWS = {
    # Pictures: places, widths, numbers of bins and of what is drawn.
    "measurement/picture.js": 4,  # height of a panel; which way a stroke runs beside the pressure
    "ui/field.js": 1,  # place of a slider
    "views/compare/ladder.js": 1,  # width of a bar
    "views/compare/list/entry.js": 2,  # width of a bar
    "views/compare/list/sketch.js": 2,  # which of several channels a sketch shows
    "views/compare/where/heat.js": 1,  # height of a row
    "views/compare/where/leftover.js": 1,  # a normal curve beside a histogram
    "views/compare/where/parts.js": 4,  # whole percents that add up to 100, and the word beside them
    "views/compare/where/specs.js": 1,  # whether there are many points
    "views/design/errors.js": 1,  # width of a bar
    "views/sizing/front.js": 1,  # the nearest point
    "views/studies/charts.js": 1,  # number of bins
    "views/studies/summary.js": 1,  # width of a bar
    "views/transient/motion/pair-picture.js": 1,  # outline of a braid
    # Counts of what the user sees or asks for.
    "measurement/asks.js": 1,  # rows left out
    "views/compare/board/rows.js": 1,  # fitted values
    "views/compare/measurement/card.js": 1,  # rows left out
    # How far two shown numbers are apart that the user has put side by side, and the fit of a pasted table.
    "format.js": 1,
    "views/transient/inputs/table-file.js": 1,
    "views/transient/inputs/panel.js": 1,
}


def made(code: str) -> int:
    """How often a module makes a figure."""
    return len(MAKES.findall(_COMMENT.sub("", code)))


def test_the_page_makes_no_figure_that_is_not_listed() -> None:
    found = {str(path.relative_to(APP)): made(path.read_text("utf-8")) for path in APP.rglob("*.js")}
    assert Counter(found) - Counter(DRAWS) == Counter(), "let the server answer it"
    assert Counter(DRAWS) - Counter(found) == Counter(), "these are gone: shorten the list"


def test_a_planted_figure_is_found() -> None:
    planted = (
        "const rms = Math.sqrt(squares / n);",
        "s.residual.forEach((r) => { sum += r; });",
        "const mean = values.reduce((a, b) => a + b, 0) / values.length;",
        "h('b', null, 100 * (a.rmse - b.rmse) / b.rmse)",
    )
    assert [bool(made(code)) for code in planted] == [True] * len(planted)
    assert made("const percent = 100 * share; // Math.sqrt(") == 0
