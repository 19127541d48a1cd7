"""``mckibben diagnose``: which physical effect a model is missing."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

from mckibben.application.diagnose import prepare
from mckibben.application.diagnosis_result import DiagnosisResult
from mckibben.application.measurement_files import measurements_of
from mckibben.application.saved_model import saved_model
from mckibben.cli.model import model_question
from mckibben.cli.options import ModelOptions
from mckibben.cli.output import (
    check_folder,
    error_unit,
    figure,
    progress,
    remark,
    rows_of,
    write_experiment,
    write_json,
    write_parameters,
    write_table,
)
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.studio import Studio
from mckibben.measurement.experiment import ExperimentValue
from mckibben.measurement.read import Correction
from mckibben.physics.errors import InputError

_SHOWN = 8  # most candidates listed


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
) -> None:
    """Print the diagnosis, and write a report and the model if requested.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    if save is not None:
        check_folder(save, "--save")
    measurements = measurements_of(files, studio, correction, said)
    question = model_question(studio, measurements, model, free=free, noise=noise, strict=correction.strict)
    work = prepare(question, studio)
    with progress("trying effects") as watch:
        result = work(watch)
    if report is not None:
        from mckibben.cli.report import write

        write(report, studio, question, result)
    if save is not None:
        _save(save, saved_model(question, result, studio))
    if as_json:
        write_json(result)
        return
    _write(result)


def _save(path: Path, model: SavedModel) -> None:
    """Write a model, and print its path.

    Raises:
        InputError: the file cannot be written.
    """
    text = json.dumps(model.to_document(), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    try:
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise InputError(
            f"--save {path}: cannot be written: {error.strerror or error}", hint="name a file in a folder"
        ) from error
    remark(f"model: {path}")


def _write(result: DiagnosisResult) -> None:
    unit, scale = error_unit(result.unit)
    for assumption in result.assumptions:
        remark(assumption)
    write_experiment(result.specimens)

    def shown(value: float | None) -> str:
        return figure(None if value is None else value * scale, unit=f" {unit}")

    rows = [
        [
            step.added or ("start model" if number == 0 else "refitted"),
            shown(step.rmse),
            shown(step.holdout_rmse),
        ]
        for number, step in enumerate(result.path)
    ]
    rows.append(["noise floor", shown(result.noise_floor.rmse), result.noise_floor.how])
    title = f"Error of the predicted {result.predicted} ({result.kind}, {rows_of(result)})"
    write_table(title, ["after adding", "RMS error", "left-out groups"], rows)
    write_table(
        "One effect alone",
        ["effect", "RMS error", "gain", "indistinguishable from"],
        [
            [c.effect, shown(c.rmse), f"{c.gain_percent:.1f} %", ", ".join(c.twins)]
            for c in result.candidates[:_SHOWN]
        ],
    )
    write_parameters(result.parameters)
    remark(result.verdict.sentence)
    for experiment in result.verdict.experiments:
        first, second = experiment.pair
        remark(f"to distinguish {first} from {second}: {experiment.declared or experiment.protocol}")
    if result.verdict.proposed_term is not None:
        remark(f"proposed term: {result.verdict.proposed_term.formula}")
    for message in result.messages[len(result.assumptions) :]:
        remark(message)
    reasons: dict[str, list[str]] = {}
    for item in result.not_tried:
        reasons.setdefault(item.why, []).append(item.effect)
    for why, hidden in reasons.items():
        remark(f"not tried: {', '.join(hidden)} ({why})")
