"""How a controlled run answers its reference: error, lag, each step, and a verdict with its evidence.

A step is a jump of the reference to a constant level, or a constant reference away from where the load
begins. It *settles* if the position stays within 2 % of the step around the level from some time before the
last tenth of its time on. Else it *swings* (two even periods in the second half of its time; *unstable*
where they grow), or the load rests: on an end stop beyond which the level is (*on the stop*), *beside* the
level, with the command at its limit or the muscle at full pressure (*saturates*), or beyond the level with a
muscle that is vented and cannot push it back (*cannot return*); or it still *moves*. A run under steps is as
good as its worst one.
Where the reference moves all the time the run *swings* about it (*unstable* where that grows) if the error
of its second half has even periods, at least twice as many as the reference turns there and back, and more
than 1 % of its range; it *tracks* if the RMS error is at most 5 % of the range of the reference, *saturates*
if it is not and the command is at its limits for a fifth of the time or more, and *deviates* otherwise.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.linear import SETTLING_BAND
from mckibben.facts.result import result_class
from mckibben.facts.run import STEP, TRACKING
from mckibben.facts.timing import SETTLED_BEFORE
from mckibben.simulation.timing.swing import Swing, swing_of

Array = NDArray[np.float64]

#: How a controlled run, or a step of its reference, ends; the worst first.
FollowState = Literal[
    "unstable", "swings", "cannot_return", "saturates", "on_stop", "beside", "moves", "deviates", "tracks",
    "settles",
]  # fmt: skip
_WORST_FIRST: tuple[FollowState, ...] = (
    "unstable", "swings", "cannot_return", "saturates", "on_stop", "beside", "moves", "settles",
)  # fmt: skip
GOOD: frozenset[FollowState] = frozenset({"tracks", "settles"})

_SAMPLES = 1000
_PEAK_MARGIN = 1e-3
_TRACKS = 0.05  # of the range of the reference
_SATURATED, _LIMITED = 0.2, 0.9  # shares of the time with the command at its limits
_VENTED = 0.01  # of the largest pressure
_GROWS = 1.02  # of the amplitude from period to period
_OWN = 2.0  # frequency of a swing about a moving reference, in that of the reference
_SMALLEST = 1e-5  # m; a smaller step is none
_SHORTEST_LAG = 1e-4  # s; a shorter one is not worth a word
_SEEN = 5e-4  # least swing, as a share of the step; the settling band is 40 times as wide


@result_class
class FollowedStep:
    """How the load answers a step of the reference."""

    FIGURES: ClassVar = STEP.name

    time: float
    size: float
    overshoot: float
    settling_time: float | None
    steady_error: float
    swing_frequency: float | None
    swing_amplitude: float | None
    saturated: float
    state: FollowState
    """How the load ends before the next step."""


@result_class
class Tracking:
    """How a controlled run follows its reference; ``notes`` says why a figure is None."""

    FIGURES: ClassVar = TRACKING.name

    rms: float
    max: float
    lag: float | None
    steps: list[FollowedStep]
    """Every step of the reference."""
    state: FollowState
    """How the run follows its reference; of several steps the worst."""
    verdict: str
    """The same as a sentence with its evidence."""
    advice: str | None
    """What to change; None where the run settles or tracks."""
    notes: dict[str, str]
    """Figure -> why it is None, or a remark on it."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Followed:
    """What a verdict rests on: columns of a controlled run.

    Attributes:
        time: ascending [s], shape (rows,), at least 4 rows.
        reference, position: [m].
        command: of the controller [-].
        limits: of the command.
        contact: whether the load rests on an end stop; None = never.
        stops: positions of the end stops [m].
        pressure: gauge pressure of the muscle [Pa]; None = not known.
        full_pressure: highest gauge pressure that the muscle can be given [Pa].
        pulled_back: whether a second muscle pulls the load back.
        integrates: whether the controller has an integral part.
        rubs: whether dry friction acts on the load.
    """

    time: Array
    reference: Array
    position: Array
    command: Array
    limits: tuple[float, float]
    contact: NDArray[np.bool_] | None = None
    stops: tuple[float, float] = (-np.inf, np.inf)
    pressure: Array | None = None
    full_pressure: float = np.inf
    pulled_back: bool = False
    integrates: bool = True
    rubs: bool = False

    def at_limits(self, rows: slice) -> float:
        """Share of the time of some rows with the command at one of its limits."""
        low, high = self.limits
        margin = 1e-9 * (high - low)
        limited = (self.command[rows] <= low + margin) | (self.command[rows] >= high - margin)
        return float(np.mean(limited))


