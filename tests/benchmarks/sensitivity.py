"""What each step and each threshold of the diagnosis is worth: with and without, 20 % more and less.

    python -m tests.benchmarks.sensitivity [--seed N] [--only TEXT] [--cheap S]
        [--without NAME ... | --thresholds TEXT] [--keep FILE]

A variation replaces a function of the diagnosis by the answer it has where it does nothing, or multiplies
one of `mckibben.identification.thresholds` by 0.8 or 1.2. All cases of `tests.benchmarks.strangers` are asked
with it in a process forked for it. A line shows the cases that are right, those whose answer changes (status,
effects named, entries asked, rows set aside), and the processor time, beside the same without a variation. A
step that changes nothing is superfluous; a threshold that changes nothing is not tuned.
"""

from __future__ import annotations

import argparse
import multiprocessing
import pickle
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mckibben.identification import thresholds
from tests.benchmarks.strangers import Line, asked
from tests.benchmarks.strangers_cases import Stranger, strangers

HOUSE = "mckibben.identification."
FACTORS = (0.8, 1.2)

#: Step -> module, function, and what it answers where it does nothing.
STEPS: Mapping[str, tuple[str, str, Callable[..., Any]]] = {
    "pairs of steps": ("diagnose.search", "_two_steps_on", lambda fitter, best, root: best),
    "fewer effects": ("diagnose.search", "_with_fewer_effects", lambda fitter, best, root: best),
    "elimination and exchange": ("diagnose.search", "_polished", lambda fitter, best, root: best),
    "ends of the data": ("diagnose.search", "reaching_farthest", lambda best, *_, **__: best),
    "usual values": ("diagnose.twins", "as_usual", lambda fitter, best, *_, **__: best),
    "two for one": ("diagnose.twins", "_by_two", lambda *_: []),
    "from another start": ("diagnose.twins", "_in_its_place", lambda fitter, kept, effect, other: other),
    "own law": ("diagnose.twins", "_with_own_law", lambda fitter, best, effect, exchange: exchange),
    "imitation": ("diagnose.twins", "_imitates", lambda *_: False),
    "pruning by noise": ("diagnose.stages", "pruned", lambda fitter, best, root: best),
    "corrections": ("diagnose.stages", "without_corrections", lambda fitter, best, *_: (best, ())),
    "kept corrections": ("diagnose.stages", "refined", lambda fitter, lean, searched, found: ([], found)),
    "vented gauge": ("diagnose.stages", "vented", lambda *_: None),
    "best with entries as stated": ("diagnose.contest", "_at_its_best", lambda fitter, _, best, *__: best),
    "entries beside single effects": ("diagnose.contest", "_with_effects", lambda trial, *_, **__: trial),
    "reading errors": ("diagnose.diagnosis", "absorbed_by", lambda *_: ()),
}  # fmt: skip


class Variation(NamedTuple):
    """A step of a module left out (``factor`` is None), or a threshold of a group multiplied."""

    name: str
    module: str
    attribute: str
    factor: float | None

    def __str__(self) -> str:
        return f"without {self.name}" if self.factor is None else f"{self.name} x {self.factor:g}"


class Told(NamedTuple):
    """What was said of a case, whether it is right, and its processor time [s]."""

    right: bool
    said: tuple[Any, ...]
    seconds: float


NOTHING = Variation("nothing", "", "", 1.0)


def constants(text: str) -> Iterator[Variation]:
    """Each threshold of a group whose name contains a text, less and more."""
    for name, group in sorted(vars(thresholds).items()):
        if is_dataclass(group) and not isinstance(group, type) and text in name:
            for each in fields(group):
                for factor in FACTORS:
                    yield Variation(f"{name}.{each.name}", name, each.name, factor)


