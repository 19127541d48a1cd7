"""What a fit makes small: a model's misfit as a function of its free numbers, with derivatives."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.identification.fit import FitResult, Free, least_squares_fit
from mckibben.identification.setting import Setting
from mckibben.identification.subjects.subject import Subject

_LOST = 1e3  # times the largest value: misfit of a row where a guess of the fit has no finite value


class Misfit:
    """Predicted minus measured over the scale; the last evaluation serves both value and derivatives.

    The unclipped force is followed: where the model is slack although the muscle pulls, a clipped one has no
    gradient. A row without a finite value is far off and has no gradient.

    Args:
        subject: the data.
        setting: the model around which numbers are changed.
        free: what is changed.
    """

    def __init__(self, subject: Subject, setting: Setting, free: Sequence[Free]) -> None:
        self._subject, self._setting, self._free = subject, setting, free
        self._names = [parameter.name for parameter in free]
        self._lost = _LOST * float(np.max(np.abs(subject.measured / subject.scale), initial=1.0))
        self._at: bytes | None = None
        self._last = np.empty(0), np.empty((0, len(free)))

    def setting(self, numbers: np.ndarray) -> Setting:
        """The model with these numbers."""
        return self._setting.with_numbers(self._names, numbers)

    def value(self, numbers: np.ndarray) -> np.ndarray:
        """Misfit, shape (values,)."""
        return self._both(numbers)[0]

    def derivatives(self, numbers: np.ndarray) -> np.ndarray:
        """Of the misfit, shape (values, free)."""
        return self._both(numbers)[1]

    def fit(self, *, starts: int, tolerance: float, evaluations: int) -> FitResult:
        """Least squares over the free numbers, see `least_squares_fit`."""
        return least_squares_fit(
            self.value,
            self.derivatives,
            self._free,
            starts=starts,
            tolerance=tolerance,
            evaluations=evaluations,
        )

    def _both(self, numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        key = numbers.tobytes()
        if key != self._at:
            with np.errstate(all="ignore"):
                predicted, slopes = self._subject.linearised(self.setting(numbers), self._free)
                misfit = (predicted - self._subject.measured) / self._subject.scale
                slopes = slopes / self._subject.scale[:, None]
            lost = ~(np.isfinite(misfit) & np.isfinite(slopes).all(axis=1))
            misfit[lost], slopes[lost] = self._lost, 0.0
            self._at, self._last = key, (misfit, slopes)
        return self._last
