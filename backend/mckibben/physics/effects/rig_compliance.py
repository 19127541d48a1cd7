r"""Compliance in series: cord, pulley and frame stretch under the force, :math:`L_{muscle} = L - c_r F`.

The length of the muscle depends on the force, so this effect only states the compliance; the caller solves
for force and length together.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def compliance(*, compliance: Value) -> Value:
    """Extension per force of the parts in series with the muscle [m/N]."""
    return compliance


_RANGE = Source("light frames and cords up to 5 mm at 1 kN, stiff rigs 0.1 mm", "E")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.0218, "braid_angle": 0.46251225177849735}

EFFECT = Effect(
    title="Compliance of the rig",
    family="load",
    type="static",
    cause="Cord, pulley and frame deform under the force of the muscle. The muscle is then shorter than "
    "the length that is measured over the rig.",
    equation=r"L_{muscle} = L - c_r\,F",
    parameters=(
        Parameter(
            "compliance",
            "c_r",
            "m/N",
            default=1.0e-6,
            lower=0.0,
            upper=2.0e-5,
            source=_RANGE,
            description="Extension of the rig per force; 1 mm at 1 kN is 1e-6 m/N.",
            off=0.0,
        ),
    ),
    slots={"compliance": compliance},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="a length error in proportion to the force: nearly the square of pressure at constant length",
        direction="even",
        pressure_power=None,
        zero_at=("zero_force", "zero_pressure", "zero_force_length"),
        energy="reading",
    ),
    confused_with=(
        Twin("thread_extensibility", "diameter against pressure at constant length, or a rigid rod"),
        Twin("length_offset", "replace the muscle by a rigid rod"),
        Twin("braid_stiffening", "pull without pressure, measured on the fittings of the muscle"),
    ),
    prior=Prior(0.3, "frames, clamps and load cells give way a little"),
    references=(Source("springs in series", "D"),),
    examples=(
        Example(
            "compliance",
            5e-6,
            1e-12,
            Source("definition: 5 mm at 1 kN", "D"),
            {"compliance": 5e-6},
            _SIZE_20,
            {"length": 0.3, "pressure": 6e5},
        ),
    ),
)
