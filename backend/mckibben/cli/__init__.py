"""The command line: ``mckibben`` alone starts the studio; the other commands work without a browser.

Exit 0: done. Exit 2: the input cannot be used; one line on stderr says where, what is wrong and what would be
right. Each command is a module, imported only when it runs.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

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
from mckibben.cli.reading import (
    Accuracy,
    Columns,
    Experiment,
    Head,
    Ignored,
    Load,
    RestLength,
    Sheet,
    Strict,
    Supply,
)
from mckibben.cli.running import run_app
from mckibben.physics.errors import InputError
from mckibben.version import __version__

__all__ = ["app", "main"]

app = typer.Typer(
    name="mckibben",
    help="Design studio for pneumatic (McKibben) muscles. Without a command: serve.",
    add_completion=False,
    no_args_is_help=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"mckibben {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: bool = typer.Option(
        False, "--version", callback=_show_version, is_eager=True, help="Show the version."
    ),
) -> None:
    """Design studio for pneumatic (McKibben) muscles. Without a command: serve."""


@app.command()
def serve(
    host: str = typer.Option(
        "127.0.0.1", help="Address to listen on; any address but loopback requires a token."
    ),
    port: int | None = typer.Option(
        None, min=0, max=65535, help="Port; 0 = any free port. Default: 8000, or the next free one."
    ),
    no_open: bool = typer.Option(False, "--no-open", help="Do not open the browser."),
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """Start the studio and open it in the browser."""
    from mckibben.cli.serve import run

    run(host=host, port=port, open_browser=not no_open, presets=presets, effects=effects or [], data=data)


@app.command()
def curves(
    muscle: MuscleText = "",
    ideal: Ideal = False,
    effect: EffectIds = None,
    model: SavedModelFile = "",
    pressure: str | None = typer.Option(
        None, help='Gauge pressures, e.g. "1 bar,3 bar"; 1 to 6 bar when left out.'
    ),
    as_json: AsJson = False,
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """Force, stiffness, volume and diameter of a muscle over its contraction."""
    from mckibben.cli.curves import run
    from mckibben.cli.options import open_studio

    run(
        open_studio(presets, effects, data),
        model=ModelOptions(muscle, ideal, effect or (), model=model),
        pressure=pressure,
        as_json=as_json,
    )


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
    from mckibben.application.file_options import file_options
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
    drive: str = typer.Option(
        "", "--drive", help="A drive document (JSON file): its muscle, effects, valve."
    ),
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
    """Which physical effect a model of measurements is missing, and what the data cannot distinguish."""
    from mckibben.application.file_options import file_options
    from mckibben.cli.diagnose import run
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
    from mckibben.application.file_options import file_options
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


@app.command()
def simulate(
    drive: Annotated[
        str, typer.Argument(metavar="DRIVE", help="A drive document (JSON file) or the id of a preset.")
    ],
    out: Annotated[Path | None, typer.Option("--out", metavar="FILE", help="Write the run as CSV.")] = None,
    as_json: AsJson = False,
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """Simulate a drive: timing table, trace, limits."""
    from mckibben.cli.options import open_studio
    from mckibben.cli.simulate import run

    run(open_studio(presets, effects, data), drive=drive, out=out, as_json=as_json)


@app.command()
def size(
    task: Annotated[str, typer.Argument(metavar="TASK", help="A sizing task (JSON file).")],
    report: Annotated[
        Path | None, typer.Option("--report", metavar="FILE", help="Also write an HTML report of one drive.")
    ] = None,
    proposal: Annotated[
        int | None, typer.Option("--proposal", min=1, help="Rank of the drive in the report; 1 is the best.")
    ] = None,
    title: Annotated[
        str, typer.Option("--title", help="Title of the report. Default: that of the task.")
    ] = "",
    as_json: AsJson = False,
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """From a task to ranked drives from the catalogue, with the reasons against the others."""
    from mckibben.cli.options import open_studio
    from mckibben.cli.size import Wanted, run

    if report is None and (proposal is not None or title):
        option = "--title" if proposal is None else "--proposal"
        raise InputError(f"{option} belongs to a report, and none is requested", hint="--report FILE")
    wanted = None if report is None else Wanted(report, proposal or 1, title)
    run(open_studio(presets, effects, data), task=task, as_json=as_json, report=wanted)


@app.command()
def study(
    study: Annotated[str, typer.Argument(metavar="STUDY", help="A study (JSON file).")],
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", metavar="FILE", help="Write the table as .csv or .parquet, the result as .json."
        ),
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue a study of --out that was interrupted.")
    ] = False,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler", metavar="ADDRESS", help="A Dask scheduler, tcp://host:8786; else this computer."
        ),
    ] = None,
    as_json: AsJson = False,
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """Many runs of a drive or task: sweeps, Monte Carlo, sensitivities, optimisation, robust designs."""
    from mckibben.cli.options import open_studio
    from mckibben.cli.study import run

    run(
        open_studio(presets, effects, data),
        study=study,
        out=out,
        resume=resume,
        scheduler=scheduler,
        as_json=as_json,
    )


def run(arguments: list[str]) -> int:
    """Run one command line; the exit code."""
    return run_app(app, arguments)


def main() -> None:
    """Entry point of the console script."""
    sys.exit(run(sys.argv[1:]))
