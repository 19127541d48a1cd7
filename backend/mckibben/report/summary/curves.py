"""Summary of the static characteristics of a muscle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mckibben.application.curves.curves import CurvesResult, Lift
from mckibben.facts.muscle import CHARACTERISTICS, CURVES, LIFT
from mckibben.report.summary import Summary, Table, figure, shown

_TABLE_ROWS = 11
_STIFFNESS = ("stiffness", "stiffness_closed", "stiffness_from_force", "stiffness_secant")
_PER_PRESSURE = [name for name in CHARACTERISTICS if name != "pressure"]


def summary_of(result: CurvesResult, muscle: str) -> Summary:
    """Force over contraction, figures per pressure, notices.

    Args:
        result: the curves.
        muscle: name of the muscle, for the title.
    """
    pressures = [shown(CURVES["pressure"], value) for value in result.pressure]
    chosen = np.unique(np.linspace(0, len(result.contraction) - 1, _TABLE_ROWS).astype(int))
    per_pressure = Table(
        f"{CHARACTERISTICS.title} {result.branch}",
        [CHARACTERISTICS["pressure"].label, *(CHARACTERISTICS[name].label for name in _PER_PRESSURE)],
        [
            [name, *(shown(CHARACTERISTICS[each], getattr(item, each)) for each in _PER_PRESSURE)]
            for name, item in zip(pressures, result.characteristics, strict=True)
        ],
    )
    sure = []
    if result.interval is not None:
        half = float(np.nanmedian(result.interval.high - result.force))
        sure.append(
            f"{100.0 * result.interval.share:.0f} % of new readings lie within about ±{half:.3g} N "
            "of a curve (median of all curves), where the model was measured"
        )
    return [
        _along(
            result, chosen, f"Force of {muscle} {result.branch}",
            dict(zip(pressures, result.force, strict=True)), "force",
        ),
        per_pressure,
        *_stiffness(result, muscle, chosen),
        *sure,
        *dict.fromkeys(filter(None, (item.free_contraction_note for item in result.characteristics))),
        *(notice.message for notice in result.flags),
    ]  # fmt: skip


def lift_summary_of(lift: Lift, muscle: str) -> Summary:
    """What the muscle does with a load at one pressure, a row a figure, with its definition.

    Args:
        lift: the answer.
        muscle: name of the muscle, for the title.
    """
    values = {name: getattr(lift, name) for name in LIFT}
    rows = [
        [LIFT[name].label, shown(LIFT[name], value), LIFT[name].definition]
        for name, value in values.items()
        if value is not None
    ]
    title = f"{muscle}: {shown(LIFT['load'], lift.load)} at {shown(LIFT['pressure'], lift.pressure)}"
    return [Table(title, ["figure", "value", "definition"], rows), *(notice.message for notice in lift.flags)]


def _stiffness(result: CurvesResult, muscle: str, chosen: NDArray[np.intp]) -> list[Table]:
    """The stiffness by all its definitions at the highest pressure, where it was asked for."""
    if result.stiffness_from_force is None:
        return []
    top = int(np.argmax(result.pressure))
    columns = {CURVES[name].label: getattr(result, name)[top] for name in _STIFFNESS}
    at = shown(CURVES["pressure"], result.pressure[top])
    return [_along(result, chosen, f"Stiffness of {muscle} at {at} {result.branch}", columns, "stiffness")]


def _along(
    result: CurvesResult,
    chosen: NDArray[np.intp],
    title: str,
    columns: dict[str, NDArray[np.float64]],
    what: str,
) -> Table:
    """Columns of one figure over contraction and length."""
    scale, along = CURVES[what].scale, ("contraction", "length")
    return Table(
        f"{title} [{scale.unit}]",
        [*(CURVES[name].label for name in along), *columns],
        [
            [
                *(shown(CURVES[name], getattr(result, name)[index]) for name in along),
                *(figure(scale.of(values[index])) for values in columns.values()),
            ]
            for index in chosen
        ],
    )