def tracking(followed: Followed) -> Tracking:
    r"""Tracking figures and verdict of a run.

    - rms, max: root mean square over time and largest |reference - position| [m].
    - lag: the shift tau in [0, a quarter of the run] [s] for which the position is best described by
      a + b reference(t - tau), that is, the largest correlation coefficient over the common time. Gain and
      offset errors do not change it. Of equally good shifts (a periodic reference) the smallest. Between
      samples by bracketing. None when reference or position is constant, or nothing fits.
    - steps: see the module.

    Raises:
        ValueError: different lengths, fewer than 4 rows, time not ascending.
    """
    t, r, y = followed.time, followed.reference, followed.position
    if not (t.shape == r.shape == y.shape and t.ndim == 1 and len(t) >= 4 and (np.diff(t) > 0.0).all()):
        raise ValueError("three columns of the same length (4 or more) and ascending times are needed")
    error = r - y
    rms = float(np.sqrt(np.trapezoid(error**2, t) / (t[-1] - t[0])))
    largest = float(np.abs(error).max())
    notes: dict[str, str] = {}
    lag = None
    if np.ptp(r) < 1e-12 or np.ptp(y) < 1e-12:
        notes["lag"] = "the reference or the position does not change"
    elif (lag := _lag(t, r, y)) is None:
        notes["lag"] = f"no lag up to {0.25 * (t[-1] - t[0]):.3g} s fits"
    steps = _steps(followed)
    if steps:
        state, verdict = _of_steps(steps)
    else:
        state, verdict = _of_motion(followed, rms, largest, lag)
    return Tracking(rms, largest, lag, steps, state, verdict, _advice(state, followed), notes)


def _of_steps(steps: list[FollowedStep]) -> tuple[FollowState, str]:
    """The worst state of the steps, and its sentence."""
    worst = min(steps, key=lambda step: _WORST_FIRST.index(step.state))
    same = [step for step in steps if step.state == worst.state]
    every = len(same) == len(steps)
    which = (
        f"in {len(same)} of {len(steps)} steps " if not every else "in each step " if len(steps) > 1 else ""
    )
    at = "" if every else f", first after {same[0].time:.4g} s"
    step, away = same[0], f"{abs(same[0].steady_error) * 1e3:.3g} mm"
    side = "beyond" if step.steady_error * step.size < 0.0 else "short of"
    late = max((each.settling_time or 0.0) for each in steps)
    over = max(each.overshoot for each in steps)
    swing = ""
    if step.swing_frequency is not None and step.swing_amplitude is not None:
        swing = (
            f"±{step.swing_amplitude * 1e3:.3g} mm at {step.swing_frequency:.3g} Hz, "
            f"{100.0 * step.swing_amplitude / abs(step.size):.3g} % of the step"
        )
    texts: dict[FollowState, str] = {
        "settles": f"settles within 2 % of each step, in {late * 1e3:.4g} ms at most, overshoot at most "
        f"{100.0 * over:.3g} %",
        "unstable": f"{which}the load swings more and more: {swing} at the end{at}",
        "swings": f"{which}the load swings to the end: {swing}{at}",
        "cannot_return": f"{which}the load stays {away} beyond the reference: the muscle is vented and "
        f"cannot push it back{at}",
        "saturates": f"{which}the load rests {away} {side} the reference with the command at its limit or "
        f"the muscle at the pressure of the supply{at}",
        "on_stop": f"{which}the load rests on its end stop, {away} {side} the reference{at}",
        "beside": f"{which}the load rests {away} {side} the reference, outside of 2 % of the step{at}",
        "moves": f"{which}the load still moves when the time of the step is over{at}",
    }
    others = sum(each.state not in GOOD for each in steps) - len(same) if worst.state not in GOOD else 0
    more = f"; {others} more {'does' if others == 1 else 'do'} not settle" if others else ""
    return worst.state, f"{texts[worst.state]}{more}"


