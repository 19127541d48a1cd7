"""FMUs of every drive preset without a controller and of repaired drives of `tests.truth`, beside our runs:

    python -m tests.benchmarks.fmu [--fmi 3] [--repaired 1-5] [--only propneu-20]

Each is compiled by gcc with all warnings as errors, checked by FMPy and simulated by it: co-simulation by the
FMU's own solver, model exchange by CVode, both at a tolerance of 1e-7, with the command of the document after
its dead times. Wanted: position within 0.1 mm, every timing figure within 0.5 %. Figures that our own two
integrators do not agree on are counted, not compared. FMPy and gcc are needed.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Iterator
from pathlib import Path

from mckibben.documents.drive_reading import read_document
from mckibben.export.fmu.dialects import FMI2, FMI3, Dialect
from mckibben.export.source import of_drive, stated_source
from mckibben.export.subject import Subject, subject_of
from mckibben.simulation.timing.evaluation import time_step
from tests.benchmarks.diagnosis import say, subject_and_start
from tests.export.fmus import KINDS, fmu_of, our_run, position_error, simulated, timing_error
from tests.export.models import studio
from tests.truth.generate import all_cases

_POSITION, _TIMING = 1e-4, 5e-3


def presets(only: str | None = None) -> Iterator[tuple[str, Subject]]:
    """The drive presets without a controller, or one of them."""
    for preset in studio().library.list("drives"):
        if only not in (None, preset.id):
            continue
        subject = subject_of(stated_source(preset.id, studio()), studio())
        if subject.runnable is not None and subject.runnable.drive.controller is None:
            yield preset.id, subject


def repaired(first: int, last: int) -> Iterator[tuple[str, Subject]]:
    """Drives as a diagnosis of their measurement leaves them; the first of each hidden effect, from 1."""
    from mckibben.identification.diagnose.diagnosis import diagnose

    seen: set[frozenset[str]] = set()
    for case in all_cases(seeds=(0,)):
        hidden = frozenset().union(*case.hidden) if case.hidden else frozenset()
        if case.kind != "transient" or not hidden or case.unknown or hidden in seen or len(seen) >= last:
            continue
        if case.drive is None or case.drive.get("controller") or "command" not in case.drive:
            continue
        seen.add(hidden)
        if len(seen) < first:
            continue
        predictor, fit_model = subject_and_start(case, studio())
        best = diagnose(predictor, fit_model, catalogue=studio().catalogue).best.fit_model
        document = {**case.drive, "effects": {name: dict(own) for name, own in best.values.items()}}
        stated = of_drive(read_document(document, "the drive"), studio(), case.id, title=case.id)
        yield f"{case.id} + {', '.join(best.values)}", subject_of(stated, studio())


def examined(name: str, subject: Subject, folder: Path, dialect: Dialect) -> bool:
    """Print the lines of one drive; whether all is as wanted."""
    from fmpy.validation import validate_fmu

    path = fmu_of(subject, folder, "drive", dialect)
    problems = validate_fmu(str(path))
    good = not problems
    say(f"{name}, FMI {dialect.version}: {len(problems)} problems")
    assert subject.runnable is not None
    interval = time_step(subject.runnable.drive.duration)
    for kind in KINDS:
        rows = simulated(path, subject, kind, interval=interval)
        run = our_run(subject, rows["time"])
        position = position_error(rows, run)
        timing, unsettled = timing_error(rows, run, subject)
        figure, worst = max(timing.items(), key=lambda item: item[1], default=("none", 0.0))
        fine = position < _POSITION and worst < _TIMING
        good = good and fine
        say(
            f"  {'ok' if fine else '--'} {kind:14} position {position * 1e3:.5f} mm, {len(timing)} figures, "
            f"worst {worst * 100:.4f} % ({figure}), not settled: {', '.join(unsettled) or 'none'}"
        )
    return good


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--repaired", default="1-5", help="which of them, 0 for none")
    parser.add_argument("--fmi", type=int, choices=(2, 3), default=2)
    parser.add_argument("--only", help="of the drive presets this one alone; - for none")
    given = parser.parse_args()
    first, _, last = given.repaired.partition("-")
    with tempfile.TemporaryDirectory() as folder:
        lines = [
            examined(name, subject, Path(folder), FMI3 if given.fmi == 3 else FMI2)
            for drives in (presets(given.only), repaired(int(first), int(last or first)))
            for name, subject in drives
        ]
    say(f"{sum(lines)} of {len(lines)} as wanted")


if __name__ == "__main__":
    main()
