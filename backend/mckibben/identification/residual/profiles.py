"""Where a model fails: the residual over each variable, its hysteresis loops and its whiteness."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from mckibben.facts.comparison import CHANNELS, RESIDUAL
from mckibben.facts.result import Integers, Series, result_class
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import Predictor

_BINS = 10
_LAGS = 24
_BAND = 1.959964  # standard deviations of a 95 % band


@result_class
class Profile:
    """The residual over one variable."""

    FIGURES: ClassVar = RESIDUAL.name

    over: str
    """The variable."""
    share_explained: float
    worst: str
    """The range with the largest error."""
    rmse: float
    edges: Series
    """Boundaries of the ranges, SI; one more than ranges."""
    mean: Series
    rms: Series
    count: Integers


def variables_of(
    predictor: Predictor, fit_model: FitModel, groups: np.ndarray | None = None
) -> dict[str, np.ndarray]:
    """Variables that the residual may depend on, name of a channel -> values; constant ones are left out."""
    variables = dict(predictor.inputs)
    if "length" in variables:
        variables["contraction"] = 1.0 - variables.pop("length") / predictor.rest_length(fit_model)
    if groups is not None:
        variables["group"] = groups.astype(float)
    return {
        name: v for name, v in variables.items() if name in CHANNELS and np.ptp(v) > 1e-9 * np.max(np.abs(v))
    }


def profiles(residual: np.ndarray, variables: Mapping[str, np.ndarray], folds: np.ndarray) -> list[Profile]:
    """The residual over each variable, the largest explained share first."""
    unsorted = [_profile(name, residual, values, folds) for name, values in variables.items()]
    return sorted(unsorted, key=lambda profile: -profile.share_explained)


def _profile(name: str, residual: np.ndarray, values: np.ndarray, folds: np.ndarray) -> Profile:
    levels = np.unique(values)
    if len(levels) <= 3:
        edges = np.concatenate([levels, levels[-1:]])
        place = np.searchsorted(levels, values)
        bins = len(levels)
    else:
        edges = np.unique(np.quantile(values, np.linspace(0.0, 1.0, _BINS + 1)))
        bins = max(len(edges) - 1, 1)
        place = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, bins - 1)
    count = np.bincount(place, minlength=bins)
    sums = np.bincount(place, residual, minlength=bins)
    squares = np.bincount(place, residual**2, minlength=bins)
    rms = np.sqrt(squares / np.maximum(count, 1))
    # Each fold is predicted by the bin means of the others.
    left = np.zeros(len(residual))
    for label in np.unique(folds):
        rows = folds == label
        rest = count - np.bincount(place[rows], minlength=bins)
        total = sums - np.bincount(place[rows], residual[rows], minlength=bins)
        left[rows] = residual[rows] - (total / np.maximum(rest, 1))[place[rows]]
    whole = float(np.mean(residual**2))
    share = 1.0 - float(np.mean(left**2)) / whole if whole > 0.0 else 0.0
    worst = int(np.argmax(np.where(count >= 3, rms, 0.0)))
    low, high = (edges[worst], edges[worst + 1]) if len(levels) > 3 else (edges[worst], edges[worst])
    return Profile(
        over=name,
        share_explained=max(share, 0.0),
        worst=range_text(name, float(low), float(high)),
        rmse=float(rms[worst]),
        edges=edges,
        mean=sums / np.maximum(count, 1),
        rms=rms,
        count=count,
    )


def range_text(name: str, low: float, high: float) -> str:
    """A range of a variable in words and shown units; a single value where both ends are the same."""
    figure = CHANNELS[name]
    if name == "direction":
        return {-1.0: "shortening", 0.0: "at rest", 1.0: "lengthening"}.get(low, "unknown")
    scale = figure.scale
    ends = (scale.of(low), scale.of(high))
    wide = abs(ends[1] - ends[0])
    digits = min(max(1 - int(np.floor(np.log10(wide))), 0), scale.digits) if wide > 0.0 else scale.digits
    # A rounded −0.0 is 0.
    first, last = (f"{round(end, digits) + 0.0:.{digits}f}" for end in ends)
    text = f"{first} to {last}" if wide > 0.0 else first.rstrip("0").rstrip(".") if digits else first
    return f"{figure.words} {text} {scale.unit}".replace(" -", " −").strip()


@result_class
class Whiteness:
    """Whether neighbouring rows of a residual are correlated; what is left is judged by the verdict."""

    FIGURES: ClassVar = RESIDUAL.name

    autocorrelation: Series
    band: float
    outside: float
    sign_changes: float
    white: bool


def whiteness(residual: np.ndarray, sweeps: Sequence[np.ndarray]) -> Whiteness:
    """Autocorrelation and sign changes of a residual within its sweeps."""
    lines = [residual[rows] - np.mean(residual) for rows in sweeps if len(rows) > 2]
    variance = float(np.mean(np.concatenate(lines) ** 2)) if lines else 0.0
    count = sum(map(len, lines))
    rho = []
    for lag in range(1, _LAGS + 1):
        products = [line[lag:] * line[:-lag] for line in lines if len(line) > lag]
        pairs = sum(map(len, products))
        if pairs < 8 or not variance > 0.0:
            break
        rho.append(sum(float(np.sum(p)) for p in products) / pairs / variance)
    band = _BAND / np.sqrt(max(count, 1))
    changes = sum(int(np.count_nonzero(np.diff(np.sign(line)) != 0.0)) for line in lines)
    pairs = max(count - len(lines), 1)
    over_noise = changes / (0.5 * pairs)
    outside = float(np.mean(np.abs(rho) > band)) if rho else 0.0
    steady = abs(changes - 0.5 * pairs) <= 3.0 * np.sqrt(0.25 * pairs)
    return Whiteness(np.array(rho), float(band), outside, over_noise, bool(outside <= 0.15 and steady))


@result_class
class ResidualLoop:
    """A group that returns to its start."""

    FIGURES: ClassVar = RESIDUAL.name

    group: int
    """Number of the sweep or cycle."""
    area: float
    area_noise: float | None
    span: float
    friction: float


@result_class
class MeanLoop:
    """The mean of all loops."""

    FIGURES: ClassVar = RESIDUAL.name

    area: float
    area_noise: float | None
    friction: float


def loops(
    force: np.ndarray, length: np.ndarray, groups: np.ndarray, noise: float | None
) -> list[ResidualLoop]:
    r"""Area :math:`\oint r\,dL` of the force residual over each group that returns to its start [J].

    Positive areas take energy out of the motion, as friction does; negative ones cannot come from friction.
    Rows after the last return are not part of the loop. White noise :math:`\sigma` gives the area
    :math:`\sum_i r_i w_i`, with the weights w of the trapezoidal rule, the standard deviation
    :math:`\sigma\sqrt{\sum_i w_i^2}`.

    Args:
        force: residual, shape (rows,).
        length: shape (rows,).
        groups: label of each row.
        noise: standard deviation of a reading of the force; None where it is not known.
    """
    closed = []
    for label in np.unique(groups):
        rows = np.flatnonzero(groups == label)
        whole = float(np.ptp(length[rows]))
        distance = np.abs(length[rows] - length[rows[0]])
        near = np.flatnonzero(distance <= 0.1 * whole)
        last = near[np.flatnonzero(np.diff(near, prepend=-2) > 1)[-1] :]  # the last return to the start
        rows = rows[: last[np.argmin(distance[last])] + 1]
        span = float(np.ptp(length[rows]))
        if len(rows) < 8 or span < 0.5 * whole:
            continue
        steps = np.diff(length[rows])
        weights = 0.5 * (np.append(steps, 0.0) + np.insert(steps, 0, 0.0))
        area = float(np.sum(force[rows] * weights))
        by_noise = None if noise is None else noise * float(np.linalg.norm(weights))
        closed.append(ResidualLoop(int(label), area, by_noise, span, area / (2.0 * span)))
    return closed


def mean_loop(all_loops: Sequence[ResidualLoop]) -> MeanLoop | None:
    """The mean of the areas, with the friction that gives it on all loops; None without a loop."""
    if not all_loops:
        return None
    area = float(np.mean([loop.area for loop in all_loops]))
    known = [loop.area_noise for loop in all_loops if loop.area_noise is not None]
    by_noise = float(np.linalg.norm(known)) / len(known) if known else None
    return MeanLoop(area, by_noise, area / (2.0 * float(np.mean([loop.span for loop in all_loops]))))
