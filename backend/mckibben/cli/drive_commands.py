"""The commands of drives and models: ``simulate``, ``linearise``, ``size``, ``export``, ``study``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mckibben.cli.app import app
from mckibben.cli.linear_options import Amplitudes, At, DesignGoals, Output, SlidingSpeed, Source
from mckibben.cli.options import (
    AsJson,
    DataFolder,
    DriveFile,
    EffectsFolders,
    Exported,
    ExportFile,
    ExportFormat,
    PresetsFolder,
)
from mckibben.physics.errors import InputError


@app.command()
def simulate(
    drive: DriveFile,
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
def linearise(
    drive: DriveFile,
    at: At = None,
    source: Source = "command",
    output: Output = "position",
    amplitudes: Amplitudes = None,
    design: DesignGoals = None,
    sliding_speed: SlidingSpeed = None,
    as_json: AsJson = False,
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """Linear models of a drive: poles, Bode, margins, sweep of the nonlinear drive, controller design."""
    from mckibben.cli.linearise import Wanted, run
    from mckibben.cli.options import open_studio

    wanted = Wanted(at, source, output, amplitudes, design, sliding_speed)
    run(open_studio(presets, effects, data), drive=drive, wanted=wanted, as_json=as_json)


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
        str,
        typer.Option(
            "--title", help="Name beside the figures of the task in the heading. Default: that of the task."
        ),
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
def export(
    source: Exported,
    format_id: ExportFormat,
    out: ExportFile,
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """Take a model or drive along: FMU, source code, lookup tables, equations, JSON."""
    from mckibben.cli.export import run
    from mckibben.cli.options import open_studio

    run(open_studio(presets, effects, data), source=source, format_id=format_id, out=out)


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
    chunk: Annotated[
        int | None,
        typer.Option(
            "--chunk", min=1, max=100_000, metavar="RUNS", help="Runs in a message to a worker; default 64."
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
        chunk=chunk,
        as_json=as_json,
    )
