"""What is asked: margins that are too small, and the policies, that are asked whatever the margin.

Each policy is one function; its files in `tests/measurement/reading` must ask.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from mckibben.measurement.kind import turning_points, weights_of_runs
from mckibben.measurement.measurement import CHANNEL_UNITS, STROKES
from mckibben.measurement.question import Question
from mckibben.measurement.reading import physics
from mckibben.measurement.reading.answers import column_option, ignore_option
from mckibben.measurement.reading.chosen import words_of_levels
from mckibben.measurement.reading.correction import Correction
from mckibben.measurement.reading.decide import (
    FINAL,
    MARGIN,
    SLOTS,
    Decision,
    Option,
    roles_of,
    unit_is_stated,
    value_of,
)
from mckibben.measurement.reading.evidence import NAME, NO_ZERO
from mckibben.measurement.reading.facts import Known
from mckibben.measurement.reading.heads import head_claims, taken_apart
from mckibben.measurement.reading.lexicon import rules, word_set, words_of
from mckibben.measurement.reading.model import FILE, Array, Column, Evidence, Span, Table, Use
from mckibben.measurement.reading.named import is_isometric, number_of_name
from mckibben.measurement.reading.numbers import MARK, TEXT, kind_of
from mckibben.measurement.reading.physics import ENOUGH, is_plausible, median_step, proposal
from mckibben.measurement.reading.rows import Rows, counts_rows
from mckibben.measurement.reading.scales import Scale
from mckibben.measurement.reading.scatter import is_sensed
from mckibben.measurement.reading.units import (
    FITTING,
    RAW,
    WEIGHTS,
    Quantity,
    dimension_of,
    quantity_si,
)
from mckibben.measurement.reading.zeros import stated_hangers, stated_zeros
from mckibben.physics.units import convert

REVERSE, KEEP = "reverse the sign", "keep the sign"
_SAME = 0.01  # of the range; columns that differ by less are the same reading
_HARDLY = 2e3  # Pa; below it a pressure moves no muscle
_LARGEST_AREA = 0.5  # m2, force over pressure; the largest catalogue muscle has 0.04
_STRETCHED, _FEW = 0.15, 0.05  # of the rest length, at which a braid locks; share of rows that may be spikes
_WHOLE = 1e-3  # mm
_NOTHING = 0.02  # of the largest reading, below which it is none
_SHORTEST = 0.4  # of the rest length, that a muscle can have
_REST_BAND = (0.9e5, 1.1e5)  # Pa; the air outside
_LONG_TEST, _SWING, _JUMP, _JUMPS = 900.0, 0.1, 0.6, 2
#: Heads of a displacement in the plain form of this program: "position_mm".
_PLAIN_STROKE = re.compile(r"(?:displacement|position|stroke|x)_[A-Za-z%]{1,4}")
_BRACKET = re.compile(r"[\[(]\s?([^\W\d_]{2,20})\s?[\])]\s?$")
_OPPOSED = -0.5  # correlation of the pressures of a pair, of which one is filled as the other is vented
_CARRIES = {"force": "force", "pressure": "pressure", "length": "displacement"}
_RAW_SPANS = {
    "V": "0 to 10 V",
    "mV": "0 to 20 mV",
    "mA": "4 to 20 mA",
    "count": "0 to 1023 counts",
    "mV/V": "0 to 2 mV/V",
    "%FS": "0 to 100 %FS",
}
SCALABLE = ("pressure", "force", *STROKES, "command")
_SCALED = {"pressure": "0 to 10 bar", "force": "0 to 2000 N", "length": "0 to 300 mm",
           "displacement": "0 to 100 mm",
           "contraction": "0 to 100 mm", "command": "-100 to 100 %"}  # fmt: skip


@dataclass(frozen=True)
class Reading:
    """All that is known of a file once it is decided."""

    name: str
    table: Table
    evidence: tuple[Evidence, ...]
    known: Known
    decision: Decision
    rows: Rows
    correction: Correction

    def column(self, channel: str) -> Column | None:
        """The column that a channel is read from."""
        use = self.decision.uses.get(channel)
        return self.table.columns[use[0]] if use is not None and channel in self.rows.channels else None

    def use(self, channel: str) -> Use:
        """How a channel is read."""
        return self.decision.uses[channel][1]

    def by_user(self, channel: str) -> bool:
        """Whether the user named the column of a channel."""
        return channel in self.decision.uses and self.decision.uses[channel][0] in self.known.chosen

    def said_unit(self, channel: str) -> bool:
        """Whether the file or the user says the unit of a channel."""
        i = self.decision.uses[channel][0]
        choice = self.known.chosen.get(i)
        return (
            choice is not None and (choice.unit is not None or choice.scale is not None)
        ) or unit_is_stated(i, self.evidence)

    def label(self, column: Column) -> str:
        """A column, as messages name it."""
        return f"{self.table.noun} '{column.title}'"

    def uses(self) -> Iterator[tuple[str, int, Use, Column]]:
        """What is read: channel, place of its column, how, the column."""
        for channel, (i, use) in self.decision.uses.items():
            if channel in self.rows.channels:
                yield channel, i, use, self.table.columns[i]

    def of_slot(self, slot: str) -> str | None:
        """The channel that is read for a slot."""
        return next((c for c, *_ in self.uses() if SLOTS.get(c) == slot), None)

    def unit(self, i: int) -> str | None:
        """The unit that is stated for a column."""
        return next((e.value for e in self.own(i) if e.facet == "unit"), None)

    @property
    def is_isometric(self) -> bool:
        """Whether a text or the name of the file says that the length was held."""
        kinds = (self.known.kind, str(self.known.conditions.get("kind", "")))
        return "isometric" in kinds or is_isometric(self.name)

    def claims(self, i: int, channel: str) -> list[Evidence]:
        """What says that a column is a channel."""
        return [e for e in self.own(i) if e.facet == "channel" and e.value == channel]

    def facet(self, i: int, facet: str) -> bool:
        """Whether something is claimed of a column."""
        return any(e.facet == facet for e in self.own(i))

    def roles(self, i: int) -> dict[str, float]:
        """Role -> what is said for it."""
        return roles_of(self.own(i))

    def own(self, i: int) -> list[Evidence]:
        """What is claimed of a column."""
        return [e for e in self.evidence if e.target == i]


def bare(column: Column) -> str:
    """A head without its unit, as options name it; its place where several are called alike."""
    head = column.head.strip()
    if head and column.key not in ("", head) and column.place >= 0:
        return f"column {column.place + 1}"
    apart = taken_apart(head, column.unit)
    return (apart.name if apart.unit is not None or apart.absolute is not None else head) or column.title


def option_of(channel: str, column: Column, unit: str | None = None, *, sign: int = 1) -> str:
    """The option that reads a column as a channel."""
    return column_option(channel, bare(column), unit, sign=sign)


def taken_or_not(reading: Reading, channel: str, column: Column, text: str, about: str = "") -> Question:
    """Whether a column is a channel; the text goes on behind its name."""
    return Question(
        about or f"column '{bare(column)}'",
        f"{reading.label(column)} {text}",
        f"{option_of(channel, column)} or {ignore_option(bare(column))}",
        column.head,
        channel,
        (channel, "ignore"),
    )


_MOST = 10  # questions of one kind at a time: what is answered first, often answers the rest


def questions_of(reading: Reading) -> list[Question]:
    """All questions, those that stop the reading first."""
    asked = list(_sheets(reading))
    enough = len(reading.rows.lines) >= ENOUGH
    with np.errstate(all="ignore"):
        for policy in POLICIES if enough else ():
            asked += islice(policy(reading), _MOST)
        for policy in ALWAYS:
            asked += islice(policy(reading), _MOST)
    first = {(q.about, q.column): q for q in reversed(asked)}
    kept = [q for q in asked if first[q.about, q.column] is q and not _follows(q, asked)]
    return sorted(kept, key=lambda question: not question.stops)


def _follows(question: Question, asked: Sequence[Question]) -> bool:
    """Whether a question is answered with another one: with the unit of a column what it counts from, with
    the one where a stroke has its zero its sign, its channel, L0.
    """
    open_zeros = {q.column for q in asked if q.about.partition("zero of ")[2] in STROKES}
    units = {q.column for q in asked if q.stops and q.about.startswith("unit of")}
    about = question.about.partition(" in ")[0]  # "pressure in p1"
    if question.column in units and (about in SLOTS or about.startswith("reference of")):
        return True
    if not open_zeros or not question.stops or question.about.startswith(("zero of", "unit of")):
        return False
    return question.about == "rest length" or question.column in open_zeros


def _sheets(reading: Reading) -> Iterator[Question]:
    titles = [title for title, _ in reading.table.rivals]
    if titles and reading.correction.sheet is None:
        shown = ", ".join(map(repr, titles[:6]))
        text = f"{len(titles)} tables hold readings, {shown}; which one is meant"
        yield Question("sheet", text, f'--sheet "{titles[0]}"', None, titles[0], tuple(titles))


def _units(reading: Reading) -> Iterator[Question]:
    """A unit that nobody says, and a stated one that no muscle can have."""
    for channel, i, use, column in reading.uses():
        if channel in ("command", "temperature") or use.unit == "clock":
            continue
        values = reading.rows.channels[channel]
        choice = reading.known.chosen.get(i)
        if choice is None and not any(e.facet == "channel" for e in reading.own(i)):
            continue  # see `_unnamed`
        if choice is not None and (choice.unit is not None or choice.assumed or choice.scale):
            continue
        raw = _back(values, use, channel)
        span = f"{np.min(raw):.4g} to {np.max(raw):.4g}"
        named = f"{reading.label(column)}"
        if not unit_is_stated(i, reading.evidence):
            if dimension_of(use.unit) == "ratio" and use.unit == "1" and channel == "contraction":
                continue
            found = proposal(channel, raw)
            if found.si_will_do and not (channel == "force" and _open_force(reading, found.choices)):
                continue
            choices = dict.fromkeys((use.unit, *found.choices[:4]))
            yield Question(
                f"unit of {channel}",
                f"{named} ({channel}) {_no_unit(column)}; its readings are {span}; they would be plausible "
                f"in {' or '.join(choices)}",
                option_of(channel, column, use.unit),
                column.head,
                use.unit,
                tuple(choices),
            )
        elif not is_plausible(channel, values) and not (channel in STROKES and reading.is_isometric):
            yield from _implausible(reading, channel, column, use, raw, values, named, span)


def _no_unit(column: Column) -> str:
    """That a head has no unit, or one in brackets that nobody knows."""
    bracket = _BRACKET.search(column.head)
    return f"has no unit: '{bracket[1]}' is not a known unit" if bracket else "has no unit"


def _implausible(
    reading: Reading, channel: str, column: Column, use: Use, raw: Array, values: Array, named: str, span: str
) -> Iterator[Question]:  # fmt: skip
    better = [unit for unit in proposal(channel, raw).choices if unit != use.unit]
    stops = channel != "pressure" or float(np.max(np.abs(values))) > _HARDLY or _forced(reading, values)
    if channel == "time":
        better = ["ms"] if is_plausible("time", raw * 1e-3) else []
        if not better or not _moves(reading):
            return
        what = f"{named} would mean {median_step(values) or 0.0:.3g} s between readings"
    else:
        what = f"{named} ({channel}) holds {span} {use.unit}, which is implausible for a muscle"
    hint = better[0] if better else use.unit
    yield Question(
        f"unit of {channel}",
        f"{what}. Is its unit {' or '.join([*better[:2], use.unit])}?",
        option_of(channel, column, hint),
        column.head,
        hint,
        (*better, use.unit),
        stops,
    )


def _back(values: Array, use: Use, channel: str) -> Array:
    """SI values as they stand in the file's unit."""
    si = CHANNEL_UNITS[channel]
    unit = WEIGHTS.get(use.unit, use.unit) if channel == "force" else use.unit
    zero, one = convert([0.0, 1.0], unit, si)
    return (values - zero) / (one - zero)


