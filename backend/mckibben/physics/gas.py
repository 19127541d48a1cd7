r"""Compressed air: flow through a restriction after ISO 6358, and the pressure in a chamber.

A restriction is given by its sonic conductance C [m^3/(s Pa)] and critical pressure ratio b [-]. With the
upstream state 1, r = p2/p1 and the reference state :math:`\rho_0 = 1.185\,kg/m^3, T_0 = 293.15\,K` (ANR):

.. math:: \dot m = C\,\rho_0\,p_1\sqrt{T_0/T_1}\;\psi(r),\quad
   \psi = 1\ (r \le b),\quad \psi = \sqrt{1-\Bigl(\frac{r-b}{1-b}\Bigr)^2}\ (r > b)

All pressures here are absolute.
"""

from __future__ import annotations

from mckibben.physics import ops
from mckibben.physics.ops import Value

GAS_CONSTANT = 287.05  # J/(kg K), dry air
HEAT_CAPACITY_RATIO = 1.4
HEAT_CAPACITY_V = GAS_CONSTANT / (HEAT_CAPACITY_RATIO - 1.0)  # J/(kg K)
HEAT_CAPACITY_P = HEAT_CAPACITY_RATIO * HEAT_CAPACITY_V
ANR_DENSITY = 1.185  # kg/m^3 at 20 degC, 100 kPa, 65 % humidity (ISO 8778)
ANR_TEMPERATURE = 293.15  # K
# Heat transfer between the air in a muscle and its wall [W/(m^2 K)], where nothing is stated: 20-60 at rest,
# several hundred during a fast fill (general knowledge, not verified). With it the gas temperature follows
# the wall within 0.2 s (10 mm bore) to 0.9 s (40 mm).
WALL_HEAT_TRANSFER = 100.0

# Above this pressure ratio psi is linear: its exact slope at r = 1 is infinite (the real flow is laminar).
LAMINAR_RATIO = 0.999
_CLOSED = 1e-30  # conductance below all others, so that nothing is divided by 0 [m^3/(s Pa)]


def flow_function(*, ratio: Value, critical_ratio: Value) -> Value:
    """The flow function psi(r) [-] for 0 <= r <= 1; linear down to 0 above r = 0.999."""
    bent = (ops.positive_part(ops.minimum(ratio, LAMINAR_RATIO) - critical_ratio)) / (1.0 - critical_ratio)
    psi = ops.sqrt(1.0 - bent**2)
    return psi * ops.where(
        ops.greater(ratio, LAMINAR_RATIO), (1.0 - ratio) / (1.0 - LAMINAR_RATIO), 1.0 + 0.0 * ratio
    )


def mass_flow(
    *,
    pressure_from: Value,
    pressure_to: Value,
    temperature_from: Value,
    temperature_to: Value,
    conductance: Value,
    critical_ratio: Value,
) -> Value:
    """Mass flow from one side to the other [kg/s]; negative for reverse flow, zero at equal pressures.

    >>> p0 = 1e5
    >>> flow = mass_flow(pressure_from=7e5, pressure_to=p0, temperature_from=293.15, temperature_to=293.15,
    ...                  conductance=1e-8, critical_ratio=0.3)
    >>> round(float(flow), 6)  # choked: C rho0 p1
    0.008295
    """
    forward = ops.greater(pressure_from, pressure_to)
    upstream = ops.where(forward, pressure_from, pressure_to)
    downstream = ops.where(forward, pressure_to, pressure_from)
    temperature = ops.where(forward, temperature_from, temperature_to)
    sign = ops.where(forward, 1.0, -1.0)
    psi = flow_function(ratio=downstream / upstream, critical_ratio=critical_ratio)
    return sign * conductance * ANR_DENSITY * upstream * ops.sqrt(ANR_TEMPERATURE / temperature) * psi


