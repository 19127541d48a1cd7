r"""Low-pass filters of the sensors and their amplifiers, one or two stages per channel.

.. math:: \tau\,\dot y = r - y,\qquad \varsigma\tau\,\dot z = y - z

A stage below 10 microseconds is bypassed. A lag causes loops that look like hysteresis, of the width
:math:`2\tau(1+\varsigma)|\dot F|`; the same lag on all channels causes none.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_SHORTEST = 1e-5  # s


def _read(reading: Value, first: Value, second: Value, time: Value, share: Value) -> Value:
    once = ops.where(ops.greater(time, _SHORTEST), first, reading)
    return ops.where(ops.greater(share * time, _SHORTEST), second, once)


def force_reading(
    *, reading: Value, force_first: Value, force_second: Value, force_time: Value, second_share: Value
) -> Value:
    """The filtered force [N]; the force itself without a lag."""
    return _read(reading, force_first, force_second, force_time, second_share)


def pressure_reading(
    *,
    reading: Value,
    pressure_first: Value,
    pressure_second: Value,
    pressure_time: Value,
    second_share: Value,
) -> Value:
    """The filtered pressure [Pa]; the pressure itself without a lag."""
    return _read(reading, pressure_first, pressure_second, pressure_time, second_share)


def stroke_reading(
    *, reading: Value, stroke_first: Value, stroke_second: Value, stroke_time: Value, second_share: Value
) -> Value:
    """The filtered stroke [m]; the stroke itself without a lag."""
    return _read(reading, stroke_first, stroke_second, stroke_time, second_share)


def _rate(signal: Value, shown: Value, time: Value) -> Value:
    return ops.where(ops.greater(time, _SHORTEST), 1.0, 0.0) * (signal - shown) / ops.maximum(time, _SHORTEST)


def drive_rates(
    *,
    instant_force_reading: Value,
    instant_pressure_reading: Value,
    instant_stroke_reading: Value,
    force_first: Value,
    pressure_first: Value,
    stroke_first: Value,
    force_second: Value,
    pressure_second: Value,
    stroke_second: Value,
    force_time: Value,
    pressure_time: Value,
    stroke_time: Value,
    second_share: Value,
) -> tuple[Value, ...]:
    """dy/dt of force, pressure and stroke, then dz/dt; 0 for a bypassed stage."""
    return (
        _rate(instant_force_reading, force_first, force_time),
        _rate(instant_pressure_reading, pressure_first, pressure_time),
        _rate(instant_stroke_reading, stroke_first, stroke_time),
        _rate(force_first, force_second, second_share * force_time),
        _rate(pressure_first, pressure_second, second_share * pressure_time),
        _rate(stroke_first, stroke_second, second_share * stroke_time),
    )


_RANGE = Source("amplifier filters of 10-1000 Hz", "E")
_ORDER = Source("second-order amplifiers without overshoot: from one stage to two equal ones", "D")
_SHARE = "Time constant of a second stage as a share of the first one's; 0 is one stage only."
_CHANNELS = (("force", "F", "N", 100.0), ("pressure", "P", "Pa", 1e5), ("stroke", "s", "m", 0.1))


def _time(channel: str, symbol: str, default: float) -> Parameter:
    meaning = f"Time constant of the {channel} channel; 5 ms is a filter of 32 Hz."
    return Parameter(
        f"{channel}_time",
        symbol,
        "s",
        default=default,
        lower=0.0,
        upper=1.0,
        source=_RANGE,
        description=meaning,
        off=0.0,
        fitted=default > 0.0,
    )


def _stages(stage: str, letter: str) -> tuple[StateVariable, ...]:
    return tuple(
        StateVariable(f"{name}_{stage}", f"{letter}_{c}", unit, scale, f"{name} after a stage", settled=True)
        for name, c, unit, scale in _CHANNELS
    )


def _rate_example(index: int, rate: float, by_hand: str, **values: float) -> Example:
    at = {f"instant_{name}_reading": 0.0 for name, *_ in _CHANNELS}
    at |= {"instant_force_reading": 200.0, "force_first": 150.0, "force_second": 140.0}
    return Example(f"slot:drive_rates:{index}", rate, 1e-9, Source(by_hand, "D"), values, {}, at)


EFFECT = Effect(
    title="Lag of the sensors",
    family="sensor",
    type="measurement",
    cause="Sensors and amplifiers smooth their signals. A channel that is slower than another one "
    "opens a loop between the two that is not hysteresis of the muscle.",
    equation=r"\tau_c\,\dot y_c = r_c-y_c,\quad \varsigma\tau_c\,\dot z_c = y_c-z_c,\quad c = F, P, s",
    parameters=(
        _time("force", r"\tau_F", 0.005),
        _time("pressure", r"\tau_P", 0.0),
        _time("stroke", r"\tau_s", 0.0),
        Parameter(
            "second_share",
            r"\varsigma",
            "1",
            default=0.0,
            lower=0.0,
            upper=1.0,
            source=_ORDER,
            description=_SHARE,
            fitted=False,
            natural=True,
        ),
    ),
    slots={
        "force_reading": force_reading,
        "pressure_reading": pressure_reading,
        "stroke_reading": stroke_reading,
        "drive_rates": drive_rates,
    },
    states=(*_stages("first", "y"), *_stages("second", "z")),
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
    prior=Prior(0.2, "amplifiers filter, often without saying so"),
    references=(Source("low-pass filters of first and second order", "D"),),
    examples=(
        _rate_example(0, 1e4, "(200 - 150) N / 5 ms", force_time=0.005),
        _rate_example(3, 4e3, "(150 - 140) N / (0.5 * 5 ms)", force_time=0.005, second_share=0.5),
    ),
)
