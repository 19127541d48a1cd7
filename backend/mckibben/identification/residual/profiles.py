"""Where a model fails: the residual over each variable, its hysteresis loops and its whiteness."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mckibben.facts.result import IntegerRows, Integers, Rows, Series, result_class
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import Predictor

_BINS = 10
_MAP = (8, 8)  # bins of a map in x and y
_LAGS = 24
_BAND = 1.959964  # standard deviations of a 95 % band
#: Variable -> how its ranges are shown: name, factor from SI, unit, decimals.
SHOWN: Mapping[str, tuple[str, float, str, int]] = {
    "pressure": ("pressure", 1e-5, "bar", 2),
    "contraction": ("contraction", 100.0, "%", 1),
    "velocity": ("velocity", 1e3, "mm/s", 1),
    "direction": ("direction of motion", 1.0, "", 0),
    "time": ("time", 1.0, "s", 2),
    "load": ("load", 1.0, "N", 0),
    "command": ("command", 1.0, "", 2),
    "displacement": ("stroke", 1e3, "mm", 1),
    "temperature": ("temperature", 1.0, "K", 1),
    "group": ("group", 1.0, "", 0),
}


@result_class
class Profile:
    """The residual over one variable."""

    over: str
    """The variable."""
    share_explained: float
    """Share of the mean square that the bin means of other folds predict."""
    worst: str
    """The range with the largest error."""
    rmse: float
    """Error in that range."""
    edges: Series
    """Boundaries of the ranges, SI; one more than ranges."""
    mean: Series
    """Mean residual of each range, SI."""
    rms: Series
    """Root mean square of the residual of each range, SI."""
    count: Integers
    """Number of points of each range."""


def variables_of(
    predictor: Predictor, fit_model: FitModel, groups: np.ndarray | None = None
) -> dict[str, np.ndarray]:
    """Variables that the residual may depend on, name of `SHOWN` -> values; constant ones are left out."""
    variables = dict(predictor.inputs)
    if "length" in variables:
        variables["contraction"] = 1.0 - variables.pop("length") / predictor.rest_length(fit_model)
    if groups is not None:
        variables["group"] = groups.astype(float)
    return {
        name: v for name, v in variables.items() if name in SHOWN and np.ptp(v) > 1e-9 * np.max(np.abs(v))
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
        worst=_range(name, float(low), float(high)),
        rmse=float(rms[worst]),
        edges=edges,
        mean=sums / np.maximum(count, 1),
        rms=rms,
        count=count,
    )


def _range(name: str, low: float, high: float) -> str:
    words, factor, unit, digits = SHOWN[name]
    if name == "direction":
        return {-1.0: "shortening", 0.0: "at rest", 1.0: "lengthening"}.get(low, "unknown")
    # A rounded −0.0 is 0.
    first, last = (f"{round(end * factor, digits) + 0.0:.{digits}f}" for end in (low, high))
    text = first if first == last else f"{first} to {last}"
    return f"{words} {text} {unit}".replace(" -", " −").strip()


@result_class
class ResidualMap:
    """Mean and rms of the residual over two variables, shape (y bins, x bins); NaN without rows."""

    x: str
    """The variable of the columns."""
    y: str
    """The variable of the rows."""
    x_edges: Series
    """Boundaries of the columns, SI; one more than columns."""
    y_edges: Series
    """Boundaries of the rows, SI; one more than rows."""
    mean: Rows
    """Mean residual of each cell, SI."""
    rms: Rows
    """Root mean square of the residual of each cell, SI."""
    count: IntegerRows
    """Number of points of each cell."""


def heat_map(residual: np.ndarray, variables: Mapping[str, np.ndarray]) -> ResidualMap | None:
    """The residual over pressure and contraction, or the first two variables; None with fewer than two."""
    preferred = [name for name in ("contraction", "displacement", "time", "load") if name in variables]
    others = [name for name in ("pressure", "velocity", "command") if name in variables]
    if not preferred or not others:
        return None
    x, y = preferred[0], others[0]
    edges = [
        np.linspace(np.min(variables[name]), np.max(variables[name]), bins + 1)
        for name, bins in ((x, _MAP[0]), (y, _MAP[1]))
    ]
    place = [
        np.clip(np.searchsorted(e, variables[name], side="right") - 1, 0, len(e) - 2)
        for name, e in zip((x, y), edges, strict=True)
    ]
    flat = place[1] * _MAP[0] + place[0]
    size = _MAP[0] * _MAP[1]
    count = np.bincount(flat, minlength=size)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.bincount(flat, residual, minlength=size) / count
        rms = np.sqrt(np.bincount(flat, residual**2, minlength=size) / count)
    shape = (_MAP[1], _MAP[0])
    return ResidualMap(
        x, y, edges[0], edges[1], mean.reshape(shape), rms.reshape(shape), count.reshape(shape)
    )


@result_class
class Whiteness:
    """Whether a residual looks like noise."""

    autocorrelation: Series
    """Autocorrelation of the residual at the lags 1, 2, ... within sweeps."""
    band: float
    """Half-width of the 95 % band of noise."""
    outside: float
    """Share of the lags outside the band; noise has 0.05."""
    runs: float
    """Number of runs of one sign over that expected of noise."""
    white: bool
    """Few lags are outside the band, and the number of runs is that of noise."""


def whiteness(residual: np.ndarray, sweeps: Sequence[np.ndarray]) -> Whiteness:
    """Autocorrelation and runs of a residual within its sweeps."""
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
    runs = changes / (0.5 * pairs)
    outside = float(np.mean(np.abs(rho) > band)) if rho else 0.0
    steady = abs(changes - 0.5 * pairs) <= 3.0 * np.sqrt(0.25 * pairs)
    return Whiteness(np.array(rho), float(band), outside, runs, bool(outside <= 0.15 and steady))


@result_class
class ResidualLoop:
    """A group that returns to its start: area of its force residual [J] and range of its length [m]."""

    group: int
    """Number of the sweep or cycle."""
    area: float
    """Positive [J]: the model lacks friction."""
    span: float
    """Travel between the reversals [m]."""


def loops(force: np.ndarray, length: np.ndarray, groups: np.ndarray) -> list[ResidualLoop]:
    r"""Area :math:`\oint r\,dL` of the force residual over each group that returns to its start [J].

    Positive areas take energy out of the motion, as friction does; negative ones cannot come from friction.
    Rows after the last return are not part of the loop.
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
        middle = 0.5 * (force[rows][1:] + force[rows][:-1])
        area = float(np.sum(middle * np.diff(length[rows])))
        closed.append(ResidualLoop(int(label), area, span))
    return closed
