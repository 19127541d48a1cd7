"""The commands that read measurements: ``compare``, ``diagnose``, ``convert``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mckibben.cli.app import app
from mckibben.cli.options import (
    AsJson,
    DataFiles,
    DataFolder,
    EffectIds,
    EffectsFolders,
    Free,
    Ideal,
    Keep,
    ModelOptions,
    MuscleText,
    PresetsFolder,
    SavedModelFile,
    Use,
)

Sheet = Annotated[
    str | None, typer.Option("--sheet", metavar="NAME", help="Sheet, group or struct with the measurement.")
]
Head = Annotated[
    int | None, typer.Option("--head", metavar="ROW", help="Row of the column names, counted from 1.")
]
Columns = Annotated[
    list[str] | None,
    typer.Option(
        "--column",
        metavar="C=NAME",
        help='What a column is, e.g. "force=-Kraft [kN]": sign and unit; repeatable.',
    ),
]
Ignored = Annotated[
    list[str] | None,
    typer.Option("--ignore", metavar="NAME", help="A column that is not wanted; repeatable."),
]
RestLength = Annotated[
    str | None,
    typer.Option("--rest-length", help='Length of the muscle without air and load, e.g. "300 mm".'),
]
Load = Annotated[str | None, typer.Option("--load", help='Mass or force on the muscle, e.g. "6 kg".')]
Supply = Annotated[str | None, typer.Option("--supply", help='Supply pressure, gauge, e.g. "6 bar".')]
Accuracy = Annotated[
    str | None,
    typer.Option(
        "--accuracy", help='Standard deviation by channel, e.g. "length 1 mm, force 0.5 %", or a sensor.'
    ),
]
Experiment = Annotated[
    list[str] | None,
    typer.Option(
        "--experiment",
        metavar="FIELD=VALUE",
        help='More about the test, e.g. "force_zero=2.5 N" or "inclination=45 deg"; repeatable.',
    ),
]
Strict = Annotated[
    bool, typer.Option("--strict", help="Refuse a file instead of assuming what it does not say.")
]


@app.command()
def compare(
    files: DataFiles,
    muscle: MuscleText = "",
    ideal: Ideal = False,
    effect: EffectIds = None,
    drive: str = typer.Option("", "--drive", help="A drive document (JSON file): its muscle and effects."),
    model: SavedModelFile = "",
    fit: bool = typer.Option(False, "--fit", help="Fit the parameters of the effects."),
    free: Free = None,
    use: Use = None,
    keep: Keep = None,
    sheet: Sheet = None,
    head: Head = None,
    column: Columns = None,
    ignore: Ignored = None,
    rest_length: RestLength = None,
    load: Load = None,
    supply: Supply = None,
    accuracy: Accuracy = None,
    experiment: Experiment = None,
    strict: Strict = False,
    as_json: AsJson = False,
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """Compare a model with measurements: the error in numbers, with or without a fit."""
    from mckibben.application.measurement.files import file_options
    from mckibben.cli.compare import run
    from mckibben.cli.options import open_studio

    options = file_options(
        sheet=sheet,
        head=head,
        columns=column,
        ignored=ignore,
        rest_length=rest_length,
        load=load,
        supply=supply,
        accuracy=accuracy,
        experiment=experiment,
        strict=strict,
    )
    run(
        open_studio(presets, effects, data),
        files=files,
        model=ModelOptions(muscle, ideal, effect or (), drive, use or (), keep or (), model),
        fit=fit,
        free=free or [],
        correction=options.correction,
        said=options.said,
        as_json=as_json,
    )


@app.command()
def diagnose(
    files: DataFiles,
    muscle: MuscleText = "",
    ideal: Ideal = False,
    effect: EffectIds = None,
    drive: str = typer.Option("", "--drive", help="A drive document (JSON): its muscle, effects, valve."),
    model: SavedModelFile = "",
    free: Free = None,
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
    sheet: Sheet = None,
    head: Head = None,
    column: Columns = None,
    ignore: Ignored = None,
    rest_length: RestLength = None,
    load: Load = None,
    supply: Supply = None,
    accuracy: Accuracy = None,
    experiment: Experiment = None,
    strict: Strict = False,
    as_json: AsJson = False,
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """Which physical effect a model of measurements is missing, and what the data cannot distinguish.

    Of a folder: one line for each of its files, on this computer or on a cluster.
    """
    from mckibben.application.measurement.files import file_options
    from mckibben.cli.diagnose import run
    from mckibben.cli.diagnose_folder import FolderOptions
    from mckibben.cli.options import open_studio

    options = file_options(
        sheet=sheet,
        head=head,
        columns=column,
        ignored=ignore,
        rest_length=rest_length,
        load=load,
        supply=supply,
        accuracy=accuracy,
        experiment=experiment,
        strict=strict,
    )
    run(
        open_studio(presets, effects, data),
        files=files,
        model=ModelOptions(muscle, ideal, effect or (), drive, use or (), keep or (), model),
        free=free or [],
        noise=noise,
        correction=options.correction,
        said=options.said,
        as_json=as_json,
        report=report,
        save=save,
        save_preset=save_preset,
        schedule=schedule,
        folder=FolderOptions(out, resume, scheduler),
    )


@app.command()
def convert(
    file: Annotated[str, typer.Argument(metavar="DATA", help="A measurement file of any laboratory.")],
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", metavar="FILE", help="Write it there instead of printing it."),
    ] = None,
    sheet: Sheet = None,
    head: Head = None,
    column: Columns = None,
    ignore: Ignored = None,
    rest_length: RestLength = None,
    load: Load = None,
    supply: Supply = None,
    accuracy: Accuracy = None,
    experiment: Experiment = None,
    strict: Strict = False,
) -> None:
    """A measurement file as the canonical CSV, with its conditions and where they stand."""
    from mckibben.application.measurement.files import file_options
    from mckibben.cli.convert import run

    options = file_options(
        sheet=sheet,
        head=head,
        columns=column,
        ignored=ignore,
        rest_length=rest_length,
        load=load,
        supply=supply,
        accuracy=accuracy,
        experiment=experiment,
        strict=strict,
    )
    run(
        file=file,
        correction=options.correction,
        out=out,
    )
