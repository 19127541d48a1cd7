r"""Pressure travels along the tube with the speed of sound, :math:`t_t = f\,l/c_s`; 2.9 ms per metre."""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_SPEED_OF_SOUND = 343.2  # m/s, air at 20 degC


def command_delay(*, tube_length: Value, factor: Value) -> tuple[Value, Value]:
    """Travelling time [s] of opening and of closing; 0 without a tube."""
    time = factor * tube_length / _SPEED_OF_SOUND
    return time, time


_RANGE = Source("1 for sound; slower in narrow tubes, because of wall friction and heat transfer", "E")
_BY_HAND = Source("3 m / 343.2 m/s", "D")

EFFECT = Effect(
    title="Delay of the tube",
    family="tube",
    type="dynamic",
    cause="A change at the valve reaches the muscle as a sound wave in the tube. Pressure and motion start "
    "later, in proportion to the length of the tube.",
    equation=r"t_t = f\,\frac{l}{c_s}",
    parameters=(
        Parameter(
            "factor",
            "f",
            "1",
            default=1.0,
            lower=0.0,
            upper=3.0,
            source=_RANGE,
            description="Travelling time over that of sound.",
            off=0.0,
        ),
    ),
    slots={"command_delay": command_delay},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="a pure shift in time in proportion to the length of the tube; rise times are unchanged",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin("valve_delay", "a pressure sensor at the port of the valve, or two lengths of the tube"),
        Twin("tube_resistance", "a small step: the delay remains, the pressure difference vanishes"),
    ),
    prior=Prior(0.15, "a wave takes 3 ms per metre of tube"),
    references=(Source("Richer & Hurmuzlu, J. Dyn. Syst. Meas. Control 122 (2000) 416", "M"),),
    examples=(
        Example(
            "slot:command_delay:0",
            8.741258741258742e-3,
            1e-12,
            _BY_HAND,
            {"factor": 1.0},
            {},
            {"tube_length": 3.0},
        ),
    ),
)
