"""The commands of drives and models: ``simulate``, ``linearise``, ``size``, ``export``, ``study``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mckibben.cli.app import app
from mckibben.cli.options import (
    AsJson,
    DriveFile,
    Exported,
    ExportFile,
    ExportFormat,
    with_shared_options,
)
from mckibben.physics.errors import InputError

if TYPE_CHECKING:
    from mckibben.documents.studio import Studio

At = Annotated[
    str | None,
    typer.Option(
        "--at",
        help='Operating point: "position 40 mm", "contraction 10 %", "pressure 3 bar" or, of a regulator, '
        '"command 50 %". Default: the middle of the positions that can be held.',
    ),
]
Source = Annotated[str, typer.Option("--input", help="command, supply_pressure or load_force.")]
Output = Annotated[
    str, typer.Option("--output", help="position, velocity, pressure, force, mass_flow or position_reading.")
]
Amplitudes = Annotated[
    str | None,
    typer.Option("--amplitudes", help='Sines for the nonlinear drive, e.g. "1 %,20 %"; "none" for no sweep.'),
]
DesignGoals = Annotated[
    str | None,
    typer.Option(
        "--design",
        help='Also design a position controller, e.g. "overshoot 5 %, settling 0.5 s, step 10 mm, '
        'no saturation".',
    ),
]


@app.command()
@with_shared_options
def simulate(
    drive: DriveFile,
    out: Annotated[Path | None, typer.Option("--out", metavar="FILE", help="Write the run as CSV.")] = None,
    as_json: AsJson = False,
    *,
    studio: Studio,
) -> None:
    """Simulate a drive: timing table, trace, limits."""
    from mckibben.cli.simulate import run

    run(studio, drive=drive, out=out, as_json=as_json)


@app.command()
@with_shared_options
def linearise(
    drive: DriveFile,
    at: At = None,
    source: Source = "command",
    output: Output = "position",
    amplitudes: Amplitudes = None,
    design: DesignGoals = None,
    as_json: AsJson = False,
    *,
    studio: Studio,
) -> None:
    """Linear models of a drive: poles, Bode, margins, sweep of the nonlinear drive, controller design."""
    from mckibben.cli.linearise import Wanted, run

    wanted = Wanted(at, source, output, amplitudes, design)
    run(studio, drive=drive, wanted=wanted, as_json=as_json)


@app.command()
@with_shared_options
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
    *,
    studio: Studio,
) -> None:
    """From a task to ranked drives from the catalogue, with the reasons against the others."""
    from mckibben.cli.size import Wanted, run

    if report is None and (proposal is not None or title):
        option = "--title" if proposal is None else "--proposal"
        raise InputError(f"{option} belongs to a report, and none is requested", hint="--report FILE")
    wanted = None if report is None else Wanted(report, proposal or 1, title)
    run(studio, task=task, as_json=as_json, report=wanted)


@app.command()
@with_shared_options
def export(
    source: Exported,
    format_id: ExportFormat,
    out: ExportFile,
    *,
    studio: Studio,
) -> None:
    """Take a model or drive along: FMU, source code, lookup tables, equations, JSON."""
    from mckibben.cli.export import run

    run(studio, source=source, format_id=format_id, out=out)


@app.command()
@with_shared_options
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
    *,
    studio: Studio,
) -> None:
    """Many runs of a drive or task: sweeps, Monte Carlo, sensitivities, optimisation, robust designs."""
    from mckibben.cli.study import run

    run(
        studio,
        study=study,
        out=out,
        resume=resume,
        scheduler=scheduler,
        chunk=chunk,
        as_json=as_json,
    )
