"""Flow of air: ISO 6358, Saint-Venant and Wantzel, and a tube of finite volumes."""

from __future__ import annotations

import numpy as np
from numba import njit

from tests.truth.muscle import Array
from tests.truth.plant import CELLS

R = 287.05  # J/(kg K)
KAPPA = 1.4
DENSITY = 1.185  # kg/m3, ANR
REFERENCE = 293.15  # K
VISCOSITY = 1.82e-5  # Pa s
_STRAIGHT = 0.999  # pressure ratio above which the flow is linear in the difference

_SONIC = np.sqrt(KAPPA / R) * (2.0 / (KAPPA + 1.0)) ** ((KAPPA + 1.0) / (2.0 * (KAPPA - 1.0)))
_CRITICAL = (2.0 / (KAPPA + 1.0)) ** (KAPPA / (KAPPA - 1.0))


@njit(cache=True)
def iso_flow(above: float, below: float, conductance: float, ratio: float, warm: float) -> float:
    """Mass flow [kg/s] from ``above`` to ``below`` (absolute, above >= below)."""
    r = below / above
    choked = conductance * DENSITY * above * np.sqrt(REFERENCE / warm)
    if r <= ratio:
        return choked
    if r < _STRAIGHT:
        return choked * np.sqrt(1.0 - ((r - ratio) / (1.0 - ratio)) ** 2)
    edge = np.sqrt(1.0 - ((_STRAIGHT - ratio) / (1.0 - ratio)) ** 2)
    return choked * edge * (1.0 - r) / (1.0 - _STRAIGHT)


@njit(cache=True)
def nozzle_flow(above: float, below: float, conductance: float, warm: float) -> float:
    """Saint-Venant and Wantzel [kg/s]; the effective area is that with the sonic flow of C."""
    area = conductance * DENSITY * np.sqrt(REFERENCE) / _SONIC
    scale = area * above / np.sqrt(warm)
    r = below / above
    if r <= _CRITICAL:
        return scale * _SONIC
    part = min(r, _STRAIGHT)
    inside = part ** (2.0 / KAPPA) - part ** ((KAPPA + 1.0) / KAPPA)
    flow = scale * np.sqrt(2.0 * KAPPA / (R * (KAPPA - 1.0)) * inside)
    return flow if r < _STRAIGHT else flow * (1.0 - r) / (1.0 - _STRAIGHT)


@njit(cache=True)
def through(
    a: float, b: float, conductance: float, ratio: float, nozzle: float, warm_a: float, warm_b: float
) -> float:
    """Mass flow from a to b [kg/s], negative when it runs back."""
    if a >= b:
        return (
            nozzle_flow(a, b, conductance, warm_a)
            if nozzle > 0.5
            else iso_flow(a, b, conductance, ratio, warm_a)
        )
    return (
        -nozzle_flow(b, a, conductance, warm_b)
        if nozzle > 0.5
        else -iso_flow(b, a, conductance, ratio, warm_b)
    )


@njit(cache=True)
def tube_rates(
    pressures: Array,
    flows: Array,
    entering: float,
    end: float,
    length: float,
    bore: float,
    loss: float,
    warm: float,
    rates: Array,
) -> None:
    """Rates of an isothermal tube: ``CELLS`` pressures and as many flows, the last into the muscle.

    Mass in every cell, momentum across every face with laminar or Blasius wall friction and ``loss`` velocity
    heads spread along the tube.
    """
    area = np.pi / 4.0 * bore**2
    dx = length / CELLS
    for cell in range(CELLS):
        inflow = entering if cell == 0 else flows[cell - 1]
        rates[cell] = R * warm / (area * dx) * (inflow - flows[cell])
        below = end if cell == CELLS - 1 else pressures[cell + 1]
        mean = 0.5 * (pressures[cell] + below)
        flow = flows[cell]
        reynolds = abs(flow) * bore / (area * VISCOSITY) + 1e-9
        friction = 64.0 / reynolds if reynolds < 1500.0 else max(0.316 * reynolds**-0.25, 64.0 / reynolds)
        heads = friction * dx / bore + loss / CELLS
        drop = heads * flow * abs(flow) * R * warm / (2.0 * area**2 * mean)
        rates[CELLS + cell] = area / dx * (pressures[cell] - below - drop)


def eckersten(bore: float, length: float) -> tuple[float, float]:
    """Sonic conductance [m^3/(s Pa)] and critical ratio of a straight tube (Eckersten 1975)."""
    conductance = 0.029 * bore**2 / np.sqrt(length / bore**1.25 + 510.0)
    return conductance, 474.0 * conductance / bore**2
