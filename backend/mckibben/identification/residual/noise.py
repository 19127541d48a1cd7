"""Noise of a residual: its deviation from a smooth course along a sweep or between neighbours."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mckibben.identification.predict.reading_errors import AbsorbedError, absorbed_errors
from mckibben.identification.thresholds import NOISE
from mckibben.measurement.noise import CHI2_MEDIAN, SHORTEST_SWEEP, noise_floor

if TYPE_CHECKING:
    from scipy.spatial import KDTree

    from mckibben.identification.predict.fit_model import FitModel
    from mckibben.identification.predict.predictor import PredictedChannel, Predictor

_PLACE = ("pressure", "length", "load", "direction")  # coordinates of a scattered point
_NEIGHBOURS, _WIDE = 8, 16  # numbers of neighbours of the estimate and of its check
_MOST_POINTS = 4000  # more are thinned
_ROUNDING = 1e-9  # of full scale; smaller values are rounding errors
_BY_ACCURACY = "the accuracy of the sensors and the scatter of the readings"
_UNKNOWN = 1e-3  # of full scale; noise that weighs reading errors where it cannot be estimated


def neighbour_noise(values: np.ndarray, coordinates: np.ndarray) -> float | None:
    r"""Standard deviation of the noise of scattered points, from repeats and near neighbours.

    Each value is compared with a plane through its eight nearest neighbours. With their weights w the
    difference has the variance :math:`\sigma^2(1 + \sum w^2)`. Points that were measured twice are each
    other's nearest neighbours. Sixteen neighbours must give the same estimate: if they give more, the values
    are not smooth on the scale of the neighbourhood.

    Args:
        values: a residual, shape (rows,).
        coordinates: what it may depend on smoothly, shape (rows, variables).

    Returns:
        None for fewer than thirty rows, or where the points are too far apart.
    """
    from scipy.spatial import KDTree

    spread = np.ptp(coordinates, axis=0)
    places = coordinates[:, spread > 0.0] / spread[spread > 0.0]
    if len(values) < NOISE.fewest or not places.shape[1]:
        return None
    chosen = np.unique(np.linspace(0, len(values) - 1, min(len(values), _MOST_POINTS)).astype(int))
    tree = KDTree(places)
    near, wide = (_beside_planes(values, places, chosen, tree, count) for count in (_NEIGHBOURS, _WIDE))
    return near if wide < NOISE.same * near else None


def _beside_planes(
    values: np.ndarray, places: np.ndarray, chosen: np.ndarray, tree: KDTree, count: int
) -> float:
    nearest = np.asarray(tree.query(places[chosen], k=count + 1)[1])
    # With points on top of each other the first one found need not be the point itself.
    others = np.where(nearest == chosen[:, None], 0, 1)
    around = np.take_along_axis(nearest, np.argsort(others, axis=1, kind="stable"), axis=1)[:, 1:]
    plane = np.concatenate([np.ones((*around.shape, 1)), places[around] - places[chosen][:, None, :]], axis=2)
    weights = np.linalg.pinv(plane)[:, 0, :]
    deviation = values[chosen] - np.sum(weights * values[around], axis=1)
    squares = deviation**2 / (1.0 + np.sum(weights**2, axis=1))
    return float(np.sqrt(np.median(squares) / CHI2_MEDIAN))


def noise_of(predictor: Predictor, residual: np.ndarray, stated: float | None) -> tuple[float | None, str]:
    """Noise of a scaled residual and how it was obtained; None when it cannot be estimated.

    Args:
        predictor: the data.
        residual: over the scale, shape (values,).
        stated: noise of the single channel as stated by the user [SI].
    """
    first, *others = predictor.channels
    if others:
        return 1.0, "third differences of each channel"
    if stated is not None:
        return stated, "given"
    value, how = channel_noise(predictor, residual, first)
    if predictor.accuracy_floor > 0.0:
        return float(np.hypot(value or 0.0, predictor.accuracy_floor)), _BY_ACCURACY
    if value is None:
        return None, "the sweeps are too short for an estimate"
    return max(float(np.hypot(value, predictor.input_floor)), _ROUNDING * first.full_scale), how


def channel_noise(
    predictor: Predictor, values: np.ndarray, channel: PredictedChannel
) -> tuple[float | None, str]:
    """Noise of one channel of stacked values and how it was obtained: from sweeps or scattered points."""
    rows = np.arange(len(values))[channel.rows]
    inside = np.zeros(len(values), bool)
    inside[rows] = True
    sweeps = [sweep[inside[sweep]] for sweep in predictor.sweeps]
    differences = sum(len(rows) - 3 for rows in sweeps if len(rows) >= SHORTEST_SWEEP)
    coordinates = [predictor.inputs[name] for name in _PLACE if name in predictor.inputs]
    if differences < NOISE.fewest and coordinates:
        # Cycles that change with time, as a muscle that warms up, are smooth only beside those next to them.
        time = [[], *([[predictor.inputs["time"]]] if "time" in predictor.inputs else [])]
        found = [neighbour_noise(values[rows], np.column_stack([*coordinates, *each])[rows]) for each in time]
        if any(found):
            return min(filter(None, found)), "repeats and near neighbours"
    return noise_floor(values, sweeps), "third differences of the residual within sweeps"


def allowing_for_errors(predictor: Predictor, fit_model: FitModel) -> Predictor:
    """The predictor, whose fits allow for reading errors within the accuracy, weighed by the noise.

    The noise is estimated from the residual of the given model, whose smooth part does not count.
    """
    if not predictor.reading_errors and not predictor.accuracy:
        return predictor
    return predictor.allowing(fit_model, _scatter(predictor, fit_model))


def absorbed_by(predictor: Predictor, fit_model: FitModel) -> tuple[AbsorbedError, ...]:
    """The reading errors that a fit of this model has taken up, with their standard errors."""
    if not predictor.reading_errors:
        return ()
    residual = predictor.residual(fit_model) / predictor.scale
    columns = predictor.error_columns(fit_model)
    noise, floor = _scatter(predictor, fit_model), predictor.accuracy_floor
    return tuple(absorbed_errors(predictor.reading_errors, columns, residual, noise=noise, floor=floor))


def _scatter(predictor: Predictor, fit_model: FitModel) -> float:
    """Scatter of the scaled residual of a model from reading to reading."""
    residual = predictor.residual(fit_model) / predictor.scale
    first = predictor.channels[0]
    value = channel_noise(predictor, residual, first)[0] if len(predictor.channels) == 1 else 1.0
    return max(value or _UNKNOWN * first.full_scale, _ROUNDING * first.full_scale)
