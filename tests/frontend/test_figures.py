"""A figure is computed by the server: what arithmetic of figures the page still has is listed here."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

APP = Path(__file__).parents[2] / "frontend" / "app" / "js"

#: What makes a figure of numbers: functions, sums, means, percents of a quotient; a share in percent is not.
MAKES = re.compile(
    r"Math\.(?:sqrt|hypot|sin|cos|tan|exp|log)\("
    r"|\.reduce\([^;]{0,60}?=> *\w+ \+"
    r"|\b(?:sum|squares|total)\w* \+="
    r"|\b100 \* \(?[^;,{}=`]{1,30}\)? / "
    r"|/ \w+(?:\.\w+)*\.length\b"
    r"|/ n\b"
)
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)

#: File -> how often it does so, and for what.
DRAWS = {
    # Pictures: places, widths, numbers of bins and of what is drawn.
    "measurement/picture.js": 4,  # height of a panel; which way a stroke runs beside the pressure
    "ui/field.js": 4,  # place of a slider, on a logarithmic scale too
    "views/compare/ladder.js": 1,  # width of a bar
    "views/compare/list/entry.js": 2,  # width of a bar
    # A sketch without axes or numbers: which of several channels it shows, and the means of few bins for its
    # dots; the figures of the effect stand beside it and are the server's.
    "views/compare/list/sketch.js": 5,
    "views/compare/strip/number.js": 3,  # height of a point on a logarithmic scale
    "views/compare/where/heat.js": 1,  # height of a row
    "views/compare/where/leftover.js": 2,  # a normal curve beside a histogram
    # Shares of the server as whole percents that add up to 100.
    "views/compare/where/parts.js": 3,
    "views/compare/where/residual-spec.js": 1,  # points of one direction beside each other
    "views/compare/where/specs.js": 1,  # whether there are many points
    "views/design/errors.js": 1,  # width of a bar
    "views/design/residuals.js": 1,  # the nearest point
    "views/sizing/front.js": 1,  # the nearest point
    "views/studies/charts.js": 1,  # number of bins
    "views/studies/summary.js": 1,  # width of a bar
    # Counts of what the user sees or asks for.
    "measurement/asks.js": 1,  # rows left out
    "views/compare/board/rows.js": 1,  # fitted values
    "views/compare/measurement/card.js": 1,  # rows left out
    # The percent of change of two numbers that both stand beside it: a column of the ladder, the board, the
    # paper or of pinned runs against the one that the user has made the base. The pair is chosen on the
    # page, from answers that the server gave at different times; a reader checks it by the two numbers.
    "format.js": 1,
    # Inputs: ends of a range for a distribution when the method changes, a long pasted table thinned out and
    # how far that goes.
    "views/studies/forms.js": 2,
    "views/transient/inputs/table-file.js": 1,
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
        "const thread = length / Math.cos(angle);",
        "return { seen: seen / n };",
    )
    assert [bool(made(code)) for code in planted] == [True] * len(planted)
    assert made("const percent = 100 * share; // Math.sqrt(") == 0
