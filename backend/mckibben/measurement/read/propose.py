"""Channels that no head names: the one column of lengths that can be the stroke, a clock without a head."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.read.conditions import read_conditions
from mckibben.measurement.read.evidence import is_numeric
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.header import Meaning
from mckibben.measurement.read.left_out import FINAL, UNKNOWN
from mckibben.measurement.read.physical_checks import mostly_negative, runs_against
from mckibben.measurement.read.plain_head import HeaderColumn
from mckibben.measurement.read.plausible import ENOUGH, is_plausible
from mckibben.measurement.read.recognise import BY_UNIT
from mckibben.measurement.read.signs import SHORTENING_POSITIVE, STROKE_SIGN
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.unit_words import CLOCK, dimension_of
from mckibben.physics.errors import InputError
from mckibben.physics.units import convert

PROPOSED = "proposed"  # origin of a column that only its unit and its numbers tell
_SHORTEST = 0.5  # of its largest length; no muscle shortens further
_LONGEST = 1.15  # of the rest length, under load
_FROM_ZERO = 0.5  # of its largest value; a stroke begins lower


def with_proposed_stroke(source: RawTable, meaning: Meaning, given: Mapping[str, object]) -> Meaning:
    """The meaning with a stroke, where exactly one column of lengths can be it.

    A pulled muscle becomes longer and air shortens it: a column that follows this from zero on is a
    displacement, one that runs the other way and stays above half of its largest value is a length; below
    zero it is a displacement that counts the other way. A rest length in the file, or in ``given``, has to
    agree.
    """
    used = {column.use: column for column in meaning.columns}
    if set(used) & set(STROKES) or "pressure" not in used:
        return meaning
    columns = _columns_of_lengths(source, meaning)
    if len(columns) != 1:
        return meaning
    index, unit = columns[0]
    beside = [used[use].place for use in ("pressure", "force") if use in used]
    try:
        table = source.read([index, *beside], [], True)
        said = read_conditions(source.notes, []) | dict(given)
    except InputError:
        return meaning  # whoever reads the rows says what is wrong
    numbers = [table.numbers[place].astype(np.float64) for place in (index, *beside)]
    values = convert(numbers[0], unit, "m")
    sign = -1 if len(values) and mostly_negative(values) else 1
    if sign < 0 and said.get(STROKE_SIGN) == SHORTENING_POSITIVE:
        return meaning
    channel = _stroke_of(
        sign * values, numbers[1], numbers[2] if len(numbers) > 2 else None,
        float(rest) if isinstance(rest := said.get("nominal_length"), (int, float)) else None,
    )  # fmt: skip
    if channel is None or (sign < 0 and channel == "length"):
        return meaning
    header = source.headers[index].strip() or f"column {index + 1}"
    column = HeaderColumn(index, header, channel, unit, penalty=BY_UNIT, sign=sign, origin=PROPOSED)
    return meaning._replace(
        columns=sorted([*meaning.columns, column], key=lambda one: one.place),
        ignored=[name for name in meaning.ignored if name != header],
        messages=[m for m in meaning.messages if not m.startswith(f"{source.noun} '{header}' is not used")],
        reasons={place: why for place, why in meaning.reasons.items() if place != index},
        problems={place: error for place, error in meaning.problems.items() if place != index},
    )


def with_clock(source: RawTable, meaning: Meaning) -> Meaning:
    """The meaning with a time, where the only column of times of day or dates has no head."""
    used = {column.use for column in meaning.columns}
    places = [index for index in sorted(source.clocks) if index < len(source.headers)]
    if "time" in used or not used or len(places) != 1:
        return meaning
    (index,) = places
    if source.headers[index].strip() or index in meaning.dismissed or index in meaning.problems:
        return meaning
    name = f"column {index + 1}"
    return meaning._replace(
        columns=sorted([*meaning.columns, HeaderColumn(index, name, "time", CLOCK)], key=lambda c: c.place),
        ignored=[ignored for ignored in meaning.ignored if ignored != name],
        reasons={place: why for place, why in meaning.reasons.items() if place != index},
    )


def _columns_of_lengths(source: RawTable, meaning: Meaning) -> list[tuple[int, str]]:
    """(index, unit) of the columns of lengths that nothing is read from, and nothing says why."""
    taken = {column.place for column in meaning.columns} | {other.place for _, other in meaning.rivals}
    found = []
    for index, header in enumerate(source.headers):
        if index in taken or index in meaning.dismissed or not is_numeric(source.sample, index):
            continue
        unit = taken_apart(header, source.units[index] if index < len(source.units) else None).unit
        if unit is None or dimension_of(unit) != "a length":
            continue
        if meaning.reasons.get(index, UNKNOWN).reason not in FINAL:
            found.append((index, unit))
    return found


def _stroke_of(
    values: NDArray[np.float64], pressure: NDArray[np.float64], force: NDArray[np.float64] | None,
    rest: float | None,
) -> str | None:  # fmt: skip
    """``displacement`` or ``length`` where the numbers [m] show which; None = they do not."""
    if len(values) < ENOUGH or not all(
        np.isfinite(v).all() for v in (values, pressure, *(() if force is None else (force,)))
    ):
        return None
    if force is not None and mostly_negative(force):
        force = -force
    with np.errstate(all="ignore"):
        longer = runs_against(values, pressure, force)
    low, high = float(np.min(values)), float(np.max(values))
    if longer is None or high <= 0.0:
        return None
    if longer:
        agrees = rest is None or (low >= _SHORTEST * rest and high <= _LONGEST * rest)
        return (
            "length"
            if agrees and low >= _SHORTEST * high and is_plausible("length", values, narrow=True)
            else None
        )
    agrees = rest is None or high <= (1.0 - _SHORTEST) * rest
    begins_low = abs(low) <= _FROM_ZERO * high
    return (
        "displacement"
        if agrees and begins_low and is_plausible("displacement", values, narrow=True)
        else None
    )
