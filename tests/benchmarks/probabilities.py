"""How far the probabilities of a diagnosis can be believed: reliability table and Brier score. One command:

    python -m tests.benchmarks.probabilities [--seeds 0,1,2] [--kind static] [--noise 1,0.15]

Every case of `tests.truth` is diagnosed, where possible also with its noise scaled. Each effect that is
called missing, and each that is left out as a correction, is one event: it, or one of its group, is really
there or not. The regression of `mckibben.identification.diagnose.probability` is fitted to the odd recipes
and printed; the table is over the even ones.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from tests.benchmarks.diagnosis import subject_and_start
from tests.benchmarks.workers import in_parallel, own_studio
from tests.truth.cases import Case
from tests.truth.generate import all_cases, names

_BINS = (0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0)


@dataclass(frozen=True)
class Event:
    """One effect of one diagnosis: what it loses without it, its probability, and whether it is there."""

    case: str
    named: bool
    size: float
    part: float
    probability: float
    true: bool


def with_noise(case: Case, predictor: Any, factor: float) -> Any:
    """The data of a case with its noise scaled; None where the readings are not those of the file."""
    from mckibben.identification.predict.quasistatic import QuasistaticPredictor

    if factor == 1.0:
        return predictor
    if not isinstance(predictor, QuasistaticPredictor) or predictor.task.channel != "force":
        return None
    task, clean, read = predictor.task, case.clean.get("force"), case.measured.get("force")
    if clean is None or read is None or len(read) <= np.max(task.rows):
        return None
    if not np.allclose(read[task.rows], task.measured, rtol=1e-4, atol=2e-3 * float(np.ptp(read))):
        return None
    scaled = clean[task.rows] + factor * (task.measured - clean[task.rows])
    return QuasistaticPredictor(replace(task, measured=scaled))


def events_of(question: tuple[Case, float]) -> list[Event]:
    """The events of one case."""
    from mckibben.identification.diagnose.diagnosis import diagnose

    case, factor = question
    studio = own_studio()
    predictor, fit_model = subject_and_start(case, studio)
    data = with_noise(case, predictor, factor)
    if data is None:
        return []
    found = diagnose(data, fit_model, catalogue=studio.catalogue)
    named = set().union(*(item.group for item in found.evidence)) if found.evidence else set()
    events = [
        Event(
            case.name,
            True,
            item.loss.size,
            item.loss.part,
            item.probability,
            any(set(item.group) & h for h in case.hidden),
        )
        for item in found.evidence
    ]
    return events + [
        Event(
            case.name,
            False,
            item.loss.size,
            item.loss.part,
            item.probability,
            any(item.effect in h and not h & named for h in case.hidden),
        )
        for item in found.corrections
    ]


def regression(events: Sequence[Event]) -> np.ndarray:
    """Constant and coefficients of ln size and ln part, by maximum likelihood with a weak prior."""
    from scipy.optimize import minimize

    inputs = np.array([[1.0, np.log(e.size + 1e-12), np.log(e.part + 1e-12)] for e in events])
    sign = np.array([1.0 if e.true else -1.0 for e in events])

    def misfit(weights: np.ndarray) -> float:
        return float(np.sum(np.logaddexp(0.0, -sign * (inputs @ weights))) + 0.02 * np.sum(weights[1:] ** 2))

    return minimize(misfit, np.zeros(3)).x


def main() -> None:
    """Print the regression of the odd recipes and the reliability of the even ones."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seeds", default="0,1,2")
    parser.add_argument("--kind", default="static", help="transient, static or all")
    parser.add_argument("--noise", default="1,0.15", help="factors of the noise")
    given = parser.parse_args()
    chosen = [
        (case, float(factor))
        for case in all_cases(seeds=[int(seed) for seed in given.seeds.split(",")])
        for factor in given.noise.split(",")
        if given.kind == "all" or (given.kind == "static") == (case.kind != "transient")
    ]
    events = [event for each in in_parallel(events_of, chosen) for event in each]
    order = {name: number for number, name in enumerate(names())}
    odd = [event for event in events if order[event.case] % 2]
    even = [event for event in events if not order[event.case] % 2]
    constant, by_size, by_part = regression(odd)
    logit = f"{constant:.2f} + {by_size:.2f} ln size + {by_part:.2f} ln part"
    say(f"odd recipes, {len(odd)} events: logit = {logit}")
    say(f"even recipes, {len(even)} events; probabilities as the program states them")
    for low, high in pairwise(_BINS):
        inside = [e for e in even if low <= e.probability < high or e.probability == high == 1.0]
        share = f"{100.0 * sum(e.true for e in inside) / len(inside):.0f} % true" if inside else "-"
        say(f"  {100 * low:3.0f} to {100 * high:3.0f} %: {len(inside):4d}  {share}")
    brier = float(np.mean([(e.probability - e.true) ** 2 for e in even])) if even else float("nan")
    base = float(np.mean([e.true for e in even])) if even else float("nan")
    say(f"Brier score {brier:.3f}; of always stating {100 * base:.0f} %: {base * (1.0 - base):.3f}")
    named = [e for e in even if e.named]
    say(f"named effects that are not there: {sum(not e.true for e in named)} of {len(named)}")


def say(text: str) -> None:
    """Write a line at once."""
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
