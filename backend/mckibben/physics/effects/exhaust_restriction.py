r"""Exhaust restricted by a silencer, throttle or smaller port, :math:`C_{ex}' = f_{ex}\,C_{ex}`.

A silencer of conductance C_s in series is about :math:`f_{ex} = 1/\sqrt{1 + (C_{ex}/C_s)^2}`.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def exhaust_conductance(*, conductance: Value, factor: Value) -> Value:
    """f_ex C_ex [m^3/(s Pa)]."""
    return factor * conductance


_RANGE = Source("silencers and exhaust throttles 0.3-1; quick exhausts up to 2.4", "E")
_DEFINITION = Source("definition", "D")

EFFECT = Effect(
    title="Restriction of the exhaust",
    family="valve",
    type="static",
    cause="A silencer, a throttle or a smaller port restricts the exhaust. Venting takes longer than "
    "filling, with a long tail of low pressure.",
    equation=r"C_{ex}' = f_{ex}\,C_{ex}",
    parameters=(
        Parameter(
            "factor",
            "f_{ex}",
            "1",
            default=0.7,
            lower=0.05,
            upper=3.0,
            source=_RANGE,
            description="Conductance over that without a silencer.",
            off=1.0,
        ),
    ),
    slots={"exhaust_conductance": exhaust_conductance},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="venting takes longer by one factor, filling is unchanged",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="dissipative",
    ),
    confused_with=(
        Twin("silencer", "short and long ventings: air in the silencer lets the short ones begin faster"),
        Twin("flow_coefficient", "filling and venting: a restricted exhaust slows venting alone"),
        Twin("tube_resistance", "filling and venting: a tube slows both"),
        Twin("viscous_damping", "vent a rigid vessel instead of the muscle"),
    ),
    prior=Prior(0.25, "silencers restrict the exhaust"),
    references=(Source("restrictions in series, ISO 6358-3", "M"),),
    examples=(
        Example(
            "slot:exhaust_conductance", 7e-9, 1e-12, _DEFINITION, {"factor": 0.7}, {}, {"conductance": 1e-8}
        ),
    ),
)
