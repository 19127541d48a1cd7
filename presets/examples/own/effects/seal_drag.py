"""Seal drag: the sliding end fitting takes part of the pull."""

from mckibben.effects import Effect, Example, Parameter, Signature, Source, Twin


def tension(*, drag):
    """A constant share of the tension [N]."""
    return -drag


ESTIMATE = Source("bench estimate", "E")
EFFECT = Effect(
    title="Seal drag",
    family="load",
    type="static",
    cause="The sliding end fitting has a seal. It takes a constant force off the pull.",
    equation=r"F = F_0 - F_s",
    parameters=(
        Parameter(
            "drag", "F_s", "N",
            default=5.0, lower=0.0, upper=50.0, off=0.0,
            source=ESTIMATE, description="Force of the seal.",
        ),
    ),
    slots={"tension": tension},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature("the same force at every pressure and length", "even", 0.0, (), "conservative"),
    confused_with=(
        Twin("force_offset", "the load cell without the muscle"),
        Twin("prestress", "the muscle without its seal, at the same length and pressure"),
    ),
    references=(ESTIMATE,),
    examples=(
        Example(
            "force_change",
            -5.0,
            1e-9,
            ESTIMATE,
            {"drag": 5.0},
            {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.44},
            {"length": 0.28, "pressure": 3e5},
        ),
    ),
)
