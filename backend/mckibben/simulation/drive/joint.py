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

from dataclasses import replace

import numpy as np

from mckibben.physics.errors import InputError
from mckibben.simulation.command.joint import LEAST_SLOPE, interpolated
from mckibben.simulation.drive.parts import Drive

_POINTS = 101
_PRESSURES = (1e5, 4e5)  # between which the stiffness of a muscle is a straight line [Pa]
#: Of the supply pressure, left for the difference where valves set the pressures.
ROOM = 0.05


class JointStiffness:
    """The stiffness of a pair's joint from stroke and pressures.

    Attributes:
        radius: of the pulley [m].
        full: highest pressure of the muscles that a command can ask for [Pa].
        low, step: first of the strokes of ``table``, and from each to the next [m].
        table: slopes of both muscles by their pressure [1/m], and stiffness without pressure [N/m]; shape
            (3, strokes).
    """

    def __init__(self, drive: Drive) -> None:
        if drive.pulley_radius is None:
            raise ValueError("only a pair has a joint")
        self.radius = drive.pulley_radius
        self.full = drive.supply_pressure if drive.regulator is None else drive.regulator.range
        self.low, high = drive.stops
        self.step = (high - self.low) / (_POINTS - 1)
        stroke = np.linspace(self.low, high, _POINTS)
        middle = drive.muscle.nominal_length * (1.0 - drive.precontraction)
        slopes, offset = [], np.zeros(_POINTS)
        for sense in (1.0, -1.0):
            length = np.minimum(middle - sense * stroke, drive.model.longest)
            lower, upper = (
                drive.model.outputs(length=length, pressure=pressure, temperature=drive.temperature)[
                    "tension_by_length"
                ]
                for pressure in _PRESSURES
            )
            slopes.append((upper - lower) / (_PRESSURES[1] - _PRESSURES[0]))
            offset += lower - slopes[-1] * _PRESSURES[0]
        self.table = np.array([*slopes, offset])

    def at(self, stroke: float) -> tuple[float, float, float]:
        """Slopes of the first and the second muscle, and offset, at a stroke [m]."""
        a1, a2, b = (float(interpolated(stroke, self.low, self.step, column)) for column in self.table)
        return a1, a2, b

    def value(self, stroke: float, first: float, second: float) -> float:
        """Stiffness of the joint [N m/rad] at a stroke [m] and the gauge pressures of both muscles [Pa]."""
        a1, a2, b = self.at(stroke)
        return self.radius**2 * (a1 * first + a2 * second + b)

    def common_pressure(self, stiffness: float, stroke: float) -> float:
        """Gauge pressure of both muscles [Pa] with this stiffness [N m/rad]."""
        a1, a2, b = self.at(stroke)
        return (stiffness / self.radius**2 - b) / max(a1 + a2, LEAST_SLOPE)


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
