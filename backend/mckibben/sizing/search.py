"""The search: closed form over all combinations, simulation of what is left, refinement, probability."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mckibben.simulation.outcome import Outcome, Watch
from mckibben.sizing.bench import Bench, EndedError
from mckibben.sizing.catalogue import Design, Group, PartsCatalogue
from mckibben.sizing.chance import chance
from mckibben.sizing.proposal import Proposal, propose
from mckibben.sizing.ranking import ranked
from mckibben.sizing.reasons import temperature_text
from mckibben.sizing.refine import refined
from mckibben.sizing.rejection import Rejection, at_rest_rejections, slow_rejections
from mckibben.sizing.sheet import Sheet, sheet_of
from mckibben.sizing.statics import least_time
from mckibben.sizing.task import Task
from mckibben.sizing.trial import Trial, trial_of

# Shares of the work after each stage, for the progress.
_PRUNED, _TRIED, _REFINED, _MEASURED = 0.1, 0.35, 0.65, 0.7
_OF_ONE_KIND = 4  # proposals with the same muscles, while there are others
_SPARE = 4  # refined beyond the number wanted: some fall behind when they are measured
_MOST_GROUPS = 240  # tried by simulation
_SECOND_LOOK = 2.0  # a group that misses a time by less gets more designs tried


@dataclass
class Sizing:
    """What was found.

    Attributes:
        proposals: best first.
        rejected: why not the others, nearest first.
        explored: the best trial of each group that does the task.
        combinations: designs within the limits of space and pressure, times valves and tubes.
        pruned: how many of them the closed form sorted out.
        simulated: transients, specimens left out.
        untried: groups that the closed form leaves and that were not simulated for lack of time.
    """

    proposals: list[Proposal] = field(default_factory=list)
    rejected: list[Rejection] = field(default_factory=list)
    explored: list[Trial] = field(default_factory=list)
    combinations: int = 0
    pruned: int = 0
    simulated: int = 0
    untried: int = 0
    outcome: Outcome = Outcome.COMPLETED


def size(task: Task, catalogue: PartsCatalogue, watch: Watch | None = None) -> Sizing:
    """Drives for a task.

    Args:
        task: what is to be done.
        catalogue: what may be used.
        watch: may end the search early; what was found until then is returned.

    Raises:
        InputError: the task lacks a stroke, or something that pulls the muscle long again.
    """
    found, bench = Sizing(), Bench(task, watch or Watch())
    search = _Search(task, catalogue, bench, found)
    try:
        search.run()
    except EndedError as end:
        found.outcome = end.outcome
    found.simulated = bench.runs
    return found


@dataclass(frozen=True, eq=False)
class DesignCandidate:
    """A group and those of its designs that the closed form leaves, as positions in the sheet."""

    group: Group
    sheet: Sheet
    left: np.ndarray

    @cached_property
    def promise(self) -> float:
        """What the closed form says of its best design, less is better: air times the root of the length."""
        rest = self.sheet.rest
        return float(np.min(rest.air[self.left] * np.sqrt(rest.length[self.left])))

    def design(self, index: int) -> Design:
        """The design at a position of the sheet."""
        rest = self.sheet.rest
        return Design(self.group, float(rest.length[index]), float(rest.pressure[index]))


class _Search:
    def __init__(self, task: Task, catalogue: PartsCatalogue, bench: Bench, found: Sizing) -> None:
        self.task, self.catalogue, self.bench, self.found = task, catalogue, bench, found
        self.parts = [(valve, tube) for valve in catalogue.valves for tube in catalogue.tubes]

    def run(self) -> None:
        """All stages; fills `found`."""
        task, found, bench = self.task, self.found, self.bench
        sheets = [
            sheet_of(part, duty, task)
            for duty in task.duties()
            for part in self.catalogue.muscles
            if temperature_text(part, task) is None
        ]
        found.rejected = at_rest_rejections(sheets, self.catalogue, task, set())
        candidates, failed = self._prune(sheets)
        candidates = self._likely(candidates)
        self._look(_PRUNED)
        good, slow = self._try(candidates)
        found.explored = good
        failed += slow
        chosen = _varied(sorted(good, key=lambda trial: trial.cost()), task.max_proposals + _SPARE)
        steps = bench.each(lambda trial: refined(trial, bench), chosen, (_TRIED, _REFINED), len(chosen))
        better = list(steps)
        proposals: list[Proposal] = []
        for item in bench.each(lambda t: propose(t, bench), better, (_REFINED, _MEASURED), len(better)):
            if isinstance(item, Proposal):
                proposals.append(item)
            else:
                failed.append((item.design.group, item))
        works = {proposal.design.group.muscle.id for proposal in proposals}
        found.rejected = at_rest_rejections(sheets, self.catalogue, task, works)
        found.rejected += slow_rejections(failed, task, works)
        found.rejected.sort(key=lambda rejection: rejection.nearness)
        found.proposals = ranked(proposals, task)[: task.max_proposals]
        found.proposals = self._with_chances(found.proposals)

    def _look(self, share: float) -> None:
        ended = self.bench.watch.ended(share)
        if ended is not None:
            raise EndedError(ended)

    def _prune(self, sheets: list[Sheet]) -> tuple[list[DesignCandidate], list[tuple[Group, Trial | None]]]:
        """What the closed form leaves, and the groups of which it leaves nothing."""
        kept: list[DesignCandidate] = []
        failed: list[tuple[Group, Trial | None]] = []
        for sheet in sheets:
            self.found.combinations += int(sheet.allowed.sum()) * len(self.parts)
            for parallel in range(1, self.task.limits.max_parallel + 1):
                sound = sheet.sound(parallel)
                for valve, tube in self.parts if len(sound) else []:
                    group = Group(sheet.duty, sheet.part, parallel, valve, tube)
                    left = self._quick(group, sheet, sound)
                    if len(left):
                        kept.append(DesignCandidate(group, sheet, left))
                    else:
                        failed.append((group, None))
        self.found.pruned = self.found.combinations - sum(len(candidate.left) for candidate in kept)
        return kept, failed

    def _likely(self, candidates: list[DesignCandidate]) -> list[DesignCandidate]:
        """Those worth simulating: of a pair's pulleys the best, not more groups than there is time for."""
        ordered = sorted(candidates, key=lambda candidate: candidate.promise)
        taken: Counter[tuple[str, int, str, str]] = Counter()
        kept: list[DesignCandidate] = []
        for candidate in ordered:
            group = candidate.group
            key = (group.muscle.id, group.parallel, group.valve.id, group.tube.id)
            taken[key] += 1
            if taken[key] == 1 and len(kept) < _MOST_GROUPS:
                kept.append(candidate)
        self.found.untried = len(taken) - len(kept)
        return kept

    def _quick(self, group: Group, sheet: Sheet, sound: np.ndarray) -> np.ndarray:
        """The designs of a group that the closed form does not show to be too slow."""
        task, most = self.task, group.valve.max_pressure
        if most is not None:
            sound = sound[sheet.rest.pressure[sound] <= most]
        wanted = min(time or np.inf for time in (task.time, task.cycle_time, task.fill_time))
        times = least_time(sheet.rest, sheet.duty, task, conductance=group.conductance)
        return sound[times[sound] <= wanted]

    def _try(self, candidates: list[DesignCandidate]) -> tuple[list[Trial], list[tuple[Group, Trial | None]]]:
        """The best trial of each group that does the task, and the nearest of those that do not."""
        first = [(candidate, index) for candidate in candidates for index in _first_choice(candidate)]
        ran = self._run(first, (_PRUNED, 0.8 * _TRIED))
        again = [
            (candidate, index)
            for candidate, trials in ran.items()
            if not any(trial.does for trial in trials)
            and min(trial.excess() for trial in trials) <= _SECOND_LOOK
            for index in _second_choice(candidate)
        ]
        for candidate, trials in self._run(again, (0.8 * _TRIED, _TRIED)).items():
            ran[candidate] += trials
        good: list[Trial] = []
        slow: list[tuple[Group, Trial | None]] = []
        for candidate, trials in ran.items():
            doing = [trial for trial in trials if trial.does]
            if doing:
                good.append(min(doing, key=lambda trial: trial.cost()))
            else:
                slow.append((candidate.group, min(trials, key=lambda trial: trial.cost())))
        return good, slow

    def _run(
        self, jobs: list[tuple[DesignCandidate, int]], share: tuple[float, float]
    ) -> dict[DesignCandidate, list[Trial]]:
        found: dict[DesignCandidate, list[Trial]] = {}
        for candidate, _ in jobs:
            self.bench.compile(candidate.group)
        trials = self.bench.each(
            lambda job: trial_of(job[0].design(job[1]), self.bench, job[0].sheet.rest.only(job[1])),
            jobs,
            share,
            len(jobs),
        )
        for (candidate, _), trial in zip(jobs, trials, strict=True):
            found.setdefault(candidate, []).append(trial)
        return found

    def _with_chances(self, proposals: list[Proposal]) -> list[Proposal]:
        specimens = self.task.uncertainty.specimens
        if not specimens:
            return proposals
        width = (1.0 - _MEASURED) / max(len(proposals), 1)
        done = [
            replace(
                proposal,
                chance=chance(
                    self.bench,
                    proposal.design,
                    (_MEASURED + i * width, _MEASURED + (i + 1) * width),
                    specimens,
                ),
            )
            for i, proposal in enumerate(proposals)
        ]
        return ranked(done, self.task)


