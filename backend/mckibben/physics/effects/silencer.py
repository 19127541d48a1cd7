r"""Silencer behind the exhaust, with air of its own: back pressure that rises while the muscle is vented.

The valve exhausts into the volume V of silencer, manifold or exhaust line, at a pressure e above ambient, and
a restriction of conductance C_s lets it out,

.. math:: \dot e = \frac{R_g T}{V}\bigl(\dot m_{ex} - \dot m(p_a + e,\,p_a,\,C_s)\bigr),\quad
   C_s = \frac{f}{\sqrt{1-f^2}}\,C_{ex}

f is the conductance of the open valve with its silencer over that without, after :math:`1/C^2 = \sum 1/C_i^2`
of restrictions in series. A valve that is hardly open feels little of it. Air in the silencer has ambient
temperature.
"""

from mckibben.physics import gas, ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_OPEN = 0.9999  # factor from which on there is no silencer
_CRITICAL_RATIO = 0.3


def exhaust_sink(*, sink_pressure: Value, excess: Value, factor: Value) -> Value:
    """p_a + e [Pa]; ambient pressure itself without a silencer."""
    return sink_pressure + ops.where(ops.greater(_OPEN, factor), excess, 0.0)


def drive_rates(
    *,
    exhaust_flow: Value,
    exhaust_conductance: Value,
    ambient_pressure: Value,
    excess: Value,
    factor: Value,
    volume: Value,
) -> tuple[Value]:
    """de/dt [Pa/s]; steady where the silencer lets out what the valve exhausts."""
    share = ops.minimum(factor, _OPEN)
    let_out = gas.mass_flow(
        pressure_from=ambient_pressure + excess,
        pressure_to=ambient_pressure,
        temperature_from=gas.ANR_TEMPERATURE,
        temperature_to=gas.ANR_TEMPERATURE,
        conductance=exhaust_conductance * share / ops.sqrt(1.0 - share**2),
        critical_ratio=_CRITICAL_RATIO,
    )
    acts = ops.where(ops.greater(_OPEN, factor), 1.0, 0.0)
    return (acts * gas.GAS_CONSTANT * gas.ANR_TEMPERATURE / volume * (exhaust_flow - let_out),)


_RANGE = Source("silencers and shared exhaust lines 0.5-1 of the valve, clogged ones less", "E")
_VOLUME = Source("silencers 1-20 ml, exhaust manifolds and lines to 0.2 l", "E")
_BY_HAND = Source("choked: 287.05 * 293.15/1e-5 * (2e-3 - 1e-8 * 0.6/0.8 * 1.185 * 4e5)", "D")

EFFECT = Effect(
    title="Silencer with a volume",
    family="valve",
    type="dynamic",
    cause="The valve exhausts into a silencer, a manifold or a line of some volume. Venting begins at full "
    "flow and slows down as the pressure behind the valve rises.",
    equation=r"\dot e = \frac{R_g T}{V}\bigl(\dot m_{ex}-\dot m(p_a+e,\,p_a,\,C_s)\bigr),\quad "
    r"C_s = \frac{f\,C_{ex}}{\sqrt{1-f^2}}",
    parameters=(
        Parameter(
            "factor",
            "f",
            "1",
            default=0.7,
            lower=0.05,
            upper=1.0,
            source=_RANGE,
            description="Conductance of the open valve with the silencer over that without.",
            off=1.0,
        ),
        Parameter(
            "volume",
            "V",
            "m3",
            default=1e-5,
            lower=1e-7,
            upper=1e-3,
            source=_VOLUME,
            description="Volume between the valve and the restriction of the silencer.",
        ),
    ),
    slots={"exhaust_sink": exhaust_sink, "drive_rates": drive_rates},
    states=(StateVariable("excess", "e", "Pa", 5e4, "Pressure behind the exhaust above ambient."),),
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="short ventings are faster than long ones; filling is unchanged",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="dissipative",
    ),
    confused_with=(
        Twin("exhaust_restriction", "short and long ventings: a plain restriction slows both by one factor"),
        Twin("flow_coefficient", "filling and venting: a silencer slows venting alone"),
        Twin("tube_resistance", "filling and venting: a tube slows both"),
    ),
    prior=Prior(0.15, "silencers and shared exhaust lines hold air between valve and outside"),
    references=(Source("mass balance of a volume between two restrictions", "D"),),
    examples=(
        Example(
            "slot:exhaust_sink",
            1.5e5,
            1e-12,
            _BY_HAND,
            {"factor": 0.6},
            {},
            {"sink_pressure": 1e5, "excess": 5e4},
        ),
        Example(
            "slot:drive_rates",
            287.05 * 293.15 / 1e-5 * (2e-3 - 0.75e-8 * 1.185 * 4e5),
            1e-9,
            _BY_HAND,
            {"factor": 0.6, "volume": 1e-5},
            {},
            {
                "exhaust_flow": 2e-3,
                "exhaust_conductance": 1e-8,
                "ambient_pressure": 1e5,
                "excess": 3e5,
            },
        ),
    ),
)
