r"""Scale error of the pressure sensor: :math:`P_{read} = s_P P`."""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Reading


def pressure_sensor(*, scale: Value) -> Reading:
    """Reading of the sensor: the true pressure times the scale."""
    return Reading(scale, 0.0)


_CLOSED_FORM = Source("blocked force 386.31316 N divided by the scale", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Pressure sensor: scale error",
    family="sensor",
    type="measurement",
    cause="The pressure sensor is off by a constant factor: a wrong calibration, or a voltage divider. "
    "Every pressure is read too high or too low by the same percentage.",
    equation=r"P_{read} = s_P\,P",
    parameters=(
        Parameter(
            "scale",
            "s_P",
            "1",
            default=1.01,
            lower=0.9,
            upper=1.1,
            source=Source("0.5-2 % of full scale", "E"),
            description="Reading over true gauge pressure.",
            off=1.0,
        ),
    ),
    slots={"pressure_sensor": pressure_sensor},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="proportional to pressure, shaped like the ideal force over contraction",
        direction="even",
        pressure_power=1.0,
        zero_at=("zero_pressure", "zero_force_length"),
        energy="reading",
    ),
    confused_with=(
        Twin(
            "effectiveness", "a pressure calibrator; no muscle test can tell them apart", by_muscle_test=False
        ),
        Twin("force_scale", "a pressure calibrator and dead weights: two independent calibrations"),
        Twin("thread_extensibility", "diameter against pressure at constant length"),
    ),
    prior=Prior(0.1, "a scale error above the accuracy of the sensor is a wrong calibration"),
    references=(Source("definition of a scale error", "D"),),
    examples=(
        Example(
            "force",
            # 386.31316/1.02
            378.73839,
            1e-7,
            _CLOSED_FORM,
            {"scale": 1.02},
            _SIZE_10,
            {"length": 0.1, "pressure": 6e5},
        ),
    ),
)