def varied(variation: Variation) -> None:
    """Replace what a variation is about, in this process."""
    if variation is NOTHING:
        return
    if variation.factor is None:
        setattr(sys.modules[variation.module], variation.attribute, STEPS[variation.name][2])
        return
    group = getattr(thresholds, variation.module)
    before = getattr(group, variation.attribute)
    after = before * variation.factor
    if isinstance(before, int):
        after = max(1, min(before - 1, round(after))) if after < before else max(before + 1, round(after))
    object.__setattr__(group, variation.attribute, after)  # for all of the house, in this process alone


def told(line: Line, seconds: float) -> Told:
    """The part of an answer that a reader acts on."""
    said = tuple(
        (
            answer.status,
            tuple(sorted(answer.groups)),
            tuple(sorted(name for name, asks in answer.doubts if asks)),
            tuple(sorted(answer.rows)),
        )
        for answer in line.answers
    )
    return Told(line.right, said, seconds)


def _all(variation: Variation, cases: Sequence[Stranger], answers: Any) -> None:
    varied(variation)
    for case in cases:
        begun = time.process_time()
        answers.send(told(asked(case), time.process_time() - begun))


def asked_with(variation: Variation, cases: Sequence[Stranger]) -> list[Told]:
    """All cases with a variation, in a process of its own."""
    mine, theirs = multiprocessing.Pipe(duplex=False)
    child = multiprocessing.get_context("fork").Process(target=_all, args=(variation, cases, theirs))
    child.start()
    theirs.close()
    found = [mine.recv() for _ in cases]
    child.join()
    return found


def line(variation: Variation, cases: Sequence[Stranger], before: list[Told], after: list[Told]) -> str:
    """What a variation changes."""
    pairs = list(zip(cases, before, after, strict=True))
    other = [case.name for case, one, two in pairs if one.said != two.said]
    better = [case.name for case, one, two in pairs if two.right and not one.right]
    worse = [case.name for case, one, two in pairs if one.right and not two.right]
    text = (
        f"{variation!s:60}{sum(one.right for one in after):5d}{len(other):5d}"
        f"{sum(one.seconds for one in after):8.0f}{max(one.seconds for one in after):7.1f}"
    )
    for title, names in (("better", better), ("worse", worse)):
        text += f"  {title}: {', '.join(names)}" if names else ""
    return text


def main() -> None:
    """Print a line for each variation."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seed", type=int, default=2)
    parser.add_argument("--only", default="", help="part of the name of the cases")
    parser.add_argument("--cheap", type=float, default=np.inf, help="only cases that need fewer seconds")
    parser.add_argument("--without", nargs="*", help="names of steps; all of them without a name")
    parser.add_argument("--thresholds", help="part of the name of their group")
    parser.add_argument("--keep", type=Path, help="file that keeps the answers")
    given = parser.parse_args()
    cases = strangers(given.seed, given.only)
    kept: dict[str, list[Told]] = {}
    if given.keep is not None and given.keep.exists():
        kept = pickle.loads(given.keep.read_bytes())

    def answers(variation: Variation) -> list[Told]:
        if str(variation) not in kept:
            kept[str(variation)] = asked_with(variation, cases)
            if given.keep is not None:
                given.keep.write_bytes(pickle.dumps(kept))
        return kept[str(variation)]

    asked(cases[0])  # imports and compiles
    before = answers(NOTHING)
    cheap = [place for place, one in enumerate(before) if one.seconds < given.cheap]
    if len(cheap) < len(cases):
        cases, before = [cases[place] for place in cheap], [before[place] for place in cheap]
        kept.clear()
        given.keep = None
    sys.stdout.write(f"{'':60}right other  s in all  worst\n{line(NOTHING, cases, before, before)}\n")
    variations: list[Variation] = []
    if given.without is not None:
        variations = [
            Variation(name, HOUSE + module, attribute, None)
            for name, (module, attribute, _) in STEPS.items()
            if name in (given.without or STEPS)
        ]
    if given.thresholds is not None:
        variations += constants(given.thresholds)
    for variation in variations:
        sys.stdout.write(line(variation, cases, before, answers(variation)) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
