r"""How well the model, fitted to the other specimens alone, predicts each specimen.

The specimen is left out whole, its zero errors are not known, and what the others do not determine stays at
its off value: the same prior as in the held-out error of groups. With the normal equations of the others,

.. math:: \Delta\theta = (J^TJ + \Lambda)^{-1}\left(J^T r - \Lambda(\theta - \theta_{off})\right)

is repeated until it settles; of simulated runs, which cost a thousand times more, it is taken once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.misfit import Misfit
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.specimens import SpecimensPredictor
from mckibben.identification.residual.noise import allowing_for_errors

_STEPS = 8  # of the fit to the others
_SETTLED = 1e-4  # relative decrease of the misfit below which it ends
_HALVED = 5  # times a step is halved before it is given up
_ENDS = ("lower", "upper")
_CUTOFF = 1e-13  # share of the largest singular value below which a direction is not determined


@dataclass(frozen=True)
class LeftOutSpecimen:
    """The prediction of one specimen by the model fitted to the others.

    Attributes:
        name: of the specimen.
        rmse: error over the scale of the predictor.
        share: the error over the largest magnitude measured on it.
    """

    name: str
    rmse: float
    share: float


def left_out_specimens(predictor: SpecimensPredictor, fitted: FittedModel) -> tuple[LeftOutSpecimen, ...]:
    """The error of every specimen that is left out in turn, without one whose run stops.

    Args:
        predictor: the data of all specimens.
        fitted: the model fitted to all of them; its free parameters are fitted again without each.
    """
    found = []
    for number, name in enumerate(predictor.names):
        model = _fitted_without(predictor, fitted, number)
        rows = predictor.specimen == number
        residual = (predictor.residual(model) / predictor.scale)[rows]
        largest = float(np.max(np.abs(predictor.measured / predictor.scale)[rows]))
        rmse = float(np.sqrt(np.mean(residual**2)))
        if not np.isfinite(rmse):  # a run stopped
            continue
        found.append(LeftOutSpecimen(name, rmse, rmse / largest if largest > 0.0 else float("nan")))
    return tuple(found)


def _fitted_without(predictor: SpecimensPredictor, fitted: FittedModel, number: int) -> FitModel:
    if not fitted.free:
        return fitted.fit_model
    others = _Others(allowing_for_errors(predictor.without(number), fitted.fit_model), fitted)
    here = np.array([p.start for p in fitted.free])
    cost = others.cost(here)
    for _ in range(1 if predictor.simulated else _STEPS):
        whole = others.step(here)
        if predictor.simulated:
            here = others.inside(here + whole)
            break
        trials = (others.inside(here + whole * 0.5**half) for half in range(_HALVED))
        lower = next((trial for trial in trials if others.cost(trial) < cost), None)
        if lower is None:
            break
        before, here, cost = cost, lower, others.cost(lower)
        if cost > (1.0 - _SETTLED) * before:
            break
    return fitted.fit_model.with_numbers([p.name for p in fitted.free], here)


class _Others:
    """The misfit of the other specimens, with the prior of the free parameters."""

    def __init__(self, predictor: Predictor, fitted: FittedModel) -> None:
        self._misfit = Misfit(predictor, fitted.fit_model, fitted.free)
        self._low, self._high = (np.array([getattr(p, end) for p in fitted.free]) for end in _ENDS)
        self._span = self._high - self._low
        self._prior = np.array([0.0 if p.off is None else fitted.mean_square for p in fitted.free])
        self._off = np.array([p.start if p.off is None else p.off for p in fitted.free])

    def inside(self, values: np.ndarray) -> np.ndarray:
        return np.clip(values, self._low, self._high)

    def cost(self, values: np.ndarray) -> float:
        misfit = self._misfit.value(values)
        return float(misfit @ misfit + self._prior @ ((values - self._off) / self._span) ** 2)

    def step(self, values: np.ndarray) -> np.ndarray:
        """The full step to the minimum of the linear model."""
        misfit, jacobian = self._misfit.value(values), self._misfit.derivatives(values) * self._span
        normal = jacobian.T @ jacobian + np.diag(self._prior)
        right = jacobian.T @ misfit + self._prior * (values - self._off) / self._span
        return -np.linalg.pinv(normal, rcond=_CUTOFF, hermitian=True) @ right * self._span
