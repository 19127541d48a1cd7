r"""Braid lock: neighbouring strands touch at a largest braid angle and stop the contraction.

Strands of width w on rhombi of side :math:`\ell` touch at :math:`\ell\sin 2\theta = w`, so
:math:`\theta_{max} = 90^\circ - \tfrac12\arcsin(w/\ell)`. Only when this is below 54.7 degrees does it end
the contraction before the ideal model does; the jammed braid is a stiff one-sided spring.

.. math:: F = -k_l\,d\,(d/d_r)^{m-1}, \quad d = \max(b\cos\theta_{max}-L,\,0), \quad d_r = L_0/100

At :math:`d_r` beyond the lock the stiffness is force over travel for any exponent m.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

# Travel beyond the lock at which the stiffness is stated, as a share of the rest length.
REFERENCE_SHARE = 0.01
# Below this share of the reference the spring is linear: the derivative by m has a logarithm, singular at 0.
_LEAST_SHARE = 1e-6


def tension(*, length: Value, muscle: Muscle, stiffness: Value, lock_angle: Value, exponent: Value) -> Value:
    """-k_l d (d/d_r)^(m-1) with d = max(b cos(theta_max) - L, 0) [N]; never positive."""
    lock_length = muscle.braid.thread_length * ops.cos(lock_angle)
    travel = ops.positive_part(lock_length - length)
    share = ops.maximum(travel / (REFERENCE_SHARE * muscle.nominal_length), _LEAST_SHARE)
    return -stiffness * travel * share ** (exponent - 1.0)


_DAVIS = Source("Davis & Caldwell, Int. J. Robotics Res. 25 (2006) 359", "M")
_DEFINITION = Source("stiffness times the travel beyond b cos(theta_max), by hand", "D")
_POWER_BY_HAND = Source("302.06009 * 3.0206009^0.5: 1 % of 100 mm is 1 mm", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Braid lock (strands touching)",
    family="geometry",
    type="static",
    cause="The strands have a width, so the braid cannot close beyond the angle at which neighbours touch. "
    "From there on the muscle hardly contracts any further, whatever the pressure.",
    equation=r"F_{l} = -k_l\,d\left(\frac{d}{d_r}\right)^{m-1},\quad "
    r"d = \max(b\cos\theta_{max}-L,\,0),\quad d_r = \frac{L_0}{100}",
    parameters=(
        Parameter(
            "stiffness",
            "k_l",
            "N/m",
            default=1.0e5,
            lower=0.0,
            upper=5.0e6,
            source=Source("2-20 times the muscle's own stiffness at high pressure", "E"),
            description="Stiffness of the jammed braid: force over travel, for an exponent other than 1 at "
            "1 % of the rest length beyond the lock.",
            off=0.0,
        ),
        Parameter(
            "lock_angle",
            r"\theta_{max}",
            "rad",
            default=0.7853981633974483,
            lower=0.6,
            upper=1.2,
            source=Source("45 degrees: strands as wide as the rhombus' side; 34-69 degrees", "E"),
            description="Braid angle at which neighbouring strands touch.",
        ),
        Parameter(
            "exponent",
            "m",
            "1",
            default=1.0,
            lower=1.0,
            upper=8.0,
            source=Source("1.5 for round strands in Hertzian contact, more where they touch one by one", "E"),
            description="Exponent of the force over the travel beyond the lock; 1 is a linear spring.",
            fitted=False,
        ),
    ),
    slots={"tension": tension},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="nothing up to one contraction, then a steep loss of force, the same at every pressure",
        direction="even",
        pressure_power=0.0,
        zero_at=("nominal_length", "longer_than_nominal"),
        energy="conservative",
    ),
    confused_with=(
        Twin("bladder_elasticity", "large contractions: the lock has a kink, the bladder saturates"),
        Twin("contraction_factor", "free contraction against pressure: the lock ends it at one length"),
    ),
    prior=Prior(0.1, "it matters only near the largest contraction of the braid"),
    references=(_DAVIS,),
    examples=(
        Example(
            "force_change",
            # b cos 45 deg = 110.33779 * 0.70710678 = 78.020601 mm: -1e5 * 3.020601e-3
            -302.06009,
            1e-7,
            _DEFINITION,
            {"stiffness": 1e5, "lock_angle": 0.7853981633974483},
            _SIZE_10,
            {"length": 0.075, "pressure": 6e5},
        ),
        Example(
            "force_change",
            0.0,
            1e-9,
            _DEFINITION,
            {"stiffness": 1e5, "lock_angle": 0.7853981633974483},
            _SIZE_10,
            {"length": 0.079, "pressure": 6e5},
        ),
        Example(
            "force_change",
            -524.97668,
            1e-7,
            _POWER_BY_HAND,
            {"stiffness": 1e5, "lock_angle": 0.7853981633974483, "exponent": 1.5},
            _SIZE_10,
            {"length": 0.075, "pressure": 6e5},
        ),
    ),
)
