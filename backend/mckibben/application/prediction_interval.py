r"""How sure the predictions of a fitted model are: intervals from the covariance of its fitted values.

To first order the variance of a prediction y is

.. math:: \sigma_y^2 = J C J^T + \sigma_e^2,\quad J_i = \frac{y(\theta_i + h_i) - y(\theta_i - h_i)}{2 h_i}

with the covariance C of the fitted values and the error :math:`\sigma_e` that the fit left. The interval is
that of a new reading, where the model was measured; outside of that range it is too narrow.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from statistics import NormalDist
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.muscle import FORCE_INTERVAL
from mckibben.facts.result import Rows, Series, result_class
from mckibben.physics.muscle import GEOMETRY
from mckibben.presets.fit import FitRecord
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.statics.model import Curves, StaticModel

Array = np.ndarray

#: Share of new readings that lie in an interval.
SHARE = 0.9
_DEVIATIONS = NormalDist().inv_cdf(0.5 + 0.5 * SHARE)
_STEP = 0.5  # of the differences, in standard deviations
_POSITIONS = ("length", "displacement")  # predicted channels that are positions


@result_class
class ForceInterval:
    """Where new readings of the force are expected; outside of the measured range it is too narrow."""

    FIGURES: ClassVar = FORCE_INTERVAL.name

    low: Rows
    high: Rows
    share: float = SHARE

    def __iter__(self) -> Iterator[NDArray[np.float64]]:
        """``low, high = interval``."""
        return iter((self.low, self.high))


@result_class
class PositionInterval:
    """Where new readings of the position lie, where the model was measured; outside it is too narrow."""

    low: Series
    """Lower ends [m], shape (N,)."""
    high: Series
    """Upper ends [m], shape (N,)."""
    share: float = SHARE
    """Share of the readings between them [-]."""

    def __iter__(self) -> Iterator[NDArray[np.float64]]:
        """``low, high = interval``."""
        return iter((self.low, self.high))


def force_interval(
    fit: FitRecord | None, model: StaticModel, curves: Curves, curves_of: Callable[[StaticModel], Curves]
) -> ForceInterval | None:
    """The interval of the force of curves; None where the model was not fitted, or its errors are not known.

    Args:
        fit: how the values of the model were fitted.
        model: of the curves.
        curves: the prediction; errors of a position become errors of the force by the stiffness.
        curves_of: the same curves of a model with other values.
    """
    if fit is None:
        return None
    if "force" in fit.errors:
        left = np.full(curves.force.shape, fit.errors["force"])
    elif name := next((name for name in _POSITIONS if name in fit.errors), None):
        left = fit.errors[name] * np.abs(curves.stiffness)
    else:
        return None
    variance = _variance(fit, curves.force.shape, model, lambda moved: curves_of(moved).force)
    low, high = _ends(curves.force, left**2 + variance)
    # A slack muscle has no tension, whatever was fitted.
    return ForceInterval(np.where(curves.force > 0.0, np.maximum(low, 0.0), low), high)


def position_interval(
    fit: FitRecord | None, drive: Drive, position: Array, position_of: Callable[[Drive], Array]
) -> PositionInterval | None:
    """The interval of the position of a drive's load; None as in `force_interval`.

    An error of the force counts as an unknown constant force on the load; it has none where the load's force
    is a signal.

    Args:
        fit: how the values of the muscle were fitted.
        drive: the drive.
        position: the prediction [m].
        position_of: the position of a drive with other values, at the same times.
    """
    if fit is None:
        return None
    load, left = drive.load, np.zeros(position.shape)
    if name := next((name for name in _POSITIONS if name in fit.errors), None):
        left += fit.errors[name] / load.lever_ratio
    elif "force" in fit.errors and isinstance(load.force, float | int):
        error = fit.errors["force"] * load.lever_ratio
        high, low = (
            position_of(replace(drive, load=replace(load, force=load.force + sign * error)))
            for sign in (1.0, -1.0)
        )
        left += 0.5 * (high - low)
    else:
        return None
    variance = _variance(
        fit, position.shape, drive.model, lambda moved: position_of(replace(drive, model=moved))
    )
    return PositionInterval(*_ends(position, left**2 + variance))


def _variance(
    fit: FitRecord, shape: tuple[int, ...], model: StaticModel, value_of: Callable[[StaticModel], Array]
) -> Array:
    """J C J^T at each point of a prediction."""
    table = fit.covariance
    matrix = np.empty((0, 0)) if table is None else np.array(table.matrix)
    # What belongs to the data alone, such as their unknown load, changes nothing of the muscle.
    chosen = {
        name: place
        for place, name in enumerate([] if table is None else table.names)
        if matrix[place, place] > 0.0
        and (name in GEOMETRY or name.partition(".")[0] in {effect.id for effect in model.effects})
    }
    if not chosen:
        return np.zeros(shape)
    places = list(chosen.values())
    matrix = matrix[np.ix_(places, places)]
    columns = []
    for name, deviation in zip(chosen, np.sqrt(np.diag(matrix)), strict=True):
        (up, high), (down, low) = (_moved(model, name, sign * _STEP * deviation) for sign in (1.0, -1.0))
        columns.append((value_of(up) - value_of(down)) / (high - low))
    return np.maximum(np.einsum("i...,ij,j...->...", columns, matrix, columns), 0.0)


def _moved(model: StaticModel, name: str, change: float) -> tuple[StaticModel, float]:
    """The model with another value of a parameter, inside its bounds; and that value."""
    muscle, values = model.muscle, model.values
    if name in GEOMETRY:
        value = float(getattr(muscle, name)) + change
        muscle = muscle._replace(**{name: value})
    else:
        effect, parameter = name.split(".")
        declared = next(each for each in model.effects if each.id == effect).parameter(parameter)
        lower, upper = declared.bounds(muscle.size)
        value = min(max(values[effect][parameter] + change, lower), upper)
        values = {**values, effect: {**values[effect], parameter: value}}
    return StaticModel.of(muscle, model.effects, values), value


def _ends(value: Array, variance: Array) -> tuple[Array, Array]:
    """Lower and upper end."""
    half = _DEVIATIONS * np.sqrt(variance)
    return value - half, value + half
