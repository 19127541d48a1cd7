r"""Prestress: a constant tension at every length and pressure; bladder and braid differ in rest length.

The tension belongs to the elastomer, so it changes with the temperature of the wall.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def elastomer(*, force: Value) -> Value:
    """-F_0 [N], from the energy -F_0 L."""
    return -force


_MAPS = Source("fit of the force maps of Martens & Boblan 2017: 110 N (size 20), 40 N (size 10)", "D")
_DEFINITION = Source("definition", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.0218, "braid_angle": 0.46251225177849735}

EFFECT = Effect(
    title="Prestress of the bladder",
    family="elastomer",
    type="static",
    cause="The bladder is not exactly as long as the braid when they are clamped together, so it pushes or "
    "pulls from the start. The difference is the same at every length and pressure.",
    equation=r"F_{pre} = -F_0",
    parameters=(
        Parameter(
            "force",
            "F_0",
            "N",
            default=110.0,
            lower=-200.0,
            upper=500.0,
            source=_MAPS,
            description="Constant loss of tension; negative when the bladder pulls.",
            off=0.0,
            default_at=2097.5,  # the size 20 of the map
        ),
    ),
    slots={"elastomer": elastomer},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="one constant force at every pressure and contraction",
        direction="even",
        pressure_power=0.0,
        zero_at=(),
        energy="conservative",
    ),
    confused_with=(
        Twin(
            "force_offset",
            "read the force sensor with the muscle removed; no muscle test can tell them apart",
            by_muscle_test=False,
        ),
        Twin("coulomb_friction", "both directions: friction changes sign, the prestress does not"),
        Twin("threshold_pressure", "lengths near the zero-force length: there the threshold vanishes"),
        Twin(
            "bladder_elasticity",
            "lengths near the rest length: there the prestress acts, the bladder does not",
        ),
    ),
    prior=Prior(0.5, "bladder and braid are seldom clamped at exactly the same length"),
    references=(Source("Martens & Boblan, Actuators 6(4):33 (2017), doi 10.3390/act6040033", "S2"),),
    examples=(
        Example(
            "force_change",
            -110.0,
            1e-9,
            _DEFINITION,
            {"force": 110.0},
            _SIZE_20,
            {"length": 0.27, "pressure": 3e5},
        ),
        Example(
            "force_change",
            40.0,
            1e-9,
            _DEFINITION,
            {"force": -40.0},
            _SIZE_20,
            {"length": 0.3, "pressure": 0.0},
        ),
    ),
)
