"""The static characteristics of a muscle: curves per pressure, figures per pressure, position over pressure."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mckibben.api.answers.start import Json, flags_json, geometry_json, start_flags
from mckibben.api.schemas.convert import given_muscle
from mckibben.api.schemas.curves import CurvesRequest
from mckibben.physics import ideal
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle
from mckibben.simulation.inverse import contraction_at
from mckibben.simulation.limits import Flag, FlagCode
from mckibben.simulation.static import StaticModel
from mckibben.studio import Studio

Array = NDArray[np.float64]

_OVER_PRESSURE_POINTS = 81
# Exact for polynomials up to degree 31, far above what a force curve needs.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_SHORTEST = 0.05  # share of the nominal length; nothing contracts further


def curves_answer(request: CurvesRequest, studio: Studio) -> Json:
    """The answer to a curves request, with numpy arrays in it.

    Raises:
        InputError: the muscle, an effect or the range cannot be used.
    """
    start = studio.start_model(given_muscle(request.muscle), request.effects)
    model = studio.static_model(start)
    muscle = model.muscle
    pressures = np.array(request.pressures)
    free = contraction_at(
        model, load=0.0, pressures=pressures, direction=request.direction, temperature=request.temperature
    )
    contraction = _range(request, model, free)
    length = muscle.nominal_length * (1.0 - contraction)
    curves = model.curves(
        pressures,
        length,
        direction=request.direction,
        temperature=request.temperature,
        clipped=not request.unclipped,
        dead_volume=request.dead_volume,
        polytropic_exponent=request.polytropic_exponent,
    )
    points, flags = _operating_points(request, model, pressures)
    flags = [crossed for p in request.pressures for crossed in model.limits.flags(pressure=p)] + flags
    # Volume, diameter and angle depend on the length; where an effect lets the pressure stretch the braid,
    # they are those of the highest pressure.
    top = int(np.argmax(pressures))
    return {
        "pressure": pressures,
        "length": length,
        "contraction": contraction,
        "braid_angle": curves.braid_angle[top],
        "force": curves.force,
        "stiffness": curves.stiffness,
        "stiffness_closed": curves.stiffness_closed,
        "volume": curves.volume[top],
        "diameter": curves.diameter[top],
        "limits": _limits(model, pressures),
        "characteristics": _characteristics(request, model, pressures, free),
        "geometry": geometry_json(start),
        "model": {"effects": model.values},
        "over_pressure": _over_pressure(request, model, pressures),
        "operating_points": points,
        "flags": [*start_flags(start), *flags_json(flags)],
    }


def _range(request: CurvesRequest, model: StaticModel, free: Array) -> Array:
    """Contractions of the columns: from the nominal length to where the strongest curve ends, unless given."""
    muscle = model.muscle
    first = 0.0 if request.contraction_from is None else request.contraction_from
    last = request.contraction_to
    if last is None:
        reached = np.max(free, initial=0.0, where=np.isfinite(free))
        enough = max(first, 0.0) + 1e-3
        last = reached if reached > enough else max(_ideal_contraction(muscle), enough)
    locked = 1.0 - model.longest / muscle.nominal_length
    for name, value in (("contraction_from", first), ("contraction_to", last)):
        if value < locked:
            raise InputError(
                f"a stretch of {-value * 100:.3g} % is beyond the braid lock at {-locked * 100:.3g} %",
                field=name,
                hint=f"at least '{locked * 100:.3g} %'",
            )
        if value > 1.0 - _SHORTEST:
            raise InputError(
                f"no muscle contracts by {value * 100:.3g} %", field=name, hint="e.g. '25 %'"
            )
    if not last > first:
        raise InputError(
            f"the range ends at {last * 100:.3g} %, before it begins at {first * 100:.3g} %",
            field="contraction_to" if request.contraction_to is not None else "contraction_from",
        )
    return np.linspace(first, last, request.points)


def _ideal_contraction(muscle: Muscle) -> float:
    return float(ideal.max_contraction(braid_angle=muscle.braid_angle))


def _limits(model: StaticModel, pressures: Array) -> Json:
    limits = model.limits
    return {
        "max_pressure": limits.max_pressure,
        "max_force": limits.max_force,
        "max_contraction": limits.max_contraction,
        "max_pretension": limits.max_pretension,
        "ideal_max_contraction": _ideal_contraction(model.muscle),
        "braid_lock_force": ideal.lock_force(braid=model.muscle.braid, pressure=pressures),
    }


def _characteristics(
    request: CurvesRequest, model: StaticModel, pressures: Array, free: Array
) -> list[Json]:
    """Blocked force, free contraction and work of each pressure."""
    rest = model.muscle.nominal_length
    state = {"direction": request.direction, "temperature": request.temperature}
    blocked = model.force(length=rest, pressure=pressures, **state)
    stroke = np.where(np.isfinite(free) & (free > 0.0), free, 0.0)
    # Work of the stroke by Gauss-Legendre over each pressure's own range of contraction.
    at = stroke[:, None] * (_NODES + 1.0) / 2.0
    force = model.force(
        length=rest * (1.0 - at.ravel()), pressure=np.repeat(pressures, len(_NODES)), **state
    ).reshape(at.shape)
    work = rest * stroke / 2.0 * (force @ _WEIGHTS)
    tension = ideal.thread_tension(braid=model.muscle.braid, pressure=pressures, length=rest)
    return [
        {
            "pressure": pressure,
            "blocked_force": blocked[index],
            "free_contraction": free[index],
            "free_contraction_flag": _free_flag(model, free[index]),
            "max_work": work[index],
            "thread_tension_total": tension[index],
        }
        for index, pressure in enumerate(request.pressures)
    ]


def _free_flag(model: StaticModel, contraction: float) -> str | None:
    if not np.isfinite(contraction):
        return str(FlagCode.OUT_OF_REACH)
    crossed = model.limits.flags(contraction=contraction)
    return str(crossed[0].code) if crossed else None


def _operating_points(
    request: CurvesRequest, model: StaticModel, pressures: Array
) -> tuple[list[Json], list[Flag]]:
    """Where the muscle holds the load at each pressure, and every limit that is crossed there."""
    if request.load is None:
        return [], []
    state: dict[str, Any] = {"direction": request.direction, "temperature": request.temperature}
    held = contraction_at(model, load=request.load, pressures=pressures, **state)
    reached = np.flatnonzero(np.isfinite(held))
    length = model.muscle.nominal_length * (1.0 - held)
    there = model.curves(
        pressures[reached],
        length[reached],
        **state,
        dead_volume=request.dead_volume,
        polytropic_exponent=request.polytropic_exponent,
    )
    figures = {
        name: np.full(len(pressures), np.nan) for name in ("stiffness", "stiffness_closed", "diameter")
    }
    for name, values in figures.items():
        values[reached] = np.diagonal(getattr(there, name))
    points, flags = [], []
    for index, pressure in enumerate(request.pressures):
        if np.isfinite(held[index]):
            crossed = model.limits.flags(pressure=pressure, force=request.load, contraction=held[index])
        else:
            crossed = [
                Flag(
                    FlagCode.OUT_OF_REACH,
                    f"{request.load:.4g} N stretch the muscle to the braid lock at {pressure / 1e5:.3g} bar",
                    "load",
                )
            ]
        flags += crossed
        points.append(
            {
                "pressure": pressure,
                "contraction": held[index],
                "length": length[index],
                "force": request.load if np.isfinite(held[index]) else None,
                **{name: values[index] for name, values in figures.items()},
                "flags": [str(item.code) for item in crossed],
            }
        )
    return points, flags


def _over_pressure(request: CurvesRequest, model: StaticModel, pressures: Array) -> Json | None:
    """Position at the load and force at the fixed length, from zero to the highest pressure, both ways."""
    if request.load is None and request.fixed_length is None:
        return None
    grid = np.linspace(0.0, float(np.max(pressures)), _OVER_PRESSURE_POINTS)
    force = None
    if request.fixed_length is not None:
        _check_fixed_length(request.fixed_length, model)
        force = {
            name: model.force(
                length=request.fixed_length, pressure=grid, direction=sign, temperature=request.temperature
            )
            for name, sign in (("filling", -1.0), ("venting", 1.0))
        }
    return {
        "pressure": grid,
        "load": request.load,
        "filling": _branch(request, model, grid, -1.0),
        "venting": _branch(request, model, grid, 1.0),
        "fixed_length": request.fixed_length,
        "force_at_fixed_length": force,
    }


def _branch(request: CurvesRequest, model: StaticModel, grid: Array, direction: float) -> Json | None:
    if request.load is None:
        return None
    held = contraction_at(
        model, load=request.load, pressures=grid, direction=direction, temperature=request.temperature
    )
    length = model.muscle.nominal_length * (1.0 - held)
    reached = np.isfinite(length)
    diameter = np.full(len(grid), np.nan)
    if reached.any():
        diameter[reached] = model.outputs(
            length=length[reached], pressure=grid[reached], direction=direction, temperature=request.temperature
        )["diameter"]
    return {"contraction": held, "length": length, "diameter": diameter}


def _check_fixed_length(length: float, model: StaticModel) -> None:
    shortest = _SHORTEST * model.muscle.nominal_length
    if not shortest <= length <= model.longest:
        raise InputError(
            f"a length of {length * 1e3:.4g} mm is out of reach",
            field="fixed_length",
            hint=f"between {shortest * 1e3:.4g} mm and the braid lock at {model.longest * 1e3:.4g} mm",
        )
