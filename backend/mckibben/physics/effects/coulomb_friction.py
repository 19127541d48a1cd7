r"""Coulomb friction between the threads and between threads and bladder, which may be higher at low speed.

.. math:: F = F_c\,\bigl[1 + s\,e^{-|\dot L|/v_s}\bigr]\operatorname{sgn}\dot L, \quad s = F_s/F_c - 1

Without a static excess s it is constant; with one it falls from :math:`F_s` to :math:`F_c` (Stribeck). A
static curve has a direction but no speed: it uses :math:`F_s`. At rest the friction takes any value between
:math:`-F_s` and :math:`F_s`: in a run the load sticks until the force on it leaves that range.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def friction(
    *, direction: Value, force: Value, velocity: Value, static_share: Value, stribeck_speed: Value
) -> Value:
    """F_c (1 + s exp(-|v|/v_s)) sgn(v) [N]: higher tension on lengthening, lower on shortening, 0 at rest."""
    fading = ops.exp(-ops.absolute(velocity) / stribeck_speed)
    return force * direction * (1.0 + static_share * fading)


_CHOU = Source("Chou & Hannaford, IEEE Trans. Robotics Autom. 12 (1996) 90: about 2.5 N", "M")
_RANGE = Source("1-2.5 % of the maximum force", "E")
_STRIBECK = Source("Armstrong-Helouvry, Dupont & Canudas de Wit, Automatica 30 (1994) 1083: some mm/s", "M")
_DEFINITION = Source("definition: half the loop width", "D")
_BY_HAND = Source("10 (1 + 0.3/e) at the Stribeck speed", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Coulomb friction",
    family="friction",
    type="static",
    cause="The threads rub on each other and on the bladder when the braid angle changes. The friction "
    "opposes the motion with a constant force, so the muscle pulls harder while lengthening than while "
    "shortening.",
    equation=r"F_{fr} = F_c\left[1+s\,e^{-|\dot L|/v_s}\right]\operatorname{sgn}\dot L",
    parameters=(
        Parameter(
            "force",
            "F_c",
            "N",
            default=10.0,
            lower=0.0,
            upper=200.0,
            source=_RANGE,
            description="Half the width of the force loop; with a static excess, that at high speed.",
            off=0.0,
        ),
        Parameter(
            "static_share",
            "s",
            "1",
            default=0.0,
            lower=0.0,
            upper=1.0,
            source=Source("static over kinetic friction 1.0-1.3 moulded, up to 2 dry threads", "E"),
            description="Excess of the static over the kinetic friction, F_s/F_c - 1; 0 is the same at "
            "every speed.",
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
    ),
    slots={"friction": friction},
    kinds=frozenset({"isobaric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="a loop of constant width at every pressure and contraction, with square corners",
        direction="odd",
        pressure_power=0.0,
        zero_at=("no_motion",),
        energy="dissipative",
    ),
    confused_with=(
        Twin("pressure_friction", "loops at three pressures: constant width or width growing with pressure"),
        Twin("viscous_damping", "three speeds: Coulomb friction does not change"),
        Twin("prestress", "both directions: friction changes sign, the prestress does not"),
    ),
    prior=Prior(0.6, "every braid rubs, and most measured loops are open"),
    references=(_CHOU,),
    examples=(
        Example(
            "force_change",
            -10.0,
            1e-9,
            _DEFINITION,
            {"force": 10.0},
            _SIZE_20,
            {"length": 0.28, "pressure": 3e5, "direction": -1.0},
        ),
        Example(
            "force_change",
            10.0,
            1e-9,
            _DEFINITION,
            {"force": 10.0},
            _SIZE_20,
            {"length": 0.26, "pressure": 1e5, "direction": 1.0},
        ),
        Example(
            "force_change",
            -11.1036383,
            1e-8,
            _BY_HAND,
            {"force": 10.0, "static_share": 0.3, "stribeck_speed": 0.005},
            _SIZE_20,
            {"length": 0.28, "pressure": 3e5, "velocity": -0.005, "direction": -1.0},
        ),
    ),
)
