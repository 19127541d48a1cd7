"""How far the probabilities of a diagnosis can be believed: reliability table and Brier score. One command:

    python -m tests.benchmarks.probabilities [--seeds 0,1] [--kind static] [--noise 1,0.15] [--keep FILE]

Every case of `tests.truth` is diagnosed, where possible also with its noise scaled, and every case of
`tests/second_truth`. Each effect that is called missing is an event; *true*: it, or one of the group that
the data cannot tell from it, which shares its probability, is there; *by name*: it is there, or an exact
twin that the case accepts. Only the odd recipes of `tests.truth` calibrate: the regression of
`mckibben.identification.diagnose.probability` on them is printed, and a map with two constants from the
stated probabilities to calibrated ones; the tables are over all others, before and after that map.

On 26 November 2026 (static cases, ``--seeds 0,1``, sets `cases` and `third`), all but the odd recipes:

| told with | effects | true | by name | after the map: effects | true |
|---|---|---|---|---|---|
| 90 to 100 % | 136 | 100 % | 97 % | 144 | 100 % |
| 75 to 90 % | 14 | 100 % | 100 % | 9 | 89 % |
| 50 to 75 % | 7 | 57 % | 29 % | 4 | 50 % |
| 30 to 50 % | 3 | 67 % | 67 % | 2 | 50 % |
| below 30 % | 1 | 0 % | 0 % | 2 | 50 % |

Brier score 0.019 (`cases` 0.031, `third` 0.024), by name 0.047; of always stating the share of true ones
0.030. The map of the odd recipes, logit p' = 0.01 + 1.43 logit p, gives 0.018: it is not used.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from tests.benchmarks import second_truth
from tests.benchmarks.diagnosis import say, subject_and_start
from tests.benchmarks.workers import Examined, add_keep, examined, other_code, own_studio
from tests.truth.cases import Case
from tests.truth.generate import case, names

_BINS = (0.0, 0.3, 0.5, 0.75, 0.9, 1.0)
ODD, EVEN = "odd recipes", "even recipes"


@dataclass(frozen=True)
class Event:
    """One effect of one diagnosis.

    Attributes:
        effect: its id.
        group: it and what the data cannot tell from it.
        named: whether it is called missing; a correction otherwise.
        size, part: what the model loses without it.
        share: of the models visited that hold one of the group.
        beside_unknown: whether an unknown effect remains.
        probability: as the program states it.
        true, by_name: whether one of the group is there, and whether it is itself.
    """

    effect: str
    group: tuple[str, ...]
    named: bool
    size: float
    part: float
    share: float
    beside_unknown: bool
    probability: float
    true: bool
    by_name: bool


@dataclass(frozen=True)
class Question:
    """A case of one of the sets, by its name."""

    of: str
    case: str
    seed: int = 0
    noise: float = 1.0

    def __str__(self) -> str:
        """What it is known by."""
        return f"{self.of}, {self.case} {self.seed}" + (
            "" if self.noise == 1.0 else f", noise x {self.noise}"
        )


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


def events_of(question: Question) -> list[Event]:
    """The events of one case."""
    from mckibben.identification.diagnose.diagnosis import diagnose

    studio = own_studio()
    if question.of in (ODD, EVEN):
        made = case(question.case, question.seed)
        predictor, start = subject_and_start(made, studio)
        predictor = with_noise(made, predictor, question.noise)
        hidden: list[set[str]] = [set(ids) for ids in made.hidden]
    else:
        predictor, start, answer, _ = second_truth.parts_of(question.case)
        hidden = [set(ids) for ids in answer["hidden"]]
    if predictor is None:
        return []
    return events_in(diagnose(predictor, start, catalogue=studio.catalogue), hidden)


def events_in(result: Any, hidden: Sequence[set[str]]) -> list[Event]:
    """The events of a diagnosis whose answer is known."""
    unknown = result.status == "unknown_effect"
    named = {name for item in result.evidence for name in item.group}
    return [
        Event(
            item.effect, item.group, True, item.loss.size, item.loss.part, item.share, unknown,
            item.probability, any(set(item.group) & ids for ids in hidden),
            any(item.effect in ids for ids in hidden),
        )
        for item in result.evidence
    ] + [
        Event(
            item.effect, (item.effect,), False, item.loss.size, item.loss.part, 1.0, unknown,
            item.probability, *[any(item.effect in ids and not ids & named for ids in hidden)] * 2,
        )
        for item in result.corrections
    ]  # fmt: skip


def regression(events: Sequence[Event]) -> np.ndarray:
    """Constant and coefficients of ln size and ln part, by maximum likelihood with a weak prior."""
    from scipy.optimize import minimize

    inputs = np.array([[1.0, np.log(e.size + 1e-12), np.log(e.part + 1e-12)] for e in events])
    sign = np.array([1.0 if e.true else -1.0 for e in events])

    def misfit(weights: np.ndarray) -> float:
        return float(np.sum(np.logaddexp(0.0, -sign * (inputs @ weights))) + 0.02 * np.sum(weights[1:] ** 2))

    return minimize(misfit, np.zeros(3)).x


def one_map(events: Sequence[Event]) -> tuple[float, float]:
    """Constants a and b of logit p' = a + b logit p, by maximum likelihood with a weak prior at 0 and 1."""
    from scipy.optimize import minimize

    logits = _logit(np.array([e.probability for e in events]))
    sign = np.array([1.0 if e.true else -1.0 for e in events])

    def misfit(constants: np.ndarray) -> float:
        a, b = constants
        return float(np.sum(np.logaddexp(0.0, -sign * (a + b * logits))) + 0.5 * a**2 + 2.0 * (b - 1.0) ** 2)

    a, b = minimize(misfit, np.array([0.0, 1.0])).x
    return float(a), float(b)


