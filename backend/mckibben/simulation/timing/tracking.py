"""Tracking figures of a controlled run: error, lag, overshoot of each step."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mckibben.facts.result import result_class
from mckibben.facts.run import STEP, TRACKING

Array = NDArray[np.float64]

_SAMPLES = 1000
_PEAK_MARGIN = 1e-3


@result_class
class StepOvershoot:
    """A step of the reference: when [s], its signed height [m], overshoot as a share of it."""

    FIGURES: ClassVar = STEP.name

    time: float
    size: float
    overshoot: float


@result_class
class Tracking:
    """Figures of `tracking`; ``notes`` says why a figure is None."""

    FIGURES: ClassVar = TRACKING.name

    rms: float
    max: float
    lag: float | None
    overshoot: list[StepOvershoot]
    """Every step of the reference."""
    notes: dict[str, str]
    """Figure -> why it is None, or a remark on it."""


def tracking(time: ArrayLike, reference: ArrayLike, position: ArrayLike) -> Tracking:
    r"""Tracking figures of a run.

    - rms, max: root mean square over time and largest |reference - position| [m].
    - lag: the shift tau in [0, a quarter of the run] [s] for which the position is best described by
      a + b reference(t - tau), that is, the largest correlation coefficient over the common time. Gain and
      offset errors do not change it. Of equally good shifts (a periodic reference) the smallest. Between
      samples by bracketing. None when reference or position is constant, or nothing fits.
    - overshoot: for each jump of the reference to a constant level, the largest travel beyond that level
      before the next jump, as a share of the jump.

    Args:
        time: ascending [s]; reference, position: same length [m].

    Raises:
        ValueError: different lengths, fewer than 4 rows, time not ascending.
    """
    t, r, y = (np.asarray(column, dtype=np.float64) for column in (time, reference, position))
    if not (t.shape == r.shape == y.shape and t.ndim == 1 and len(t) >= 4 and (np.diff(t) > 0.0).all()):
        raise ValueError("three columns of the same length (4 or more) and ascending times are needed")
    error = r - y
    rms = float(np.sqrt(np.trapezoid(error**2, t) / (t[-1] - t[0])))
    notes: dict[str, str] = {}
    lag = None
    if np.ptp(r) < 1e-12 or np.ptp(y) < 1e-12:
        notes["lag"] = "the reference or the position does not change"
    elif (lag := _lag(t, r, y)) is None:
        notes["lag"] = f"no lag up to {0.25 * (t[-1] - t[0]):.3g} s fits"
    return Tracking(rms, float(np.abs(error).max()), lag, _overshoots(t, r, y), notes)


def _lag(t: Array, r: Array, y: Array) -> float | None:
    """The smallest shift with the largest correlation."""
    even = np.linspace(t[0], t[-1], min(max(len(t), 64), _SAMPLES))
    step = float(even[1] - even[0])
    a, b = np.interp(even, t, r), np.interp(even, t, y)
    shifts = np.arange(len(even) // 4 + 1)
    score = np.array([_correlation(a[: len(a) - k], b[k:]) for k in shifts])
    if not score.max() > 0.1:
        return None
    tops = _tops(score)
    best = int(np.flatnonzero(tops >= tops.max() - _PEAK_MARGIN)[0])
    if best == shifts[-1]:
        return None

    from scipy.optimize import minimize_scalar

    def misfit(shift: float) -> float:
        late = even[even >= t[0] + shift]
        return -_correlation(np.interp(late - shift, t, r), np.interp(late, t, y))

    bracket = (max(0.0, (best - 1) * step), (best + 1) * step)
    minimum = minimize_scalar(misfit, bounds=bracket, method="bounded", options={"xatol": 1e-6 * step})
    return 0.0 if misfit(0.0) <= minimum.fun and best <= 1 else float(minimum.x)


def _tops(score: Array) -> Array:
    """Height of the parabola through each local maximum and its neighbours; -inf elsewhere."""
    tops = np.full(len(score), -np.inf)
    left, middle, right = score[:-2], score[1:-1], score[2:]
    peak = (middle >= left) & (middle >= right)
    bend = np.maximum(2.0 * middle - left - right, 1e-300)
    tops[1:-1][peak] = (middle + (left - right) ** 2 / (8.0 * bend))[peak]
    tops[0] = score[0] if score[0] >= score[1] else -np.inf
    tops[-1] = score[-1] if score[-1] > score[-2] else -np.inf
    return tops


def _correlation(a: Array, b: Array) -> float:
    """Correlation coefficient; 0 when one is constant."""
    a, b = a - a.mean(), b - b.mean()
    scale = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / scale if scale > 1e-18 else 0.0


def _overshoots(t: Array, r: Array, y: Array) -> list[StepOvershoot]:
    """Overshoot of every jump to a constant level."""
    change = np.diff(r)
    small = 1e-9 * float(np.ptp(r)) if len(r) else 0.0
    moving = np.abs(change) > small
    # A jump is one interval of change between two constant ones; a ramp or a sine changes all the time.
    rest_after = np.r_[~moving[1:], True]
    rest_before = np.r_[True, ~moving[:-1]]
    jumps = np.flatnonzero(moving & rest_after & rest_before)
    steps: list[StepOvershoot] = []
    for number, index in enumerate(jumps):
        end = jumps[number + 1] + 1 if number + 1 < len(jumps) else len(t)
        size, level = float(change[index]), float(r[index + 1])
        beyond = float(np.max(np.sign(size) * (y[index + 1 : end] - level)))
        at = float(t[index + 1])
        steps.append(StepOvershoot(at, size, max(0.0, beyond) / abs(size)))
    return steps
