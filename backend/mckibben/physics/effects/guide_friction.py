r"""Friction of the load's guide: a force against the motion, higher at low speed, and a part with the speed.

.. math:: F_g = F_{cg}\,\bigl[1 + s\,e^{-|\dot s|/v_s}\bigr]\operatorname{sgn}\dot s + c_g\,\dot s,
   \quad s = F_{sg}/F_{cg} - 1

Without a static share s the first part is constant; with one it falls with the speed (Stribeck). It acts on
the load, so it is missing from a force that is measured at the muscle.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def guide(
    *,
    direction: Value,
    speed: Value,
    force: Value,
    coefficient: Value,
    static_share: Value,
    stribeck_speed: Value,
) -> Value:
    """F_cg (1 + s exp(-|v|/v_s)) sgn v + c_g v [N], positive against a stroke that grows; 0 at rest."""
    fading = ops.exp(-ops.absolute(speed) / stribeck_speed)
    return force * direction * (1.0 + static_share * fading) + coefficient * speed


_RANGE = Source("recirculating guides 1-10 N with seals, plain guides 5-20 % of the load", "E")
_STRIBECK = Source("Armstrong-Helouvry, Dupont & Canudas de Wit, Automatica 30 (1994) 1083: some mm/s", "M")
_DEFINITION = Source("definition, by hand", "D")
_BY_HAND = Source("5 (1 + 0.4/e) at the Stribeck speed", "D")

EFFECT = Effect(
    title="Friction of the guide",
    family="friction",
    type="rate",
    cause="The carriage, its seals and the pulleys rub while the load moves. The load feels less than the "
    "muscle gives on the way up, and the muscle has to hold less on the way down.",
    equation=r"F_g = F_{cg}\left[1+s\,e^{-|\dot s|/v_s}\right]\operatorname{sgn}\dot s + c_g\,\dot s",
    parameters=(
        Parameter("force", "F_{cg}", "N", 5.0, 0.0, 200.0, _RANGE, "Friction at high speed.", off=0.0),
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
        Parameter(
            "static_share",
            "s",
            "1",
            0.0,
            0.0,
            1.0,
            Source("static over kinetic friction 1.0-1.5 of guides with seals, up to 2 dry", "E"),
            "Excess of the static over the kinetic friction, F_sg/F_cg - 1; 0 is the same at every speed.",
            fitted=False,
        ),
        Parameter(
            "stribeck_speed",
            "v_s",
            "m/s",
            0.005,
            0.001,
            0.1,
            _STRIBECK,
            "Speed at which 1/e of the static share is left.",
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
        Example(
            "slot:guide",
            5.7357589,
            1e-7,
            _BY_HAND,
            {"force": 5.0, "static_share": 0.4, "stribeck_speed": 0.005},
            {},
            {"direction": 1.0, "speed": 0.005},
        ),
    ),
)