def _of_motion(followed: Followed, rms: float, largest: float, lag: float | None) -> tuple[FollowState, str]:
    """Whether a reference that moves all the time is tracked."""
    size = float(np.ptp(followed.reference))
    if size < _SMALLEST:
        state: FollowState = "settles" if largest < _SMALLEST else "beside"
        return (
            state,
            f"the reference does not change; the load is at most {largest * 1e3:.3g} mm away from it",
        )
    if (swing := _about(followed, size)) is not None:
        said = (
            f"±{swing.amplitude * 1e3:.3g} mm at {swing.frequency:.3g} Hz, RMS error {rms * 1e3:.3g} mm of "
        )
        more = "unstable" if swing.growth > _GROWS else "swings"
        words = (
            "swings more and more about the reference" if more == "unstable" else "swings about the reference"
        )
        return more, f"the load {words} to the end: {said}{size * 1e3:.4g} mm"
    limited = followed.at_limits(slice(None))
    state = "tracks" if rms <= _TRACKS * size else "saturates" if limited >= _SATURATED else "deviates"
    words = {"tracks": "follows", "saturates": "does not follow", "deviates": "does not follow"}[state]
    text = (
        f"{words} the reference within {100.0 * _TRACKS:g} % of its range: RMS error {rms * 1e3:.3g} mm of "
        f"{size * 1e3:.4g} mm ({100.0 * rms / size:.3g} %), at most {largest * 1e3:.3g} mm"
    )
    if lag is not None and lag >= _SHORTEST_LAG:
        text += f", {lag * 1e3:.4g} ms late"
    if state == "saturates":
        text += f"; the command is at its limits for {100.0 * limited:.3g} % of the time"
    return state, text


def _about(followed: Followed, size: float) -> Swing | None:
    """The swing of the error of the second half that is the loop's own and not the reference's."""
    t, r = followed.time, followed.reference
    half = t >= 0.5 * (t[0] + t[-1])
    swing = swing_of(t[half], (r - followed.position)[half])
    if swing is None or swing.amplitude <= 0.5 * SETTLING_BAND * size:
        return None
    pace = np.diff(r[half])
    signs = np.sign(pace[np.abs(pace) > 1e-9 * size])
    turns = np.count_nonzero(np.diff(signs)) / (t[-1] - t[half][0])
    return swing if swing.frequency >= _OWN * 0.5 * turns else None


def _advice(state: FollowState, followed: Followed) -> str | None:
    """What to change."""
    lower = "lower the gains, or let the linear view design them"
    if followed.rubs and followed.integrates:
        lower += "; the integral part hunts where dry friction holds the load, which no linear model shows"
    if state in GOOD:
        return None
    return {
        "unstable": lower,
        "swings": lower,
        "cannot_return": "add what pulls the load back: a second muscle, a spring, or gravity",
        "saturates": "a higher supply pressure, a larger muscle or a larger valve",
        "on_stop": "a reference between the end stops, or other stops",
        "beside": "a larger integral gain, or more time" if followed.integrates else "an integral gain",
        "moves": "a longer time between the steps, or higher gains",
        "deviates": "higher gains, a feed forward, or a slower reference",
    }[state]


