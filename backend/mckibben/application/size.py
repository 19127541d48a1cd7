"""From a task to ranked drives: each proposal with its drive, and why not the others."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mckibben.application.drive_of_design import drive_document
from mckibben.application.muscle_summary import Notice
from mckibben.application.task_reading import catalogue_of, task_of
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.sizing import PartsCatalogue, Proposal, Rejection, Sizing, Task
from mckibben.sizing import size as search_designs
from mckibben.sizing.ranking import front_of
from mckibben.sizing.trial import Trial

_MESSAGES = {
    Outcome.TIMED_OUT: "The search took too long and was stopped. Name fewer muscles, valves or tubes, or "
    "ask for fewer specimens.",
    Outcome.CANCELLED: "The search was cancelled.",
}
_TIME_LIMIT = 30.0  # s; a search is many runs


@dataclass(frozen=True)
class SizingQuestion:
    """A task, and what may be used for it.

    Attributes:
        document: the task as the caller gives it.
        task: the same in SI.
        catalogue: muscles, valves and tubes that may be used.
    """

    document: SizingTask
    task: Task
    catalogue: PartsCatalogue


@dataclass(frozen=True, slots=True)
class ProposedDrive:
    """A drive that does the task; SI, pressures gauge.

    Attributes:
        muscle, valve, tube: ids of the presets.
        nominal_length: of each muscle.
        parallel, muscles: side by side (on each side of a pair), and all of the drive.
        tube_length: 0 without a tube.
        pulley_radius: of a pair.
        pressure: of the supply at the valve.
        time, time_down: for the stroke and the way back; None when that does not end in the time watched.
        contraction: at the end of the stroke.
        force_reserve: share by which the static force exceeds the load at least.
        needed_pressure: that just carries the load at the end of the stroke.
        pressure_start, pressure_end: in the muscle when the load leaves its stop, and on arrival.
        air_volume_anr: of all muscles in a cycle.
        impact_energy, end_speed: of the whole load on the end stop; max_speed: on the way.
        peak_force: largest tension of a muscle.
        stiffness, stiffness_closed: of the load at the end of the stroke, valve open and closed.
        installed_length, diameter: with end fittings; bulged.
        life: load cycles, an estimate.
        probability, probability_error, specimens: that what is built does the task.
        margins, binding: limit -> share of it that is left; the limit with the least margin.
        reason: why it stands where it stands; front: whether no other proposal is better in everything.
        notes: what to know when it is built.
        unverified: figures that enter and nobody verified, by preset.
        drive: a drive document, of one of the muscles.
    """

    muscle: str
    nominal_length: float
    parallel: int
    muscles: int
    valve: str
    tube: str | None
    tube_length: float
    pulley_radius: float | None
    pressure: float
    time: float | None
    time_down: float | None
    contraction: float
    force_reserve: float
    needed_pressure: float
    pressure_start: float
    pressure_end: float
    air_volume_anr: float
    impact_energy: float
    end_speed: float
    max_speed: float
    peak_force: float
    stiffness: float
    stiffness_closed: float
    installed_length: float
    diameter: float
    life: float
    probability: float | None
    probability_error: float | None
    specimens: int
    margins: dict[str, float]
    binding: str
    reason: str
    front: bool
    notes: list[str]
    unverified: list[str]
    drive: dict[str, Any]


@dataclass(frozen=True, slots=True)
class RejectedParts:
    """Parts that do not do the task; valve and tube None: whatever they are.

    Attributes:
        why: in figures.
        binding: the limit that must move by the least share when no other moves.
        would_work_if: what would help, least change first.
        combinations: how many combinations it stands for.
    """

    muscle: str
    parallel: int
    valve: str | None
    tube: str | None
    why: str
    binding: str
    would_work_if: str
    combinations: int


@dataclass(frozen=True, slots=True)
class ExploredDrive:
    """A simulated design that does the task; coarse figures, SI, for a picture of the choices."""

    muscle: str
    nominal_length: float
    parallel: int
    valve: str
    tube: str | None
    pressure: float
    time: float | None
    air_volume_anr: float
    force_reserve: float
    stiffness: float
    front: bool


@dataclass(frozen=True, slots=True)
class SizingResult:
    """Proposals best first, and everything else with its reason.

    Attributes:
        proposals: empty when nothing does; that is an answer too.
        rejected: nearest first; explored: one for each choice of parts that does the task.
        combinations, pruned, simulated, specimens: how many were there, sorted out in closed form, run, and
            run for probabilities.
        outcome, message: how the search ended; what to do when it did not complete.
        wall_ms: time of the whole search.
    """

    proposals: list[ProposedDrive]
    rejected: list[RejectedParts]
    explored: list[ExploredDrive]
    combinations: int
    pruned: int
    simulated: int
    specimens: int
    outcome: str
    message: str | None
    flags: list[Notice]
    wall_ms: float


@dataclass(frozen=True)
class Searched:
    """A question, what the search found, and the result made of it."""

    question: SizingQuestion
    found: Sizing
    result: SizingResult


def sizing_question(document: SizingTask, studio: Studio) -> SizingQuestion:
    """The question of a task.

    Raises:
        InputError: the task cannot be used; names the field.
    """
    return SizingQuestion(document, task_of(document), catalogue_of(document, studio))


def prepare_search(question: SizingQuestion) -> Callable[[Watch], Searched]:
    """The search, ready to start; with everything its result is made of."""

    def work(watch: Watch) -> Searched:
        watch.time_limit = max(watch.time_limit, _TIME_LIMIT)
        began = time.perf_counter()
        found = search_designs(question.task, question.catalogue, watch)
        return Searched(question, found, _result(found, question, (time.perf_counter() - began) * 1e3))

    return work


def prepare(question: SizingQuestion) -> Callable[[Watch], SizingResult]:
    """The search, ready to start."""
    search = prepare_search(question)
    return lambda watch: search(watch).result


def size(question: SizingQuestion, watch: Watch | None = None) -> SizingResult:
    """Search, and tell what was found."""
    return prepare(question)(watch or Watch())


def _result(found: Sizing, question: SizingQuestion, wall_ms: float) -> SizingResult:
    proposals = [_proposal(proposal, question) for proposal in found.proposals]
    front = front_of(found.explored)
    return SizingResult(
        proposals=proposals,
        rejected=[_rejected(item) for item in found.rejected],
        explored=[_explored(trial, on) for trial, on in zip(found.explored, front, strict=True)],
        combinations=found.combinations,
        pruned=found.pruned,
        simulated=found.simulated,
        specimens=sum(proposal.specimens for proposal in proposals),
        outcome=found.outcome.label,
        message=_MESSAGES.get(found.outcome) or _untried(found),
        flags=_notices(proposals, question.document),
        wall_ms=wall_ms,
    )


def _untried(found: Sizing) -> str | None:
    if not found.untried:
        return None
    return (
        f"{found.untried} choices of parts that take more air and room were not simulated; name fewer parts."
    )


def _proposal(proposal: Proposal, question: SizingQuestion) -> ProposedDrive:
    task = question.task
    trial, design, rest = proposal.trial, proposal.design, proposal.trial.rest
    group, figures, likely = design.group, trial.figures, proposal.chance
    tube = group.tube.tube
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
        time=figures.time,
        time_down=figures.time_down,
        contraction=design.contraction,
        force_reserve=trial.force_reserve,
        needed_pressure=float(rest.needed[0]),
        pressure_start=proposal.pressure_start,
        pressure_end=proposal.pressure_end,
        air_volume_anr=trial.air,
        impact_energy=proposal.impact_energy,
        end_speed=proposal.end_speed,
        max_speed=proposal.max_speed,
        peak_force=figures.peak_force,
        stiffness=float(rest.stiffness[0]),
        stiffness_closed=float(rest.stiffness_closed[0]),
        installed_length=design.length + task.limits.end_fittings,
        diameter=float(rest.diameter[0]),
        life=float(rest.life[0]),
        probability=None if likely is None else likely.probability,
        probability_error=None if likely is None else likely.error,
        specimens=0 if likely is None else likely.specimens,
        margins=trial.margins,
        binding=trial.binding,
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
    found: list[str] = []
    if group.parallel > 1:
        found.append(
            f"The drive document is that of one of {group.parallel} parallel muscles: it has its share of "
            "the load and of the valve's flow. Equal muscles move alike."
        )
    if group.duty.pair:
        found.append(
            "Both muscles are at their nominal length at the far end of the swing; the run first fills the "
            "second muscle, then swings."
        )
    if document.load.force_over_stroke is not None:
        found.append("The run takes the straight line above the force over the stroke.")
    if proposal.trial.figures.time_down is None:
        found.append(f"It does not come back within {task.vent_time:.3g} s.")
    return found


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


def _explored(trial: Trial, front: bool) -> ExploredDrive:
    group = trial.design.group
    return ExploredDrive(
        muscle=group.muscle.id,
        nominal_length=trial.design.length,
        parallel=group.parallel,
        valve=group.valve.id,
        tube=group.tube.id or None,
        pressure=trial.design.pressure,
        time=trial.figures.time,
        air_volume_anr=trial.air,
        force_reserve=trial.force_reserve,
        stiffness=float(trial.rest.stiffness[0]),
        front=front,
    )


def _notices(proposals: list[ProposedDrive], document: SizingTask) -> list[Notice]:
    parts = dict.fromkeys(text for proposal in proposals for text in proposal.unverified)
    why = "from general knowledge or estimated, not read in a source"
    found = [Notice("unverified", f"{text} {why}", "catalogue") for text in parts]
    if document.limits.life is not None:
        text = "the life is an estimate between 100 000 and 10 million cycles; no maker's curve is known"
        found.append(Notice("unverified", text, "limits.life"))
    return found
