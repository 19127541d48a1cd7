r"""Dead volume: gas in fittings, end caps and ports, :math:`V = V_{muscle} + V_d`."""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def dead_volume(*, volume: Value) -> Value:
    """V_d [m^3]."""
    return volume


_RANGE = Source("fittings and end caps 1-10 cm3, a long port or a sensor line more", "E")
_DEFINITION = Source("definition", "D")

EFFECT = Effect(
    title="Dead volume",
    family="gas",
    type="dynamic",
    cause="Fittings, end caps and ports hold gas that does no work but has to be filled and vented. The "
    "pressure changes more slowly, and the muscle is softer when its valve is closed.",
    equation=r"V = V_{muscle}(L) + V_d",
    parameters=(
        Parameter(
            "volume",
            "V_d",
            "m3",
            default=5.0e-6,
            lower=0.0,
            upper=5.0e-4,
            source=_RANGE,
            description="Gas volume outside the muscle.",
            off=0.0,
        ),
    ),
    slots={"extra_volume": dead_volume},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="pressure rises and falls more slowly in proportion, the same factor on filling and venting",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="conservative",
    ),
    confused_with=(
        Twin(
            "flow_coefficient", "a rigid vessel of known volume in place of the muscle gives the conductance"
        ),
        Twin("tube_resistance", "a second pressure sensor at the valve"),
        Twin("heat_exchange", "close the valve and hold the length: dead volume does not drift"),
    ),
    prior=Prior(0.5, "fittings and valve ports always hold some air"),
    references=(Source("conservation of mass", "D"),),
    examples=(Example("slot:extra_volume", 8e-6, 1e-12, _DEFINITION, {"volume": 8e-6}, {}, {}),),
)
