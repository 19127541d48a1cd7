"""``mckibben compare``: a model compared with measurements."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mckibben.application.compare.compare import compare
from mckibben.application.measurement.files import measurements_of
from mckibben.cli.model import model_question, muscle_length
from mckibben.cli.options import ModelOptions
from mckibben.cli.output import progress, standard_input, write_json, write_summary
from mckibben.documents.studio import Studio
from mckibben.measurement.experiment import ExperimentValue
from mckibben.measurement.read import Correction
from mckibben.report.summary.comparison import summary_of


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
    with progress("fitting" if fit else "comparing"):
        measurements = measurements_of(
            files, studio, correction, said, contents=standard_input(files),
            muscle_length=muscle_length(studio, model),
        )  # fmt: skip
        question = model_question(studio, measurements, model, free=free, strict=correction.strict, refit=fit)
        result = compare(question, fit=fit)
    if as_json:
        write_json(result)
        return
    write_summary(summary_of(result))
