r"""Seal drag that grows with the pressure: the gas presses the lip of the seal against the rod.

.. math:: F = k P \operatorname{sgn}\dot L
"""

from mckibben.effects import Effect, Example, Parameter, Prior, Signature, Source, Twin


def friction(*, pressure, direction, area):
    """k P sgn(v) [N]: higher tension on lengthening, lower on shortening, 0 at rest."""
    return area * pressure * direction


ESTIMATE = Source("lip seals of 10 mm rods: 10 to 40 N at 6 bar", "E")
DEFINITION = Source("definition: 3e-5 m2 times 3 bar", "D")

EFFECT = Effect(
    title="Drag of a pressed seal",
    family="friction",
    type="static",
    cause="The gas presses the lip of a seal against the rod of a sliding end fitting. The rod therefore "
    "drags with a force that grows with the pressure, against the motion.",
    equation=r"F_{fr} = k\,P\,\operatorname{sgn}\dot L",
    parameters=(
        Parameter(
            "area",
            "k",
            "m^2",
            default=3e-5,
            lower=0.0,
            upper=3e-4,
            off=0.0,
            source=ESTIMATE,
            description="Drag over pressure.",
        ),
    ),
    slots={"friction": friction},
    kinds=frozenset({"isobaric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="a loop whose width grows in proportion to the pressure, with square corners",
        direction="odd",
        pressure_power=1.0,
        zero_at=("no_motion", "zero_pressure"),
        energy="dissipative",
    ),
    confused_with=(
        Twin("pressure_friction", "a second muscle without the seal: its braid rubs all the same"),
        Twin("coulomb_friction", "loops at three pressures: constant width or width growing with pressure"),
    ),
    prior=Prior(0.1, "few end fittings slide"),
    references=(ESTIMATE,),
    examples=(
        Example(
            "force_change",
            9.0,
            1e-9,
            DEFINITION,
            {"area": 3e-5},
            {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.44},
            {"length": 0.28, "pressure": 3e5, "direction": 1.0},
        ),
    ),
    interface=1,
)
