"""The order of the proposals, their Pareto front, and an explanation of each rank."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mckibben.sizing.proposal import Proposal
from mckibben.sizing.task import Task
from mckibben.sizing.trial import Trial

_CLASS = 0.05  # width of a class of probability: 100 specimens cannot resolve much less
_SURE = 0.95  # probabilities above this form one class


def ranked(proposals: list[Proposal], task: Task) -> list[Proposal]:
    """Best first, with the front and reasons filled in.

    Whatever the task ranks by, a drive that probably fails comes after one that probably fulfils the task:
    the first key is the probability in classes of 5 % up to 95 %, the second what the task ranks by. If that
    is the probability, the first key is the probability itself and the second the air. Before both, a muscle
    whose force is extrapolated comes after every muscle with a known curve.
    """

    def order(proposal: Proposal) -> tuple[bool, float, float]:
        unknown = proposal.design.group.muscle.extrapolated is not None
        probability = 1.0 if proposal.chance is None else proposal.chance.probability
        if task.rank_by != "probability":
            probability = np.floor(min(probability, _SURE) / _CLASS + 1e-9)
        else:
            return unknown, -probability, proposal.trial.air
        return unknown, -float(probability), proposal.trial.worth()

    ordered = sorted(proposals, key=order)
    front = front_of([proposal.trial for proposal in ordered])
    best = {name: min(_aims(p.trial)[name] for p in ordered) for name in _NAMES} if ordered else {}
    return [
        replace(proposal, front=on_front, reason=_reason(proposal, best))
        for proposal, on_front in zip(ordered, front, strict=True)
    ]


def front_of(trials: list[Trial]) -> list[bool]:
    """Whether no other trial is at least as good in every aim and better in one: air, time, installed length,
    force reserve, stiffness.
    """
    if not trials:
        return []
    table = np.array([list(_aims(trial).values()) for trial in trials])
    no_worse = np.all(table[:, None, :] <= table[None, :, :] * (1.0 + 1e-9), axis=2)
    better = np.any(table[:, None, :] < table[None, :, :] * (1.0 - 1e-9), axis=2)
    return [bool(beaten) for beaten in ~np.any(no_worse & better, axis=0)]


_NAMES = {
    "air": "the least air",
    "time": "the fastest",
    "length": "the shortest",
    "reserve": "the most force in reserve",
    "stiffness": "the stiffest",
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
        texts.append(f"{aims['air'] / best['air']:.2g} times the least air")
    if proposal.chance is not None:
        texts.append(f"fulfils the task with {proposal.chance.probability * 100:.0f} % probability")
    margin = proposal.trial.margins[proposal.trial.binding]
    texts.append(f"nearest limit: {proposal.trial.binding.replace('_', ' ')}, {margin * 100:.2g} % left")
    muscle = proposal.design.group.muscle
    if muscle.extrapolated is not None:
        texts.append(f"behind all others: {muscle.extrapolated}")
    return "; ".join(texts)
