"""Physical likelihood of readings in SI [nats]: what a muscle does, whatever the columns are called.

Every term is bounded, so that one odd sensor does not outweigh clear words, and has its name for the
messages. Terms
are computed for all rival answers alike, or the answer without the term would win.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.reading.model import Array
from mckibben.physics.units import STANDARD_ATMOSPHERE, convert

ATMOSPHERE = STANDARD_ATMOSPHERE  # Pa
LONGEST = 0.42  # contraction that hardly a muscle exceeds
_IMPOSSIBLE = 0.5  # and none, also where it is pushed together
ROWS = 300  # rows that are looked at
ENOUGH = 5  # rows; fewer show no range
_MANY = 20  # rows, from which single ones can be odd
_TAIL, _FAR, _FEW = 0.1, 3.0, 0.03  # quantile of the usual values, their widths beyond it, share of the rows
_STRETCH = 0.06  # of the rest length, beyond which a muscle is hardly stretched
_USUAL_AREA = 9e-4  # m2, force over pressure of a muscle of unknown diameter
_SPREAD_KNOWN, _SPREAD_UNKNOWN = 0.9, 1.2  # of its logarithm, with and without a known diameter

Terms = list[tuple[str, float]]


class Range(NamedTuple):
    """Bounds of a channel [SI]: what its largest magnitude reaches, and its median does not exceed."""

    lowest: float
    highest: float


#: Muscles of 5 to 80 mm diameter, up to 12 bar and 10 m; the largest blocks with about 20 kN.
POSSIBLE = {
    "pressure": Range(2e3, 1.3e6), "force": Range(0.05, 5e4), "length": Range(1e-3, 12.0),
    "displacement": Range(2e-5, 2.0),
    "diameter": Range(1e-3, 0.3), "contraction": Range(1e-4, 0.75), "velocity": Range(1e-5, 10.0),
}  # fmt: skip
#: Where usual units overlap: ranges in which a bench really works.
USUAL = {
    "pressure": Range(3e4, 1.0e6), "force": Range(2.0, 1e4), "length": Range(0.04, 2.0),
    "displacement": Range(1e-3, 0.5),
    "diameter": Range(4e-3, 0.12), "contraction": Range(0.01, 0.5), "velocity": Range(1e-4, 2.0),
}  # fmt: skip
#: Units that people leave out, the usual ones first.
LEFT_OUT = {
    "pressure": ("bar", "kPa", "MPa", "psi", "mbar", "Pa"), "force": ("N", "kN", "lbf", "kgf"),
    "length": ("mm", "cm", "m", "in"), "displacement": ("mm", "cm", "m", "in"),
    "diameter": ("mm", "cm", "m", "in"),
    "contraction": ("%", "1"), "velocity": ("mm/s", "m/s"), "time": ("s", "ms", "min"),
    "temperature": ("degC", "K"),
    "command": ("1", "%"), "angle": ("deg", "rad"), "torque": ("N*m",), "lever": ("mm", "cm", "m", "in"),
}  # fmt: skip
_STEPS = Range(1e-6, 4.0)  # s between the readings of a moving muscle


class Proposal(NamedTuple):
    """A unit for numbers without one, all that would do, and whether the SI unit is likely as it stands."""

    unit: str
    choices: tuple[str, ...]
    si_will_do: bool


def is_plausible(channel: str, values: Array, *, usual: bool = False) -> bool:
    """Whether a muscle on a bench can show these values [SI]; a few spikes are no reason to doubt a unit."""
    if channel == "time":
        step = median_step(values)
        return step is None or _STEPS.lowest <= step <= _STEPS.highest
    bounds = (USUAL if usual else POSSIBLE).get(channel)
    sizes = np.abs(values[np.isfinite(values)])
    largest = float(np.max(sizes, initial=0.0))
    if bounds is None or largest == 0.0:
        return True
    return largest >= bounds.lowest and float(np.median(sizes[sizes > 0.0])) <= bounds.highest


def median_step(time: Array) -> float | None:
    """Median step of a time axis [s]; None without two different times."""
    steps = np.diff(time[:100_000])
    steps = steps[steps > 0.0]
    return float(np.median(steps)) if len(steps) else None


def proposal(channel: str, raw: Array) -> Proposal:
    """Units that numbers without unit could have, the likeliest first."""
    units, si = LEFT_OUT.get(channel, ()), CHANNEL_UNITS[channel]
    likely, possible = [], []
    for unit in units:
        values = convert(raw, unit, si)
        if is_plausible(channel, values, usual=True):
            likely.append(unit)
        elif is_plausible(channel, values):
            possible.append(unit)
    choices = (*likely, *possible)
    si_will_do = si in likely or (si in possible and not likely) or si not in units
    return Proposal(si if si_will_do else choices[0] if choices else si, choices, si_will_do)


def core(values: Array) -> Array:
    """The values without a few that lie far away from all others, as NaN: they are errors of single rows,
    and say nothing of what the column is.
    """
    finite = values[np.isfinite(values)]
    if len(finite) < _MANY:
        return values
    low, high = np.quantile(finite, (_TAIL, 1.0 - _TAIL))
    width = max(high - low, _TAIL * max(abs(low), abs(high)))
    with np.errstate(invalid="ignore"):
        far = (values < low - _FAR * width) | (values > high + _FAR * width)
    few = 0 < np.count_nonzero(far) <= max(1, int(_FEW * len(finite)))
    return np.where(far, np.nan, values) if few else values


def alone(channel: str, x: Array, rest: float | None, blocks: int) -> Terms:
    """What the readings of one column say by themselves; ``x`` finite."""
    if len(x) < 2:
        return [("it has hardly a reading", -9.0)]
    match channel:
        case "pressure":
            return _pressure(x)
        case "force":
            return _force(x, None)
        case "length" | "contraction" | "displacement":
            return _stroke(channel, x, rest)
        case "time":
            return _time(x, blocks)
        case "command":
            return [("a command is a share of the opening", -6.0)] if float(np.max(np.abs(x))) > 1.001 else []
    return []


def _pressure(p: Array) -> Terms:
    """A gauge pressure between a weak vacuum and what a muscle bears."""
    low, high = np.percentile(p, (1, 99))
    terms = []
    if not 0.3e5 <= high <= 10e5:
        terms.append(
            ("the highest pressure is not that of a muscle", -1.5 if 0.1e5 <= high <= 17e5 else -6.0)
        )
    if low < -0.15e5:
        terms.append(("the pressure is far below the atmosphere", -5.0 if low < -0.4e5 else -1.5))
    return terms


def _force(f: Array, p: Array | None) -> Terms:
    """A muscle pulls, with newtons to kilonewtons."""
    size = np.percentile(np.abs(f), 99)
    terms = []
    if not 2.0 <= size <= 6000.0:
        terms.append(
            (
                "the force is not of the order of a muscle's",
                -2.0 if POSSIBLE["force"].lowest <= size <= POSSIBLE["force"].highest else -6.0,
            )
        )
    pressed = f if p is None else f[p > 0.3 * max(p.max(), 1.0)]
    if len(pressed) and abs(np.median(pressed)) > 0.02 * size:
        terms.append(("a muscle pulls", 3.0 if np.median(pressed) > 0 else -4.0))
    return terms


def _stroke(channel: str, x: Array, rest: float | None) -> Terms:
    """Contractions between a slight stretch and 42 %, lengths of a muscle."""
    low, high = np.percentile(x, (0.5, 99.5))
    if channel == "length":
        terms = [] if 0.02 <= high <= 2.5 and low > 0 else [("the length is not that of a muscle", -6.0)]
        if low > 0 and (high - low) > LONGEST * high:
            share = (high - low) / high
            terms.append(("it contracts by more than 42 %", -2.0 if share < _IMPOSSIBLE else -5.0))
        if rest and not (0.55 * rest <= low and high <= 1.12 * rest):
            terms.append(("the length does not fit the rest length", -5.0))
        return terms
    scale = rest if channel == "displacement" else 1.0
    if scale is None:
        if high <= 0.001 and low < -0.001:
            return [("all readings would be stretches", -5.0)]
        over = max(high, -low)
        terms = []
        if over > 0.25 or over < 2e-4:
            terms.append(("the stroke is not that of a muscle", -2.0 if over <= 0.4 else -6.0))
        if -min(0.0, low) > 0.3 * max(high, 1e-9) and over > 0.002:
            terms.append(("it would be stretched as far as it contracts", -4.0))
        return terms
    terms = []
    if high > LONGEST * scale:
        terms.append(("it contracts by more than 42 %", -2.0 if high < _IMPOSSIBLE * scale else -6.0))
    if low < -_STRETCH * scale:
        terms.append(("it would be stretched by more than 6 %", -5.0))
    if high < 0.002 * scale and low < -0.004 * scale:
        terms.append(("all readings would be stretches", -3.0))
    if channel == "contraction" and max(high, -low) < 0.004:
        terms.append(("it hardly contracts at all", -1.5))
    return terms


def _time(t: Array, blocks: int) -> Terms:
    """Time grows, and a record takes seconds to days."""
    steps = np.diff(t)
    back = int(np.sum(steps < 0))
    few = max(3, blocks, len(t) // 100)
    terms = [("time grows", 2.0 if back == 0 and np.any(steps > 0) else -0.5 if back <= few else -3.5)]
    if not 0.05 <= np.ptp(t) <= 3e6:
        terms.append(("the record would last too short or too long", -3.0))
    return terms


def together(
    p: Array | None, f: Array | None, channel: str, x: Array | None, diameter: float | None, *, gauge: bool
) -> Terms:
    """Force over P A (3 cos^2 - 1); force falls with contraction and rises with pressure; the zero of the
    pressure.

    Args:
        p: pressure as it is counted in the file [Pa].
        f: force [N].
        channel: what the stroke is.
        x: stroke.
        diameter: of the muscle, if it is known [m].
        gauge: whether the pressure is taken as gauge; what tells its zero speaks for that, or against it.
    """
    terms: Terms = []
    s = None if x is None else (-x if channel == "length" else x)
    zero: Terms = []
    if p is not None and f is not None:
        terms += _of_size(p, f, diameter)
        terms += [
            (text, value - (3.0 if value > 0 else 0.0))
            for text, value in _force(f, p)
            if text == "a muscle pulls"
        ]
        zero += _at_rest(p, f)
        if s is not None:
            if _varies(s, 0.003) and np.std(f) > 0:
                apart = (
                    1.0 - _corr(s, p) ** 2
                )  # where pressure and stroke go together, neither tells the other's part
                terms.append(("the force falls as it contracts", -3.0 * _partial(f, s, p) * apart**0.5))
            if np.ptp(p) > 0.1 * max(np.max(np.abs(p)), 1.0):
                terms.append(("the force rises with the pressure", _clip(2.0 * _partial(f, p, s), 2.0)))
            zero += _zeros(p, f, s)
        elif np.ptp(p) > 0.1 * np.max(np.abs(p)):
            terms.append(("the force rises with the pressure", 2.0 * _corr(f, p)))
            zero += _zeros(p, f, np.zeros_like(p))
    elif p is not None and s is not None and np.ptp(p) > 0.1 * np.max(np.abs(p)) and _varies(s, 0.003):
        terms.append(("it contracts as the pressure rises", 3.0 * _corr(s, p)))
    sign = 1.0 if gauge else -1.0
    return terms + [(text, sign * value) for text, value in zero]


def _of_size(p: Array, f: Array, diameter: float | None) -> Terms:
    """The largest forces over their pressures are of the order of 3 times the area."""
    top = np.argsort(f)[-max(3, len(f) // 50) :]
    ratio = np.median(f[top]) / max(np.median(p[top]), 1.0)
    if ratio <= 0:
        return []
    usual, spread = (
        (3.0 * np.pi * diameter**2 / 4, _SPREAD_KNOWN) if diameter else (_USUAL_AREA, _SPREAD_UNKNOWN)
    )
    off = (np.log(ratio) - np.log(usual)) / spread
    return [("force over pressure times area", max(-6.0, -0.5 * off**2))]


def _zeros(p: Array, f: Array, s: Array) -> Terms:
    """Where the force vanishes by F = p g(s) - h(s): at no gauge pressure, or at one atmosphere; ``p`` as
    read.
    """
    if np.ptp(p) < 0.4 * np.max(np.abs(p)) or np.std(f) == 0:
        return []
    z = (s - np.percentile(s, 10)) / (np.std(s) or 1.0)  # 0 near the least contraction
    q = p / 1e5
    base = (
        np.column_stack([q, q * z, q * z * z, np.ones_like(q), z, z * z])
        if np.std(s) > 0
        else np.column_stack([q, np.ones_like(q)])
    )
    found = np.linalg.lstsq(base, f, rcond=None)[0]
    left = f - base @ found
    gain, loss = found[0], found[3 if len(found) > 2 else 1]
    if gain <= 0 or np.std(left) > 0.15 * np.std(f):
        return []
    zero = -loss / gain  # bar; the threshold of the rubber adds some
    return [
        (
            "the force vanishes without pressure",
            _clip(((zero - 1.2) ** 2 - (zero - 0.2) ** 2) / (2 * 0.4**2), 3.0),
        )
    ]


def _at_rest(p: Array, f: Array) -> Terms:
    """A file that begins or ends without pressure shows its zero: as gauge it would be 0 there."""
    still = np.abs(f) < 0.03 * np.max(np.abs(f))
    if still.sum() < 3 or np.std(p) < 0.1e5:
        return []
    low = np.median(p[still])
    if abs(low) < 0.06e5:
        return [("the pressure is 0 at rest", 1.5)]
    if abs(low - ATMOSPHERE) < 0.06e5 and np.max(p) > 1.3e5:
        return [("the pressure is 1 atm where the force is nothing", -2.5)]
    return []


def _clip(value: float, bound: float) -> float:
    return float(min(bound, max(-bound, value)))


def _varies(s: Array, share: float) -> bool:
    """Whether readings differ by more than a share of the largest, one lone reading apart."""
    off = np.sort(np.abs(s - np.median(s)))[:-1]
    return bool(off[-1] > 0.5 * share * max(np.max(np.abs(s)), 1e-9))


def _corr(a: Array, b: Array) -> float:
    if np.std(a) == 0 or np.std(b) == 0:
        return 0.0
    return float(np.corrcoef(a, b)[0, 1])


def _partial(a: Array, b: Array, fixed: Array) -> float:
    """Correlation of a and b at equal ``fixed``."""
    if np.std(fixed) == 0:
        return _corr(a, b)
    base = np.column_stack([np.ones_like(fixed), fixed])
    ra, rb = (v - base @ np.linalg.lstsq(base, v, rcond=None)[0] for v in (a, b))
    return _corr(ra, rb) if np.std(rb) > 1e-6 * max(np.std(b), 1e-12) else 0.0
