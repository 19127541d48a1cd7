r"""Weight of the link that a joint turns.

:math:`\tau_w = M_w\cos(\varphi - \varphi_h)` with :math:`M_w = m g c`.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def joint_torque(*, angle: Value, moment: Value, level_at: Value) -> Value:
    """Torque to smaller angles [N m]."""
    return moment * ops.cos(angle - level_at)


_RANGE = Source("0.5-5 kg at 0.05-0.4 m from the axis", "E")
_DEFINITION = Source("2 N m cos 60 degrees", "D")

EFFECT = Effect(
    title="Weight of the link",
    family="load",
    type="static",
    cause="The link that turns, its sensor and its fittings have a weight with a lever of its own about the "
    "axis. Its torque changes with the angle alone and is part of what a torque sensor reads.",
    equation=r"\tau_w = M_w\cos(\varphi - \varphi_h)",
    parameters=(
        Parameter(
            "moment",
            "M_w",
            "N*m",
            default=1.0,
            lower=-100.0,
            upper=100.0,
            source=_RANGE,
            description="Mass times gravity times distance of its centre from the axis.",
            off=0.0,
            of_joint="link.moment",
        ),
        Parameter(
            "level_at",
            r"\varphi_h",
            "rad",
            default=0.0,
            lower=-3.2,
            upper=3.2,
            source=Source("the link hangs, stands or lies at the angle 0", "E"),
            description="Angle at which the link is level.",
            of_joint="link.level_at",
        ),
    ),
    slots={"joint_torque": joint_torque},
    kinds=frozenset({"joint"}),
    signature=Signature(
        text="a torque of the angle alone, the same at every pressure and both ways",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="conservative",
    ),
    confused_with=(
        Twin("prestress", "read the torque with the muscle removed"),
        Twin("force_offset", "read the torque with the muscle removed, at several angles"),
    ),
    prior=Prior(0.25, "the weight of the link is often forgotten"),
    references=(Source("weight on a lever", "M"),),
    examples=(
        Example(
            "slot:joint_torque", 1.0, 1e-12, _DEFINITION, {"moment": 2.0, "level_at": 0.0}, {},
            {"angle": 1.0471975511965976},
        ),
    ),
)  # fmt: skip
