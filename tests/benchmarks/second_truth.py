"""The diagnosis examined by somebody else: the cases of `tests/second_truth`, and what their models predict.

    python -m tests.benchmarks.second_truth [--set cases|third|fourth] [--only c01,c02] [--keep FILE]

Errors are over the true noise. *Surplus*: a named group that holds no hidden effect. *Held*: error of the
repaired model on the second test of the same muscle, without fitting anything again; *band*: over its
twins.

On 26 November 2026, `cases` and `third`: single 41 of 42, pairs and triples 19 of 21, false alarms 0 of 11,
surplus 4 of 63, second test within 1.2 x noise 56 of 63, told with 90 % or more 76 of 76 true; where twins
part (4 cases) the band holds 93 % of the readings (wanted 85-95 %). `fourth`: single 16 of 17, pairs and
triples 7 of 9, false alarms 0 of 4, surplus 7 of 26, second test 17 of 26, told with 90 % or more 29 of 32;
where twins part (7 cases) the band holds 85 %. Before hanging loads were followed along their own way: second
test 54 of 63 and 16 of 26.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from tests.benchmarks.diagnosis import say
from tests.benchmarks.held_out import band
from tests.benchmarks.workers import Examined, add_keep, examined, other_code, own_studio

SETS = Path(__file__).parents[1] / "second_truth"
OF_LETTER = {"c": "cases", "d": "third", "e": "fourth"}
WANTED = 1.2  # largest error over the noise of a prediction that holds


@dataclass
class Line:
    """What became of one case."""

    case: str
    kind: str
    hidden: list[list[str]]
    status: str
    named: tuple[str, ...]
    found: int
    surplus: list[str]
    start: float
    after: float
    held: float
    seconds: float
    told: list[tuple[float, bool]] = field(default_factory=list)
    parting: int = 0
    spread: float = 0.0
    covered: float = float("nan")

    @property
    def right(self) -> bool:
        """Whether all hidden effects and nothing else are named."""
        return self.found == len(self.hidden) and not self.surplus


def names(chosen: str = "cases") -> list[str]:
    """Names of the cases of a set."""
    with zipfile.ZipFile(SETS / f"{chosen}.zip") as archive:
        return sorted({name.partition("/")[0] for name in archive.namelist() if name.endswith("answer.json")})


def parts_of(case: str) -> tuple[Any, Any, dict[str, Any], bytes]:
    """Predictor and start model of a case, its answer, and the file of its second test."""
    from mckibben.documents.muscle import MuscleInput
    from mckibben.documents.start_model import stated_muscle
    from mckibben.identification.predict import predictor_of
    from mckibben.identification.predict.fit_model import FitModel
    from mckibben.measurement.reading import read_measurement

    with zipfile.ZipFile(SETS / f"{OF_LETTER[case[0]]}.zip") as archive:
        train, held, given, answer = (
            archive.read(f"{case}/{name}") for name in ("train.csv", "held.csv", "given.json", "answer.json")
        )
    studio = own_studio()
    muscle = stated_muscle(MuscleInput.model_validate(json.loads(given)["muscle"]))
    model = studio.static_model(studio.start_model(muscle, {}))
    start = FitModel(model.muscle, model.effects, model.values)
    return predictor_of(read_measurement(train, "train.csv"), start.muscle), start, json.loads(answer), held


def diagnosed(case: str) -> Line:
    """Diagnose one case, predict its second test, and open its answer."""
    from mckibben.identification.diagnose.diagnosis import diagnose
    from mckibben.identification.predict import predictor_of
    from mckibben.measurement.reading import read_measurement

    studio = own_studio()
    predictor, start, truth, held = parts_of(case)
    began = time.perf_counter()
    result = diagnose(predictor, start, catalogue=studio.catalogue)
    seconds = time.perf_counter() - began
    other = predictor_of(read_measurement(held, "held.csv"), start.muscle)
    other = other.prepared(start, tuple(studio.catalogue.values()))
    noise = truth["noise"]["held"]

    def error_of(model: Any) -> np.ndarray:
        return (other.measured - other.predict(model)) / noise

    error = error_of(result.best.fit_model)
    parting, spread, covered = band(
        error,
        error_of(result.lean.fit_model),
        [error_of(twin.fitted_model.fit_model) for twin in result.alternatives],
    )
    hidden = [set(ids) for ids in truth["hidden"]]
    groups = [{name, *(a.effect for a in result.alternatives if a.of == name)} for name in result.added]
    return Line(
        case=case,
        kind=predictor.kind,
        hidden=truth["hidden"],
        status=result.status,
        named=result.added,
        found=sum(any(ids & group for group in groups) for ids in hidden),
        surplus=[
            name
            for name, group in zip(result.added, groups, strict=True)
            if not any(group & ids for ids in hidden)
        ],
        start=result.start.rmse / truth["noise"]["train"],
        after=result.best.rmse / truth["noise"]["train"],
        held=float(np.sqrt(np.mean(error**2))),
        parting=parting,
        spread=spread,
        covered=covered,
        seconds=seconds,
        told=[(item.probability, any(set(item.group) & ids for ids in hidden)) for item in result.evidence],
    )


def summary(lines: Sequence[Line]) -> list[str]:
    """The figures of the table."""
    single = [line for line in lines if len(line.hidden) == 1]
    several = [line for line in lines if len(line.hidden) > 1]
    nothing = [line for line in lines if not line.hidden]
    known = [*single, *several]
    sure = [true for line in lines for probability, true in line.told if probability >= 0.9]
    held = [line.held for line in known]
    parting = [line for line in known if line.parting]
    covered = 100.0 * float(np.mean([line.covered for line in parting])) if parting else float("nan")
    return [
        f"single effect found                 {sum(line.found == 1 for line in single)} of {len(single)}",
        "pairs and triples: all found        "
        f"{sum(line.found == len(line.hidden) for line in several)} of {len(several)}",
        f"nothing missing: false alarms       {sum(bool(line.named) for line in nothing)} of {len(nothing)}",
        f"with surplus effects                {sum(bool(line.surplus) for line in known)} of {len(known)}",
        f"second test: error <= {WANTED} x noise   {sum(one <= WANTED for one in held)} of {len(held)}",
        f"told with 90 % or more: true        {sum(sure)} of {len(sure)}",
        f"where twins part ({len(parting)} cases): 90 % band over them holds {covered:.0f} % of the readings",
    ]


def text_of(line: Line) -> str:
    """A line of the table."""
    parts = [
        f"{'ok' if line.right else '--'} {line.case} {line.kind:10}{line.status:16}",
        f"{line.start:6.1f} ->{line.after:6.2f}  held {line.held:6.2f}  {line.seconds:5.1f} s ",
        ", ".join(line.named),
        "" if line.right else f"hidden {'; '.join('/'.join(ids) for ids in line.hidden)}",
        f"surplus {', '.join(line.surplus)}" if line.surplus else "",
        f"twins part by {line.spread:.1f}, band {100.0 * line.covered:.0f} %" if line.parting else "",
    ]
    return " ".join(part for part in parts if part)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--only", default="", help="cases, separated by commas")
    parser.add_argument("--set", default="cases", choices=tuple(OF_LETTER.values()), help="which examiner's")
    add_keep(parser)
    given = parser.parse_args()
    chosen = [name for name in given.only.split(",") if name] or names(given.set)
    lines = []
    kept: list[Examined[Line]] = []
    for one in examined(diagnosed, chosen, keep=given.keep):
        kept.append(one)
        lines.append(one.result)
        say(f"{text_of(one.result)}  {one.seconds:.1f} s of the processor")
    say(other_code(kept))
    for text in summary(lines):
        say(text)


if __name__ == "__main__":
    sys.exit(main())
