r"""Volume of the wall: the gas has less room than the braid, :math:`V = V_{braid} - \pi t (D_b-t) L_0`.

Rubber keeps its volume, whatever the length: :math:`dV/dL`, and so the force, is that of the braid. The
muscle takes less air, and its pressure changes faster. So it is with a rod or filler in the bore.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_THICKEST = 0.2  # share of the diameter, which leaves a third of the volume at rest


def wall_volume(*, muscle: Muscle, thickness: Value) -> Value:
    """-pi t (D_b - t) L_0 [m^3]; no more than a wall of a fifth of the diameter."""
    wall = ops.minimum(thickness, _THICKEST * muscle.braid_diameter)
    return -ops.pi * wall * (muscle.braid_diameter - wall) * muscle.nominal_length


_BY_HAND = Source("-pi * 1 mm * (10 - 1) mm * 100 mm", "D")

EFFECT = Effect(
    title="Volume of the wall",
    family="gas",
    type="dynamic",
    cause="Rubber and threads, or a filler in the bore, take room inside the braid that the gas does not "
    "have. Filling and venting take less air and less time.",
    equation=r"V = V_{braid}(L) - \pi\,t\,(D_b-t)\,L_0",
    parameters=(
        Parameter(
            "thickness",
            "t",
            "m",
            default=0.0015,
            lower=0.0,
            upper=0.006,
            source=Source("hand-made bladders 0.5-1.6 mm, moulded 1.3-2.2 mm, thick muscles more", "E"),
            description="Thickness at rest of what is between gas and braid.",
            off=0.0,
            across=True,
        ),
    ),
    slots={"extra_volume": wall_volume},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="pressure rises and falls faster, most so near the length at rest, where the volume is small",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="conservative",
    ),
    confused_with=(
        Twin("flow_coefficient", "weigh the air in the muscle, or fill it with water"),
        Twin("wall_thickness", "measure the force: a wall that keeps its volume leaves it as it is"),
        Twin("dead_volume", "the sign: dead volume makes filling slower, a wall makes it faster"),
    ),
    prior=Prior(0.5, "the wall always takes room from the gas"),
    references=(Source("conservation of volume of rubber", "D"),),
    examples=(
        Example(
            "slot:extra_volume",
            -2.827433388230814e-06,
            1e-12,
            _BY_HAND,
            {"thickness": 1e-3},
            {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824},
            {},
        ),
    ),
)
