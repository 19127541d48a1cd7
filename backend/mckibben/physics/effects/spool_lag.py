r"""The spool follows its command as a mass on a spring.

.. math:: \tau^2\,\ddot x + 2\zeta\tau\,\dot x + x = u, \qquad \tau = \frac{1}{2\pi f_n}

A natural frequency of 100 Hz is :math:`\tau = 1.6` ms. A lag below 10 microseconds is ignored.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_SHORTEST = 1e-5  # s


def opening(*, opening: Value, position: Value, time: Value) -> Value:
    """The position of the spool [-]; the command itself without a lag."""
    return ops.where(ops.greater(time, _SHORTEST), position, opening)


def drive_rates(
    *, opening: Value, position: Value, rate: Value, time: Value, damping: Value
) -> tuple[Value, Value]:
    """dx/dt and d2x/dt2 of the spool [1/s, 1/s^2]; at rest where the position is the command."""
    acts = ops.where(ops.greater(time, _SHORTEST), 1.0, 0.0)
    bounded_time = ops.maximum(time, _SHORTEST)
    return acts * rate, acts * ((opening - position) / bounded_time - 2.0 * damping * rate) / bounded_time


_DYNAMICS = Source("65-125 Hz, damping ratio 0.6-1, proportional spool valves", "M")
_BY_HAND = Source("(0.5 - 0.2)/0.002^2 - 2 * 0.8 * 10/0.002", "D")

EFFECT = Effect(
    title="Spool dynamics",
    family="valve",
    type="dynamic",
    cause="The spool has a mass and is moved by a spring and a magnet of limited force. Its opening "
    "lags behind the command, and hardly moves above its natural frequency.",
    equation=r"\tau^2\,\ddot x + 2\zeta\tau\,\dot x + x = u,\quad \tau = \frac{1}{2\pi f_n}",
    parameters=(
        Parameter(
            "time",
            r"\tau",
            "s",
            default=1.6e-3,
            lower=0.0,
            upper=0.05,
            source=_DYNAMICS,
            description="Inverse of the natural angular frequency; 1.6 ms is 100 Hz.",
            off=0.0,
        ),
        Parameter(
            "damping",
            r"\zeta",
            "1",
            default=0.8,
            lower=0.4,
            upper=2.0,
            source=_DYNAMICS,
            description="Damping ratio; below 1 the spool overshoots a step.",
            fitted=False,
        ),
    ),
    slots={"opening": opening, "drive_rates": drive_rates},
    states=(
        StateVariable("position", "x", "1", 1.0, "Opening of the spool.", settled=True),
        StateVariable(
            "rate", r"\dot x", "1/s", 500.0, "Speed of the spool in openings per second.", settled=True
        ),
    ),
    order=-10,  # after the play of the spool (valve_hysteresis, -20), before the overlap (valve_deadband, 0)
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="a rounded start of pressure steps, and a fast loss of amplitude above one frequency",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin(
            "valve_delay", "steps of two sizes: a lag rounds the start of the pressure, a dead time does not"
        ),
        Twin("tube_resistance", "a pressure sensor at the port of the valve"),
        Twin("sensor_lag", "a second, faster pressure sensor"),
    ),
    prior=Prior(0.3, "a proportional spool follows its command with its own dynamics"),
    references=(_DYNAMICS,),
    examples=(
        Example("slot:opening", 0.2, 1e-12, _BY_HAND, {"time": 0.002}, {}, {"opening": 0.5, "position": 0.2}),
        Example(
            "slot:drive_rates:1",
            67000.0,
            1e-9,
            _BY_HAND,
            {"time": 0.002, "damping": 0.8},
            {},
            {"opening": 0.5, "position": 0.2, "rate": 10.0},
        ),
    ),
)
