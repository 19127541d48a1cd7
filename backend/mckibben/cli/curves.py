"""``mckibben curves``: the static characteristics of a muscle."""

from __future__ import annotations

from dataclasses import replace

from mckibben.application.curves import CurvesQuestion, curves
from mckibben.cli.options import ModelOptions, start_model
from mckibben.cli.output import write_json, write_summary
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.physics.units import si
from mckibben.report.summary.curves import summary_of

_MAX_PRESSURES = 12


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
    write_summary(summary_of(result, model.muscle))


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
