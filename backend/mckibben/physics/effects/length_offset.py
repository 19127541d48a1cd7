r"""Zero error of the length, :math:`L_{read} = L + o_L`.

A rest length that differs from the name plate, or an unrecorded pretension, has the same effect.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Reading


def length_sensor(*, offset: Value) -> Reading:
    """Reading of the sensor: the true length plus the offset."""
    return Reading(1.0, offset)


_RANGE = Source("mounting and rest length are known to 1-2 % of 300 mm", "E")
_SHIFT = Source("ideal muscle at the length without the offset, P A0 (a 0.9^2 - c_b)", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Length sensor: zero error",
    family="sensor",
    type="measurement",
    cause="The length is not measured from the rest position of the muscle, because of mounting, pretension "
    "or a wrong rest length. The whole working range is shifted.",
    equation=r"L_{read} = L + o_L",
    parameters=(
        Parameter(
            "offset",
            "o_L",
            "m",
            default=1.0e-3,
            lower=-0.01,
            upper=0.01,
            source=_RANGE,
            description="Measured minus true length.",
            off=0.0,
        ),
    ),
    slots={"length_sensor": length_sensor},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "diameter", "static", "transient"}),
    signature=Signature(
        text="proportional to pressure like the stiffness, nearly the same at every contraction",
        direction="even",
        pressure_power=1.0,
        zero_at=("zero_pressure",),
        energy="reading",
    ),
    confused_with=(
        Twin("end_caps", "gauge blocks, or two muscle lengths"),
        Twin("contraction_factor", "the rest length: the factor does nothing there"),
        Twin("rig_compliance", "replace the muscle by a rigid rod"),
        Twin("braid_stiffening", "several pressures: the braid's share does not grow with pressure"),
    ),
    prior=Prior(0.3, "the zero of a stroke is often taken by hand"),
    references=(Source("definition of a zero error", "D"),),
    examples=(
        Example(
            "force",
            # 6e5 * 78.539816e-6 (13.796730 * 0.81 - 5.598910)
            262.78360,
            1e-7,
            _SHIFT,
            {"offset": 0.005},
            _SIZE_10,
            {"length": 0.095, "pressure": 6e5},
        ),
    ),
)
