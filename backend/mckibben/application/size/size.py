"""From a task to ranked drives: the proposals with their drives, and the rejected parts with reasons."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar

from mckibben.application.envelope import MeasuredRange, range_of, use_notices
from mckibben.application.muscle_summary import Notice, unverified_notice
from mckibben.application.operating_limits import pressure_notices
from mckibben.application.size.task import about_task, catalogue_of, task_of
from mckibben.documents.drive import DriveDocument, LoadInput
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.facts.result import Number, result_class
from mckibben.facts.sizing import SEARCH, SIZING
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.outcome import Outcome, OutcomeName, Watch
from mckibben.sizing import Design, PartsCatalogue, Proposal, Rejection, Sizing, Task
from mckibben.sizing import size as search_designs
from mckibben.sizing.catalogue import Group, switch_on
from mckibben.sizing.design_table import LENGTHS, PRESSURES
from mckibben.sizing.ranking import joint_front, why_first
from mckibben.sizing.refine import CLOSE
from mckibben.sizing.statics import LimitName
from mckibben.sizing.trial import Trial

#: A search is bounded in runs, so a task has the same answer however busy the machine is; only one that takes
#: longer still ends with the drives found so far [s].
TIME_LIMIT = 900.0
#: How it would take less time.
HINT = "name fewer muscles, valves or tubes, or ask for fewer specimens"


@dataclass(frozen=True)
class SizingQuestion:
    """A task, and the parts available for it.

    Attributes:
        document: the task as given by the caller.
        task: the same in SI.
        catalogue: available muscles, valves and tubes.
    """

    document: SizingTask
    task: Task
    catalogue: PartsCatalogue


@result_class
class ProposedDrive:
    """A drive that fulfils the task; SI, gauge pressures."""

    FIGURES: ClassVar = SIZING.name

    muscle: str
    """Id of the preset."""
    nominal_length: float
    parallel: int
    muscles: int
    valve: str
    """Id of the preset; one for all parallel muscles, one on each side of a pair."""
    tube: str | None
    """Id of the preset; one tube from the valve to each muscle."""
    tube_length: float
    pulley_radius: float | None
    pressure: float
    time: float
    time_down: float | None
    contraction: float
    force_reserve: float
    static_load: float
    needed_pressure: Number
    pressure_start: float
    pressure_end: float
    air_volume_anr: float
    air_cost: float
    air_cost_year: float
    impact_energy: float
    impact_energy_stroke: float
    impact_energy_return: float
    end_speed: float
    max_speed: float
    peak_force: float
    stiffness: float
    stiffness_closed: float
    installed_length: float
    outer_diameter: float
    life: float
    probability: float | None
    probability_error: float | None
    specimens: int
    margins: dict[LimitName, float]
    binding: LimitName
    reservations: list[str]
    """What costs it rank: thin margins, an impact of stroke or return above limits.max_impact_energy."""
    reason: str
    """Explanation of its rank."""
    front: bool
    notes: list[str]
    """Remarks for building it."""
    unverified: list[str]
    """Unverified figures it depends on, by preset."""
    drive: DriveDocument
    """Drive document for /api/simulations, of one of the muscles."""


@result_class
class RejectedParts:
    """Parts that do not fulfil the task; valve and tube None = any."""

    FIGURES: ClassVar = SIZING.name

    muscle: str
    """Id of the preset."""
    parallel: int
    valve: str | None
    """None = with any valve."""
    tube: str | None
    """None = with any tube."""
    why: str
    """The reason, with figures."""
    binding: LimitName
    """The limit that must move by the least share when no other moves."""
    would_work_if: str
    """What would help, least change first."""
    combinations: int
    """Number of combinations this entry covers."""


@result_class
class ExploredDrive:
    """A simulated design that fulfils the task; approximate values, SI, for a plot of the alternatives."""

    FIGURES: ClassVar = SIZING.name

    muscle: str
    """Id of the preset."""
    nominal_length: float
    parallel: int
    valve: str
    """Id of the preset."""
    tube: str | None
    """Id of the preset; None without a tube."""
    pressure: float
    time: float
    air_volume_anr: float
    force_reserve: float
    installed_length: float
    stiffness: float
    front: bool


@result_class
class SizingResult:
    """The proposals, the best first, and all rejected parts with reasons."""

    FIGURES: ClassVar = SEARCH.name

    about: str
    """The task in one sentence, from its figures."""
    proposals: list[ProposedDrive]
    """Best first; empty if no candidate fulfils the task."""
    searched: str
    """What was searched, as a sentence: "the least" and "the fastest" are meant among these."""
    ranking: str | None
    """Why the first proposal comes before the second; None for less than two."""
    rejected: list[RejectedParts]
    """The nearest to the task first."""
    explored: list[ExploredDrive]
    """The best design of each choice of parts that fulfils the task."""
    combinations: int
    pruned: int
    simulated: int
    specimens: int
    outcome: OutcomeName
    """How the search ended; unless completed, the answer is what was found until then."""
    message: str | None
    """How far a search came that did not complete, or what a completed one left out."""
    flags: list[Notice]
    """Remarks on the task."""
    wall_ms: float
    """Computing time of the search in ms."""


def nothing_words(result: SizingResult) -> str:
    """What a search without a proposal says: only a complete one speaks of the whole catalogue."""
    if result.outcome == Outcome.COMPLETED.label:
        return "no drive in the catalogue fulfils this task"
    return "none of the drives that were tried fulfils this task"


@dataclass(frozen=True)
class Searched:
    """A question, the outcome of the search, and the result."""

    question: SizingQuestion
    sizing: Sizing
    result: SizingResult


def sizing_question(document: SizingTask, studio: Studio) -> SizingQuestion:
    """The question of a task.

    Raises:
        InputError: invalid task; names the field.
    """
    return SizingQuestion(document, task_of(document), catalogue_of(document, studio))


def prepare_search(question: SizingQuestion) -> Callable[[Watch], Searched]:
    """The search, ready to start; it returns question, outcome and result."""

    def work(watch: Watch) -> Searched:
        began = time.perf_counter()
        sizing = search_designs(question.task, question.catalogue, watch)
        wall_ms = (time.perf_counter() - began) * 1e3
        return Searched(question, sizing, _result(sizing, question, watch.time_limit, wall_ms))

    return work


def prepare(question: SizingQuestion) -> Callable[[Watch], SizingResult]:
    """The search, ready to start."""
    search = prepare_search(question)
    return lambda watch: search(watch).result


def _result(sizing: Sizing, question: SizingQuestion, limit: float, wall_ms: float) -> SizingResult:
    listed, explored = joint_front(sizing.proposals, sizing.explored)
    proposals = [
        _proposal(replace(proposal, front=on), question)
        for proposal, on in zip(sizing.proposals, listed, strict=True)
    ]
    return SizingResult(
        about=about_task(question.document),
        proposals=proposals,
        searched=_searched(sizing, question, sum(proposal.specimens for proposal in proposals)),
        ranking=why_first(sizing.proposals, question.task),
        rejected=[_rejected(item) for item in sizing.rejected],
        explored=[
            _explored(trial, on, question.task) for trial, on in zip(sizing.explored, explored, strict=True)
        ],
        combinations=sizing.combinations,
        pruned=sizing.pruned,
        simulated=sizing.simulated,
        specimens=sum(proposal.specimens for proposal in proposals),
        outcome=sizing.outcome.label,
        message=_message(sizing, question.document.uncertainty.specimens, limit),
        flags=_notices(proposals, question.document),
        wall_ms=wall_ms,
    )


def _searched(sizing: Sizing, question: SizingQuestion, specimens: int) -> str:
    """The domain of the search, and how fine it was."""
    parts = question.catalogue
    kinds = ((len(parts.muscles), "muscle"), (len(parts.valves), "valve"), (len(parts.tubes), "tube"))
    chosen = ", ".join(f"{count} {name}{'' if count == 1 else 's'}" for count, name in kinds)
    refined = (
        f"; near the best of them length and pressure were searched to {100.0 * CLOSE:g} %"
        if sizing.refined
        else ""
    )
    tolerances = (
        f" Shares of successful specimens are those of {specimens // len(sizing.proposals)} each, with the "
        "tolerances and the friction that the models assume."
        if specimens and sizing.proposals
        else ""
    )
    return (
        f"Searched: {sizing.combinations} combinations of {chosen}, up to "
        f"{question.task.limits.max_parallel} in parallel, with {LENGTHS} lengths and {PRESSURES} pressures "
        f"each; {sizing.pruned} fail by the static calculation, {sizing.simulated} runs were simulated"
        f"{refined}.{tolerances}"
    )


def _message(sizing: Sizing, specimens: int, limit: float) -> str | None:
    """What was not tried; None when everything was."""
    if sizing.outcome is not Outcome.COMPLETED:
        return _so_far(sizing, specimens, limit)
    if not sizing.untried:
        return None
    return (
        f"{sizing.untried} choices of parts that need more air and space were not simulated; "
        "name fewer parts."
    )


def _so_far(sizing: Sizing, specimens: int, limit: float) -> str:
    """How far a search came that was ended, and what the drives of it are not."""
    timed = sizing.outcome is Outcome.TIMED_OUT
    ended = (
        f"The limit of {limit:g} s of processor time ended the search"
        if timed
        else "The search was cancelled"
    )
    more = f" To try all, {HINT}." if timed else ""
    tried = sizing.choices - sizing.untried
    if not tried:
        return f"{ended} before any drive was simulated: nothing was tried.{more}"
    done = [
        f"{tried} of {sizing.choices} choices of parts that the static calculation leaves were simulated"
        + ("; the others were not tried" if sizing.untried else "")
    ]
    if sizing.proposals:
        if not sizing.refined:
            done.append("length and pressure of the drives were not searched to the end")
        known = sum(proposal.chance is not None for proposal in sizing.proposals)
        if specimens and known < len(sizing.proposals):
            done.append(f"{known} of {len(sizing.proposals)} probabilities were computed")
    return f"Partial result. {ended}: {'; '.join(done)}.{more}"


def _proposal(proposal: Proposal, question: SizingQuestion) -> ProposedDrive:
    task = question.task
    trial, design, rest = proposal.trial, proposal.design, proposal.trial.rest
    group, figures, chance = design.group, trial.figures, proposal.chance
    tube, operation = group.tube.tube, question.document.operation
    return ProposedDrive(
        muscle=group.muscle.id,
        nominal_length=design.length,
        parallel=group.parallel,
        muscles=group.muscles,
        valve=group.valve.id,
        tube=group.tube.id or None,
        tube_length=0.0 if tube is None else tube.length,
        pulley_radius=group.duty.pulley_radius,
        pressure=design.pressure,
        time=trial.time,
        time_down=figures.time_down,
        contraction=design.contraction,
        force_reserve=trial.force_reserve,
        static_load=float(rest.load[0]),
        needed_pressure=float(rest.needed[0]),
        pressure_start=proposal.pressure_start,
        pressure_end=proposal.pressure_end,
        air_volume_anr=trial.air,
        air_cost=trial.air * operation.air_price,
        air_cost_year=trial.air * operation.air_price * operation.cycles_per_year,
        impact_energy=proposal.impact_energy,
        impact_energy_stroke=proposal.impacts[0],
        impact_energy_return=proposal.impacts[1],
        end_speed=proposal.end_speed,
        max_speed=proposal.max_speed,
        peak_force=figures.peak_force,
        stiffness=float(rest.stiffness[0]),
        stiffness_closed=float(rest.stiffness_closed[0]),
        installed_length=design.length + task.limits.end_fittings,
        outer_diameter=float(rest.outer_diameter[0]),
        life=float(rest.life[0]),
        probability=None if chance is None else chance.probability,
        probability_error=None if chance is None else chance.error,
        specimens=0 if chance is None else chance.specimens,
        margins=trial.margins,
        binding=trial.binding,
        reservations=list(proposal.reservations),
        reason=proposal.reason,
        front=proposal.front,
        notes=_notes(proposal, task, question.document),
        unverified=[
            f"{part.id}: {', '.join(part.unverified)}"
            for part in (group.muscle, group.valve, group.tube)
            if part.unverified
        ],
        drive=drive_document(design, task),
    )


def _notes(proposal: Proposal, task: Task, document: SizingTask) -> list[str]:
    group = proposal.design.group
    notes: list[str] = []
    needed, arrived = float(proposal.trial.rest.needed[0]), proposal.pressure_end
    if arrived < needed:
        notes.append(
            f"It arrives by momentum: the muscles have {arrived / 1e5:.3g} bar then, and {needed / 1e5:.3g} "
            "bar carry the load over the stroke; until that is reached it may sag."
        )
    if group.parallel > 1:
        notes.append(
            f"The drive document is that of one of {group.parallel} parallel muscles: it has its share of "
            "the load and of the valve's flow. Equal muscles move alike."
        )
    if group.duty.pair:
        notes.append(
            "Each muscle has its rest length at one end of the swing. The run first fills the second "
            "muscle, then swings."
        )
    if group.muscle.extrapolated is not None:
        notes.append(f"Test a sample of {group.muscle.id} first: {group.muscle.extrapolated}.")
    if left := use_notices(group.muscle.fit, _use(proposal, document)):
        outside = "; ".join(notice.message for notice in left)
        notes.append(f"{group.muscle.id} is used where it was not measured: {outside}.")
    if document.load.force_over_stroke is not None:
        notes.append("The simulation uses a straight line above the force over the stroke.")
    if proposal.trial.figures.time_down is None:
        notes.append(f"The load does not return within {task.vent_time:.3g} s.")
    return notes


def _use(proposal: Proposal, document: SizingTask) -> dict[str, MeasuredRange]:
    """The ranges in which a proposal uses the model of its muscle."""
    design, lever = proposal.design, document.load.lever_ratio
    return (
        range_of("rest_length", design.length)
        | range_of("pressure", design.pressure)
        | range_of("contraction", design.contraction)
        | range_of("speed", 0.0, proposal.max_speed * lever)
    )


def _rejected(item: Rejection) -> RejectedParts:
    return RejectedParts(
        muscle=item.muscle,
        parallel=item.parallel,
        valve=item.valve,
        tube=item.tube or None,
        why=item.why,
        binding=item.binding,
        would_work_if=item.would_work_if,
        combinations=item.combinations,
    )


def _explored(trial: Trial, front: bool, task: Task) -> ExploredDrive:
    group = trial.design.group
    return ExploredDrive(
        muscle=group.muscle.id,
        nominal_length=trial.design.length,
        parallel=group.parallel,
        valve=group.valve.id,
        tube=group.tube.id or None,
        pressure=trial.design.pressure,
        time=trial.time,
        air_volume_anr=trial.air,
        force_reserve=trial.force_reserve,
        installed_length=trial.design.length + task.limits.end_fittings,
        stiffness=float(trial.rest.stiffness[0]),
        front=front,
    )


def _notices(proposals: list[ProposedDrive], document: SizingTask) -> list[Notice]:
    parts = dict.fromkeys(text for proposal in proposals for text in proposal.unverified)
    notices = [unverified_notice(text, "catalogue") for text in parts]
    notices += pressure_notices({"supply_pressure": document.supply_pressure})
    if document.limits.life is not None:
        text = "the life is an estimate between 100 000 and 10 million cycles; no maker's curve is known"
        notices.append(Notice("unverified", text, "limits.life"))
    if proposals and document.limits.end_fittings == 0.0:
        text = "the task states no end fittings: installed lengths are those of the muscles alone"
        notices.append(Notice("assumed", text, "limits.end_fittings"))
    return notices


def drive_document(design: Design, task: Task) -> DriveDocument:
    """The drive of one of the parallel muscles as a document; its simulation gives the proposal's figures."""
    group, drive = design.group, design.group.drive(task, design.length, design.pressure)
    on = switch_on(task, group.duty)
    valve: dict[str, object] = {"preset": group.valve.id}
    if group.parallel > 1:
        valve["sonic_conductance"] = drive.valve.fill_conductance
        valve["exhaust_conductance"] = drive.valve.exhaust_conductance
    document: dict[str, object] = {
        "schema": 1,
        "title": f"One of {group.muscles} muscles" if group.muscles > 1 else "",
        "muscle": {"preset": group.muscle.id, "nominal_length": design.length},
        "supply": {"pressure": design.pressure},
        "valve": valve,
        "load": _load(group, drive),
        "command": {"shape": "pulse", "on": on, "off": on + task.fill_time},
        "gas": {"temperature": task.temperature},
        "stops": {"min_contraction": 0.0, "max_contraction": drive.max_contraction},
        "duration": drive.duration,
    }
    if drive.tube is not None:
        document["tube"] = {"preset": group.tube.id, "length": drive.tube.length}
    return DriveDocument.model_validate(document)


def _load(group: Group, drive: Drive) -> LoadInput:
    load, duty = drive.load, group.duty
    values: dict[str, object] = {"mass": load.mass, "force": load.force, "spring": load.spring}
    if duty.pair:
        values |= {
            "arrangement": "antagonist",
            "pulley_radius": duty.pulley_radius,
            "precontraction": drive.precontraction,
        }
    else:
        values["inclination"] = load.inclination
        if duty.lever_ratio != 1.0:
            values |= {"arrangement": "lever", "lever_ratio": load.lever_ratio}
    # Without validation: the mass equivalent to an inertia may exceed what a document may state.
    return LoadInput.model_construct(None, **values)
