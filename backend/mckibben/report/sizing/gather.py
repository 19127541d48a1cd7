"""Collects the content of a sizing report: the search, the run of one proposal, its parts."""

from __future__ import annotations

import hashlib
import json
import shlex
from collections.abc import Callable, Mapping
from datetime import datetime
from math import ceil

from mckibben.application.json_text import to_json
from mckibben.application.run.drive_run import run_drive
from mckibben.application.run.simulate import result_of
from mckibben.application.size.size import Searched, prepare_search, sizing_question
from mckibben.application.size.task import heading_of
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.physics.errors import InputError, fields_inside
from mckibben.report.command import Command
from mckibben.report.sizing.chosen import curves_of, margins_of, spread_of
from mckibben.report.sizing.entries import entries_of
from mckibben.report.sizing.material import Chosen, SizingMaterial
from mckibben.report.sizing.parts_list import effect_figures, parts_of
from mckibben.report.sizing.writing import sizing_report
from mckibben.report.versions import versions
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.simulation.timing.evaluation import grid_of
from mckibben.sizing.catalogue import switch_on

# Time step [s] and number of rows: resolves a stroke of milliseconds in a run of seconds.
_STEP, _FEWEST, _MOST = 2.5e-4, 2000, 20_000
_TASK_FILE, _DRIVE_FILE = "task.json", "drive.json"


def prepare_report(
    document: SizingTask, studio: Studio, *, proposal: int = 1, title: str = ""
) -> Callable[[Watch], str]:
    """The report of a task, ready to be computed and written.

    Args:
        document: the task.
        studio: presets and effects.
        proposal: rank of the drive that is reported, 1 is the best.
        title: name beside the figures of the task in the heading; "" = that of the task.

    Raises:
        InputError: the task cannot be used; its field begins with ``task``.
    """
    with fields_inside("task"):
        search = prepare_search(sizing_question(document, studio))

    def work(watch: Watch) -> str:
        return report_of(search(watch), studio, proposal=proposal, title=title, watch=watch)

    return work


def report_of(
    search: Searched, studio: Studio, *, proposal: int = 1, title: str = "", watch: Watch | None = None
) -> str:
    """The HTML of a search and one of its proposals.

    Raises:
        InputError: there are fewer proposals, or the search was cancelled.
    """
    result, document = search.result, search.question.document
    if search.sizing.outcome is Outcome.CANCELLED:
        raise InputError(f"there is nothing to report: {result.message}", field="task")
    count = len(result.proposals)
    if 0 < count < proposal:  # a task without a proposal has a report too
        number = "is 1 proposal" if count == 1 else f"are {count} proposals"
        most = "1" if count == 1 else f"1 to {count}"
        raise InputError(f"there {number}", field="proposal", hint=most)
    # The time of the search may be over: the one run of the report has its own.
    cancelled = None if watch is None else watch.cancelled
    chosen = _chosen(search, studio, proposal, Watch(cancelled=cancelled)) if count else None
    task = canonical(document.completed())
    files = {_TASK_FILE: task}
    if chosen is not None:
        files[_DRIVE_FILE] = canonical(chosen.proposal.drive)
    considered = {
        "muscles": [part.id for part in search.question.catalogue.muscles],
        "valves": [part.id for part in search.question.catalogue.valves],
        "tubes": [part.id for part in search.question.catalogue.tubes if part.id],
    }
    return sizing_report(
        SizingMaterial(
            title=heading_of(result.about, title.strip() or document.title),
            made=datetime.now().astimezone(),
            versions=versions(),
            entries=entries_of(document, considered),
            result=result,
            pair=search.question.task.pair is not None,
            operation=document.operation,
            profile=search.question.task.force_over_stroke,
            chosen=chosen,
            catalogue=studio.catalogue,
            hashes={name: hashlib.sha256(text.encode()).hexdigest() for name, text in files.items()},
            command=_command(files, chosen, proposal, to_json(result).decode()),
        )
    )


def _chosen(search: Searched, studio: Studio, rank: int, watch: Watch) -> Chosen:
    proposal, answer = search.sizing.proposals[rank - 1], search.result.proposals[rank - 1]
    task, group = search.question.task, proposal.design.group
    drive_model = drive_of(answer.drive, studio)
    duration = drive_model.drive.duration
    points = min(max(ceil(duration / _STEP), _FEWEST), _MOST) + 1
    grid = grid_of(duration=duration, begin=0.0, end=duration, points=points)
    # The solver of the search, so that the figures agree to the last digit.
    run = result_of(drive_model, grid, run_drive(drive_model, grid, watch))
    on = switch_on(task, group.duty)
    return Chosen(
        rank=rank,
        proposal=answer,
        run=run,
        fill=(on, on + task.fill_time),
        count=group.parallel,
        curves=curves_of(proposal, task),
        margins=margins_of(proposal, task),
        parts=parts_of(proposal.design, studio),
        spread=spread_of(proposal, task),
        effects=drive_model.start.effects,
        figures=dict(effect_figures(proposal.design, studio, drive_model.start.effects)),
        gas=drive_model.drive.gas_closure,
    )


def canonical(content: object) -> str:
    """JSON with sorted keys and without spaces, for hashing."""
    plain = json.loads(to_json(content))
    return json.dumps(plain, sort_keys=True, separators=(",", ":"), ensure_ascii=False)


def _command(files: Mapping[str, str], chosen: Chosen | None, proposal: int, result: str) -> Command:
    rank = f" --proposal {proposal}" if proposal > 1 else ""
    lines = [f"mckibben size {_TASK_FILE}", f"mckibben size {_TASK_FILE} --report report.html{rank}"]
    notes = []
    if chosen is not None:
        lines.append(f"mckibben simulate {_DRIVE_FILE}")
        user_presets = [part.id for part in chosen.parts if part.origin == "user"]
        if user_presets:
            notes.append(
                f"Also needs your own presets (--presets): {', '.join(map(shlex.quote, user_presets))}."
            )
    shown = {name: json.dumps(json.loads(text), indent=2, ensure_ascii=False) for name, text in files.items()}
    return Command(lines, shown, notes, {"sizing.json": result})
