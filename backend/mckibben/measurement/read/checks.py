"""Questions that the columns of a file and their numbers raise."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import CHANNEL_UNITS, STROKES
from mckibben.measurement.question import Question
from mckibben.measurement.read.cells import Labels
from mckibben.measurement.read.correction import SAMPLE
from mckibben.measurement.read.header import HeaderColumn, Meaning
from mckibben.measurement.read.plausible import ENOUGH, is_plausible, median_step, proposal
from mckibben.measurement.read.questions import column_option, ignore_option
from mckibben.measurement.read.recognise import BY_WORDS, taken_apart
from mckibben.measurement.read.unit_words import dimension_of
from mckibben.physics.units import convert

Array = NDArray[np.float64]

_CARRIES = {"a force": "force", "a pressure": "pressure", "a length": "length"}
_KNOWN_REASONS = ("the supply", "the surrounding air", "a length at rest", "a size of the tube", "a preload",
                  "a deviation", "you do not want it")  # fmt: skip
_SAME = 0.01  # of the range; columns that differ by less are the same reading
_CLIPPED = 100  # the penalty of a clipped column
_RAW_PENALTY = 1  # between a column and its raw, filtered or clipped form


class Evidence(NamedTuple):
    """What has been read when questions are asked.

    Attributes:
        headers: of all columns; ``apart``: their units in a row of their own.
        meaning: which columns are used.
        used: channel -> its column.
        channels: channel -> values [SI].
        numeric: whether a column that is not used holds numbers.
        pair: the numbers of two columns, row by row, None where they have none.
        labels: index of a column of words -> its words.
        conditions: of the test.
        choices: other tables of the file (option, columns).
    """

    headers: Sequence[str]
    apart: Sequence[str | None]
    meaning: Meaning
    used: Mapping[str, HeaderColumn]
    channels: Mapping[str, Array]
    numeric: Callable[[int], bool]
    pair: Callable[[int, int], tuple[Array, Array] | None]
    labels: Mapping[int, Labels]
    conditions: Mapping[str, float | str]
    choices: Sequence[tuple[str, str]]
    noun: str = "column"


def questions_of(evidence: Evidence) -> list[Question]:
    """All questions, those that stop the reading first."""
    rows = len(next(iter(evidence.channels.values()), ()))
    asked = _tables(evidence)
    if rows >= ENOUGH:
        asked += [*_units(evidence), *_unread(evidence), *_rivals(evidence), *_specimens(evidence)]
        unit_doubts = {question.about for question in asked}
        if not any(about.startswith("unit of") for about in unit_doubts):
            asked += [*_signs(evidence), *_reference(evidence), *_tare(evidence)]
    asked += _context(evidence)
    return sorted(asked, key=lambda question: not question.stops)


def _tables(evidence: Evidence) -> list[Question]:
    if not evidence.choices:
        return []
    titles = [title for title, _ in evidence.choices]
    return [
        Question(
            "sheet", f"{len(titles)} tables could be meant, {', '.join(map(repr, titles[:6]))}; which one is it",
            f'--sheet "{titles[0]}"', None, titles[0], tuple(titles),
        )
    ]  # fmt: skip


def _units(evidence: Evidence) -> list[Question]:
    asked = []
    for channel, column in evidence.used.items():
        if channel not in evidence.channels or column.unit_origin == "you" or channel in ("group", "direction"):
            continue
        values = evidence.channels[channel]
        si, unit = CHANNEL_UNITS[channel], column.unit or CHANNEL_UNITS[channel]
        raw = convert(values, si, si) if unit == si else _back(values, unit, si)
        span = f"{np.min(raw):.4g} to {np.max(raw):.4g}"
        named = f"{evidence.noun} '{column.header}'"
        if column.unit_origin == "proposed":
            found = proposal(channel, raw)
            if found.si_will_do:
                continue
            may = f"; {' or '.join(found.choices[:3])} would be plausible" if found.choices else ""
            asked.append(
                Question(
                    f"unit of {channel}", f"{named} ({channel}) has no unit and holds {span}{may}; which unit is it",
                    column_option(channel, _bare(column), found.unit), column.header, found.unit, found.choices,
                )
            )  # fmt: skip
        elif not is_plausible(channel, values):
            stops = channel != "pressure" or float(np.max(np.abs(values))) > _HARDLY or _forced(evidence, values)
            better = [u for u in proposal(channel, raw).choices if u != unit]
            if channel == "time":
                step = median_step(values) or 0.0
                better = [u for u in ("ms",) if is_plausible("time", raw * 1e-3)]
                if not better or not _moves(evidence):
                    continue
                what = f"{named} would take {step:.3g} s from reading to reading"
            else:
                what = f"{named} ({channel}) holds {span} {unit}, which no muscle on a test bench shows"
            hint = better[0] if better else unit
            asked.append(
                Question(
                    f"unit of {channel}", f"{what}; is its unit {' or '.join([*better[:2], unit])}",
                    column_option(channel, _bare(column), hint), column.header, hint, (*better, unit), stops,
                )
            )  # fmt: skip
    return asked


_HARDLY = 2e3  # Pa; below it a pressure moves no muscle
_LARGEST_AREA = 0.5  # m2, force over pressure; the largest catalogue muscle has 0.04


def _forced(evidence: Evidence, pressure: Array) -> bool:
    """Whether the force is more than any muscle gives at such a pressure."""
    force = evidence.channels.get("force")
    if force is None:
        return False
    return bool(np.max(np.abs(force)) > _LARGEST_AREA * max(float(np.max(np.abs(pressure))), 1e-9))


def _back(values: Array, unit: str, si: str) -> Array:
    zero, one = convert([0.0, 1.0], unit, si)
    return (values - zero) / (one - zero)


def _bare(column: HeaderColumn) -> str:
    """The name of a column as an option takes it: without its unit."""
    return taken_apart(column.header).name or column.header


def _moves(evidence: Evidence) -> bool:
    """Whether a quantity goes up and down, as no slow drift does."""
    for channel in ("pressure", *STROKES, "force"):
        values = evidence.channels.get(channel)
        if values is not None and np.ptp(values) > 0.0:
            steps = np.diff(values)
            if np.sum(np.abs(steps)) > 1.5 * np.ptp(values):
                return True
    return False


def _unread(evidence: Evidence) -> list[Question]:
    """Columns in N, bar or mm that nothing is read from, and nothing says why."""
    meaning = evidence.meaning
    used = {column.place for column in evidence.used.values()}
    rivals = {other.place for _, other in meaning.rivals}
    filled = set(evidence.used)
    asked = []
    for index, header in enumerate(evidence.headers):
        if index in used or index in meaning.dismissed or index in rivals or not evidence.numeric(index):
            continue
        head = taken_apart(header, evidence.apart[index] if index < len(evidence.apart) else None)
        channel = _CARRIES.get(dimension_of(head.unit))
        reason = meaning.reasons.get(index, "")
        if channel is None or any(known in reason for known in _KNOWN_REASONS):
            continue
        is_filled = channel in filled or (channel == "length" and bool(filled & set(STROKES)))
        if "a set value" in reason and is_filled:
            continue
        name = head.name or header or f"column {index + 1}"
        target = {"length": "displacement"}.get(channel, channel)
        asked.append(
            Question(
                f"column '{name}'", f"{evidence.noun} '{header or name}' is in {head.unit} and is not read"
                f"{' (' + reason + ')' if reason else ''}; what is it",
                f"{ignore_option(name)} or {column_option(target, name)}", header or name,
                choices=("ignore", *((target,) if target != "displacement" else ("displacement", "length", "diameter"))),
            )
        )  # fmt: skip
    return asked


def _rivals(evidence: Evidence) -> list[Question]:
    """Two columns for one channel that show different values."""
    asked = []
    for winner, other in evidence.meaning.rivals:
        if "you" in (winner.origin, other.origin) or winner.use not in evidence.channels:
            continue
        if winner.use not in ("force", "pressure", *STROKES):
            continue
        if abs(_plainness(other) - _plainness(winner)) >= _RAW_PENALTY or not evidence.numeric(other.place):
            continue
        both = evidence.pair(winner.place, other.place)
        if both is None:
            continue
        si = CHANNEL_UNITS[winner.use]
        values, second = (convert(v, c.unit or si, si) for v, c in zip(both, (winner, other), strict=True))
        if float(np.max(np.abs(second - values))) <= _SAME * max(float(np.ptp(values)), 1e-12):
            continue
        first, later = _bare(winner), _bare(other)
        asked.append(
            Question(
                f"second {winner.use}", f"{evidence.noun}s '{winner.header}' and '{other.header}' are both {winner.use} "
                "and differ; which one acts on the muscle",
                f"{column_option(winner.use, first)} or {column_option(winner.use, later)}", other.header,
                winner.header, (winner.header, other.header),
            )
        )  # fmt: skip
    return asked


def _plainness(column: HeaderColumn) -> int:
    """How raw, filtered or clipped a column says to be, however its name was recognised."""
    return column.penalty if column.penalty >= _CLIPPED else column.penalty % BY_WORDS


def _specimens(evidence: Evidence) -> list[Question]:
    column = evidence.used.get(SAMPLE)
    labels = evidence.labels.get(column.place) if column else None
    words = [word for word in labels.words if word] if labels else []
    if column is None or len(words) < 2 or column.origin == "you":
        return []
    return [
        Question(
            "specimens", f"{evidence.noun} '{column.header}' names {len(words)} specimens, {', '.join(map(repr, words[:4]))}; "
            "their readings belong to different muscles: split the file, or read all as one",
            ignore_option(_bare(column)), column.header, None, tuple(words[:8]),
        )
    ]  # fmt: skip


def _signs(evidence: Evidence) -> list[Question]:
    asked = []
    force = evidence.channels.get("force")
    column = evidence.used.get("force")
    if force is not None and column is not None and column.origin != "you" and _mostly_negative(force):
        asked.append(
            Question(
                "sign of force", f"{evidence.noun} '{column.header}' is negative nearly throughout, a pulling muscle "
                "is positive here; is compression counted positive",
                column_option("force", _bare(column), sign=-1), column.header, "turned", ("turned", "as it is"),
            )
        )  # fmt: skip
        force = -force
    stroke = evidence.channels.get("displacement")
    column = evidence.used.get("displacement")
    if stroke is None or column is None or column.origin == "you":
        return asked
    against = _against(evidence, stroke, force)
    if (_mostly_negative(stroke) and against is not False) or against or (column.extends and against is not False):
        how = "falls" if _mostly_negative(stroke) else "grows"
        asked.append(
            Question(
                "sign of displacement", f"{evidence.noun} '{column.header}' {how} as the muscle "
                f"{'shortens' if how == 'falls' else 'becomes longer'}, a stroke counts shortening as positive; "
                "is it to be turned",
                f"{column_option('displacement', _bare(column), sign=-1)}, or {column_option('length', _bare(column))}"
                if np.min(stroke) > 0.0 else column_option("displacement", _bare(column), sign=-1),
                column.header, "turned", ("turned", "as it is"),
            )
        )  # fmt: skip
    return asked


def _mostly_negative(values: Array) -> bool:
    low, high = float(np.min(values)), float(np.max(values))
    return low < 0.0 and -low > 4.0 * max(high, 0.0)


def _against(evidence: Evidence, stroke: Array, force: Array | None) -> bool | None:
    """Whether the stroke runs against physics: pulled harder, a muscle becomes longer, more air shortens it.

    None = the readings do not show it.
    """
    pressure = evidence.channels.get("pressure")
    if np.ptp(stroke) == 0.0 or pressure is None:
        return None
    if force is not None and np.ptp(force) > 0.02 * np.max(np.abs(force)):
        basis = np.column_stack([np.ones(len(stroke)), _scaled(pressure), _scaled(stroke)])
        weights, *_ = np.linalg.lstsq(basis, _scaled(force), rcond=None)
        return None if abs(weights[2]) < 0.2 else bool(weights[2] > 0.0)
    if np.ptp(pressure) == 0.0:
        return None
    together = float(np.corrcoef(pressure, stroke)[0, 1])
    return None if abs(together) < 0.6 else together < 0.0


def _scaled(values: Array) -> Array:
    span = float(np.ptp(values))
    return (values - np.mean(values)) / (span or 1.0)


_REST_BAND = (0.9e5, 1.1e5)  # Pa; the air outside


def _reference(evidence: Evidence) -> list[Question]:
    """A pressure that shows about 1 bar while the muscle does nothing may count from vacuum."""
    pressure, column = evidence.channels.get("pressure"), evidence.used.get("pressure")
    if pressure is None or column is None or column.absolute is not None or column.origin == "you":
        return []
    if "pressure" in evidence.conditions:
        return []
    lowest = float(np.min(pressure))
    if not _REST_BAND[0] <= lowest <= _REST_BAND[1] or np.ptp(pressure) < 0.2e5:
        return []
    at_rest = pressure <= lowest + 0.03e5
    if not _idle(evidence, at_rest):
        return []
    return [
        Question(
            "reference of pressure", f"{evidence.noun} '{column.header}' shows {lowest / 1e5:.2f} bar at rest; is it absolute or "
            "gauge pressure",
            f'{column_option("pressure", _bare(column), f"{column.unit}(a)")} or '
            f'{column_option("pressure", _bare(column), f"{column.unit}(g)")}',
            column.header, "absolute", ("absolute", "gauge"),
        )
    ]  # fmt: skip


def _idle(evidence: Evidence, rows: NDArray[np.bool_]) -> bool:
    """Whether the muscle neither pulls nor moves in these rows."""
    force = evidence.channels.get("force")
    if force is not None and np.ptp(force) > 0.05 * np.max(np.abs(force)):
        shown = force[rows][force[rows] != 0.0]  # an exact 0 is a slack muscle or a clipped table
        return len(shown) > 0 and bool(np.max(np.abs(shown)) <= 0.05 * np.max(np.abs(force)))
    for channel in ("displacement", "contraction"):
        stroke = evidence.channels.get(channel)
        if stroke is not None and np.ptp(stroke) > 0.0:
            return bool(np.max(np.abs(stroke[rows])) <= 0.05 * np.max(np.abs(stroke)))
    return False


def _tare(evidence: Evidence) -> list[Question]:
    """A force at rest, without pressure and stroke: the sensor was not set to zero."""
    force, pressure = evidence.channels.get("force"), evidence.channels.get("pressure")
    column = evidence.used.get("force")
    stroke = evidence.channels.get("displacement")
    if force is None or pressure is None or stroke is None or column is None or np.ptp(force) == 0.0:
        return []
    rows = (np.abs(pressure) < 0.03e5) & (np.abs(stroke) < 0.01 * max(float(np.max(np.abs(stroke))), 1e-9))
    if np.count_nonzero(rows) < ENOUGH:
        return []
    offset = float(np.median(force[rows]))
    if abs(offset) < 0.02 * float(np.max(np.abs(force))):
        return []
    return [
        Question(
            "zero of force", f"{evidence.noun} '{column.header}' shows {offset:.3g} N at rest, without pressure and stroke; "
            "it is not subtracted, was the sensor not set to zero",
            column_option("force", _bare(column)), column.header, None, (), stops=False,
        )
    ]  # fmt: skip


def _context(evidence: Evidence) -> list[Question]:
    """What the test was, where the file does not say it and a comparison needs it."""
    asked = []
    channels, conditions = evidence.channels, evidence.conditions
    strokes = [channel for channel in STROKES if channel in channels]
    if strokes == ["displacement"] and "nominal_length" not in conditions:
        asked.append(
            Question(
                "rest length", "the file states no rest length (L0) of the muscle; a stroke alone gives no contraction",
                '--rest-length "300 mm"', stops=False,
            )
        )  # fmt: skip
    loaded = "load_mass" in conditions or "load_force" in conditions or "force" in channels
    if not loaded and (strokes or "pressure" in channels) and "diameter" not in channels:
        asked.append(
            Question(
                "load", "the file states no load; it decides how far the muscle shortens", '--load "6 kg"', stops=False
            )
        )
    if "command" in channels and "supply_pressure" not in conditions:
        asked.append(
            Question(
                "supply", "the file states no supply pressure, from which the valve fills the muscle",
                '--supply "6 bar"', stops=False,
            )
        )  # fmt: skip
    return asked
