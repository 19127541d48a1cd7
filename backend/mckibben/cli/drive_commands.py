"""The commands of drives and models: ``simulate``, ``linearise``, ``size``, ``export``, ``study``."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import contextmanager
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
from mckibben.documents.located import at_file, located
from mckibben.physics.errors import InputError

if TYPE_CHECKING:
    from mckibben.application.size.size import Searched
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
SlidingSpeed = Annotated[
    str | None,
    typer.Option(
        "--sliding-speed",
        help="Speed of the load at which models that slide against dry friction have the slopes of friction "
        'and damping, e.g. "20 mm/s". Default: they just slide.',
    ),
]
DesignGoals = Annotated[
    str | None,
    typer.Option(
        "--design",
        help='Also design a position controller, e.g. "overshoot 5 %, settling 0.5 s, step 10 mm, '
        'no saturation".',
    ),
]

# Fields of a question about the linear view that are options.
#: Exit code of a sizing that finds no drive.
NO_DRIVE = 3
_LINEAR_OPTIONS = ("at", "input", "output", "amplitudes", "design", "sliding_speed")


@app.command()
@with_shared_options
def simulate(
    drive: DriveFile,
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="FILE", help="Write the run: .csv its rows, .json all of it."),
    ] = None,
    as_json: AsJson = False,
    *,
    studio: Studio,
) -> None:
    """Simulate a drive: timing table, trace, limits."""
    from mckibben.application.json_text import answer_json
    from mckibben.application.run.simulate import SimulationQuestion, trace_text
    from mckibben.application.run.simulate import simulate as simulate_drive
    from mckibben.application.text_file import write_text
    from mckibben.cli.output import check_written, remark, write_json, write_summary
    from mckibben.documents.drive_reading import drive_of, named_document
    from mckibben.report.summary.simulation import notices, summary_of

    check_written(out, "--out", (".csv", ".json"))
    document = named_document(drive, studio)
    with _errors_of(drive):
        annotated = drive_of(document, studio)
        result = simulate_drive(SimulationQuestion(annotated))
    if out is not None:
        whole = out.suffix.lower() == ".json"
        text = answer_json(result).decode() + "\n" if whole else trace_text(result)
        write_text(out, text, named=f"--out {out}")
    if not as_json:
        write_summary(summary_of(result, document.named(drive)))
        return
    write_json(result)
    for sentence in notices(result):
        remark(sentence)


@app.command()
@with_shared_options
def linearise(
    drive: DriveFile,
    at: At = None,
    source: Source = "command",
    output: Output = "position",
    amplitudes: Amplitudes = None,
    design: DesignGoals = None,
    sliding_speed: SlidingSpeed = None,
    as_json: AsJson = False,
    *,
    studio: Studio,
) -> None:
    """Linear models of a drive: poles, Bode, margins, sweep of the nonlinear drive, controller design."""
    from mckibben.application.linear.linearise import LinearQuestion, condition_of, goals_of, linear_view
    from mckibben.cli.output import progress, write_json, write_summary
    from mckibben.documents.drive_reading import drive_of, named_document
    from mckibben.physics.units import si
    from mckibben.report.summary.linear import summary_of
    from mckibben.simulation.linear.bound import SLIDING_SPEED

    try:
        point = None if at is None else condition_of(at)
        goals = None if design is None else goals_of(design)
        sines = None if amplitudes is None else _amplitudes(amplitudes, source)
        speed = SLIDING_SPEED if sliding_speed is None else si(sliding_speed, "m/s", field="sliding_speed")
    except InputError as error:
        raise InputError(f"{_option(error.field)} {error.message}", hint=error.hint) from error
    document = named_document(drive, studio)
    with _errors_of(drive, _LINEAR_OPTIONS):
        annotated = drive_of(document, studio, measured=True)
        question = LinearQuestion(
            annotated, at=point, input=source, output=output, amplitudes=sines, goals=goals,
            sliding_speed=speed,
        )  # fmt: skip
        with progress("linearising") as watch:
            result = linear_view(question, watch)
    if as_json:
        write_json(result)
    else:
        write_summary(summary_of(result, document.named(drive)))


def _amplitudes(text: str, source: str) -> tuple[float, ...]:
    """Amplitudes of sines; "none" for no sweep."""
    from mckibben.physics.units import si

    if text.strip().lower() == "none":
        return ()
    unit = "N" if source == "load_force" else "1"
    return tuple(si(part.strip(), unit, field="amplitudes") for part in text.split(","))


def _option(field: str | None) -> str:
    """The option that a field of the question is."""
    return f"--{(field or '').replace('_', '-')}"


@contextmanager
def _errors_of(source: str, options: Collection[str] = ()) -> Iterator[None]:
    """Errors name the file, and the field in it or the option."""
    try:
        yield
    except InputError as error:
        place = f"{_option(error.field)}: {error.message}" if error.field in options else None
        message = place or located(error.field, error.message)
        raise InputError(f"{source}: {message}", hint=error.hint) from error


@app.command()
@with_shared_options
def size(
    task: Annotated[
        str, typer.Argument(metavar="TASK", help="A sizing task (JSON file) or the id of a preset.")
    ],
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
    from mckibben.application.size.size import prepare_search, sizing_question
    from mckibben.application.text_file import HTML
    from mckibben.cli.output import check_written, progress, remark, write_file, write_json, write_summary
    from mckibben.documents.task import named_task
    from mckibben.presets.reading import BadDocumentError
    from mckibben.report.summary.sizing import notices, summary_of

    if report is None and (proposal is not None or title):
        option = "--title" if proposal is None else "--proposal"
        raise InputError(f"{option} belongs to a report, and none is requested", hint="--report FILE")
    check_written(report, "--report", HTML)
    try:
        work = prepare_search(sizing_question(named_task(task, studio), studio))
        with progress("searching drives") as watch:
            search = work(watch)
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{task}: {located(finding.field, finding.message)}", hint=finding.hint) from bad
    except InputError as error:
        raise at_file(task, error.field, error.message, error.hint) from error
    if report is not None:
        write_file(report, "--report", "report", _sizing_report(search, studio, proposal or 1, title))
    if as_json:
        write_json(search.result)
        for sentence in notices(search.result):
            remark(sentence)
    else:
        write_summary(summary_of(search.result, task))
    if not search.result.proposals:
        raise typer.Exit(NO_DRIVE)


def _sizing_report(search: Searched, studio: Studio, proposal: int, title: str) -> str:
    from mckibben.report.sizing.gather import report_of

    try:
        return report_of(search, studio, proposal=proposal, title=title)
    except InputError as error:
        place = f"--proposal {proposal}: " if error.field == "proposal" else ""
        raise InputError(f"{place}{error.message}", hint=error.hint) from error


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
    from mckibben.cli.output import remark
    from mckibben.export.registry import format_named
    from mckibben.export.source import stated_source
    from mckibben.export.use_case import ExportQuestion, write_export

    try:
        chosen = format_named(format_id)
    except InputError as error:
        raise InputError(f"--as {format_id}: {error.message}", hint=error.hint) from error
    stated = stated_source(source, studio)
    try:
        written = write_export(
            ExportQuestion(stated, format_id), out, studio, named=f"-o {out}", remark=remark
        )
    except InputError as error:
        if error.message.startswith("-o "):
            raise
        raise InputError(f"{source}: {located(error.field, error.message)}", hint=error.hint) from error
    for path in written:
        remark(f"{chosen.title}: {path}")


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
    from mckibben.application.study.file import check_out, journal_of, prepare_file
    from mckibben.application.study.study import prepare, study_question
    from mckibben.cli.output import progress, remark, write_json, write_summary
    from mckibben.documents.study import in_file, read_study_file
    from mckibben.report.summary.study import notices, summary_of
    from mckibben.simulation.outcome import Outcome

    if resume and out is None:
        raise InputError("--resume continues the table of --out, and none is named", hint="--out table.csv")
    document = read_study_file(Path(study))
    if out is not None:
        check_out(out, resume)
    try:
        question = study_question(document, studio)
    except InputError as error:
        raise in_file(study, error) from error
    workers = None
    if scheduler is not None:
        from mckibben.application.study.cluster import on_cluster

        workers = on_cluster(question, scheduler)
    if out is None:
        work = prepare(question, workers=workers, chunk=chunk)
    else:
        work = prepare_file(question, out, resume=resume, workers=workers, chunk=chunk)
    try:
        with progress("running the study") as watch:
            result = work(watch)
    except KeyboardInterrupt:
        if out is not None:
            remark(f"stopped; the runs made so far are in {journal_of(out)}: --resume continues")
        raise
    if out is not None:
        remark(f"table: {out}")
        if result.outcome != Outcome.COMPLETED.label:
            remark(f"the study is not complete: --resume continues it from {journal_of(out)}")
    if not as_json:
        write_summary(summary_of(result, Path(study).name))
        return
    write_json(result)
    for sentence in notices(result):
        remark(sentence)
