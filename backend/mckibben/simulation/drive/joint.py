r"""Control of an antagonist joint: its angle and its stiffness as two set points.

Both muscles are given a common command c and the difference u, the first c + u and the second c - u. A PID
controller of the position sets u. The stiffness of the joint at constant pressures is affine in both of them,

.. math:: K = r^2\,\bigl(a_1(s)\,p_1 + a_2(s)\,p_2 + b_1(s) + b_2(s)\bigr),

with the stiffness of a muscle :math:`a\,p + b` at its length, from its static model. The share e of the full
pressure that is missing on average sets c: a regulator is commanded the pressures that the model wants, plus
k_p e and an integral k_i of e; a valve opens by k_p e and the integral.

The difference has priority: c is limited to what it leaves.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mckibben.physics.drive_terms import COUNTER
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.control_loop import ControlLoop, measured_position
from mckibben.simulation.drive.parts import Drive

_POINTS = 101
_PRESSURES = (1e5, 4e5)  # between which the stiffness of a muscle is a straight line [Pa]
_LEAST_SLOPE = 1e-12
_ROOM = 0.05  # of the supply pressure, left for the difference


class MuscleStiffness(NamedTuple):
    """Stiffness of both muscles at a stroke: slopes by the pressure [1/m] and values without it [N/m]."""

    first_slope: float
    second_slope: float
    offset: float


class JointStiffness:
    """The stiffness of a pair's joint from stroke and pressures.

    Attributes:
        radius: of the pulley [m].
        full: highest pressure of the muscles that a command can ask for [Pa].
    """

    def __init__(self, drive: Drive) -> None:
        if drive.pulley_radius is None:
            raise ValueError("only a pair has a joint")
        self.radius = drive.pulley_radius
        self.full = drive.supply_pressure if drive.regulator is None else drive.regulator.range
        low, high = drive.stops
        self._stroke = np.linspace(low, high, _POINTS)
        middle = drive.muscle.nominal_length * (1.0 - drive.precontraction)
        tables = []
        for sense in (1.0, -1.0):
            length = np.minimum(middle - sense * self._stroke, drive.model.longest)
            at = [
                drive.model.outputs(length=length, pressure=pressure, temperature=drive.temperature)
                for pressure in _PRESSURES
            ]
            lower, upper = (found["tension_by_length"] for found in at)
            slope = (upper - lower) / (_PRESSURES[1] - _PRESSURES[0])
            tables += [slope, lower - slope * _PRESSURES[0]]
        self._first, first_offset, self._second, second_offset = tables
        self._offset = first_offset + second_offset

    def at(self, stroke: float) -> MuscleStiffness:
        """Slopes and offset at a stroke [m]."""
        columns = (self._first, self._second, self._offset)
        return MuscleStiffness(*(float(np.interp(stroke, self._stroke, column)) for column in columns))

    def value(self, stroke: float, first: float, second: float) -> float:
        """Stiffness of the joint [N m/rad] at a stroke [m] and the gauge pressures of both muscles [Pa]."""
        here = self.at(stroke)
        return self.radius**2 * (here.first_slope * first + here.second_slope * second + here.offset)

    def common_pressure(self, stiffness: float, stroke: float, difference: float = 0.0) -> float:
        """Mean gauge pressure [Pa] with this stiffness [N m/rad], where the first has ``difference`` more."""
        here = self.at(stroke)
        slope = max(here.first_slope + here.second_slope, _LEAST_SLOPE)
        needed = stiffness / self.radius**2 - here.offset
        return (needed - (here.first_slope - here.second_slope) * difference) / slope

    def missing_pressure(self, stiffness: float, stroke: float, first: float, second: float) -> float:
        """Mean pressure [Pa] that is missing for a stiffness [N m/rad]."""
        here = self.at(stroke)
        slope = max(here.first_slope + here.second_slope, _LEAST_SLOPE) * self.radius**2
        return (stiffness - self.value(stroke, first, second)) / slope


class JointSteps:
    """The commands of both muscles, sample by sample."""

    def __init__(self, loop: ControlLoop) -> None:
        drive, control = loop.drive, loop.drive.stiffness
        if control is None:
            raise ValueError("the drive has no set point of the stiffness")
        self._loop, self._control, self._measured = loop, control, measured_position
        self.joint = JointStiffness(drive)
        period = loop.controller.sample_time
        self._wanted = np.asarray(control.reference.value(np.arange(len(loop.set_points)) * period), float)
        names = [state.name for state in loop.compiled.model.states]
        self._pressures = [names.index(name) for name in ("pressure", f"pressure{COUNTER}")]
        self._memory = loop.controller.start(measurement=measured_position(loop, loop.start.state))
        self._integral = 0.0

    def __call__(self, sample: int, state: np.ndarray) -> tuple[float, float]:
        """Commands of the first and the second muscle."""
        loop, control, joint = self._loop, self._control, self.joint
        drive, wanted = loop.drive, float(self._wanted[sample])
        position = self._measured(loop, state)
        difference, self._memory = loop.controller.step(
            float(loop.set_points[sample]), position, self._memory
        )
        stroke = position * drive.load.lever_ratio
        first, second = (float(state[place]) - drive.ambient_pressure for place in self._pressures)
        missing = joint.missing_pressure(wanted, stroke, first, second)
        if drive.regulator is None:  # valves at the pressure of the supply could not turn the joint any more
            most = (1.0 - _ROOM) * joint.full - 0.5 * abs(first - second)
            missing = min(missing, most - 0.5 * (first + second))
        missing /= joint.full
        step = control.ki * loop.controller.sample_time * missing
        common = control.kp * missing + self._integral + step
        if drive.regulator is not None:
            common += joint.common_pressure(wanted, stroke, difference * joint.full) / joint.full
        lowest, highest = common_limits(drive, difference)
        if lowest <= common <= highest:
            self._integral += step
        common = min(max(common, lowest), highest)
        return common + difference, common - difference


def common_limits(drive: Drive, difference: float) -> tuple[float, float]:
    """Limits of the common command beside a difference: neither muscle is commanded more than there is."""
    size = abs(difference)
    return (size, 1.0 - size) if drive.regulator is not None else (size - 1.0, 1.0 - size)


def largest_difference(drive_is_regulated: bool) -> float:
    """The largest difference that leaves both muscles a command."""
    return 0.5 if drive_is_regulated else 1.0


def at_stiffness(drive: Drive, stroke: float) -> Drive:
    """The pair with the common command, of valves the common pressure, that its stiffness needs at a stroke.

    Raises:
        InputError: no pressure gives this stiffness. Field "controller.stiffness.reference".
    """
    control = drive.stiffness
    if control is None:
        raise ValueError("the drive has no set point of the stiffness")
    from dataclasses import replace

    joint = JointStiffness(drive)
    wanted = float(control.reference.value(0.0))
    mean = joint.common_pressure(wanted, stroke)
    if not 0.0 < mean < min(joint.full, drive.supply_pressure):
        ends = [joint.value(stroke, each, each) for each in (0.0, min(joint.full, drive.supply_pressure))]
        raise InputError(
            f"a stiffness of {wanted:.4g} N m/rad is out of reach: {max(ends[0], 0.0):.4g} to {ends[1]:.4g} "
            "N m/rad with equal pressures at this angle",
            field="controller.stiffness.reference",
        )
    if drive.regulator is None:
        return replace(drive, start_pressure=mean)
    return replace(drive, common=mean / joint.full)
