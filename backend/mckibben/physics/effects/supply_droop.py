r"""Droop of the supply: its pressure falls with the flow drawn, and recovers.

With the drop d below the nominal supply pressure, the flow :math:`q = \dot m/\rho_0` and :math:`d_1` = 1 bar

.. math:: p_s = p_{s,0} - d, \qquad \tau\,\dot d = R\,q - d\left(\frac{d}{d_1}\right)^{m-1}

R is the droop per flow at a drop of 1 bar. The refilling flow is linear in the drop (m = 1) for a pressure
regulator, and goes with its square root (m = 0.5) for an orifice or a long line. A reservoir of volume
:math:`V_r = \tau R_g T\rho_0/R` (:math:`\tau p_0/R`, 2.5 l with the defaults) slows it down.
"""

from mckibben.physics import gas, ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_REFERENCE = 1e5  # Pa
_ROUNDING = 0.01


def supply(*, supply_pressure: Value, drop: Value, droop: Value) -> Value:
    """p_s - d [Pa]."""
    # The state acts only with a droop, so that a supply without one is exactly unchanged.
    return supply_pressure - ops.where(ops.greater(droop, 0.0), drop, 0.0)


def drive_rates(
    *, supply_flow: Value, drop: Value, droop: Value, time: Value, exponent: Value
) -> tuple[Value]:
    """dd/dt [Pa/s]; steady at the droop times the flow where m is 1, back to 0 without flow."""
    bars = drop / _REFERENCE
    # |d| is rounded below 1 kPa, where the slope of a root would be infinite.
    refilled = drop * ops.exp(0.5 * (exponent - 1.0) * ops.log(bars**2 + _ROUNDING**2))
    return ((droop * supply_flow / gas.ANR_DENSITY - refilled) / time,)


_DROOP = Source("0.02-0.5 bar per l/s for small regulators", "E")
_RESERVOIR = Source("reservoirs of 0.1-20 l behind the regulator", "E")
_BY_HAND = Source("(2e7 * 1.185e-3/1.185 - 5e3)/0.5", "D")

EFFECT = Effect(
    title="Droop of the supply",
    family="supply",
    type="dynamic",
    cause="The pressure regulator and the line before the valve pass a limited flow. While the muscle fills, "
    "the supply pressure falls and recovers slowly.",
    equation=r"p_s = p_{s,0}-d,\quad "
    r"\tau\,\dot d = R\,\frac{\dot m}{\rho_0}-d\left(\frac{d}{d_1}\right)^{m-1}",
    parameters=(
        Parameter(
            "droop",
            "R",
            "Pa*s/m3",
            default=2.0e7,
            lower=0.0,
            upper=2.0e8,
            source=_DROOP,
            description="Loss of supply pressure per standard flow; 0.1 bar per l/s is 1e7 Pa s/m3.",
            off=0.0,
        ),
        Parameter(
            "time",
            r"\tau",
            "s",
            default=0.5,
            lower=0.01,
            upper=20.0,
            source=_RESERVOIR,
            description="Time in which the supply falls and recovers.",
            fitted=False,
        ),
        Parameter(
            "exponent",
            "m",
            "1",
            default=1.0,
            lower=0.5,
            upper=1.0,
            source=Source("flow over a pressure drop: laminar or regulated 1, turbulent 0.5", "D"),
            description="Exponent of the refilling flow over the drop: 1 for a regulator, 0.5 for an orifice "
            "or a long line.",
            fitted=False,
            natural=True,
        ),
    ),
    slots={"supply": supply, "drive_rates": drive_rates},
    states=(StateVariable("drop", "d", "Pa", 1e4, "Supply pressure below its nominal value."),),
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="slower filling, the more so with volume and repetition; venting unchanged",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="dissipative",
    ),
    confused_with=(
        Twin("flow_coefficient", "log the supply pressure"),
        Twin("exhaust_restriction", "filling and venting: a droop slows filling alone"),
    ),
    prior=Prior(0.25, "small regulators and lines let the supply fall while they deliver"),
    references=(Source("mass balance of a reservoir behind a regulator", "D"),),
    examples=(
        Example(
            "slot:supply", 6.9e5, 1e-12, _BY_HAND, {"droop": 2e7}, {}, {"supply_pressure": 7e5, "drop": 1e4}
        ),
        Example(
            "slot:drive_rates",
            3e4,
            1e-9,
            _BY_HAND,
            {"droop": 2e7, "time": 0.5},
            {},
            {"supply_flow": 1.185e-3, "drop": 5e3},
        ),
        Example(
            # (2e7 * 4e-3 - 1e5 sqrt(0.25))/0.5
            "slot:drive_rates",
            6e4,
            1e-3,
            _BY_HAND,
            {"droop": 2e7, "time": 0.5, "exponent": 0.5},
            {},
            {"supply_flow": 4.74e-3, "drop": 2.5e4},
        ),
    ),
)