def _open_force(reading: Reading, choices: Sequence[str]) -> bool:
    """Whether a force without unit may be in several: N is sure only where the whole file is in SI."""
    others = [
        (c, u.unit) for c, (_, u) in reading.decision.uses.items() if c in ("pressure", *STROKES, "diameter")
    ]
    return len(choices) > 1 and any(unit != CHANNEL_UNITS[channel] for channel, unit in others)


def _forced(reading: Reading, pressure: Array) -> bool:
    """Whether the force is more than any muscle gives at such a pressure."""
    force = reading.rows.channels.get("force")
    return force is not None and bool(
        np.max(np.abs(force)) > _LARGEST_AREA * max(float(np.max(np.abs(pressure))), 1e-9)
    )


def _moves(reading: Reading) -> bool:
    """Whether a test of many minutes goes up and down all the way, as no slow drift and no creep does."""
    channels = reading.rows.channels
    pressure = channels.get("pressure")
    jumps = (
        pressure is not None
        and np.count_nonzero(np.abs(np.diff(pressure)) > _JUMP * float(np.ptp(pressure))) >= _JUMPS
    )
    if float(np.ptp(channels["time"])) < _LONG_TEST or jumps:
        return False
    for channel in ("pressure", *STROKES, "force"):
        values = channels.get(channel)
        if values is None or not np.ptp(values) > _SWING * float(np.max(np.abs(values))):
            continue
        if np.any(turning_points(values, threshold=0.5 * float(np.ptp(values)))):
            return True
    return False


def _unnamed(reading: Reading) -> Iterator[Question]:
    """A column that no word calls what it is read as."""
    for channel, i, use, column in reading.uses():
        if i in reading.known.chosen or channel not in ("pressure", "force", *STROKES, "time"):
            continue
        claims = reading.claims(i, channel)
        if not claims or (dimension_of(use.unit) == "mass" and all(e.rule == "unit" for e in claims)):
            yield Question(
                f"column '{bare(column)}'",
                f"nothing says what {reading.table.noun} '{column.title}' is; its readings behave like "
                f"{channel} in {use.unit}",
                f"{option_of(channel, column, use.unit)} or {ignore_option(bare(column))}",
                column.head or column.title,
                channel,
                (channel, "ignore"),
            )
        elif _is_by_unit(reading, channel, i):
            other = "length" if channel == "displacement" else "displacement"
            yield Question(
                f"column '{bare(column)}'",
                f"{reading.table.noun} '{column.title}' is read as "
                f"{channel}{', with its sign reversed,' if use.sign < 0 else ''} because "
                f"of its unit '{use.unit}' and its numbers; its name does not say so",
                f"{option_of(other, column)} or {ignore_option(bare(column))}",
                column.head,
                channel,
                (channel, other, "ignore"),
                # Two strokes cannot both be right, and a constant shows nothing.
                stops=len(set(STROKES) & set(reading.rows.channels)) > 1
                or bool(np.ptp(reading.rows.channels[channel]) == 0.0),
            )


def _headless(reading: Reading) -> Iterator[Question]:
    """A column of a file without heads that is read as nothing, where the others are guessed."""
    used = {i for i, _ in reading.decision.uses.values()} | set(reading.rows.labels.values())
    missing = next((c for c in ("pressure", "force", "displacement") if not reading.of_slot(SLOTS[c])), None)
    for i, column in enumerate(reading.table.columns):
        idle = i in used or i in reading.known.chosen or column.words is not None or reading.own(i)
        if (
            not reading.table.headless
            or idle
            or missing is None
            or not np.ptp(column.values[np.isfinite(column.values)])
        ):
            continue
        yield Question(
            f"column '{column.title}'",
            f"the file has no heads, and nothing says what {reading.label(column)} is; it holds "
            f"{np.nanmin(column.values):.4g} to {np.nanmax(column.values):.4g}",
            f"{option_of(missing, column, physics.LEFT_OUT[missing][0])} or {ignore_option(bare(column))}",
            column.head,
            choices=(missing, "ignore"),
        )


