"""The timing table of a drive: figures of one fill and one vent, SI throughout.

`mckibben.facts.timing` defines each figure. Impacts, and a load at rest on a stop, count neither for speeds
nor for accelerations. The settling band is 5 % of the stroke by default: a load that stops between the end
stops may swing on the air by a few per cent long after it has arrived for practical purposes; a narrower band
gives the time until that oscillation has decayed. Where the pressure stands still near a level of a figure,
as between two pulses of a modulated valve, its last digits decide whether it passes before or behind the
pause: a note says from when to when it is within 0.1 % of the step. With a stated polytropic exponent, which
does not conserve mass, the air is counted from pressure and volume at ambient temperature.

A figure that does not exist is None; ``notes`` says why under ``extend.<figure>``. Figures of a step exist
where the command, or the reference of a controlled drive, is constant throughout the phase.

The motion of a phase of a step has a state, found in this order: it *never leaves*; it *swings* (two even
periods in its second half, or since it was first there, by more than half of the band to either side); it
*returns* (ends within a tenth of its largest travel from where it began); it *arrives and holds* (settles
within the band of the stop that it hits, or hits none and settles); it *arrives and bounces* (hits the stop
ahead, and settles away from it); a demanded stroke that is not kept, or a motion the other way, *never
arrives*; else it *drifts*: it still moves.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.result import Deferring, once, result_class
from mckibben.facts.timing import (
    MOTION_FIGURES,
    NO_STEP,
    PRESSURE_FIGURES,
    SETTLED_BEFORE,
    STEP_FIGURES,
    TIMING,
)
from mckibben.physics.gas import ANR_DENSITY
from mckibben.simulation.command.segments import Interval
from mckibben.simulation.timing.swing import Swing, swing_of
from mckibben.simulation.timing.trace import Impact, Trace

#: How the motion of a phase ends.
MotionState = Literal[
    "never_left", "swings", "returned", "arrived_and_held", "arrived_and_bounced", "never_arrived", "drifts"
]

# Figures that need an arrival.
_TIMED = ("positioning_time", "rise_time", "delay_time", "settling_time", "average_speed")
_SWING = ("swing_frequency", "swing_amplitude")
# Why there is no settling time; with an impact a load that still moves has arrived all the same.
_SETTLES = TIMING["settling_time"].exists_when.otherwise
_SWINGS = "the load swings until the end of the phase"
_MOVES = "arrives, but still moves at the end of the phase"

#: Travel [m] and pressure change [Pa] below these count as none.
SMALLEST_STROKE, SMALLEST_STEP = 1e-5, 100.0
PRESSURE_BAND = 0.01
# A level is passed, within this share of the step, in less than this share of the figure, or a note says so.
_SHARP, _SHARP_TIME = 0.001, 0.01
_MICROGRAM = 9  # decimals of a mass in kg; less is the error of the integration
_RETURNED = 0.1  # of the largest travel

Array = NDArray[np.float64]


@result_class
class PhaseFigures:
    """Figures of one phase, as `mckibben.facts.timing` defines them; None where one does not exist.

    Speeds are magnitudes along the motion of the phase, accelerations positive towards shorter in both.
    """

    FIGURES: ClassVar = TIMING.name

    stroke: float | None = None
    positioning_time: float | None = None
    rise_time: float | None = None
    delay_time: float | None = None
    settling_time: float | None = None
    average_speed: float | None = None
    max_speed: float | None = None
    max_speed_at: float | None = None
    max_acceleration: float | None = None
    max_acceleration_at: float | None = None
    min_acceleration: float | None = None
    min_acceleration_at: float | None = None
    end_speed: float | None = None
    impact_energy: float | None = None
    overshoot: float | None = None
    swing_frequency: float | None = None
    swing_amplitude: float | None = None
    pressure_rise_time: float | None = None
    pressure_delay_time: float | None = None
    pressure_settling_time: float | None = None
    supplied_mass: float | None = None
    supplied_volume_anr: float | None = None
    vented_mass: float | None = None
    vented_volume_anr: float | None = None
    tube_air_mass: float | None = None
    choked_share: float | None = None
    state: MotionState | None = None
    """How the motion ends; None where the command is no step, or there is no such phase."""
    motion: str | None = None
    """The same as a sentence with its evidence."""


@dataclass(frozen=True, slots=True)
class Phase:
    """A phase by the command.

    Attributes:
        interval: begin and end [s].
        target: position that the reference demands of the end [m]; None without a reference.
        stepped: whether command or reference are constant in it.
    """

    interval: Interval
    target: float | None = None
    stepped: bool = True


@result_class
class TimingTable(Deferring):
    """Figures of the first fill and of the vent after it."""

    extend: PhaseFigures = field(default_factory=PhaseFigures)
    """Figures of the first fill."""
    retract: PhaseFigures = field(default_factory=PhaseFigures)
    """Figures of the vent after it."""
    notes: dict[str, str] = field(default_factory=dict)
    """For example "extend.rise_time" -> why it is None, or a remark on it."""

    @classmethod
    def missing(cls, why: str) -> TimingTable:
        """A table without any figure, with the reason as a note."""
        return cls(notes={f"{phase}.{name}": why for phase in ("extend", "retract") for name in TIMING})


def timing(
    trace: Trace,
    *,
    fill: Phase | None,
    vent: Phase | None,
    mass: float | None = None,
    band: float = 0.05,
    delays: tuple[float, float] = (0.0, 0.0),
) -> TimingTable:
    """Figures of both phases.

    Args:
        trace: the run.
        fill, vent: by the command, see `mckibben.simulation.timing.evaluation.phases_of`; None when there is
            none. Figures for a demanded stroke that is not reached are None.
        mass: moving mass, for the impact energy [kg].
        band: settling band as a share of the stroke.
        delays: dead times of the valve for opening and closing [s]; so long the flow of the phase before goes
            on, and counts there.
    """
    motions = {
        name: once(partial(_of_phase, trace, phase, sign, mass, band, delays))
        for name, phase, sign in (("extend", fill, 1.0), ("retract", vent, -1.0))
    }
    return TimingTable.deferred(
        extend=lambda: motions["extend"]()[0],
        retract=lambda: motions["retract"]()[0],
        notes=lambda: {
            f"{name}.{figure}": why for name, found in motions.items() for figure, why in found()[1].items()
        },
    )


def _of_phase(
    trace: Trace, phase: Phase | None, sign: float, mass: float | None, band: float, delays: Interval
) -> tuple[PhaseFigures, dict[str, str]]:
    """The figures of a phase whose motion has a sign, and remarks on them."""
    window = None if phase is None else trace.window(*phase.interval)
    if phase is None or window is None:
        why = "the command has no such phase" if phase is None else "the run ended before this phase"
        return PhaseFigures(), dict.fromkeys(TIMING, why)
    motion = _Motion(window, sign, phase.target, band)
    figures, reasons = motion.figures(mass)
    late, later = delays if sign > 0.0 else delays[::-1]
    flows = window.time[0] + late, window.time[-1] + later
    for part, why in (motion.pressure(), air(trace, flows, sign)):
        figures |= part
        reasons |= why
    state, said = motion.state() if phase.stepped else (None, None)
    if not phase.stepped:
        figures |= dict.fromkeys(STEP_FIGURES)
        reasons |= dict.fromkeys(STEP_FIGURES, NO_STEP)
    return PhaseFigures(**figures, state=state, motion=said), reasons


Figures = tuple[dict[str, float | None], dict[str, str]]


class _Motion:
    """One phase: time from its switching instant, travel in its direction."""

    def __init__(self, window: Trace, sign: float, target: float | None, band: float) -> None:
        self.window, self.sign, self.band = window, sign, band
        self.time = window.time - window.time[0]
        self.contact, position = window.contact, window.position
        self.travel = sign * (position - float(position[0]))
        self.speed, self.acceleration = sign * window.velocity, sign * window.acceleration
        self.reached = float(self.travel[-1])
        self.demanded = target is not None
        self.stroke = self.reached if target is None else sign * (target - float(position[0]))
        self.last = float(self.time[-1])

    @cached_property
    def impact(self) -> Impact | None:
        """The first impact on the stop ahead."""
        return next((each for each in self.window.impacts if self.sign * each.velocity > 0.0), None)

    @cached_property
    def stays(self) -> str:
        """Why nothing moves; "" where something does."""
        if self.contact.all():
            return "the muscle stays on its stop"
        return "the muscle does not move" if np.ptp(self.travel) < SMALLEST_STROKE else ""

    @cached_property
    def swing(self) -> Swing | None:
        """The swing of the second half of a phase, or since the load was first there, of half of the band.

        Where a stroke is demanded, a load that stays within the band around it does not swing.
        """
        if self.stays or (self.demanded and self._within is not None):
            return None
        least, impact = 0.5 * self.band * abs(self.stroke), self.impact
        there = (self._first(0.9 * self.stroke) or 0.0) if impact is None else self._since(impact)
        for since in (0.5 * self.last, min(there, 0.5 * self.last)):
            rows = slice(int(np.searchsorted(self.time, since)), None)
            if not np.ptp(self.travel[rows]) > 2.0 * least:
                return None
            if (found := swing_of(self.time[rows], self.travel[rows])) is not None:
                return found if found.amplitude > least else None
        return None

    @cached_property
    def _within(self) -> float | None:
        """Since when the travel stays within the band around the stroke."""
        return None if self.stays else self._settled(self.travel, self.stroke, self.band * abs(self.stroke))

    @property
    def settled(self) -> float | None:
        """The same of a load that does not swing: of one that does, the last instant decides about it."""
        return None if self.swing is not None else self._within

    def state(self) -> tuple[MotionState, str]:
        """How the motion ends, and a sentence."""
        if self.stays:
            return "never_left", "stays on its stop" if self.contact.all() else "does not move"
        if (swing := self.swing) is not None:
            dies = "" if swing.growth > 0.98 else f", {100.0 * (1.0 - swing.growth):.2g} % less each period"
            size = f"{swing.frequency:.3g} Hz by ±{1e3 * swing.amplitude:.3g} mm"
            return "swings", f"swings until the end of the phase at {size}{dies}"
        most = float(np.abs(self.travel).max())
        reached, wanted = (f"{1e3 * x:.4g} mm".replace("-", "−") for x in (self.reached, self.stroke))
        if abs(self.reached) <= _RETURNED * most:
            return (
                "returned",
                f"goes {1e3 * most:.4g} mm and returns: the phase ends {reached} from its start",
            )
        if self.demanded and (self.settled is None or not self.stroke >= SMALLEST_STROKE):
            return (
                "never_arrived",
                f"is at {reached} of the demanded {wanted} at the end of the phase",
            )
        if self.reached < 0.0:
            return "never_arrived", f"goes the other way: it ends {reached} from its start"
        if self.settled is not None and self.impact is not None:
            behind = self._travel_to(self.impact) - self.reached
            if behind <= self.band * self._travel_to(self.impact):
                return "arrived_and_held", "arrives on the stop and holds"
            return "arrived_and_bounced", f"hits the stop, and rests {1e3 * behind:.3g} mm before it"
        if self.settled is not None:
            return "arrived_and_held", f"arrives after {reached} and holds"
        pace = f"{1e3 * float(self.speed[-1]):.3g} mm/s".replace("-", "−")
        return "drifts", f"still moves at {pace} at the end of the phase"

    def figures(self, mass: float | None) -> Figures:
        """Figures of position, speed and acceleration."""
        figures: dict[str, float | None] = dict.fromkeys(MOTION_FIGURES)
        if self.stays:
            return figures, dict.fromkeys(MOTION_FIGURES, self.stays)
        notes: dict[str, str] = {}
        impact, swing = self.impact, self.swing
        if swing is None:
            notes |= dict.fromkeys(_SWING, TIMING[_SWING[0]].exists_when.otherwise)
        else:
            figures |= dict(zip(_SWING, (swing.frequency, swing.amplitude), strict=True))
        self._extremes(figures, notes, impact)
        stroke = self.stroke
        figures["stroke"] = stroke
        stop = None if impact is None else self._travel_to(impact)
        if stop is not None:
            behind = stop - self.reached
            ends = "on the stop" if self.contact[-1] else f"{1e3 * behind:.3g} mm before the stop that it hit"
            notes["stroke"] = f"the phase ends {ends}"
        if not stroke >= SMALLEST_STROKE:
            why = (
                f"the phase ends {-1e3 * stroke:.3g} mm behind its start"
                if stroke < 0.0
                else "no stroke is left"
            )
            notes |= dict.fromkeys((*_TIMED, "end_speed", "overshoot"), why)
        else:
            for name, share in (("delay_time", 0.5), ("rise_time", 0.9)):
                figures[name] = self._first(share * stroke)
            if (late := figures["rise_time"]) is not None:
                figures["rise_time"] = late - (self._first(0.1 * stroke) or 0.0)
            settled = self.settled
            arrival, travelled = self._first((1.0 - self.band) * stroke), (1.0 - self.band) * stroke
            why = unsettled = _SETTLES
            on_stop = (
                stop is not None
                and swing is None
                and stop - self.reached <= self.band * stop
                and not (self.demanded and abs(stop - stroke) > self.band * stroke)
            )
            if swing is not None:
                why = unsettled = _SWINGS
            elif self.demanded:
                best = 1e3 * float(self.travel.max())
                why = unsettled = f"{best:.3g} mm of the {1e3 * stroke:.3g} mm are reached, or not kept"
            elif stop is not None and not on_stop:
                why = f"the load leaves the stop again: {notes['stroke']}"
            if not on_stop and (settled is None or (stop is not None and not self.demanded)):
                arrival = None
            if impact is not None and on_stop and arrival is not None:
                arrival, travelled = self._since(impact), self._travel_to(impact)
                settled = None if settled is None else max(settled, arrival)
                unsettled = why if self.demanded else _MOVES
            figures |= {"settling_time": settled, "positioning_time": arrival}
            if arrival:
                figures["average_speed"] = travelled / arrival
            if arrival is not None:
                figures["end_speed"] = float(np.interp(arrival, self.time, self.speed))
            if impact is None:
                figures["overshoot"] = max(0.0, float(self.travel.max()) / stroke - 1.0)
            else:
                notes["overshoot"] = TIMING["overshoot"].exists_when.otherwise
            reasons = {**dict.fromkeys((*_TIMED, "end_speed"), why), "settling_time": unsettled}
            notes |= {name: reason for name, reason in reasons.items() if figures[name] is None}
        if impact is None:
            figures["impact_energy"] = 0.0
            notes["impact_energy"] = "no stop is reached"
        else:
            figures["end_speed"] = self.sign * impact.velocity
            notes.pop("end_speed", None)
            if mass is None:
                notes["impact_energy"] = TIMING["impact_energy"].exists_when.otherwise
            else:
                figures["impact_energy"] = 0.5 * mass * impact.velocity**2
        return figures, notes

    def pressure(self) -> Figures:
        """Figures of the pressure."""
        pressure = self.window.pressure - self.window.pressure[0]
        figures: dict[str, float | None] = dict.fromkeys(PRESSURE_FIGURES)
        change = float(pressure[-1])
        if abs(change) < SMALLEST_STEP:
            return figures, dict.fromkeys(PRESSURE_FIGURES, "the pressure does not change")
        pressure = pressure * np.sign(change)
        change = abs(change)
        passed = np.maximum.accumulate(pressure)
        low, half, high = (self._linear_first(passed, share * change) for share in (0.1, 0.5, 0.9))
        settled = self._settled(pressure, change, PRESSURE_BAND * change, linear=True)
        figures = dict(zip(PRESSURE_FIGURES, (high - low, half, settled), strict=True))
        notes = {
            name: why
            for name, shares in (("pressure_rise_time", (0.1, 0.9)), ("pressure_delay_time", (0.5,)))
            if (why := self._blurred(passed, change, shares, figures[name]))
        }
        if settled is None:
            notes["pressure_settling_time"] = "the pressure still changes at the end of the phase"
        return figures, notes

    def _blurred(
        self, passed: Array, change: float, shares: tuple[float, ...], figure: float | None
    ) -> str | None:
        """From when to when the pressure is nearly at a level of a figure; None when it passes at once."""
        for share in shares:
            first, last = (self._linear_first(passed, (share + d) * change) for d in (-_SHARP, _SHARP))
            if figure is not None and last - first > _SHARP_TIME * figure:
                return (
                    f"from {first * 1e3:.4g} to {last * 1e3:.4g} ms the pressure is within {100 * _SHARP:g} "
                    f"% of its step around {100 * share:g} % of it: "
                    "the instant of the crossing is uncertain by that much"
                )
        return None

    def _extremes(
        self, figures: dict[str, float | None], notes: dict[str, str], impact: Impact | None
    ) -> None:
        """Largest speed and accelerations, without a load at rest on a stop."""
        free = np.flatnonzero(~self.contact)
        at, speed = self._fastest(int(free[np.argmax(self.speed[free])]))
        figures |= {"max_speed": max(speed, 0.0), "max_speed_at": at}
        values = self.window.acceleration
        for name, pick in (("max_acceleration", np.argmax), ("min_acceleration", np.argmin)):
            index = free[pick(values[free])]
            figures |= {name: float(values[index]), f"{name}_at": float(self.time[index])}
            if impact is not None:
                notes[name] = "without the impact"

    def _fastest(self, row: int) -> tuple[float, float]:
        """Instant and value of the largest speed, near its row: between rows by the cubic of speed."""
        best = float(self.time[row]), float(self.speed[row])
        for index in (row - 1, row):
            if not 0 <= index < len(self.time) - 1:
                continue
            pair = slice(index, index + 2)
            (t0, t1), (v0, v1), (a0, a1) = (
                column[pair].tolist() for column in (self.time, self.speed, self.acceleration)
            )
            if not a0 > 0.0 > a1:
                continue
            share = a0 / (a0 - a1)  # where the acceleration, linear in between, is zero
            w, width = 1.0 - share, t1 - t0
            speed = w * w * (v0 * (1.0 + 2.0 * share) + share * width * a0)
            speed += share * share * (v1 * (1.0 + 2.0 * w) - w * width * a1)
            best = max(best, (t0 + share * width, speed), key=lambda pair: pair[1])
        return best

    def _since(self, impact: Impact) -> float:
        """When an impact is, in the time of the phase."""
        return impact.time - float(self.window.time[0])

    def _travel_to(self, impact: Impact) -> float:
        """Travel from the start of the phase to the stop of an impact."""
        return self.sign * (impact.position - float(self.window.position[0]))

    def _first(self, level: float) -> float | None:
        """First instant at which the travel reaches the level."""
        reached = np.flatnonzero(self.travel >= level)
        if not len(reached):
            return None
        return 0.0 if reached[0] == 0 else self._between(int(reached[0]) - 1, level)

    def _between(self, index: int, level: float) -> float:
        """Instant between two samples at which the travel is at the level, by the cubic through both."""
        pairs = (self.time, self.travel, self.speed)
        (t0, t1), (s0, s1), (v0, v1) = (column[index : index + 2].tolist() for column in pairs)
        width = t1 - t0
        rising = s1 >= s0
        low, high, u = 0.0, 1.0, (level - s0) / (s1 - s0) if s1 != s0 else 0.5
        for _ in range(50):  # Newton's method within a bracket
            w = 1.0 - u
            here = w * w * (s0 * (1.0 + 2.0 * u) + u * width * v0)
            here += u * u * (s1 * (1.0 + 2.0 * w) - w * width * v1)
            if (here < level) == rising:
                low = u
            else:
                high = u
            slope = 6.0 * u * w * (s1 - s0) + width * (w * (1.0 - 3.0 * u) * v0 + u * (1.0 - 3.0 * w) * v1)
            following = u + (level - here) / slope if slope != 0.0 else low
            if abs(following - u) < 1e-15:
                break
            u = following if low < following < high else 0.5 * (low + high)
        return t0 + u * width

    def _linear_first(self, passed: Array, level: float) -> float:
        """First instant at which a signal reaches a level.

        Args:
            passed: running maximum of a signal that starts at 0 and ends above the level.
            level: above 0.
        """
        index = int(np.searchsorted(passed, level))
        (low, high), (t0, t1) = (column[index - 1 : index + 1].tolist() for column in (passed, self.time))
        return t0 + (t1 - t0) * (level - low) / (high - low)

    def _settled(self, values: Array, end: float, width: float, *, linear: bool = False) -> float | None:
        """Instant after which the values stay within the width around the end; None when not settled."""
        outside = np.flatnonzero(np.abs(values - end) > width)
        index = int(outside[-1]) if len(outside) else 0
        if index + 1 >= len(values):
            return None
        level = end + width if values[index] > end else end - width
        pair = np.array([index, index + 1] if values[index + 1] >= values[index] else [index + 1, index])
        at = float(np.interp(level, values[pair], self.time[pair])) if linear else self._between(index, level)
        under_way = at > SETTLED_BEFORE * self.last
        return None if under_way and not self.contact[-1] else at


def air(trace: Trace, flows: Interval, sign: float) -> Figures:
    """Figures of the air of a phase between the instants at which its flow begins and ends."""
    begin, end = np.minimum(flows, trace.time[-1])

    def change(column: Array) -> float:
        first, last = np.interp([begin, end], trace.time, column)
        return round(float(last - first), _MICROGRAM) + 0.0

    exchanged = {"supplied": change(trace.supplied), "vented": change(trace.vented)}
    passed = (trace.time >= begin) & (trace.time <= end)
    flow = trace.supply_mass_flow if sign > 0.0 else trace.exhaust_mass_flow
    flowing, time = np.where(passed, flow, 0.0), trace.time
    whole = float(np.trapezoid(flowing, time))
    choked = float(np.trapezoid(flowing * (trace.choked != 0), time))
    figures = {
        **{f"{way}_mass": mass for way, mass in exchanged.items()},
        **{f"{way}_volume_anr": mass / ANR_DENSITY for way, mass in exchanged.items()},
        "tube_air_mass": sign * change(trace.tube_charge),
        "choked_share": choked / whole if whole > 0.0 else None,
    }
    notes: dict[str, str] = {}
    if trace.from_states:
        said = (
            "from the change of pressure times volume at ambient temperature: with a stated polytropic "
            "exponent the flows do not conserve mass, and the flow over time integrates to another amount"
        )
        notes = {name: said for name in figures if name.startswith(("supplied", "vented"))}
        for way, mass in exchanged.items():
            if mass < 0.0:  # no flow goes that way: the exponent makes air of nothing
                figures |= {f"{way}_mass": None, f"{way}_volume_anr": None}
    if figures["choked_share"] is None:
        done = "taken from the supply" if sign > 0.0 else "let out"
        notes["choked_share"] = f"no air is {done} in this phase"
    return figures, notes
