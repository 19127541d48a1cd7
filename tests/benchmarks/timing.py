"""How much processor time the diagnosis of a transient takes, and when its first useful answer is streamed.

    python -m tests.benchmarks.timing [--seeds 0] [--only TEXT] [--kind transient] [--keep FILE]

The measured transients of `tests.truth`, with their entries open to doubt as on every door. *First*: until
the first effect is streamed with the error that the model has with it; the most promising is tried first.
*Best*: until the one that stays the best single effect is streamed. Seconds are of the processor, so that a
busy machine counts the same; the first run of a drive of some structure compiles it, about 1 s of them.

On 26 November 2026, 31 cases on a quiet machine, equations compiled by an earlier run: median 3.3 s (wanted
6), longest 20.7 s (wanted 40: `unknown-inertance-pulses`); first effect after 0.17 s in the median and 0.70 s
at most (wanted 1), the best single effect after 0.23 s, at most 0.83 s. With nothing compiled before, which
happens once for each structure on a machine (``MCKIBBEN_CACHE=off``), the first effect of the four slowest
takes 0.4 s since those without equations of their own are streamed first (1.3 to 1.4 s before), and the best
one up to 2.1 s. ``--kind static``, 65 cases of the other kinds: median 0.7 s (wanted 1.5), longest 14.4 s
(`rig-isotonic`); first effect, which is the best single one, after 0.06 s in the median, at most 0.40 s.

On 27 November, 32 transients: median 3.5 s, longest 24.4 s; first effect at most 0.25 s, best one at most
1.06 s (31 of 32 within 1 s). Static: median 1.1 s, longest 10.0 s.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.benchmarks.diagnosis import say
from tests.benchmarks.entries import parts_of
from tests.benchmarks.workers import Examined, add_keep, examined, other_code, own_studio, processor_time
from tests.truth.cases import Case
from tests.truth.generate import all_cases


@dataclass(frozen=True)
class Line:
    """What became of one case; seconds of processor time."""

    case: str
    rows: int
    values: int
    status: str
    added: tuple[str, ...]
    first: float
    first_effect: str
    best: float
    best_effect: str
    whole: float


def timed(case: Case) -> Line:
    """Diagnose one case and note when what is streamed."""
    from mckibben.identification.diagnose.diagnosis import diagnose
    from mckibben.identification.diagnose.entries import statements

    studio = own_studio()
    predictor, start, measurement, rebuilt, drive = parts_of(case, studio)
    supply = None if drive is None else float(drive.supply_pressure)
    elastic = studio.catalogue.values()
    streamed: dict[str, float] = {}
    began = processor_time()

    def note(candidate: Any) -> None:
        streamed.setdefault(candidate.effect.id, processor_time() - began)

    result = diagnose(
        predictor,
        start,
        catalogue=studio.catalogue,
        statements=statements(measurement, start, rebuilt, supply=supply, elastic=elastic),
        on_candidate=note,
    )
    whole = processor_time() - began
    first = next(iter(streamed), "")
    best = result.candidates[0].effect.id if result.candidates else ""
    return Line(
        case.id,
        case.rows,
        len(predictor.measured),
        result.status,
        result.added,
        streamed.get(first, float("nan")),
        first,
        streamed.get(best, float("nan")),
        best,
        whole,
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seeds", default="0")
    parser.add_argument("--only", default="", help="part of the case's name")
    parser.add_argument("--kind", default="transient", help="of measurement; 'static' is all but transient")
    add_keep(parser)
    options = parser.parse_args()
    chosen = [
        case
        for case in all_cases(seeds=tuple(int(seed) for seed in options.seeds.split(",")))
        if options.only in case.name
        and (case.kind == options.kind or (options.kind == "static" and case.kind != "transient"))
    ]
    lines: list[Examined[Line]] = []
    for line in examined(timed, chosen, key=lambda case: case.id, keep=options.keep):
        lines.append(line)
        say(text_of(line.result))
    if not lines:
        sys.exit("no case of that name and kind")
    whole, first, best = (
        np.array([getattr(line.result, name) for line in lines]) for name in ("whole", "first", "best")
    )
    say(f"\n{len(lines)} cases: median {np.median(whole):.1f} s, longest {np.max(whole):.1f} s")
    for words, values in (("first effect streamed", first), ("best single effect streamed", best)):
        within = np.count_nonzero(values <= 1.0)
        told = f"median {np.nanmedian(values):.2f} s, longest {np.nanmax(values):.2f} s"
        say(f"{words}: {told}, within 1 s {within} of {len(values)}")
    say(other_code(lines))


def text_of(line: Line) -> str:
    """A line of the table."""
    return (
        f"{line.case:38}{line.rows:5d} rows  first {line.first:5.2f} s ({line.first_effect}), "
        f"best {line.best:5.2f} s ({line.best_effect}), all {line.whole:6.1f} s  {line.status:16}"
        f"{', '.join(line.added)}"
    )


if __name__ == "__main__":
    main()
