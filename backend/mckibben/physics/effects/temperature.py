r"""Temperature of the elastomer multiplies all its tensions by :math:`1 + \beta(T-T_0)`.

Two mechanisms act against each other. The network of the rubber is elastic by entropy and stiffens when
warm, :math:`\beta = 1/T_0`, +0.3 % per kelvin: an unfilled bladder of latex or silicone. The network of the
filler (carbon black) between its chains loosens when warm, -0.3 to -1 % per kelvin, and outweighs it: the
chloroprene bladder of a made muscle. The default is that of filled rubber, as in `self_heating`, where the
same softening is stated per work instead of per kelvin; a positive value is that of an unfilled bladder. The
temperature is that of the wall, which a working muscle heats over minutes.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def elastomer_factor(*, temperature: Value, coefficient: Value, reference_temperature: Value) -> Value:
    """1 + beta (T - T0) [-]."""
    return 1.0 + coefficient * (temperature - reference_temperature)


_BOTH_SIGNS = Source("filled rubber -0.01 to -0.003 1/K; unfilled, by kinetic theory, +1/293 K", "M")
_NO_ELASTOMER = Source("without an elastomer there is nothing to warm: the blocked force", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Temperature of the elastomer",
    family="elastomer",
    type="static",
    cause="Filled rubber gets softer when warm, rubber without filler stiffer, and a working muscle warms "
    "its wall. The elastic share of the force then drifts over minutes.",
    equation=r"F_{el}(T) = \left[1+\beta\,(T-T_0)\right] F_{el}",
    parameters=(
        Parameter(
            "coefficient",
            r"\beta",
            "1/K",
            default=-0.005,
            lower=-0.015,
            upper=0.01,
            source=_BOTH_SIGNS,
            description="Relative change of the elastomer's modulus per kelvin: negative of filled rubber, "
            "which softens, +1/T of rubber without filler.",
            off=0.0,
        ),
        Parameter(
            "reference_temperature",
            "T_0",
            "K",
            default=293.15,
            lower=273.15,
            upper=313.15,
            source=Source("room temperature", "E"),
            description="Temperature at which the constants of the elastomer hold.",
            fitted=False,
        ),
    ),
    slots={"elastomer_factor": elastomer_factor},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="a slow change of the elastic share of the force alone, following the temperature of the wall",
        direction="even",
        pressure_power=0.0,
        zero_at=("reference_temperature",),
        energy="conservative",
    ),
    confused_with=(
        Twin("creep", "log the temperature; warm the resting muscle without pressure"),
        Twin("mullins", "let the muscle cool: heating returns with work, the first-cycle loss does not"),
        Twin("bladder_elasticity", "the same test at two temperatures"),
        Twin("force_offset", "read the force sensor with the muscle removed, cold and warm"),
    ),
    prior=Prior(0.1, "it needs a change of temperature of tens of kelvin"),
    references=(Source("Andrikopoulos, Nikolakopoulos & Manesis, thermal studies of PAMs (2014-16)", "S2"),),
    examples=(
        Example(
            "force",
            386.31316,
            1e-7,
            _NO_ELASTOMER,
            {"coefficient": 0.0034, "reference_temperature": 293.15},
            _SIZE_10,
            {"length": 0.1, "pressure": 6e5, "temperature": 333.15},
        ),
    ),
)
