r"""Where a drive would rest at given pressures: the balance of muscles, weight, external force and spring.

At every row it is solved for the stroke :math:`s`,

.. math:: F(L_m - s, p) - F_2(L_m + s, p_2) = (W + F_e)/i + k s/i^2,

with the muscle's length :math:`L_m` at stroke 0, the lever ratio :math:`i`, and :math:`F_2` of a pair only.
"""

from __future__ import annotations

from math import sin

import numpy as np

from mckibben.physics.units import GRAVITY
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.statics.model import clip_slack

Array = np.ndarray

_STEPS = 60
_SAME_PLACE = 1e-10  # share of the rest length
_LOOSE = 0.5  # N; a pair whose muscles pull less than this together is slack


def static_contraction(
    drive: Drive, *, pressure: Array, counter_pressure: Array | None, load_force: Array, direction: float
) -> Array:
    """Contraction ratio of the (first) muscle at rest at each row, between the end stops.

    NaN where a row has no single place: nothing pulls in either direction, or both muscles of a pair are
    slack.

    Args:
        drive: muscle, load and stops.
        pressure: gauge [Pa], shape (rows,).
        counter_pressure: of the second muscle of a pair [Pa]; None of a single muscle.
        load_force: external force on the load [N].
        direction: sign of dL/dt of the (first) muscle, for friction: -1 shortening, 1 lengthening.
    """
    model, load, lever = drive.model, drive.load, drive.load.lever_ratio
    rest = drive.muscle.nominal_length
    middle = rest * (1.0 - drive.precontraction)
    outer = (load.mass * GRAVITY * sin(load.inclination) + load_force) / lever
    spring = load.spring / lever**2

    def pull(length: Array, pressure: Array, direction: float) -> tuple[Array, Array]:
        out = model.outputs(
            length=np.minimum(length, model.longest),
            pressure=pressure,
            direction=direction,
            temperature=drive.temperature,
        )
        return clip_slack(out), np.where(out["tension"] > 0.0, out["force_by_length"], 0.0)

    def balance(stroke: Array) -> tuple[Array, Array, Array]:
        """Force towards shorter, its slope, and what the muscles pull together."""
        force, slope = pull(middle - stroke, pressure, direction)
        spare, by_stroke, together = force - outer - spring * stroke, -slope - spring, force
        if counter_pressure is not None:
            second, second_slope = pull(middle + stroke, counter_pressure, -direction)
            spare, by_stroke, together = spare - second, by_stroke - second_slope, together + second
        return spare, by_stroke, together

    low, high = (np.full(len(pressure), stop) for stop in drive.stops)
    if not len(pressure):
        return low
    least, most = balance(low)[0], balance(high)[0]
    at_low, at_high = least < 0.0, most > 0.0
    stroke, together = 0.5 * (low + high), np.zeros(len(pressure))
    below, above = low.copy(), high.copy()
    with np.errstate(divide="ignore", invalid="ignore"):
        for _ in range(_STEPS):  # Newton's method in a shrinking bracket
            spare, slope, together = balance(stroke)
            below, above = np.where(spare > 0.0, stroke, below), np.where(spare > 0.0, above, stroke)
            newton = stroke - spare / slope
            inside = (newton >= below) & (newton <= above)
            following = np.where(inside, newton, 0.5 * (below + above))
            done = at_low | at_high | (np.abs(following - stroke) < _SAME_PLACE * rest)
            stroke = following
            if done.all():
                break
    stroke = np.where(at_high, high, np.where(at_low, low, stroke))
    loose = (counter_pressure is not None) & ~at_low & ~at_high & (together < _LOOSE)
    anywhere = ((least == 0.0) & (most == 0.0)) | loose | ~np.isfinite(least)
    return np.where(anywhere, np.nan, drive.precontraction + stroke / rest)
