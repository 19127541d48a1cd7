r"""Leak from the muscle to the atmosphere, a restriction after ISO 6358.

.. math:: \dot m_l = C_l\,\rho_0\,p\sqrt{T_0/T}\;\psi(p_a/p)

Choked, the pressure of a closed muscle falls exponentially with :math:`V/(C_l p_0)`. Below the atmosphere the
flow turns round.
"""

from mckibben.physics import gas
from mckibben.physics.effect import Effect, Example, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def leak(
    *,
    absolute_pressure: Value,
    ambient_pressure: Value,
    gas_temperature: Value,
    conductance: Value,
    critical_ratio: Value,
) -> Value:
    """Mass flow out of the muscle [kg/s]; 0 at equal pressures, negative below the atmosphere."""
    return gas.mass_flow(
        pressure_from=absolute_pressure,
        pressure_to=ambient_pressure,
        temperature_from=gas_temperature,
        temperature_to=gas_temperature,
        conductance=conductance,
        critical_ratio=critical_ratio,
    )


_RANGE = Source("1e-6 to 1e-3 l/(s bar) moulded, to 1e-2 hand-made", "E")
_BY_HAND = Source("choked: 1e-12 * 1.185 * 7e5", "D")

EFFECT = Effect(
    title="Leak",
    family="gas",
    type="dynamic",
    cause="Air escapes through fittings, clamps and the wall itself. A closed muscle loses its pressure "
    "slowly, and a pressure controller has to keep feeding it.",
    equation=r"\dot m_l = C_l\,\rho_0\,p\sqrt{T_0/T}\;\psi(p_a/p)",
    parameters=(
        Parameter(
            "conductance",
            "C_l",
            "m3/(s*Pa)",
            1.0e-12,
            0.0,
            1.0e-9,
            _RANGE,
            "Sonic conductance of the leak; 1 l/(s bar) is 1e-8 m3/(s Pa).",
            off=0.0,
        ),
        Parameter(
            "critical_ratio",
            "b_l",
            "1",
            0.3,
            0.05,
            0.6,
            Source("small orifices 0.2-0.5", "E"),
            "Critical pressure ratio of the leak.",
            fitted=False,
        ),
    ),
    slots={"leakage": leak},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="pressure falls slowly and without end while the valve is closed",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="dissipative",
    ),
    confused_with=(
        Twin("heat_exchange", "close the valve and wait: heat exchange ends at an asymptote, a leak goes on"),
        Twin("creep", "log the pressure: it falls with a leak and stays with creep"),
        Twin("valve_deadband", "close off the muscle by a tap instead of the valve"),
    ),
    references=(Source("ISO 6358", "M"),),
    examples=(
        Example(
            "slot:leakage",
            8.295e-7,
            1e-9,
            _BY_HAND,
            {"conductance": 1e-12, "critical_ratio": 0.3},
            {},
            {"absolute_pressure": 7e5, "ambient_pressure": 1e5, "gas_temperature": 293.15},
        ),
    ),
)
