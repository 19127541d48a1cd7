"""A drive in the hands of a controller of the user's own: set a command, step, read."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mckibben.door.problem import reported
from mckibben.door.values import FloatArray, Quantity, number_of
from mckibben.extras import of_extra
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.simulation.drive.stepper import Stepper as Engine

#: What is read -> name in the equations; position and velocity are those of the load.
_READINGS = {
    "position": "stroke_reading", "velocity": "speed", "pressure": "pressure_reading",
    "force": "force_reading", "mass_flow": "mass_flow", "opening": "opening",
}  # fmt: skip


def nonlinear_plant(engine: Engine) -> Any:
    """The drive in discrete time as ``control.NonlinearIOSystem``; it starts from ``params["start"]``.

    Raises:
        InputError: python-control is not installed, or the drive has dead times.
    """
    control = python_control()
    names, drive = engine.vector_names, engine.drive
    lever, ambient = drive.load.lever_ratio, drive.ambient_pressure
    places = [names.index(name) for name in ("stroke", "speed", "pressure")]
    engine.carried(engine.vector, engine.command, 0.0)  # whether it can be one

    def update(_time: float, x: FloatArray, u: FloatArray, _params: object) -> FloatArray:
        return engine.carried(np.asarray(x), float(u[0]), float(u[1]))

    def output(_time: float, x: FloatArray, _u: FloatArray, _params: object) -> FloatArray:
        stroke, speed, pressure = (float(x[place]) for place in places)
        return np.array([stroke / lever, speed / lever, pressure - ambient])

    return control.nlsys(
        update, output, inputs=["command", "load_force"], outputs=["position", "velocity", "pressure"],
        states=names, dt=engine.dt, name="drive", params={"start": engine.vector},
    )  # fmt: skip


def python_control() -> Any:
    """The module of python-control.

    Raises:
        InputError: it is not installed.
    """
    return of_extra("control")


class Stepper:
    """A drive that is carried on in steps of ``dt``, from `Drive.stepper`; SI, pressures gauge.

    The command is held during a step: opening of the valve from -1 (vent) to 1 (fill), of a regulator its
    share from 0 to 1. The integrator is that of `Drive.run`, 40 microseconds a step of a usual drive.

    >>> import mckibben as mk
    >>> plant = mk.Drive.preset("propneu-20-physical").stepper("5 ms")
    >>> for _ in range(40):  # a controller that closes the valve at 100 mm
    ...     plant.set(1.0 if plant.position < 0.1 else 0.0)
    ...     plant.step()
    >>> plant.position > 0.1
    True
    """

    __slots__ = ("_engine", "_lever")

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self._lever = engine.drive.load.lever_ratio

    @property
    def dt(self) -> float:
        """Step [s]."""
        return self._engine.dt

    @property
    def time(self) -> float:
        """Time since the start [s]."""
        return self._engine.time

    @property
    def command(self) -> float:
        """The command that was set last."""
        return self._engine.command

    @property
    def position(self) -> float:
        """Position of the load as its sensor reads it, positive = muscle shorter [m]."""
        return self._engine.value("stroke_reading") / self._lever

    @property
    def velocity(self) -> float:
        """Speed of the load [m/s]."""
        return self._engine.value("speed") / self._lever

    @property
    def pressure(self) -> float:
        """Gauge pressure in the (first) muscle as its sensor reads it [Pa]."""
        return self._engine.value("pressure_reading")

    @property
    def force(self) -> float:
        """Tension of the muscle as its sensor reads it [N]."""
        return self._engine.value("force_reading")

    def read(self) -> dict[str, float]:
        """All readings by name, SI: position, velocity, pressure, force, mass_flow, opening."""
        return {name: self._engine.value(own) / self._scale(name) for name, own in _READINGS.items()}

    def _scale(self, name: str) -> float:
        return self._lever if name in ("position", "velocity") else 1.0

    @reported
    def set(self, command: float, *, load_force: Quantity | None = None) -> None:
        """The command, and if stated the external force against the pull, from now on.

        Raises:
            Problem: a command that the valve does not have.
        """
        force = None if load_force is None else number_of(load_force, "N", "load_force")
        self._engine.set(command, load_force=force)

    @reported
    def step(self, steps: int = 1) -> None:
        """Carry the drive on by some steps.

        Raises:
            Problem: the integrator cannot go on; says when.
        """
        for _ in range(steps):
            self._engine.step()

    def copy(self) -> Stepper:
        """The same drive at the same moment, carried on apart: to look ahead."""
        return Stepper(self._engine.copy())

    @reported
    def ahead(self, commands: ArrayLike, read: str = "position") -> FloatArray:
        """What would be read after each step if these commands were given; this drive stays where it is.

        All sequences run side by side, so that a controller can compare many of them within its sample time.

        Args:
            commands: shape (sequences, steps), or (steps,) for one.
            read: position, velocity, pressure, force, mass_flow or opening.

        Returns:
            SI, with the shape of the commands; NaN from where a run ended early.

        Raises:
            Problem: a shape or a command that cannot be used, or no such reading.
        """
        if read not in _READINGS:
            raise InputError(f"there is no reading '{read}'", hint=did_you_mean(read, _READINGS))
        table: Any = np.asarray(commands, dtype=np.float64)
        found = self._engine.ahead(np.atleast_2d(table), (_READINGS[read],))[:, :, 0] / self._scale(read)
        return found[0] if table.ndim == 1 else found

    def __repr__(self) -> str:
        return f"<Stepper at {self.time:.6g} s: position {self.position:.6g} m, command {self.command:g}>"
