"""``mckibben size``: from a task to ranked drives."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mckibben.application.size import Searched, SizingResult, prepare_search, sizing_question
from mckibben.cli.output import figure, remark, write_json, write_table
from mckibben.documents.located import located
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.physics.errors import InputError
from mckibben.presets import TaskPreset
from mckibben.presets.reading import BadDocumentError, parse, read_file
from mckibben.simulation.outcome import Watch

_REJECTED_SHOWN = 12


@dataclass(frozen=True)
class Wanted:
    """A report to write: path, rank of the proposal (1 the best), title ("" = that of the task)."""

    path: Path
    proposal: int = 1
    title: str = ""


def run(studio: Studio, *, task: str, as_json: bool, report: Wanted | None = None) -> None:
    """Search, print proposals and rejections or the JSON answer; write a report if requested.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    try:
        document = read_task(_content(Path(task), studio))
        watch = Watch(progress=_show if sys.stderr.isatty() else None)
        search = prepare_search(sizing_question(document, studio))(watch)
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{task}: {located(finding.field, finding.message)}", hint=finding.hint) from bad
    except InputError as error:
        message = located(error.field, error.message).removesuffix(".")
        raise InputError(f"{task}: {message}", hint=error.hint) from error
    result = search.result
    if report is not None:
        _write_report(search, studio, report)
    if as_json:
        write_json(result)
    else:
        _write_tables(task, result)
    for notice in result.flags:
        remark(notice.message)
    if result.message is not None:
        remark(result.message)


def _write_report(search: Searched, studio: Studio, wanted: Wanted) -> None:
    from mckibben.cli.report import save
    from mckibben.report.sizing.gather import report_of

    try:
        text = report_of(search, studio, proposal=wanted.proposal, title=wanted.title)
    except InputError as error:
        message = error.message
        if error.field == "proposal":
            message = f"--proposal {wanted.proposal}: {message}"
        raise InputError(message, hint=error.hint) from error
    save(wanted.path, text)


def _content(path: Path, studio: Studio) -> object:
    """The content of a file, or the document inside a preset file."""
    content = read_file(path, follow_links=True)
    if not isinstance(content, dict) or "kind" not in content:
        return content
    preset = parse(TaskPreset, content, studio.effect_table)
    assert isinstance(preset, TaskPreset)  # noqa: S101 - parsed as one
    return preset.document


def _show(share: float) -> None:
    """Print the progress, in a line that the next output overwrites."""
    sys.stderr.write(f"\r{share * 100:3.0f} %\r")
    sys.stderr.flush()


def read_task(document: object) -> SizingTask:
    """A task from JSON.

    Raises:
        InputError: what is wrong, with ``field`` the path in the document.
    """
    from pydantic import ValidationError

    from mckibben.documents.problems import first_problem

    try:
        return SizingTask.model_validate(document)
    except ValidationError as error:
        problem = first_problem(error.errors(), SizingTask, document, "the task")
        raise InputError(
            problem.message, field=problem.field, hint=problem.hint, code=problem.code
        ) from error


def _write_tables(name: str, result: SizingResult) -> None:
    rows: list[Sequence[str]] = [
        [
            f"{item.parallel} × {item.muscle}" if item.parallel > 1 else item.muscle,
            figure(item.nominal_length * 1e3, unit=" mm"),
            item.valve,
            item.tube or "–",
            figure(item.pressure / 1e5, 3, " bar"),
            figure(item.time, 3, " s"),
            figure(item.contraction * 100.0, 3, " %"),
            figure(item.force_reserve * 100.0, 3, " %"),
            figure(item.air_volume_anr * 1e3, 3, " l"),
            figure(item.impact_energy, 3, " J"),
            "–" if item.probability is None else figure(item.probability * 100.0, 3, " %"),
            figure(item.margins[item.binding] * 100.0, 2, " %"),
            item.binding.replace("_", " "),
        ]
        for item in result.proposals
    ]
    header = [
        "muscle", "length", "valve", "tube", "supply", "time", "contraction", "force reserve",
        "air per cycle", "impact", "probability", "margin", "nearest limit",
    ]  # fmt: skip
    counted = f"{result.combinations} combinations, {result.simulated} simulated"
    if rows:
        write_table(f"{name}: drives, best first ({counted})", header, rows)
        if result.ranking is not None:
            remark(result.ranking)
    else:
        write_table(f"{name}: no drive in the catalogue fulfils this task ({counted})", ["no drive"], [])
    shown = result.rejected[:_REJECTED_SHOWN]
    for item in shown:
        remark(f"– {item.why} [{item.binding.replace('_', ' ')}]; it would work with {item.would_work_if}")
    if len(result.rejected) > len(shown):
        remark(f"– and {len(result.rejected) - len(shown)} further choices of parts")
