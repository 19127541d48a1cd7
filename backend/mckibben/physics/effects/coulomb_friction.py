r"""Constant Coulomb friction between the threads and between threads and bladder."""

from mckibben.physics.effect import Effect, Example, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def friction(*, direction: Value, force: Value) -> Value:
    """F_c sgn(dL/dt) [N]: tension is higher on lengthening, lower on shortening, 0 at rest."""
    return force * direction


_CHOU = Source("Chou & Hannaford, IEEE Trans. Robotics Autom. 12 (1996) 90: about 2.5 N", "M")
_RANGE = Source("1-2.5 % of the maximum force", "E")
_DEFINITION = Source("definition: half the loop width", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Coulomb friction",
    family="friction",
    type="static",
    cause="The threads rub on each other and on the bladder when the braid angle changes. The friction "
    "opposes the motion with a constant force, so lengthening takes more and shortening gives less.",
    equation=r"F_{fr} = F_c\,\operatorname{sgn}\dot L",
    parameters=(
        Parameter(
            "force",
            "F_c",
            "N",
            10.0,
            0.0,
            200.0,
            _RANGE,
            "Half the width of the force loop.",
            off=0.0,
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
    ),
)
