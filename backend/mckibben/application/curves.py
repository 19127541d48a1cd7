"""The static characteristics of a muscle: curves and figures per pressure, position over pressure."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.application.start import Json, flags_json, geometry_json, start_flags
from mckibben.documents.convert import given_muscle
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.physics import ideal
from mckibben.physics.errors import InputError
from mckibben.server.schemas.curves import CurvesOptions, CurvesRequest
from mckibben.simulation.statics.inverse import contraction_at
from mckibben.simulation.statics.limits import FlagCode, LimitFlag
from mckibben.simulation.statics.model import StaticModel

Array = NDArray[np.float64]

_OVER_PRESSURE_POINTS = 81
# Exact for polynomials up to degree 31, far above what a force curve needs.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_SHORTEST = 0.05  # share of the nominal length; nothing contracts further


class _Held(NamedTuple):
    """Contractions at which the muscle carries a load; NaN where it cannot."""

    free: Array  # without load, at each pressure
    load: Array  # the load of the request, at each pressure; empty without one
    filling: Array  # the same over the grid of pressures, while shortening
    venting: Array  # and while lengthening


def curves_answer(request: CurvesRequest, studio: Studio) -> Json:
    """The answer to a curves request, with numpy arrays in it.

    Raises:
        InputError: the muscle, an effect or the range cannot be used.
    """
    start = studio.start_model(given_muscle(request.muscle), request.effects)
    return curves_of(request, start, studio)


def curves_of(request: CurvesOptions, start: StartModel, studio: Studio) -> Json:
    """The curves of a muscle that is known already.

    Raises:
        InputError: the geometry cannot pull, a parameter is out of bounds, the range cannot be used.
    """
    model = studio.static_model(start)
    pressures = np.array(request.pressures)
    grid = np.linspace(0.0, float(np.max(pressures)), _OVER_PRESSURE_POINTS)
    held = _solve(request, model, pressures, grid)
    contraction = _range(request, model, held.free)
    length = model.muscle.nominal_length * (1.0 - contraction)
    curves = model.curves(
        pressures,
        length,
        direction=request.direction,
        temperature=request.temperature,
        clipped=not request.unclipped,
        dead_volume=request.dead_volume,
        polytropic_exponent=request.polytropic_exponent,
    )
    points, flags = _operating_points(request, model, pressures, held.load)
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
        "outer_diameter": curves.outer_diameter[top],
        "limits": _limits(model, pressures),
        "characteristics": _characteristics(request, model, pressures, held.free),
        "geometry": geometry_json(start),
        "model": {"effects": model.values},
        "over_pressure": _over_pressure(request, model, grid, held),
        "operating_points": points,
        "flags": [*start_flags(start), *flags_json(flags)],
    }


def _solve(request: CurvesOptions, model: StaticModel, pressures: Array, grid: Array) -> _Held:
    """All contractions of the answer in one vectorised search: the calls cost more than the rows."""
    free = (np.zeros(len(pressures)), pressures, np.full(len(pressures), float(request.direction)))
    parts = [free]
    if request.load is not None:
        parts += [
            (np.full(len(pressures), request.load), pressures, free[2]),
            (np.full(len(grid), request.load), grid, np.full(len(grid), -1.0)),
            (np.full(len(grid), request.load), grid, np.full(len(grid), 1.0)),
        ]
    rows: list[Any] = [np.concatenate(column) for column in zip(*parts, strict=True)]
    found = contraction_at(
        model, load=rows[0], pressures=rows[1], direction=rows[2], temperature=request.temperature
    )
    ends = np.cumsum([len(part[0]) for part in parts])[:-1]
    pieces = np.split(found, ends)
    return _Held(*pieces, *[np.empty(0)] * (4 - len(pieces)))


def _range(request: CurvesOptions, model: StaticModel, free: Array) -> Array:
    """Contractions of the columns; unless given, the permitted range, and on to where the last curve ends."""
    locked = 1.0 - model.longest / model.muscle.nominal_length
    first, last = request.contraction_from, request.contraction_to
    if first is None:
        first = max(-(model.limits.max_pretension or 0.0), locked)
        if last is not None and last <= first:
            first = max(last - 0.01, locked)
    if last is None:
        reached = float(np.max(free, initial=0.0, where=np.isfinite(free)))
        enough = max(first, 0.0) + 1e-3
        last = reached if reached > enough else max(_ideal_contraction(model), enough)
        last = max(last, model.limits.max_contraction or 0.0)
    for name, value in (("contraction_from", first), ("contraction_to", last)):
        if value < locked:
            raise InputError(
                f"a stretch of {-value * 100:.3g} % is beyond the braid lock at {-locked * 100:.3g} %",
                field=name,
                hint=f"at least '{locked * 100:.3g} %'",
            )
        if value > 1.0 - _SHORTEST:
            raise InputError(f"no muscle contracts by {value * 100:.3g} %", field=name, hint="e.g. '25 %'")
    if not last > first:
        raise InputError(
            f"the range ends at {last * 100:.3g} %, not after it begins at {first * 100:.3g} %",
            field="contraction_to" if request.contraction_to is not None else "contraction_from",
        )
    columns = np.linspace(first, last, request.points)
    nearest = int(np.argmin(np.abs(columns)))
    if 0 < nearest < len(columns) - 1:
        columns[nearest] = 0.0  # the nominal length itself, where the blocked force is read
    return columns


def _ideal_contraction(model: StaticModel) -> float:
    return float(ideal.max_contraction(braid_angle=model.muscle.braid_angle))


def _limits(model: StaticModel, pressures: Array) -> Json:
    limits = model.limits
    return {
        "max_pressure": limits.max_pressure,
        "max_force": limits.max_force,
        "max_contraction": limits.max_contraction,
        "max_pretension": limits.max_pretension,
        "ideal_max_contraction": _ideal_contraction(model),
        "braid_lock_force": ideal.lock_force(braid=model.muscle.braid, pressure=pressures),
    }


def _characteristics(request: CurvesOptions, model: StaticModel, pressures: Array, free: Array) -> list[Json]:
    """Blocked force, free contraction and work of each pressure."""
    rest = model.muscle.nominal_length
    stroke = np.where(np.isfinite(free) & (free > 0.0), free, 0.0)
    # The work of the stroke by Gauss-Legendre over each pressure's own range; the first column is the
    # nominal length itself.
    at = np.concatenate([[0.0], (_NODES + 1.0) / 2.0]) * stroke[:, None]
    force = model.force(
        length=rest * (1.0 - at.ravel()),
        pressure=np.repeat(pressures, at.shape[1]),
        direction=request.direction,
        temperature=request.temperature,
    ).reshape(at.shape)
    work = rest * stroke / 2.0 * (force[:, 1:] @ _WEIGHTS)
    tension = ideal.thread_tension(braid=model.muscle.braid, pressure=pressures, length=rest)
    return [
        {
            "pressure": pressure,
            "blocked_force": force[index, 0],
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
    request: CurvesOptions, model: StaticModel, pressures: Array, held: Array
) -> tuple[list[Json], list[LimitFlag]]:
    """Where the muscle holds the load at each pressure, and every limit that is crossed there."""
    if request.load is None:
        return [], []
    reached = np.flatnonzero(np.isfinite(held))
    length = model.muscle.nominal_length * (1.0 - held)
    figures = {
        name: np.full(len(pressures), np.nan) for name in ("stiffness", "stiffness_closed", "diameter")
    }
    if reached.size:
        there = model.curves(
            pressures[reached],
            length[reached],
            direction=request.direction,
            temperature=request.temperature,
            dead_volume=request.dead_volume,
            polytropic_exponent=request.polytropic_exponent,
            clipped=False,  # in balance with the load, so never slack, not even at a load of zero
        )
        for name, values in figures.items():
            values[reached] = np.diagonal(getattr(there, name))
    points, flags = [], []
    for index, pressure in enumerate(request.pressures):
        if np.isfinite(held[index]):
            crossed = model.limits.flags(pressure=pressure, force=request.load, contraction=held[index])
        else:
            why = f"{request.load:.4g} N stretch the muscle to the braid lock at {pressure / 1e5:.3g} bar"
            crossed = [LimitFlag(FlagCode.OUT_OF_REACH, why, "load")]
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


def _over_pressure(request: CurvesOptions, model: StaticModel, grid: Array, held: _Held) -> Json | None:
    """Position at the load and force at the fixed length, from zero to the highest pressure, both ways."""
    if request.load is None and request.fixed_length is None:
        return None
    force = None
    if request.fixed_length is not None:
        _check_fixed_length(request.fixed_length, model)
        both = model.force(
            length=request.fixed_length,
            pressure=np.tile(grid, 2),
            direction=np.repeat([-1.0, 1.0], len(grid)),
            temperature=request.temperature,
        )
        force = {"filling": both[: len(grid)], "venting": both[len(grid) :]}
    return {
        "pressure": grid,
        "load": request.load,
        "filling": _branch(request, model, grid, held.filling, -1.0),
        "venting": _branch(request, model, grid, held.venting, 1.0),
        "fixed_length": request.fixed_length,
        "force_at_fixed_length": force,
    }


def _branch(
    request: CurvesOptions, model: StaticModel, grid: Array, held: Array, direction: float
) -> Json | None:
    if request.load is None:
        return None
    length = model.muscle.nominal_length * (1.0 - held)
    reached = np.isfinite(length)
    state: dict[str, Any] = {"direction": direction, "temperature": request.temperature}
    widths = {name: np.full(len(grid), np.nan) for name in ("diameter", "outer_diameter")}
    if reached.any():
        there = model.outputs(length=length[reached], pressure=grid[reached], **state)
        for name, width in widths.items():
            width[reached] = there[name]
    return {"contraction": held, "length": length, **widths}


def _check_fixed_length(length: float, model: StaticModel) -> None:
    shortest = _SHORTEST * model.muscle.nominal_length
    if not shortest <= length <= model.longest:
        raise InputError(
            f"a length of {length * 1e3:.4g} mm is out of reach",
            field="fixed_length",
            hint=f"between {shortest * 1e3:.4g} mm and the braid lock at {model.longest * 1e3:.4g} mm",
        )
