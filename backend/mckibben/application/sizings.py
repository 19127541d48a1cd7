"""Answer of ``/api/sizings`` and ``mckibben size``: the search as JSON, each proposal with its drive."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from mckibben.application.sizing_task import catalogue_of, task_of
from mckibben.application.start import Json, flag
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.sizing import Design, PartsCatalogue, Proposal, Rejection, Sizing, Task, size
from mckibben.sizing.catalogue import switch_on
from mckibben.sizing.ranking import front_of
from mckibben.sizing.trial import Trial

_MESSAGES = {
    Outcome.TIMED_OUT: "The search took too long and was stopped. Name fewer muscles, valves or tubes, or "
    "ask for fewer specimens.",
    Outcome.CANCELLED: "The search was cancelled.",
}
_TIME_LIMIT = 30.0  # s; a search is many runs


@dataclass(frozen=True)
class Searched:
    """A task, what may be used for it, what was found, and the answer that tells it."""

    document: SizingTask
    task: Task
    catalogue: PartsCatalogue
    found: Sizing
    answer: Json


def prepare_sizing(document: SizingTask, studio: Studio) -> Callable[[Watch], Json]:
    """The search a task means, ready to start.

    Raises:
        InputError: the task cannot be used; names the field.
    """
    search = prepare_search(document, studio)
    return lambda watch: search(watch).answer


def prepare_search(document: SizingTask, studio: Studio) -> Callable[[Watch], Searched]:
    """As `prepare_sizing`, with everything the answer was made of."""
    task, catalogue = task_of(document), catalogue_of(document, studio)

    def work(watch: Watch) -> Searched:
        watch.time_limit = max(watch.time_limit, _TIME_LIMIT)
        began = time.perf_counter()
        found = size(task, catalogue, watch)
        answer = answer_of(found, task, document, (time.perf_counter() - began) * 1e3)
        return Searched(document, task, catalogue, found, answer)

    return work


def searched(document: SizingTask, studio: Studio, watch: Watch | None = None) -> Searched:
    """Make the search of a task; raises like `prepare_sizing`."""
    return prepare_search(document, studio)(watch or Watch())


def sizing_answer(document: SizingTask, studio: Studio, watch: Watch | None = None) -> Json:
    """Search and tell what was found; raises like `prepare_sizing`."""
    return searched(document, studio, watch).answer


def answer_of(found: Sizing, task: Task, document: SizingTask, wall_ms: float) -> Json:
    """Everything there is to say about a search."""
    proposals = [_proposal(proposal, task, document) for proposal in found.proposals]
    front = front_of(found.explored)
    specimens = sum(item["specimens"] for item in proposals)
    return {
        "proposals": proposals,
        "rejected": [_rejected(item) for item in found.rejected],
        "explored": [_explored(trial, on) for trial, on in zip(found.explored, front, strict=True)],
        "combinations": found.combinations,
        "pruned": found.pruned,
        "simulated": found.simulated,
        "specimens": specimens,
        "outcome": found.outcome.label,
        "message": _MESSAGES.get(found.outcome) or _untried(found),
        "flags": _flags(proposals, document),
        "wall_ms": wall_ms,
    }


def _untried(found: Sizing) -> str | None:
    if not found.untried:
        return None
    return (
        f"{found.untried} choices of parts that take more air and room were not simulated; name fewer parts."
    )


def _proposal(proposal: Proposal, task: Task, document: SizingTask) -> Json:
    trial, design, rest = proposal.trial, proposal.design, proposal.trial.rest
    group, figures, likely = design.group, trial.figures, proposal.chance
    tube = group.tube.tube
    needed = float(rest.needed[0])
    return {
        "muscle": group.muscle.id,
        "nominal_length": design.length,
        "parallel": group.parallel,
        "muscles": group.muscles,
        "valve": group.valve.id,
        "tube": group.tube.id or None,
        "tube_length": 0.0 if tube is None else tube.length,
        "pulley_radius": group.duty.pulley_radius,
        "pressure": design.pressure,
        "time": figures.time,
        "time_down": figures.time_down,
        "contraction": design.contraction,
        "force_reserve": trial.force_reserve,
        "needed_pressure": needed,
        "pressure_start": proposal.pressure_start,
        "pressure_end": proposal.pressure_end,
        "air_volume_anr": trial.air,
        "impact_energy": proposal.impact_energy,
        "end_speed": proposal.end_speed,
        "max_speed": proposal.max_speed,
        "peak_force": figures.peak_force,
        "stiffness": float(rest.stiffness[0]),
        "stiffness_closed": float(rest.stiffness_closed[0]),
        "installed_length": design.length + task.limits.end_fittings,
        "diameter": float(rest.diameter[0]),
        "life": float(rest.life[0]),
        "probability": None if likely is None else likely.probability,
        "probability_error": None if likely is None else likely.error,
        "specimens": 0 if likely is None else likely.specimens,
        "margins": trial.margins,
        "binding": trial.binding,
        "reason": proposal.reason,
        "front": proposal.front,
        "notes": _notes(proposal, task, document),
        "unverified": [
            f"{part.id}: {', '.join(part.unverified)}"
            for part in (group.muscle, group.valve, group.tube)
            if part.unverified
        ],
        "drive": drive_document(design, task),
    }


def drive_document(design: Design, task: Task) -> Json:
    """The drive of one of the parallel muscles as a document; its run shows the proposal's figures."""
    group, drive = design.group, design.group.drive(task, design.length, design.pressure)
    duty, load = group.duty, drive.load
    on = switch_on(task, duty)
    valve: Json = {"preset": group.valve.id}
    if group.parallel > 1:
        valve["sonic_conductance"] = drive.valve.fill_conductance
        valve["exhaust_conductance"] = drive.valve.exhaust_conductance
    moved: Json = {"mass": load.mass, "force": load.force, "spring": load.spring}
    if duty.pair:
        moved |= {
            "arrangement": "antagonist",
            "pulley_radius": duty.pulley_radius,
            "precontraction": drive.precontraction,
        }
    else:
        moved["inclination"] = load.inclination
        if duty.lever_ratio != 1.0:
            moved |= {"arrangement": "lever", "lever_ratio": load.lever_ratio}
    document: Json = {
        "schema": 1,
        "title": f"{group.muscle.id}, one of {group.muscles}" if group.muscles > 1 else group.muscle.id,
        "muscle": {"preset": group.muscle.id, "nominal_length": design.length},
        "supply": {"pressure": design.pressure},
        "valve": valve,
        "load": moved,
        "command": {"shape": "pulse", "on": on, "off": on + task.fill_time},
        "gas": {"temperature": task.temperature},
        "stops": {"min_contraction": 0.0, "max_contraction": drive.max_contraction},
        "duration": drive.duration,
    }
    if drive.tube is not None:
        document["tube"] = {"preset": group.tube.id, "length": drive.tube.length}
    return document


