"""A drive with its compiled equations and its numbers, evaluated at states and commands."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mckibben.physics import gas
from mckibben.physics.braid import volume as braid_volume
from mckibben.physics.drive_terms import COUNTER, INPUTS, LEAST_GUARD, SLACK
from mckibben.simulation.drive.initial_state import settle
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import external_force, parameters_of
from mckibben.simulation.integrate.engine import CompiledDrive, compiled_drive
from mckibben.simulation.linear.equations import LinearEquations, Values, linear_equations

Array = np.ndarray

# A muscle that just slides: its speed [m/s] is far below every other speed of the model.
SLIDING_SPEED = 1e-9
# Fastest sliding that can be stated [m/s]: muscles move by a few metres per second.
FASTEST_SLIDING = 10.0
# A command is moved this far to one side of a point at which the equations switch [-].
ASIDE = 1e-9


@dataclass(frozen=True)
class BoundDrive:
    """A drive and its equations.

    Attributes:
        drive: in SI.
    """

    drive: Drive

    @cached_property
    def equations(self) -> LinearEquations:
        """Rates, outputs and derivatives."""
        return linear_equations(self.drive.structure)

    @cached_property
    def compiled(self) -> CompiledDrive:
        """The equations as the engine runs them."""
        return compiled_drive(self.drive.structure)

    @cached_property
    def parameters(self) -> Array:
        """Constants of a run; a regulator has no dead band here, in which it would not control at all."""
        drive = self.drive
        if drive.regulator is not None:
            drive = replace(drive, regulator=replace(drive.regulator, dead_band=0.0))
        return parameters_of(drive, self.compiled)

    @cached_property
    def load_force(self) -> float:
        """External force on the load at t = 0 [N]."""
        return float(external_force(self.drive).value(0.0))

    @cached_property
    def names(self) -> list[str]:
        """Names of the states."""
        return self.equations.names

    def places(self, name: str) -> list[int]:
        """Numbers of a state, of both muscles of a pair."""
        return [index for index, full in enumerate(self.names) if full.removesuffix(COUNTER) == name]

    @cached_property
    def middle(self) -> float:
        """Distance of the fittings at stroke 0 [m]."""
        table = dict(zip(self.equations.model.parameters, self.parameters, strict=True))
        return float(table["nominal_length"] - table["precontraction"])

    @cached_property
    def highest_pressure(self) -> float:
        """Highest gauge pressure that can be reached in the muscle [Pa]."""
        regulator = self.drive.regulator
        supply = self.drive.supply_pressure
        return supply if regulator is None else min(regulator.range, supply)

    def inputs(self, command: float, counter: float | None = None) -> Array:
        """Inputs of the equations at a constant command; that of a second muscle mirrors it."""
        values = dict.fromkeys(INPUTS, 0.0)
        values["opening"] = command
        values["counter_opening"] = self.drive.counter(command) if counter is None else counter
        values["external_force"] = self.load_force
        return np.array([values[name] for name in INPUTS])

    def values(self, state: Array, command: float, switches: Array, *, direction: int | None = 0) -> Values:
        """Rates, outputs and derivatives.

        Args:
            state, command: of the point.
            switches: of stops and slack muscles.
            direction: in which the load slides against its dry friction, 1 up or -1 down; 0 without that
                friction; None if it sticks.
        """
        switches = switches.copy()
        switches[self.directions] = {None: (0.0, 0.0), 0: (0.5, 0.5), 1: (1.0, 0.0), -1: (0.0, 1.0)}[
            direction
        ][: len(self.directions)]
        return self.equations.at(
            state=state, parameters=self.parameters, inputs=self.inputs(command), switches=switches
        )

    @cached_property
    def directions(self) -> list[int]:
        """Numbers of the switches *slides up* and *slides down*; none without dry friction."""
        return [index for index, switch in enumerate(self.equations.model.switches) if switch.slides]

    def range_left(self, state: Array, command: float) -> tuple[float, float]:
        """Force [N] on the load that its dry friction still takes, upwards and downwards; 0 without any."""
        if not self.directions:
            return 0.0, 0.0
        guards = self.compiled.guards(np.concatenate([state, self.parameters, self.inputs(command)]))
        lever = self.drive.load.lever_ratio
        up, down = (float(guards[index]) / lever for index in self.directions)
        return (up, down) if up + down > LEAST_GUARD else (0.0, 0.0)

    @property
    def free(self) -> Array:
        """Switches of a load that touches no stop, and of taut muscles."""
        return np.zeros(len(self.equations.model.switches))

    def tensions(self, state: Array) -> list[float]:
        """Tensions at rest of the muscles [N]; below 0 it hangs slack."""
        packed = np.concatenate([state, self.parameters, self.inputs(0.0)])
        guards = self.compiled.guards(packed)
        switches = self.equations.model.switches
        return [
            float(guard)
            for guard, switch in zip(guards, switches, strict=True)
            if switch.name.startswith(SLACK)
        ]

    def rest(self, stroke: float, pressures: tuple[float, float], command: float, direction: int) -> Array:
        """The states at rest: gas at ambient temperature, everything that settles settled.

        Args:
            stroke: of the (first) muscle [m].
            pressures: gauge, of both muscles [Pa]; the second is used of a pair only.
            command: see `inputs`.
            direction: 1 the muscle slides shorter, -1 longer, 0 it rests.
        """
        drive, model = self.drive, self.equations.model
        state = np.array([0.0 if info.initial is None else info.initial for info in model.states])
        state[self.names.index("stroke")] = stroke
        state[self.names.index("speed")] = direction * SLIDING_SPEED
        absolute = [pressure + drive.ambient_pressure for pressure in pressures]
        for name in ("pressure", "tube_pressure", "regulator_pressure"):
            for place, pressure in zip(self.places(name), absolute, strict=False):
                state[place] = pressure
        for place, sense in zip(self.places("length"), (1.0, -1.0), strict=False):
            state[place] = self.middle - sense * stroke
        for place, value in self.reached.items():
            sense = -1.0 if self.names[place].endswith(COUNTER) else 1.0
            state[place] = -sense * direction * value  # the value is that of a long lengthening
        masses = self.places("gas_mass")
        if masses:
            rough = float(braid_volume(braid=drive.muscle.braid, length=drive.muscle.nominal_length))
            specific = [each / (gas.GAS_CONSTANT * drive.temperature) for each in absolute]
            state[masses] = [each * rough for each in specific[: len(masses)]]
            outputs = self.values(state, command, self.free).outputs
            for place, each in zip(masses, specific, strict=False):
                state[place] = each * outputs["volume" + self.names[place].removeprefix("gas_mass")]
        settle(self.compiled, state, self.parameters, self.inputs(command))
        return state

    @cached_property
    def reached(self) -> dict[int, float]:
        """States of friction with memory: number -> value after a long lengthening."""
        values = {
            f"{effect.id}.{variable.name}": variable.sliding
            for effect in self.drive.model.effects
            for variable in effect.states
            if variable.sliding
        }
        return {
            index: values[plain]
            for index, name in enumerate(self.names)
            if (plain := name.removesuffix(COUNTER)) in values
        }

    @cached_property
    def independent(self) -> list[int]:
        """Numbers of the states of a linear model: a taut muscle has the length of its stroke."""
        left_out = {*self.equations.counted, *self.places("length")}
        return [index for index in range(len(self.names)) if index not in left_out]

    @cached_property
    def expansion(self) -> Array:
        """All states from the independent ones, shape (states, independent)."""
        matrix = np.zeros((len(self.names), len(self.independent)))
        for column, row in enumerate(self.independent):
            matrix[row, column] = 1.0
        stroke = self.independent.index(self.names.index("stroke"))
        for place, sense in zip(self.places("length"), (1.0, -1.0), strict=False):
            matrix[place, stroke] = -sense
        return matrix

    @cached_property
    def scales(self) -> Array:
        """Magnitudes of the independent states."""
        return np.array([self.equations.model.states[index].scale for index in self.independent])
