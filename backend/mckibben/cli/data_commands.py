"""The commands that read measurements: ``compare``, ``diagnose``, ``convert``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mckibben.cli.app import app
from mckibben.cli.options import (
    AsJson,
    DataFiles,
    EffectIds,
    Free,
    Ideal,
    Keep,
    ModelOptions,
    MuscleText,
    SavedModelFile,
    Use,
    Validate,
    with_shared_options,
)
from mckibben.physics.errors import InputError

if TYPE_CHECKING:
    from mckibben.application.measurement.files import FileOptions
    from mckibben.documents.studio import Studio


@app.command()
@with_shared_options
def compare(
    files: DataFiles,
    muscle: MuscleText = "",
    ideal: Ideal = False,
    effect: EffectIds = None,
    drive: str = typer.Option("", "--drive", help="A drive document (JSON file): its muscle and effects."),
    model: SavedModelFile = "",
    fit: bool = typer.Option(False, "--fit", help="Fit the parameters of the effects."),
    free: Free = None,
    tie: Annotated[
        list[str] | None,
        typer.Option(
            "--tie", metavar="A=B", help="Fitted constants that always have the value of another; repeatable."
        ),
    ] = None,
    profile: Annotated[
        str,
        typer.Option(
            "--profile", metavar="NAME", help="Show how well the data determine a fitted constant instead."
        ),
    ] = "",
    validate: Validate = None,
    use: Use = None,
    keep: Keep = None,
    *,
    reading: FileOptions,
    as_json: AsJson = False,
    studio: Studio,
) -> None:
    """Compare a model with measurements: the error in numbers, with or without a fit."""
    from mckibben.application.compare.compare import compared_whole
    from mckibben.cli.model import data_of, model_question
    from mckibben.cli.output import progress, write_json, write_summary
    from mckibben.identification.fit.profile import profile as constant_profile
    from mckibben.report.summary.comparison import summary_of
    from mckibben.report.summary.profile import summary_of as profile_summary

    chosen = ModelOptions(muscle, ideal, effect or (), drive, use or (), keep or (), model)
    with progress("fitting" if fit else "comparing"):
        measurements = data_of(files, studio, reading, chosen, validate=validate or ())
        question = model_question(
            studio,
            measurements,
            chosen,
            free=free or [],
            strict=reading.correction.strict,
            refit=fit or bool(profile),
        )
        whole = compared_whole(question, fit=fit or bool(profile), ties=_ties(tie or []))
        shown = constant_profile(whole.comparison, profile) if profile else None
    if as_json:
        write_json(shown or whole.result)
    else:
        write_summary(profile_summary(shown) if shown else summary_of(whole.result))


def _ties(texts: list[str]) -> dict[str, str]:
    """Constant -> the one that it follows, from "A=B".

    Raises:
        InputError: another form.
    """
    pairs = [text.partition("=") for text in texts]
    for text, (_, sign, _) in zip(texts, pairs, strict=True):
        if not sign:
            raise InputError(
                f"--tie {text}: is not of the form A=B",
                hint="--tie valve_delay.closing_time=valve_delay.opening_time",
            )
    return {follower.strip(): leader.strip() for follower, _, leader in pairs}


@app.command()
@with_shared_options
def diagnose(
    files: DataFiles,
    muscle: MuscleText = "",
    ideal: Ideal = False,
    effect: EffectIds = None,
    drive: str = typer.Option("", "--drive", help="A drive document (JSON): its muscle, effects, valve."),
    model: SavedModelFile = "",
    free: Free = None,
    validate: Validate = None,
    noise: Annotated[
        str | None,
        typer.Option("--noise", help='Noise of the predicted channel, if known, e.g. "2 N"; a number is SI.'),
    ] = None,
    report: Annotated[
        Path | None, typer.Option("--report", metavar="FILE", help="Also write an HTML report.")
    ] = None,
    save: Annotated[
        Path | None, typer.Option("--save", metavar="FILE", help="Also write the model found, for --model.")
    ] = None,
    save_preset: Annotated[
        str | None,
        typer.Option(
            "--save-preset", metavar="ID", help="Also keep the model found as a muscle of your own."
        ),
    ] = None,
    schedule: Annotated[
        Path | None,
        typer.Option(
            "--schedule", metavar="FILE", help="Also write the set points of the next experiment (CSV)."
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", metavar="FILE", help="Of a folder: also write the table of verdicts, .csv or .json."
        ),
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Of a folder: continue diagnoses of --out that were interrupted.")
    ] = False,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler",
            metavar="ADDRESS",
            help="Of a folder: a Dask scheduler, tcp://host:8786; else this computer.",
        ),
    ] = None,
    use: Use = None,
    keep: Keep = None,
    *,
    reading: FileOptions,
    as_json: AsJson = False,
    studio: Studio,
) -> None:
    """Which physical effect a model of measurements is missing, and what the data cannot distinguish.

    Of a folder: one line for each of its files, on this computer or on a cluster.
    """
    from mckibben.cli.diagnose import run
    from mckibben.cli.diagnose_folder import FolderOptions

    run(
        studio,
        files=files,
        model=ModelOptions(muscle, ideal, effect or (), drive, use or (), keep or (), model),
        free=free or [],
        validate=validate or [],
        noise=noise,
        reading=reading,
        as_json=as_json,
        report=report,
        save=save,
        save_preset=save_preset,
        schedule=schedule,
        folder=FolderOptions(out, resume, scheduler),
    )


@app.command()
@with_shared_options
def convert(
    file: Annotated[str, typer.Argument(metavar="DATA", help="A measurement file of any laboratory.")],
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", metavar="FILE", help="Write it there instead of printing it."),
    ] = None,
    *,
    reading: FileOptions,
) -> None:
    """A measurement file as the canonical CSV, with its conditions and where they stand."""
    from mckibben.application.measurement.convert import converted
    from mckibben.application.measurement.files import read_file
    from mckibben.application.text_file import write_text
    from mckibben.cli.model import at_option
    from mckibben.cli.output import check_written, progress, remark, standard_input
    from mckibben.measurement.preparation import prepared

    check_written(out, "--out", (".csv",))
    with progress("reading"):
        measurement = read_file(file, reading.correction, standard_input([file]))
        with at_option():
            measurement = prepared(measurement, reading.prepare)
        result = converted(measurement)
    if out is None:
        typer.echo(result.text, nl=False)
    else:
        write_text(out, result.text, named=f"--out {out}")
    for message in result.messages:
        remark(message)
