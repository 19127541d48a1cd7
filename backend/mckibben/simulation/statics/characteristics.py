"""Static figures of a muscle: blocked force, contraction, work, operating points, curves over pressure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.muscle import CHARACTERISTICS, OPERATING_POINT, OVER_PRESSURE
from mckibben.facts.result import Number, Series, result_class
from mckibben.physics import ideal
from mckibben.simulation.statics.inverse import contraction_at
from mckibben.simulation.statics.limits import FlagCode, LimitFlag
from mckibben.simulation.statics.model import Curves, StaticModel

Array = NDArray[np.float64]

# Gauss-Legendre: exact for polynomials up to degree 31, far above what a force curve needs.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
# The first column is the nominal length, the others cover the range of each pressure.
_COLUMNS = np.concatenate([[0.0], (_NODES + 1.0) / 2.0])
FILLING, VENTING = -1.0, 1.0  # sign of dL/dt
_SAME_LENGTH = 1e-7  # lengths nearer than this share of the nominal length are one


@dataclass(frozen=True, slots=True)
class Conditions:
    """Conditions for static figures.

    Attributes:
        direction: sign of dL/dt, for friction.
        temperature: temperature of the elastomer [K].
        dead_volume: gas volume outside the muscle [m^3], for the closed valve.
        polytropic_exponent: exponent of the gas behind a closed valve.
    """

    direction: float = 0.0
    temperature: float = 293.15
    dead_volume: float = 0.0
    polytropic_exponent: float = 1.4


@result_class
class Characteristics:
    """Figures at one pressure."""

    FIGURES: ClassVar = CHARACTERISTICS.name

    pressure: float
    blocked_force: Number
    free_contraction: Number
    free_contraction_note: str | None
    """The limit that the free contraction crosses, as a sentence."""
    max_work: Number
    thread_tension_total: Number


@result_class
class OperatingPoint:
    """State in which a muscle holds a load at one pressure, SI; NaN and None where it cannot."""

    FIGURES: ClassVar = OPERATING_POINT.name

    pressure: float
    contraction: Number
    length: Number
    force: float | None
    stiffness: Number
    stiffness_closed: Number
    diameter: Number
    flags: list[str]
    """Codes of the flags of this point."""


@result_class
class PressureBranch:
    """Position under a constant load over pressure, in one direction; NaN where the load cannot be held."""

    FIGURES: ClassVar = OVER_PRESSURE.name

    contraction: Series
    length: Series
    diameter: Series
    outer_diameter: Series


@result_class
class ForceBranches:
    """Force at a fixed length over pressure [N], while shortening and while lengthening."""

    FIGURES: ClassVar = OVER_PRESSURE.name

    filling: Series
    venting: Series


class FurtherStiffness(NamedTuple):
    """Stiffness of curves by other definitions than the tangent [N/m], shape (P, N)."""

    from_force: Array
    secant: Array


class HeldContractions(NamedTuple):
    """Contractions at which a muscle carries a load; NaN where it cannot."""

    free: Array  # without load, at each pressure
    loaded: Array  # under the load, at each pressure; empty without a load
    filling: Array  # under the load over a grid of pressures, while shortening
    venting: Array  # and while lengthening


def held_contractions(
    model: StaticModel, pressures: Array, grid: Array, load: float | None, conditions: Conditions
) -> HeldContractions:
    """All equilibria that the curves need, in one vectorised search: each call costs more than its rows.

    Args:
        model: the muscle.
        pressures: gauge pressures of the curves [Pa].
        grid: pressures of the curves over pressure [Pa].
        load: load [N], None without one.
        conditions: direction and temperature.
    """
    here = np.full(len(pressures), float(conditions.direction))
    parts = [(np.zeros(len(pressures)), pressures, here)]
    if load is not None:
        parts += [
            (np.full(len(pressures), load), pressures, here),
            (np.full(len(grid), load), grid, np.full(len(grid), FILLING)),
            (np.full(len(grid), load), grid, np.full(len(grid), VENTING)),
        ]
    loads, at, direction = (np.concatenate(column) for column in zip(*parts, strict=True))
    contractions = contraction_at(
        model, load=loads, pressures=at, direction=direction, temperature=conditions.temperature
    )
    pieces = np.split(contractions, np.cumsum([len(part[0]) for part in parts])[:-1])
    return HeldContractions(*pieces, *[np.empty(0)] * (4 - len(pieces)))


def characteristics(
    model: StaticModel, pressures: Array, free: Array, conditions: Conditions
) -> list[Characteristics]:
    r"""Blocked force, free contraction and work :math:`\int F\,dL` of each pressure.

    There is no work where the muscle does not contract without load.

    Args:
        model: the muscle.
        pressures: gauge [Pa].
        free: contraction without load at each pressure; NaN when out of reach.
        conditions: direction and temperature.
    """
    rest = model.muscle.nominal_length
    stroke = np.where(np.isfinite(free) & (free > 0.0), free, 0.0)
    at = _COLUMNS * stroke[:, None]
    force = model.force(
        length=rest * (1.0 - at.ravel()),
        pressure=np.repeat(pressures, at.shape[1]),
        direction=conditions.direction,
        temperature=conditions.temperature,
    ).reshape(at.shape)
    work = np.where(stroke > 0.0, rest * stroke / 2.0 * (force[:, 1:] @ _WEIGHTS), np.nan)
    tension = ideal.thread_tension(braid=model.muscle.braid, pressure=pressures, length=rest)
    crossed = [_free_note(model, contraction) for contraction in free.tolist()]
    return [
        Characteristics(
            pressure=pressure,
            blocked_force=force[index, 0],
            free_contraction=contraction,
            free_contraction_note=note,
            max_work=work[index],
            thread_tension_total=tension[index],
        )
        for index, (pressure, contraction, note) in enumerate(
            zip(pressures.tolist(), free.tolist(), crossed, strict=True)
        )
    ]


def _free_note(model: StaticModel, contraction: float) -> str | None:
    if not isfinite(contraction):
        return CHARACTERISTICS["free_contraction"].exists_when.otherwise
    return next((flag.message for flag in model.limits.flags(contraction=contraction)), None)


def operating_points(
    model: StaticModel, pressures: Array, load: float, held: Array, conditions: Conditions
) -> tuple[list[OperatingPoint], list[LimitFlag]]:
    """The state in which the muscle holds a load at each pressure, and every limit it crosses.

    Args:
        model: the muscle.
        pressures: gauge [Pa].
        load: [N].
        held: contraction under the load at each pressure; NaN when out of reach.
        conditions: direction, temperature, and the gas behind a closed valve.
    """
    reached = np.flatnonzero(np.isfinite(held))
    length = model.muscle.nominal_length * (1.0 - held)
    stiffness, closed, diameter = (np.full(len(pressures), np.nan) for _ in range(3))
    if reached.size:
        there = model.curves(
            pressures[reached],
            length[reached],
            direction=conditions.direction,
            temperature=conditions.temperature,
            dead_volume=conditions.dead_volume,
            polytropic_exponent=conditions.polytropic_exponent,
            clipped=False,  # in balance with the load, so never slack, not even at a load of zero
        )
        stiffness[reached] = np.diagonal(there.stiffness)
        closed[reached] = np.diagonal(there.stiffness_closed)
        diameter[reached] = np.diagonal(there.diameter)
    points: list[OperatingPoint] = []
    flags: list[LimitFlag] = []
    for index, pressure in enumerate(pressures):
        inside = bool(np.isfinite(held[index]))
        if inside:
            crossed = model.limits.flags(pressure=pressure, force=load, contraction=held[index])
        else:
            why = f"{load:.4g} N stretches the muscle to the braid lock at {pressure / 1e5:.3g} bar"
            crossed = [LimitFlag(FlagCode.OUT_OF_REACH, why, "load")]
        flags += crossed
        points.append(
            OperatingPoint(
                pressure=float(pressure),
                contraction=held[index],
                length=length[index],
                force=load if inside else None,
                stiffness=stiffness[index],
                stiffness_closed=closed[index],
                diameter=diameter[index],
                flags=[str(flag.code) for flag in crossed],
            )
        )
    return points, flags


def pressure_branch(
    model: StaticModel, grid: Array, held: Array, *, direction: float, temperature: float
) -> PressureBranch:
    """Position under a load over a grid of pressures, in one direction.

    Args:
        model: the muscle.
        grid: gauge pressures [Pa].
        held: contraction at each of them; NaN where the load is not held.
        direction: sign of dL/dt.
        temperature: [K].
    """
    length = model.muscle.nominal_length * (1.0 - held)
    reached = np.isfinite(length)
    diameter, outer = np.full(len(grid), np.nan), np.full(len(grid), np.nan)
    if reached.any():
        there = model.outputs(
            length=length[reached], pressure=grid[reached], direction=direction, temperature=temperature
        )
        diameter[reached], outer[reached] = there["diameter"], there["outer_diameter"]
    return PressureBranch(held, length, diameter, outer)


def force_at_length(model: StaticModel, grid: Array, length: float, *, temperature: float) -> ForceBranches:
    """Force at a fixed length [m] over a grid of gauge pressures [Pa], both ways."""
    both = model.force(
        length=length,
        pressure=np.tile(grid, 2),
        direction=np.repeat([FILLING, VENTING], len(grid)),
        temperature=temperature,
    )
    return ForceBranches(both[: len(grid)], both[len(grid) :])


def diameters_at_length(
    model: StaticModel, grid: Array, length: float, *, temperature: float
) -> tuple[Array, Array]:
    """Braid diameter and outer diameter [m] at a fixed length [m] over a grid of gauge pressures [Pa].

    Constant as long as no effect stretches the threads or changes the wall: whatever changes is that effect.
    """
    there = model.outputs(length=length, pressure=grid, temperature=temperature)
    diameter, outer = (
        np.broadcast_to(there[name], np.shape(grid)).copy() for name in ("diameter", "outer_diameter")
    )
    return diameter, outer


def further_stiffness(
    model: StaticModel, curves: Curves, pressures: Array, length: Array, free: Array
) -> FurtherStiffness:
    """The stiffness that the force implies and the secant from the length without force, of curves.

    Args:
        model: the muscle.
        curves: its curves, shape (P, N).
        pressures: gauge pressures of the rows [Pa].
        length: lengths of the columns [m].
        free: contraction without load at each pressure; NaN when out of reach.

    Returns:
        Both of shape (P, N). NaN where they have no value: with a force at the length at which an ideal
        muscle has none; at a pressure at which the muscle has no length without force. 0 where a clipped
        curve is slack.
    """
    braid, rest = model.muscle.braid, model.muscle.nominal_length
    shortest = float(ideal.zero_force_length(braid=braid))
    lengths = np.broadcast_to(length, curves.force.shape)
    with np.errstate(divide="ignore", invalid="ignore"):
        from_force = ideal.stiffness_from_force(braid=braid, force=curves.force, length=lengths)
        without = (rest * (1.0 - free))[:, None]
        secant = ideal.stiffness_secant(force=curves.force, length=lengths, shortest=without)
    # Both are 0/0 there; of the ideal muscle, and of the secant of any, the limit is the tangent.
    largest = ideal.lock_force(braid=braid, pressure=pressures)[:, None]
    at_shortest = np.abs(lengths - shortest) < _SAME_LENGTH * rest
    limit = np.where(np.abs(curves.force) <= 10.0 * _SAME_LENGTH * largest, curves.stiffness, np.nan)
    at_free = np.abs(lengths - without) < _SAME_LENGTH * rest
    return FurtherStiffness(
        np.where(at_shortest, limit, from_force), np.where(at_free, curves.stiffness, secant)
    )


def ideal_contraction(model: StaticModel) -> float:
    """Contraction at which the ideal force is zero."""
    return float(ideal.max_contraction(braid_angle=model.muscle.braid_angle))


def lock_forces(model: StaticModel, pressures: Sequence[float] | Array) -> Array:
    """Ideal force of the fully stretched braid at each pressure [N]."""
    return ideal.lock_force(braid=model.muscle.braid, pressure=np.asarray(pressures))
