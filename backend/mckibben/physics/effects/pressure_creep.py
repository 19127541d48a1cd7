r"""Creep after a change of pressure: at a fixed length the force drifts towards its final value.

With the pressure :math:`d_j` that arm j has not yet followed and the effective area A of the ideal braid,

.. math:: F = -c\,A(L)_+\,\frac13\sum_j d_j, \qquad \dot d_j = \dot P - \frac{d_j}{s_j\tau},
   \qquad s_j = \frac1s,\ 1,\ s

A step of the pressure shows the share c late, over times that are a factor s apart; c < 0 is a force that
overshoots and relaxes. Slow changes show nothing.
"""

from mckibben.physics import ideal, ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_ARMS = ("fast", "middle", "slow")


def friction(
    *, muscle: Muscle, length: Value, share: Value, fast: Value, middle: Value, slow: Value
) -> Value:
    """-c A(L) times the mean of d_j [N]; 0 once the pressure has rested, and beyond the zero-force length."""
    area = ops.positive_part(ideal.area(braid=muscle.braid, length=length))
    return -share * area * (fast + middle + slow) / 3.0


def rates(
    *, pressure_rate: Value, fast: Value, middle: Value, slow: Value, time: Value, spread: Value
) -> tuple[Value, ...]:
    """d/dt of the pressures that are not yet followed [Pa/s]: dP/dt - d/(s_j tau)."""
    return (
        pressure_rate - fast * spread / time,
        pressure_rate - middle / time,
        pressure_rate - slow / (spread * time),
    )


_FESTO = Source("relaxation of at most 3-4 % of the force in catalogues", "M")
_TIMES = Source("arms of 0.3, 3 and 30 s cover a hold of a minute", "E")
_DEFINITION = Source("definition, by hand", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Creep after a change of pressure",
    family="elastomer",
    type="dynamic",
    cause="The bladder and the threads settle slowly under a new pressure. At a fixed length the force goes "
    "on changing for seconds to minutes after the pressure has come to rest.",
    equation=r"F_{pc} = -c\,A_+\,\frac13\sum_j d_j,\quad \dot d_j = \dot P-\frac{d_j}{s_j\tau},\quad "
    r"s_j = \frac{1}{s},\,1,\,s",
    parameters=(
        Parameter(
            "share",
            "c",
            "1",
            default=0.03,
            lower=-0.3,
            upper=0.3,
            source=_FESTO,
            description="Share of a change of force that comes late; negative where the force overshoots.",
            off=0.0,
        ),
        Parameter(
            "time",
            r"\tau",
            "s",
            default=3.0,
            lower=0.3,
            upper=1000.0,
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
    ),
    slots={"friction": friction, "rates": rates},
    states=tuple(
        StateVariable(
            *(name, f"d_{index}", "Pa", 1e5, f"Pressure that the {name} arm has not yet followed."),
            applied="pressure",
        )
        for index, name in enumerate(_ARMS, start=1)
    ),
    kinds=frozenset({"isometric", "isotonic", "transient"}),
    signature=Signature(
        text="a drift of the force after every change of pressure, with the sign of that change",
        direction="odd",
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin("pressure_hysteresis", "hold the pressure: creep goes on, hysteresis stays"),
        Twin("sensor_lag", "ramps at two rates a decade apart: a lag has one short time, creep has many"),
        Twin("creep", "change the length at constant pressure: only the creep of the wall shows"),
        Twin("time_skew", "ramps at two rates: a skew grows with the rate, creep hardly"),
    ),
    prior=Prior(0.2, "rubber under a new pressure settles slowly"),
    references=(_FESTO, Source("Minh et al., creep of pneumatic artificial muscles (2010-2012)", "M")),
    examples=(
        Example(
            # A = pi 0.02^2/4 (3/tan^2 25° - 1/sin^2 25°) = 2.57542107e-3 m2, times 0.05 and 0.2 bar
            "slot:friction",
            -2.5754210660907333,
            1e-9,
            _DEFINITION,
            {"share": 0.05},
            _SIZE_20,
            {"length": 0.3, "fast": 1e4, "middle": 2e4, "slow": 3e4},
        ),
        Example(
            # 1e5 - 3e4/0.3
            "slot:rates",
            0.0,
            1e-9,
            _DEFINITION,
            {"time": 3.0},
            {},
            {"pressure_rate": 1e5, "fast": 3e4},
        ),
    ),
)
