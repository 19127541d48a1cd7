r"""Zero error of the pressure sensor: :math:`P_{read} = P + o_P`.

Gauge pressure read as absolute, or the weather with an absolute sensor, gives such an offset: 1 atm changes
the force by 90 N for a 10 mm and 265 N for a 20 mm muscle.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Reading


def pressure_sensor(*, offset: Value) -> Reading:
    """Reading of the sensor: the true pressure plus the offset."""
    return Reading(1.0, offset)


_RANGE = Source(
    "zero error of industrial sensors 0.5-1 % of 10 bar; weather 3 kPa; badly set zero 0.3 bar", "E"
)
_CLOSED_FORM = Source("-o_P A0 (2/sin^2 theta0 - 3), A0 (...) = 643.85527 mm^2", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Pressure sensor: zero error",
    family="sensor",
    type="measurement",
    cause="The pressure sensor does not read zero when the muscle is vented. Every pressure is then too "
    "high or too low by the same amount.",
    equation=r"P_{read} = P + o_P",
    parameters=(
        Parameter(
            "offset",
            "o_P",
            "Pa",
            default=5.0e3,
            lower=-5.0e4,
            upper=5.0e4,
            source=_RANGE,
            description="Reading of the sensor at atmospheric pressure.",
            off=0.0,
        ),
    ),
    slots={"pressure_sensor": pressure_sensor},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="constant in pressure, shaped like the ideal force over contraction",
        direction="even",
        pressure_power=0.0,
        zero_at=("zero_force_length",),
        energy="reading",
    ),
    confused_with=(
        Twin("threshold_pressure", "vent to the atmosphere and read the pressure sensor"),
        Twin("prestress", "lengths near the zero-force length: there the offset vanishes"),
        Twin("force_offset", "lengths near the zero-force length: there a pressure offset vanishes"),
        Twin("bladder_elasticity", "vent and read; the bladder's share grows with contraction"),
    ),
    prior=Prior(0.2, "a zero error above the accuracy of the sensor is an error of the set-up"),
    references=(Source("definition of a zero error", "D"),),
    examples=(
        Example(
            "force_change",
            -6.4385527,
            1e-7,
            _CLOSED_FORM,
            {"offset": 1e4},
            _SIZE_10,
            {"length": 0.1, "pressure": 6e5},
        ),
    ),
)
