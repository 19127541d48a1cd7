"""Collects the content of a sizing report: the search, one proposal with its run, figures and parts."""

from __future__ import annotations

import hashlib
import json
import shlex
from collections.abc import Callable, Mapping
from datetime import datetime
from math import ceil

import numpy as np

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
from mckibben.report.document import versions
from mckibben.report.sizing.inputs import entries_of
from mckibben.report.sizing.material import Chosen, ForceCurves, Margin, SizingMaterial, SpecimenSpread
from mckibben.report.sizing.parts import effect_figures, parts_of
from mckibben.report.sizing.writing import sizing_report
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.simulation.timing.evaluation import grid_of
from mckibben.sizing import Design, Proposal, Task
from mckibben.sizing.catalogue import switch_on
from mckibben.sizing.spread import deviation_of
from mckibben.sizing.statics import contraction_limit, outputs

# Time step [s] and number of rows: resolves a stroke of milliseconds in a run of seconds.
_STEP, _FEWEST, _MOST = 2.5e-4, 2000, 20_000
_TASK_FILE, _DRIVE_FILE = "task.json", "drive.json"

Array = np.ndarray

_COLUMNS, _PLACES = 121, 61
_BEYOND = 1.15  # end of the curves, as a multiple of the contraction at the end of the stroke
_BAR = 1e5
_FEW_BARS = 1.5  # supply [bar] below which the pressures of the curves are quarters of it


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


def curves_of(proposal: Proposal, task: Task) -> ForceCurves:
    """Force of one muscle over its contraction, and the force demanded over the stroke.

    Static values while filling, by the closed form that the search prunes with.
    """
    design, rest = proposal.design, proposal.trial.rest
    group, duty = design.group, design.group.duty
    reach = design.contraction
    contraction = np.linspace(0.0, max(_BEYOND * reach, contraction_limit(group.muscle, task)), _COLUMNS)
    pressures = _pressures(design.pressure)
    force = np.array([_force(design, task, contraction, pressure) for pressure in pressures])
    strokes = np.linspace(0.0, duty.stroke, _PLACES)
    places = reach * strokes / duty.stroke
    counter = np.zeros(_PLACES)
    if duty.pair:  # the second muscle is empty; it lengthens as the first one shortens
        counter = np.maximum(_force(design, task, places[::-1], 0.0), 0.0)
    share = duty.lever_ratio * group.parallel
    start, slope = duty.straight()
    straight = (duty.weight + start + slope * strokes) / share + counter
    demand = duty.load(strokes) / share + counter
    return ForceCurves(
        contraction=contraction.tolist(),
        pressures=pressures,
        force=force.tolist(),
        places=places.tolist(),
        demand=demand.tolist(),
        counter=counter.tolist(),
        carrying=(float(rest.lifting[0]), float(rest.holding[0])),
        run=() if np.allclose(straight, demand, rtol=1e-9, atol=1e-9) else straight.tolist(),
    )


def _pressures(supply: float) -> list[float]:
    """At most seven whole-bar pressures below the supply pressure, and the supply pressure itself."""
    if supply < _FEW_BARS * _BAR:
        return [supply * share for share in (0.25, 0.5, 0.75, 1.0)]
    step = max(round(supply / _BAR / 6.0), 1) * _BAR
    whole = [step * number for number in range(1, 8) if step * number < supply - 0.3 * step]
    return [*whole, supply]


def _force(design: Design, task: Task, contraction: Array, pressure: float) -> Array:
    rows = np.ones(len(contraction))
    return outputs(
        design.group.muscle,
        length=design.length * rows,
        contraction=contraction,
        pressure=pressure * rows,
        temperature=task.temperature,
    )["force"]


def margins_of(proposal: Proposal, task: Task) -> list[Margin]:
    """Allowed and actual value of each limit, the smallest margin first."""
    trial, design, rest, figures = (
        proposal.trial,
        proposal.design,
        proposal.trial.rest,
        proposal.trial.figures,
    )
    part, limits = design.group.muscle, task.limits
    up, down = figures.time or 0.0, figures.time_down or 0.0
    sides: dict[str, tuple[float | None, float, bool]] = {
        "length": (limits.max_length, design.length + limits.end_fittings, True),
        "pressure": (task.available_pressure, design.pressure, True),
        "contraction": (contraction_limit(part, task), design.contraction, True),
        "force": (1.0 + limits.force_reserve, float(rest.capacity[0]), False),
        "force_limit": (part.limits.max_force, max(float(rest.tension[0]), figures.peak_force), True),
        "suspended_mass": (
            part.suspended_mass,
            task.suspended_mass / (design.group.parallel * task.lever_ratio),
            True,
        ),
        "diameter": (limits.max_diameter, float(rest.outer_diameter[0]), True),
        "stiffness": (limits.stiffness, float(rest.stiffness[0]), False),
        "life": (limits.life, float(rest.life[0]), False),
        "time": (task.time, up, True),
        "time_down": (task.time_down, down, True),
        "cycle_time": (task.cycle_time, up + down, True),
    }
    margins = []
    for name, share in sorted(trial.margins.items(), key=lambda item: item[1]):
        allowed, actual, upper = sides[name]
        if allowed is not None:
            margins.append(Margin(name, allowed, actual, upper, share))
    return margins


def spread_of(proposal: Proposal, task: Task) -> SpecimenSpread | None:
    """How the simulated specimens differ; None if none were simulated."""
    if proposal.chance is None:
        return None
    uncertainty, part = task.uncertainty, proposal.design.group.muscle
    deviation = deviation_of(proposal.design, task)
    demands = ["it reaches the end of the stroke and stays there while the valve fills"]
    for words, demanded in (
        ("the stroke takes", task.time),
        ("the return takes", task.time_down),
        ("stroke and return together take", task.cycle_time),
    ):
        if demanded is not None:
            demands.append(f"{words} at most {demanded:.4g} s")
    return SpecimenSpread(
        blocked_force=uncertainty.blocked_force,
        shift=deviation.shift,
        hysteresis=(part.hysteresis or None) if uncertainty.hysteresis is None else uncertainty.hysteresis,
        friction=deviation.friction,
        supply=uncertainty.supply_pressure,
        demands=demands,
    )
