"""The rows of a decision in SI: which can be read, in which order, with directions, groups and what was
held.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.reading.answers import ignore_option
from mckibben.measurement.reading.correction import SAMPLE, SLACK, Correction
from mckibben.measurement.reading.decide import SLOTS, Decision, roles_of, value_of
from mckibben.measurement.reading.evidence import NAME
from mckibben.measurement.reading.facts import Held, Known
from mckibben.measurement.reading.lexicon import word_set, words_of
from mckibben.measurement.reading.model import Array, Column, Evidence, Skip, Table, Use
from mckibben.measurement.reading.named import length_of_name
from mckibben.measurement.reading.numbers import BROKEN
from mckibben.measurement.reading.units import Quantity, quantity_si
from mckibben.physics.errors import InputError
from mckibben.physics.units import GRAVITY

LARGEST = 1e15  # in SI; more is of no physical size
_ENOUGH_ROWS = 20
_MOST_WITHOUT = 4  # rows without a reading for each other one; more are a slow signal or a wrong column
_MOST_CUT = 40  # whole rows for each line that breaks off, from which the writing of the line was cut short
_LONG_TABLE = 100  # rows
_FEWEST_TO_TURN = 3  # rows
_DISORDERED = 1.0 / 3.0  # share of steps back in time from which rows are in no order; a half by chance
_RUN_CHANGES = (
    0.1  # share of rows that begin another run, above which the runs do not follow each other in time
)
_CLEAR = 0.2  # of the range of a channel, from which its change on the way shows a direction
_MOST_WORDS = 40  # different ones of a column of directions
_UNKNOWN_WAYS = frozenset(("", "-", "unknown", "none", "nan", "na", "n/a"))
_WAYS = ("shortening", "lengthening", "pressure_rises", "pressure_falls", "one_way", "other_way")
_PAIRS = (("shortening", "lengthening"), ("pressure_rises", "pressure_falls"), ("one_way", "other_way"))
_SIDES = {"pressure_rises": 1.0, "pressure_falls": -1.0, "one_way": 1.0, "other_way": -1.0}
_OPTIONAL = ("temperature", "velocity", "diameter", "angle", "torque", "lever")
_IMPOSSIBLE = {
    "length": ("is not a length", "a length above 0"), "diameter": ("is not a diameter", "a diameter above "
                                                                                         "0"),
    "temperature": ("is not a temperature", "a temperature above 0 K"),
    "contraction": ("is not possible", "contraction is (L0 - L)/L0 < 1; percent is 'contraction_pct'"),
    "pressure": (
        "is a negative absolute pressure",
        "write 'pressure_abs_bar' or '# pressure: absolute' if it is absolute; gauge is assumed",
    ),
}  # fmt: skip


@dataclass
class Rows:
    """The channels in SI, and what was left out.

    Attributes:
        channels: channel -> values.
        labels: use (``direction``, ``group``, ``slack``, ``sample``) -> column.
        held: channel -> what was held instead of a column.
        skipped: reason -> rows left out, and where the first is.
        slack: rows that the file marks as slack.
        lines: number in the file of each row.
        dropped: column -> why it is not read though its head says a channel.
        blocks: block of each row.
        messages: what was done.
        samples: names of the specimens.
        first_bad: the first row that cannot be read, as a refusal.
    """

    channels: dict[str, Array] = field(default_factory=dict)
    labels: dict[str, int] = field(default_factory=dict)
    held: dict[str, Held] = field(default_factory=dict)
    skipped: dict[str, Skip] = field(default_factory=dict)
    slack: NDArray[np.bool_] | None = None
    lines: NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, np.int64))
    dropped: dict[int, str] = field(default_factory=dict)
    blocks: NDArray[np.intp] = field(default_factory=lambda: np.zeros(0, np.intp))
    messages: list[str] = field(default_factory=list)
    samples: tuple[str, ...] = ()
    first_bad: InputError | None = None


def rows_of(
    table: Table, decision: Decision, known: Known, evidence: Sequence[Evidence], correction: Correction
) -> Rows:
    """The rows of a table that can be read.

    Raises:
        InputError: cells that are no numbers, values that cannot be, or too few rows; `Rows.first_bad` holds
        the
            first of them where bad rows are left out.
    """
    rows = Rows()
    facts = known.facts(table)
    values = {
        c: value_of(table.columns[i].values, use, facts.ambient) for c, (i, use) in decision.uses.items()
    }
    bad = str(known.conditions.get("bad_rows", "")).lower() == "skip" or correction.skip_bad_rows
    used = dict(decision.uses)
    for channel in [c for c in used if c in _OPTIONAL and used[c][0] not in known.chosen]:
        i = used[channel][0]
        others = [u[0] for c, u in used.items() if c != channel]
        if table.columns[i].gaps and not set(table.columns[i].gaps) <= {
            r for o in others for r in table.columns[o].gaps
        }:
            rows.dropped[i] = f"it holds no number in {len(table.columns[i].gaps)} rows"
            del used[channel], values[channel]
    keep = _readable(table, [i for i, _ in used.values()], rows, skip=bad)
    keep &= _possible(table, used, values, keep, facts.ambient, rows, skip=bad)
    if not keep.any():
        raise rows.first_bad or InputError(
            f"{table.where}: no row can be read", field="rows", hint="rows of numbers below the header"
        )
    rows.channels = {c: v[keep].astype(float) for c, v in values.items()}
    rows.lines, rows.blocks = table.lines[keep], table.blocks[keep]
    _even_time(rows, table, decision, evidence)
    if "time" in rows.channels and "time" in decision.uses and decision.uses["time"][1].unit in ("clock",):
        rows.channels["time"] = rows.channels["time"] - rows.channels["time"][0]
    counted = decision.uses.get("time")
    if counted is not None and counted[1].scale != 1.0 and counted[0] not in known.chosen:
        rows.channels["time"] = rows.channels["time"] - rows.channels["time"][0]  # counts begin anywhere
    if "time" in rows.channels and "time" in decision.uses and rows.channels["time"][0] > 1e8:
        rows.channels["time"] = rows.channels["time"] - rows.channels["time"][0]
        rows.messages.append(
            f"{table.noun} '{table.columns[decision.uses['time'][0]].title}' counts from 1970: its first "
            f"row is 0 s"
        )
    _hold(rows, known, correction, table.where)
    _labels(rows, table, known, evidence, keep, {i for i, _ in used.values()})
    _oldest_first(rows, table, decision)
    if len(table.titles) > 1 and "group" not in rows.channels:
        rows.channels["group"] = rows.blocks.astype(float)
    return rows


_COARSE = 0.6  # share of the steps of a clock that are 0, from which a stated interval is finer


def _even_time(rows: Rows, table: Table, decision: Decision, evidence: Sequence[Evidence]) -> None:
    """The time by a stated interval of sampling, where the file has none, or a clock that stands still for
    several rows.
    """
    steps = {_seconds(e.value): e for e in evidence if e.facet == "condition:sampling_step"}
    if not steps or len(table.titles) > 1:
        return
    time = rows.channels.get("time")
    seconds, step = next(iter(steps.items()))
    thinned = any(word_set("thinned").among(words_of(e.span.text)) for e in steps.values())
    if (len(steps) > 1 or thinned) and time is None:
        rows.messages.append(
            f"no time: '{step.span.text[:60]}' ({step.span.where}) does not say how far apart the rows are"
        )
    if len(steps) > 1 or thinned:
        return
    if time is not None:
        column = table.columns[decision.uses["time"][0]]
        if (
            not column.clock
            or len(time) < _FEWEST_TO_TURN
            or np.mean(np.diff(time) == 0.0) < 1.0 - _COARSE
            or seconds >= 1.0
        ):
            return
    elif not {"force", *STROKES} & set(rows.channels):
        return
    rows.channels["time"] = seconds * np.arange(len(rows.lines), dtype=float)
    rows.messages.append(
        f"time is counted by the interval of sampling, '{step.span.text[:60]}' ({step.span.where})"
    )


def _seconds(step: Quantity) -> float:
    """The interval [s] of an interval or a rate."""
    rate = step.unit.dimension == "frequency"
    value = quantity_si(step.value, step.unit.name, "Hz" if rate else "s")
    return round(1.0 / value if rate and value else value, 12)


def _readable(table: Table, places: Sequence[int], rows: Rows, *, skip: bool) -> NDArray[np.bool_]:
    """The rows in which every column that is used has a number."""
    keep = np.ones(table.rows, bool)
    for i in places:
        keep &= np.isfinite(table.columns[i].values)
    empty = np.ones(table.rows, bool)
    for i in places:
        column = table.columns[i]
        gaps = {r for r, gap in column.gaps.items() if gap.reason == "empty"}
        here = np.zeros(table.rows, bool)
        here[list(gaps)] = True
        empty &= here
    first: dict[int, tuple[int, str, str]] = {}
    for i in places:
        for r, gap in table.columns[i].gaps.items():
            if not empty[r] and (r not in first or gap.reason == "short"):
                first[r] = (i, gap.reason, gap.text)
    missing: list[tuple[int, str, str]] = []
    cut = sum(reason == "short" for _, reason, _ in first.values()) * _MOST_CUT <= keep.sum()
    hint = "one cell for each name of the header; with decimal commas ';' or tabs between the cells"
    for r, what in table.bad.items():
        if not empty[r]:
            keep[r] = False
            first.pop(r, None)
            _refuse(rows, table, int(table.lines[r]), "", what, hint)
            _count(rows, "another number of cells", 1, f"row {int(table.lines[r])}")
    counts = Counter(reason for _, reason, _ in first.values())
    for r, (i, reason, text) in sorted(first.items()):
        title = table.columns[i].title
        where = f"row {int(table.lines[r])}, {table.noun} '{title}'"
        if reason == "short" and cut:
            _count(rows, "the line is cut off", 1, f"row {int(table.lines[r])}: {text}")
            continue
        if reason == "short":
            _refuse(rows, table, int(table.lines[r]), "", text, "one cell for each name of the header")
            _count(rows, "another number of cells", 1, f"row {int(table.lines[r])}")
            continue
        if reason in BROKEN:
            what, hint = f"{text!r} {BROKEN[reason]}", "a number, or an empty cell"
            what += f" (and {counts[reason] - 1} more such rows)" if counts[reason] > 1 else ""
            _refuse(rows, table, int(table.lines[r]), title, what, hint)
            _count(rows, "not a number", 1, where)
            continue
        what = "the cell is empty" if reason == "empty" else f"{text!r} is {reason}"
        reason = "an empty cell" if reason == "empty" else reason
        missing.append((int(table.lines[r]), title, what))
        _count(rows, reason, 1, where)
    if rows.first_bad is not None and not skip:
        raise rows.first_bad
    if (
        missing
        and not skip
        and len(missing) > keep.sum()
        and not (keep.sum() >= _ENOUGH_ROWS and len(missing) <= _MOST_WITHOUT * keep.sum())
    ):
        line, title, what = missing[0]
        _refuse(
            rows,
            table,
            line,
            title,
            f"{what}, and {len(missing)} rows have no number there",
            f"a number in each row, or leave the column out: {ignore_option(title)}",
        )
    if missing and rows.first_bad is not None and not skip:
        raise rows.first_bad
    return keep


def _refuse(rows: Rows, table: Table, line: int, title: str, what: str, hint: str) -> None:
    if rows.first_bad is None:
        column = f", {table.noun} '{title}'" if title else ""
        rows.first_bad = InputError(
            f"{table.where}, row {line}{column}: {what}",
            field=f"row {line}{column.replace(chr(39), '')}",
            hint=hint,
        )


def _count(rows: Rows, reason: str, count: int, first: str) -> None:
    before = rows.skipped.get(reason)
    rows.skipped[reason] = Skip(count + (before.rows if before else 0), before.first if before else first)


def _possible(
    table: Table, used: Mapping[str, tuple[int, Use]], values: Mapping[str, Array], keep:
        NDArray[np.bool_],
    ambient: float | Array, rows: Rows, *, skip: bool,
) -> NDArray[np.bool_]:  # fmt: skip
    """The rows whose values can be: no length below 0, no absolute pressure below 0."""
    good = np.ones(table.rows, bool)
    for channel, x in values.items():
        what, hint = "is too large", "a number of physical size"
        with np.errstate(invalid="ignore"):
            bad = keep & ~(np.abs(x) < LARGEST)
            if not bad.any() and channel in _IMPOSSIBLE:
                what, hint = _IMPOSSIBLE[channel]
                limit = {"pressure": x < -ambient, "contraction": x >= 1.0}.get(channel, x <= 0.0)
                bad = keep & limit
        if not bad.any():
            continue
        i = used[channel][0]
        r = int(np.argmax(bad))
        title = table.columns[i].title
        more = f" (and {int(bad.sum()) - 1} more such rows)" if bad.sum() > 1 else ""
        shown = f"{table.columns[i].values[r]:g} {used[channel][1].unit}"
        _refuse(rows, table, int(table.lines[r]), title, f"{shown} {what}{more}", hint)
        _count(
            rows,
            what.removeprefix("is "),
            int(bad.sum()),
            f"row {int(table.lines[r])}, {table.noun} '{title}'",
        )
        if not skip and rows.first_bad is not None:
            raise rows.first_bad
        good &= ~bad
    return good


def _hold(rows: Rows, known: Known, correction: Correction, where: str) -> None:
    """What texts say was held, for the channels that no column holds."""
    columns = rows.channels
    for channel, held in known.held.items():
        if held.by_you:
            alike = next((c for c in columns if SLOTS.get(c) == SLOTS[channel]), None)
            if alike is not None:
                raise InputError(
                    f"{where}: '{held.text}' is said to be the {channel}, which a column holds, the {alike}",
                    field="columns",
                    hint="leave that column out as well, or do not say the value",
                )
            _take(rows, known, channel)
    stroke = bool(set(columns) & {*STROKES, "diameter"})
    if (
        "pressure" not in columns
        and "pressure" in known.held
        and ("force" in columns or (stroke and "load_mass" in known.held))
    ):
        _take(rows, known, "pressure")
    if not stroke and "command" not in columns and {"pressure", "force"} <= set(columns):
        for channel in ("length", "contraction", "displacement"):
            if channel in known.held and not known.held[channel].by_name:
                _take(rows, known, channel)
                break
        else:
            _by_name(rows, known, correction, where)
    if "force" not in columns and "pressure" in columns and bool(set(columns) & set(STROKES)):
        for key, factor in (("load_mass", GRAVITY), ("load_force", 1.0)):
            if key in known.held and np.ptp(known.held[key].values) > 0.0:
                columns["force"] = known.held[key].values[rows.blocks] * factor
                rows.held["force"] = known.held[key]
                rows.messages.append(
                    f"force is the weight that the titles of the blocks state, '{known.held[key].text}' first"
                )


def _by_name(rows: Rows, known: Known, correction: Correction, where: str) -> None:
    """The length that the file's name says, where the rest length is known from elsewhere."""
    name = where.partition(", ")[0]
    stated = known.stated.get("nominal_length")
    rest = correction.muscle_length if stated is None or stated.where.where == NAME else stated.value
    if not isinstance(rest, float):
        return
    isometric = known.kind == "isometric" or str(known.conditions.get("kind", "")) == "isometric"
    found = length_of_name(name, rest, isometric=isometric, others=correction.beside)
    if found is None or (found.why and correction.strict):
        return
    rows.channels["length"] = np.full(len(rows.lines), found.value)
    rows.held["length"] = Held(np.array([found.value]), found.text, NAME, "m", True)
    if stated is not None and stated.where.where == NAME:
        known.conditions.pop("nominal_length", None)
    rows.messages.append(
        f"length is taken from {NAME}: '{found.text}'{f' ({found.why})' if found.why else ''}"
    )


