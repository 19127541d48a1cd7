r"""Friction of the load's guide: presliding and sliding friction, and a viscous part.

With the share z of the friction at high speed

.. math:: F_g = (F_{cg} + \mu_g |W|)\,z + c_g\,\dot s, \qquad x_g\,\dot z = \dot s - \frac{|\dot s|\,z}{g},
   \quad g = 1 + \varsigma\,e^{-|\dot s|/v_s}, \quad \varsigma = F_{sg}/F_{cg} - 1

After a travel of a few x_g it reaches :math:`F_{cg}\,g\operatorname{sgn}\dot s`, which falls with the speed
if there is a static excess (Stribeck). Over a shorter travel the guide acts like a spring. A load beside
the axis of the guide presses its contacts together with a share of its force W, which adds
:math:`\mu_g |W|`. The friction acts on the load, so a force sensor at the muscle does not see it.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def guide(
    *, presliding: Value, speed: Value, load: Value, force: Value, coefficient: Value, load_share: Value
) -> Value:
    """(F_cg + mu_g |W|) z + c_g v [N], positive against a growing stroke."""
    return (force + load_share * load) * presliding + coefficient * speed


def drive_rates(
    *, presliding: Value, speed: Value, break_way: Value, static_share: Value, stribeck_speed: Value
) -> tuple[Value]:
    """dz/dt [1/s]: (v - |v| z/g)/x_g; exactly 0 at rest."""
    sliding = 1.0 + static_share * ops.exp(-ops.absolute(speed) / stribeck_speed)
    return ((speed - ops.absolute(speed) * presliding / sliding) / break_way,)


_RANGE = Source("recirculating guides 1-10 N with seals, plain guides 5-20 % of the load", "E")
_STRIBECK = Source("Armstrong-Helouvry, Dupont & Canudas de Wit, Automatica 30 (1994) 1083: some mm/s", "M")
_DEFINITION = Source("definition, by hand", "D")
_BY_HAND = Source("-(5 + 2.5/(1 + 0.4/e)) mm/s / 0.05 mm at the Stribeck speed", "D")

EFFECT = Effect(
    title="Friction of the guide",
    family="friction",
    type="rate",
    cause="The carriage, its seals and the pulleys rub while the load moves. On the way up the load "
    "receives less force than the muscle exerts; on the way down the muscle has to hold less.",
    equation=r"F_g = (F_{cg} + \mu_g |W|)\,z + c_g\,\dot s,\quad x_g\,\dot z = \dot s - "
    r"\frac{|\dot s|\,z}{1+\varsigma\,e^{-|\dot s|/v_s}}",
    parameters=(
        Parameter(
            "force",
            "F_{cg}",
            "N",
            default=5.0,
            lower=0.0,
            upper=200.0,
            source=_RANGE,
            description="Friction at high speed.",
            off=0.0,
        ),
        Parameter(
            "coefficient",
            "c_g",
            "N*s/m",
            default=0.0,
            lower=0.0,
            upper=500.0,
            source=Source("grease and seals of linear guides", "E"),
            description="Friction in proportion to the speed of the load.",
            off=0.0,
            fitted=False,
        ),
        Parameter(
            "load_share",
            r"\mu_g",
            "1",
            default=0.0,
            lower=0.0,
            upper=0.3,
            source=_RANGE,
            description="Share of the load's force by which the friction grows.",
            off=0.0,
            fitted=False,
        ),
        Parameter(
            "static_share",
            r"\varsigma",
            "1",
            default=0.0,
            lower=0.0,
            upper=1.0,
            source=Source("static over kinetic friction 1.0-1.5 of guides with seals, up to 2 dry", "E"),
            description="Excess of the static over the kinetic friction, F_sg/F_cg - 1; 0 is the same "
            "at every speed.",
            fitted=False,
        ),
        Parameter(
            "stribeck_speed",
            "v_s",
            "m/s",
            default=0.005,
            lower=0.001,
            upper=0.1,
            source=_STRIBECK,
            description="Speed at which the static excess has fallen to 1/e.",
            fitted=False,
        ),
        Parameter(
            "break_way",
            "x_g",
            "m",
            default=5e-5,
            lower=2e-6,
            upper=2e-3,
            source=Source("presliding of rolling and plain guides, 1 to several 100 micrometres", "E"),
            description="Travel over which the friction builds up after a reversal; over a shorter travel "
            "the guide acts like a spring.",
            fitted=False,
        ),
    ),
    slots={"guide": guide, "drive_rates": drive_rates},
    states=(
        StateVariable(
            "presliding", "z", "1", 1.0, "Present friction as a share of the friction at high speed."
        ),
    ),
    kinds=frozenset({"isotonic", "transient"}),
    signature=Signature(
        text="a dead band of the load, the same at every pressure, invisible to a force sensor at the muscle",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="dissipative",
    ),
    confused_with=(
        Twin(
            "coulomb_friction", "a spring in place of the muscle, or force sensors on both sides of the guide"
        ),
        Twin("viscous_damping", "force sensors on both sides of the guide"),
    ),
    prior=Prior(0.15, "only rigs with a guide have it"),
    references=(Source("Coulomb and viscous friction of a linear guide", "M"),),
    examples=(
        Example(
            "slot:guide",
            -9.0,
            1e-12,
            _DEFINITION,
            {"force": 5.0, "coefficient": 20.0, "load_share": 0.02},
            {},
            {"presliding": -1.0, "speed": -0.1, "load": 100.0},
        ),
        Example(
            "slot:drive_rates",
            -143.5862115,
            1e-8,
            _BY_HAND,
            {"break_way": 5e-5, "static_share": 0.4, "stribeck_speed": 0.005},
            {},
            {"presliding": 0.5, "speed": -0.005},
        ),
    ),
)
