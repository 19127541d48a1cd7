"""How often the hidden effect is found: every case of `tests.truth`, as a table. One command, one run:

    python -m tests.benchmarks.diagnosis [--seeds 0,1,2] [--only TEXT] [--kind transient]

The diagnosis sees the file, the muscle or drive document and the start model; the answer is opened after it.
Errors are over the true noise of the case. *Found*: every hidden effect is named or in a named group of
twins. *Surplus*: a named group that holds none of them. Where a short term is proposed for an effect that
is in no catalogue, it is added and refitted: *taken* is the share of the excess over the noise that it takes.

On 26 November 2026, three seeds: single 200 of 201, at most 1.15 x noise 192 of 201, pairs and triples 47 of
48, false alarms 0 of 21, not in the catalogue and flagged 21 of 21, surplus 9 of 270, 1.6 s in the median.
A day later, static cases alone: 135 of 135, 131 of 135, 30 of 30, 0 of 15, 15 of 15, 3 of 180, 0.7 s.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tests.benchmarks.workers import Examined, add_keep, examined, other_code, own_studio
from tests.truth.cases import Case
from tests.truth.generate import all_cases


@dataclass
class Line:
    """What became of one case; errors over its true noise."""

    case: str
    seed: int
    kind: str
    hidden: int
    unknown: bool
    status: str = ""
    named: list[str] = field(default_factory=list)
    found: int = 0
    surplus: list[str] = field(default_factory=list)
    before: float = float("nan")
    after: float = float("nan")
    floor: float = float("nan")
    taken: float | None = None
    seconds: float = float("nan")
    problem: str = ""

    @property
    def right(self) -> bool:
        """Whether the verdict is the right one."""
        if self.unknown:
            return self.status == "unknown_effect"
        return not self.problem and (self.found == self.hidden if self.hidden else not self.named)


def diagnosed(case: Case) -> Line:
    """Diagnose one case and open its answer."""
    from mckibben.identification.diagnose.diagnosis import diagnose

    line = Line(case.name, case.seed, case.kind, len(case.hidden), case.unknown is not None)
    studio = own_studio()
    try:
        predictor, fit_model = subject_and_start(case, studio)
        began = time.perf_counter()
        result = diagnose(predictor, fit_model, catalogue=studio.catalogue)
        line.seconds = time.perf_counter() - began
    except Exception as error:  # a case that breaks is a line of the table, not its end
        line.problem = f"{type(error).__name__}: {error}"[:120]
        return line
    floor = true_floor(case, predictor)
    groups = [{name, *(a.effect for a in result.alternatives if a.of == name)} for name in result.added]
    named = set().union(*groups) if groups else set()
    line.status, line.named = result.status, list(result.added)
    line.found = sum(bool(hidden & named) for hidden in case.hidden)
    line.surplus = [sorted(group)[0] for group in groups if not any(group & h for h in case.hidden)]
    line.before, line.after = result.start.rmse / floor, result.best.rmse / floor
    line.floor = (result.noise or float("nan")) / floor
    if line.unknown and result.term is not None:
        line.taken = _taken(predictor, result, floor)
    return line


def subject_and_start(case: Case, studio: Any) -> tuple[Any, Any]:
    """What a user would give of a case: measurement, muscle or drive, start model."""
    from mckibben.documents.drive_reading import drive_of, read_document
    from mckibben.documents.muscle import MuscleInput
    from mckibben.documents.start_model import stated_muscle
    from mckibben.identification.predict import predictor_of
    from mckibben.identification.predict.fit_model import FitModel
    from mckibben.measurement.experiment import corrected, file_experiment
    from mckibben.measurement.points import Points, joined
    from mckibben.measurement.reading import read_measurement

    files = [Points(read_measurement(text.encode(), name)) for name, text in case.files.items()]
    measurement = joined(files).measurement
    if "torque" in measurement.columns:  # length and force of its muscle follow from what the file states
        measurement = corrected(measurement, file_experiment(measurement.stated))
    if case.drive is not None:
        document = {"effects": case.effects, **case.drive}
        drive = drive_of(read_document(document, "the drive"), studio).drive
        model = drive.model
    else:
        start = studio.start_model(stated_muscle(MuscleInput.model_validate(case.muscle)), case.effects)
        drive, model = None, studio.static_model(start)
    fit_model = FitModel(model.muscle, model.effects, model.values, size=model.muscle.size)
    return predictor_of(measurement, fit_model.muscle, drive), fit_model


def true_floor(case: Case, predictor: Any) -> float:
    """Rms of the true noise over the scale of the subject's residual."""
    if len(predictor.channels) == 1:
        return next(iter(case.noise.values()))
    shares = [(case.noise[channel.name] / channel.noise) ** 2 for channel in predictor.channels]
    return float(np.sqrt(np.mean(shares)))


