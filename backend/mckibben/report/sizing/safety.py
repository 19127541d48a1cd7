"""Margin to each limit, and the probability that a built drive fulfils the task."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.facts.muscle import CHARACTERISTICS
from mckibben.facts.sizing import LIMITS, SIZING
from mckibben.report.bars import Bar, bars
from mckibben.report.document import Head, bullets, callout, heading, mark, paragraph, table
from mckibben.report.figures import figure, plain
from mckibben.report.html import Child, Html, html, tag
from mckibben.report.sizing.material import Chosen, Margin, SpecimenSpread
from mckibben.report.sizing.words import NEWTON, SHARE, shown

_USED_UP = 0.005  # margin below which a limit counts as used up
_FREE = ("length", "pressure", "contraction")  # values chosen by the search
_TIMES = ("time", "time_down", "cycle_time")  # limits that a specimen has to keep
_LONGEST = 1.0  # longest bar: larger margins make no difference


def margins_section(chosen: Chosen) -> Html:
    """Table of the margins with a bar for each, the smallest first."""
    nearest = chosen.margins[0]
    drawn = bars(
        [
            Bar(f"Margin {_left(margin)}", min(max(margin.share, 0.0), _LONGEST), strong=margin is nearest)
            for margin in chosen.margins
        ],
        level=_LONGEST if max(margin.share for margin in chosen.margins) < _LONGEST else None,
    )
    caption = (
        f"The nearest limit is {LIMITS[nearest.name].words}. {SIZING['margins'].label}: "
        f"{SIZING['margins'].definition} A full bar is 100 % or more."
    )
    columns = [
        Head("Limit"), Head("Required", number=True), Head("This drive", number=True),
        Head(SIZING["margins"].label, number=True), Head("", bar=True),
    ]  # fmt: skip
    body = [
        [
            LIMITS[margin.name].label,
            html("at most " if margin.upper else "at least ", _value(margin, margin.allowed)),
            _value(margin, margin.actual),
            tag("data", _left(margin), value=repr(float(margin.share))),
            bar,
        ]
        for margin, bar in zip(chosen.margins, drawn, strict=True)
    ]
    parts: list[Child] = [table(columns, body, caption=caption)]
    if nearest.name in _FREE and nearest.share < _USED_UP:
        parts.append(
            paragraph(
                "A length, pressure or contraction at its limit is a choice, not a fault: the search uses "
                "what is allowed where less would cost air or time. The tolerance of the supply pressure is "
                "covered by the specimens below.",
                note=True,
            )
        )
    return html(parts)


def _left(margin: Margin) -> str:
    """The margin as its bar shows it."""
    return "> 100 %" if margin.share > _LONGEST else f"{plain(100.0 * margin.share, 2)} %"


def _value(margin: Margin, value: float) -> Html:
    if margin.name == "force":
        return html(figure(value, digits=3), " × the load")
    return shown(value, LIMITS[margin.name], exact=True)


def uncertainty_section(chosen: Chosen) -> Html:
    """The probability, its meaning, and what varies between the specimens."""
    proposal, spread = chosen.proposal, chosen.spread
    if spread is None or proposal.probability is None or proposal.probability_error is None:
        return paragraph(
            "No specimens were simulated, because the task requests none. How many built drives would fulfil "
            "the task is unknown."
        )
    share, error = 100.0 * proposal.probability, 100.0 * proposal.probability_error
    low, high = (max(share - 2.0 * error, 0.0), min(share + 2.0 * error, 100.0))
    parts: list[Child] = [
        callout(
            f"{share:.3g} % of {proposal.specimens} simulated specimens succeed",
            f"{SIZING['probability_error'].label} {error:.2g} %: "
            f"with many more specimens the share would be between {low:.3g} "
            f"and {high:.3g} % (two standard errors).",
        ),
        paragraph("A specimen succeeds if"),
        bullets(spread.demands),
        heading("What differs between specimens"),
        _spread_table(spread),
        paragraph("All muscles of a drive deviate equally, as in one batch: the worst case."),
        heading("What this share means"),
        bullets(
            [
                SIZING["probability"].definition,
                html(
                    "The spread itself is an assumption ", mark("not measured on these parts"), "; "
                    "change it in the task if you know better.",
                ),
                "Not varied: flow of valve and tube, load, stroke, temperature, mounting. If their figures "
                "are not verified, neither is the share.",
                *_at_rest(chosen.margins),
            ]
        ),
    ]  # fmt: skip
    return html(parts)


def _at_rest(margins: Sequence[Margin]) -> list[str]:
    """The limits that no specimen is asked for."""
    names = [LIMITS[margin.name].words for margin in margins if margin.name not in _TIMES]
    return [f"Limits at rest that no specimen is asked for: {', '.join(names)}."] if names else []


def _spread_table(spread: SpecimenSpread) -> Html:
    columns = [
        Head("What"),
        Head("Distribution"),
        Head("Size"),
        Head("What it means for this drive"),
    ]
    rows: list[list[Child]] = [
        [
            CHARACTERISTICS["blocked_force"].label,
            "normal",
            html("± ", figure(spread.blocked_force, SHARE, 3, exact=True), " (two standard deviations)"),
            html(
                "the curve shifted along the contraction by ± ", figure(2.0 * spread.shift, SHARE, 2),
                " of the length (two standard deviations)",
            ),
        ],
        [
            "Hysteresis",
            "uniform, from the loop of the model to the whole loop",
            mark("unknown for this muscle")
            if spread.hysteresis is None
            else html(figure(spread.hysteresis, SHARE, 3, exact=True), " of the rest length wide"),
            "assumed to be zero, so the share is too high"
            if spread.hysteresis is None
            else html(
                "up to ", figure(spread.friction, NEWTON, 3),
                " of each muscle against the motion, beyond its friction in the model",
            ),
        ],
        [
            "Supply pressure",
            "uniform",
            html("± ", figure(spread.supply, SHARE, 3, exact=True), " (the largest deviation)"),
            "the pressure at the valve",
        ],
    ]  # fmt: skip
    return table(columns, rows)
