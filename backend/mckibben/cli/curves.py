"""``mckibben curves``: the static characteristics of a muscle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mckibben.application.curves import CurvesQuestion, CurvesResult, curves
from mckibben.cli.options import ModelOptions, start_model
from mckibben.cli.output import figure, remark, write_json, write_table
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.physics.units import si

_MAX_PRESSURES = 12
_TABLE_ROWS = 11


def run(
    studio: Studio,
    *,
    model: ModelOptions,
    pressure: str | None,
    as_json: bool,
) -> None:
    """Print the curves.

    Raises:
        InputError: an option cannot be used.
    """
    start = start_model(studio, model)
    question = CurvesQuestion(start)
    if pressure is not None:
        question = replace(question, pressures=_pressures(pressure))
    result = curves(question, studio)
    if as_json:
        write_json(result)
        return
    _write_tables(model.muscle, result)
    for notice in result.flags:
        remark(notice.message)


def _pressures(text: str) -> tuple[float, ...]:
    """ "1 bar,3 bar" in Pa."""
    parts = [part.strip() for part in text.split(",")]
    if len(parts) > _MAX_PRESSURES:
        raise InputError(f"--pressure: {len(parts)} pressures, at most {_MAX_PRESSURES} are possible")
    values = []
    for part in parts:
        try:
            value = si(part, "Pa", reference="gauge")
        except InputError as error:
            raise InputError(f"--pressure: {error.message}", hint='e.g. --pressure "1 bar,3 bar"') from error
        if not 0.0 <= value <= 1e8:
            raise InputError(f"--pressure: {part} is not between 0 and 1000 bar", hint="gauge pressures")
        values.append(value)
    return tuple(values)


def _write_tables(muscle: str, result: CurvesResult) -> None:
    bars = [f"{value / 1e5:g} bar" for value in result.pressure]
    chosen = np.unique(np.linspace(0, len(result.contraction) - 1, _TABLE_ROWS).astype(int))
    write_table(
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
    write_table(
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
