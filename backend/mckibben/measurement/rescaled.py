"""A measurement with one channel read another way: another unit, the other sign, another zero."""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

from mckibben.measurement.measurement import STROKES, Measurement, build


def rescaled(
    measurement: Measurement, channel: str, *, factor: float = 1.0, offset: float = 0.0
) -> Measurement:
    """The measurement whose channel is ``factor * reading + offset``, everything derived from it found anew.

    Args:
        measurement: of any kind.
        channel: its name; "stroke" means whichever of length, contraction and displacement was measured.
        factor: true value over reading.
        offset: true value at a reading of zero, SI.

    Raises:
        InputError: the channels fit the measurement's kind no longer.
    """
    names = [name for name in STROKES if name in measurement.columns] if channel == "stroke" else [channel]
    columns = {name: values for name, values in measurement.columns.items() if name != "group"}
    for name in names:
        columns[name] = factor * columns[name] + offset
    if "velocity" in columns and channel in ("stroke", "time"):
        columns["velocity"] = columns["velocity"] * (factor if channel == "stroke" else 1.0 / factor)
    if "direction" in columns and channel == "stroke" and factor < 0.0:
        columns["direction"] = -columns["direction"]
    changed = build(
        columns,
        name=measurement.name,
        id=measurement.id,
        kind=measurement.kind,
        conditions=measurement.conditions,
        starts=measurement.starts,
    )
    kept = MappingProxyType({**changed.columns, "group": measurement.columns["group"]})
    return replace(
        changed,
        columns=kept,
        skipped=measurement.skipped,
        ignored=measurement.ignored,
        prepared=measurement.prepared,
        source_rows=measurement.source_rows,
        cut_off=measurement.cut_off,
        shared_noise={
            name: noise * (abs(factor) if name in names else 1.0)
            for name, noise in measurement.shared_noise.items()
        },
        in_words=measurement.in_words,
    )
