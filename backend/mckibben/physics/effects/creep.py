r"""Creep and relaxation of the elastomer: three Maxwell arms, a decade apart in time, beside the wall.

With the extension :math:`d_j` of the spring in arm j, counted from when it was last relaxed,

.. math:: F = \frac{k}{3}\sum_{j=1}^3 d_j, \qquad \dot d_j = \dot L - \frac{d_j}{\tau_j},
   \quad \tau_j = \frac{\tau}{10},\ \tau,\ 10\,\tau

Slow motion adds nothing, fast motion the stiffness k; three decades make a step relax nearly with log time.
"""

from mckibben.physics.effect import Effect, Example, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

# Names of the arms and their times over the middle one.
_ARMS = {"fast": 0.1, "middle": 1.0, "slow": 10.0}


def friction(*, fast: Value, middle: Value, slow: Value, stiffness: Value) -> Value:
    """Tension k (d1 + d2 + d3)/3 of the arms [N]; 0 when they are relaxed."""
    return stiffness * (fast + middle + slow) / 3.0


def rates(*, velocity: Value, fast: Value, middle: Value, slow: Value, time: Value) -> tuple[Value, ...]:
    """d/dt of the extensions [m/s]: v - d/tau."""
    return tuple(
        velocity - extension / (share * time)
        for extension, share in zip((fast, middle, slow), _ARMS.values(), strict=True)
    )


_FESTO = Source("relaxation of at most 3-4 % of the force in catalogues", "M")
_TIMES = Source("arms of 0.3, 3 and 30 s cover a hold of a minute", "E")
_DEFINITION = Source("definition, by hand", "D")

EFFECT = Effect(
    title="Creep and relaxation",
    family="elastomer",
    type="dynamic",
    cause="Rubber flows back slowly after it was stretched. Held at a length the force drifts, and under a "
    "constant load and pressure the muscle goes on shortening for seconds to minutes.",
    equation=r"F_{ve} = \frac{k}{3}\sum_j d_j,\quad \dot d_j = \dot L-\frac{d_j}{\tau_j},\quad "
    r"\tau_j = \frac{\tau}{10},\,\tau,\,10\,\tau",
    parameters=(
        Parameter(
            "stiffness",
            "k",
            "N/m",
            500.0,
            0.0,
            2.0e4,
            Source("5-25 % of the bladder's stiffness; 3 % of that of a size 20 at 6 bar", "E"),
            "Stiffness that the three arms add to a fast motion, together.",
            off=0.0,
        ),
        Parameter(
            "time",
            r"\tau",
            "s",
            3.0,
            0.3,
            100.0,
            _TIMES,
            "Time constant of the middle arm; the others are a tenth and ten times of it.",
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
