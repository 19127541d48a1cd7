"""Inverse questions of the static model: the pressure for a force, the contraction under a load, the range.

Answers are flagged, not clipped: a value is None only when no state of the muscle answers the question, and
the flag says why.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.simulation.statics.limits import FlagCode, LimitFlag
from mckibben.simulation.statics.model import StaticModel

SEARCH_PRESSURE = 4e6  # Pa; upper end of the search: no fluidic muscle works beyond
_SHORTEST = 0.35  # lower end of the search, as a share of the nominal length
_STEPS = 60
_FEW, _TABLE = 24, 12  # pressures that start from a table, and its lengths
_SHARES = np.linspace(0.0, 1.0, _TABLE)


@dataclass(frozen=True, slots=True)
class InverseResult:
    """The answer to an inverse question in SI, with further figures and the crossed limits."""

    value: float | None
    unit: str
    details: dict[str, float | None] = field(default_factory=dict)
    flags: list[LimitFlag] = field(default_factory=list)


def contraction_at(
    model: StaticModel,
    *,
    load: float | np.ndarray,
    pressures: np.ndarray,
    direction: float | np.ndarray = 0.0,
    temperature: float | np.ndarray = ROOM_TEMPERATURE,
) -> np.ndarray:
    """Contraction ratio at which the muscle carries the load [N] at each gauge pressure [Pa].

    Shape of ``pressures``; negative where the load stretches the muscle, NaN where it cannot be carried at
    any length short of the braid lock. Newton's method kept inside a shrinking bracket; few pressures start
    from a coarse table of lengths, which costs one evaluation and saves four.
    """
    rest = model.muscle.nominal_length
    low = np.full(len(pressures), _SHORTEST * rest)
    high = np.full(len(pressures), model.longest)

    def excess_at(length: np.ndarray, row: np.ndarray | slice) -> tuple[np.ndarray, np.ndarray]:
        each = {
            name: value[row] if isinstance(value, np.ndarray) and value.ndim else value
            for name, value in (
                ("pressure", pressures),
                ("direction", direction),
                ("temperature", temperature),
            )
        }
        out = model.outputs(length=length, **each)
        return out["force"] - (load[row] if isinstance(load, np.ndarray) else load), out["force_by_length"]

    def excess(length: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return excess_at(length, slice(None))

    if len(pressures) <= _FEW:
        reachable, low, high, length = _bracketed(excess_at, low, high)
    else:
        reachable = excess(high)[0] >= 0.0
        length = np.full(len(pressures), rest)
    with np.errstate(divide="ignore", invalid="ignore"):
        for _ in range(_STEPS):
            value, slope = excess(length)
            above = value >= 0.0
            high = np.where(above, length, high)
            low = np.where(above, low, length)
            newton = length - value / slope
            inside = (newton >= low) & (newton <= high)
            following = np.where(inside, newton, 0.5 * (low + high))
            # Newton's method: the next relative error is about the square of this relative step.
            done = ~reachable | (inside & (np.abs(following - length) < 1e-6 * rest))
            length = following
            if done.all():
                break
    return np.where(reachable, 1.0 - length / rest, np.nan)


def _bracketed(
    excess_at: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]],
    low: np.ndarray,
    high: np.ndarray,
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Whether the load can be carried at all, a bracket of the length, and a first guess in it.

    From a table of lengths: the last of them with too small a force, and the next. Between the two the length
    over the force is Hermite's cubic; where that leaves the bracket, a straight line, or else the middle.
    """
    count = len(low)
    lengths = low[0] + (high[0] - low[0]) * _SHARES
    rows = np.arange(count).repeat(_TABLE)
    value, slope = (column.reshape(count, _TABLE) for column in excess_at(np.tile(lengths, count), rows))
    reachable = value[:, -1] >= 0.0
    small = value < 0.0
    last = np.where(small.any(axis=1), _TABLE - 1 - small[:, ::-1].argmax(axis=1), 0)
    last = np.minimum(last, _TABLE - 2)
    each = np.arange(count)
    below, above = value[each, last], value[each, last + 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        span = above - below
        share = -below / span
        rest = 1.0 - share
        width = lengths[1] - lengths[0]
        bend = rest * (span / (slope[each, last] * width) - 1.0)
        bend -= share * (span / (slope[each, last + 1] * width) - 1.0)
        cubic = share + share * rest * bend
        guess = np.where((cubic >= 0.0) & (cubic <= 1.0), cubic, share)
        guess = np.where((guess >= 0.0) & (guess <= 1.0), guess, 0.5)
    first = lengths[last]
    # Too much force even at the shortest length of the table: as without a table.
    return reachable, np.where(small[:, 0], first, low), first + width, first + guess * width


def pressure_for_force(
    model: StaticModel,
    *,
    force: float,
    length: float,
    direction: float = 0.0,
    temperature: float = ROOM_TEMPERATURE,
) -> InverseResult:
    """The gauge pressure at which the muscle pulls with ``force`` [N] at ``length`` [m].

    Without a direction it is that without friction, and the details hold the lowest and the highest pressure
    at which friction holds the muscle there: those of lengthening and of shortening. None with `OUT_OF_REACH`
    when no pressure up to 40 bar does, or when the muscle pulls more than that without any pressure (it is
    stretched).
    """
    contraction = 1.0 - length / model.muscle.nominal_length

    def excess(pressure: float, direction: float = direction) -> float:
        reading = model.force(
            length=length, pressure=pressure, direction=direction, temperature=temperature, clipped=False
        )
        return float(reading[0]) - force

    flags = model.limits.flags(force=force, contraction=contraction)
    details: dict[str, float | None] = {"length": length, "contraction": contraction, "force": force}
    if length >= model.longest or excess(SEARCH_PRESSURE) < 0.0:
        most = None if length >= model.longest else excess(SEARCH_PRESSURE) + force
        why = (
            "the braid locks before this length"
            if most is None
            else f"at {contraction * 100:.3g} % contraction even {SEARCH_PRESSURE / 1e5:.0f} bar "
            + (f"gives only {most:.4g} N" if most > 0.0 else "leaves the muscle slack")
        )
        return InverseResult(None, "Pa", details, [*flags, LimitFlag(FlagCode.OUT_OF_REACH, why, "force")])
    without = excess(0.0)
    if without > 0.0:
        why = f"stretched to this length the muscle pulls {without + force:.4g} N without any pressure"
        return InverseResult(None, "Pa", details, [*flags, LimitFlag(FlagCode.OUT_OF_REACH, why, "force")])

    from scipy.optimize import root_scalar  # 0.2 s import, not paid at start

    pressure = 0.0
    if without < 0.0:
        pressure = float(root_scalar(excess, bracket=(0.0, SEARCH_PRESSURE), xtol=1e-6).root)
    if direction == 0.0:
        ends: list[float | None] = []
        for branch in (1.0, -1.0):
            weak, strong = excess(0.0, branch), excess(SEARCH_PRESSURE, branch)
            if weak < 0.0 <= strong:
                found = root_scalar(excess, args=(branch,), bracket=(0.0, SEARCH_PRESSURE), xtol=1e-6)
                ends.append(float(found.root))
            else:
                ends.append(0.0 if weak >= 0.0 else None)
        details |= _ends("pressure", *ends, least=1e-3)
    return InverseResult(pressure, "Pa", details, [*flags, *model.limits.flags(pressure=pressure)])


def _ends(name: str, low: float | None, high: float | None, *, least: float) -> dict[str, float | None]:
    """Both ends of the interval in which friction holds the muscle; none without friction."""
    if low is not None and high is not None and high - low < least:
        return {}
    return {f"lowest_{name}": low, f"highest_{name}": high}


def contraction_for_force(
    model: StaticModel,
    *,
    force: float,
    pressure: float,
    direction: float = 0.0,
    temperature: float = ROOM_TEMPERATURE,
) -> InverseResult:
    """The contraction ratio at which the muscle pulls with ``force`` [N] at a gauge pressure [Pa].

    Without a direction it is that without friction, and the details hold the least and the largest
    contraction at which friction holds the muscle: those reached by shortening and by lengthening.
    """
    contraction = float(
        contraction_at(
            model, load=force, pressures=np.array([pressure]), direction=direction, temperature=temperature
        )[0]
    )
    details: dict[str, float | None] = {"force": force, "pressure": pressure}
    flags = model.limits.flags(pressure=pressure, force=force)
    if np.isnan(contraction):
        why = f"{force:.4g} N stretches the muscle to the braid lock at {pressure / 1e5:.3g} bar"
        return InverseResult(None, "1", details, [*flags, LimitFlag(FlagCode.OUT_OF_REACH, why, "force")])
    details["length"] = model.muscle.nominal_length * (1.0 - contraction)
    if direction == 0.0:
        branches = np.array([-1.0, 1.0])
        low, high = contraction_at(
            model, load=force, pressures=np.full(2, pressure), direction=branches, temperature=temperature
        ).tolist()
        details |= _ends("contraction", *(None if np.isnan(end) else end for end in (low, high)), least=1e-9)
    return InverseResult(contraction, "1", details, [*flags, *model.limits.flags(contraction=contraction)])


def stroke_pressure(
    model: StaticModel,
    *,
    load: float,
    stroke: float,
    temperature: float = ROOM_TEMPERATURE,
) -> InverseResult:
    """The gauge pressure at which the muscle, filling, has lifted ``load`` [N] by ``stroke`` [m] from L0."""
    length = model.muscle.nominal_length - stroke
    return pressure_for_force(model, force=load, length=length, direction=-1.0, temperature=temperature)


def working_range(
    model: StaticModel,
    *,
    load: float,
    pressure: float,
    preload: float = 0.0,
    temperature: float = ROOM_TEMPERATURE,
) -> InverseResult:
    """The usable stroke [m]: from the length under ``preload`` [N] without pressure to that under ``load``.

    The start is the nominal length without preload; a preload stretches the muscle as far as its elastic
    effects allow. The end is the contraction under the load while filling, or the contraction limit of the
    maker if that comes first (flagged). Details hold both ends as contraction ratios.
    """
    rest = model.muscle.nominal_length
    flags = model.limits.flags(pressure=pressure, force=max(load, preload))
    start = 0.0
    if preload > 0.0:
        stretched = contraction_at(
            model, load=preload, pressures=np.zeros(1), direction=1.0, temperature=temperature
        )[0]
        if np.isnan(stretched):
            why = f"nothing in the model carries {preload:.4g} N without pressure short of the braid lock"
            flags.append(LimitFlag(FlagCode.OUT_OF_REACH, why, "preload"))
            return InverseResult(None, "m", {"start": None, "end": None}, flags)
        start = min(float(stretched), 0.0)
        flags += model.limits.flags(contraction=start)
    end = contraction_for_force(model, force=load, pressure=pressure, direction=-1.0, temperature=temperature)
    details: dict[str, float | None] = {"start": start, "end": end.value}
    if end.value is None:
        return InverseResult(None, "m", details, [*flags, *(f for f in end.flags if f not in flags)])
    reached = end.value
    limit = model.limits.max_contraction
    if limit is not None and reached > limit:
        flags += model.limits.flags(contraction=reached)
        details["end"] = reached = limit
    return InverseResult((reached - start) * rest, "m", details, flags)
