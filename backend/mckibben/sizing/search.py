"""The search: closed form over all combinations, simulation of the remaining, refinement, probability."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mckibben.simulation.outcome import Outcome, Watch
from mckibben.sizing.batch import Bench, EndedError
from mckibben.sizing.catalogue import Design, Group, PartsCatalogue
from mckibben.sizing.design_table import Sheet, sheet_of
from mckibben.sizing.proposal import Proposal, chance, propose
from mckibben.sizing.ranking import ranked
from mckibben.sizing.refine import refined
from mckibben.sizing.rejection import (
    Failed,
    Rejection,
    RemedyKey,
    Unsound,
    WrongPressure,
    at_rest_rejections,
    slow_rejections,
    temperature_text,
    unsound,
)
from mckibben.sizing.statics import least_time
from mckibben.sizing.task import Task
from mckibben.sizing.trial import AtRest, Trial, at_rest_of, times_over, trial_of

# Progress after each stage, as a share of the whole work.
_PRUNED, _TRIED, _REFINED, _MEASURED = 0.1, 0.35, 0.65, 0.7
_FASTEST = 2  # choices of valve and tube with which a remedy is run
_OF_ONE_KIND = 4  # most proposals with the same muscles, while there are others
_SPARE = 4  # designs refined beyond the number requested: some fail on the fine grid
_MOST_GROUPS = 240  # most groups simulated
_SECOND_LOOK = 2.0  # a group gets more designs tried if its time is within this factor of the required one


@dataclass
class Sizing:
    """The result of a search.

    Attributes:
        proposals: best first.
        rejected: the rejected candidates, nearest first.
        explored: the best trial of each group that fulfils the task.
        combinations: designs within the limits of length, pressure and contraction, times valves and tubes.
        pruned: number of them that the closed form ruled out.
        simulated: number of transient runs, without those of specimens.
        choices: choices of parts that the closed form does not rule out.
        untried: those of them that were not simulated: to save time, or because the watch ended the search.
        refined: whether lengths and pressures were searched to the end.
        outcome: how it ended; unless it is complete, the proposals are the best of what was simulated.
    """

    proposals: list[Proposal] = field(default_factory=list)
    rejected: list[Rejection] = field(default_factory=list)
    explored: list[Trial] = field(default_factory=list)
    combinations: int = 0
    pruned: int = 0
    simulated: int = 0
    choices: int = 0
    untried: int = 0
    refined: bool = False
    outcome: Outcome = Outcome.COMPLETED


def size(task: Task, catalogue: PartsCatalogue, watch: Watch | None = None) -> Sizing:
    """Drives for a task.

    Args:
        task: the task.
        catalogue: the parts that may be used.
        watch: may end the search early; then the drives found so far are returned, ranked.

    Raises:
        InputError: the task has no stroke, or nothing stretches the muscle again.
    """
    sizing = Sizing()
    try:
        bench = Bench(task, watch or Watch())
    except EndedError as end:
        sizing.outcome = end.outcome
        return sizing
    search = _Search(task, catalogue, bench, sizing)
    try:
        search.run()
    except EndedError as end:
        sizing.outcome = end.outcome
    search.conclude()
    sizing.simulated = bench.runs
    return sizing


@dataclass(frozen=True, eq=False)
class DesignCandidate:
    """A group and its designs not ruled out by the closed form, as positions in the sheet."""

    group: Group
    sheet: Sheet
    left: np.ndarray

    @cached_property
    def promise(self) -> float:
        """Estimate for its best design, less is better: air times the square root of the length."""
        rest = self.sheet.rest
        return float(np.min(rest.air[self.left] * np.sqrt(rest.length[self.left])))

    def design(self, index: int) -> Design:
        """The design at a position of the sheet."""
        rest = self.sheet.rest
        return Design(self.group, float(rest.length[index]), float(rest.pressure[index]))

    def at_rest(self, index: int) -> AtRest:
        """The statics of the design at a position of the sheet."""
        return at_rest_of(self.sheet.rest, self.sheet.margins, index)


class _Search:
    def __init__(self, task: Task, catalogue: PartsCatalogue, bench: Bench, sizing: Sizing) -> None:
        self.task, self.catalogue, self.bench, self.sizing = task, catalogue, bench, sizing
        self.parts = [(valve, tube) for valve in catalogue.valves for tube in catalogue.tubes]
        self.sheets: list[Sheet] = []
        self.failed: list[Failed] = []
        self.ran: dict[DesignCandidate, list[Trial]] = {}
        self.better: list[Trial] | None = None  # to be proposed; None = none is chosen yet
        self.proposals: list[Proposal] = []
        self.settled = False  # whether each candidate was tried as often as it can be
        self.broken: list[Failed] = []  # those that break a limit on the fine grid
        self.ruled_out: list[Unsound] = []
        self.lateness: dict[RemedyKey, float] = {}

    def run(self) -> None:
        """Run all stages; what each finds stays, wherever the watch ends them.

        Raises:
            EndedError: the watch ended the search.
        """
        task, bench = self.task, self.bench
        bench.check_end(0.0)
        self.sheets = [
            sheet_of(part, duty, task)
            for duty in task.duties()
            for part in self.catalogue.muscles
            if temperature_text(part, task) is None
        ]
        candidates = self._likely(self._prune())
        self.ruled_out = unsound(self.sheets, task)
        bench.check_end(_PRUNED)
        self._try(candidates)
        self._try_remedies()
        self.better = self._chosen(task.max_proposals + _SPARE)
        for better in refined(self.better, bench, (_TRIED, _REFINED)):
            self.better = better
        self.sizing.refined = True
        share, total = (_REFINED, _MEASURED), len(self.better)
        for item in bench.each(lambda trial: propose(trial, bench), self.better, share, total):
            self._take(item)
        self._give_chances()

    def conclude(self) -> None:
        """Rank and reject by what was found; of a search whose time is over the best drives are proposed."""
        task, sizing = self.task, self.sizing
        good, slow = self._judged()
        if sizing.outcome is Outcome.TIMED_OUT:
            left = self._chosen(task.max_proposals) if self.better is None else self.better
            for trial in left[: max(task.max_proposals - len(self.proposals), 0)]:
                self._take(propose(trial, self.bench))
        sizing.explored = good
        sizing.untried = sizing.choices - len(self.ran)
        works = {proposal.design.group.muscle.id for proposal in self.proposals}
        sizing.rejected = at_rest_rejections(self.ruled_out, self.catalogue, task, works, self.lateness)
        broken = self.broken if sizing.refined else []  # another length or pressure may keep the limit
        sizing.rejected += slow_rejections([*self.failed, *slow, *broken], task, works)
        sizing.rejected.sort(key=lambda rejection: rejection.nearness)
        sizing.proposals = ranked(self.proposals, task)[: task.max_proposals]

    def _take(self, item: Proposal | Trial) -> None:
        """Take a drive that was measured on the fine grid, the next one of those to propose."""
        self.better = (self.better or [])[1:]
        if isinstance(item, Proposal):
            self.proposals.append(item)
        else:
            self.broken.append((item.design.group, item))

    def _chosen(self, count: int) -> list[Trial]:
        """The trials worth refining and proposing."""
        return _varied(sorted(self._judged()[0], key=_by_cost), count)

    def _prune(self) -> list[DesignCandidate]:
        """Candidates not ruled out by the closed form."""
        kept: list[DesignCandidate] = []
        failed = self.failed
        for sheet in self.sheets:
            self.sizing.combinations += int(sheet.allowed.sum()) * len(self.parts)
            for parallel in range(1, self.task.limits.max_parallel + 1):
                sound = sheet.sound(parallel)
                for valve, tube in self.parts if len(sound) else []:
                    group = Group(sheet.duty, sheet.part, parallel, valve, tube)
                    suited = _suited(group, sheet, sound)
                    if not len(suited):
                        needed = sheet.rest.pressure[sound]
                        failed.append((group, WrongPressure(float(needed.min()), float(needed.max()))))
                        continue
                    left = self._quick(group, sheet, suited)
                    if len(left):
                        kept.append(DesignCandidate(group, sheet, left))
                    else:
                        failed.append((group, None))
        self.sizing.pruned = self.sizing.combinations - sum(len(candidate.left) for candidate in kept)
        return kept

    def _likely(self, candidates: list[DesignCandidate]) -> list[DesignCandidate]:
        """Candidates worth simulating: one pulley radius for each choice of parts, at most `_MOST_GROUPS`."""
        ordered = sorted(candidates, key=lambda candidate: candidate.promise)
        taken: Counter[tuple[str, int, str, str]] = Counter()
        kept: list[DesignCandidate] = []
        for candidate in ordered:
            group = candidate.group
            key = (group.muscle.id, group.parallel, group.valve.id, group.tube.id)
            taken[key] += 1
            if taken[key] == 1 and len(kept) < _MOST_GROUPS:
                kept.append(candidate)
        self.sizing.choices, self.sizing.untried = len(taken), len(taken) - len(kept)
        return kept

    def _quick(self, group: Group, sheet: Sheet, sound: np.ndarray) -> np.ndarray:
        """Designs of a group that the closed form does not rule out as too slow."""
        task = self.task
        wanted = min(time or np.inf for time in (task.time, task.cycle_time, task.fill_time))
        times = least_time(sheet.rest, sheet.duty, task, conductance=group.conductance)
        return sound[times[sound] <= wanted]

    def _try(self, candidates: list[DesignCandidate]) -> None:
        """Simulate some designs of each candidate, and more of those that are nearly quick enough."""
        first = [(candidate, index) for candidate in candidates for index in _first_choice(candidate)]
        self._run(first, (_PRUNED, 0.8 * _TRIED))
        again = [
            (candidate, index)
            for candidate, trials in self.ran.items()
            if not any(trial.keeps_limits for trial in trials) and not _far_off(candidate, trials)
            for index in _second_choice(candidate)
        ]
        self._run(again, (0.8 * _TRIED, _TRIED))
        self.settled = True

    def _try_remedies(self) -> None:
        """Run what would help the muscles that the closed form rules out, with the parts of the most flow."""
        jobs: dict[RemedyKey, list[Design]] = {}
        for item in self.ruled_out:
            for key, count, length, pressure in item.designs:
                groups = [Group(item.sheet.duty, item.sheet.part, count, *pair) for pair in self.parts]
                groups.sort(key=lambda group: -group.conductance)
                for group in groups[:_FASTEST]:
                    self.bench.compile(group)
                    jobs.setdefault(key, []).append(Design(group, length, pressure))
        self.bench.run_ahead([each for designs in jobs.values() for each in designs], (_TRIED, _TRIED))
        for key, designs in jobs.items():
            for figures in map(self.bench.run, designs):
                arrives = figures.time is not None and figures.holds
                late = max(times_over(figures, self.task).values(), default=0.0) if arrives else np.inf
                self.lateness[key] = min(self.lateness.get(key, np.inf), late)

    def _judged(self) -> tuple[list[Trial], list[Failed]]:
        """The best trial of each group that fulfils the task, and the nearest trial of each other group.

        Before the end no group is among the others that another length or pressure might make quick enough.
        """
        good: list[Trial] = []
        slow: list[Failed] = []
        for candidate, trials in self.ran.items():
            good_trials = [trial for trial in trials if trial.keeps_limits]
            if good_trials:
                good.append(min(good_trials, key=lambda trial: trial.cost()))
            elif self.settled or _far_off(candidate, trials):
                slow.append((candidate.group, min(trials, key=lambda trial: trial.cost())))
        return good, slow

    def _run(self, jobs: list[tuple[DesignCandidate, int]], share: tuple[float, float]) -> None:
        for candidate, _ in jobs:
            self.bench.compile(candidate.group)
        end = None
        try:
            self.bench.run_ahead([candidate.design(index) for candidate, index in jobs], share)
        except EndedError as stop:
            end = stop
        # What ran ahead is only judged here: threads would gain nothing.
        for candidate, index in jobs:
            if self.bench.has_run(candidate.design(index)):
                trial = trial_of(candidate.design(index), self.bench, candidate.at_rest(index))
                self.ran.setdefault(candidate, []).append(trial)
        if end is not None:
            raise end

    def _give_chances(self) -> None:
        specimens = self.task.uncertainty.specimens
        self.proposals = ranked(self.proposals, self.task)[: self.task.max_proposals]
        if not specimens:
            return
        width = (1.0 - _MEASURED) / max(len(self.proposals), 1)
        for i, proposal in enumerate(self.proposals):
            share = (_MEASURED + i * width, _MEASURED + (i + 1) * width)
            known = chance(self.bench, proposal.design, share, specimens)
            self.proposals[i] = replace(proposal, chance=known)


def _suited(group: Group, sheet: Sheet, sound: np.ndarray) -> np.ndarray:
    """Those designs whose pressure the valve is made for."""
    low, high = group.valve.min_pressure or 0.0, group.valve.max_pressure or np.inf
    pressure = sheet.rest.pressure[sound]
    return sound[(pressure >= low) & (pressure <= high)]


def _varied(trials: list[Trial], count: int) -> list[Trial]:
    """The first ``count`` trials, at most `_OF_ONE_KIND` with the same muscles while there are others."""
    taken: Counter[tuple[str, int]] = Counter()
    first: list[Trial] = []
    rest: list[Trial] = []
    for trial in trials:
        key = (trial.design.group.muscle.id, trial.design.group.parallel)
        taken[key] += 1
        (first if taken[key] <= _OF_ONE_KIND else rest).append(trial)
    return [*first, *rest][:count]


def _by_cost(trial: Trial) -> tuple[bool, float]:
    """The least cost first; muscles whose force is extrapolated last."""
    return trial.design.group.muscle.extrapolated is not None, trial.cost()


def _first_choice(candidate: DesignCandidate) -> list[int]:
    """Designs that bracket a group: the least air, the same length at full pressure, the most force."""
    rest, left = candidate.sheet.rest, candidate.left
    cheap = int(left[np.argmin(rest.air[left])])
    same = left[rest.length[left] == rest.length[cheap]]
    strong = int(left[np.argmax(rest.capacity[left])])
    return list(dict.fromkeys((cheap, int(same[np.argmax(rest.pressure[same])]), strong)))


def _far_off(candidate: DesignCandidate, trials: list[Trial]) -> bool:
    """Whether all designs of the first choice were tried and none of them is nearly quick enough."""
    tried = len(trials) >= len(_first_choice(candidate))
    return tried and min(trial.excess() for trial in trials) > _SECOND_LOOK


def _second_choice(candidate: DesignCandidate) -> list[int]:
    """Every length at its highest pressure."""
    rest, left = candidate.sheet.rest, candidate.left
    by_length: dict[float, int] = {}
    for index in left[np.argsort(rest.pressure[left])]:
        by_length[float(rest.length[index])] = int(index)
    return list(by_length.values())
