"""Contacts of threads that rub: how pressure and length scale their friction, for all laws with memory."""

from __future__ import annotations

from mckibben.physics import ops
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.presliding import pressed

_LEAST_STRETCH = 0.05  # share of the nominal length, far below any; the power has a pole at 0


def grip(
    *, pressure: Value, length: Value, nominal_length: Value, pressure_power: Value, length_power: Value
) -> Value:
    r"""Friction over that at 3 bar and the nominal length, :math:`(P_+/P_r)^q (L/L_0)^m` [-].

    Threads that lie on each other over the width w and the length of a turn touch on an area in proportion to
    :math:`L\,r\cos\theta/\sin\theta`, which goes with :math:`L^2` (m = 2); the area of Tondu and Lopez,
    :math:`\sin 2\theta_0/\sin 2\theta`, falls about as fast as L from braid angles of 20 to 25 degrees
    (m = 1).

    Args:
        pressure: gauge [Pa]; below the atmosphere as vented, rounded below 10 mbar.
        length, nominal_length: of the muscle [m].
        pressure_power, length_power: q and m.

    Returns:
        1 for q = m = 0.

    Source: Tondu & Lopez, IEEE Control Systems 20(2) (2000) 15, for the area.
    """
    stretch = ops.maximum(length / nominal_length, _LEAST_STRETCH)
    return pressed(pressure=pressure, power=pressure_power) * ops.exp(length_power * ops.log(stretch))


PRESSURE_POWER = Parameter(
    *("pressure_power", "q", "1", 0.0, 0.0, 1.0),
    Source("0 friction without pressure, 2/3 Hertzian contacts, 1 rough surfaces under the gas", "M"),
    description="Power of the pressure with which the friction grows.",
    fitted=False,
    natural=True,
    usual=1.0,
)
LENGTH_POWER = Parameter(
    *("length_power", "m", "1", 0.0, -2.0, 3.0),
    Source("0 the same at every length, 1 area of Tondu and Lopez, 2 threads along each other", "D"),
    description="Power of the length with which the friction grows: a shorter muscle has less contact area.",
    fitted=False,
    natural=True,
)
