r"""Linear elasticity: the elastomer as a spring that is relaxed at the rest length.

The braid makes the wall stiffer than its rubber: for small strain of a tube of modulus E and cross-section
:math:`A_w` it is :math:`k_e = \tfrac23\frac{E A_w}{L_0}[1+q^2+(q-1)^2]`, :math:`q=\cot^2\theta_0`, some 17
times :math:`E A_w/L_0`. Real muscles follow a straight line over the first 5 % of contraction only; beyond,

.. math:: F = -k_e\,(L_0-L)\,\left(\frac{|L_0-L|}{d_r}\right)^{m-1}, \qquad d_r = L_0/10

At 10 % of contraction the stiffness is force over stroke for any exponent m.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

#: Contraction at which the stiffness is stated.
REFERENCE_CONTRACTION = 0.1
# Below this share of it the spring is linear: the derivative by m has a logarithm, singular at 0.
_LEAST_SHARE = 1e-6


def elastomer(*, length: Value, muscle: Muscle, stiffness: Value, exponent: Value) -> Value:
    """-k_e (L0 - L) (|L0 - L|/d_r)^(m-1) [N]; conservative: a function of the length alone."""
    stretch = length - muscle.nominal_length
    share = ops.absolute(stretch) / (REFERENCE_CONTRACTION * muscle.nominal_length)
    return stiffness * stretch * ops.maximum(share, _LEAST_SHARE) ** (exponent - 1.0)


_MAPS = Source("chord of the elastic tension, Martens & Boblan 2017, doi 10.3390/act6040033", "D")
_TUBE = Source("k_e = 9695 N/m of a latex tube under a braid of 26.5 degrees, times 3 mm", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.0218, "braid_angle": 0.46251225177849735}

EFFECT = Effect(
    title="Elasticity (linear)",
    family="elastomer",
    type="static",
    cause="The braid stretches the elastomer around the muscle when it contracts. For small strain this "
    "acts like a spring that is relaxed at the rest length.",
    equation=r"F_{el} = -k_e\,(L_0-L)\left(\frac{|L_0-L|}{d_r}\right)^{m-1},\quad d_r = \frac{L_0}{10}",
    parameters=(
        Parameter(
            "stiffness",
            "k_e",
            "N/m",
            default=3.3e3,
            lower=0.0,
            upper=1.0e5,
            source=_MAPS,
            description="Loss of tension per contraction stroke, the same at every pressure; for an exponent "
            "other than 1 at 10 % of contraction.",
            off=0.0,
        ),
        Parameter(
            "exponent",
            "m",
            "1",
            default=1.0,
            lower=0.4,
            upper=3.0,
            source=Source("1 for a spring; less for rubber that saturates, more for one that stiffens", "E"),
            description="Exponent of the tension over the stroke; 1 is a linear spring.",
            fitted=False,
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
