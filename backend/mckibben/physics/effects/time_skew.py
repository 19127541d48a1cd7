r"""The force channel is recorded later than the others, :math:`y_F(t) = F(t-\delta)`.

Sequential sampling, separate recorders or digital filters shift a channel in time without changing its form.
The loop area between force and length changes sign with :math:`\delta`, which no friction does.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def skew(*, delay: Value) -> Value:
    """Delay of the force channel [s]; negative when the other channels are late."""
    return delay


_RANGE = Source("one sample at 100-1000 Hz, to two frames of separate recorders", "E")
_DEFINITION = Source("definition", "D")

EFFECT = Effect(
    title="Time skew between channels",
    family="sensor",
    type="measurement",
    cause="Channels that are sampled one after the other, or by two recorders, belong to different instants. "
    "Force and length then open a loop, clockwise or counter-clockwise.",
    equation=r"y_F(t) = F(t-\delta)",
    parameters=(
        Parameter(
            "delay",
            r"\delta",
            "s",
            default=0.002,
            lower=-0.1,
            upper=0.1,
            source=_RANGE,
            description="Delay of the force channel.",
            off=0.0,
        ),
    ),
    slots={"skew": skew},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "transient"}),
    signature=Signature(
        text="a false loop whose width grows with the rate and may turn the wrong way round",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="reading",
    ),
    confused_with=(
        Twin("sensor_lag", "steps: a skew shifts the edge, a lag rounds it"),
        Twin("viscous_damping", "a tap on the rig that every channel records"),
        Twin("valve_delay", "a tap on the rig that every channel records"),
    ),
    prior=Prior(0.1, "channels of one logger are sampled together"),
    references=(Source("definition of a skew", "D"),),
    examples=(Example("slot:skew", -0.01, 1e-12, _DEFINITION, {"delay": -0.01}, {}, {}),),
)
