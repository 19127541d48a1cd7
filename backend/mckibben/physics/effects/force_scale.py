r"""Scale error of the force sensor, :math:`F_{read} = s_F F`.

A pull that is not in line with the sensor reads the same way, :math:`s_F = \cos\varphi`.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Reading


def force_sensor(*, scale: Value) -> Reading:
    """Reading of the sensor: the true force times the scale."""
    return Reading(scale, 0.0)


_DEFINITION = Source("blocked force 386.31316 N times cos 10 degrees", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Force sensor: scale error",
    family="sensor",
    type="measurement",
    cause="The force sensor is off by a constant factor, or the muscle pulls at an angle to it. Every force "
    "is read too high or too low by the same percentage.",
    equation=r"F_{read} = s_F\,F",
    parameters=(
        Parameter(
            "scale",
            "s_F",
            "1",
            default=0.99,
            lower=0.8,
            upper=1.2,
            source=Source("calibration 0.1-2 %; 10 degrees out of line 1.5 %", "E"),
            description="Reading over true force.",
            off=1.0,
        ),
    ),
    slots={"force_sensor": force_sensor},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="a constant share of the whole force, elastic part and friction included",
        direction="even",
        pressure_power=1.0,
        zero_at=("zero_force", "zero_pressure", "zero_force_length"),
        energy="reading",
    ),
    confused_with=(
        Twin("effectiveness", "dead weights on the force sensor"),
        Twin("pressure_scale", "a pressure calibrator and dead weights: two independent calibrations"),
        Twin("wall_thickness", "measure wall and braid diameter"),
    ),
    prior=Prior(0.1, "a scale error above the accuracy of the sensor is a wrong calibration"),
    references=(Source("definition of a scale error", "D"),),
    examples=(
        Example(
            "force",
            # 386.31316 * 0.98480775
            380.44420,
            1e-7,
            _DEFINITION,
            {"scale": 0.984807753012208},
            _SIZE_10,
            {"length": 0.1, "pressure": 6e5},
        ),
    ),
)
