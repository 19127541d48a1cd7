"""Figures of the linear view: Bode diagram with describing points, steps of designed controllers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mckibben.application.linear.result import LinearResult
from mckibben.door.figures.style import (
    ACCENT,
    LOAD,
    SECOND,
    SOFT,
    add_line,
    add_points,
    blank,
    colours,
    name_axes,
)

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

_DASHES = ("dash", "dot", "dashdot", "longdash")


def bode_figure(result: LinearResult, title: str) -> Figure:
    """Gain and phase of each model over frequency, with the nonlinear drive under sines."""
    figure = blank(title, rows=2)
    others = 0
    for model in result.models:
        colour = ACCENT if model.primary else SOFT
        dash = None if model.primary else _DASHES[others % len(_DASHES)]
        others += 0 if model.primary else 1
        add_line(figure, result.frequency, _decibels(model.gain), model.name, colour=colour, dash=dash)
        degrees = np.degrees(model.phase)
        add_line(figure, result.frequency, degrees, model.name, colour=colour, dash=dash, row=2, legend=False)
    amplitudes = sorted({point.amplitude for point in result.describing})
    scale, unit = (100.0, " %") if result.input.unit == "1" else (1.0, f" {result.input.unit}")
    for amplitude, colour in zip(amplitudes, colours(len(amplitudes)), strict=True):
        points = [
            each for each in result.describing if each.amplitude == amplitude and each.gain == each.gain
        ]
        at = [point.frequency for point in points]
        name = f"nonlinear, {scale * amplitude:.3g}{unit}"
        add_points(figure, at, _decibels(np.array([p.gain for p in points])), name, colour=colour)
        phases = np.degrees([point.phase for point in points])
        add_points(figure, at, phases, name, colour=colour, row=2, legend=False)
    figure.update_xaxes(type="log")
    name_axes(figure, "Frequency (Hz)", [f"Gain (dB re 1 {result.gain_unit})", "Phase (°)"])
    return figure


def design_figure(result: LinearResult, title: str) -> Figure:
    """Position and command of each controller's step on the nonlinear drive."""
    figure = blank(title, rows=2)
    design = result.design
    if design is None:
        return figure
    for trial, colour in zip(reversed(design.trials), (ACCENT, SECOND, LOAD), strict=False):
        add_line(figure, trial.time, 1e3 * trial.position, trial.name, colour=colour)
        add_line(figure, trial.time, 100.0 * trial.command, trial.name, colour=colour, row=2, legend=False)
    last = design.trials[-1]
    add_line(figure, last.time, 1e3 * last.reference, "reference", colour=SOFT, dash="dash")
    name_axes(figure, "Time (s)", ["Position (mm)", "Command (%)"])
    return figure


def _decibels(gain: np.ndarray) -> np.ndarray:
    return 20.0 * np.log10(np.maximum(gain, 1e-300))