def _lag(t: Array, r: Array, y: Array) -> float | None:
    """The smallest shift with the largest correlation."""
    even = np.linspace(t[0], t[-1], min(max(len(t), 64), _SAMPLES))
    step = float(even[1] - even[0])
    a, b = np.interp(even, t, r), np.interp(even, t, y)
    shifts = np.arange(len(even) // 4 + 1)
    score = _correlations(a, b, len(shifts))
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


def _correlations(a: Array, b: Array, count: int) -> Array:
    """`_correlation` of ``a[: n - k]`` and ``b[k:]`` for k below a count, from running sums."""
    a, b = a - a.mean(), b - b.mean()
    shifts = np.arange(count)
    left = len(a) - shifts
    products = np.correlate(b, a, mode="full")[len(a) - 1 : len(a) - 1 + count]
    sum_a, square_a = (np.cumsum(each)[left - 1] for each in (a, a * a))
    sum_b, square_b = (np.cumsum(each[::-1])[left - 1] for each in (b, b * b))
    scale = np.sqrt(np.maximum(square_a - sum_a**2 / left, 0.0) * np.maximum(square_b - sum_b**2 / left, 0.0))
    return np.divide(products - sum_a * sum_b / left, scale, out=np.zeros(count), where=scale > 1e-18)


def _correlation(a: Array, b: Array) -> float:
    """Correlation coefficient; 0 when one is constant."""
    a, b = a - a.mean(), b - b.mean()
    scale = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / scale if scale > 1e-18 else 0.0


def _steps(followed: Followed) -> list[FollowedStep]:
    """Every jump of the reference to a constant level, and the first level if the load begins elsewhere."""
    r, y = followed.reference, followed.position
    change = np.diff(r)
    moving = np.abs(change) > 1e-9 * float(np.ptp(r))
    # A jump is one interval of change between two constant ones; a ramp or a sine changes all the time.
    rest_after = np.r_[~moving[1:], True]
    rest_before = np.r_[True, ~moving[:-1]]
    jumps = np.flatnonzero(moving & rest_after & rest_before)
    moves = np.flatnonzero(moving)
    begins = [(int(index) + 1, float(change[index])) for index in jumps]
    if abs(r[0] - y[0]) > _SMALLEST and not moving[0]:
        begins.insert(0, (0, float(r[0] - y[0])))
    found = []
    for begin, size in begins:
        after = moves[moves >= begin]
        end = int(after[0]) + 1 if len(after) else len(r)
        if abs(size) > _SMALLEST and end - begin > 1:
            found.append(_step(followed, begin, end, size))
    return found


def _step(followed: Followed, begin: int, end: int, size: float) -> FollowedStep:
    """Figures of a step whose level holds from one row to before another."""
    rows = slice(begin, end)
    t, y, level = followed.time[rows], followed.position[rows], float(followed.reference[begin])
    beyond = np.sign(size) * (y - level)
    band, last = SETTLING_BAND * abs(size), float(t[-1] - t[0])
    outside = np.flatnonzero(np.abs(beyond) > band)
    settled = 0.0
    if len(outside):
        row = min(int(outside[-1]) + 1, len(t) - 1)
        settled = float(t[row] - t[0])
    quarter = slice(begin + 3 * len(t) // 4, end)
    rest = followed.position[quarter]
    half = t >= 0.5 * (t[0] + t[-1])
    swing = swing_of(t[half], y[half])
    if swing is not None and swing.amplitude < _SEEN * abs(size):
        swing = None
    error = float(level - np.mean(rest))
    state: FollowState = "moves"
    if (not len(outside) or outside[-1] < len(t) - 1) and settled <= SETTLED_BEFORE * last:
        state = "settles"
    elif swing is not None and swing.amplitude > 0.5 * band:
        state = "unstable" if swing.growth > _GROWS else "swings"
    elif np.ptp(rest) <= band:
        state = _at_rest(followed, quarter, level, -error)
    return FollowedStep(
        time=float(t[0]),
        size=size,
        overshoot=max(0.0, float(beyond.max())) / abs(size),
        settling_time=settled if state == "settles" else None,
        steady_error=error,
        swing_frequency=None if swing is None else swing.frequency,
        swing_amplitude=None if swing is None else swing.amplitude,
        saturated=followed.at_limits(rows),
        state=state,
    )


def _at_rest(followed: Followed, rows: slice, level: float, beyond: float) -> FollowState:
    """Why a load rests away from its level, ``beyond`` it on the side of a shorter muscle [m]."""
    low, high = followed.stops
    rests = followed.contact is not None and bool(followed.contact[rows].all())
    if rests and not low <= level <= high:
        return "on_stop"
    pressure = followed.pressure
    if pressure is not None:
        vented = float(np.max(pressure[rows])) <= _VENTED * float(np.max(pressure))
        if beyond > 0.0 and vented and not followed.pulled_back:
            return "cannot_return"
        if beyond < 0.0 and float(np.min(pressure[rows])) >= (1.0 - _VENTED) * followed.full_pressure:
            return "saturates"
    if rests:
        return "on_stop"
    return "saturates" if followed.at_limits(rows) >= _LIMITED else "beside"
