"""The order of the proposals, their Pareto front, and an explanation of each rank."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mckibben.facts.sizing import LIMITS, SIZING
from mckibben.sizing.proposal import Proposal
from mckibben.sizing.task import Task
from mckibben.sizing.trial import Trial

#: Below this margin to a limit a drive has a reservation.
THIN = 0.05
_LIKELY = 0.8  # a drive less probable than this comes after all others
_ERROR = f"± {SIZING['probability_error'].words}"
_SIGMAS = 2.0  # probabilities closer than this many standard errors of their difference are a tie


def ranked(proposals: list[Proposal], task: Task) -> list[Proposal]:
    """Best first, with the front, reservations and reasons filled in.

    Muscles with a known curve come before those whose force is extrapolated. A task that ranks by air,
    length, time or reserve has its drives in that order, whatever their margins and probabilities; those
    whose impact is above ``limits.max_impact_energy`` come after the others. Otherwise:

    1. drives that probably fulfil the task (80 % or more) before the others;
    2. drives without a reservation before those with one: a margin below 5 %, or an impact of stroke or
       return above ``limits.max_impact_energy``;
    3. the probability: drives within two standard errors of the best one left are a tie with it;
    4. within a tie what the task ranks by; the air if that is the probability.
    """
    marked = [replace(proposal, reservations=reservations(proposal, task)) for proposal in proposals]
    ties = _ties(marked)

    def order(index: int) -> tuple[bool, bool, bool, int, float]:
        proposal = marked[index]
        worth = proposal.trial.air if task.rank_by == "probability" else proposal.trial.worth()
        chances = (not _likely(proposal), bool(proposal.reservations), ties[index])
        return (
            proposal.design.group.muscle.extrapolated is not None,
            *(chances if task.robust else (False, _hits_hard(proposal, task), 0)),
            worth,
        )

    ordered = [marked[index] for index in sorted(range(len(marked)), key=order)]
    front = front_of([proposal.trial for proposal in ordered])
    best = {name: min(_aims(p.trial)[name] for p in ordered) for name in _NAMES} if ordered else {}
    return [
        replace(proposal, front=on_front, reason=_reason(proposal, best))
        for proposal, on_front in zip(ordered, front, strict=True)
    ]


def reservations(proposal: Proposal, task: Task) -> tuple[str, ...]:
    """What costs a drive rank although it keeps every limit."""
    trial, most = proposal.trial, task.limits.max_impact_energy
    found = [
        f"only {margin * 100:.2g} % margin to the limit of {LIMITS[name].words}"
        for name, margin in trial.margins.items()
        if margin < THIN
    ]
    if most is not None and _hits_hard(proposal, task):
        place = "the stroke" if proposal.impacts[0] == proposal.impact_energy else "the return"
        found.append(f"an impact of {proposal.impact_energy:.3g} J on {place}, more than {most:.3g} J")
    return tuple(found)


def _hits_hard(proposal: Proposal, task: Task) -> bool:
    most = task.limits.max_impact_energy
    return most is not None and proposal.impact_energy > most


def why_first(ordered: list[Proposal], task: Task) -> str | None:
    """Why the first proposal comes before the second, in one sentence; None for less than two."""
    if len(ordered) < 2:
        return None
    first, second = ordered[:2]
    names = [_name(first), _name(second)]
    if names[0] == names[1]:
        names = [f"{name} of {p.design.length * 1e3:.0f} mm" for name, p in zip(names, ordered, strict=False)]
    before = f"{names[0]} comes before {names[1]}"
    if (unknown := second.design.group.muscle.extrapolated) and not first.design.group.muscle.extrapolated:
        return f"{before}, because the force of the second is not known: {unknown}."
    if not task.robust and _hits_hard(first, task) == _hits_hard(second, task):
        return f"{before}, because {_by_aim(first, second, task)}."
    if _likely(first) and not _likely(second):
        return f"{before}, because {_more_succeed(first, second)}."
    if second.reservations and not first.reservations:
        return f"{before}, because the second has {second.reservations[0]}."
    reason = _by_aim(first, second, task)
    if first.chance is None or second.chance is None:
        return f"{before}, because {reason}."
    if _ties([first, second]) == [0, 0]:
        equal = "as many specimens of both succeed"
        if _share(first) != _share(second):
            shares = f"{_share(first)} and {_share(second)}"
            equal = f"the shares of specimens that succeed, {shares} ({_ERROR}), do not differ significantly"
        return f"{before}: {equal}, and {reason}."
    return f"{before}, because {_more_succeed(first, second)}."


def _more_succeed(first: Proposal, second: Proposal) -> str:
    return f"{_share(first)} of its specimens succeed, not {_share(second)} ({_ERROR})"


def _name(proposal: Proposal) -> str:
    group = proposal.design.group
    return f"{group.parallel} × {group.muscle.id}" if group.parallel > 1 else group.muscle.id


def _share(proposal: Proposal) -> str:
    chance = proposal.chance
    return (
        "an unknown share"
        if chance is None
        else f"{chance.probability * 100:.3g} ± {chance.error * 100:.1g} %"
    )


def _by_aim(first: Proposal, second: Proposal, task: Task) -> str:
    """What the task ranks by, of both."""
    a, b = first.trial, second.trial
    match task.rank_by:
        case "length":
            return f"its rest length is {a.design.length * 1e3:.0f} mm, not {b.design.length * 1e3:.0f} mm"
        case "time":
            return f"it takes {a.figures.time or 0.0:.3g} s, not {b.figures.time or 0.0:.3g} s"
        case "reserve":
            return f"it has {a.force_reserve * 100:.3g} % force in reserve, not {b.force_reserve * 100:.3g} %"
        case "air" | "probability":
            return f"it takes {a.air * 1e3:.3g} l of air a cycle, not {b.air * 1e3:.3g} l"
        case _:
            return (
                f"air, rest length and number of muscles together are less: {a.air * 1e3:.3g} l and "
                f"{a.design.length * 1e3:.0f} mm, not {b.air * 1e3:.3g} l and {b.design.length * 1e3:.0f} mm"
            )


def _likely(proposal: Proposal) -> bool:
    return proposal.chance is None or proposal.chance.probability >= _LIKELY


def _ties(proposals: list[Proposal]) -> list[int]:
    """Number of the tie of each proposal: 0 holds the most probable one and all within its uncertainty."""
    number = [0] * len(proposals)
    left = {index: p.chance for index, p in enumerate(proposals) if p.chance is not None}
    tie = 0
    while left:
        best = max(left.values(), key=lambda chance: chance.probability)
        for index, chance in list(left.items()):
            if best.probability - chance.probability <= _SIGMAS * np.hypot(best.error, chance.error):
                number[index] = tie
                del left[index]
        tie += 1
    return number


def front_of(trials: list[Trial]) -> list[bool]:
    """Whether each is on the Pareto front of them, as `mckibben.facts.sizing` defines it."""
    if not trials:
        return []
    table = np.array([list(_aims(trial).values()) for trial in trials])
    no_worse = np.all(table[:, None, :] <= table[None, :, :] * (1.0 + 1e-9), axis=2)
    better = np.any(table[:, None, :] < table[None, :, :] * (1.0 - 1e-9), axis=2)
    return [bool(beaten) for beaten in ~np.any(no_worse & better, axis=0)]


def joint_front(proposals: Sequence[Proposal], explored: Sequence[Trial]) -> tuple[list[bool], list[bool]]:
    """Whether each proposal and each explored design is on the front of both together.

    Explored designs whose parts are proposed do not count: the proposal is the same drive, refined. They are
    on the front where it is.
    """
    proposed = [_parts(proposal.trial) for proposal in proposals]
    others = [trial for trial in explored if _parts(trial) not in proposed]
    front = front_of([*(proposal.trial for proposal in proposals), *others])
    listed, rest = front[: len(proposed)], iter(front[len(proposed) :])
    of_parts = dict(zip(proposed, listed, strict=True))
    named = [_parts(trial) for trial in explored]
    return listed, [of_parts[parts] if parts in of_parts else next(rest) for parts in named]


def _parts(trial: Trial) -> tuple[str, int, str, str]:
    group = trial.design.group
    return group.muscle.id, group.parallel, group.valve.id, group.tube.id


_NAMES = {
    "air": "the least air of these",
    "time": "the fastest of these",
    "length": "the shortest of these",
    "reserve": "the most force in reserve of these",
    "stiffness": "the stiffest of these",
}


def _aims(trial: Trial) -> dict[str, float]:
    """Figures to be minimised, all positive."""
    rest = trial.rest
    return {
        "air": trial.air,
        "time": trial.figures.time or np.inf,
        "length": trial.design.length,
        "reserve": 1.0 / max(float(rest.capacity[0]), 1e-9),
        "stiffness": 1.0 / max(float(rest.stiffness[0]), 1e-9),
    }


def _reason(proposal: Proposal, best: dict[str, float]) -> str:
    aims = _aims(proposal.trial)
    firsts = [text for name, text in _NAMES.items() if aims[name] <= best[name] * 1.005]
    texts = [", ".join(firsts)] if firsts else []
    if aims["air"] > best["air"] * 1.05:
        texts.append(f"{aims['air'] / best['air']:.2g} times the least air of these")
    texts += proposal.reservations
    margin = proposal.trial.margins[proposal.trial.binding]
    limit = LIMITS[proposal.trial.binding].words
    texts.append(f"{SIZING['binding'].words}: {limit}, {margin * 100:.2g} % left")
    muscle = proposal.design.group.muscle
    if muscle.extrapolated is not None:
        texts.append(f"behind all others: {muscle.extrapolated}")
    return "; ".join(texts)