def _notes(proposal: Proposal, task: Task, document: SizingTask) -> list[str]:
    group = proposal.design.group
    found = []
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


def _rejected(item: Rejection) -> Json:
    return {
        "muscle": item.muscle,
        "parallel": item.parallel,
        "valve": item.valve,
        "tube": item.tube or None,
        "why": item.why,
        "binding": item.binding,
        "would_work_if": item.would_work_if,
        "combinations": item.combinations,
    }


def _explored(trial: Trial, front: bool) -> Json:
    group = trial.design.group
    return {
        "muscle": group.muscle.id,
        "nominal_length": trial.design.length,
        "parallel": group.parallel,
        "valve": group.valve.id,
        "tube": group.tube.id or None,
        "pressure": trial.design.pressure,
        "time": trial.figures.time,
        "air_volume_anr": trial.air,
        "force_reserve": trial.force_reserve,
        "stiffness": float(trial.rest.stiffness[0]),
        "front": front,
    }


def _flags(proposals: list[Json], document: SizingTask) -> list[Json]:
    parts = dict.fromkeys(text for proposal in proposals for text in proposal["unverified"])
    why = "from general knowledge or estimated, not read in a source"
    found = [flag("unverified", f"{text} {why}", "catalogue") for text in parts]
    if document.limits.life is not None:
        text = "the life is an estimate between 100 000 and 10 million cycles; no maker's curve is known"
        found.append(flag("unverified", text, "limits.life"))
    return found
