"""The error over windows beside that of the run: what grows with time, and what is wrong at once."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from mckibben.facts.comparison import WINDOWS, error_scale
from mckibben.facts.result import Number, result_class
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.windows import WindowErrors, window_errors
from mckibben.identification.residual.digits import brief

_AT_NOISE = 1.3  # error over that of a perfect model, up to which it shows nothing else
_MOST_NOISE = 0.05  # of the largest reading; more from row to row is motion, of which few rows show a swing
_FAR_LESS = 0.5  # of the error of the run beyond noise; windows that have less do not have what builds up


@result_class
class WindowsResult:
    """The error over windows, each of which begins anew from what was measured; in the unit of the error."""

    FIGURES: ClassVar = WINDOWS.name

    length: float
    count: int
    rmse: Number
    perfect: Number
    of_run: Number
    """RMS error of the whole run at the rows of the windows."""
    sentence: str
    """What both errors together say."""


def windows_result(
    predictor: Predictor, fit_model: FitModel, noise: float | None
) -> tuple[WindowsResult | None, str]:
    """The error over windows, and why there is none; "" where there is one, or the data have no time.

    Args:
        predictor: the compared rows.
        fit_model: the compared model.
        noise: of the only channel where it is stated [SI].
    """
    found = window_errors(predictor, fit_model, noise)
    if not isinstance(found, WindowErrors):
        return None, found or ""
    largest = float(np.max(np.abs(predictor.measured / predictor.scale)))
    if noise is None and found.noise > _MOST_NOISE * largest:
        return None, "no windows: too few rows a swing to tell noise from motion; state the noise"
    sentence = _sentence(found, predictor.unit)
    return WindowsResult(found.length, found.count, found.rmse, found.perfect, found.of_run, sentence), ""


def _sentence(found: WindowErrors, unit: str) -> str:
    scale = error_scale(unit)
    run, windows, perfect = (
        f"{brief(scale.of(value))} {scale.unit}" for value in (found.of_run, found.rmse, found.perfect)
    )
    return (
        f"Error of the run {run}; over {found.count} windows of {found.length:g} s, each begun from the "
        f"measurement, {windows} (a perfect model {perfect}). {_reading(found)}"
    )


def _reading(found: WindowErrors) -> str:
    """What the two errors say."""
    run, windows, perfect, noise = found.of_run, found.rmse, found.perfect, found.noise
    if perfect > _AT_NOISE * noise > 0.0 and perfect >= run:
        return "The readings that the windows begin with cost more than the run has, so they say nothing"
    if run <= _AT_NOISE * noise and windows <= _AT_NOISE * perfect:
        return "Both are noise"
    beyond_run = max(run**2 - noise**2, 0.0) ** 0.5
    beyond_windows = max(windows**2 - perfect**2, 0.0) ** 0.5
    if beyond_windows < _FAR_LESS * beyond_run:
        return "Most of the error of the run builds up over more than a window: a slow error, or one of phase"
    return "The error is there within each window: one of shape, which does not build up"
