r"""Friction that grows with pressure: the gas presses the threads together.

.. math:: F = \mu_P\,P\left(\frac{P}{P_r}\right)^{q-1}\left(\frac{D}{D_0}\right)^m\operatorname{sgn}\dot L,
   \quad P_r = 3\,\text{bar}

With q = 1 and m = 0 it is Coulomb friction in proportion to pressure. Contacts that grow with their load
have q < 1. Where the muscle is thicker, the gas presses more braid together: m = 1 follows the circumference,
m = 2 the cross-section.
"""

from mckibben.physics import braid, ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

#: Pressure at which the area is stated [Pa].
REFERENCE_PRESSURE = 3e5
# Share of it below which the friction is linear: the derivative by q has a logarithm, singular at 0.
_LEAST_SHARE = 1e-6


def friction(
    *,
    muscle: Muscle,
    length: Value,
    direction: Value,
    pressure: Value,
    area: Value,
    exponent: Value,
    diameter_power: Value,
) -> Value:
    """mu_P P (P/P_r)^(q-1) (D/D0)^m sgn(dL/dt) [N]; 0 at rest and at or below atmospheric pressure."""
    thicker = braid.diameter(braid=muscle.braid, length=length) / muscle.braid_diameter
    above = ops.positive_part(pressure)
    share = ops.maximum(above / REFERENCE_PRESSURE, _LEAST_SHARE)
    return area * above * share ** (exponent - 1.0) * thicker**diameter_power * direction


_RANGE = Source("0.2-30 N/bar over the sizes, 2-6 N/bar for size 20", "E")
_DEFINITION = Source("definition: 4 N/bar at 3 bar", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Friction growing with pressure",
    family="friction",
    type="static",
    cause="The gas presses the threads onto each other and the bladder onto the threads. Their friction "
    "therefore grows with pressure, and so does the width of the force loop.",
    equation=r"F_{fr} = \mu_P\,P\left(\frac{P}{P_r}\right)^{q-1}\left(\frac{D}{D_0}\right)^m"
    r"\operatorname{sgn}\dot L",
    parameters=(
        Parameter(
            "area",
            r"\mu_P",
            "m2",
            default=4.0e-5,
            lower=0.0,
            upper=5.0e-4,
            source=_RANGE,
            description="Half the width of the force loop per pressure, at 3 bar.",
            off=0.0,
        ),
        Parameter(
            "exponent",
            "q",
            "1",
            default=1.0,
            lower=0.5,
            upper=1.5,
            source=Source("2/3 for a Hertzian contact, 1 for rough surfaces (Bowden & Tabor)", "M"),
            description="Exponent of the friction over pressure; 1 is in proportion.",
            fitted=False,
        ),
        Parameter(
            *("diameter_power", "m", "1", 0.0, -1.0, 3.0, Source("1 circumference, 2 cross-section", "D")),
            description="Exponent over the braid diameter; 0 is the same at every contraction.",
            fitted=False,
        ),
    ),
    slots={"friction": friction},
    kinds=frozenset({"isobaric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="a loop whose width grows in proportion to pressure and is the same at every contraction",
        direction="odd",
        pressure_power=1.0,
        zero_at=("no_motion", "zero_pressure"),
        energy="dissipative",
    ),
    confused_with=(
        Twin("coulomb_friction", "loops at three pressures: width growing with pressure or constant"),
        Twin("contact_friction", "two muscle lengths: contact friction grows with the length"),
        Twin("viscous_damping", "three speeds at three pressures, crossed"),
        Twin(
            "pressure_hysteresis",
            "force against pressure at constant length: only a pressure-driven loop shows",
        ),
    ),
    prior=Prior(0.4, "threads are pressed together by the pressure, so friction often grows with it"),
    references=(
        Source("Chou & Hannaford, IEEE Trans. Robotics Autom. 12 (1996) 90", "M"),
        Source("Tondu, J. Intell. Mater. Syst. Struct. 23 (2012) 225", "M"),
        Source("Davis & Caldwell, Int. J. Robotics Research 25 (2006) 359: contact of strands", "M"),
    ),
    examples=(
        Example(
            "force_change",
            -12.0,
            1e-9,
            _DEFINITION,
            {"area": 4e-5},
            _SIZE_20,
            {"length": 0.28, "pressure": 3e5, "direction": -1.0},
        ),
        Example(
            "force_change",
            12.0,
            1e-9,
            _DEFINITION,
            {"area": 4e-5},
            _SIZE_20,
            {"length": 0.25, "pressure": 3e5, "direction": 1.0},
        ),
        Example(
            "force_change",
            # 12 (1 - (28/30 cos 25 deg)^2)/(sin 25 deg)^2
            19.1129807,
            1e-9,
            _DEFINITION,
            {"area": 4e-5, "diameter_power": 2.0},
            _SIZE_20,
            {"length": 0.28, "pressure": 3e5, "direction": 1.0},
        ),
    ),
)
