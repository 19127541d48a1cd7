"""How much of a residual is noise: what is left along a sweep or between neighbours beside smooth change."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mckibben.measurement.noise import CHI2_MEDIAN, SHORTEST_SWEEP, noise_floor

if TYPE_CHECKING:
    from scipy.spatial import KDTree

    from mckibben.identification.predict.predictor import PredictedChannel, Predictor

_PLACE = ("pressure", "length", "load", "direction")  # where a scattered point is
_FEWEST = 30  # third differences, below which the points around each one tell more
_NEIGHBOURS, _WIDE = 8, 16
_SAME = 1.25  # of the estimate from the nearer ones
_MOST_POINTS = 4000  # looked at; more are thinned
_ROUNDING = 1e-9  # of full scale: below, it is rounding


def neighbour_noise(values: np.ndarray, coordinates: np.ndarray) -> float | None:
    r"""Standard deviation of the noise of scattered points, from repeats and near neighbours.

    Each value is compared with a plane through its eight nearest neighbours, w their weights in it; what is
    left has the variance :math:`\sigma^2(1 + \sum w^2)`. Points that were measured twice are each other's
    nearest neighbours. Sixteen neighbours have to tell the same: where they tell more, the values change
    from point to point by themselves.

    Args:
        values: a residual, shape (rows,).
        coordinates: what it may depend on smoothly, shape (rows, variables).

    Returns:
        None for fewer than thirty rows, or where the points are too far apart to tell.
    """
    from scipy.spatial import KDTree

    spread = np.ptp(coordinates, axis=0)
    places = coordinates[:, spread > 0.0] / spread[spread > 0.0]
    if len(values) < _FEWEST or not places.shape[1]:
        return None
    chosen = np.unique(np.linspace(0, len(values) - 1, min(len(values), _MOST_POINTS)).astype(int))
    tree = KDTree(places)
    near, wide = (_beside_planes(values, places, chosen, tree, count) for count in (_NEIGHBOURS, _WIDE))
    return near if wide < _SAME * near else None


def _beside_planes(
    values: np.ndarray, places: np.ndarray, chosen: np.ndarray, tree: KDTree, count: int
) -> float:
    found = np.asarray(tree.query(places[chosen], k=count + 1)[1])
    # With points on top of each other the first one found need not be the point itself.
    others = np.where(found == chosen[:, None], 0, 1)
    around = np.take_along_axis(found, np.argsort(others, axis=1, kind="stable"), axis=1)[:, 1:]
    plane = np.concatenate([np.ones((*around.shape, 1)), places[around] - places[chosen][:, None, :]], axis=2)
    weights = np.linalg.pinv(plane)[:, 0, :]
    left = values[chosen] - np.sum(weights * values[around], axis=1)
    squares = left**2 / (1.0 + np.sum(weights**2, axis=1))
    return float(np.sqrt(np.median(squares) / CHI2_MEDIAN))


def noise_of(predictor: Predictor, residual: np.ndarray, given: float | None) -> tuple[float | None, str]:
    """Noise of a residual over its scale, and from what it was told; None when it cannot be told.

    Args:
        predictor: the data.
        residual: over the scale, shape (values,).
        given: what the user says of the single channel [SI].
    """
    first, *others = predictor.channels
    if others:
        return 1.0, "third differences of each channel"
    if given is not None:
        return given, "given"
    value, how = channel_noise(predictor, residual, first)
    if value is None:
        return None, "the sweeps are too short to tell"
    return max(value, _ROUNDING * first.full_scale), how


def channel_noise(
    predictor: Predictor, values: np.ndarray, channel: PredictedChannel
) -> tuple[float | None, str]:
    """Noise of one channel of stacked values, and from what: along its sweeps, or of scattered points."""
    rows = np.arange(len(values))[channel.rows]
    inside = np.zeros(len(values), bool)
    inside[rows] = True
    sweeps = [sweep[inside[sweep]] for sweep in predictor.sweeps]
    differences = sum(len(rows) - 3 for rows in sweeps if len(rows) >= SHORTEST_SWEEP)
    own = [predictor.inputs[name] for name in _PLACE if name in predictor.inputs]
    if differences < _FEWEST and own:
        found = neighbour_noise(values[rows], np.column_stack(own)[rows])
        if found:
            return found, "repeats and near neighbours"
    return noise_floor(values, sweeps), "third differences of the residual within sweeps"
