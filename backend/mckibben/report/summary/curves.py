"""Summary of the static characteristics of a muscle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mckibben.application.curves.curves import CurvesResult
from mckibben.report.summary.parts import Summary, Table, figure

_TABLE_ROWS = 11


def summary_of(result: CurvesResult, muscle: str) -> Summary:
    """Force over contraction, figures per pressure, notices.

    Args:
        result: the curves.
        muscle: name of the muscle, for the title.
    """
    bars = [f"{value / 1e5:g} bar" for value in result.pressure]
    chosen = np.unique(np.linspace(0, len(result.contraction) - 1, _TABLE_ROWS).astype(int))
    force = Table(
        f"Force of {muscle} [N]",
        ["contraction", "length", *bars],
        [
            [
                f"{result.contraction[index] * 100:.1f} %",
                f"{result.length[index] * 1e3:.1f} mm",
                *(figure(row[index]) for row in result.force),
            ]
            for index in chosen
        ],
    )
    per_pressure = Table(
        "Per pressure",
        ["pressure", "blocked force", "free contraction", "work of a stroke"],
        [
            [
                name,
                figure(item.blocked_force, unit=" N"),
                figure(item.free_contraction * 100, unit=" %"),
                figure(item.max_work, unit=" J"),
            ]
            for name, item in zip(bars, result.characteristics, strict=True)
        ],
    )
    stiffness = _stiffness(result, muscle, chosen)
    sure = []
    if result.interval is not None:
        half = float(np.nanmedian(result.interval.high - result.force))
        sure.append(
            f"{100.0 * result.interval.share:.0f} % of new readings lie within about ±{half:.3g} N "
            "of a curve, where the model was measured"
        )
    return [force, per_pressure, *stiffness, *sure, *(notice.message for notice in result.flags)]


def _stiffness(result: CurvesResult, muscle: str, chosen: NDArray[np.intp]) -> list[Table]:
    """The stiffness by all its definitions at the highest pressure, where it was asked for."""
    if result.stiffness_from_force is None or result.stiffness_secant is None:
        return []
    top = int(np.argmax(result.pressure))
    columns = {
        "dF/dL": result.stiffness,
        "valve closed": result.stiffness_closed,
        "of the force (20)": result.stiffness_from_force,
        "secant (25)": result.stiffness_secant,
    }
    return [
        Table(
            f"Stiffness of {muscle} at {result.pressure[top] / 1e5:g} bar [N/mm]",
            ["contraction", "length", *columns],
            [
                [
                    f"{result.contraction[index] * 100:.1f} %",
                    f"{result.length[index] * 1e3:.1f} mm",
                    *(figure(rows[top][index] * 1e-3) for rows in columns.values()),
                ]
                for index in chosen
            ],
        )
    ]
