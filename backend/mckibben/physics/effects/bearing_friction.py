r"""Dry friction in the bearing of a joint, :math:`\tau_b = M_b\operatorname{sgn}\dot\varphi`."""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def joint_torque(*, direction: Value, torque: Value) -> Value:
    """Torque against the motion of the joint [N m]; 0 at rest."""
    return torque * direction


_RANGE = Source("sealed ball bearings 0.01-0.1 N m, plain bearings and brake-like hinges up to some N m", "E")
_DEFINITION = Source("definition, by hand", "D")

EFFECT = Effect(
    title="Friction in the bearing of the joint",
    family="friction",
    type="static",
    cause="The bearing of the joint, its seals and the cables over its pulleys rub. While the joint turns "
    "the way the muscle pulls it gives less torque, on the way back it holds more.",
    equation=r"\tau_b = M_b\operatorname{sgn}\dot\varphi",
    parameters=(
        Parameter(
            "torque",
            "M_b",
            "N*m",
            default=0.2,
            lower=0.0,
            upper=50.0,
            source=_RANGE,
            description="Friction torque of the bearing.",
            off=0.0,
            of_joint="friction",
        ),
    ),
    slots={"joint_torque": joint_torque},
    kinds=frozenset({"joint"}),
    signature=Signature(
        text="a loop of one torque at every angle and pressure; over the lever it is a larger force where "
        "the lever is short",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="dissipative",
    ),
    confused_with=(
        Twin("coulomb_friction", "two angles with different levers, or the joint turned without the muscle"),
        Twin("pressure_friction", "several pressures"),
    ),
    prior=Prior(0.25, "every bearing rubs a little"),
    references=(Source("Coulomb friction of a journal", "M"),),
    examples=(
        Example("slot:joint_torque", -0.4, 1e-12, _DEFINITION, {"torque": 0.4}, {}, {"direction": -1.0}),
    ),
)
