r"""Leak from the muscle to the atmosphere: an orifice after ISO 6358, a laminar gap, or a mixture of both.

.. math:: \dot m_l = C_l\,\rho_0\Bigl[(1-\lambda)\,p\sqrt{T_0/T}\;\psi(p_a/p)
   + \lambda\,\frac{T_0}{T}\,\frac{p^2-p_a^2}{p_r}\Bigr], \quad p_r = 3.75\,bar

Choked, the pressure of a closed muscle falls exponentially with :math:`V/(C_l p_0)`; through a gap it falls
faster when it is high and slower when it is low (isothermal flow of constant viscosity).
With :math:`p_r` both laws pass the same at 20 degC from 4 to 1 bar (absolute), where an orifice of
:math:`b_l \ge 0.25` is choked. Below atmospheric pressure the flow reverses.
"""

from mckibben.physics import gas
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

# (p1^2 - p2^2)/p1 from 4 to 1 bar absolute [Pa]: there a laminar leak passes as much as a choked one.
REFERENCE_PRESSURE = 3.75e5


def leak(
    *,
    absolute_pressure: Value,
    ambient_pressure: Value,
    gas_temperature: Value,
    conductance: Value,
    critical_ratio: Value,
    laminar_share: Value,
) -> Value:
    """Mass flow out of the muscle [kg/s]; 0 at equal pressures, negative below the atmosphere."""
    orifice = gas.mass_flow(
        pressure_from=absolute_pressure,
        pressure_to=ambient_pressure,
        temperature_from=gas_temperature,
        temperature_to=gas_temperature,
        conductance=conductance,
        critical_ratio=critical_ratio,
    )
    squares = (absolute_pressure**2 - ambient_pressure**2) / REFERENCE_PRESSURE
    gap = conductance * gas.ANR_DENSITY * gas.ANR_TEMPERATURE / gas_temperature * squares
    return (1.0 - laminar_share) * orifice + laminar_share * gap


_RANGE = Source("1e-6 to 1e-3 l/(s bar) moulded, to 1e-2 hand-made", "E")
_POISEUILLE = Source("Hagen-Poiseuille flow of a gas at constant temperature, (p1^2 - p2^2)", "M")
_BY_HAND = Source("choked: 1e-12 * 1.185 * 7e5", "D")
_SHARED_BY_HAND = Source("half of 1e-12 * 1.185 * (7e5 + 48e10/3.75e5)", "D")
_SEVEN_BAR = {"absolute_pressure": 7e5, "ambient_pressure": 1e5, "gas_temperature": 293.15}

EFFECT = Effect(
    title="Leak",
    family="gas",
    type="dynamic",
    cause="Air escapes through fittings, clamps and the wall itself. A closed muscle loses its pressure "
    "slowly, and a pressure controller has to keep feeding it.",
    equation=r"\dot m_l = C_l\,\rho_0\left[(1-\lambda)\,p\sqrt{\frac{T_0}{T}}\;\psi\left(\frac{p_a}{p}\right)"
    r" + \lambda\,\frac{T_0}{T}\,\frac{p^2-p_a^2}{p_r}\right],\quad p_r = 3.75\,\mathrm{bar}",
    parameters=(
        Parameter(
            "conductance",
            "C_l",
            "m3/(s*Pa)",
            default=1.0e-12,
            lower=0.0,
            upper=1.0e-9,
            source=_RANGE,
            description="Sonic conductance of the leak; 1 l/(s bar) is 1e-8 m3/(s Pa).",
            off=0.0,
        ),
        Parameter(
            "critical_ratio",
            "b_l",
            "1",
            default=0.3,
            lower=0.05,
            upper=0.6,
            source=Source("small orifices 0.2-0.5", "E"),
            description="Critical pressure ratio of the leak.",
            fitted=False,
        ),
        Parameter(
            "laminar_share",
            r"\lambda",
            "1",
            default=0.0,
            lower=0.0,
            upper=1.0,
            source=Source("0 for a hole, 1 for long narrow gaps and porous walls", "E"),
            description="Share of the flow that is laminar, in proportion to p^2 - p_a^2; at 3 bar above "
            "the atmosphere it makes no difference.",
            fitted=False,
            natural=True,
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
        Twin(
            "heat_exchange", "close the valve and wait: heat exchange ends at an asymptote, a leak continues"
        ),
        Twin("creep", "log the pressure: it falls with a leak and stays with creep"),
        Twin("valve_deadband", "close off the muscle by a tap instead of the valve"),
    ),
    prior=Prior(0.15, "tight fittings are the rule"),
    references=(Source("ISO 6358", "M"), _POISEUILLE),
    examples=(
        Example(
            "slot:leakage",
            8.295e-7,
            1e-9,
            _BY_HAND,
            {"conductance": 1e-12, "critical_ratio": 0.3},
            {},
            _SEVEN_BAR,
        ),
        Example(
            "slot:leakage",
            1.17315e-6,
            1e-9,
            _SHARED_BY_HAND,
            {"conductance": 1e-12, "critical_ratio": 0.3, "laminar_share": 0.5},
            {},
            _SEVEN_BAR,
        ),
    ),
)
