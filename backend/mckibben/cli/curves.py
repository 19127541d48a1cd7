"""``mckibben curves``: the static characteristics of a muscle."""

from __future__ import annotations

from dataclasses import replace

from mckibben.application.curves.curves import CurvesQuestion, curves, pressures_of
from mckibben.cli.options import ModelOptions, start_model
from mckibben.cli.output import write_json, write_summary
from mckibben.documents.studio import Studio
from mckibben.report.summary.curves import summary_of


def run(
    studio: Studio,
    *,
    model: ModelOptions,
    pressure: str | None,
    stiffness: bool,
    as_json: bool,
) -> None:
    """Print the curves.

    Raises:
        InputError: an option cannot be used.
    """
    start = start_model(studio, model)
    question = CurvesQuestion(start, further_stiffness=stiffness)
    if pressure is not None:
        question = replace(question, pressures=pressures_of(pressure.split(","), "--pressure"))
    result = curves(question, studio)
    if as_json:
        write_json(result)
        return
    write_summary(summary_of(result, model.muscle or model.model))
