r"""Zero error of the force sensor, :math:`F_{read} = F + o_F`, e.g. the weight of parts attached to it."""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Reading


def force_sensor(*, offset: Value) -> Reading:
    """Reading of the sensor: the true force plus the offset."""
    return Reading(1.0, offset)


_RANGE = Source("0.1-1 % of a 1 kN cell, weight of muscle and fixtures 0.5-50 N", "E")
_DEFINITION = Source("blocked force 386.31316 N plus the offset", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Force sensor: zero error",
    family="sensor",
    type="measurement",
    cause="The force sensor does not read zero without the muscle, or carries the weight of attached "
    "parts. Every force is then too high or too low by the same amount.",
    equation=r"F_{read} = F + o_F",
    parameters=(
        Parameter(
            "offset",
            "o_F",
            "N",
            default=5.0,
            lower=-200.0,
            upper=200.0,
            source=_RANGE,
            description="Reading of the sensor without the muscle.",
            off=0.0,
        ),
    ),
    slots={"force_sensor": force_sensor},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="one constant force at every pressure and contraction",
        direction="even",
        pressure_power=0.0,
        zero_at=(),
        energy="reading",
    ),
    confused_with=(
        Twin(
            "prestress",
            "read the force sensor with the muscle removed; no muscle test can tell them apart",
            by_muscle_test=False,
        ),
        Twin("coulomb_friction", "both directions: friction changes sign, an offset does not"),
        Twin("pressure_offset", "lengths near the zero-force length: there a pressure offset vanishes"),
    ),
    prior=Prior(0.2, "load cells are often not tared after mounting"),
    references=(Source("definition of a zero error", "D"),),
    examples=(
        Example(
            "force",
            391.31316,
            1e-7,
            _DEFINITION,
            {"offset": 5.0},
            _SIZE_10,
            {"length": 0.1, "pressure": 6e5},
        ),
    ),
)
