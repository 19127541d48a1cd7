"""What the numbers of a channel can be: ranges of muscles on test benches, and units that lead there."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.physics.units import convert

#: Fewer readings show no range; what they say is taken as it stands.
ENOUGH = 5


class Range(NamedTuple):
    """Bounds of a channel [SI]: what its largest magnitude reaches, and its median does not exceed.

    Muscles of 5 to 80 mm diameter, up to 12 bar and 10 m; pressures too low to move one are none.
    """

    lowest: float
    highest: float


#: The largest catalogue muscle (80 mm) blocks with about 20 kN; the rest follows from ``Range``.
RANGES = {
    "pressure": Range(2e3, 1.3e6),
    "force": Range(0.05, 3e4),
    "length": Range(1e-3, 12.0),
    "displacement": Range(2e-5, 2.0),
    "diameter": Range(1e-3, 0.3),
    "contraction": Range(1e-4, 0.75),
    "velocity": Range(1e-5, 10.0),
}
#: Units that people leave out, the usual ones first.
_LEFT_OUT = {
    "pressure": ("bar", "kPa", "MPa", "psi", "mbar", "Pa"),
    "force": ("N", "kN", "lbf", "kgf"),
    "length": ("mm", "cm", "m", "in"),
    "displacement": ("mm", "cm", "m", "in"),
    "diameter": ("mm", "cm", "m", "in"),
    "contraction": ("%", "1"),
    "velocity": ("mm/s", "m/s"),
    "time": ("s", "ms", "min"),
}
_NARROW = {  # where the usual units overlap: ranges in which a bench really works
    "pressure": Range(3e4, 1.0e6),
    "force": Range(2.0, 1e4),
    "length": Range(0.04, 2.0),
    "displacement": Range(1e-3, 0.5),
    "diameter": Range(4e-3, 0.12),
    "contraction": Range(0.01, 0.5),
    "velocity": Range(1e-4, 2.0),
}
_STEPS = Range(1e-6, 4.0)  # s between the readings of a moving muscle


class Proposal(NamedTuple):
    """A unit for numbers without one, and all that would do; ``si_will_do``: SI is likely as it stands."""

    unit: str
    choices: tuple[str, ...]
    si_will_do: bool


def is_plausible(channel: str, values: NDArray[np.float64], *, narrow: bool = False) -> bool:
    """Whether a muscle on a bench can show these values [SI]."""
    if channel == "time":
        step = median_step(values)
        return step is None or _STEPS.lowest <= step <= _STEPS.highest
    bounds = (_NARROW if narrow else RANGES).get(channel)
    if bounds is None:
        return True
    sizes = np.abs(values)
    largest = float(np.max(sizes, initial=0.0))
    if largest == 0.0:
        return True
    # One spike or a short peak is no reason to doubt the unit of all readings.
    return largest >= bounds.lowest and float(np.median(sizes[sizes > 0.0])) <= bounds.highest


def median_step(time: NDArray[np.float64]) -> float | None:
    """Median step of a time axis [s]; None without two different times."""
    steps = np.diff(time[:100_000])
    steps = steps[steps > 0.0]
    return float(np.median(steps)) if len(steps) else None


def proposal(channel: str, values: NDArray[np.float64]) -> Proposal:
    """Units that numbers without unit could have, the likeliest first."""
    units = _LEFT_OUT.get(channel, ())
    si = CHANNEL_UNITS[channel]
    likely, possible = [], []
    for unit in units:
        converted = convert(values, unit, si)
        if is_plausible(channel, converted, narrow=True):
            likely.append(unit)
        elif is_plausible(channel, converted):
            possible.append(unit)
    choices = (*likely, *possible)
    si_will_do = si in likely or (si in possible and not likely) or si not in units
    if si_will_do:
        return Proposal(si, choices, True)
    return Proposal(choices[0] if choices else si, choices, False)
