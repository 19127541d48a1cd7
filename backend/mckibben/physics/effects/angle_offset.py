r"""Zero error of the angle of a joint, :math:`\varphi_{read} = \varphi + o_\varphi`.

Length and lever of every muscle that follow from the angle are those of another angle,
:math:`L(\varphi)`, :math:`r(\varphi)`.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def joint_angle(*, angle: Value, offset: Value) -> Value:
    """True angle: the reading less the offset [rad]."""
    return angle - offset


_RANGE = Source("protractors and index marks of joints are set by eye to 1-5 degrees", "E")
_DEFINITION = Source("definition of a zero error", "D")

EFFECT = Effect(
    title="Angle of the joint: zero error",
    family="load",
    type="measurement",
    cause="The angle is not counted from where the path of the muscle is stated, because the encoder or "
    "protractor was mounted turned. Length and lever of the muscle are then those of another angle.",
    equation=r"\varphi_{read} = \varphi + o_\varphi",
    parameters=(
        Parameter(
            "offset",
            r"o_\varphi",
            "rad",
            default=0.05,
            lower=-0.5,
            upper=0.5,
            source=_RANGE,
            description="Measured minus true angle.",
            off=0.0,
        ),
    ),
    slots={"joint_angle": joint_angle},
    kinds=frozenset({"joint"}),
    signature=Signature(
        text="a shift along the angle: proportional to the pressure, as the stiffness of the muscle times "
        "the square of its lever",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin("length_offset", "two angles at which the lever differs, or the muscle's length by a rule"),
        Twin("lever_scale", "angles on both sides of the zero: a factor of the lever does nothing there"),
    ),
    prior=Prior(0.3, "the zero of an angle is often set by eye"),
    references=(_DEFINITION,),
    examples=(Example("slot:joint_angle", 0.25, 1e-12, _DEFINITION, {"offset": 0.05}, {}, {"angle": 0.3}),),
)
