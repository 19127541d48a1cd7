"""A model beside a measurement: the error in numbers, and the points for the plots."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from mckibben.api.answers.measured import Points
from mckibben.api.answers.start import Json, geometry_json, start_flags
from mckibben.identification.compare import Comparison, compare
from mckibben.muscle_input import StartModel
from mckibben.studio import Studio

MAX_POINTS_PER_SERIES = 400
_MAX_SERIES = 200
# A sample this much longer or shorter than the muscle is another muscle.
_OTHER_LENGTH = 0.05


def comparison_answer(
    studio: Studio, start: StartModel, points: Points, *, fit: bool = False, free: Sequence[str] = ()
) -> Json:
    """Compare, and say it in JSON (with numpy arrays in it).

    Raises:
        InputError: the measurement does not allow the comparison, or a geometry field cannot be freed.
    """
    result = compare(
        points.measurement,
        start.muscle,
        start.effects,
        catalogue=studio.catalogue,
        limits=start.limits,
        fit=fit,
        free=free,
        tolerance={} if start.preset is None else start.preset.tolerance,
    )
    report = result.report()
    series, thinned = _series(result)
    messages = [*report["messages"], *_length_messages(start, points)]
    if thinned:
        messages.append(f"curves show at most {MAX_POINTS_PER_SERIES} points each; the figures use all rows")
    left_out = sum(points.left_out.values())
    return {
        **report,
        "rows": report["rows"] + left_out,
        "excluded": points.left_out | report["excluded"],
        "messages": messages,
        # A fitted geometry no longer belongs to the lattice it was given by.
        "geometry": geometry_json(
            start if result.muscle == start.muscle else replace(start, muscle=result.muscle, rhombus=None)
        ),
        "series": series,
        "flags": start_flags(start),
    }


def _length_messages(start: StartModel, points: Points) -> list[str]:
    sample, muscle = points.nominal_length, start.muscle.nominal_length
    if sample is None or abs(muscle / sample - 1.0) <= _OTHER_LENGTH:
        return []
    return [
        f"the measured sample is {sample * 1e3:.4g} mm long, the muscle {muscle * 1e3:.4g} mm: "
        "the lengths do not belong together"
    ]


def _series(result: Comparison) -> tuple[list[Json], bool]:
    """One curve per group of rows, thinned for the screen."""
    task, rest = result.task, result.muscle.nominal_length
    pressure = task.state["pressure"]
    if task.channel == "length":
        length: NDArray | None = task.measured
    else:
        length = task.state.get("length")
    labels, thinned = np.unique(task.groups), False
    if len(labels) > _MAX_SERIES:
        labels, thinned = labels[:_MAX_SERIES], True
    series = []
    for number, label in enumerate(labels, 1):
        rows = np.flatnonzero(task.groups == label)
        held = _held(pressure[rows])
        name = _label(number, held, None if length is None else _held(length[rows]))
        if len(rows) > MAX_POINTS_PER_SERIES:
            rows, thinned = rows[np.linspace(0, len(rows) - 1, MAX_POINTS_PER_SERIES).astype(int)], True
        unknown = np.full(len(rows), np.nan)
        series.append(
            {
                "label": name,
                "pressure": held,
                "contraction": unknown if length is None else 1.0 - length[rows] / rest,
                "length": unknown if length is None else length[rows],
                "x_pressure": pressure[rows],
                "measured": task.measured[rows],
                "predicted": result.predicted[rows],
                "residual": result.residual[rows],
            }
        )
    return series, thinned


def _held(values: NDArray) -> float | None:
    """The level of a quantity that stays the same (within 3 %), else None."""
    level = float(np.mean(values))
    return level if np.ptp(values) <= 0.03 * abs(level) else None


def _label(number: int, pressure: float | None, length: float | None) -> str:
    if pressure is not None:
        return f"{pressure / 1e5:.3g} bar"
    return f"sweep {number}" if length is None else f"{length * 1e3:.4g} mm"
