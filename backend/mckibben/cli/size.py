"""``mckibben size``: from a task to ranked drives."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mckibben.application.size.size import Searched, prepare_search, sizing_question
from mckibben.cli.output import progress, remark, write_file, write_json, write_summary
from mckibben.documents.located import located
from mckibben.documents.studio import Studio
from mckibben.documents.task import read_task_file
from mckibben.physics.errors import InputError
from mckibben.presets.reading import BadDocumentError
from mckibben.report.summary.sizing import notices, summary_of


@dataclass(frozen=True)
class Wanted:
    """A report to write: path, rank of the proposal (1 the best), title (a name, "" = that of the task)."""

    path: Path
    proposal: int = 1
    title: str = ""


def run(studio: Studio, *, task: str, as_json: bool, report: Wanted | None = None) -> None:
    """Search, print proposals and rejections or the JSON answer; write a report if requested.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    try:
        work = prepare_search(sizing_question(read_task_file(Path(task), studio), studio))
        with progress("searching drives") as watch:
            search = work(watch)
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{task}: {located(finding.field, finding.message)}", hint=finding.hint) from bad
    except InputError as error:
        message = located(error.field, error.message).removesuffix(".")
        raise InputError(f"{task}: {message}", hint=error.hint) from error
    result = search.result
    if report is not None:
        _write_report(search, studio, report)
    if not as_json:
        write_summary(summary_of(result, task))
        return
    write_json(result)
    for sentence in notices(result):
        remark(sentence)


def _write_report(search: Searched, studio: Studio, wanted: Wanted) -> None:
    from mckibben.report.sizing.gather import report_of

    try:
        text = report_of(search, studio, proposal=wanted.proposal, title=wanted.title)
    except InputError as error:
        message = error.message
        if error.field == "proposal":
            message = f"--proposal {wanted.proposal}: {message}"
        raise InputError(message, hint=error.hint) from error
    write_file(wanted.path, "--report", "report", text)
