"""``mckibben diagnose``: which physical effect a model is missing."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.diagnose.diagnose import prepare
from mckibben.application.diagnose.next_experiment import NO_EXPERIMENT, schedule_csv
from mckibben.application.measurement.files import FileOptions
from mckibben.application.model.saved import keep, model_text, saved_model
from mckibben.application.text_file import HTML
from mckibben.cli.diagnose_folder import FolderOptions, run_folder
from mckibben.cli.model import data_of, model_question
from mckibben.cli.options import ModelOptions
from mckibben.cli.output import (
    check_written,
    progress,
    remark,
    write_file,
    write_json,
    write_summary,
)
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.report.summary.diagnosis import summary_of


def run(
    studio: Studio,
    *,
    files: Sequence[str],
    model: ModelOptions,
    free: Sequence[str],
    validate: Sequence[str],
    noise: str | None,
    reading: FileOptions,
    as_json: bool,
    report: Path | None = None,
    save: Path | None = None,
    save_preset: str | None = None,
    schedule: Path | None = None,
    folder: FolderOptions | None = None,
) -> None:
    """Print the diagnosis, and write a report, the model and the next experiment if requested.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """

    def asked(names: Sequence[str]) -> ModelQuestion:
        measurements = data_of(names, studio, reading, model, validate=validate)
        strict = reading.correction.strict
        return model_question(studio, measurements, model, free=free, noise=noise, strict=strict)

    if any(Path(name).is_dir() for name in files):
        writes = {"--report": report, "--save": save, "--save-preset": save_preset, "--schedule": schedule}
        wanted = (
            model, tuple(free), noise, reading.correction, dict(reading.said), reading.prepare,
            tuple(validate),
        )  # fmt: skip
        run_folder(
            files, lambda name: asked([name]), studio, wanted, folder or FolderOptions(), as_json, writes
        )
        return
    if folder is not None:
        folder.refuse(files)
    check_written(report, "--report", HTML)
    check_written(save, "--save", (".json",))
    check_written(schedule, "--schedule", (".csv",))
    question = asked(files)
    work = prepare(question, studio)
    with progress("trying effects") as watch:
        result = work(watch)
    if report is not None:
        from mckibben.report.diagnosis.gather import ReportOptions, report_of

        text = report_of(question, studio, ReportOptions(), result)
        write_file(report, "--report", "report", text)
    if save_preset is not None:
        _keep(saved_model(question, result, studio), studio, save_preset)
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


def _keep(saved: SavedModel, studio: Studio, preset_id: str) -> None:
    """Keep the model as a preset, and say how it is used.

    Raises:
        InputError: the id cannot be used, or the model cannot be a preset.
    """
    try:
        preset = keep(saved, studio, id=preset_id)
    except InputError as error:
        raise InputError(
            f"--save-preset {preset_id}: {error.message}", hint=error.hint, code=error.code
        ) from error
    remark(f"kept as {preset.id}: use it with --muscle {preset.id}, in sizing tasks and in the page")
