r"""The levers of a joint differ from the stated ones by a factor, :math:`r' = f_r\,r`.

Where the length of the muscle follows from the angle it changes with them, by virtual work:
:math:`L' = L(0) + f_r\,(L(\varphi) - L(0))`.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def joint_lever(*, factor: Value) -> Value:
    """f_r [-]."""
    return factor


_RANGE = Source("half the thickness of a cable or strap, a pulley measured at its rim: 2-15 %", "E")
_DEFINITION = Source("definition of a scale error", "D")

EFFECT = Effect(
    title="Lever of the joint: scale error",
    family="load",
    type="measurement",
    cause="The muscle pulls at another lever than stated, because its cable runs above the groove of the "
    "pulley or an attachment was measured at the wrong edge. Torques are off by that factor, and the length "
    "of the muscle changes faster or slower with the angle.",
    equation=r"r' = f_r\,r",
    parameters=(
        Parameter(
            "factor",
            "f_r",
            "1",
            default=1.05,
            lower=0.5,
            upper=2.0,
            source=_RANGE,
            description="True over stated lever.",
            off=1.0,
        ),
    ),
    slots={"joint_lever": joint_lever},
    kinds=frozenset({"joint"}),
    signature=Signature(
        text="a constant share of the whole torque, and a stiffness that grows with the square of the factor",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin("effectiveness", "the same muscle on a tensile tester"),
        Twin("force_scale", "dead weights on the joint without a muscle"),
        Twin("angle_offset", "angles on both sides of the zero"),
    ),
    prior=Prior(0.2, "levers are measured with a ruler"),
    references=(_DEFINITION,),
    examples=(Example("slot:joint_lever", 1.08, 1e-12, _DEFINITION, {"factor": 1.08}, {}, {}),),
)
