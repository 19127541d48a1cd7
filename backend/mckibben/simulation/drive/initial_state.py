"""The start of a run: where the load rests and why, computed from the compiled equations."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np

from mckibben.physics import gas
from mckibben.physics.braid import volume as braid_volume
from mckibben.physics.drive_terms import COUNTER, HIGH_STOP, LEAST_GUARD, LOW_STOP, SLACK
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.integrate.engine import CompiledDrive

# Net force that counts as none [N].
BALANCED = 1e-6
# Strokes that differ by less are one [m].
_SAME_PLACE = 1e-9


class Rest(Enum):
    """Why a run starts where it does; the value is a sentence for the user."""

    BALANCED = "in equilibrium of muscle and load at the start pressure"
    LOW_STOP = "on the lower end stop, where the load rests at the start pressure"
    HIGH_STOP = "on the upper end stop, where the load rests at the start pressure"
    ANYWHERE = (
        "on the lower end stop: without pressure the load would rest anywhere; a start position can be stated"
    )
    BELOW = "where it comes to rest from below at the start pressure, against its dry friction"
    ABOVE = "where it comes to rest from above at the start pressure, against its dry friction"
    STATED = "at the stated start position"


@dataclass(frozen=True, eq=False)
class Start:
    """States and switches at the start, stroke of the muscle [m], and why."""

    state: np.ndarray
    switches: np.ndarray
    stroke: float
    why: Rest


def start_of(drive: Drive, compiled: CompiledDrive, parameters: np.ndarray, inputs: np.ndarray) -> Start:
    """The states at the start: at rest, in equilibrium or on a stop, or at the stated position.

    Where the load could rest anywhere (a vented muscle, no force on the load) it starts on its lower stop.

    Args:
        drive: the drive.
        compiled: its equations.
        parameters: constants of the run.
        inputs: inputs before the run, shape (inputs,).

    Raises:
        InputError: the load stretches the muscle beyond its braid lock, or the stated position is not between
            the stops.
    """
    search = _Search(drive, compiled, parameters, inputs)
    low, high = drive.stops
    if drive.start_position is not None:
        stroke, why = stated_stroke(drive), Rest.STATED
    else:
        search.slide(drive.start_reached)
        stroke, why = _rest(drive, search.net_force)
        why = reached_rest(why, drive.start_reached) if search.directions else why
        search.slide(0)
    net = search.net_force(stroke)
    switches = np.zeros(len(compiled.model.switches))
    for index, switch in enumerate(compiled.model.switches):
        if switch.name == LOW_STOP:
            switches[index] = float(stroke <= low and net <= BALANCED)
        elif switch.name == HIGH_STOP:
            switches[index] = float(stroke >= high and net >= 0.0)
    start = search.settled(switches)
    settle(compiled, start, parameters, inputs)
    packed = np.concatenate([start, parameters, inputs])
    without_friction(compiled, switches, lambda given: compiled.guards(packed, given))
    return Start(start, switches, stroke, why)


def reached_rest(why: Rest, reached: int) -> Rest:
    """Why a load with dry friction starts where it does, which has come there from below or above."""
    return {0: why, 1: Rest.BELOW, -1: Rest.ABOVE}[reached] if why is Rest.BALANCED else why


def held_between(
    drive: Drive, compiled: CompiledDrive, parameters: np.ndarray, inputs: np.ndarray
) -> tuple[float, float] | None:
    """Lowest and highest stroke [m] at which dry friction holds the load at the start pressure; None without.

    Their ends are where the load comes to rest from below and from above: :math:`N(d = 1) = 0` and
    :math:`N(d = -1) = 0`, or an end stop.

    Raises:
        InputError: the load stretches the muscle beyond its braid lock.
    """
    search = _Search(drive, compiled, parameters, inputs)
    if not search.directions:
        return None
    ends = []
    for direction in (1, -1):
        search.slide(direction)
        ends.append(_rest(drive, search.net_force)[0])
    return (ends[0], ends[1]) if ends[1] - ends[0] > _SAME_PLACE else None


def without_friction(
    compiled: CompiledDrive, switches: np.ndarray, guards: Callable[[np.ndarray], np.ndarray]
) -> None:
    """Let a load that no stop and no dry friction holds slide: without friction nothing sticks; in place.

    Args:
        compiled: the equations; nothing is done where they contain no dry friction.
        switches: at the start, shape (switches,) or (switches, sets); a load with friction sticks there.
        guards: guards for switches, of their shape.
    """
    each = compiled.model.switches
    directions = [index for index, switch in enumerate(each) if switch.slides]
    if not directions:
        return
    free = switches.copy()
    stops = [index for index, switch in enumerate(each) if switch.stop]
    free[stops] = 0.0
    # The guards of a load that sticks are what is left of the range of the friction, upwards and downwards.
    wide = np.sum(guards(free)[directions], axis=0)
    switches[directions[0]] = (np.sum(switches[stops], axis=0) == 0.0) & (np.abs(wide) <= LEAST_GUARD)


def stated_stroke(drive: Drive) -> float:
    """The stroke of the muscle at the stated position [m].

    Raises:
        InputError: the position is not between the stops.
    """
    lever = drive.load.lever_ratio
    low, high = drive.stops
    stroke = (drive.start_position or 0.0) * lever
    if not low - 1e-12 <= stroke <= high + 1e-12:
        raise InputError(
            f"{stroke / lever * 1e3:.4g} mm is not between the end stops at {low / lever * 1e3:.4g} mm and "
            f"{high / lever * 1e3:.4g} mm",
            field="start.position",
        )
    return min(max(stroke, low), high)


def beyond_lock() -> InputError:
    """The error of a load that no start position holds."""
    return InputError(
        "the load stretches the muscle beyond its braid lock at the start pressure",
        field="load",
        hint="lower the mass or the external force, or set stops.min_contraction",
    )


def stroke_at_lock(drive: Drive) -> float:
    """The stroke at which the braid of the first muscle locks [m]; of a path the lower stop, short of it."""
    if drive.path is not None:
        return drive.stops[0]
    return drive.muscle.nominal_length * (1.0 - drive.precontraction) - drive.model.longest


def _rest(drive: Drive, net_force: Callable[[float], float]) -> tuple[float, Rest]:
    """The stroke at rest, and why; the net force does not increase with the stroke."""
    low, high = drive.stops
    lock = stroke_at_lock(drive)
    lowest = max(low, lock)
    below = net_force(lowest)
    if below < -BALANCED:
        if low < lock:
            raise beyond_lock()
        return low, Rest.LOW_STOP
    if below <= BALANCED:
        return lowest, Rest.ANYWHERE if net_force(high) >= -BALANCED else Rest.BALANCED
    if net_force(high) > BALANCED:
        return high, Rest.HIGH_STOP

    from scipy.optimize import brentq

    return float(brentq(lambda x: net_force(x) - BALANCED, lowest, high, xtol=1e-14)), Rest.BALANCED


class _Search:
    """The compiled equations at rest, as functions of the stroke."""

    def __init__(
        self, drive: Drive, compiled: CompiledDrive, parameters: np.ndarray, inputs: np.ndarray
    ) -> None:
        self.drive, self.compiled = drive, compiled
        absolute = drive.start_pressure + drive.ambient_pressure
        initial: dict[str, float] = dict.fromkeys(
            ("pressure", "tube_pressure", "regulator_pressure"), absolute
        )
        self.names = [state.name for state in compiled.model.states]
        self.specific = absolute / (gas.GAS_CONSTANT * drive.temperature)
        rough = float(braid_volume(braid=drive.muscle.braid, length=drive.muscle.nominal_length))
        self.packed = compiled.prepared(np.concatenate([np.zeros(compiled.size), parameters, inputs]))
        for index, state in enumerate(compiled.model.states):
            start = initial.get(state.name.removesuffix(COUNTER), 0.0)
            self.packed[index] = start if state.initial is None else state.initial
        for index in self._places("gas_mass"):
            self.packed[index] = self.specific * rough
        self.stroke = self.names.index("stroke")
        table = dict(zip(compiled.model.parameters, parameters, strict=True))
        #: Distance of the fittings at stroke 0 [m], unless they lie on a path.
        self.middle = float(table["nominal_length"] - table["precontraction"])
        self.lengths = self._places("length")
        self.net = compiled.model.output_names.index("net_force")
        self._outputs = np.empty(compiled.codes.outputs.width)
        self._call_outputs = compiled.codes.outputs.bound(self.packed, self._outputs)
        #: Places of the switches *slides up* and *slides down* among the arguments; none without friction.
        first = len(self.packed) - len(compiled.model.switches)
        self.directions = [first + n for n, switch in enumerate(compiled.model.switches) if switch.slides]
        self.slack = [
            index for index, switch in enumerate(compiled.model.switches) if switch.name.startswith(SLACK)
        ]

    def _places(self, name: str) -> list[int]:
        return [index for index, full in enumerate(self.names) if full.removesuffix(COUNTER) == name]

    def slide(self, direction: int) -> None:
        """Let `net_force` be that of a load that slides up (1) or down (-1), or has no friction (0)."""
        for place, sense in zip(self.directions, (1, -1), strict=False):
            self.packed[place] = float(sense == direction)

    def net_force(self, stroke: float) -> float:
        """Force along the stroke without that of the stops [N]."""
        self.packed[self.stroke] = stroke
        straight = (self.middle - stroke, self.middle + stroke)
        lengths = straight if self.drive.path is None else self.drive.lengths(stroke)
        for place, length in zip(self.lengths, lengths, strict=False):
            self.packed[place] = float(length)
        self._call_outputs()
        return float(self._outputs[self.net])

    def settled(self, switches: np.ndarray) -> np.ndarray:
        """The states where `net_force` was asked last; sets the switches of slack muscles."""
        for place, number in zip(self.lengths, self.slack, strict=True):
            if self._tension(number) < 0.0:
                switches[number] = 1.0
                self.packed[place] = self._free_length(place, number)
        outputs = self.compiled.codes.outputs(self.packed)
        for index in self._places("gas_mass"):
            name = "volume" + self.names[index].removeprefix("gas_mass")
            volume = float(outputs[self.compiled.model.output_names.index(name)])
            self.packed[index] = self.specific * volume
        return self.packed[: self.compiled.size].copy()

    def _tension(self, number: int) -> float:
        """Tension at rest of the muscle that this switch belongs to [N]; the switches are 0 here."""
        return float(self.compiled.codes.guards(self.packed)[number])

    def _free_length(self, place: int, number: int) -> float:
        """Length at which a slack muscle carries no tension [m]."""
        from scipy.optimize import brentq

        def tension(length: float) -> float:
            self.packed[place] = length
            return self._tension(number)

        short, longest = float(self.packed[place]), self.drive.model.longest
        long = min(self.drive.muscle.nominal_length, longest)
        if not (long > short and tension(long) >= 0.0):
            long = longest
        if not (long > short and tension(long) >= 0.0):
            return short
        return float(brentq(tension, short, long, xtol=1e-14))


def settle(compiled: CompiledDrive, start: np.ndarray, parameters: np.ndarray, inputs: np.ndarray) -> None:
    """Set the states that start settled (a spool, a lagged reading) to where their rates are zero, in place.

    Their rates are linear in them. Least squares, because a lag of zero makes a rate that is always zero.
    """
    chosen = [index for index, state in enumerate(compiled.model.states) if state.settled]
    if not chosen:
        return
    packed = np.concatenate([start, parameters, inputs])
    zero = compiled.rates(packed)[chosen]
    scales = np.array([compiled.model.states[index].scale for index in chosen])
    columns = []
    for index, scale in zip(chosen, scales, strict=True):
        packed[index] = start[index] + scale
        columns.append(compiled.rates(packed)[chosen] - zero)
        packed[index] = start[index]
    start[chosen] += scales * np.linalg.lstsq(np.column_stack(columns), -zero, rcond=None)[0]