def _take(rows: Rows, known: Known, channel: str) -> None:
    held = known.held[channel]
    rows.channels[channel] = held.values[rows.blocks]
    rows.held[channel] = held
    rows.messages.append(f"{channel} is taken from {held.where}: '{held.text}'")


def _labels(
    rows: Rows, table: Table, known: Known, evidence: Sequence[Evidence], keep: NDArray[np.bool_], used:
        set[int]
) -> None:  # fmt: skip
    """Directions, groups, marks of slack and names of specimens."""
    for use in ("direction", "group", SLACK, SAMPLE):
        i = _label_column(use, table, known, evidence, used)
        if i is None:
            continue
        words = _words(table.columns[i], keep)
        made: Array | None = None
        if use == "direction":
            made = direction_of(words, rows.channels, rows.messages)
            if made is None:
                rows.dropped[i] = "its words are not known, e.g. 'filling' and 'venting'"
        elif use == "group":
            made = _group(words)
        elif use == SLACK:
            if "force" in rows.channels and {w.lower() for w in words} <= {"0", "1", "true", "false"}:
                rows.slack = np.array([w.lower() in ("1", "true") for w in words])
            else:
                rows.dropped[i] = "a mark of slack is 0 or 1, beside a force"
        elif use == SAMPLE:
            rows.samples = tuple(dict.fromkeys(w for w in words if w))
            if len(rows.samples) == 1:
                known.conditions.setdefault("sample", rows.samples[0][:200])
        if made is not None:
            rows.channels[use] = made
        if i not in rows.dropped:
            rows.labels[use] = i
            used.add(i)


