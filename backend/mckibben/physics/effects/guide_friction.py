r"""Friction of the load's guide: a constant force against the motion and a part in proportion to speed.

.. math:: F_g = F_{cg}\operatorname{sgn}\dot s + c_g\,\dot s

It acts on the load, so it is missing from a force that is measured at the muscle.
"""

from mckibben.physics.effect import Effect, Example, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def guide(*, direction: Value, speed: Value, force: Value, coefficient: Value) -> Value:
    """F_cg sgn(ds/dt) + c_g ds/dt [N], positive against a stroke that grows; 0 at rest."""
    return force * direction + coefficient * speed


_RANGE = Source("recirculating guides 1-10 N with seals, plain guides 5-20 % of the load", "E")
_DEFINITION = Source("definition, by hand", "D")

EFFECT = Effect(
    title="Friction of the guide",
    family="friction",
    type="rate",
    cause="The carriage, its seals and the pulleys rub while the load moves. The load feels less than the "
    "muscle gives on the way up, and the muscle has to hold less on the way down.",
    equation=r"F_g = F_{cg}\operatorname{sgn}\dot s + c_g\,\dot s",
    parameters=(
        Parameter("force", "F_{cg}", "N", 5.0, 0.0, 200.0, _RANGE, "Friction at any speed.", off=0.0),
        Parameter(
            "coefficient",
            "c_g",
            "N*s/m",
            0.0,
            0.0,
            500.0,
            Source("grease and seals of linear guides", "E"),
            "Friction in proportion to the speed of the load.",
            off=0.0,
            fitted=False,
        ),
    ),
    slots={"guide": guide},
    kinds=frozenset({"isotonic", "transient"}),
    signature=Signature(
        text="a dead width of the load, the same at every pressure, not seen by a force sensor at the muscle",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="dissipative",
    ),
    confused_with=(
        Twin(
            "coulomb_friction", "a dummy spring for the muscle, or force sensors on both sides of the guide"
        ),
        Twin("viscous_damping", "force sensors on both sides of the guide"),
    ),
    references=(Source("Coulomb and viscous friction of a linear guide", "M"),),
    examples=(
        Example(
            "slot:guide",
            -7.0,
            1e-12,
            _DEFINITION,
            {"force": 5.0, "coefficient": 20.0},
            {},
            {"direction": -1.0, "speed": -0.1},
        ),
    ),
)
