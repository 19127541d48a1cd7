"""How far each limit is kept, and how likely what is built does the task."""

from __future__ import annotations

from mckibben.report.bars import Bar, bars
from mckibben.report.document import Head, bullets, callout, figure_of, heading, mark, paragraph, table
from mckibben.report.figures import figure, percent, plain
from mckibben.report.html import Child, Html, html
from mckibben.report.sizing.material import Chosen, Margin, SpecimenSpread
from mckibben.report.sizing.words import NEWTON, SHARE, in_unit, limit_name

_USED_UP = 0.005
_FREE = ("length", "pressure", "contraction")  # what the search chooses by itself
_LONGEST = 1.0  # a bar: more than twice the limit is more than enough


def margins_section(chosen: Chosen) -> Html:
    """Every limit as a bar and as a row; the nearest first."""
    nearest = chosen.margins[0]
    rows = [
        Bar(
            limit_name(margin.name),
            100.0 * min(max(margin.share, 0.0), _LONGEST),
            f"{plain(100.0 * margin.share, 2)} %",
            strong=margin is nearest,
        )
        for margin in chosen.margins
    ]
    drawing = bars(rows, axis="Left to the limit [%]", title="Margins to the limits")
    told = (
        f"Margins; the nearest limit is {limit_name(nearest.name).lower()}. 0 % is the limit itself; bars "
        "end at 100 %."
    )
    columns = [
        Head("Limit"), Head("Allowed or wanted", number=True), Head("This drive", number=True),
        Head("Left", number=True),
    ]  # fmt: skip
    body = [
        [
            limit_name(margin.name),
            html("at most " if margin.upper else "at least ", _value(margin, margin.allowed)),
            _value(margin, margin.actual),
            percent(margin.share, 3),
        ]
        for margin in chosen.margins
    ]
    parts: list[Child] = [figure_of(drawing, told), table(columns, body)]
    if nearest.name in _FREE and nearest.share < _USED_UP:
        parts.append(
            paragraph(
                "Room, pressure and contraction that are used up are a choice, not a fault: the search takes "
                "what is allowed where less would cost air or time. The tolerance of the supply is part of "
                "the specimens below.",
                note=True,
            )
        )
    return html(parts)


def _value(margin: Margin, value: float) -> Html:
    if margin.name == "force":
        return html(figure(value, digits=3), " × the load")
    return in_unit(value, margin.unit)


def uncertainty_section(chosen: Chosen) -> Html:
    """The probability, what it is a share of, what varies and what does not."""
    found, spread = chosen.proposal, chosen.spread
    if spread is None or found.probability is None or found.probability_error is None:
        return paragraph(
            "No specimens were simulated, because the task asks for none: how likely the drive does the task "
            "when it is built is not known."
        )
    share, error = 100.0 * found.probability, 100.0 * found.probability_error
    low, high = (max(share - 2.0 * error, 0.0), min(share + 2.0 * error, 100.0))
    parts: list[Child] = [
        callout(
            f"{share:.3g} % of {found.specimens} simulated specimens do the task",
            f"Standard error {error:.2g} %: more specimens of the same kind would show between {low:.3g} and "
            f"{high:.3g} % (two standard errors).",
        ),
        paragraph("A specimen does the task when it"),
        bullets(spread.demands),
        heading("What differs between specimens"),
        _spread_table(spread),
        paragraph("All muscles of a drive deviate together, as those of one batch do: the harder case."),
        heading("What the probability means"),
        bullets(
            [
                "It is the share of simulated specimens, under the spread above, that keep the times and the "
                "end of the stroke. It is no failure rate and says nothing about wear.",
                html(
                    "The spread itself is an assumption ", mark("not measured on these parts"), ": with "
                    "another one in the task the probability changes.",
                ),
                "Not varied: flow of valve and tube, load, stroke, temperature, mounting. Where their "
                "figures are not verified, the probability rests on them all the same.",
                "Limits at rest (length, diameter, forces the maker allows) are not part of it; their "
                "margins stand above.",
            ]
        ),
    ]  # fmt: skip
    return html(parts)


def _spread_table(spread: SpecimenSpread) -> Html:
    columns = [
        Head("What"),
        Head("Distribution"),
        Head("Size"),
        Head("What it means for this drive"),
    ]
    rows: list[list[Child]] = [
        [
            "Blocked force",
            "normal",
            html("± ", figure(spread.blocked_force, SHARE, 3, exact=True), " (two standard deviations)"),
            html(
                "the curve shifted along the contraction by ± ", figure(2.0 * spread.shift, SHARE, 2),
                " of the length",
            ),
        ],
        [
            "Hysteresis",
            "even, from the loop of the model to the whole loop",
            mark("not known of this muscle")
            if spread.hysteresis is None
            else html(figure(spread.hysteresis, SHARE, 3, exact=True), " of the nominal length wide"),
            "none was assumed: the probability is too high by what it would cost"
            if spread.hysteresis is None
            else html(
                "up to ", figure(spread.friction, NEWTON, 3),
                " of each muscle against the motion, beyond its friction in the model",
            ),
        ],
        [
            "Supply pressure",
            "even",
            html("± ", figure(spread.supply, SHARE, 3, exact=True)),
            "the pressure at the valve",
        ],
    ]  # fmt: skip
    return table(columns, rows)