def _is_by_unit(reading: Reading, channel: str, i: int) -> bool:
    """Whether a stroke is told by nothing but its unit, or by the name of a sensor."""
    rules = {e.rule for e in reading.claims(i, channel)}
    return channel in STROKES and bool(rules) and rules <= {"unit", "position_of_a_sensor"}


def _unread(reading: Reading) -> Iterator[Question]:
    """A column in N, bar or mm, or called like a channel that nothing is read for, of which nothing says what
    it is.
    """
    used = {i for i, _ in reading.decision.uses.values()} | set(reading.rows.labels.values())
    filled = {SLOTS.get(c, c) for c in reading.rows.channels}
    conditions = {place for place, _ in reading.known.columns.values()}
    for i, column in enumerate(reading.table.columns):
        if (
            i in used
            or column.words is not None
            or i in reading.rows.dropped
            or i in conditions
            or reading.known.chosen.get(i, 0) is None
        ):
            continue
        if (choice := reading.known.chosen.get(i)) is not None:
            yield from _raw_signal(reading, i, {choice.channel}, filled)
            continue
        own = reading.own(i)
        roles = reading.roles(i)
        if any(roles.get(role, 0.0) >= 2.0 for role in (*FINAL, "remark", "running number")):
            continue
        unit = reading.unit(i)
        dimension = dimension_of(unit) if unit else ""
        claimed = {e.value for e in own if e.facet == "channel" and e.rule != "unit"}
        if roles.get("counter", 0.0) >= 3.0 and "stroke" not in filled:
            continue  # see `_counted`
        if dimension in RAW or roles.get("raw", 0.0) >= 3.0 or roles.get("counter", 0.0) >= 3.0:
            yield from _raw_signal(reading, i, claimed, filled)
            continue
        channel = _CARRIES.get(dimension) or (
            "force" if dimension == "mass" and "force" not in filled else None
        )
        if channel is None or (roles.get("set value", 0.0) >= 2.0 and SLOTS[channel] in filled):
            continue
        if claimed & set(SLOTS) and SLOTS[next(iter(claimed & set(SLOTS)))] in filled:
            continue  # another column is read for it: see `_seconds`
        if channel == "pressure" and "pressure" in filled and roles.get("at the valve", 0.0) > 0.0:
            continue  # it was measured elsewhere
        others = (channel,) if channel != "displacement" else ("displacement", "length", "diameter")
        why = " (it is a set value)" if roles.get("set value", 0.0) >= 2.0 else ""
        doubt = "; what is it"
        if channel == "displacement" and "stroke" not in filled:
            doubt = (
                "; no text states its zero or whether it grows as the muscle shortens: is it the position "
                "of the muscle's end, "
                "and how does it count"
            )
        yield Question(
            f"column '{bare(column)}'",
            f"{reading.label(column)} is in {unit} and is not read{why}{doubt}",
            f"{ignore_option(bare(column))} or {option_of(channel, column)}",
            column.head,
            choices=("ignore", *others),
        )


def _unreadable(reading: Reading) -> Iterator[Question]:
    """What is called like a quantity that nothing is read for, with its unit, and holds no numbers for it."""
    table = reading.table
    filled = {SLOTS.get(c, c) for c in reading.rows.channels}
    lost = [(name, name, "", why) for name, why in table.dropped]
    for i, column in enumerate(table.columns):
        if column.words is not None and reading.known.chosen.get(i, 0) is not None:
            row, word = next((r, w) for r, w in enumerate((*column.words, "-")) if kind_of(w) in (TEXT, MARK))
            place = f"row {int(table.lines[row])} holds" if row < len(table.lines) else "it holds"
            lost.append((bare(column), column.head, column.unit, f"{place} {word.strip()[:40]!r}, no number"))
    for name, head, unit, why in lost:
        stated = taken_apart(head, unit).unit
        claimed = {c.value for c in head_claims(head, unit) if c.facet == "channel"}
        wanted = claimed & {"pressure", "force", *STROKES} if stated is not None else set()
        channel = next((c for c in wanted if stated and stated.dimension in FITTING[c]), None)
        if channel is None or SLOTS[channel] in filled or name in reading.correction.columns:
            continue
        yield Question(
            f"column '{name}'",
            f"{table.noun} '{head}' is called like the {channel} and is not read: {why}; put it right, or "
            "read the file without it",
            f'--ignore "{name}"',
            head,
        )


def _raw_signal(reading: Reading, i: int, claimed: set[str], filled: set[str]) -> Iterator[Question]:
    """A signal without a scale where the channel that it is called like is missing."""
    column, unit = reading.table.columns[i], reading.unit(i)
    wanted = next((c for c in SCALABLE if c in claimed and SLOTS[c] not in filled), None)
    if (
        reading.correction.columns
        and wanted is None
        and column.key in {str(k) for k in reading.correction.columns}
    ):
        return
    missing = [c for c in ("pressure", "force", "displacement") if SLOTS[c] not in filled]
    if wanted is None and (claimed or unit is None or not {"pressure", "displacement"} & set(missing)):
        return
    several = next((e.value for e in reading.own(i) if e.facet == "several scales"), "")
    among = (wanted,) if wanted is not None else tuple(missing)
    yield scale_question(reading.label(column), column, among, unit, several)


def scale_question(
    label: str, column: Column, among: tuple[str, ...], unit: str | None, several: str = ""
) -> Question:
    """What scale a signal has, and which of the channels it is; the first stands in the example."""
    wanted = among[0]
    *others, last = among
    channels = f"{', '.join(others)} or {last}" if others else last
    scale = f"{_RAW_SPANS.get(unit or 'count', '0 to 10 V')} = {_SCALED[wanted]}"
    return Question(
        f"scale of {wanted}",
        f"{label} is a signal in {unit or 'counts'}, and "
        f"{f'texts state several scales, {several}' if several else 'no text states its scale'}: "
        f"which {channels} is which reading",
        f"{option_of(wanted, column, scale)} or {ignore_option(bare(column))}",
        column.head,
        None,
        ("ignore", *among),
        stops=wanted != "command",
    )


def _scales(reading: Reading) -> Iterator[Question]:
    """A scale that the file states with two values."""
    for channel, i, use, column in reading.uses():
        stated = [e for e in reading.own(i) if e.facet == "scale" and e.value.unit == use.unit]
        best = max((e.weight for e in stated), default=0.0)
        values = {(round(e.value.factor, 9), round(e.value.offset, 6)): e for e in stated if e.weight == best}
        if len(values) < 2 or reading.by_user(channel):
            continue
        two = list(values.values())[:2]
        first, second = (f"'{e.value.text[:60]}' ({e.span.where})" for e in two)
        yield Question(
            f"scale of {channel}",
            f"the file states two scales for {reading.label(column)}, {first} and {second}; "
            "which one is right",
            " or ".join(option_of(channel, column, _spelled(e.value, column, reading.unit(i))) for e in two),
            column.head,
        )


def _spelled(scale: Scale, column: Column, unit: str | None) -> str:
    """A scale as a user writes it: "205 to 1024 counts = 0 to 5 bar"."""
    ends = (float(np.nanmin(column.values)), float(np.nanmax(column.values)))
    low, high = (scale.factor * (end - scale.offset) for end in ends)
    raw = "counts" if unit in (None, "count") else unit
    return f"{ends[0]:.6g} to {ends[1]:.6g} {raw} = {low:.6g} to {high:.6g} {scale.unit}"


