"""``mckibben diagnose``: which physical effect a model is missing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from mckibben.application.diagnose import prepare
from mckibben.application.measurement_files import measurements_of
from mckibben.application.next_experiment import NO_EXPERIMENT, schedule_csv
from mckibben.application.saved_model import model_text, saved_model
from mckibben.cli.model import model_question
from mckibben.cli.options import ModelOptions
from mckibben.cli.output import check_folder, progress, remark, write_file, write_json, write_summary
from mckibben.documents.studio import Studio
from mckibben.measurement.experiment import ExperimentValue
from mckibben.measurement.read import Correction
from mckibben.report.summary.diagnosis import summary_of


def run(
    studio: Studio,
    *,
    files: Sequence[str],
    model: ModelOptions,
    free: Sequence[str],
    noise: float | None,
    correction: Correction,
    said: Mapping[str, ExperimentValue],
    as_json: bool,
    report: Path | None = None,
    save: Path | None = None,
    schedule: Path | None = None,
) -> None:
    """Print the diagnosis, and write a report, the model and the next experiment if requested.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    if save is not None:
        check_folder(save, "--save")
    if schedule is not None:
        check_folder(schedule, "--schedule")
    measurements = measurements_of(files, studio, correction, said)
    question = model_question(studio, measurements, model, free=free, noise=noise, strict=correction.strict)
    work = prepare(question, studio)
    with progress("trying effects") as watch:
        result = work(watch)
    if report is not None:
        from mckibben.cli.report import write

        write(report, studio, question, result)
    if save is not None:
        write_file(save, "--save", "model", model_text(saved_model(question, result, studio)))
    if schedule is not None:
        designed = result.verdict.next_experiments
        if designed:
            write_file(schedule, "--schedule", "set points", schedule_csv(designed[0]))
        else:
            remark(f"--schedule {schedule}: not written, because {NO_EXPERIMENT}")
    if as_json:
        write_json(result)
        return
    write_summary(summary_of(result))
