r"""Linear elasticity: the elastomer as a spring that is relaxed at the nominal length.

The braid makes the wall stiffer than its rubber: for small strain of a tube of modulus E and cross-section
:math:`A_w` it is :math:`k_e = \tfrac23\frac{E A_w}{L_0}[1+q^2+(q-1)^2]`, :math:`q=\cot^2\theta_0`, some 17
times :math:`E A_w/L_0`. Real muscles follow a straight line over the first 5 % of contraction only.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def elastomer(*, length: Value, muscle: Muscle, stiffness: Value) -> Value:
    """-k_e (L0 - L) [N], from the energy k_e (L0 - L)^2/2."""
    return stiffness * (length - muscle.nominal_length)


_MAPS = Source("chord of the elastic tension, Martens & Boblan 2017, doi 10.3390/act6040033", "D")
_TUBE = Source("k_e = 9695 N/m of a latex tube under a braid of 26.5 degrees, times 3 mm", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.0218, "braid_angle": 0.46251225177849735}

EFFECT = Effect(
    title="Elasticity (linear)",
    family="elastomer",
    type="static",
    cause="The braid stretches the elastomer around the muscle when it contracts. For small strain this "
    "acts like a spring that is relaxed at the nominal length.",
    equation=r"F_{el} = -k_e\,(L_0-L)",
    parameters=(
        Parameter(
            "stiffness",
            "k_e",
            "N/m",
            default=3.3e3,
            lower=0.0,
            upper=1.0e5,
            source=_MAPS,
            description="Loss of tension per contraction stroke, the same at every pressure.",
            off=0.0,
        ),
    ),
    slots={"elastomer": elastomer},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="constant in pressure, proportional to contraction",
        direction="even",
        pressure_power=0.0,
        zero_at=("nominal_length",),
        energy="conservative",
    ),
    confused_with=(
        Twin(
            "bladder_elasticity",
            "contractions beyond 10 %: a linear spring keeps rising, the bladder saturates",
        ),
        Twin("contraction_factor", "several pressures: the effect of the factor grows with pressure"),
        Twin("end_caps", "several pressures: the share of the ends grows with pressure"),
        Twin("creep", "two speeds: elasticity has no rate"),
    ),
    prior=Prior(0.2, "a straight-line summary of what rubber does; the bladder itself is seldom linear"),
    references=(
        Source("Reynolds et al., Ann. Biomed. Eng. 31 (2003) 310", "M"),
        Source("Martens & Boblan, Actuators 6(4):33 (2017), doi 10.3390/act6040033", "S2"),
    ),
    examples=(
        Example(
            "force_change",
            -29.085,
            1e-9,
            _TUBE,
            {"stiffness": 9695.0},
            _SIZE_20,
            {"length": 0.297, "pressure": 3e5},
        ),
    ),
)