def _seconds(reading: Reading) -> Iterator[Question]:
    """Two columns for one channel that are about as likely and show different values."""
    for slot in ("pressure", "force", "stroke") if not reading.table.headless else ():
        channel = reading.of_slot(slot)
        if channel is None or reading.by_user(channel):
            continue
        i, use = reading.decision.uses[channel]
        mine = next((o for o in reading.decision.options[slot] if o.column == i), None)
        used = {u[0] for u in reading.decision.uses.values()}
        rivals: dict[int, Option] = {}
        for option in reading.decision.options[slot]:
            if (
                option.column not in used
                and option.use.channel == channel
                and mine is not None
                and option.score > mine.score - MARGIN
            ):
                rivals.setdefault(option.column, option)
        for option in rivals.values():
            if option.column in reading.known.chosen or _aside(reading, option.column) != _aside(reading, i):
                continue
            if _same_values(reading, channel, use, option):
                continue
            first, second = reading.table.columns[i], reading.table.columns[option.column]
            joint = _joint(reading, i, option.column) if slot == "pressure" else ""
            alike = first.head == second.head and first.place >= 0
            if not alike and len(reading.rows.lines) < ENOUGH:
                continue  # so few rows show no difference between them
            mine_said = column_option(channel, f"column {first.place + 1}" if alike else bare(first))
            yield Question(
                f"second {channel}",
                f"{reading.table.noun}s '{first.title}' and '{second.title}' are both {channel} and differ"
                f"{joint}; which one acts on the muscle",
                f"{mine_said} or {option_of(channel, second)}",
                second.title,
                first.title,
                (first.title, second.title),
            )


_SIGN_CLAUSES = frozenset(rule.id for rule in rules("clause"))


def _times(reading: Reading) -> Iterator[Question]:
    """Columns of times that are called alike and differ: a row holds readings of different times."""
    column, time = reading.column("time"), reading.rows.channels.get("time")
    if column is None or time is None or reading.by_user("time"):
        return
    i = reading.decision.uses["time"][0]
    for j, other in enumerate(reading.table.columns):
        alike = taken_apart(other.head).name == taken_apart(column.head).name and other.unit == column.unit
        if j == i or j in reading.known.chosen or not alike:
            continue
        a, b = column.values, other.values
        both = np.isfinite(a) & np.isfinite(b)
        if both.any() and np.max(np.abs((a - b)[both])) > _SAME * max(float(np.ptp(a[both])), 1e-12):
            yield Question(
                f"second time in {other.title}",
                f"{reading.table.noun}s '{column.title}' and '{other.title}' differ: they are times of "
                f"different signals, and the readings of a row belong to different times; which one holds",
                f"{column_option('time', column.title)} or {column_option('time', other.title)}",
                other.title,
                column.title,
                (column.title, other.title),
            )
            return


def _aside(reading: Reading, i: int) -> bool:
    roles = reading.roles(i)
    return roles.get("set value", 0.0) >= 2.0


def _same_values(reading: Reading, channel: str, use: Use, other: Option) -> bool:
    ambient = reading.known.facts(reading.table).ambient
    a = value_of(reading.table.columns[reading.decision.uses[channel][0]].values, use, ambient)
    b = value_of(reading.table.columns[other.column].values, other.use, ambient)
    both = np.isfinite(a) & np.isfinite(b)
    if not both.any():
        return True
    return float(np.max(np.abs(a[both] - b[both]))) <= _SAME * max(float(np.ptp(a[both])), 1e-12)


def _joint(reading: Reading, i: int, j: int) -> str:
    """What two pressures that run against each other are."""
    a, b = reading.table.columns[i].values, reading.table.columns[j].values
    both = np.isfinite(a) & np.isfinite(b)
    if (
        both.sum() > 3
        and np.ptp(a[both]) > 0
        and np.ptp(b[both]) > 0
        and np.corrcoef(a[both], b[both])[0, 1] < _OPPOSED
    ):
        return (
            ", one filled as the other is vented, as those of a joint of two muscles: its force is that of "
            "both; measure with one of them vented, or model the pair as 'antagonist'"
        )
    return ""


def antagonists(reading: Reading) -> list[str]:
    """The pressures that run against the one that the user took."""
    if "pressure" not in reading.rows.channels or not reading.by_user("pressure"):
        return []
    i = reading.decision.uses["pressure"][0]
    counter = [use[0] for channel, use in reading.decision.uses.items() if channel == "counter_pressure"]
    others = [
        j
        for j, c in enumerate(reading.table.columns)
        if j != i and c.words is None and reading.claims(j, "pressure") and j not in counter
    ]
    return [reading.table.columns[j].title for j in others if _joint(reading, i, j)]


def _signs(reading: Reading) -> Iterator[Question]:
    """A sign that no word says: the readings decided, or do not show it."""
    for channel in ("force", "displacement", "contraction"):
        column = reading.column(channel)
        if column is None or reading.by_user(channel) or (channel != "force" and reading.is_isometric):
            continue
        i, use = reading.decision.uses[channel]
        facet = "sign_force" if channel == "force" else "sign_stroke"
        about = [e for e in reading.evidence if e.facet == facet and e.target in (i, FILE)]
        said = [e for e in about if e.value == use.sign]
        against = [e for e in about if e.value != use.sign and e.rule in _SIGN_CLAUSES]
        shown = channel == "force" or any(t in MOTION and v > -_AGAINST for t, v in reading.decision.terms)
        rival = next(
            (r for r in reading.decision.rivals if r.slot == SLOTS[channel] and r.part == "sign"), None
        )
        close = rival is not None and rival.margin < MARGIN
        doubt = close or (use.sign == -1 and not said and bool(against or not shown))
        if not doubt and (use.sign == 1 or said or _is_by_unit(reading, channel, i)):
            continue
        what = {
            "force": "a pulling force is positive here",
            "displacement": "shortening is positive here",
            "contraction": "shortening is positive here",
        }[channel]
        other = option_of(channel, column, sign=-use.sign)
        text = (
            f"{reading.label(column)} is read with its sign reversed: {what}, and its readings "
            f"run the other way{'' if shown else ', though they hardly show it'}"
            if use.sign == -1
            else f"{reading.label(column)}: {what}, but its readings hardly show which way they count"
        )
        text += "".join(f"; '{e.span.text[:60]}' ({e.span.where}) says otherwise" for e in against[:1])
        yield Question(f"sign of {channel}",
        text, f"{option_of(channel, column, sign=use.sign)} or {other}", column.head,
                       REVERSE if use.sign == -1 else KEEP, (REVERSE, KEEP), stops=doubt)  # fmt: skip


def _reference(reading: Reading) -> Iterator[Question]:
    """A pressure that may count from vacuum though no word says so."""
    column = reading.column("pressure")
    if column is None or reading.by_user("pressure"):
        return
    i, use = reading.decision.uses["pressure"]
    if (
        any(e.facet == "absolute" and e.target in (i, FILE) for e in reading.evidence)
        or "pressure" in reading.known.conditions
    ):
        return
    pressure = reading.rows.channels["pressure"]
    lowest = float(np.min(pressure)) + (physics.ATMOSPHERE if use.absolute else 0.0)
    at_rest = pressure <= float(np.min(pressure)) + 0.03e5
    shows = _REST_BAND[0] <= lowest <= _REST_BAND[1] and np.ptp(pressure) >= 0.2e5 and _idle(reading, at_rest)
    rival = next((r for r in reading.decision.rivals if r.slot == "pressure" and r.part == "reference"), None)
    both = next((e.span for e in reading.evidence if e.facet == "either_reference"), None)
    if not use.absolute and not shows and not both and not (rival is not None and rival.margin < MARGIN):
        return
    told = f"shows {lowest / 1e5:.2f} bar at its lowest"
    told += f", and '{both.text[:80]}' ({both.where}) names both" if both else ""
    absolute, gauge = (option_of("pressure", column, f"{use.unit}({mark})") for mark in ("a", "g"))
    yield Question(
        "reference of pressure",
        f"{reading.label(column)} {told}; is it absolute or gauge pressure",
        f"{absolute} or {gauge}",
        column.head,
        "absolute",
        ("absolute", "gauge"),
    )


