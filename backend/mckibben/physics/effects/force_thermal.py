r"""The zero of the force sensor moves with its temperature, :math:`F_{read} = F + c_T\,(T - T_0)`.

The temperature is the recorded one, of the room or of the amplifier; without a record it is that of a room,
and the effect is a constant.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Reading

_REFERENCE = 293.15  # K


def force_sensor(*, temperature: Value, coefficient: Value) -> Reading:
    """Reading of the sensor: the true force plus c_T (T - 293.15 K)."""
    return Reading(1.0, coefficient * (temperature - _REFERENCE))


_RANGE = Source("0.05-0.5 % of full scale per 10 K for cells, several times that for cheap amplifiers", "M")
_DEFINITION = Source("definition: 0.5 N/K times 10 K", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Force sensor: zero moves with temperature",
    family="sensor",
    type="measurement",
    cause="The strain gauges, the wires and the amplifier of a load cell shift its zero as they warm up. The "
    "force then follows the temperature, whatever the muscle does.",
    equation=r"F_{read} = F + c_T\,(T-T_0)",
    parameters=(
        Parameter(
            *("coefficient", "c_T", "N/K", 0.5, -20.0, 20.0, _RANGE),
            description="Change of the zero per kelvin; the zero at 20 degC is that of the sensor.",
            off=0.0,
        ),
    ),
    slots={"force_sensor": force_sensor},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="the same shift of every force, along with the temperature",
        direction="even",
        pressure_power=0.0,
        zero_at=("reference_temperature",),
        energy="reading",
    ),
    confused_with=(
        Twin("force_drift", "a test at once after an hour with the amplifier on: warmed up, its zero rests"),
        Twin("temperature", "the vented, slack muscle: an elastomer that warms leaves its zero alone"),
        Twin("force_offset", "the same test in a warm room: a constant zero does not follow"),
    ),
    prior=Prior(0.1, "few rigs change their temperature during a test"),
    references=(Source("OIML R 60 (2017), temperature effect on minimum dead load output", "M"),),
    examples=(
        Example(
            *("force_change", 5.0, 1e-9, _DEFINITION, {"coefficient": 0.5}, _SIZE_10),
            {"length": 0.1, "pressure": 3e5, "temperature": 303.15},
        ),
    ),
)
