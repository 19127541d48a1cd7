"""Plots of measured and modelled values, and of the residual."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

import numpy as np

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.compare.series import ComparedSeries
from mckibben.report.chart import chart, family
from mckibben.report.document import figure_of
from mckibben.report.figures import variable
from mckibben.report.html import Html, html, tag
from mckibben.report.marks import ACCENT, EDGE, SECOND, Axis, Band, Dots, Line, Mark

_MOST_POINTS = 250  # of a series in a drawing
_FEW_POINTS = 300  # of all series: below, dots are drawn larger
_LEFT = 84.0  # where the axes of both drawings begin, below each other
_WIDE, _NARROW, _HIGH, _ROOM = 450.0, 270.0, 200.0, 88.0  # beside each other; room of the legend


def pictures(answer: ComparisonResult, name: str) -> Html:
    """Overlay and residual of every predicted channel; ``name`` is the model's."""
    parts = [_channels(answer.series, answer, name)]
    if answer.validation:
        parts.append(_channels(answer.validation.series, answer, f"{name} on the validation data"))
    return html(parts)


def _channels(all_series: Sequence[ComparedSeries], answer: ComparisonResult, name: str) -> Html:
    channels = dict.fromkeys(series.channel for series in all_series)
    return html(
        _channel([series for series in all_series if series.channel == channel], answer, channel, name)
        for channel in channels
    )


def _channel(all_series: Sequence[ComparedSeries], answer: ComparisonResult, channel: str, name: str) -> Html:
    words, scale = variable(channel)
    key = _across(all_series, answer.kind)
    over, x_scale = variable("pressure" if key == "x_pressure" else key)
    only_one, scattered = len(all_series) == 1, _scattered(all_series, answer.kind)
    colours = [ACCENT] * len(all_series) if only_one or scattered else family(len(all_series))
    size = 5.0 if sum(len(series.measured) for series in all_series) < _FEW_POINTS else 3.0
    dots: list[Mark] = []
    lines: list[Mark] = []
    errors: list[Mark] = []
    for series, colour in zip(all_series, colours, strict=True):
        rows = _rows(series, key, sort=answer.kind in ("static", "diameter"))
        across = x_scale.all(_values(getattr(series, key))[rows])
        measured, predicted, residual = (
            scale.all(_values(getattr(series, part))[rows]) for part in ("measured", "predicted", "residual")
        )
        of_dots, of_line = _labels(series, only_one)
        dots.append(Dots(across, measured, of_dots, colour, size))
        lines.append(Line(across, predicted, of_line, SECOND if only_one else colour, width=1.6))
        errors.append(Dots(across, residual, "", colour, size))
    noise = answer.channels[channel].noise_floor if answer.channels else answer.noise_floor
    caption = "Residual (measured minus modelled)" + ("." if only_one or scattered else ", colours as above.")
    if noise is not None:
        wide = 2.0 * scale.of(noise)
        errors.insert(0, Band(-wide, wide, "± 2 × noise"))
        caption += " Grey band: twice the noise of the data."
    x, about = Axis(over.capitalize(), x_scale.unit), f"{words} over {over}"
    beside = key != "time"  # a trace needs the whole width
    left_one, right_one = (
        (partial(chart, width=_WIDE, height=_HIGH, room=_ROOM), partial(chart, width=_NARROW, height=_HIGH))
        if beside
        else (partial(chart, height=190.0, left=_LEFT), partial(chart, height=140.0, left=_LEFT))
    )
    if scattered:
        overlay, legend = (
            _parity(all_series, channel, size, left_one),
            f"{words.capitalize()} by the {name} over measured.",
        )
    else:
        overlay = left_one(
            x, Axis(words.capitalize(), scale.unit), [*dots, *lines],
            title=f"Measured and modelled {about}", legend=True,
        )  # fmt: skip
        legend = f"{words.capitalize()}: dots are measured, lines are the {name}."
    below = right_one(
        x, Axis(f"Residual of {words}", scale.unit, zero=True), errors,
        title=f"Residual of {about}", legend=not beside,
    )  # fmt: skip
    if beside:
        return figure_of(tag("div", overlay, below, class_="beside"), f"{legend} {caption}")
    return html(
        figure_of(overlay, legend),
        figure_of(below, caption),
    )


def _scattered(all_series: Sequence[ComparedSeries], kind: str) -> bool:
    """Whether the points form no lines: in most series neither pressure nor length is constant."""
    if kind not in ("static", "diameter"):
        return False
    whole = _span(np.concatenate([_values(series.contraction) for series in all_series]))
    varies = [s.pressure is None and _span(_values(s.contraction)) > 0.05 * whole for s in all_series]
    return 2 * sum(varies) > len(all_series)


def _parity(
    all_series: Sequence[ComparedSeries], channel: str, size: float, draw: Callable[..., Html]
) -> Html:
    """Modelled over measured values, with the line of equality."""
    words, scale = variable(channel)
    measured, modelled = (
        scale.all(np.concatenate([_values(getattr(s, part)) for s in all_series]))
        for part in ("measured", "predicted")
    )
    ends = [min(measured), max(measured)]
    return draw(
        Axis(f"Measured {words}", scale.unit), Axis(f"Modelled {words}", scale.unit),
        [Line(ends, ends, "equal", EDGE), Dots(measured, modelled, "rows", ACCENT, size)],
        title=f"Modelled over measured {words}", legend=True,
    )  # fmt: skip


def _across(all_series: Sequence[ComparedSeries], kind: str) -> str:
    """x axis of the series: time for transients, else the variable that changes most within a series."""
    if kind == "transient" and all_series[0].time is not None:
        return "time"
    best, best_share = "contraction", 0.0
    for key in ("contraction", "x_pressure"):
        values = [_values(getattr(series, key)) for series in all_series]
        whole = _span(np.concatenate(values))
        inner = float(np.mean([_span(v) for v in values])) / whole if whole > 0.0 else 0.0
        if inner > best_share + 0.05:
            best, best_share = key, inner
    return best


def _span(values: np.ndarray) -> float:
    known = values[np.isfinite(values)]
    return float(np.ptp(known)) if len(known) else 0.0


def _values(values: Iterable[Any]) -> np.ndarray:
    return np.array(list(values), dtype=float)


def _rows(series: ComparedSeries, key: str, *, sort: bool) -> np.ndarray:
    """Indices of at most `_MOST_POINTS` rows to draw; sorted by x if their order has no meaning."""
    count = len(series.measured)
    rows = np.unique(np.linspace(0, count - 1, min(count, _MOST_POINTS)).astype(int))
    return rows[np.argsort(_values(getattr(series, key))[rows], kind="stable")] if sort else rows


def _labels(series: ComparedSeries, single: bool) -> tuple[str, str]:
    """Legend entries of dots and line; with several series they share one."""
    return ("measured", "model") if single else (series.label, series.label)