def _idle(reading: Reading, at_rest: np.ndarray) -> bool:
    """Whether the muscle neither pulls nor moves in these rows."""
    channels = reading.rows.channels
    force = channels.get("force")
    if force is not None and np.ptp(force) > 0.05 * np.max(np.abs(force)):
        shown = force[at_rest][force[at_rest] != 0.0]  # an exact 0 is a slack muscle or a clipped table
        if not len(shown) or np.max(np.abs(shown)) > 0.05 * np.max(np.abs(force)):
            return False
        shortened = _shortened(channels)
        return shortened is None or bool(np.min(shortened[at_rest]) <= 0.1 * np.max(shortened))
    for channel in ("displacement", "contraction"):
        stroke = channels.get(channel)
        if stroke is not None and np.ptp(stroke) > 0.0:
            return bool(np.max(np.abs(stroke[at_rest])) <= 0.05 * np.max(np.abs(stroke)))
    return False


def _shortened(channels: dict[str, Array]) -> Array | None:
    for channel in STROKES:
        stroke = channels.get(channel)
        if stroke is not None and np.ptp(stroke) > 0.005 * np.max(np.abs(stroke)):
            return np.max(stroke) - stroke if channel == "length" else stroke - np.min(stroke)
    return None


def _tare(reading: Reading) -> Iterator[Question]:
    """A force at rest, without pressure and stroke: the sensor was not set to zero."""
    channels = reading.rows.channels
    force, pressure, stroke = (channels.get(c) for c in ("force", "pressure", "displacement"))
    column = reading.column("force")
    if force is None or pressure is None or stroke is None or column is None or np.ptp(force) == 0.0:
        return
    if "force_zero" in reading.known.conditions or weights_of_runs(channels) is not None:
        return
    rows = (np.abs(pressure) < 0.03e5) & (np.abs(stroke) < 0.01 * max(float(np.max(np.abs(stroke))), 1e-9))
    if np.count_nonzero(rows) < ENOUGH:
        return
    offset = float(np.median(force[rows]))
    if abs(offset) < 0.02 * float(np.max(np.abs(force))):
        return
    yield Question(
        "zero of force",
        f"{reading.label(column)} shows {offset:.3g} N at rest, without pressure and stroke; "
        f"it is not subtracted; is it "
        "an offset of the sensor",
        f'--experiment "force_zero={offset:.3g} N"',
        column.head,
        f"{offset:.3g} N",
        (),
        stops=False,
    )


def _bridge(reading: Reading) -> Iterator[Question]:
    """A load cell is read by its sensitivity alone, and no reading shows its zero; a force that comes down to
    nothing shows it: a muscle does not push.
    """
    column, force = reading.column("force"), reading.rows.channels.get("force")
    if column is None or force is None or reading.by_user("force") or not len(force):
        return
    unknown = any(
        e.facet == "scale" and e.rule == NO_ZERO for e in reading.own(reading.decision.uses["force"][0])
    )
    smallest = float(np.min(np.abs(force)))
    if not unknown or "force_zero" in reading.known.conditions or smallest <= 0.01 * np.max(np.abs(force)):
        return
    yield Question(
        "zero of force",
        f"{reading.label(column)} is read by the sensitivity of its load cell, and neither the "
        f"file nor a reading (all are at least {smallest:.4g} N) states what it shows at zero force",
        '--experiment "force_zero=0 N"',
        column.head,
    )


def _contradicted(reading: Reading) -> Iterator[Question]:
    """Readings that no muscle shows as they are read."""
    for channel, terms in reading.decision.against.items():
        column = reading.column(channel)
        if column is None or reading.by_user(channel) or channel == "time":
            continue
        if channel in ("displacement", "length") and "rest length" in terms[0][0]:
            continue  # see `_rest_length`
        text = f"is read as {channel} in {reading.use(channel).unit}, but {terms[0][0]}; what is it"
        yield taken_or_not(reading, channel, column, text, f"{channel} in {column.title}")


def _close(reading: Reading) -> Iterator[Question]:
    """Another answer for what a column is that is nearly as likely."""
    for rival in reading.decision.rivals:
        channel = reading.of_slot(rival.slot)
        if channel is None or rival.margin >= MARGIN or reading.by_user(channel) or rival.part != "channel":
            continue
        column, use = reading.table.columns[reading.decision.uses[channel][0]], reading.use(channel)
        other = rival.other
        if other is None:
            continue
        yield Question(
            f"channel of {column.title}",
            f"{reading.label(column)} is read as {channel} in {use.unit}, but could as well be "
            f"{other.use.channel} in {other.use.unit}",
            f"{option_of(channel, column, use.unit)} or "
            f"{option_of(other.use.channel, column, other.use.unit)}",
            column.head,
            channel,
            (channel, other.use.channel),
        )


def _runs_against(reading: Reading) -> Iterator[Question]:
    """A stroke that runs against physics as it is read, and no word says its sign."""
    if reading.by_user("force") or reading.by_user("pressure"):
        return  # what the motion is judged by is the user's word
    for channel in ("displacement", "contraction"):
        column = reading.column(channel)
        if column is None or reading.by_user(channel):
            continue
        i, _ = reading.decision.uses[channel]
        worst = min((v for t, v in reading.decision.terms if t in MOTION), default=0.0)
        if worst > _AGAINST or any(
            e.facet == "sign_stroke" and e.target in (i, FILE) for e in reading.evidence
        ):
            continue
        rest = reading.known.conditions.get("nominal_length")
        stroke = reading.rows.channels[channel]
        if channel == "displacement" and isinstance(rest, float):
            yield _lengthens(reading, column, rest)
        else:
            as_length = f" or {option_of('length', column)}" if float(np.min(stroke)) > 0.0 else ""
            yield Question(
                f"sign of {channel}",
                f"{reading.label(column)} grows as the muscle lengthens, but shortening is "
                f"positive here; reverse its sign",
                f"{option_of(channel, column, sign=-1)}{as_length}",
                column.head,
                REVERSE,
                (REVERSE, KEEP),
            )


def _lengthens(reading: Reading, column: Column, rest: float) -> Question:
    """A position that grows as the muscle lengthens, and shows 0 where it is not at its rest length [m]."""
    use, stroke = reading.use("displacement"), np.abs(reading.rows.channels["displacement"])
    low, high = float(np.min(stroke)), float(np.max(stroke))
    low = low if low > 0.5 * high else 0.0  # a position of the machine, which never comes near its 0
    first, reach, whole = (float(v) for v in convert([low, high, rest], "m", use.unit))
    shortest, unit = whole - reach + first, use.unit
    if use.scale != 1.0 or use.offset:  # the answer is about the signal
        first, reach = (v / abs(use.scale) + use.offset for v in (first, reach))
        unit = reading.unit(reading.decision.uses["displacement"][0]) or "counts"
    span = f"{first:.6g} to {reach:.6g} {unit} = {shortest:.4g} to {whole:.4g} {use.unit}"
    return Question(
        "zero of displacement",
        f"{reading.label(column)} grows as the muscle lengthens, up to {reach:.6g} {unit}: a "
        f"muscle of {whole:.4g} {use.unit} is not at its rest length where it shows 0; which length has it "
        f"{'there' if not low else f'at {first:.6g} {unit}'} and at the end",
        option_of("length", column, span),
        column.head,
    )


MOTION = ("the force falls as it contracts", "it contracts as the pressure rises")
_AGAINST = -1.5  # nats of what a motion shows, below which it runs against physics


def _zero(reading: Reading) -> Iterator[Question]:
    """A position of which nothing says where the muscle is at its rest length."""
    yield from _zero_of_length(reading)
    column = reading.column("displacement")
    if column is None or reading.by_user("displacement"):
        return
    shown = [value for text, value in reading.decision.terms if text in MOTION]
    if (
        _PLAIN_STROKE.fullmatch(column.head)
        and reading.use("displacement").sign == 1
        and min(shown, default=0.0) > _AGAINST
    ):
        return
    i, use = reading.decision.uses["displacement"]
    about = [e for e in reading.evidence if e.target in (i, FILE)]
    turned = use.sign == -1 and float(np.median(reading.rows.channels["displacement"])) < 0.0
    if turned and "nominal_length" in reading.known.conditions:
        pass
    elif (
        not any(e.facet == "zero_open" and e.target == i for e in about)
        or use.zero
        or any(e.facet in ("zero_known", "sign_stroke") for e in about)
    ):
        return
    stroke = reading.rows.channels["displacement"]
    rest = reading.known.conditions.get("nominal_length")
    if use.sign == -1 and float(np.median(stroke)) < 0.0 and isinstance(rest, float):
        yield _lengthens(reading, column, rest)
        return
    if float(np.min(np.abs(stroke))) <= 0.02 * float(np.max(np.abs(stroke))):
        return
    yield Question(
        "zero of displacement",
        f"{reading.label(column)} is a position; at which reading is the muscle at its rest length",
        f"{option_of('displacement', column)} or {option_of('length', column)}",
        column.head,
        None,
        ("displacement", "length"),
    )


