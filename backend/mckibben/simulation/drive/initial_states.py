"""The starts of many runs at once; the rules are those of `mckibben.simulation.drive.initial_state`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.physics import gas
from mckibben.physics.braid import volume as braid_volume
from mckibben.physics.drive_terms import COUNTER, HIGH_STOP, LOW_STOP, SLACK
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import GEOMETRY, Muscle
from mckibben.simulation.drive.initial_state import (
    BALANCED,
    Rest,
    beyond_lock,
    reached_rest,
    start_of,
    stated_stroke,
    without_friction,
)
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.integrate.engine import CompiledDrive
from mckibben.simulation.integrate.lane_calls import LaneCalls
from mckibben.simulation.statics.model import longest_of


@dataclass(frozen=True, eq=False)
class Starts:
    """Starts of many runs.

    Attributes:
        states, switches: shapes (sets, states), (sets, switches).
        strokes: of the muscle [m], shape (sets,).
        why: of each set.
        errors: of each set why it has no start, None if it has one; states are NaN without one.
    """

    states: np.ndarray
    switches: np.ndarray
    strokes: np.ndarray
    why: tuple[Rest, ...]
    errors: tuple[InputError | None, ...]


def starts_of_many(
    drives: Drive | Sequence[Drive], compiled: CompiledDrive, parameters: np.ndarray, inputs: np.ndarray
) -> Starts:
    """The states at the start of each set, as `mckibben.simulation.drive.initial_state.start_of` finds them.

    Args:
        drives: the drive of each set, or one for all; its geometry and its stops are those of the parameters.
        compiled: their equations.
        parameters: constants of the runs, shape (sets, parameters).
        inputs: inputs before the runs, shape (inputs,) or (sets, inputs).
    """
    sets = len(parameters)
    each = [drives] * sets if isinstance(drives, Drive) else list(drives)
    if each and each[0].path is not None:
        return _one_by_one(each, compiled, np.asarray(parameters, float), np.asarray(inputs, float))
    with np.errstate(all="ignore"):
        return _Search(each, compiled, np.asarray(parameters, float), np.asarray(inputs, float)).found()


def _one_by_one(
    drives: list[Drive], compiled: CompiledDrive, parameters: np.ndarray, inputs: np.ndarray
) -> Starts:
    """The starts of joints whose levers change with the angle: their lengths are no lines of the stroke."""
    sets, size = len(drives), compiled.size
    states, strokes = np.full((sets, size), np.nan), np.full(sets, np.nan)
    switches = np.zeros((sets, len(compiled.model.switches)))
    why, errors = [Rest.BALANCED] * sets, list[InputError | None]([None] * sets)
    for place, drive in enumerate(drives):
        try:
            start = start_of(
                drive, compiled, parameters[place], inputs if inputs.ndim == 1 else inputs[place]
            )
        except InputError as error:
            errors[place] = error
            continue
        states[place], switches[place] = start.state, start.switches
        strokes[place], why[place] = start.stroke, start.why
    return Starts(states, switches, strokes, tuple(why), tuple(errors))


def _of_drives(drives: list[Drive], value: Callable[[Drive], float]) -> np.ndarray:
    known: dict[int, float] = {}
    for drive in drives:
        if id(drive) not in known:
            known[id(drive)] = value(drive)
    return np.array([known[id(drive)] for drive in drives])


class _Search:
    """The compiled equations at rest, as functions of the strokes."""

    def __init__(
        self, drives: list[Drive], compiled: CompiledDrive, parameters: np.ndarray, inputs: np.ndarray
    ) -> None:
        self.drives, self.compiled, model = drives, compiled, compiled.model
        self.calls = LaneCalls(compiled, parameters, inputs)
        self.names = [state.name for state in model.states]
        absolute = _of_drives(drives, lambda drive: drive.start_pressure + drive.ambient_pressure)
        temperature = _of_drives(drives, lambda drive: drive.temperature)
        self.specific = absolute / (gas.GAS_CONSTANT * temperature)
        for index, state in enumerate(model.states):
            plain = state.name.removesuffix(COUNTER)
            pressure = plain in ("pressure", "tube_pressure", "regulator_pressure")
            start = absolute if pressure else 0.0
            self.calls.put(index, start if state.initial is None else state.initial)
        table = dict(zip(model.parameters, parameters.T, strict=True))
        braid = Muscle(**{name: table[name] for name in GEOMETRY}).braid
        self.nominal = table["nominal_length"]
        rough = np.asarray(braid_volume(braid=braid, length=self.nominal))
        for index in self._places("gas_mass"):
            self.calls.put(index, self.specific * rough)
        self.low, self.high = table["stop_low"], table["stop_high"]
        self.middle = self.nominal - table["precontraction"]
        self.longest = np.asarray(longest_of(braid))
        self.lengths = self._places("length")
        volumes = [
            "volume" + self.names[index].removeprefix("gas_mass") for index in self._places("gas_mass")
        ]
        outputs = [model.output_names.index(name) for name in ("net_force", *volumes)]
        self.outputs, _ = compiled.lanes.outputs(outputs)

    def _places(self, name: str) -> list[int]:
        return [index for index, full in enumerate(self.names) if full.removesuffix(COUNTER) == name]

    def _follows(self) -> dict[int, tuple[np.ndarray | float, float]]:
        """The states that follow the strokes: number -> (offset, slope)."""
        found: dict[int, tuple[np.ndarray | float, float]] = {self.names.index("stroke"): (0.0, 1.0)}
        for place, sense in zip(self.lengths, (1.0, -1.0), strict=False):
            found[place] = (self.middle, -sense)
        return found

    def net_force(self, strokes: np.ndarray) -> np.ndarray:
        """Force along the stroke without that of the stops [N]."""
        for place, (offset, slope) in self._follows().items():
            self.calls.put(place, offset + slope * strokes)
        return self.calls.call(self.outputs)[0]

    def found(self) -> Starts:
        drives, model = self.drives, self.compiled.model
        low, high = self.low, self.high
        self._slide([drive.start_reached for drive in drives])
        strokes, why, errors = self._rest(low, high)
        self._slide([0] * len(drives))
        if any(switch.slides for switch in model.switches):
            why = [reached_rest(each, drive.start_reached) for each, drive in zip(why, drives, strict=True)]
        for index, drive in enumerate(drives):
            if drive.start_position is not None:
                try:
                    strokes[index], why[index], errors[index] = stated_stroke(drive), Rest.STATED, None
                except InputError as error:
                    errors[index] = error
        net = self.net_force(strokes)
        switches = np.zeros((len(drives), len(model.switches)))
        for index, switch in enumerate(model.switches):
            if switch.name == LOW_STOP:
                switches[:, index] = (strokes <= low) & (net <= BALANCED)
            elif switch.name == HIGH_STOP:
                switches[:, index] = (strokes >= high) & (net >= 0.0)
        self._loosen(switches)
        volumes = self.calls.call(self.outputs)[1:]
        for place, volume in zip(self._places("gas_mass"), volumes, strict=True):
            self.calls.put(place, self.specific * volume)
        self._settle()
        without_friction(self.compiled, switches.T, self._guards)
        states = np.column_stack([self.calls.get(index) for index in range(self.compiled.size)])
        states[[error is not None for error in errors]] = np.nan
        return Starts(states, switches, strokes, tuple(why), tuple(errors))

    def _slide(self, directions: list[int]) -> None:
        """Let the net force be that of loads that slide up (1) or down (-1), or have no friction (0)."""
        first = self.compiled.codes.rates.size - len(self.compiled.model.switches)
        for index, switch in enumerate(self.compiled.model.switches):
            if switch.slides:
                self.calls.put(first + index, np.equal(directions, switch.slides).astype(float))

    def _rest(
        self, low: np.ndarray, high: np.ndarray
    ) -> tuple[np.ndarray, list[Rest], list[InputError | None]]:
        """Strokes at rest, and why; the net force does not increase with the stroke."""
        precontraction = _of_drives(self.drives, lambda drive: drive.precontraction)
        lock = self.nominal * (1.0 - precontraction) - self.longest  # the stroke at the braid lock
        lowest = np.maximum(low, lock)
        below, above = self.net_force(lowest), self.net_force(high)
        hangs = below < -BALANCED
        free = ~hangs & (below <= BALANCED)
        lifted = ~hangs & ~free & (above > BALANCED)
        between = ~(hangs | free | lifted)
        strokes = np.where(hangs, low, np.where(lifted, high, lowest))
        line = (-BALANCED, 1.0)
        root = self.calls.roots(self.outputs, 0, self._follows(), (lowest, high), between, line)
        strokes = np.where(between, root, strokes)
        why = [
            Rest.LOW_STOP
            if hangs[index]
            else Rest.HIGH_STOP
            if lifted[index]
            else Rest.ANYWHERE
            if free[index] and above[index] >= -BALANCED
            else Rest.BALANCED
            for index in range(len(self.drives))
        ]
        return strokes, why, [beyond_lock() if lost else None for lost in hangs & (low < lock)]

    def _loosen(self, switches: np.ndarray) -> None:
        """Give slack muscles their free length, and set their switches."""
        slack = [i for i, switch in enumerate(self.compiled.model.switches) if switch.name.startswith(SLACK)]
        for place, number in zip(self.lengths, slack, strict=True):
            short = self.calls.get(place)
            loose = self._tension(number) < 0.0
            if not loose.any():
                continue
            switches[loose, number] = 1.0

            def tension(length: np.ndarray, place: int = place, number: int = number) -> np.ndarray:
                self.calls.put(place, length)
                return self._tension(number)

            long = np.minimum(self.nominal, self.longest)
            long = np.where((long > short) & (tension(long) >= 0.0), long, self.longest)
            taut = (long > short) & (tension(long) >= 0.0)
            jacobian = self.compiled.lanes.step["jacobian"]
            guard = jacobian.width - len(self.compiled.model.switches) + number
            ends, follows = (short, long), {place: (0.0, 1.0)}
            root = self.calls.roots(jacobian, guard, follows, ends, loose & taut, (0.0, -1.0))
            self.calls.put(place, np.where(loose & taut, root, short))

    def _tension(self, number: int) -> np.ndarray:
        """Tensions at rest of the muscles that a switch belongs to [N]; the switches are 0 here."""
        guards = self.calls.call(self.compiled.lanes.step["jacobian"])[-len(self.compiled.model.switches) :]
        return guards[number]

    def _guards(self, switches: np.ndarray) -> np.ndarray:
        """Guards of the sets, shape (switches, sets)."""
        first, kinds = self.compiled.codes.rates.size - len(switches), len(switches)
        for index, values in enumerate(switches):
            self.calls.put(first + index, values)
        guards = self.calls.call(self.compiled.lanes.step["jacobian"])[-kinds:]
        for index in range(kinds):
            self.calls.put(first + index, 0.0)
        return guards

    def _settle(self) -> None:
        """Set the states that start settled to where their rates, linear in them, are zero."""
        states = self.compiled.model.states
        chosen = [index for index, state in enumerate(states) if state.settled]
        if not chosen:
            return
        rates = self.compiled.lanes.step["rates"]
        zero = self.calls.call(rates)[chosen]
        scales = np.array([states[index].scale for index in chosen])
        columns = []
        for index, scale in zip(chosen, scales, strict=True):
            start = self.calls.get(index)
            self.calls.put(index, start + scale)
            columns.append(self.calls.call(rates)[chosen] - zero)
            self.calls.put(index, start)
        # Least squares, because a lag of zero makes a rate that is always zero.
        matrices = np.stack(columns, axis=-1).transpose(1, 0, 2)  # (sets, rates, states)
        broken = ~np.isfinite(matrices).all(axis=(1, 2))
        matrices[broken] = 0.0
        changes = -np.einsum("qij,jq->iq", np.linalg.pinv(matrices), np.where(broken, 0.0, zero))
        for row, index in enumerate(chosen):
            self.calls.put(index, self.calls.get(index) + scales[row] * changes[row])
