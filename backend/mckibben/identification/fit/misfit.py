"""The misfit of a model as a function of its free parameters, with derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mckibben.identification.fit.effort import FitEffort
from mckibben.identification.fit.least_squares import FitResult, fit_report, least_squares_fit
from mckibben.identification.predict.fit_model import FitModel, Free, each, together, with_values
from mckibben.identification.predict.predictor import Predictor

_LOST = 1e3  # residual of a row whose prediction is not finite, over the largest value
# Steps of a fit in a row without new derivatives, where those are dear, and its least tolerance.
_SECANTS, _TOLERANCE = 2, 3e-5


def penalised(predictor: Predictor, residual: np.ndarray) -> tuple[np.ndarray, int]:
    """The weighted residual as an optimiser sees it, and the number of values without a finite prediction.

    Those get a large residual, so that a fit turns back; it is no error, and nobody is to see a figure made
    from it.

    Args:
        predictor: the data.
        residual: measured minus predicted, shape (values,), SI.
    """
    finite = np.isfinite(residual)
    largest = float(np.max(np.abs(predictor.measured / predictor.scale), initial=1.0))
    penalty = -_LOST * largest * predictor.scale
    lost = len(residual) - int(np.count_nonzero(finite))
    return predictor.weighted(np.where(finite, residual, penalty)), lost


class Misfit:
    """Predicted minus measured, weighted; the last evaluation is kept for value and derivatives.

    The force is not clipped: where the model is slack although the muscle pulls, a clipped force has no
    gradient. A row without a finite value gets a large misfit and no gradient.

    Args:
        predictor: the data.
        fit_model: the model with the fixed values.
        free: the free parameters.
    """

    def __init__(self, predictor: Predictor, fit_model: FitModel, free: Sequence[Free]) -> None:
        self._predictor, self._fit_model, self._free = predictor, fit_model, free
        self._each = each(free)
        self._at: bytes | None = None
        self._misfit = np.empty(0)
        self._predicted: np.ndarray | None = None
        self._slopes: np.ndarray | None = None

    def fit_model(self, numbers: np.ndarray) -> FitModel:
        """The model with these values of the free parameters."""
        return with_values(self._fit_model, self._free, numbers)

    def value(self, numbers: np.ndarray) -> np.ndarray:
        """Misfit, shape (values,)."""
        key = numbers.tobytes()
        if key != self._at:
            predictor, fit_model = self._predictor, self.fit_model(numbers)
            self._predicted, self._slopes = None, None
            with np.errstate(all="ignore"):
                if predictor.simulated or predictor.follows(fit_model, self._each):
                    predicted = self._predicted = predictor.within_fit(fit_model, self._each)
                else:
                    predicted, slopes = predictor.linearised(fit_model, self._each)
                    slopes = np.where(np.isfinite(predicted)[:, None], slopes, 0.0)
                    self._slopes = self._weighted(slopes)
                residual = predictor.measured - predicted
            self._at, self._misfit = key, -penalised(predictor, residual)[0]
        return self._misfit

    def derivatives(self, numbers: np.ndarray) -> np.ndarray:
        """Derivatives of the misfit, shape (values, free)."""
        self.value(numbers)
        if self._slopes is None:
            slopes = self._predictor.slopes(self.fit_model(numbers), self._each, self._predicted)
            self._slopes = self._weighted(slopes)
        return self._slopes

    def _weighted(self, slopes: np.ndarray) -> np.ndarray:
        slopes = together(slopes, self._free)
        finite = np.all(np.isfinite(slopes), axis=1, keepdims=True)
        return self._predictor.weighted(np.where(finite, slopes, 0.0))

    def report(self, numbers: np.ndarray) -> FitResult:
        """What the data determine at these numbers, as after a fit that ended there."""
        return fit_report(
            numbers,
            self.derivatives(numbers),
            self.value(numbers),
            self._free,
            noise_lines=self._predictor.noise_lines,
        )

    def fit(self, effort: FitEffort) -> np.ndarray:
        """Values of the free parameters by least squares, see `least_squares_fit`.

        What went before the records is that which suits the start; where another one suits the end better,
        the fit goes on with that. Of histories that lead to other sizes of an effect, each is fitted and the
        closest kept. The evaluations after it are with the last one.
        """
        any_history, free = self._predictor, self._free
        histories = any_history.histories(self._fit_model.effects)
        if len(histories) > 1:
            return self._with_closest(any_history, histories, effort)
        history = any_history.history(self.fit_model(np.array([p.start for p in free])))
        numbers = self._after(any_history.after(history), free, effort)
        better = any_history.history(self.fit_model(numbers))
        if better != history:
            ended = [replace(p, start=float(x)) for p, x in zip(free, numbers, strict=True)]
            numbers = self._after(any_history.after(better), ended, effort)
        return numbers

    def _with_closest(
        self, predictor: Predictor, histories: Sequence[tuple[str, ...]], effort: FitEffort
    ) -> np.ndarray:
        """The fit with that one of the histories with which it ends closest to the readings."""
        fits = []
        for history in histories:
            numbers = self._after(predictor.after(history), self._free, effort)
            fits.append((float(np.sum(self.value(numbers) ** 2)), history, numbers))
        _, history, numbers = min(fits, key=lambda fit: fit[0])
        self._predictor, self._at = predictor.after(history), None
        return numbers

    def _after(self, predictor: Predictor, free: Sequence[Free], effort: FitEffort) -> np.ndarray:
        self._predictor, self._at = predictor, None
        dear = predictor.follows(self._fit_model, self._each)
        return least_squares_fit(
            self.value,
            self.derivatives,
            free,
            starts=effort.starts,
            tolerance=max(effort.tolerance, _TOLERANCE) if dear else effort.tolerance,
            evaluations=effort.evaluations,
            secants=_SECANTS if dear else 0,
        ).numbers