def _zero_of_length(reading: Reading) -> Iterator[Question]:
    """A position that could be the length, or a stroke from a zero that nothing says."""
    column = reading.column("length")
    if column is None or reading.by_user("length"):
        return
    i, use = reading.decision.uses["length"]
    rivals = [r for r in reading.decision.rivals if r.slot == "stroke" and r.part == "channel"]
    other = rivals[0].other if rivals else None
    if other is None or not _is_by_unit(reading, "length", i) or not reading.facet(i, "zero_open"):
        return
    if rivals[0].margin < MARGIN or "length" in reading.decision.against:
        low, high = float(np.nanmin(column.values)), float(np.nanmax(column.values))
        ends = f"{high - low:.6g} to 0" if other.use.sign < 0 else f"0 to {high - low:.6g}"
        span = f"{low:.6g} to {high:.6g} {use.unit} = {ends} {use.unit}"
        yield Question(
            "zero of length",
            f"{reading.label(column)} is a position, and no text states one zero of it; at which "
            f"reading is the muscle at its rest length",
            f"{option_of('displacement', column, span)} or {option_of('length', column)}",
            column.head,
            None,
            ("displacement", "length"),
        )


def _by_valve(reading: Reading) -> Iterator[Question]:
    """The only pressure is named after the valve, and nothing says that it was measured."""
    column = reading.column("pressure")
    if column is None or though_at_the_valve(reading) != "":
        return
    text = (
        "is the only pressure and named after the valve or the supply; no text says that it was measured at "
        "the muscle; take it"
    )
    yield taken_or_not(reading, "pressure", column, text)


def though_at_the_valve(reading: Reading) -> str | None:
    """Why a pressure that is named after the valve is the measured one; "" = nothing says so, None = it is
    not named so, or the user took it.
    """
    column = reading.column("pressure")
    if column is None or reading.by_user("pressure"):
        return None
    i = reading.decision.uses["pressure"][0]
    if reading.roles(i).get("at the valve", 0.0) <= 0.0 or reading.use("pressure").scale != 1.0:
        return None
    for text in reading.table.texts:
        if word_set("measured").among(words_of(text.text)) and _of_pressure(text.text):
            return f"{text.where} says '{text.text[:60]}'"
    if reading.roles(i).get("measured", 0.0) > 0.0:
        return "its name says that it was measured"
    commands = [
        reading.table.columns[e.target].title
        for e in reading.evidence
        if e.facet == "channel" and e.value == "command" and e.target not in (i, FILE)
    ]
    if commands and len(np.unique(column.values)) >= _FEW_LEVELS * len(column.values):
        return f"the command is '{commands[0]}'"
    others = [reading.rows.channels[c] for c in ("force", *STROKES) if c in reading.rows.channels]
    return "its readings scatter as those of a sensor" if is_sensed(column.values, others) else ""


_FEW_LEVELS = 0.2  # different values by row, below which a series is that of a set value


def _of_pressure(text: str) -> bool:
    return word_set("@pressure").among(words_of(text))


def _counted(reading: Reading) -> Iterator[Question]:
    """Counts of an encoder, or angles, where the file has no other stroke."""
    channels = reading.rows.channels
    if set(channels) & {*STROKES, "diameter"}:
        return
    if "torque" in channels:  # the angle is that of a joint
        return
    used = {i for channel, (i, _) in reading.decision.uses.items() if channel != "angle"}
    for i, column in enumerate(reading.table.columns):
        unit = reading.unit(i)
        angle = unit is not None and dimension_of(unit) == "angle"
        counter = reading.roles(i).get("counter", 0.0) >= 3.0
        if i in used or i in reading.known.chosen or column.words is not None or not (angle or counter):
            continue
        low, high = float(np.nanmin(column.values)), float(np.nanmax(column.values))
        what = (
            f"an angle, {low:.4g} to {high:.4g} {unit}"
            if angle
            else f"counts of an encoder, {low:.6g} to {high:.6g}"
        )
        span = f"{low:.6g} to {high:.6g} {unit if angle else 'counts'} = 0 to 60 mm"
        open_ = "how it counts" if angle else "the counts per mm, nor at which of them the stroke is 0"
        yield Question(
            "stroke",
            f"{reading.label(column)} holds {what}, and the file has no other stroke; no text states {open_}",
            f"{option_of('displacement', column, span)} or {ignore_option(bare(column))}",
            column.head,
            None,
            ("displacement", "ignore"),
        )
        return


def _torque(reading: Reading) -> Iterator[Question]:
    """A torque, where the file has no force, and no angle that makes it one of a joint."""
    if "angle" in reading.rows.channels:
        return
    for i, column in enumerate(reading.table.columns):
        unit = reading.unit(i)
        if unit is None or dimension_of(unit) != "torque" or {"force"} & set(reading.rows.channels):
            continue
        if column.words is None and i not in reading.known.chosen:
            torque = 3.0 / quantity_si(1.0, unit, "N*m")  # on a radius of 30 mm
            span = f"0 to {torque:.4g} {unit.replace('*', '')} = 0 to 100 N"
            yield Question(
                "force",
                f"{reading.label(column)} holds a torque, and the file has no force, which is the torque "
                f"over the radius at which the muscle pulls; which radius is it (here 30 mm)",
                f"{option_of('force', column, span)} or {ignore_option(bare(column))}",
                column.head,
                None,
                ("force", "ignore"),
            )


def _cycles(reading: Reading) -> Iterator[Question]:
    """Cycles that count on in each row of a test without time: of the controller, of unknown length."""
    channels = reading.rows.channels
    moving = [c for c in ("pressure", "force", *STROKES) if c in channels and _sweeps(channels[c])]
    for i, column in enumerate(reading.table.columns if len(moving) > 1 else ()):
        named = any(e.facet == "channel" and e.value == "group" for e in reading.own(i))
        if "time" in channels or i in reading.known.chosen or not named or not counts_rows(column.values):
            continue
        yield Question(
            "unit of time",
            f"{reading.label(column)} counts on in each row, and no text states how long one is; the "
            "test has no other time",
            f"{option_of('time', column, '1 count = 10 ms')} or {ignore_option(bare(column))}",
            column.head,
            None,
            ("time", "ignore"),
        )
        return


def _sweeps(values: Array) -> bool:
    return bool(np.ptp(values) > _SWING * np.max(np.abs(values)))


def _stated_zeros(reading: Reading) -> Iterator[Question]:
    """A reading at true zero that a text states without saying whether the readings contain it, or twice."""
    applied = {e.facet for e in reading.evidence if e.facet.startswith("zero:")}
    for zero in stated_zeros(reading.table):
        channel, column = zero.channel, reading.column(zero.channel)
        if (
            zero.contained is False
            or f"zero:{channel}" in applied
            or (channel in STROKES and reading.by_user(channel))
        ):
            continue
        option = f'--experiment "{channel}_zero={zero.value:.6g} {CHANNEL_UNITS[channel]}"'
        if channel in STROKES and column is not None:
            option = _from_zero(reading, channel, column, zero.value)
        what = f"a {'tare' if channel == 'force' else 'zero'} of the {channel}"
        what += " without a unit" if zero.bare else ""
        yield from _contained(reading, channel, what, zero.span, option)


