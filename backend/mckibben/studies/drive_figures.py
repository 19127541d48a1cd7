"""Figures of a run of a drive that a study can watch, by their paths."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.facts.run import TRACKING
from mckibben.facts.study import WATCHED
from mckibben.facts.timing import TIMING
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.simulation.drive.transient import Run
from mckibben.simulation.timing.evaluation import timing_of, trace_of, tracking_of
from mckibben.simulation.timing.trace import Trace
from mckibben.studies.table import Figure

_PICKS = {"largest": np.max, "smallest": np.min, "last": lambda column: column[-1]}

#: Path -> SI unit: the timing table, tracking of a reference, and extremes and last values of columns.
DRIVE_FIGURES: dict[str, str] = {
    path: figure.unit
    for path, figure in WATCHED.items()
    if path.partition(".")[0] in {TIMING.name, TRACKING.name, *_PICKS}
}


def figures_named(paths: Sequence[str], known: dict[str, str]) -> tuple[Figure, ...]:
    """The figures with these paths.

    Args:
        paths: of a study.
        known: path -> SI unit of the figures of the subject.

    Raises:
        InputError: an unknown figure; names the nearest.
    """
    for path in paths:
        if path not in known:
            hint = did_you_mean(path, known) or f"e.g. {next(iter(known))}"
            raise InputError(f"the subject has no figure {path}", field="figures", hint=hint)
    return tuple(Figure(path, known[path]) for path in paths)


def figures_of_run(run: Run, paths: Sequence[str]) -> tuple[tuple[float, ...], str]:
    """Values of figures, NaN for one that does not exist, and why those do not exist."""
    trace = trace_of(run)
    table = timing_of(run.drive, trace)
    follows = tracking_of(run, trace) if any(path.startswith("tracking.") for path in paths) else None
    values: list[float] = []
    reasons: dict[str, None] = {}
    for path in paths:
        first, _, rest = path.partition(".")
        value: float | None = None
        if first == "timing":
            phase, _, name = rest.partition(".")
            value, why = getattr(getattr(table, phase), name), table.notes.get(rest, "")
        elif first == "tracking":
            why = TRACKING["rms"].exists_when.otherwise
            if follows is not None:
                value, why = getattr(follows, rest), follows.notes.get(rest, "")
        else:
            value, why = _picked(trace, first, rest), WATCHED[path].exists_when.otherwise
        if value is None:
            reasons[f"{path}: {why}"] = None
        values.append(float("nan") if value is None else float(value))
    return tuple(values), "; ".join(reasons)


def _picked(trace: Trace | None, pick: str, name: str) -> float | None:
    return None if trace is None else float(_PICKS[pick](getattr(trace, name)))