def _label_column(
    use: str, table: Table, known: Known, evidence: Sequence[Evidence], used: set[int]
) -> int | None:
    """The column of a use that is no quantity."""
    said = [i for i, choice in known.chosen.items() if choice is not None and choice.channel == use]
    if said:
        return said[0]
    found: list[tuple[float, int]] = []
    for i, column in enumerate(table.columns):
        if i in used or i in known.chosen or column.clock:
            continue
        own = [e for e in evidence if e.target == i]
        roles = roles_of(own)
        claimed = sum(e.weight for e in own if e.facet == "channel" and e.value == use)
        claimed += {SLACK: roles.get("slack", 0.0), SAMPLE: roles.get("specimen", 0.0)}.get(use, 0.0)
        if use == "direction" and not claimed and word_set("phases").among(words_of(column.head)):
            claimed = 2.0
        numeric = column.words is None
        if (
            claimed <= 0.0
            or (use == SAMPLE and numeric)
            or (use == "group" and numeric and not _are_labels(column.values))
        ):
            continue
        if any(e.facet == "unit" for e in own) and use != "direction":
            continue
        found.append((claimed, -i))
    return -max(found)[1] if found else None


def _are_labels(values: Array) -> bool:
    finite = values[np.isfinite(values)]
    if not len(finite) or counts_rows(finite):
        return False
    return bool(np.all(finite == np.round(finite))) and bool(np.max(np.abs(finite)) < 1e9)


