r"""Creep and relaxation of the elastomer: three Maxwell arms parallel to the wall, a decade apart in time.

With the extension :math:`d_j` of the spring in arm j from its relaxed length,

.. math:: F = k\,\frac{\sum_j s_j^{-\alpha} d_j}{\sum_j s_j^{-\alpha}}, \qquad
   \dot d_j = \dot L - \frac{d_j}{s_j\tau}, \qquad s_j = \frac{1}{s},\ 1,\ s

Slow motion adds no force, fast motion adds the stiffness k. With a spread s of 10 the force after a step
relaxes nearly with the logarithm of time for :math:`\alpha = 0`, with a power of time for
:math:`\alpha > 0`; a spread of 1 is one arm.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_ARMS = ("fast", "middle", "slow")


def friction(
    *, fast: Value, middle: Value, slow: Value, stiffness: Value, spread: Value, power: Value
) -> Value:
    """Tension of the arms [N]; 0 when they are relaxed."""
    strong, weak = spread**power, spread**-power
    return stiffness * (strong * fast + middle + weak * slow) / (strong + 1.0 + weak)


def rates(
    *, velocity: Value, fast: Value, middle: Value, slow: Value, time: Value, spread: Value
) -> tuple[Value, ...]:
    """d/dt of the extensions [m/s]: v - d/tau."""
    return (velocity - fast * spread / time, velocity - middle / time, velocity - slow / (spread * time))


_FESTO = Source("relaxation of at most 3-4 % of the force in catalogues", "M")
_TIMES = Source("arms of 0.3, 3 and 30 s cover a hold of a minute", "E")
_DEFINITION = Source("definition, by hand", "D")

EFFECT = Effect(
    title="Creep and relaxation",
    family="elastomer",
    type="dynamic",
    cause="Rubber relaxes slowly after it is stretched. At a constant length the force drifts; under a "
    "constant load and pressure the muscle keeps shortening for seconds to minutes.",
    equation=r"F_{ve} = k\,\frac{\sum_j s_j^{-\alpha} d_j}{\sum_j s_j^{-\alpha}},\quad "
    r"\dot d_j = \dot L-\frac{d_j}{s_j\tau},\quad s_j = \frac{1}{s},\,1,\,s",
    parameters=(
        Parameter(
            "stiffness",
            "k",
            "N/m",
            default=500.0,
            lower=0.0,
            upper=2.0e4,
            source=Source("5-25 % of the bladder's stiffness; 3 % of that of a size 20 at 6 bar", "E"),
            description="Total stiffness that the three arms add to a fast motion.",
            off=0.0,
        ),
        Parameter(
            "time",
            r"\tau",
            "s",
            default=3.0,
            lower=0.3,
            upper=100.0,
            source=_TIMES,
            description="Time constant of the middle arm.",
            fitted=False,
        ),
        Parameter(
            "spread",
            "s",
            "1",
            default=10.0,
            lower=1.0,
            upper=30.0,
            source=_TIMES,
            description="Ratio of the times of neighbouring arms; 1 is a single arm.",
            fitted=False,
            natural=True,
        ),
        Parameter(
            "power",
            r"\alpha",
            "1",
            default=0.0,
            lower=-0.3,
            upper=0.8,
            source=Source(
                "relaxation of filled rubber with a power of time, exponents from about 0.01 to a few 0.1",
                "E",
            ),
            description="Weights the faster arms more: each weight is its time to the power -alpha.",
            fitted=False,
        ),
    ),
    slots={"friction": friction, "rates": rates},
    states=tuple(
        StateVariable(name, f"d_{index}", "m", 0.01, f"Extension of the {name} arm's spring.")
        for index, name in enumerate(_ARMS, start=1)
    ),
    kinds=frozenset({"isobaric", "isotonic", "transient"}),
    signature=Signature(
        text="a drift after every motion, with the sign of the last motion, nearly with the log of time",
        direction="odd",
        pressure_power=0.0,
        zero_at=("no_motion",),
        energy="dissipative",
    ),
    confused_with=(
        Twin("leak", "log the pressure: it falls with a leak and stays with creep"),
        Twin("heat_exchange", "log the pressure: it changes with the gas temperature and stays with creep"),
        Twin("mullins", "wait and repeat: creep recovers, the first-cycle loss does not"),
        Twin("temperature", "a hold after a single motion: only creep drifts"),
        Twin("coulomb_friction", "very slow loops: creep vanishes, Coulomb friction stays"),
    ),
    prior=Prior(0.4, "every rubber relaxes when it is held"),
    references=(_FESTO, Source("Minh et al., creep of pneumatic artificial muscles (2010-2012)", "M")),
    examples=(
        Example(
            "slot:friction",
            6.0,
            1e-12,
            _DEFINITION,
            {"stiffness": 600.0},
            {},
            {"fast": 0.005, "middle": 0.01, "slow": 0.015},
        ),
        Example(
            # -0.02 - 0.01/0.3
            "slot:rates",
            -0.05333333333333334,
            1e-12,
            _DEFINITION,
            {"time": 3.0},
            {},
            {"velocity": -0.02, "fast": 0.01},
        ),
    ),
)
