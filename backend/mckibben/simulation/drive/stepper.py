"""A drive that is carried step by step: a command is set, time goes on, readings are taken."""

from __future__ import annotations

from copy import copy
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mckibben.physics.drive_terms import INPUTS
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.initial_state import start_of
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import (
    TOLERANCE,
    before_of,
    dead_times,
    external_force,
    parameters_of,
)
from mckibben.simulation.integrate.alone import Alone
from mckibben.simulation.integrate.engine import FIRST_STEP, compiled_drive
from mckibben.simulation.integrate.many import integrate_many
from mckibben.simulation.outcome import Outcome

_AT = {name: place for place, name in enumerate(INPUTS)}
_LONGEST = 10.0  # s, of a step


class Stepper:
    """The state of a drive, which `step` carries on by ``dt`` with the command held.

    The integrator and its equations are those of a run; each step ends exactly at its end. Dead times of the
    effects act on the commands as in a run; the time skew of a force reading does not act on readings.

    Args:
        drive: what to carry; its own command and controller are not used.
        dt: step [s].
        tolerance: relative error per step of the integrator.

    Raises:
        InputError: a step that is not positive, a drive whose valves are pulse-width modulated, no
            equilibrium to start from.
    """

    def __init__(self, drive: Drive, dt: float, *, tolerance: float = TOLERANCE) -> None:
        if not 0.0 < dt <= _LONGEST:
            raise InputError(f"a step of {dt:g} s is not between 0 and {_LONGEST:g} s", field="dt")
        if drive.pwm is not None:
            raise InputError(
                "pulse-width modulation generates the openings itself", field="pwm", hint="leave out pwm"
            )
        self.drive, self.dt, self.time = drive, dt, 0.0
        self._tolerance = tolerance
        self._compiled = compiled_drive(drive.structure)
        self._parameters = parameters_of(drive, self._compiled)
        self._alone = Alone(
            self._compiled, parameters=self._parameters, tolerance=tolerance, restitution=drive.restitution
        )
        self._delays = dead_times(drive)
        self._least = 0.0 if drive.regulator is not None else -1.0
        rest = np.zeros((1, len(INPUTS)))
        rest[0, _AT["external_force"]] = float(external_force(drive).value(0.0))
        before = before_of(drive, rest)
        start = start_of(drive, self._compiled, self._parameters, before)
        self._state, self._switches = start.state, start.switches
        self._command = self._acting = float(before[_AT["opening"]])
        self._pending: list[tuple[float, float]] = []
        self._load_force = float(rest[0, _AT["external_force"]])
        self._next = FIRST_STEP
        self._names = [state.name for state in self._compiled.model.states]
        self._names += list(self._compiled.model.output_names)
        self._row = self._alone.run(
            start=self._state, switches=self._switches, times=np.array([0.0, 1e-9]), inputs=before[None],
            grid=np.array([0.0]), first_step=1e-9,
        ).rows[0]  # fmt: skip

    @property
    def command(self) -> float:
        """The command that was set last."""
        return self._command

    def set(self, command: float, *, load_force: float | None = None) -> None:
        """The command from now on, -1 (0 of a regulator) to 1; and an external force against the pull [N].

        Raises:
            InputError: a command that the valve does not have.
        """
        value = float(command)
        if not self._least <= value <= 1.0:
            raise InputError(
                f"a command of {value:g} is not between {self._least:g} and 1", field="command",
                hint="limit it: min(max(command, -1.0), 1.0)",
            )  # fmt: skip
        if load_force is not None:
            self._load_force = float(load_force)
        if value == self._command:
            return
        at = self.time + self._delays[0 if value > self._command else 1]
        self._pending = [(when, what) for when, what in self._pending if when < at]
        self._pending.append((at, value))
        self._command = value

    def step(self) -> None:
        """Carry the drive on by ``dt``.

        Raises:
            InputError: the integrator cannot go on; says when.
        """
        end = self.time + self.dt
        times, levels = [self.time], [self._acting]
        while self._pending and self._pending[0][0] < end:
            at, level = self._pending.pop(0)
            if at > times[-1]:
                times.append(at)
                levels.append(level)
            else:
                levels[-1] = level
        times.append(end)
        done = self._alone.run(
            start=self._state, switches=self._switches, times=np.array(times),
            inputs=self._inputs(np.array(levels), np.array(times[:-1])), grid=np.array([end]),
            first_step=min(self._next, self.dt),
        )  # fmt: skip
        if done.outcome is not Outcome.COMPLETED or len(done.rows) == 0:
            raise InputError(f"the drive cannot be carried beyond {self.time:.6g} s: {done.outcome.label}")
        self._state, self._switches, self._row = done.end, done.switches, done.rows[0].copy()
        self._acting, self.time, self._next = levels[-1], end, done.next_step

    def _inputs(self, levels: NDArray[np.float64], begins: NDArray[np.float64]) -> NDArray[np.float64]:
        inputs = np.zeros((*levels.shape, len(INPUTS)))
        inputs[..., _AT["opening"]] = levels
        inputs[..., _AT["counter_opening"]] = self.drive.counter(0.0) - levels
        inputs[..., _AT["external_force"]] = self._load_force
        inputs[..., _AT["begin"]] = begins
        return inputs

    def value(self, name: str) -> float:
        """A state or output of the drive at this moment, by its name."""
        return float(self._row[self._names.index(name)])

    def copy(self) -> Self:
        """The same drive at the same moment, to be carried on apart."""
        other = copy(self)
        other._pending = list(self._pending)
        return other

    def ahead(self, commands: ArrayLike, names: tuple[str, ...]) -> NDArray[np.float64]:
        """What would be read if these commands were given, one a step; the drive itself stays where it is.

        All sequences run side by side in the kernel. Dead times shift the commands by whole steps.

        Args:
            commands: shape (sequences, steps).
            names: of the states or outputs that are wanted.

        Returns:
            Values at the end of each step, shape (sequences, steps, names); NaN after a run that ended early.

        Raises:
            InputError: no table of commands, or one that the valve does not have.
        """
        wanted = np.asarray(commands, dtype=np.float64)
        if wanted.ndim != 2 or not wanted.size:
            raise InputError(f"commands of the shape {wanted.shape}", hint="(sequences, steps)")
        if not np.all((wanted >= self._least) & (wanted <= 1.0)):
            raise InputError(f"a command is not between {self._least:g} and 1", field="commands")
        sequences, steps = wanted.shape
        late = round(max(self._delays) / self.dt)
        if late:
            first = np.full((sequences, late), self._acting)
            for when, level in self._pending:
                first[:, max(round((when - self.time) / self.dt), 0) :] = level
            wanted = np.concatenate([first, wanted], axis=1)[:, :steps]
        times = self.time + self.dt * np.arange(steps + 1)
        done = integrate_many(
            self._compiled,
            parameters=np.tile(self._parameters, (sequences, 1)),
            starts=np.tile(self._state, (sequences, 1)),
            switches=np.tile(self._switches, (sequences, 1)),
            times=times,
            inputs=self._inputs(wanted, np.broadcast_to(times[:-1], wanted.shape)),
            grid=times[1:],
            tolerance=self._tolerance,
            columns=names,
            restitution=self.drive.restitution,
            first_step=min(self._next, self.dt),
        )
        return done.rows.copy()

    @property
    def vector(self) -> NDArray[np.float64]:
        """States and switches, from which `carried` goes on."""
        return np.concatenate([self._state, self._switches])

    @property
    def vector_names(self) -> list[str]:
        """Names of the parts of `vector`."""
        model = self._compiled.model
        return [each.name for each in (*model.states, *model.switches)]

    def carried(self, vector: NDArray[np.float64], command: float, load_force: float) -> NDArray[np.float64]:
        """The vector one step later; a pure function, which leaves this drive where it is.

        Raises:
            InputError: the drive has dead times, which no state holds; or the integrator cannot go on.
        """
        if any(self._delays):
            raise InputError(
                f"the drive has dead times of {self._delays[0]:g} and {self._delays[1]:g} s, which no state "
                "holds",
                hint="leave the effects with dead times out, or use stepper(dt)",
            )
        other, size = self.copy(), self._compiled.size
        other._state, other._switches = vector[:size].copy(), np.round(vector[size:])
        other.time = float(vector[self._names.index("clock")])
        other._acting = min(max(float(command), self._least), 1.0)
        other._load_force, other._pending = float(load_force), []
        other.step()
        return other.vector