def _hangers(reading: Reading) -> Iterator[Question]:
    """The weight of a hanger, where the force is a mass that may or may not contain it."""
    if "force" not in reading.decision.uses or (
        dimension_of(reading.use("force").unit) != "mass" and not reading.by_user("force")
    ):
        return
    for hanger in stated_hangers(reading.table):
        if not hanger.contained and not reading.use("force").zero:
            option = f'--experiment "force_zero={-hanger.weight:.6g} N" or --experiment "force_zero=0 N"'
            yield from _contained(reading, "force", "the weight of a hanger", hanger.span, option)


def _contained(reading: Reading, channel: str, what: str, span: Span, option: str) -> Iterator[Question]:
    """Whether the readings of a channel contain what a text states, unless the user says so."""
    if (
        channel not in reading.rows.channels
        or f"{channel}_zero" in reading.known.conditions
        or (channel == "force" and "load_mass" in reading.correction.conditions)
    ):
        return
    column = reading.column(channel)
    of_column = f" of '{column.head}'" if column else ""
    pull = "without pull" if channel == "force" else "there"
    yield Question(
        f"zero of {channel}",
        f"the file states {what}, '{span.text[:60]}' ({span.where}), but it is not clear whether the "
        f"readings{of_column} contain it; what do they show {pull}",
        option,
        None if column is None else column.head,
    )


def _from_zero(reading: Reading, channel: str, column: Column, zero: float) -> str:
    """The option that reads a stroke less its zero [m]."""
    unit, values = reading.use(channel).unit, reading.rows.channels[channel]
    ends = convert([float(np.min(values)), float(np.max(values)), zero], "m", unit)
    low, high, less = (float(v) for v in ends)
    return option_of(
        channel, column, f"{low:.6g} to {high:.6g} {unit} = {low - less:.6g} to {high - less:.6g} {unit}"
    )


def _air(reading: Reading) -> Iterator[Question]:
    """A pressure of the surrounding air that cannot be, or is stated twice, where an absolute pressure needs
    it.
    """
    column = reading.column("pressure")
    if (
        column is None
        or not reading.use("pressure").absolute
        or "pressure_zero" in reading.known.conditions
        or reading.known.air is not None
    ):
        return
    said = reading.known.conditions.get("ambient_pressure")
    stated = {}
    for e in reading.evidence:
        if e.facet == "condition:ambient_pressure" and isinstance(e.value, Quantity):
            stated[round(quantity_si(e.value.value, e.value.unit.name, "Pa"), -2)] = e.value.text
    if not isinstance(said, float) or (len(stated) < 2 and 5e4 <= said <= 1.1e5):
        return
    twice = f"is stated as {' and as '.join(list(stated.values())[:3])}, which one is right"
    what = twice if len(stated) > 1 else f"is read as {said:.6g} Pa, which is impossible; what was it"
    yield Question(
        "pressure of the surrounding air",
        f"column '{column.head}' is absolute, and the pressure of the surrounding air {what}",
        "keep one value in the file, or state how much it exceeded 1013.25 hPa: --experiment "
        '"pressure_zero=-6 hPa"',
        column.head,
    )


def _set_point(reading: Reading) -> Iterator[Question]:
    """The only pressure is the set value of a regulator."""
    for channel in ("pressure", "force"):
        column = reading.column(channel)
        if column is None or reading.by_user(channel):
            continue
        i = reading.decision.uses[channel][0]
        roles = reading.roles(i)
        if roles.get("set value", 0.0) >= 2.0 and not roles.get("measured"):
            text = f"is a set value, and no measured {channel} is there; take it"
            yield taken_or_not(reading, channel, column, text)


def _specimens(reading: Reading) -> Iterator[Question]:
    names = reading.rows.samples
    running = names and all(n.isdecimal() for n in names) and 2 * len(names) > len(reading.rows.lines)
    if len(names) < 2 or running:
        return
    column = reading.table.columns[reading.rows.labels["sample"]]
    yield Question(
        "specimens",
        f"{reading.label(column)} names {len(names)} specimens, "
        f"{', '.join(map(repr, names[:4]))}; their readings belong to "
        "different muscles; split the file, or read all as one muscle",
        ignore_option(bare(column)),
        column.head,
        None,
        names[:8],
    )


def _rest_length(reading: Reading) -> Iterator[Question]:
    """A rest length that is missing, or with which no reading is possible."""
    channels, rest = reading.rows.channels, reading.known.conditions.get("nominal_length")
    strokes = [c for c in STROKES if c in channels]
    if "nominal_length" not in reading.known.conditions and (
        strokes == ["displacement"] or (strokes == ["length"] and not _shows_rest(channels))
    ):
        alone = (
            "a stroke alone"
            if "displacement" in strokes
            else "no reading is without pressure and pull: a length"
        )
        yield Question(
            "rest length",
            f"the file states no rest length (L0) of the muscle; {alone} gives no contraction",
            '--rest-length "300 mm"',
            stops=False,
        )
        return
    if "nominal_length" in reading.correction.conditions or not isinstance(rest, float) or rest <= 0.0:
        return
    shown = _beyond(channels, rest)
    if shown:
        said = reading.known.stated["nominal_length"]
        option = '--rest-length "300 mm"' + (
            ' or --column "length=NAME [0 to 72 mm = 228 to 300 mm]"' if "stretch" in shown else ""
        )
        yield Question(
            "rest length",
            f"the rest length is read as {said.text or rest} ({said.where.where}), {shown}, which is "
            f"impossible for it; "
            f"{'where is the stroke 0, or ' if 'stretch' in shown else ''}which rest length is right",
            option,
        )


def _shows_rest(channels: dict[str, Array]) -> bool:
    """Whether the lengths show that at rest: measured without pressure and pull, or a whole number of
    millimetres at which the test began.
    """
    longest = 1e3 * float(np.max(channels["length"]))
    if abs(longest - round(longest)) < _WHOLE:
        return True
    small = [
        np.abs(channels[c]) <= _NOTHING * float(np.max(np.abs(channels[c])))
        for c in ("pressure", "force")
        if c in channels
    ]
    return len(small) < 2 or bool(np.any(np.all(small, axis=0)))


def _beyond(channels: dict[str, Array], rest: float) -> str:
    """What of the readings no muscle of a rest length [m] shows; "" = they are possible."""
    length, stroke = channels.get("length"), channels.get("displacement")
    if length is not None and len(length):
        low, high = float(np.min(length)), float(np.max(length))
        most = float(np.quantile(length, 1.0 - _FEW))
        if most > (1.0 + _STRETCHED) * rest or high < _SHORTEST * rest:
            return f"the lengths measured are {low * 1e3:.4g} to {high * 1e3:.4g} mm"
    elif stroke is not None and len(stroke):
        low, high = float(np.min(stroke)), float(np.max(stroke))
        if float(np.median(np.abs(stroke))) > (1.0 - _SHORTEST) * rest:
            return f"the strokes measured are {low * 1e3:.4g} to {high * 1e3:.4g} mm"
        if float(np.quantile(stroke, _FEW)) < -_STRETCHED * rest:
            share = -100.0 * low / rest
            return (
                f"the strokes measured would stretch the muscle by up to {-low * 1e3:.4g} mm beyond its "
                f"rest length ({share:.0f} %)"
            )
    return ""


def _counts_rows(reading: Reading) -> Iterator[Question]:
    """A counter beside many rows without time: a logger takes them evenly."""
    if "time" in reading.rows.channels or len(reading.rows.lines) < _BY_LOGGER:
        return
    used = {i for i, _ in reading.decision.uses.values()} | set(reading.known.chosen)
    for i, column in enumerate(reading.table.columns):
        if i in used or column.words is not None or not np.all(np.diff(column.values) == 1.0):
            continue
        yield Question(
            "time",
            f"{reading.label(column)} counts the rows, and no time is read: creep, speed and lags cannot be "
            f"found; if the rows were taken at an even rate, e.g. every 2 s, it is the time",
            option_of("time", column, "0 to 1 counts = 0 to 2 s"),
            column.title,
            stops=False,
        )
        return


