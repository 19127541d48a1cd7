"""The operating point: equilibrium at a stated position, contraction, pressure or command."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from mckibben.physics.drive_terms import HIGH_STOP, LOW_STOP
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.initial_state import BALANCED, beyond_lock
from mckibben.simulation.linear.bound import BoundDrive

Array = np.ndarray
Kind = Literal["position", "contraction", "pressure", "command"]

_FIELD = "at"
_LEAST_FLOW = 1e-6  # opening with which the search of a valve that feeds a leak begins [-]
_STILL = 1e-7  # a rate over the scale of its state that counts as none [1/s]


@dataclass(frozen=True, slots=True)
class Condition:
    """What is stated of the point: position [m], contraction [-], gauge pressure [Pa] or command [-]."""

    kind: Kind
    value: float


@dataclass(frozen=True)
class OperatingPoint:
    """An equilibrium.

    Attributes:
        bound: the drive.
        state, switches: of the equations.
        command: that keeps it there [-].
        direction: 0 at rest; 1 the muscle slides shorter, -1 longer, against its full friction.
        on_stop: name of the end stop the load rests on, None if it is free.
    """

    bound: BoundDrive
    state: Array
    switches: Array
    command: float
    direction: int = 0
    on_stop: str | None = None

    def _of(self, name: str) -> float:
        return float(self.state[self.bound.names.index(name)])

    @property
    def stroke(self) -> float:
        """Stroke of the muscle [m]."""
        return self._of("stroke")

    @property
    def position(self) -> float:
        """Position of the load [m]."""
        return self.stroke / self.bound.drive.load.lever_ratio

    @property
    def contraction(self) -> float:
        """Contraction ratio of the (first) muscle [-]."""
        drive = self.bound.drive
        return self.stroke / drive.muscle.nominal_length + drive.precontraction

    @property
    def pressure(self) -> float:
        """Gauge pressure in the (first) muscle [Pa]."""
        return self._of("pressure") - self.bound.drive.ambient_pressure

    @property
    def pressures(self) -> tuple[float, ...]:
        """Gauge pressures in all muscles [Pa]."""
        places = self.bound.places("pressure")
        return tuple(float(self.state[i]) - self.bound.drive.ambient_pressure for i in places)

    @property
    def force(self) -> float:
        """Tension of the (first) muscle [N]."""
        values = self.bound.values(self.state, self.command, self.switches, direction=self.direction)
        return values.outputs["force"]

    @property
    def friction(self) -> tuple[float, float]:
        """Force [N] on the load that its dry friction still takes at rest, upwards and downwards."""
        state = self.state.copy()
        state[self.bound.names.index("speed")] = 0.0
        return self.bound.range_left(state, self.command)

    @property
    def motion(self) -> int | None:
        """How the load moves under small changes, see `BoundDrive.values`: dry friction holds it at rest."""
        return self.direction or (None if any(self.friction) else 0)


def operating_point(bound: BoundDrive, condition: Condition | None, *, direction: int = 0) -> OperatingPoint:
    """The equilibrium that fulfils a condition.

    Args:
        bound: the drive.
        condition: None is the middle of the positions that can be held.
        direction: 0 at rest without the friction of the moment; 1 or -1 where the muscle just slides.

    Raises:
        InputError: there is no such equilibrium; says which there are. Field "at".
    """
    search = _Search(bound, direction)
    if condition is None:
        condition = Condition("position", search.middle_position())
    drive = bound.drive
    if condition.kind == "command":
        condition = _pressure_of(bound, condition.value)
    if condition.kind == "contraction":
        stroke = (condition.value - drive.precontraction) * drive.muscle.nominal_length
        condition = Condition("position", stroke / drive.load.lever_ratio)
    if condition.kind == "position":
        point = search.at_stroke(condition.value * drive.load.lever_ratio)
    else:
        point = search.at_pressure(condition.value)
    slack = [tension < -BALANCED for tension in bound.tensions(point.state)]
    if any(slack):
        which = "the muscle hangs" if len(slack) == 1 else "one muscle of the pair hangs"
        raise InputError(
            f"at {point.position * 1e3:.4g} mm and {max(point.pressure, 0.0) / 1e5:.3g} bar {which} slack: "
            "there is no tension to linearise",
            field=_FIELD,
            hint="state a lower position or a higher pressure, or a load that pulls on the muscle",
        )
    return point


def at_speed(point: OperatingPoint, speed: float) -> OperatingPoint:
    """The point of a sliding load with the speed at which its slopes are wanted [m/s]."""
    state = point.state.copy()
    state[point.bound.names.index("speed")] = point.direction * speed * point.bound.drive.load.lever_ratio
    return replace(point, state=state)


def held_positions(bound: BoundDrive) -> tuple[float, float]:
    """Lowest and highest position [m] that pressures up to the highest can hold.

    Raises:
        InputError: the load does not move. Field "at".
    """
    return _Search(bound, 0).held_positions()


def _pressure_of(bound: BoundDrive, command: float) -> Condition:
    regulator = bound.drive.regulator
    if regulator is None:
        raise InputError(
            f"no command of a valve states an operating point: {command:g} fills or vents without end, and "
            "closed it holds any pressure",
            field=_FIELD,
            hint='state a position or a pressure, e.g. "pressure 3 bar"',
        )
    if not 0.0 <= command <= 1.0:
        raise InputError(
            f"command {command:g} is not between 0 and 1", field=_FIELD, hint='e.g. "command 0.5"'
        )
    return Condition("pressure", min(command * regulator.range, bound.highest_pressure))


class _Search:
    """Equilibria of a drive at rest, or while it just slides."""

    def __init__(self, bound: BoundDrive, direction: int) -> None:
        self.bound, self.direction = bound, direction
        drive = bound.drive
        self.low, self.high = drive.stops
        lock = drive.muscle.nominal_length * (1.0 - drive.precontraction) - drive.model.longest
        self.lowest = max(self.low, lock)
        self.top = bound.highest_pressure

    def pressures(self, pressure: float) -> tuple[float, float]:
        """Pressures of both muscles when the first has this one: of a pair their sum is constant."""
        drive = self.bound.drive
        if not drive.pair:
            return pressure, 0.0
        return pressure, max(self.sum_of_pair - pressure, 0.0)

    @property
    def sum_of_pair(self) -> float:
        """Sum of a pair's pressures: mirrored regulators share their range, valves keep what they have."""
        drive = self.bound.drive
        if drive.regulator is not None:
            if drive.common is not None:
                return min(2.0 * drive.common * drive.regulator.range, 2.0 * self.top)
            return min(drive.regulator.range, self.top)
        return 2.0 * drive.start_pressure if drive.start_pressure > 0.0 else self.top

    @property
    def most(self) -> float:
        """Highest pressure of the first muscle [Pa]."""
        return min(self.top, self.sum_of_pair) if self.bound.drive.pair else self.top

    def net(self, stroke: float, pressure: float) -> float:
        """Force along the stroke without that of the stops [N]."""
        state = self.bound.rest(stroke, self.pressures(pressure), 0.0, self.direction)
        return self.bound.values(state, 0.0, self.bound.free, direction=self.direction).outputs["net_force"]

    def stroke_at(self, pressure: float) -> tuple[float, str | None]:
        """The stroke at a pressure, and the stop that the load rests on there."""
        if self.net(self.lowest, pressure) < -BALANCED:
            if self.low < self.lowest:
                raise beyond_lock()
            return self.low, LOW_STOP
        if self.net(self.high, pressure) > BALANCED:
            return self.high, HIGH_STOP
        return _root(lambda stroke: self.net(stroke, pressure), self.lowest, self.high), None

    def held_positions(self) -> tuple[float, float]:
        """Lowest and highest position that pressures up to the highest can hold [m]."""
        lever = self.bound.drive.load.lever_ratio
        low, high = self.stroke_at(0.0)[0], self.stroke_at(self.most)[0]
        if high - low < 1e-6:
            raise InputError(
                f"the load does not move: up to {self.most / 1e5:.3g} bar it stays at "
                f"{low / lever * 1e3:.4g} mm",
                field=_FIELD,
                hint="change the load, the supply pressure or the end stops",
            )
        return low / lever, high / lever

    def middle_position(self) -> float:
        """Middle of the positions that pressures up to the highest can hold [m]."""
        return 0.5 * sum(self.held_positions())

    def at_stroke(self, stroke: float) -> OperatingPoint:
        """The equilibrium at a stroke."""
        lever = self.bound.drive.load.lever_ratio
        if not self.lowest <= stroke <= self.high:
            raise InputError(
                f"{stroke / lever * 1e3:.4g} mm is not between the ends at "
                f"{self.lowest / lever * 1e3:.4g} mm and {self.high / lever * 1e3:.4g} mm",
                field=_FIELD,
            )
        least, most = self.net(stroke, 0.0), self.net(stroke, self.most)
        if least > BALANCED or most < -BALANCED:
            raise self._out_of_reach(stroke / lever, least, most)
        if abs(least) <= BALANCED:
            pressure = 0.0
        elif abs(most) <= BALANCED:
            pressure = self.most
        else:
            pressure = _root(lambda each: self.net(stroke, each), 0.0, self.most)
        return self._refined(stroke, pressure, "stroke")

    def _out_of_reach(self, position: float, least: float, most: float) -> InputError:
        lever = self.bound.drive.load.lever_ratio
        ends = [self.stroke_at(pressure)[0] / lever * 1e3 for pressure in (0.0, self.most)]
        hint = f"positions from {ends[0]:.4g} mm to {ends[1]:.4g} mm can be held"
        if most < -BALANCED:
            why = f"at {self.most / 1e5:.3g} bar the load pulls {-most / lever:.3g} N more than the muscle"
        else:
            why = f"without pressure the muscle already pulls {least / lever:.3g} N more than the load"
        return InputError(
            f"there is no equilibrium at {position * 1e3:.4g} mm: {why}", field=_FIELD, hint=hint
        )

    def at_pressure(self, pressure: float) -> OperatingPoint:
        """The equilibrium at a pressure, which may be on an end stop."""
        if not 0.0 <= pressure <= self.most * (1.0 + 1e-9):
            raise InputError(
                f"{pressure / 1e5:.4g} bar is not between 0 and the {self.most / 1e5:.4g} bar that the "
                "supply and the regulator allow",
                field=_FIELD,
            )
        stroke, stop = self.stroke_at(pressure)
        if stop is None:
            return self._refined(stroke, pressure, "pressure")
        return self._refined(stroke, pressure, "pressure", stop)

    def _followed(self, state: Array, command: float, switches: Array) -> Array:
        """The states with those of the valve where a constant command has moved them, as behind a play."""
        bound = self.bound
        moved = {effect.id for effect in bound.drive.model.effects if "opening" in effect.slots}
        own = [i for i, name in enumerate(bound.names) if name.partition(".")[0] in moved]
        for _ in range(8 if own else 0):
            values = bound.values(state, command, switches)
            step = np.linalg.lstsq(values.a[np.ix_(own, own)], -values.rates[own], rcond=1e-13)[0]
            state = state.copy()
            state[own] += step
        return state

    def _refined(self, stroke: float, pressure: float, fixed: str, stop: str | None = None) -> OperatingPoint:
        """Newton's method on all rates: leaks, droop and lags take their part."""
        bound, direction = self.bound, self.direction
        regulator = bound.drive.regulator
        command = 0.0 if regulator is None else pressure / regulator.range
        state = bound.rest(stroke, self.pressures(pressure), command, direction)
        switches = bound.free
        for index, switch in enumerate(bound.equations.model.switches):
            switches[index] = float(switch.name == stop)
        state = self._followed(state, command, switches)
        keep, expansion, scales = bound.independent, bound.expansion, bound.scales
        names = [bound.names[index] for index in keep]
        moving = {"stroke", "speed"}
        rows = [i for i, name in enumerate(names) if name != "stroke" and not (stop and name == "speed")]
        fixed_names = moving if stop or fixed == "stroke" else {"speed", "pressure"}
        if stop:
            fixed_names = {*moving, "pressure"}
        columns = [i for i, name in enumerate(names) if name not in fixed_names]
        counter = 1 if bound.drive.pair else 0
        for _ in range(40):
            values = bound.values(state, command, switches, direction=direction)
            residual = (values.rates[keep] / scales)[rows]
            leaks = regulator is None and command == 0.0 and np.abs(residual).max(initial=0.0) > _STILL
            if leaks:
                command = _LEAST_FLOW  # at 0 the flow of a valve has no derivative
                continue
            a = (values.a @ expansion)[keep] * scales / scales[:, None]
            b = values.b[keep, 0] / scales
            if counter:
                b = b - values.b[keep, 3] / scales
            matrix = np.column_stack([a[np.ix_(rows, columns)], b[rows]])
            step = np.linalg.lstsq(matrix, -residual, rcond=1e-13)[0]
            if not np.isfinite(step).all():
                break
            change = np.zeros(len(keep))
            change[columns] = step[:-1] * scales[columns]
            state = state + expansion @ change
            command += float(step[-1])
            if np.abs(step).max(initial=0.0) < 1e-13:
                break
        values = bound.values(state, command, switches, direction=direction)
        residual = np.abs(values.rates[keep] / scales)[rows]
        if not np.isfinite(residual).all() or residual.max(initial=0.0) > _STILL:
            worst = names[rows[int(np.nanargmax(np.where(np.isfinite(residual), residual, np.inf)))]]
            raise InputError(
                f"there is no equilibrium: the state '{worst}' of the drive does not come to rest",
                field=_FIELD,
                hint="state another position or pressure",
            )
        lowest = 0.0 if regulator is not None else -1.0
        if not lowest - 1e-9 <= command <= 1.0 + 1e-9:
            raise InputError(
                f"there is no equilibrium: the drive loses so much air that a command of {command:.3g} would "
                "be needed",
                field=_FIELD,
                hint="reduce the leak, or choose a larger valve",
            )
        return OperatingPoint(bound, state, switches, min(max(command, lowest), 1.0), direction, stop)


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    from scipy.optimize import root_scalar

    if function(low) * function(high) > 0.0:  # within the error of a balance
        return low if abs(function(low)) < abs(function(high)) else high
    found = root_scalar(function, bracket=(low, high), xtol=1e-13 * max(1.0, abs(high)), rtol=1e-14)
    return float(found.root)
