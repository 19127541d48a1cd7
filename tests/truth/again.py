"""Another experiment with the muscle and rig of a case: set points of a schedule, played and written down."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from tests.truth.bench import force_rows, length_rows
from tests.truth.cases import BOOK, Case
from tests.truth.composition import Record, Truth
from tests.truth.experiments import FINE, RecordBuilder
from tests.truth.laboratory import watched
from tests.truth.muscle import Array
from tests.truth.sensors import Noise
from tests.truth.tables import STYLES, text_of

_PER_PART = 60  # written rows between two set points
_SET_UP = 30.0  # s


def played(case: Case, run: Array, columns: Mapping[str, Array]) -> str:
    """The file of a schedule played on the rig of a case of forces or strokes.

    Args:
        case: made by `tests.truth.laboratory`.
        run: number of the run of each set point.
        columns: "time", "pressure", and "length" or "load" of each set point, linear between them, SI.
    """
    made: list[tuple[Truth, Noise]] = []
    with watched(lambda truth, noise: made.append((truth, noise))):
        BOOK.make(case.name, case.seed)
    truth, noise = made[0]
    record = _record(run, columns)
    rng = np.random.default_rng([case.seed, 2])
    under_load = record.load is not None
    measured = (length_rows if under_load else force_rows)(truth, record, noise, rng)
    return text_of(
        {**measured.columns, "temperature": record.temperature[record.kept]},
        nominal=truth.muscle.nominal,
        style=STYLES[0],
        conditions={"kind": "isotonic" if under_load else "isobaric"},
        channels=("time", "pressure", *(["force"] if "force" in measured.columns else [])),
        group=True,
    )


def _record(run: Array, columns: Mapping[str, Array]) -> Record:
    path = RecordBuilder()
    loads = []
    for number in np.unique(run):
        of_run = run == number
        time, pressure = columns["time"][of_run], columns["pressure"][of_run]
        length = columns["length"][of_run] if "length" in columns else np.ones(len(time))
        path.pause(float(pressure[0]), float(length[0]), seconds=_SET_UP)
        for begin, end in pairwise(range(len(time))):
            along = np.linspace(0.0, 1.0, _PER_PART * FINE)
            path.add(
                float(time[end] - time[begin]) / len(along),
                pressure[begin] + along * (pressure[end] - pressure[begin]),
                length[begin] + along * (length[end] - length[begin]),
                kept=True,
            )
        path.loops += 1
        if "load" in columns:
            loads.append(float(columns["load"][of_run][0]))
    record = path.record()
    if loads:
        record.load = np.array(loads)[np.minimum(record.group, len(loads) - 1)]
    return record