def counts_rows(values: Array) -> bool:
    """Whether a column counts on in each row of a long table: no row would be in a group with another."""
    return len(values) >= _LONG_TABLE and bool(np.all(np.diff(values) == 1.0))


def _words(column: Column, keep: NDArray[np.bool_]) -> list[str]:
    if column.words is not None:
        return [word.strip() for word, kept in zip(column.words, keep, strict=True) if kept]
    return ["" if not np.isfinite(v) else f"{v:g}" for v in column.values[keep]]


def _group(words: Sequence[str]) -> Array:
    """Integer labels as they are, other words numbered from 0 in order of appearance."""
    order = {word: k for k, word in enumerate(dict.fromkeys(words))}
    if all(re.fullmatch(r"[+-]?[0-9]{1,9}", word) for word in order):
        return np.array([int(word) for word in words], float)
    return np.array([order[word] for word in words], float)


def direction_of(words: Sequence[str], channels: Mapping[str, Array], messages: list[str]) -> Array | None:
    """-1 shortening, +1 lengthening, 0 unknown; None when a word is not understood.

    "load" alone says too little (a weight lengthens, air shortens), nor does "rising": there the stroke, else
    the
    pressure, of neighbouring rows decides.
    """
    distinct = dict.fromkeys(words)
    if len(distinct) > _MOST_WORDS:
        return None
    known = {word: way_of_word(word) for word in distinct}
    if None in known.values():
        return None
    sides = np.array([_SIDES.get(str(known[word]), 0.0) for word in words])
    sign = _sign_of_sides(sides, channels) if sides.any() else 0.0
    sure = {"shortening": -1.0, "lengthening": 1.0}
    value = {
        word: float(str(way))
        if re.fullmatch(r"-?[01]", str(way))
        else sure.get(str(way), _SIDES.get(str(way), 0.0) * sign)
        for word, way in known.items()
    }
    meaning = {-1.0: "shortening", 1.0: "lengthening", 0.0: "unknown"}
    messages.append("direction read: " + ", ".join(f"'{w}' as {meaning[v + 0.0]}" for w, v in value.items()))
    return np.array([value[word] for word in words]) + 0.0


