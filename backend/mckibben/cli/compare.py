"""``mckibben compare``: a model compared with measurements."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mckibben.application.compare import ComparisonResult, compare
from mckibben.application.measurement_files import measurements_of
from mckibben.cli.model import model_question
from mckibben.cli.options import ModelOptions
from mckibben.cli.output import (
    error_unit,
    figure,
    remark,
    rows_of,
    write_experiment,
    write_json,
    write_parameters,
    write_table,
)
from mckibben.documents.studio import Studio
from mckibben.measurement.experiment import ExperimentValue
from mckibben.measurement.read import Correction


def run(
    studio: Studio,
    *,
    files: Sequence[str],
    model: ModelOptions,
    fit: bool,
    free: Sequence[str],
    correction: Correction,
    said: Mapping[str, ExperimentValue],
    as_json: bool,
) -> None:
    """Print the comparison.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    measurements = measurements_of(files, studio, correction, said)
    question = model_question(studio, measurements, model, free=free, strict=correction.strict, refit=fit)
    result = compare(question, fit=fit)
    if as_json:
        write_json(result)
        return
    _write_tables(result)
    for message in (
        *result.messages[len(result.assumptions) :],
        *(notice.message for notice in result.flags),
    ):
        remark(message)


def _write_tables(result: ComparisonResult) -> None:
    unit, scale = error_unit(result.unit)
    for assumption in result.assumptions:
        remark(assumption)
    write_experiment(result.specimens)

    def shown(value: float | None) -> str:
        return figure(None if value is None else value * scale, unit=f" {unit}")

    write_table(
        f"Predicted {result.predicted} ({result.kind}, {rows_of(result)})",
        ["", "value"],
        [
            ["RMS error", shown(result.rmse)],
            ["RMS error of the largest value", figure(result.nrmse_percent, 3, " %")],
            ["RMS error with whole groups left out", shown(result.holdout_rmse)],
            ["mean error", shown(result.residual_mean)],
            ["noise floor", shown(result.noise_floor)],
        ],
    )
    for words in result.sentences:
        remark(words)
    write_parameters(result.parameters)
    for pair in result.correlations:
        remark(f"{pair.a} and {pair.b} are strongly correlated ({pair.value:.3f})")
