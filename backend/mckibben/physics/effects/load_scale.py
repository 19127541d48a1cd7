r"""The load differs from the stated one by a factor, :math:`M' = f_M M,\ F_{ext}' = f_M F_{ext}`."""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def load_factor(*, factor: Value) -> Value:
    """f_M [-]."""
    return factor


_RANGE = Source("weights with hook and cord, an inclined guide", "E")
_DEFINITION = Source("definition", "D")

EFFECT = Effect(
    title="Scale of the load",
    family="load",
    type="static",
    cause="Hooks, cords and the real inclination make the load heavier or lighter than stated. The muscle "
    "then rests at another length and moves with another acceleration.",
    equation=r"M' = f_M M,\quad F_{ext}' = f_M F_{ext}",
    parameters=(
        Parameter(
            "factor",
            "f_M",
            "1",
            default=1.05,
            lower=0.2,
            upper=5.0,
            source=_RANGE,
            description="True over stated load.",
            off=1.0,
        ),
    ),
    slots={"load_factor": load_factor},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="a shift of the rest position together with a lower frequency of ringing",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="conservative",
    ),
    confused_with=(
        Twin("moving_mass", "weigh the load: a mass without weight does not change the rest position"),
        Twin("force_scale", "dead weights on the force sensor"),
        Twin("effectiveness", "weigh the load"),
    ),
    prior=Prior(0.05, "a mass is easily weighed"),
    references=(Source("definition of a scale error", "D"),),
    examples=(Example("slot:load_factor", 0.9, 1e-12, _DEFINITION, {"factor": 0.9}, {}, {}),),
)