_BY_LOGGER = 200  # rows that nobody writes down by hand


def _of_columns(reading: Reading) -> Iterator[Question]:
    """A condition of which a column holds several values."""
    for key, (i, values) in reading.known.columns.items():
        needed = key == "nominal_length" or (key == "load_mass" and "force" not in reading.rows.channels)
        if (
            len(values) < 2
            or not needed
            or key in reading.correction.conditions
            or (key == "load_mass" and "load_force" in reading.correction.conditions)
        ):
            continue
        column = reading.table.columns[i]
        what, option = {"nominal_length": ("rest length", "--rest-length"), "load_mass": ("load", "--load")}[
            key
        ]
        si = "kg" if key == "load_mass" else "m"
        unit = reading.unit(i) or si
        own = [f"{v:.6g} {unit}" for v in np.atleast_1d(convert(list(values[:4]), si, unit))]
        shown = ", ".join(own)
        yield Question(
            what,
            f"{reading.label(column)} holds {len(values)} values, {shown}, but a measurement "
            f"has one {what}; split the file by it, "
            "or state which one holds for all rows",
            f'{option} "{own[0]}"' + (f" or {option_of('force', column)}" if key == "load_mass" else ""),
            column.head,
        )


def _unknown_unit(reading: Reading) -> Iterator[Question]:
    """A head with a word in brackets that is no unit, or with a unit of something else than its name says."""
    for i, column in enumerate(reading.table.columns):
        if i in reading.known.chosen or column.words is not None or column.clock:
            continue
        own = reading.own(i)
        claimed = [
            e.value
            for e in own
            if e.facet == "channel" and e.rule not in ("unit", "letter") and e.weight >= 2.5
        ]
        claimed = [c for c in claimed if c in ("pressure", "force", "length", "time", "displacement")]
        stated = reading.unit(i)
        used = next((c for c, (j, _) in reading.decision.uses.items() if j == i), None)
        bracket = _BRACKET.search(column.head)
        if not claimed:
            continue
        if words_of(bare(column))[-1:] == ("last",):
            continue  # a statistic
        channel = claimed[0]
        si = CHANNEL_UNITS[channel]
        if (
            stated is None
            and bracket is not None
            and used in ("pressure", "force", *STROKES, "time")
            and not column.unit
        ):
            yield Question(
                f"unit of {used}",
                f"{reading.label(column)}: '{bracket[1]}' is not a known unit",
                option_of(used, column, reading.use(used).unit),
                column.head,
                reading.use(used).unit,
                (reading.use(used).unit,),
            )
        elif (
            stated is not None
            and used not in claimed
            and dimension_of(stated) not in (*RAW, "ratio", "")
            and not any(
                dimension_of(stated) in FITTING[e.value]
                for e in own
                if e.facet == "channel" and e.rule != "unit"
            )
        ):
            yield Question(
                f"unit of {channel}",
                f"{reading.label(column)}: the unit '{stated}' is a {dimension_of(stated)}, a "
                f"unit of {channel} is needed",
                f"{option_of(channel, column, si)} or {ignore_option(bare(column))}",
                column.head,
            )


def _load(reading: Reading) -> Iterator[Question]:
    channels, conditions = reading.rows.channels, reading.known.conditions
    loaded = "load_mass" in conditions or "load_force" in conditions or {"force", "torque"} & set(channels)
    if not loaded and (set(STROKES) & set(channels) or "pressure" in channels) and "diameter" not in channels:
        yield Question(
            "load",
            "the file states no load, which decides how far the muscle shortens",
            '--load "6 kg"',
            stops=False,
        )
    if "command" in channels and "supply_pressure" not in conditions:
        yield Question(
            "supply",
            "the file states no supply pressure, from which the valve fills the muscle",
            '--supply "6 bar"',
            stops=False,
        )


def _twice(reading: Reading) -> Iterator[Question]:
    """Conditions that the file states with two values."""
    channels = reading.rows.channels
    for found in reading.known.contradictions:
        needed = (
            "command" in channels
            if found.key == "supply_pressure"
            else found.key == "nominal_length" or "force" not in channels
        )
        if (
            not needed
            or found.key in reading.rows.held
            or ("load_mass" in reading.known.held and found.key.startswith("load"))
        ):
            continue
        first, second = found.values
        yield Question(
            found.name,
            f"the file states two values for the {found.name}, {first.text} ({first.where.where}) and "
            f"{second.text} ({second.where.where}); "
            "which one is right",
            f'{found.option} "{first.text}" or {found.option} "{second.text}"',
            None,
            first.text,
            (first.text, second.text),
        )


_EXAMPLES = {"length": "280 mm", "contraction": "10 %", "displacement": "20 mm"}


def _held(reading: Reading) -> Iterator[Question]:
    """A quantity of a static test that no column holds and no single text states: the test held it."""
    channels = set(reading.rows.channels)
    strokes = channels & {*STROKES, "diameter", "command"}
    several = reading.known.several
    if "force" in channels and "pressure" not in channels and strokes:
        if "pressure" in several or "time" not in channels:
            yield from _held_pressure(reading)
    elif (
        {"pressure", "force"} <= channels
        and not strokes
        and (reading.is_isometric or set(several) & set(STROKES))
    ):
        yield from _held_length(reading)


def _stated_by_texts(reading: Reading, channel: str) -> tuple[str, str]:
    """What is said of a quantity of which texts state several values, and the first of these."""
    claims = reading.known.several.get(channel, ())
    shown = ", ".join(f"'{e.value.text}' ({e.span.where})" for e in claims[:6])
    return (f", and the texts state several: {shown}", claims[0].value.text) if claims else ("", "")


def _held_pressure(reading: Reading) -> Iterator[Question]:
    said, first = _stated_by_texts(reading, "pressure")
    levels = next(
        (
            (column, words)
            for i, column in enumerate(reading.table.columns)
            if (words := words_of_levels(column)) and any(reading.claims(i, "pressure"))
        ),
        None,
    )
    if levels is not None:
        column, words = levels
        example = ", ".join(f"{word} = {k} bar" for k, word in enumerate(words, 1))
        yield Question(
            "levels of pressure",
            f"{reading.label(column)} names the pressure by words, {', '.join(words)}, and nothing says "
            "which pressures they are",
            option_of("pressure", column, example),
            column.head,
            None,
            tuple(words),
        )
        return
    yield Question(
        "held pressure",
        f"no column holds the pressure{said or ', and no text states it'}; which one was it",
        column_option("pressure", first or "3 bar"),
    )


def _held_length(reading: Reading) -> Iterator[Question]:
    several = next((c for c in STROKES if c in reading.known.several), "length")
    said, first = _stated_by_texts(reading, several)
    number = number_of_name(reading.name)
    rest = reading.known.stated.get("nominal_length")
    if number and (rest is None or rest.where.where == NAME):
        said += f"; '{number}' in the file's name is it where --rest-length is stated"
    isometric = "the file says that the test is isometric, but " if reading.is_isometric else ""
    yield Question(
        f"held {several}",
        f"{isometric}no column holds the {several} at which the muscle was held"
        f"{said or ', and no text states it'}",
        column_option(several, first or _EXAMPLES[several]),
    )


Policy = Callable[[Reading], Iterator[Question]]
#: Asked where there are enough rows to show something.
POLICIES: tuple[Policy, ...] = (
    _units, _unread, _headless, _scales, _times, _set_point, _by_valve, _counted, _torque, _signs,
    _cycles, _runs_against, _reference, _zero, _contradicted, _close, _tare, _bridge,
)  # fmt: skip
#: Asked always.
ALWAYS: tuple[Policy, ...] = (
    _seconds,
    _unknown_unit,
    _unreadable,
    _unnamed,
    _specimens,
    _rest_length,
    _load,
    _twice,
    _held,
    _counts_rows,
    _of_columns,
    _stated_zeros,
    _hangers,
    _air,
)
