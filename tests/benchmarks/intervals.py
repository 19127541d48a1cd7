"""Whether the intervals of a repaired model hold: readings of a second test that it was not fitted to.

    python -m tests.benchmarks.intervals [--seeds 0] [--only TEXT] [--kind transient]

The diagnosis sees the first test of a case. The 90 % interval of its model, from the covariance of the fitted
values and the error left, is then laid over the readings of the second test of the same rig, whose levels lie
within the range of the first.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.benchmarks.diagnosis import say, subject_and_start
from tests.benchmarks.held_out import second_test
from tests.benchmarks.workers import Examined, add_keep, examined, other_code, own_studio
from tests.truth.cases import Case
from tests.truth.generate import all_cases

_NORMAL_90 = 1.645  # standard deviations of a normal distribution that hold 90 %


@dataclass
class Line:
    """One case: share of the readings inside the interval, and its width over that of the noise alone."""

    case: str
    covered: float = float("nan")
    width: float = float("nan")
    twins: int = 0
    problem: str = ""


def covered(case: Case) -> Line:
    """Diagnose the first test, and count the readings of the second one inside the interval."""
    from mckibben.identification.diagnose.diagnosis import diagnose
    from mckibben.identification.predict.fit_model import free_numbers

    line = Line(case.id)
    studio = own_studio()
    try:
        predictor, start = subject_and_start(case, studio)
        result = diagnose(predictor, start, catalogue=studio.catalogue)
        test, noise = second_test(case, studio)
        model = result.best.fit_model
        readings = test.prepared(model, tuple(studio.catalogue.values()))
        residual = readings.measured - readings.predict(model)
        left = _error_left(result)
        variance = np.empty(len(residual))
        for channel in readings.channels:
            variance[channel.rows] = left[channel.name] ** 2
        fit = result.fit
        table = None if fit is None else fit.covariance
        if table is not None and table.names:
            free = [p for p in free_numbers(model, (), result.best.freed) if p.name in table.names]
            places = [table.names.index(p.name) for p in free]
            slopes = _slopes(readings, model, free)
            matrix = np.array(table.matrix)[np.ix_(places, places)]
            variance += np.einsum("ki,ij,kj->k", slopes, matrix, slopes)
        half = _NORMAL_90 * np.sqrt(variance)
        line.covered = float(np.mean(np.abs(residual) <= half))
        line.width = float(np.mean(half / (_NORMAL_90 * noise)))
        line.twins = len(result.alternatives)
    except Exception as failure:  # a case that breaks is a line of the table, not its end
        line.problem = f"{type(failure).__name__}: {failure}"[:120]
    return line


def _error_left(result: Any) -> dict[str, float]:
    """Error of each channel in the first test."""
    predictor = result.predictor
    residual = predictor.measured - predictor.predict(result.best.fit_model)
    return {
        channel.name: float(np.sqrt(np.mean(residual[channel.rows] ** 2))) for channel in predictor.channels
    }


def _slopes(readings: Any, model: Any, free: Any) -> np.ndarray:
    if readings.simulated:
        return readings.differences(model, free, readings.predict(model, clipped=False))
    return readings.linearised(model, free)[1]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seeds", default="0")
    parser.add_argument("--only", default="", help="parts of names, separated by commas")
    parser.add_argument(
        "--kind", default="static", help="transient, isobaric, ...; 'static' is all but transient"
    )
    add_keep(parser)
    given = parser.parse_args()
    chosen = [
        case
        for case in all_cases(seeds=tuple(int(seed) for seed in given.seeds.split(",")))
        if any(part in case.name for part in given.only.split(","))
        and case.unknown is None
        and case.hidden
        and (case.kind == given.kind or (given.kind == "static") == (case.kind != "transient"))
    ]
    lines = []
    kept: list[Examined[Line]] = []
    for one in examined(covered, chosen, key=lambda case: case.id, keep=given.keep):
        kept.append(one)
        line = one.result
        lines.append(line)
        say(
            f"{line.case:46}{100.0 * line.covered:5.1f} %  width {line.width:5.2f} x noise"
            f"  twins {line.twins}  {one.seconds:5.1f} s  {line.problem}"
        )
    say(other_code(kept))
    shares = np.array([line.covered for line in lines if not line.problem])
    alone = np.array([line.covered for line in lines if not line.problem and not line.twins])
    held = f"{100.0 * np.mean(shares):.1f} % of the readings of {len(shares)} cases"
    say(f"\n90 % intervals hold {held}, wanted 85-95 %")
    say(f"where the effects have no twins  {100.0 * np.mean(alone):.1f} % of {len(alone)}")
    say(f"cases below 80 %: {np.count_nonzero(shares < 0.8)}, above 95 %: {np.count_nonzero(shares > 0.95)}")


if __name__ == "__main__":
    sys.exit(main())