def in_series(*, first: Value, first_ratio: Value, second: Value, second_ratio: Value) -> tuple[Value, Value]:
    r"""One for two restrictions in series, the first upstream: conductance [m^3/(s Pa)] and critical ratio.

    Its choked flow is exact: the pressure between both, a share x of that upstream, solves
    :math:`C_1^2\,\psi_1(x)^2 = C_2^2 x^2` while the second is choked, and where :math:`C_1 \le b_1 C_2` the
    first alone is. So is its slope near equal pressures, where :math:`(1-b)/C^2` adds up:

    .. math:: C = \min(C_1,\,C_2 x),\quad
       1 - b = C^2\Bigl(\frac{1-b_1}{C_1^2} + \frac{1-b_2}{C_2^2}\Bigr)

    Between, the flow is within 1.5 % of that of both. Each conductance may be 0. Derived from ISO 6358 for
    this program; 1/C^2 = 1/C_1^2 + 1/C_2^2, often used, is up to 7 % below the choked flow of two equal ones.

    >>> conductance, ratio = in_series(first=1e-8, first_ratio=0.3, second=1e-8, second_ratio=0.3)
    >>> round(float(conductance) * 1e8, 4), round(float(ratio), 4)
    (0.7572, 0.1973)
    """
    wide = ops.maximum(first, first_ratio * second)  # below, the first alone is choked
    root = ops.sqrt(wide**2 + (1.0 - 2.0 * first_ratio) * second**2)
    both = wide**2 + ((1.0 - first_ratio) * second) ** 2
    passed = (first_ratio * wide + (1.0 - first_ratio) * root) / ops.maximum(both, _CLOSED**2)
    by_second = ops.greater(first, first_ratio * second)
    of_first = ops.where(by_second, second * passed, 1.0)  # C/C_1
    of_second = ops.where(by_second, wide * passed, first / ops.maximum(second, _CLOSED))  # C/C_2
    ratio = 1.0 - of_first**2 * (1.0 - first_ratio) - of_second**2 * (1.0 - second_ratio)
    return of_first * first, ratio


def conductance_of_nominal_flow(*, nominal_flow: Value, critical_ratio: Value) -> Value:
    """Sonic conductance C of a standard nominal flow [m^3/s at DIN 1343, 6 to 5 bar gauge].

    The nominal flow is measured from 7 to 6 bar absolute and stated at 0 degC (1.293 kg/m^3):
    C = q 1.293/1.185/(p1 psi(6/7)).
    """
    psi = flow_function(ratio=6.0 / 7.0, critical_ratio=critical_ratio)
    return nominal_flow * 1.293 / ANR_DENSITY / (7e5 * psi)


def tube_conductance(*, diameter: Value, length: Value) -> Value:
    """Sonic conductance of a tube after Eckersten, 0.029 d^2/sqrt(l/d^1.25 + 510) [m^3/(s Pa)]; d, l in m."""
    return 0.029 * diameter**2 / ops.sqrt(length / diameter**1.25 + 510.0)


def tube_critical_ratio(*, diameter: Value, length: Value) -> Value:
    """Critical pressure ratio of a tube after Eckersten, b = 474 C/d^2 [-]."""
    return 474.0 * tube_conductance(diameter=diameter, length=length) / diameter**2


def pressure_rate(
    *,
    pressure: Value,
    volume: Value,
    volume_rate: Value,
    mass_flow: Value,
    temperature: Value,
    polytropic_exponent: Value,
) -> Value:
    """dp/dt = n/V (R T m_dot - p dV/dt) of a polytropic chamber [Pa/s], p absolute."""
    inflow = GAS_CONSTANT * temperature * mass_flow
    return polytropic_exponent / volume * (inflow - pressure * volume_rate)


def wall_heat_flow(
    *, coefficient: Value, diameter: Value, length: Value, gas_temperature: Value, wall_temperature: Value
) -> Value:
    """Heat flow from the wall into the gas of a cylinder with both ends, h (pi D L + pi D^2/2) (T_w - T) [W].

    >>> round(float(wall_heat_flow(coefficient=30.0, diameter=0.02, length=0.3,
    ...                            gas_temperature=333.0, wall_temperature=293.0)), 4)
    -23.3734
    """
    area = ops.pi * diameter * (length + 0.5 * diameter)
    return coefficient * area * (wall_temperature - gas_temperature)
