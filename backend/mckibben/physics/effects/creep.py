r"""Creep and relaxation: arms of the elastomer that relax, and a pressed braid that goes on settling.

Five Maxwell arms parallel to the wall have times that are a factor s apart. With the travel x since the
beginning, at rest, and the extension :math:`d_j` of the spring in arm j,

.. math:: F = k\,\bar d - c\,K\,(x - \bar d), \qquad \dot x = \dot L, \qquad
   \dot d_j = \dot L - \frac{d_j}{s_j\tau}, \qquad s_j = s^{-2},\ \dots,\ s^{2}

with the mean :math:`\bar d` weighted by :math:`s_j^{-\alpha}` and the stiffness of the pressed braid
:math:`K = 3 L P/(2\pi n^2)`.
The arms resist a fast motion with the stiffness k, a slow one not at all: the model without creep is where
they lead to. A braid that settles begins there and goes on as its last motion went, as if the muscle were
longer by c times what it has settled: under a constant load by the share c of the motion, at every pressure.
With s = 3 both are nearly logarithmic in time, powers of it for :math:`\alpha > 0`; s = 1 is one arm.
"""

from mckibben.physics import ideal, ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_ARMS = ("fastest", "fast", "middle", "slow", "slowest")
_PLACES = (2.0, 1.0, 0.0, -1.0, -2.0)  # powers of the spread in the rates of the arms


def friction(
    *,
    muscle: Muscle,
    length: Value,
    pressure: Value,
    fastest: Value,
    fast: Value,
    middle: Value,
    slow: Value,
    slowest: Value,
    travel: Value,
    stiffness: Value,
    share: Value,
    spread: Value,
    power: Value,
) -> Value:
    """Tension of the arms less what the settled braid has lost [N]; 0 at rest from the beginning."""
    pressed = ideal.stiffness(braid=muscle.braid, length=length, pressure=ops.positive_part(pressure))
    arms = fastest, fast, middle, slow, slowest
    weights = [spread ** (power * at) for at in _PLACES]
    mean = sum(weight * arm for weight, arm in zip(weights, arms, strict=True)) / sum(weights)
    return stiffness * mean + share * pressed * (mean - travel)


def rates(
    *,
    velocity: Value,
    fastest: Value,
    fast: Value,
    middle: Value,
    slow: Value,
    slowest: Value,
    time: Value,
    spread: Value,
) -> tuple[Value, ...]:
    """d/dt of the extensions [m/s], v - d/tau, and of the travel."""
    arms = fastest, fast, middle, slow, slowest
    return (*(velocity - arm * spread**at / time for arm, at in zip(arms, _PLACES, strict=True)), velocity)


_FESTO = Source("relaxation of at most 3-4 % of the force in catalogues", "M")
_TIMES = Source("arms from 0.3 to 30 s cover a hold of a minute", "E")
_STIFFNESS = Source("5-25 % of the bladder's stiffness; 3 % of that of a size 20 at 6 bar", "E")
_LATE = Source("isotonic creep of a few to 20 % of the contraction within minutes", "E")
_POWER = Source("relaxation of filled rubber with a power of time, exponents of 0.01 to a few 0.1", "E")
_DEFINITION = Source("definition, by hand", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}

_STATES = {arm: (f"d_{j}", f"Extension of the {arm} arm.") for j, arm in enumerate(_ARMS, start=1)}
_STATES["travel"] = ("x", "Change of the length since the beginning.")
_EXTENDED = dict(zip(_ARMS, (0.0, 0.005, 0.01, 0.015, 0.02), strict=True))

EFFECT = Effect(
    title="Creep and relaxation",
    family="elastomer",
    type="dynamic",
    cause="Rubber relaxes slowly after it is stretched, and threads go on settling under pressure. At a "
    "constant length the force drifts; under a constant load the muscle keeps moving for seconds to minutes.",
    equation=r"F_{ve} = k\,\bar d - c\,K\,(x-\bar d),\quad "
    r"\bar d = \frac{\sum_j s_j^{-\alpha} d_j}{\sum_j s_j^{-\alpha}},\quad \dot x = \dot L,\quad "
    r"\dot d_j = \dot L-\frac{d_j}{s_j\tau},\quad s_j = s^{-2},\dots,s^{2}",
    parameters=(
        Parameter(
            *("stiffness", "k", "N/m"),
            default=500.0,
            lower=0.0,
            upper=2.0e4,
            source=_STIFFNESS,
            description="Total stiffness that the arms add to a fast motion.",
            off=0.0,
        ),
        Parameter(
            *("share", "c", "1"),
            default=0.0,
            lower=0.0,
            upper=0.5,
            source=_LATE,
            description="Share of a motion under a constant load that follows late, beyond the rest.",
            off=0.0,
        ),
        Parameter(
            *("time", r"\tau", "s"),
            default=3.0,
            lower=0.3,
            upper=1000.0,
            source=_TIMES,
            description="Time constant of the middle arm.",
            fitted=False,
        ),
        Parameter(
            *("spread", "s", "1"),
            default=10.0**0.5,
            lower=1.0,
            upper=6.0,
            source=_TIMES,
            description="Ratio of the times of neighbouring arms; 1 is a single arm.",
            fitted=False,
            natural=True,
        ),
        Parameter(
            *("power", r"\alpha", "1"),
            default=0.0,
            lower=-0.3,
            upper=0.8,
            source=_POWER,
            description="Weights the faster arms more: each weight is its time to the power −α.",
            fitted=False,
        ),
    ),
    slots={"friction": friction, "rates": rates},
    states=tuple(
        StateVariable(n, sign, "m", 0.01, what, applied="stroke") for n, (sign, what) in _STATES.items()
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
        Twin("coulomb_friction", "very slow loops: creep vanishes, Coulomb friction stays"),
    ),
    prior=Prior(0.4, "every rubber relaxes when it is held"),
    references=(_FESTO, Source("Minh et al., creep of pneumatic artificial muscles (2010-2012)", "M")),
    examples=(
        Example(
            # K = 3 0.3 m 2 bar/(2 pi n^2) with n = 0.3 tan 25°/(pi 0.02) = 2.2264551 is 5779.161 N/m;
            # 600 N/m 10 mm, less 0.05 K (20 - 10) mm
            *("slot:friction", 3.1104196685502865, 1e-12, _DEFINITION),
            {"stiffness": 600.0, "share": 0.05},
            _SIZE_20,
            {"length": 0.3, "pressure": 2e5, **_EXTENDED, "travel": 0.02},
        ),
        Example(  # -0.02 - 0.01 1.5^2/3
            *("slot:rates", -0.0275, 1e-12, _DEFINITION),
            *({"time": 3.0, "spread": 1.5}, {}, {"velocity": -0.02, "fastest": 0.01}),
        ),
    ),
)
