r"""Further moving mass, :math:`(M + M_x)\,\ddot s = F - (M + h M_x) g - \dots`: pulleys, carriage, hook.

Of a balanced or guided mass the weight does not act on the muscle, h = 0; of a hook or clamp it does, h = 1.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def inertia(*, mass: Value) -> Value:
    """M_x [kg]."""
    return mass


def hung_mass(*, mass: Value, hung: Value) -> Value:
    """h M_x [kg]."""
    return hung * mass


_RANGE = Source("carriage, fittings and the inertia of pulleys over their radius squared", "E")
_SHARE = Source("between a balanced mass and a hung one", "D")
_DEFINITION = Source("definition", "D")

EFFECT = Effect(
    title="Additional moving mass",
    family="load",
    type="dynamic",
    cause="Carriage, fittings, hooks and pulleys are accelerated together with the load. The load starts and "
    "stops more slowly and oscillates at a lower frequency, and what hangs on the muscle also pulls it.",
    equation=r"(M+M_x)\,\ddot s = F-(M+h\,M_x)\,g-\dots",
    parameters=(
        Parameter(
            "mass",
            "M_x",
            "kg",
            default=0.5,
            lower=0.0,
            upper=100.0,
            source=_RANGE,
            description="Moving mass in addition to the load.",
            off=0.0,
        ),
        Parameter(
            "hung",
            "h",
            "1",
            default=0.0,
            lower=0.0,
            upper=1.0,
            source=_SHARE,
            description="Share of it whose weight acts: 0 balanced, 1 hung on the muscle.",
            fitted=False,
            natural=True,
        ),
    ),
    slots={"inertia": inertia, "hung_mass": hung_mass},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="a force in proportion to the acceleration, and a lower frequency of ringing",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="conservative",
    ),
    confused_with=(
        Twin("load_scale", "weigh the load: a wrong weight also changes the rest position"),
        Twin("sensor_lag", "a second mass: the ringing moves, a filter stays"),
        Twin("dead_volume", "a second mass: the ringing moves with the root of the mass"),
    ),
    prior=Prior(0.4, "clamps, hooks and rods move with the load and are seldom weighed"),
    references=(Source("Newton's second law", "D"),),
    examples=(
        Example("slot:inertia", 1.5, 1e-12, _DEFINITION, {"mass": 1.5}, {}, {}),
        Example("slot:hung_mass", 0.6, 1e-12, _DEFINITION, {"mass": 1.5, "hung": 0.4}, {}, {}),
    ),
)
