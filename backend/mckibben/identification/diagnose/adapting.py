r"""How far a rival adapts to an experiment that another model describes: it is refitted to all the data.

What `design` calculates first moves constants along their slopes. A rival can do more: its constants may move
far, and those of its effects that the present data did not ask for may be freed. So it is refitted to the
present data and to what the other model predicts of the experiment, at once:

.. math:: \min_\theta\; |r(\theta)|^2 + |d(\theta)|^2

with its residual r in the present data and d, the other model's prediction minus its own, both over the noise
of a reading, and :math:`\theta` within the plausible ranges. What is left of d is what the experiment shows.
Further constants that end at a bound of their range are not freed: a diagnosis does not take them either. A
reading's own noise adds the same to both models, so none is drawn. The work is limited by the number of
evaluations, never by the clock.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.levenberg import minimise
from mckibben.identification.predict.fit_model import FitModel, Free, fixed_beside, free_numbers
from mckibben.identification.predict.predictor import Predictor

_EVALUATIONS = 10  # of a refit: from the fit to the present data it is a few Gauss-Newton steps away
_TOLERANCE = 1e-3  # relative change of the sum of squares; a separation needs two digits
_AT_BOUND = 1e-3  # share of the range; nearer to a bound a constant counts as being at it
_LOST = 1e3  # sigma, difference of a reading without a finite prediction


def further_constants(rival: FittedModel) -> list[Free]:
    """The constants that a rival may free in addition: all others of its effects, as in a diagnosis."""
    known = {parameter.name for parameter in rival.free} | fixed_beside(rival.free)
    names = {
        f"{effect.id}.{p.name}"
        for effect in rival.fit_model.effects
        for p in effect.parameters
        if not p.reference
    } - known
    return [parameter for parameter in free_numbers(rival.fit_model, (), names) if parameter.name in names]


def left_after_refit(
    rival: FittedModel, present: Predictor, experiment: Predictor, rows: np.ndarray, noise: float
) -> np.ndarray:
    """What a rival leaves of an experiment when it is refitted to it and to the present data.

    Args:
        rival: fitted to the present data.
        present: those data.
        experiment: what it is to explain as well, with the readings that the other model predicts.
        rows: mask of the readings that count.
        noise: standard deviation of the scaled residual.

    Returns:
        The difference over the noise, 0 where a row does not count, shape (values,).
    """
    present = present.after(present.history(rival.fit_model))
    further = further_constants(rival)
    fit = _Refit(rival, present, experiment, rows, noise)
    numbers = fit.minimum([*rival.free, *further])
    inside = [
        parameter
        for parameter, number in zip(further, numbers[len(rival.free) :], strict=True)
        if not _at_bound(parameter, number)
    ]
    free = [*rival.free, *inside]
    if len(inside) < len(further):
        numbers = fit.minimum(free)
    return fit.left(free, numbers)


def _at_bound(parameter: Free, value: float) -> bool:
    """Whether a constant ended at a bound of its range that is neither natural nor where it does nothing."""
    width = _AT_BOUND * (parameter.upper - parameter.lower)
    idle = parameter.off is not None and abs(value - parameter.off) <= width
    return (
        min(value - parameter.lower, parameter.upper - value) <= width and not idle and not parameter.natural
    )


@dataclass
class _Refit:
    """A rival beside present data and an experiment."""

    rival: FittedModel
    present: Predictor
    experiment: Predictor
    rows: np.ndarray
    noise: float

    def minimum(self, free: Sequence[Free]) -> np.ndarray:
        """The values of some parameters that fit both best."""
        if not free:
            return np.empty(0)
        kept: dict[bytes, tuple[np.ndarray, np.ndarray]] = {}

        def both(numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            key = numbers.tobytes()
            if key not in kept:
                kept.clear()
                kept[key] = self._both(free, numbers)
            return kept[key]

        return minimise(
            lambda numbers: both(numbers)[0],
            lambda numbers: both(numbers)[1],
            np.array([parameter.start for parameter in free]),
            np.array([parameter.lower for parameter in free]),
            np.array([parameter.upper for parameter in free]),
            tolerance=_TOLERANCE,
            evaluations=_EVALUATIONS,
        ).numbers

    def left(self, free: Sequence[Free], numbers: np.ndarray) -> np.ndarray:
        """What the rival with these values leaves of the experiment, over the noise."""
        residual = self.experiment.residual(self._model(free, numbers))
        scale = self.experiment.scale
        return np.where(self.rows, _finite(residual, scale), 0.0) / scale / self.noise

    def _model(self, free: Sequence[Free], numbers: np.ndarray) -> FitModel:
        return self.rival.fit_model.with_numbers([parameter.name for parameter in free], numbers)

    def _both(self, free: Sequence[Free], numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Misfit over the noise and its derivatives; as in a fit, a force is not clipped."""
        model, misfits, columns = self._model(free, numbers), [], []
        counted = np.concatenate([np.ones(len(self.present.measured), bool), self.rows])
        for predictor in (self.present, self.experiment):
            with np.errstate(all="ignore"):
                values, slopes = predictor.linearised(model, free)
            misfits.append(predictor.weighted(_finite(values - predictor.measured, predictor.scale)))
            columns.append(predictor.weighted(_finite_rows(slopes)))
        misfit, slopes = np.concatenate(misfits) / self.noise, np.concatenate(columns) / self.noise
        return np.where(counted, misfit, 0.0), np.where(counted[:, None], slopes, 0.0)


def _finite(difference: np.ndarray, scale: np.ndarray) -> np.ndarray:
    return np.where(np.isfinite(difference), difference, _LOST * scale)


def _finite_rows(slopes: np.ndarray) -> np.ndarray:
    return np.where(np.all(np.isfinite(slopes), axis=1, keepdims=True), slopes, 0.0)
