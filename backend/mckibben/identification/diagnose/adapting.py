r"""How far a rival adapts to an experiment that another model describes: it is refitted to all the data.

What `design` calculates first moves constants along their slopes. A rival can do more: its constants may move
far, and those of its effect that the present data did not ask for may be freed. So it is refitted to the
present data and to what the other model predicts of the experiment, at once:

.. math:: \min_\theta\; |r(\theta)|^2 + |d(\theta)|^2

with its residual r in the present data and d, the other model's prediction minus its own, both over the noise
of a reading, and :math:`\theta` within the plausible ranges. What is left of d is what the experiment shows.
Further constants that end at a bound of their range are not freed: a diagnosis does not take them either. A
reading's own noise adds the same to both models, so none is drawn. The work is limited by the number of
evaluations, never by the clock.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.levenberg import minimise
from mckibben.identification.predict.fit_model import free_numbers, held_beside
from mckibben.identification.predict.free import Free
from mckibben.identification.predict.predictor import Predictor

_EVALUATIONS = 8  # of a refit: from the fit to the present data it is a few Gauss-Newton steps away
_TOLERANCE = 1e-3  # relative change of the sum of squares; a separation needs two digits
_AT_BOUND = 1e-3  # share of the range; nearer to a bound a constant counts as being at it
_LOST = 1e3  # sigma, difference of a reading without a finite prediction


def further_constants(rival: FittedModel, shared: Collection[str]) -> list[Free]:
    """The constants that a rival may free in addition: the others of the effects that are its own.

    Args:
        rival: fitted to the present data.
        shared: effects that the other model has as well; their further constants stay.
    """
    known = {parameter.name for parameter in rival.free} | held_beside(rival.free)
    names = {
        f"{effect.id}.{p.name}"
        for effect in rival.fit_model.effects
        if effect.id not in shared
        for p in effect.parameters
        if not p.reference
    } - known
    return [parameter for parameter in free_numbers(rival.fit_model, (), names) if parameter.name in names]


@dataclass(frozen=True)
class Experiment:
    """An experiment as another model describes it.

    Attributes:
        predictor: its rows.
        wanted: its readings by that model, SI, shape (values,).
        rows: mask of those that count.
        shared: effects of that model.
    """

    predictor: Predictor
    wanted: np.ndarray
    rows: np.ndarray
    shared: Collection[str]


def left_after_refit(
    rival: FittedModel, present: Predictor, experiment: Experiment, noise: float
) -> np.ndarray:
    """What a rival leaves of an experiment when it is refitted to it and to the present data.

    Args:
        rival: fitted to the present data.
        present: those data.
        experiment: what it is to explain as well.
        noise: standard deviation of the scaled residual.

    Returns:
        The difference over the noise, 0 where a row does not count, shape (values,).
    """
    present = present.after(present.history(rival.fit_model))
    further = further_constants(rival, experiment.shared)
    numbers, left = _refitted(rival, [*rival.free, *further], present, experiment, noise)
    if any(_at_bound(p, x) for p, x in zip(further, numbers[len(rival.free) :], strict=True)):
        left = _refitted(rival, rival.free, present, experiment, noise)[1]
    return left


def _at_bound(parameter: Free, value: float) -> bool:
    """Whether a constant ended at a bound of its range that is neither natural nor where it does nothing."""
    width = _AT_BOUND * (parameter.upper - parameter.lower)
    idle = parameter.off is not None and abs(value - parameter.off) <= width
    return (
        min(value - parameter.lower, parameter.upper - value) <= width and not idle and not parameter.natural
    )


def _refitted(
    rival: FittedModel, free: Sequence[Free], present: Predictor, experiment: Experiment, noise: float
) -> tuple[np.ndarray, np.ndarray]:
    """Values of the free parameters after the refit, and what it leaves of the experiment."""
    names = [parameter.name for parameter in free]
    predictor, rows = experiment.predictor, experiment.rows
    kept: dict[bytes, tuple[np.ndarray, np.ndarray]] = {}

    def both(numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        key = numbers.tobytes()
        if key not in kept:
            kept.clear()
            model = rival.fit_model.with_numbers(names, numbers)
            with np.errstate(all="ignore"):
                old, old_slopes = present.linearised(model, free)
                new, new_slopes = predictor.linearised(model, free)
            over = predictor.scale * noise
            difference = np.where(rows, _finite(new - experiment.wanted, predictor.scale) / over, 0.0)
            slopes = np.where(rows[:, None], _finite_rows(new_slopes) / over[:, None], 0.0)
            kept[key] = (
                np.concatenate([
                    present.weighted(_finite(old - present.measured, present.scale)) / noise, difference,
                ]),
                np.concatenate([present.weighted(_finite_rows(old_slopes)) / noise, slopes]),
            )  # fmt: skip
        return kept[key]

    start = np.array([parameter.start for parameter in free])
    if not free:
        return start, -both(start)[0][len(present.measured) :]
    ended = minimise(
        lambda numbers: both(numbers)[0],
        lambda numbers: both(numbers)[1],
        start,
        np.array([parameter.lower for parameter in free]),
        np.array([parameter.upper for parameter in free]),
        tolerance=_TOLERANCE,
        evaluations=_EVALUATIONS,
    )
    return ended.numbers, -ended.residuals[len(present.measured) :]


def _finite(difference: np.ndarray, scale: np.ndarray) -> np.ndarray:
    return np.where(np.isfinite(difference), difference, _LOST * scale)


def _finite_rows(slopes: np.ndarray) -> np.ndarray:
    return np.where(np.all(np.isfinite(slopes), axis=1, keepdims=True), slopes, 0.0)
