"""Windows of a run: begun anew at several instants, from what was measured there.

A window begins with the states of the whole run at its instant, with these differences: stroke and speed are
the measured ones, and where pressures are computed, so is the pressure, with the air that belongs to it. All
windows run side by side.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.physics.drive_terms import COUNTER, HIGH_STOP, LOW_STOP, SLACK
from mckibben.simulation.drive.initial_state import start_of, without_friction
from mckibben.simulation.drive.many_runs import Pieces
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.records import begun_motion
from mckibben.simulation.drive.transient import TOLERANCE, before_of, parameters_of, skewed
from mckibben.simulation.integrate.engine import CompiledDrive, compiled_drive, compiled_driven
from mckibben.simulation.integrate.many import integrate_many
from mckibben.simulation.outcome import MAX_STEPS

_PRESSURES = ("pressure", "tube_pressure")  # states that are shifted with the measured pressure
_MOVING = 3.0  # standard uncertainties of a speed from which a load with dry friction slides


@dataclass(frozen=True, eq=False)
class Measured:
    """What was measured at the rows of a run, shape (rows,) each.

    Attributes:
        stroke: reading of the stroke of the muscle [m], without noise as far as possible.
        speed, uncertainty: its rate and the standard uncertainty of that [m/s].
        pressure: gauge reading [Pa]; None where the pressure is an input.
        states: "effect.state" -> values followed along the measured motion; those of other states are the
            run's own.
    """

    stroke: np.ndarray
    speed: np.ndarray
    uncertainty: np.ndarray
    pressure: np.ndarray | None
    states: Mapping[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class WholeRun:
    """A run from the beginning of a record, which windows begin from.

    Attributes:
        drive: what ran.
        compiled: its equations.
        parameters: its constants.
        pieces: boundaries of its segments and their inputs.
        tolerance: relative error per step.
        grid: times of the rows [s].
        columns: state or output -> values of the rows that the run reached.
    """

    drive: Drive
    compiled: CompiledDrive
    parameters: np.ndarray
    pieces: Pieces
    tolerance: float
    grid: np.ndarray
    columns: Mapping[str, np.ndarray]

    def windows(
        self, spans: Sequence[tuple[int, int]], measured: Measured, readings: Sequence[str]
    ) -> list[dict[str, np.ndarray]]:
        """The readings of each window at the rows after its first one, NaN where it ends early.

        Args:
            spans: numbers of the first and last row of each window.
            measured: at all rows.
            readings: names of outputs, "stroke_reading".
        """
        begun = [self._begun(first, measured) for first, _ in spans]
        found: list[dict[str, np.ndarray]] = [{} for _ in spans]
        alike: dict[tuple[int, int], list[int]] = {}
        cut = [self._cut(self.grid[first], self.grid[last]) for first, last in spans]
        for number, ((first, last), (times, _)) in enumerate(zip(spans, cut, strict=True)):
            alike.setdefault((len(times), last - first), []).append(number)
        for group in alike.values():
            grid = np.array([self.grid[spans[n][0] + 1 : spans[n][1] + 1] for n in group])
            with np.errstate(all="ignore"):
                solutions = integrate_many(
                    self.compiled,
                    parameters=np.tile(self.parameters, (len(group), 1)),
                    starts=np.array([begun[n][0] for n in group]),
                    switches=np.array([begun[n][1] for n in group]),
                    restitution=self.drive.restitution,
                    times=np.array([cut[n][0] for n in group]),
                    inputs=np.array([cut[n][1] for n in group]),
                    grid=grid,
                    tolerance=self.tolerance,
                    columns=tuple(readings),
                    max_steps=MAX_STEPS,
                )
            for place, number in enumerate(group):
                rows = dict(zip(readings, solutions.rows[place].T.copy(), strict=True))
                if "force_reading" in rows:
                    rows["force_reading"] = skewed(self.drive.model, grid[place], rows["force_reading"])
                found[number] = rows
        return found

    def _cut(self, begin: float, end: float) -> Pieces:
        """Boundaries and inputs between two times; the inputs of a cut segment still count from its own."""
        times, inputs = self.pieces
        first = max(int(np.searchsorted(times, begin, side="right")) - 1, 0)
        last = min(int(np.searchsorted(times, end, side="left")), len(times) - 1)
        inner = times[first + 1 : last]
        return np.concatenate([[begin], inner, [end]]), inputs[first : first + len(inner) + 1]

    def _begun(self, row: int, measured: Measured) -> tuple[np.ndarray, np.ndarray]:
        """States and switches of a window that begins at a row."""
        model, drive = self.compiled.model, self.drive
        names = [state.name for state in model.states]
        own = {name: float(values[row]) for name, values in self.columns.items()}
        state = {name: own[name] for name in names}
        state |= {name: float(values[row]) for name, values in measured.states.items() if name in state}
        # A zero error of the sensor is that of the model: only the difference of the readings counts.
        low, high = drive.stops
        wanted = own["stroke"] + float(measured.stroke[row]) - own["stroke_reading"]
        state["stroke"] = min(max(wanted, low), high)
        state["speed"] = float(measured.speed[row])
        moved = state["stroke"] - own["stroke"]
        for name, sense in (("length", 1.0), (f"length{COUNTER}", -1.0)):
            if name in state:
                state[name] -= sense * moved
        if measured.pressure is not None:
            self._fill(state, own, float(measured.pressure[row]) - own["pressure_reading"])
        inputs = self._cut(float(self.grid[row]), float(self.grid[row]))[1][0]
        packed = np.concatenate([[state[name] for name in names], self.parameters, inputs])
        switches = np.zeros(len(model.switches))
        for index, switch in enumerate(model.switches):
            if switch.name.startswith(SLACK) and self.compiled.guards(packed)[index] < 0.0:
                switches[index] = 1.0
        self._hold(state, packed, switches, (low, high), float(measured.uncertainty[row]))
        packed[names.index("speed")] = state["speed"]
        return packed[: len(names)], switches

    def _fill(self, state: dict[str, float], own: Mapping[str, float], change: float) -> None:
        """Shift the pressures of the muscle, and let it hold the air of its volume at its own temperature."""
        for name in _PRESSURES:
            if name in state:
                state[name] = max(own[name] + change, 1.0)
        if "gas_mass" not in state:
            return
        names = [each.name for each in self.compiled.model.states]
        inputs = self.pieces[1][0]
        packed = np.concatenate([[state[name] for name in names], self.parameters, inputs])
        volume = self.compiled.outputs(packed)[self.compiled.model.output_names.index("volume")]
        share = state["pressure"] * float(volume) / (own["pressure"] * own["volume"])
        state["gas_mass"] = own["gas_mass"] * share

    def _hold(
        self,
        state: dict[str, float],
        packed: np.ndarray,
        switches: np.ndarray,
        stops: tuple[float, float],
        uncertainty: float,
    ) -> None:
        """Set the switches of stops and dry friction; a load that one of them holds has no speed."""
        model = self.compiled.model
        stopped = False
        for index, switch in enumerate(model.switches):
            # A stop that holds nothing back lets go at once.
            if switch.name == LOW_STOP:
                switches[index] = float(state["stroke"] <= stops[0] and state["speed"] <= 0.0)
            elif switch.name == HIGH_STOP:
                switches[index] = float(state["stroke"] >= stops[1] and state["speed"] >= 0.0)
            stopped = stopped or bool(switch.stop and switches[index])
        without_friction(self.compiled, switches, lambda given: self.compiled.guards(packed, given))
        slides = [index for index, switch in enumerate(model.switches) if switch.slides]
        rubs = bool(slides) and not any(switches[index] for index in slides)
        if stopped or (rubs and abs(state["speed"]) <= _MOVING * uncertainty):
            state["speed"] = 0.0
            return
        if not rubs:
            return
        for index in slides:
            switches[index] = float(model.switches[index].slides * state["speed"] > 0.0)


def whole_motion(
    drive: Drive,
    *,
    time: np.ndarray,
    pressure: np.ndarray,
    stroke: float,
    speed: float = 0.0,
    grid: np.ndarray,
    tolerance: float,
    max_steps: int = MAX_STEPS,
) -> WholeRun:
    """The motion of a load under a measured pressure; see `mckibben.simulation.drive.records`.

    Args:
        drive, time, pressure, stroke, grid, tolerance, max_steps: as `motions_of_records` takes them.
        speed: at the start [m/s].

    Raises:
        InputError: times that do not ascend.
    """
    compiled = compiled_driven(drive.model.effects, motion=True)
    begun = begun_motion(drive, compiled, time=time, pressure=pressure, stroke=stroke, speed=speed)
    pieces = (np.asarray(time, dtype=float), begun.inputs)
    return _whole(
        drive, compiled, begun.parameters, pieces, (begun.start, begun.switches), grid, tolerance, max_steps
    )


def whole_run(drive: Drive, pieces: Pieces, *, grid: np.ndarray, max_steps: int = MAX_STEPS) -> WholeRun:
    """The run of a commanded drive; see `mckibben.simulation.drive.many_runs`.

    Args:
        drive, pieces, grid, max_steps: as `readings_of_many` takes them.

    Raises:
        InputError: the drive has no start.
    """
    compiled = compiled_drive(drive.structure)
    parameters = parameters_of(drive, compiled)
    start = start_of(drive, compiled, parameters, before_of(drive, pieces[1]))
    return _whole(
        drive, compiled, parameters, pieces, (start.state, start.switches), grid, TOLERANCE, max_steps
    )


def _whole(
    drive: Drive,
    compiled: CompiledDrive,
    parameters: np.ndarray,
    pieces: Pieces,
    begun: tuple[np.ndarray, np.ndarray],
    grid: np.ndarray,
    tolerance: float,
    max_steps: int,
) -> WholeRun:
    names = (*(state.name for state in compiled.model.states), *compiled.model.output_names)
    with np.errstate(all="ignore"):
        solution = integrate_many(
            compiled,
            parameters=parameters[None],
            starts=begun[0][None],
            switches=begun[1][None],
            restitution=drive.restitution,
            times=pieces[0],
            inputs=pieces[1],
            grid=grid,
            tolerance=tolerance,
            columns=names,
            max_steps=max_steps,
        )
    rows = solution.rows[0, : solution.written[0]]
    return WholeRun(
        drive, compiled, parameters, pieces, tolerance, grid, dict(zip(names, rows.T.copy(), strict=True))
    )
