"""From a truth and a record to a case of every kind but transient: noise, units, file."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any
from zlib import crc32

import numpy as np

from tests.truth.bench import Measured, diameter_rows, force_rows, length_rows
from tests.truth.cases import Case, Held, file_name
from tests.truth.composition import Record, Truth
from tests.truth.held_out import other_conditions
from tests.truth.muscle import FULL_PRESSURE
from tests.truth.sensors import Noise
from tests.truth.tables import STYLES, text_of

#: Called with the truth and the noise of each case that is made.
_watchers: list[Callable[[Truth, Noise], None]] = []
_DIRECTIONS = ("up/down", "shortening/lengthening", "-1/1")


def usual_noise(truth: Truth, rng: np.random.Generator, *, force: float | None = None) -> Noise:
    """Noise of a good bench: force 0.05-0.2 % of full scale, pressure 0.05-0.1 % of 6 bar, 20-40 um."""
    full = truth.muscle.blocked
    share = rng.uniform(5e-4, 2e-3) if force is None else force
    return Noise(
        levels={
            "force": share * full,
            "pressure": float(rng.uniform(5e-4, 1e-3)) * FULL_PRESSURE,
            "length": float(rng.uniform(2e-5, 4e-5)),
            "diameter": float(rng.uniform(2e-5, 4e-5)),
        },
        ranges={"force": 1.5 * full, "pressure": 1e6, "length": 0.6, "diameter": 0.1},
        bits=int(rng.choice([12, 14, 16])),
        drift=0.6 if truth.hidden and rng.random() < 0.15 else 0.0,
    )


@contextmanager
def watched(watch: Callable[[Truth, Noise], None]) -> Iterator[None]:
    """Shows the truth and the noise of the cases that are made meanwhile."""
    _watchers.append(watch)
    try:
        yield
    finally:
        _watchers.remove(watch)


def jittered(record: Record, rng: np.random.Generator) -> Record:
    """The same test with rows written down a little early or late."""
    rows = np.flatnonzero(record.kept)
    rows = np.clip(rows + rng.integers(-3, 4, len(rows)), 0, len(record.kept) - 1)
    kept = np.zeros_like(record.kept)
    kept[rows] = True
    return replace(record, kept=kept)


def shuffled(measured: Measured, rng: np.random.Generator) -> Measured:
    """The rows in no order: a map has none."""
    order = rng.permutation(len(next(iter(measured.columns.values()))))
    return Measured(
        {name: values[order] for name, values in measured.columns.items()},
        measured.noise,
        measured.ratios,
        {name: values[order] for name, values in measured.clean.items()},
    )


def case_of(
    name: str,
    seed: int,
    truth: Truth,
    record: Record,
    kind: str,
    rng: np.random.Generator,
    *,
    noise: Noise | None = None,
    effects: dict[str, dict[str, Any]] | None = None,
    unknown: str | None = None,
    timed: bool = True,
    temperature: bool = False,
    directed: bool | None = None,
    grouped: bool | None = None,
    say_kind: bool | None = None,
    style: int | None = None,
    form: str = "diameter",
) -> Case:
    """Run the bench and write the file.

    Args:
        unknown: name of the effect no catalogue has; it is the last hidden one and no right answer.
        timed: whether the time is written.
        temperature: whether the temperature is written.
        directed, grouped, say_kind: whether the file has a direction, run numbers, a kind line; None: drawn.
        style: index into `STYLES`, None: by the seed and the name.
        form: of the muscle document.
    """
    noise = noise or usual_noise(truth, rng)
    if kind in ("isobaric", "isometric", "isotonic") and rng.random() < 0.3:
        record = jittered(record, rng)

    def written(record: Record, rng: np.random.Generator) -> tuple[Measured, str]:
        rows_of = {"isotonic": length_rows, "diameter": diameter_rows}.get(kind, force_rows)
        measured = rows_of(truth, record, noise, rng)
        if kind == "static":
            measured = shuffled(measured, rng)
        columns = dict(measured.columns)
        columns["temperature"] = record.temperature[record.kept]
        columns["way"] = (record.length if kind == "isobaric" else -record.pressure)[record.kept]
        channels = tuple(
            channel
            for channel, wanted in (
                ("time", timed and kind != "static"),
                ("pressure", True),
                ("force", "force" in columns),
                ("diameter", kind == "diameter"),
                ("temperature", temperature),
            )
            if wanted
        )
        draw = rng.random(3)
        with_direction = bool(draw[0] < 0.4) if directed is None else directed
        with_group = bool(draw[1] < 0.4) if grouped is None else grouped
        said = bool(draw[2] < 0.5) if say_kind is None else say_kind
        if kind in ("isotonic", "diameter"):
            said = True
        text = text_of(
            columns,
            nominal=truth.muscle.nominal,
            style=STYLES[int(rng.integers(len(STYLES))) if style is None else style],
            conditions={"kind": kind} if said else {},
            channels=channels,
            direction=str(rng.choice(_DIRECTIONS))
            if with_direction and kind not in ("static", "diameter")
            else "",
            group=with_group and kind != "static",
        )
        return measured, text

    for watch in _watchers:
        watch(truth, noise)
    measured, text = written(record, rng)
    rows = int(np.count_nonzero(record.kept))
    # Random numbers of its own: what the diagnosis sees does not depend on what it does not see.
    held_measured, held_text = written(
        other_conditions(record, truth, kind), np.random.default_rng([crc32(name.encode()), seed, 1])
    )
    held = Held(held_text, None, held_measured.noise)
    known = truth.hidden[:-1] if unknown else truth.hidden
    return Case(
        name=name,
        kind=kind,
        hidden=tuple(part.accepted for part in known),
        unknown=unknown,
        muscle=truth.muscle.document(form),
        drive=None,
        effects=effects or {},
        files={file_name(text): text},
        noise=measured.noise,
        seed=seed,
        truths=tuple(part.name for part in truth.hidden),
        ratios=measured.ratios,
        rows=rows,
        clean=measured.clean,
        measured={channel: measured.columns[channel] for channel in measured.noise},
        held=held,
    )
