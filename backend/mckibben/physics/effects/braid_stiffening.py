r"""Braid stiffening: beyond its largest length the threads are taut along the axis and act as a stiff spring.

The source paper prints this as eq. (23) with the condition :math:`L > L_{min}`, which would make the braid
push over the whole working range; the spring is meant to act beyond :math:`L_{max}`.

Threads become taut one after another, so the pull may grow faster than the travel:

.. math:: F = k_{br}\,d\,(d/d_r)^{m-1}, \quad d = \max(L-L_{max},\,0), \quad d_r = L_0/100

At :math:`d_r` beyond the onset the stiffness is force over travel for any exponent m.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

# Travel beyond the onset at which the stiffness is stated, as a share of the rest length.
REFERENCE_SHARE = 0.01
# Below this share of the reference the spring is linear: the derivative by m has a logarithm, singular at 0.
_LEAST_SHARE = 1e-6


def tension(*, length: Value, muscle: Muscle, stiffness: Value, onset: Value, exponent: Value) -> Value:
    """k_br d (d/d_r)^(m-1) with d = max(L - L0 (1 - onset), 0) [N]; never negative."""
    travel = ops.positive_part(length - muscle.nominal_length * (1.0 - onset))
    share = ops.maximum(travel / (REFERENCE_SHARE * muscle.nominal_length), _LEAST_SHARE)
    return stiffness * travel * share ** (exponent - 1.0)


_COLBRUNN = Source("Colbrunn, Nelson & Quinn, IEEE/RSJ IROS (2001)", "M")
_DEFINITION = Source("1000 N at 20 mm beyond L0 = 247 mm and 6 bar take 504 N beyond the ideal 496 N", "D")
_PAPER = {"nominal_length": 0.247, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Braid stiffening when stretched",
    family="geometry",
    type="static",
    cause="Stretched beyond its rest length the braid aligns with the axis and its strands jam. The threads "
    "themselves then carry the pull, like a stiff spring that only acts on one side.",
    equation=r"F_{br} = k_{br}\,d\left(\frac{d}{d_r}\right)^{m-1},\quad d = \max(L-L_{max},\,0),"
    r"\quad L_{max} = L_0(1-\varepsilon_0),\quad d_r = \frac{L_0}{100}",
    parameters=(
        Parameter(
            "stiffness",
            "k_{br}",
            "N/m",
            default=1.0e5,
            lower=0.0,
            upper=2.0e6,
            source=Source("share of N E_t A_t/L0; 20-1500 kN/m over the sizes at 0.3 m", "E"),
            description="Stiffness of the braid beyond the onset: force over travel, for an exponent other "
            "than 1 at 1 % of the rest length beyond it.",
            off=0.0,
        ),
        Parameter(
            "onset",
            r"\varepsilon_0",
            "1",
            default=0.0,
            lower=-0.1,
            upper=0.0,
            source=Source("the catalogue's permitted pretension is 3-5 % of L0", "E"),
            description="Contraction at which the spring begins; 0 is the rest length, -0.02 is 2 % stretch.",
            fitted=False,
        ),
        Parameter(
            "exponent",
            "m",
            "1",
            default=1.0,
            lower=1.0,
            upper=6.0,
            source=Source("1 for taut threads, more where they become taut one after another", "E"),
            description="Exponent of the force over the travel beyond the onset; 1 is a linear spring.",
            fitted=False,
        ),
    ),
    slots={"tension": tension},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="nothing up to the rest length, then a steep rise, the same at every pressure",
        direction="even",
        pressure_power=0.0,
        zero_at=("nominal_length", "shorter_than_nominal"),
        energy="conservative",
    ),
    confused_with=(
        Twin("bladder_elasticity", "pull without pressure: only the braid has a kink, at one fixed length"),
        Twin("rig_compliance", "replace the muscle by a rigid rod"),
        Twin("length_offset", "several pressures: the braid's share does not grow with pressure"),
    ),
    prior=Prior(0.2, "it matters for muscles pulled beyond their rest length"),
    references=(_COLBRUNN,),
    examples=(
        Example(
            "force_change",
            504.0,
            1e-9,
            _DEFINITION,
            {"stiffness": 25.2e3, "onset": 0.0},
            _PAPER,
            {"length": 0.267, "pressure": 6e5},
        ),
        Example(
            "force_change",
            0.0,
            1e-9,
            _DEFINITION,
            {"stiffness": 25.2e3, "onset": -0.1},
            _PAPER,
            {"length": 0.267, "pressure": 6e5},
        ),
    ),
)