def _varied(trials: list[Trial], count: int) -> list[Trial]:
    """The first so many, but of one choice of muscles only a few while there are others."""
    taken: Counter[tuple[str, int]] = Counter()
    first: list[Trial] = []
    rest: list[Trial] = []
    for trial in trials:
        key = (trial.design.group.muscle.id, trial.design.group.parallel)
        taken[key] += 1
        (first if taken[key] <= _OF_ONE_KIND else rest).append(trial)
    return [*first, *rest][:count]


def _first_choice(candidate: DesignCandidate) -> list[int]:
    """Designs that bracket a group: the least air, the same length at full pressure, the most force."""
    rest, left = candidate.sheet.rest, candidate.left
    cheap = int(left[np.argmin(rest.air[left])])
    same = left[rest.length[left] == rest.length[cheap]]
    strong = int(left[np.argmax(rest.capacity[left])])
    return list(dict.fromkeys((cheap, int(same[np.argmax(rest.pressure[same])]), strong)))


def _second_choice(candidate: DesignCandidate) -> list[int]:
    """Every length at its highest pressure."""
    rest, left = candidate.sheet.rest, candidate.left
    found: dict[float, int] = {}
    for index in left[np.argsort(rest.pressure[left])]:
        found[float(rest.length[index])] = int(index)
    return list(found.values())
