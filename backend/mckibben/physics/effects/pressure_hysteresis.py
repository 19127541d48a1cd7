r"""Hysteresis driven by pressure: the force on filling is lower than on venting, even at constant length.

.. math:: F = -F_p\,z, \qquad \dot z = \frac{\dot P - |\dot P|\,z}{P_b}

Friction that follows the length alone has exactly no loop at constant length; real muscles show one, because
threads micro-slip when the pressure strains them and presses them together.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def friction(*, filling: Value, force: Value) -> Value:
    """-F_p z [N], within +-F_p: negative on filling."""
    return -force * filling


def rates(*, pressure_rate: Value, filling: Value, break_pressure: Value) -> tuple[Value]:
    """dz/dt [1/s]: (dP/dt - |dP/dt| z)/P_b; exactly 0 at constant pressure."""
    return ((pressure_rate - ops.absolute(pressure_rate) * filling) / break_pressure,)


_LOOP = Source(
    "hysteresis of at most 2.5-3 % of the force in catalogues, a part of it at constant length", "E"
)
_WAY = Source("a tenth of the working pressure", "E")
_DEFINITION = Source("definition, by hand", "D")

EFFECT = Effect(
    title="Pressure-driven hysteresis",
    family="friction",
    type="hysteretic",
    cause="The pressure strains the threads and presses them together, so that they slip a little even when "
    "the length is held. The force on filling is then lower than on venting at the same pressure.",
    equation=r"F_{h} = -F_p\,z,\quad \dot z = \frac{\dot P-|\dot P|\,z}{P_b}",
    parameters=(
        Parameter(
            "force", "F_p", "N", 5.0, 0.0, 100.0, _LOOP, "Half the width of the pressure loop.", off=0.0
        ),
        Parameter(
            "break_pressure",
            "P_b",
            "Pa",
            3.0e4,
            1.0e3,
            3.0e5,
            _WAY,
            "Change of pressure over which the loop opens after a reversal.",
            fitted=False,
        ),
    ),
    slots={"friction": friction, "rates": rates},
    states=(StateVariable("filling", "z", "1", 1.0, "Share of the full loop, positive on filling."),),
    kinds=frozenset({"isometric", "isotonic", "transient"}),
    signature=Signature(
        text="a loop of force over pressure at constant length, nothing at constant pressure",
        direction="odd",
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin("coulomb_friction", "a pressure loop at constant length: only the pressure-driven one shows"),
        Twin("pressure_friction", "a length loop at constant pressure: only friction shows"),
        Twin("sensor_lag", "two rates of the pressure ramp: a lag widens the loop, hysteresis does not"),
        Twin("time_skew", "two rates of the pressure ramp: a skew widens the loop, hysteresis does not"),
    ),
    references=(
        Source("Minh et al., IEEE/ASME AIM (2010), isometric force-pressure loops", "M"),
        Source("Lin, Lin, Yu & Chen, Control Eng. Pract. 40 (2015) 35", "M"),
    ),
    examples=(
        Example("slot:friction", -3.0, 1e-12, _DEFINITION, {"force": 5.0}, {}, {"filling": 0.6}),
        Example(
            "slot:rates",
            # (-1e5 - 1e5 * 0.5) Pa/s / 0.3 bar
            -5.0,
            1e-12,
            _DEFINITION,
            {"break_pressure": 3e4},
            {},
            {"pressure_rate": -1e5, "filling": 0.5},
        ),
    ),
)
