r"""Low-pass filters of the sensors and their amplifiers, :math:`\tau\,\dot y = r - y` per channel.

A channel with a time constant below 10 microseconds is read directly. A lag makes loops that look like
hysteresis, of the width :math:`2\tau|\dot F|`; the same lag on all channels makes none.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_SHORTEST = 1e-5  # s


def _read(reading: Value, filtered: Value, time: Value) -> Value:
    return ops.where(ops.greater(time, _SHORTEST), filtered, reading)


def force_reading(*, reading: Value, force_filtered: Value, force_time: Value) -> Value:
    """The filtered force [N]; the force itself without a lag."""
    return _read(reading, force_filtered, force_time)


def pressure_reading(*, reading: Value, pressure_filtered: Value, pressure_time: Value) -> Value:
    """The filtered pressure [Pa]; the pressure itself without a lag."""
    return _read(reading, pressure_filtered, pressure_time)


def stroke_reading(*, reading: Value, stroke_filtered: Value, stroke_time: Value) -> Value:
    """The filtered stroke [m]; the stroke itself without a lag."""
    return _read(reading, stroke_filtered, stroke_time)


def drive_rates(
    *,
    instant_force_reading: Value,
    instant_pressure_reading: Value,
    instant_stroke_reading: Value,
    force_filtered: Value,
    pressure_filtered: Value,
    stroke_filtered: Value,
    force_time: Value,
    pressure_time: Value,
    stroke_time: Value,
) -> tuple[Value, ...]:
    """(r - y)/tau of force, pressure and stroke; a channel without a lag stands still."""
    channels = (
        (instant_force_reading, force_filtered, force_time),
        (instant_pressure_reading, pressure_filtered, pressure_time),
        (instant_stroke_reading, stroke_filtered, stroke_time),
    )
    return tuple(
        ops.where(ops.greater(time, _SHORTEST), 1.0, 0.0) * (reading - y) / ops.maximum(time, _SHORTEST)
        for reading, y, time in channels
    )


_RANGE = Source("amplifier filters of 10-1000 Hz", "E")
_BY_HAND = Source("(200 - 150) N / 5 ms", "D")


def _time(channel: str, symbol: str, default: float) -> Parameter:
    return Parameter(
        f"{channel}_time",
        rf"\tau_{symbol}",
        "s",
        default,
        0.0,
        1.0,
        _RANGE,
        f"Time constant of the {channel} channel; 5 ms is a filter of 32 Hz.",
        off=0.0,
        fitted=default > 0.0,
    )


def _filtered(channel: str, symbol: str, unit: str, scale: float) -> StateVariable:
    return StateVariable(
        f"{channel}_filtered", f"y_{symbol}", unit, scale, f"What the {channel} channel shows.", settled=True
    )


EFFECT = Effect(
    title="Lag of the sensors",
    family="sensor",
    type="measurement",
    cause="Sensors and their amplifiers smooth what they show. A channel that is slower than another one "
    "opens a loop between both that is no hysteresis of the muscle.",
    equation=r"\tau_c\,\dot y_c = r_c-y_c,\quad c = F, P, s",
    parameters=(_time("force", "F", 0.005), _time("pressure", "P", 0.0), _time("stroke", "s", 0.0)),
    slots={
        "force_reading": force_reading,
        "pressure_reading": pressure_reading,
        "stroke_reading": stroke_reading,
        "drive_rates": drive_rates,
    },
    states=(
        _filtered("force", "F", "N", 100.0),
        _filtered("pressure", "P", "Pa", 1e5),
        _filtered("stroke", "s", "m", 0.1),
    ),
    kinds=frozenset({"isobaric", "isometric", "isotonic", "transient"}),
    signature=Signature(
        text="a false loop whose width grows with the rate, and rounded steps in one channel",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="reading",
    ),
    confused_with=(
        Twin("viscous_damping", "isometric pressure steps: without motion only the sensor lags"),
        Twin("time_skew", "steps: a skew shifts the edge, a lag rounds it"),
        Twin("coulomb_friction", "very slow loops: the false loop vanishes"),
        Twin("spool_lag", "a second, faster pressure sensor"),
    ),
    references=(Source("first-order low-pass filter", "D"),),
    examples=(
        Example(
            "slot:drive_rates:0",
            1e4,
            1e-9,
            _BY_HAND,
            {"force_time": 0.005},
            {},
            {
                "instant_force_reading": 200.0,
                "force_filtered": 150.0,
                "instant_pressure_reading": 0.0,
                "instant_stroke_reading": 0.0,
            },
        ),
    ),
)