@lru_cache(maxsize=4096)
def way_of_word(word: str) -> str | None:
    """The way that a word says, ``"0"``, ``"1"`` or ``"-1"``; None = not understood."""
    low = word.strip().lower()
    if low in _UNKNOWN_WAYS:
        return "0"
    if re.fullmatch(r"[+-]?[01](?:\.0{1,9})?", low):
        return str(int(float(low)))
    parts = words_of(word)
    found = {way for way in _WAYS if word_set(f"way_{way}").among(parts)}
    for pair in _PAIRS:
        if len(both := found & set(pair)) == 1:
            return both.pop()
        if both:
            return None
    return "0" if word_set("holds").among(parts) else None


def _sign_of_sides(side: Array, channels: Mapping[str, Array]) -> float:
    """Direction of the rows of the first side: the sign of the summed change of length along them."""
    same = (side[1:] == side[:-1]) * side[1:]
    blocks = 1 + int(np.count_nonzero(side[1:] != side[:-1]))
    for channel in (*STROKES, "pressure"):
        if channel not in channels or not np.ptp(channels[channel]) > 0.0:
            continue
        change = float(np.sum(np.diff(channels[channel]) * same))
        if abs(change) > _CLEAR * blocks * float(np.ptp(channels[channel])):
            return float(np.sign(change)) * (1.0 if channel == "length" else -1.0)
    return 0.0


