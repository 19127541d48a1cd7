"""The order of the proposals, the front of those that nothing beats, and why each stands where it does."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mckibben.sizing.proposal import Proposal
from mckibben.sizing.task import Task
from mckibben.sizing.trial import Trial

#: Probabilities nearer than this are not told apart when something else decides [-].
_CLASS = 0.05
_SURE = 0.95


def ranked(proposals: list[Proposal], task: Task) -> list[Proposal]:
    """Best first, with the front and reasons filled in.

    Whatever the task ranks by, a drive that probably fails comes after one that probably does: classes of
    5 % of the probability up to 95 % come first. Ranked by probability, the probability itself does.
    """

    def order(proposal: Proposal) -> tuple[float, float]:
        probability = 1.0 if proposal.chance is None else proposal.chance.probability
        if task.rank_by != "probability":
            probability = np.floor(min(probability, _SURE) / _CLASS + 1e-9)
        else:
            return -probability, proposal.trial.air
        return -float(probability), proposal.trial.worth()

    found = sorted(proposals, key=order)
    front = front_of([proposal.trial for proposal in found])
    best = {name: min(_aims(p.trial)[name] for p in found) for name in _NAMES} if found else {}
    return [
        replace(proposal, front=on_front, reason=_reason(proposal, best))
        for proposal, on_front in zip(found, front, strict=True)
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
    """What is to be small, all positive."""
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
        texts.append(f"does the task with {proposal.chance.probability * 100:.0f} % probability")
    margin = proposal.trial.margins[proposal.trial.binding]
    texts.append(f"nearest limit: {proposal.trial.binding.replace('_', ' ')}, {margin * 100:.2g} % left")
    return "; ".join(texts)
