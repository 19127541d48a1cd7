r"""Moving mass without weight on the muscle, :math:`(M + M_x)\,\ddot s = \dots`: pulleys, carriage."""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def inertia(*, mass: Value) -> Value:
    """M_x [kg]."""
    return mass


_RANGE = Source("carriage, fittings and the inertia of pulleys over their radius squared", "E")
_DEFINITION = Source("definition", "D")

EFFECT = Effect(
    title="Additional moving mass",
    family="load",
    type="dynamic",
    cause="Carriage, fittings and pulleys are accelerated together with the load. They hardly change the "
    "force at rest, but the load starts and stops more slowly and oscillates at a lower frequency.",
    equation=r"(M+M_x)\,\ddot s = \dots",
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
    ),
    slots={"inertia": inertia},
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
    examples=(Example("slot:inertia", 1.5, 1e-12, _DEFINITION, {"mass": 1.5}, {}, {}),),
)
