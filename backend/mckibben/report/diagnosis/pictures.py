"""A model beside the data: measured and modelled, and the residual."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from mckibben.application.compare import ComparisonResult
from mckibben.application.compared_series import ComparedSeries
from mckibben.report.chart import chart, family
from mckibben.report.document import figure_of
from mckibben.report.figures import variable
from mckibben.report.html import Html, html
from mckibben.report.marks import ACCENT, EDGE, SECOND, Axis, Band, Dots, Line, Mark

_MOST_POINTS = 250  # of a series in a drawing
_FEW_POINTS = 300  # of all series: dots are drawn larger
_LEFT = 84.0  # where the axes of both drawings begin


def pictures(answer: ComparisonResult, name: str) -> Html:
    """Overlay and residual of every predicted channel; ``name`` is the model's."""
    parts = [_all(answer.series, answer, name)]
    if answer.validation:
        parts.append(_all(answer.validation.series, answer, f"{name} on the validation data"))
    return html(parts)


def _all(every: Sequence[ComparedSeries], answer: ComparisonResult, name: str) -> Html:
    channels = dict.fromkeys(series.channel for series in every)
    return html(
        _channel([series for series in every if series.channel == channel], answer, channel, name)
        for channel in channels
    )


def _channel(every: Sequence[ComparedSeries], answer: ComparisonResult, channel: str, name: str) -> Html:
    words, scale = variable(channel)
    key = _across(every, answer.kind)
    over, x_scale = variable("pressure" if key == "x_pressure" else key)
    single, scattered = len(every) == 1, _scattered(every, answer.kind)
    colours = [ACCENT] * len(every) if single or scattered else family(len(every))
    size = 5.0 if sum(len(series.measured) for series in every) < _FEW_POINTS else 3.0
    dots: list[Mark] = []
    lines: list[Mark] = []
    errors: list[Mark] = []
    for series, colour in zip(every, colours, strict=True):
        rows = _rows(series, key, sort=answer.kind in ("static", "diameter"))
        across = x_scale.all(_values(getattr(series, key))[rows])
        measured, predicted, residual = (
            scale.all(_values(getattr(series, part))[rows]) for part in ("measured", "predicted", "residual")
        )
        of_dots, of_line = _labels(series, single)
        dots.append(Dots(across, measured, of_dots, colour, size))
        lines.append(Line(across, predicted, of_line, SECOND if single else colour, width=1.6))
        errors.append(Dots(across, residual, "", colour, size))
    noise = answer.channels[channel].noise_floor if answer.channels else answer.noise_floor
    told = "Residual (measured minus modelled)" + ("." if single or scattered else ", colours as above.")
    if noise is not None:
        wide = 2.0 * scale.of(noise)
        errors.insert(0, Band(-wide, wide, "± 2 × noise"))
        told += " The grey band is twice the noise of the data."
    x, about = Axis(over.capitalize(), x_scale.unit), f"{words} over {over}"
    if scattered:
        overlay, legend = _parity(every, channel, size), f"{words.capitalize()} by the {name} over measured."
    else:
        overlay = chart(
            x, Axis(words.capitalize(), scale.unit), [*dots, *lines],
            title=f"Measured and modelled {about}", left=_LEFT, legend=True,
        )  # fmt: skip
        legend = f"{words.capitalize()}: dots are measured, lines are the {name}."
    below = chart(
        x, Axis(f"Residual of {words}", scale.unit, zero=True), errors,
        title=f"Residual of {about}", height=230.0, left=_LEFT, legend=True,
    )  # fmt: skip
    return html(
        figure_of(overlay, legend),
        figure_of(below, told),
    )


def _scattered(every: Sequence[ComparedSeries], kind: str) -> bool:
    """Points of a map that follow no line: most series hold neither pressure nor length."""
    if kind not in ("static", "diameter"):
        return False
    whole = _span(np.concatenate([_values(series.contraction) for series in every]))
    loose = [s.pressure is None and _span(_values(s.contraction)) > 0.05 * whole for s in every]
    return 2 * sum(loose) > len(every)


def _parity(every: Sequence[ComparedSeries], channel: str, size: float) -> Html:
    """Modelled over measured, beside the line on which both are the same."""
    words, scale = variable(channel)
    measured, modelled = (
        scale.all(np.concatenate([_values(getattr(s, part)) for s in every]))
        for part in ("measured", "predicted")
    )
    ends = [min(measured), max(measured)]
    return chart(
        Axis(f"Measured {words}", scale.unit), Axis(f"Modelled {words}", scale.unit),
        [Line(ends, ends, "the same", EDGE), Dots(measured, modelled, "rows", ACCENT, size)],
        title=f"Modelled over measured {words}", left=_LEFT, legend=True,
    )  # fmt: skip


def _across(every: Sequence[ComparedSeries], kind: str) -> str:
    """What the series run over: time for transients, else what changes most within them."""
    if kind == "transient" and every[0].time is not None:
        return "time"
    best, share = "contraction", 0.0
    for key in ("contraction", "x_pressure"):
        values = [_values(getattr(series, key)) for series in every]
        whole = _span(np.concatenate(values))
        inner = float(np.mean([_span(v) for v in values])) / whole if whole > 0.0 else 0.0
        if inner > share + 0.05:
            best, share = key, inner
    return best


def _span(values: np.ndarray) -> float:
    known = values[np.isfinite(values)]
    return float(np.ptp(known)) if len(known) else 0.0


def _values(values: Iterable[Any]) -> np.ndarray:
    return np.array(list(values), dtype=float)


def _rows(series: ComparedSeries, key: str, *, sort: bool) -> np.ndarray:
    """Rows to draw: not too many; in the order of x where the measurement has none of its own."""
    count = len(series.measured)
    rows = np.unique(np.linspace(0, count - 1, min(count, _MOST_POINTS)).astype(int))
    return rows[np.argsort(_values(getattr(series, key))[rows], kind="stable")] if sort else rows


def _labels(series: ComparedSeries, single: bool) -> tuple[str, str]:
    """Legend of dots and line: one entry for both where there are several series."""
    return ("measured", "model") if single else (series.label, series.label)