def _taken(predictor: Any, result: Any, floor: float) -> float:
    from mckibben.identification.fit.fitted_model import refitted
    from mckibben.identification.predict.fit_model import free_numbers
    from mckibben.physics.custom import custom_effect

    effect = custom_effect(result.term.formula, result.term.coefficients)
    fit_model = result.best.fit_model.adding(effect)
    fitted_model = refitted(predictor, fit_model, free_numbers(fit_model, (), result.best.freed))
    excess = result.best.mean_square - floor**2
    return 1.0 - max(fitted_model.mean_square - floor**2, 0.0) / excess if excess > 0.0 else 1.0


def summary(lines: Sequence[Line]) -> list[tuple[str, str, str]]:
    """The figures that were promised: name, reached, wanted."""
    known = [line for line in lines if not line.unknown]
    single = [line for line in known if line.hidden == 1]
    several = [line for line in known if line.hidden > 1]
    nothing = [line for line in known if not line.hidden]
    unknown = [line for line in lines if line.unknown]
    proposed = [line for line in unknown if line.taken is not None]

    def share(chosen: Sequence[Line], holds: Callable[[Line], bool]) -> str:
        count = sum(map(holds, chosen))
        return f"{count} of {len(chosen)} ({100.0 * count / max(len(chosen), 1):.0f} %)"

    return [
        ("single effect found", share(single, lambda line: line.right), ">= 95 %"),
        ("single: error <= 1.15 x noise", share(single, lambda line: line.after <= 1.15), ">= 95 %"),
        ("pairs and triples: all found", share(several, lambda line: line.right), ">= 85 %"),
        ("nothing missing: false alarms", share(nothing, lambda line: bool(line.named)), "<= 5 %"),
        ("not in the catalogue: flagged", share(unknown, lambda line: line.right), ">= 80 %"),
        ("with a proposed term", f"{len(proposed)} of {len(unknown)}", ""),
        ("proposed: takes >= 70 %", share(proposed, lambda line: (line.taken or 0.0) >= 0.7), "all"),
        ("with surplus effects", share(known, lambda line: bool(line.surplus)), ""),
        ("seconds, median", f"{statistics.median([line.seconds for line in lines]):.1f}", ""),
    ]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seeds", default="0,1,2")
    parser.add_argument("--only", default="", help="part of the case's name")
    parser.add_argument("--kind", default="", help="transient, isobaric, ...; 'static' is all but transient")
    add_keep(parser)
    given = parser.parse_args()
    seeds = tuple(int(seed) for seed in given.seeds.split(","))
    chosen = [
        case
        for case in all_cases(seeds=seeds)
        if given.only in case.name
        and (
            not given.kind
            or case.kind == given.kind
            or (given.kind == "static") == (case.kind != "transient")
        )
    ]
    lines = []
    kept: list[Examined[Line]] = []
    for one in examined(diagnosed, chosen, key=lambda case: case.id, keep=given.keep):
        kept.append(one)
        lines.append(one.result)
        say(f"{text_of(one.result)} ({one.seconds:.1f} s of the processor)")
    say(other_code(kept))
    for name, reached, wanted in summary(lines):
        say(f"{name:34}{reached:>18}   {wanted}")


def text_of(line: Line) -> str:
    """A line of the table."""
    parts = [
        f"{'ok' if line.right else '--'} {line.case + ' ' + str(line.seed):46}{line.status:16}",
        f"{line.before:6.1f} ->{line.after:6.2f} floor {line.floor:4.2f} {line.seconds:5.1f} s ",
        ", ".join(line.named),
        f"surplus {', '.join(line.surplus)}" if line.surplus else "",
        "" if line.taken is None else f"term takes {100.0 * line.taken:.0f} %",
        line.problem,
    ]
    return " ".join(part for part in parts if part)


def say(text: str) -> None:
    """One line, at once."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