def _logit(probability: np.ndarray) -> np.ndarray:
    inside = np.clip(probability, 1e-4, 1.0 - 1e-4)
    return np.log(inside / (1.0 - inside))


def mapped(events: Sequence[Event], constants: tuple[float, float]) -> list[Event]:
    """The events with their probabilities mapped."""
    a, b = constants
    logits = a + b * _logit(np.array([e.probability for e in events]))
    return [
        replace(e, probability=float(p)) for e, p in zip(events, 1.0 / (1.0 + np.exp(-logits)), strict=True)
    ]


def table(words: str, events: Sequence[Event]) -> list[str]:
    """Reliability and Brier score of the effects that are called missing."""
    named = [event for event in events if event.named]
    if not named:
        return []
    texts = [f"{words}: {len(named)} effects called missing"]
    for low, high in pairwise(_BINS):
        inside = [e for e in named if low <= e.probability < high or e.probability == high == 1.0]
        if inside:
            true, own = (sum(values) for values in zip(*((e.true, e.by_name) for e in inside), strict=True))
            mean = np.mean([e.probability for e in inside])
            texts.append(
                f"  told with {100 * low:3.0f} to {100 * high:3.0f} % (mean {100 * mean:3.0f} %): "
                f"true {true:3d} of {len(inside):3d} = {100 * true / len(inside):3.0f} %, "
                f"by name {own:3d} = {100 * own / len(inside):3.0f} %"
            )
    brier = [float(np.mean([(e.probability - t) ** 2 for e, t in zip(named, truth, strict=True)]))
             for truth in ([e.true for e in named], [e.by_name for e in named])]  # fmt: skip
    base = float(np.mean([e.true for e in named]))
    texts.append(
        f"  Brier score {brier[0]:.3f}, by name {brier[1]:.3f}; of always stating {100 * base:.0f} %: "
        f"{base * (1.0 - base):.3f}"
    )
    others = [e for e in events if not e.named]
    texts.append(
        f"  corrections that are effects of their own: {sum(e.true for e in others)} of {len(others)}"
    )
    return texts


def questions(
    seeds: Sequence[int], noises: Sequence[float], kind: str, sets: Sequence[str]
) -> list[Question]:
    """All cases to diagnose."""
    order = {name: number for number, name in enumerate(names())}
    asked = [
        Question(ODD if order[name] % 2 else EVEN, name, seed, noise)
        for noise in noises
        for seed in seeds
        for name in names()
        if kind == "all" or (kind == "static") == (case(name, seed).kind != "transient")
    ]
    return asked + [Question(chosen, name) for chosen in sets for name in second_truth.names(chosen)]


def main() -> None:
    """Print the regression of the odd recipes and the reliability of all others."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seeds", default="0,1")
    parser.add_argument("--kind", default="static", help="transient, static or all")
    parser.add_argument("--noise", default="1", help="factors of the noise")
    parser.add_argument("--sets", default="cases,third", help="of tests/second_truth")
    add_keep(parser)
    options = parser.parse_args()
    asked = questions(
        [int(seed) for seed in options.seeds.split(",") if seed],
        [float(factor) for factor in options.noise.split(",")],
        options.kind,
        [chosen for chosen in options.sets.split(",") if chosen],
    )
    lines: list[Examined[list[Event]]] = []
    for line in examined(events_of, asked, keep=options.keep):
        lines.append(line)
        say(f"{line.key:64}{line.seconds:6.1f} s  {', '.join(map(text_of, line.result))}")
    say("")
    for text in summary(lines):
        say(text)


def text_of(event: Event) -> str:
    """An effect with its probability and whether it is there."""
    mark = "" if event.by_name else " (of its group)" if event.true else " WRONG"
    return f"{event.effect} {100.0 * event.probability:.0f} %{mark if event.named else ' correction'}"


def summary(lines: Sequence[Examined[list[Event]]]) -> list[str]:
    """The regression and the tables."""
    events: dict[str, list[Event]] = {}
    for line in lines:
        events.setdefault(line.key.partition(",")[0], []).extend(line.result)
    texts = []
    if len(events.get(ODD, ())) > 10:
        constant, by_size, by_part = regression(events[ODD])
        logit = f"{constant:.2f} + {by_size:.2f} ln size + {by_part:.2f} ln part"
        texts.append(f"{ODD}, {len(events[ODD])} events: logit = {logit}")
    for of, some in events.items():
        texts += table(of if of != ODD else f"{of} (calibrated on)", some)
    apart = [event for of, some in events.items() if of != ODD for event in some]
    texts += table(f"all but the {ODD}", apart)
    named = [event for event in events.get(ODD, ()) if event.named]
    if named and apart:
        a, b = one_map(named)
        texts.append(f"map fitted to the {ODD}: logit p' = {a:.2f} + {b:.2f} logit p")
        texts += table(f"all but the {ODD}, mapped", mapped(apart, (a, b)))
    texts.append(other_code(lines))
    return [text for text in texts if text]


if __name__ == "__main__":
    main()
