r"""The zero of the force sensor drifts while its amplifier warms up, :math:`F_{read} = F + a\,w`.

.. math:: \dot w = \frac{1 - w}{\tau}, \qquad w(0) = 0

The clock starts with the record; with a long time constant the drift is a line.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Reading


def force_sensor(*, warmed: Value, drift: Value) -> Reading:
    """Reading of the sensor: the true force plus a w."""
    return Reading(1.0, drift * warmed)


def rates(*, warmed: Value, time: Value) -> tuple[Value]:
    """dw/dt [1/s]: (1 - w)/tau."""
    return ((1.0 - warmed) / time,)


_RANGE = Source("0.1-2 % of full scale in the first half hour", "E")
_TIME = Source("amplifiers are warm after 5 to 30 minutes", "M")
_DEFINITION = Source("definition, by hand", "D")

EFFECT = Effect(
    title="Force sensor: drift of its zero",
    family="sensor",
    type="measurement",
    cause="A load cell and its amplifier warm up after they are switched on, or the cell creeps under its "
    "load. All forces then drift together, fast at first and slower later.",
    equation=r"F_{read} = F + a\,w,\quad \dot w = \frac{1-w}{\tau}",
    parameters=(
        Parameter(
            *("drift", "a", "N", 10.0, -200.0, 200.0, _RANGE),
            description="Change of the zero from the start of the record to the end of the warming.",
            off=0.0,
        ),
        Parameter(
            *("time", r"\tau", "s", 120.0, 10.0, 1e5, _TIME),
            description="Time constant of the drift.",
            fitted=False,
            natural=True,
        ),
    ),
    slots={"force_sensor": force_sensor, "rates": rates},
    states=(StateVariable("warmed", "w", "1", 1.0, "Share of the drift that has happened."),),
    kinds=frozenset({"isobaric", "isometric", "isotonic", "transient"}),
    signature=Signature(
        text="all forces of a record drift together, whatever length and pressure do",
        direction="even",
        pressure_power=0.0,
        zero_at=(),
        energy="reading",
    ),
    confused_with=(
        Twin(
            "force_thermal", "a test at once after an hour with the amplifier on: warmed up, its zero rests"
        ),
        Twin("creep", "the unloaded cell beside a running test: its reading drifts without a muscle"),
        Twin("self_heating", "the unloaded cell beside a running test: its reading drifts without a muscle"),
        Twin("force_offset", "a repetition of the first minute at the end: a constant zero gives the same"),
    ),
    prior=Prior(0.1, "most amplifiers are on for long, or zeroed before each test"),
    references=(Source("OIML R 60 (2017), creep and warm-up of load cells", "M"),),
    examples=(
        Example(
            *("slot:rates", 2.5e-3, 1e-12, _DEFINITION, {"time": 300.0}, {}),
            {"warmed": 0.25},
        ),
    ),
)
