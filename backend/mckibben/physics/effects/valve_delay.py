r"""Dead time of the valve: nothing moves until coil, pilot and electronics have acted, u(t - t_d).

Energising and releasing usually take different times. A dead time shifts the motion and changes no rise time.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def command_delay(*, opening_time: Value, closing_time: Value) -> tuple[Value, Value]:
    """Dead times of a growing and of a falling command [s]."""
    return opening_time, closing_time


_PAPER = Source("the source paper: 5 ms in, 7.5 ms out", "S")
_DEFINITION = Source("definition", "D")

EFFECT = Effect(
    title="Dead time of the valve",
    family="valve",
    type="dynamic",
    cause="Current has to build up in the coil and a pilot has to fill before the spool moves. The pressure "
    "starts to change later than commanded, by a time that differs between on and off.",
    equation=r"u_v(t) = u(t-t_{on})\ \text{or}\ u(t-t_{off})",
    parameters=(
        Parameter(
            "opening_time",
            "t_{on}",
            "s",
            default=0.005,
            lower=0.0,
            upper=0.1,
            source=_PAPER,
            description="Dead time of switching on.",
            off=0.0,
        ),
        Parameter(
            "closing_time",
            "t_{off}",
            "s",
            default=0.0075,
            lower=0.0,
            upper=0.1,
            source=_PAPER,
            description="Dead time of switching off.",
            off=0.0,
        ),
    ),
    slots={"command_delay": command_delay},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="a pure shift in time of pressure, force and stroke; rise times are unchanged",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin("tube_delay", "a pressure sensor at the port of the valve"),
        Twin("spool_lag", "steps of two sizes: a lag rounds the start of the pressure, a dead time does not"),
        Twin("time_skew", "compare with a second channel of the same recorder"),
    ),
    prior=Prior(0.4, "every solenoid needs some milliseconds"),
    references=(_PAPER,),
    examples=(
        Example(
            "slot:command_delay:0",
            0.005,
            1e-12,
            _DEFINITION,
            {"opening_time": 0.005, "closing_time": 0.0075},
            {},
            {},
        ),
        Example(
            "slot:command_delay:1",
            0.0075,
            1e-12,
            _DEFINITION,
            {"opening_time": 0.005, "closing_time": 0.0075},
            {},
            {},
        ),
    ),
)
