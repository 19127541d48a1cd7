r"""Control of the stiffness of an antagonist joint: plain numbers, so that it runs in Python and compiled.

.. math:: K = r^2\,\bigl(a_1 p_1 + a_2 p_2 + b\bigr)

with the slopes :math:`a_1, a_2` of both muscles' stiffness by their gauge pressures and its part b without
pressure, all at the present stroke. See `mckibben.simulation.drive.joint` for the control.
"""

from __future__ import annotations

import numpy as np

#: Of the stiffness over r^2 by the mean pressure [1/m]; it is divided by.
LEAST_SLOPE = 1e-12


def interpolated(stroke: float, low: float, step: float, column: np.ndarray) -> float:
    """A column of values at evenly spaced strokes from ``low`` on, at a stroke; beyond them the nearest."""
    place = min(max((stroke - low) / step, 0.0), len(column) - 1.0)
    piece = min(int(place), len(column) - 2)
    return column[piece] + (place - piece) * (column[piece + 1] - column[piece])


def common_command(
    difference: float, wanted: float, p1: float, p2: float, a1: float, a2: float, b: float,
    integral: float, radius: float, full: float, room: float, kp: float, step: float, regulated: float,
) -> tuple[float, float]:  # fmt: skip
    """One sample of the stiffness controller: (common command, its integral) beside a difference.

    Args:
        difference: half the difference of the commands, which has priority.
        wanted: stiffness [N m/rad].
        p1, p2: gauge pressures [Pa].
        a1, a2, b: slopes [1/m] and offset [N/m] of the stiffness at the present stroke.
        integral: before this sample.
        radius: of the pulley [m].
        full: highest pressure of the muscles that a command can ask for [Pa].
        room: of valves, share of it that stays free for the difference.
        kp: proportional gain [-].
        step: integral gain times the sample time [-].
        regulated: 1 if the commands are pressures of regulators, 0 if they are openings of valves.
    """
    slope = max(a1 + a2, LEAST_SLOPE)
    stiffness = radius**2 * (a1 * p1 + a2 * p2 + b)
    missing = (wanted - stiffness) / (slope * radius**2)
    size = abs(difference)
    lowest, highest, wished = size - 1.0, 1.0 - size, 0.0
    if regulated > 0.0:
        lowest = size
        # Pressures that the model wants with the first muscle so far above the second.
        wished = (wanted / radius**2 - b - (a1 - a2) * difference * full) / slope / full
    else:  # valves at the pressure of the supply could not turn the joint any more
        missing = min(missing, (1.0 - room) * full - 0.5 * abs(p1 - p2) - 0.5 * (p1 + p2))
    grown = step * missing / full
    common = kp * missing / full + integral + grown + wished
    if lowest <= common <= highest:
        integral += grown
    return min(max(common, lowest), highest), integral