def _oldest_first(rows: Rows, table: Table, decision: Decision) -> None:
    """Turn or sort the rows of a file whose time does not run forwards."""
    time = rows.channels.get("time")
    if (
        time is None
        or "time" not in decision.uses
        or len(time) < _FEWEST_TO_TURN
        or time.min() == time.max()
        or len(table.titles) > 1
    ):
        return
    if (np.diff(time) <= 0.0).all():
        order = np.arange(len(time))[::-1]
        said = "the rows run backwards in time: they are read from the last to the first"
    elif (sorted_rows := _order_of(time, rows.channels.get("group"))) is not None:
        order, said = sorted_rows, "the rows are in no order of time: they are sorted by it"
    else:
        return
    rows.channels = {channel: values[order].copy() for channel, values in rows.channels.items()}
    rows.lines, rows.blocks = rows.lines[order], rows.blocks[order]
    if table.columns[decision.uses["time"][0]].clock:
        rows.channels["time"] -= rows.channels["time"][0]
    rows.messages.append(said)
    rows.slack = None if rows.slack is None else rows.slack[order].copy()


def _order_of(time: Array, group: Array | None) -> NDArray[np.intp] | None:
    """Rows in order of time where they are in no order; None where they are, or several runs begin at 0."""
    if np.mean(np.diff(time) < 0.0) < _DISORDERED:
        return None
    labels = np.zeros(len(time)) if group is None else group
    if len(np.unique(np.column_stack([labels, time]), axis=0)) < len(time):
        return None
    order = np.argsort(time)
    if np.mean(np.diff(labels[order]) != 0) < _RUN_CHANGES:
        return order
    return np.lexsort((time, labels))  # each run has a time of its own
