r"""Self-heating: a muscle that is worked warms its wall, and warm filled rubber is softer.

Every cycle turns a part of its work into heat, so the heat per time grows with the speed. With the warmth w
relative to steady work at :math:`v_r` = 5 % of the rest length per second,

.. math:: F_{el} \to F_{el}\,e^{-a w}, \qquad \tau\,\dot w = |\dot L|/v_r - w, \qquad w(0) = 0

The record is assumed to begin with a cold wall. Where the temperature of the wall is measured, `temperature`
is the direct description; the default here is its default, -0.5 % per kelvin of filled rubber, at 20 K of
warming.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

#: Speed at which the softening is stated, as a share of the rest length per second [1/s].
REFERENCE_RATE = 0.05


def elastomer_factor(*, warmth: Value, softening: Value) -> Value:
    """exp(-a w) [-]; 1 when cold, never negative."""
    return ops.exp(-softening * warmth)


def rates(*, muscle: Muscle, velocity: Value, warmth: Value, time: Value) -> tuple[Value]:
    """dw/dt [1/s]: (|dL/dt|/v_r - w)/tau; cools at rest."""
    reference = REFERENCE_RATE * muscle.nominal_length
    return ((ops.absolute(velocity) / reference - warmth) / time,)


_SOFTENING = Source("10-30 K of warming in fast cycles, 0.3-1 % per kelvin of filled rubber", "E")
_TIME = Source("wall of 1.5-3 mm rubber against air: half a minute to several minutes", "E")
_BY_HAND = Source("definition, by hand", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Self-heating of the wall",
    family="elastomer",
    type="dynamic",
    cause="Each cycle turns a part of its work into heat in the wall and between the threads. The rubber "
    "warms over minutes and gets softer, so the elastic share of the force drifts while the muscle works.",
    equation=r"F_{el} e^{-a w},\quad \tau\,\dot w = \frac{|\dot L|}{v_r}-w,\quad v_r = 0.05\,L_0/\mathrm{s}",
    parameters=(
        Parameter(
            "softening",
            "a",
            "1",
            default=0.1,
            lower=-0.5,
            upper=1.5,
            source=_SOFTENING,
            description="Loss of the elastic force in steady work at 5 % of the rest length per second; "
            "negative for rubber that stiffens when warm.",
            off=0.0,
        ),
        Parameter(
            "time",
            r"\tau",
            "s",
            default=90.0,
            lower=10.0,
            upper=1000.0,
            source=_TIME,
            description="Time in which the wall reaches 63 % of its steady temperature.",
            fitted=False,
        ),
    ),
    slots={"elastomer_factor": elastomer_factor, "rates": rates},
    states=(StateVariable("warmth", "w", "1", 1.0, "Warming relative to steady work at 5 % of L0 per s."),),
    kinds=frozenset({"isobaric", "isotonic", "transient"}),
    signature=Signature(
        text="a drift of the elastic share of the force over minutes of work, which rest takes back",
        direction=None,
        pressure_power=0.0,
        zero_at=("no_motion",),
        energy="lumped",
    ),
    confused_with=(
        Twin("mullins", "let the muscle rest for ten minutes: warming is gone, the first-cycle loss stays"),
        Twin("temperature", "log the temperature of the wall"),
        Twin("creep", "hold the muscle at one length: creep goes on, the warming fades"),
        Twin("bladder_elasticity", "the first cycle alone, with a cold wall"),
    ),
    prior=Prior(0.1, "it needs minutes of fast cycles"),
    references=(Source("Andrikopoulos, Nikolakopoulos & Manesis, thermal studies of PAMs (2014-16)", "S2"),),
    examples=(
        Example(
            "slot:elastomer_factor",
            0.904837418,
            1e-9,
            _BY_HAND,
            {"softening": 0.1},
            {},
            {"warmth": 1.0},
        ),
        Example(
            "slot:rates:0",
            # (0.01/(0.05 * 0.1) - 0.5)/100
            0.015,
            1e-12,
            _BY_HAND,
            {"time": 100.0},
            _SIZE_10,
            {"velocity": -0.01, "warmth": 0.5},
        ),
    ),
)
