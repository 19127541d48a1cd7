"""The assignment of columns to channels, units, signs and references that the evidence makes most likely.

    S = sum over the columns used [words for the channel - half of the best words for another one
        + half of what is said for sign and reference - what makes the column something else]
        + physics of each column and of all of them together

It is found exactly among the `KEPT` best uses of pressure, force and stroke; time, command and the others
follow. The
margin of a part of the answer is S less the best S without it. A user's answer is evidence with the weight
`YOU`.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from mckibben.measurement.measurement import CHANNEL_UNITS, STROKES
from mckibben.measurement.reading import physics
from mckibben.measurement.reading.correction import Choice
from mckibben.measurement.reading.model import FILE, Array, Evidence, Table, Use
from mckibben.measurement.reading.physics import ATMOSPHERE, Terms
from mckibben.measurement.reading.scales import Scale, answered_scale
from mckibben.measurement.reading.units import CLOCK, FITTING, RAW, dimension_of, in_si

MARGIN = 2.0  # nats, below which is asked: 7 to 1
YOU = 60.0  # nats of what the user says
KEPT = 9  # uses of pressure and force; twice as many of the stroke
GAUGE = 2.5  # nats; pressures of laboratories are gauge
_PULL = _SHORTER = 1.0  # nats; a pull, a shortening counts positive
_NO_WORDS = -3.0  # nats of a column of which nothing says what it is
_RANK = 0.15  # nats that each less usual unit costs
_UNFIT = -9.0  # nats of a unit that is none of the channel
_MASS = -1.0  # nats of a mass as a force
FINAL = (
    "supply",
    "air",
    "at rest",
    "preload",
    "deviation",
    "tube size",
    "a value",
    "slack",
    "condition",
    "ignored",
    "another axis",
)
_ASIDE = ("set value", "running number", "remark", "raw", "words", "counter", "slack", *FINAL)
SLOTS = {
    "time": "time", "pressure": "pressure", "force": "force", "length": "stroke", "contraction": "stroke",
    "displacement": "stroke", "command": "command", "diameter": "diameter",
    "temperature": "temperature", "velocity": "velocity", "angle": "angle", "torque": "torque",
    "lever": "lever",
}  # fmt: skip
_MAIN = ("pressure", "force", "stroke")


_UNREAD = 4.0  # nats against reading nothing from a column whose words and unit both say what it is


class Option(NamedTuple):
    """A use of a column with the score of what is said for it."""

    score: float
    column: int
    use: Use
    named: bool = False


@dataclass(frozen=True)
class Facts:
    """What the decision needs besides the table: conditions in SI, constants of blocks, what the user
    says.
    """

    rest: float | None = None
    ambient: float | Array = ATMOSPHERE
    diameter: float | None = None
    held: Mapping[str, Array] = field(default_factory=dict)
    chosen: Mapping[int, Choice | None] = field(default_factory=dict)


@dataclass(frozen=True)
class Rival:
    """The best answer that differs in one part: which part, how far behind, what it says."""

    slot: str
    part: str
    margin: float
    other: Option | None


@dataclass(frozen=True)
class Decision:
    """The winner: channel -> column and use, its physics, its rivals within and beyond the margin."""

    uses: Mapping[str, tuple[int, Use]]
    options: Mapping[str, tuple[Option, ...]]
    rivals: tuple[Rival, ...]
    terms: tuple[tuple[str, float], ...]
    against: Mapping[str, tuple[tuple[str, float], ...]]
    score: float


def value_of(values: Array, use: Use, ambient: float | Array) -> Array:
    """Readings in SI: pressure gauge, displacement positive when shorter, force positive when pulling."""
    raw = values if use.scale == 1.0 and use.offset == 0.0 else use.scale * (values - use.offset)
    result = in_si(raw, use.unit, use.channel)
    if use.zero:
        result = result - use.zero
    if use.absolute:
        result = result - ambient
    return result if use.sign == 1 else -result


def roles_of(own: Sequence[Evidence]) -> dict[str, float]:
    """Role -> what is said for it."""
    roles: dict[str, float] = {}
    for e in own:
        if e.facet == "role":
            roles[e.value] = roles.get(e.value, 0.0) + e.weight
    return roles


def uses_of(i: int, table: Table, evidence: Sequence[Evidence], facts: Facts) -> list[Option]:
    """What a column may be, each with what its words say for it, the best first."""
    column = table.columns[i]
    if column.words is not None or np.isfinite(column.values).sum() < 1:
        return []
    if i in facts.chosen:
        choice = facts.chosen[i]
        return [] if choice is None else _chosen(i, table, evidence, facts, choice)
    own = [e for e in evidence if e.target == i]
    channels: dict[str, float] = {}
    for e in own:
        if e.facet == "channel":
            channels[e.value] = channels.get(e.value, 0.0) + e.weight
    measures = next((dimension_of(e.value) for e in own if e.facet == "unit"), "")
    named = {e.value for e in own if e.facet == "channel" and e.rule != "unit"}
    worded = {c for c in named if measures in FITTING.get(c, ())}
    roles = roles_of(own)
    scale = next((e.value for e in own if e.facet == "scale"), None)
    si = any(e.facet == "si" for e in evidence)
    options: list[Option] = []
    for channel in SLOTS:
        if channels and channel not in channels:
            continue
        # What only its unit may be stands back behind what its words call it.
        share = 1.0 if worded and channel not in worded else 0.5
        words = channels.get(channel, 0.0) - share * max(
            [w for c, w in channels.items() if c != channel], default=0.0
        )
        words = words if channels else _NO_WORDS
        aside = _aside(channel, roles, scaled=scale is not None, worded=channels.get(channel, 0.0) >= 2.0)
        named = bool(measures) and channel in worded and aside <= 0.0
        for unit, cost, scaling in _units(i, channel, table, own, scale, si=si):
            for option in _signed(i, channel, unit, words - aside + cost, scaling, own, evidence):
                options.append(option._replace(named=named))
    return sorted(options, key=lambda option: -option.score)


def _aside(channel: str, roles: Mapping[str, float], *, scaled: bool, worded: bool) -> float:
    """What makes a column something else than a channel."""
    aside = 0.0
    for role in _ASIDE:
        weight = roles.get(role, 0.0)
        if scaled and role in ("raw", "counter", "running number", "remark", "set value"):
            continue
        if (role == "set value" and channel == "command" and worded) or (
            role == "tube size" and channel != "diameter"
        ):
            continue
        if role == "at rest" and channel in ("displacement", "contraction", "pressure", "force"):
            continue
        aside = max(aside, (2.5 if role in FINAL else 1.0) * weight)
    return (
        aside
        - roles.get("measured", 0.0)
        + roles.get("less wanted", 0.0)
        + (roles.get("at the valve", 0.0) if channel == "pressure" else 0.0)
    )


def _units(
    i: int, channel: str, table: Table, own: Sequence[Evidence], scale: Scale | None, *, si: bool
) -> list[tuple[str, float, Scale | None]]:
    """(unit, its cost, scale) that a column may have as a channel."""
    column = table.columns[i]
    if column.clock:
        return [(CLOCK, 0.0, None)] if channel == "time" else []
    if scale is not None and scale.rule == "valve states":
        return [("1", 0.0, scale)] if channel == "command" else []
    if scale is not None:
        return [(scale.unit, 0.0, scale)] if dimension_of(scale.unit) in FITTING[channel] else []
    stated = next((e.value for e in own if e.facet == "unit"), None)
    stated = stated or next((e.value for e in own if e.facet == "unit_word" and channel == "time"), None)
    if stated is not None:
        dimension = dimension_of(stated)
        if stated == "1" and channel in ("pressure", "force", "length", "displacement"):
            stated = None
        elif dimension in FITTING[channel]:
            return [(stated, _MASS if channel == "force" and dimension == "mass" else 0.0, None)]
        else:
            return [(LEAST[channel], _UNFIT, None)] if dimension in RAW else []
    finite = column.values[np.isfinite(column.values)]
    if si and channel in CHANNEL_UNITS:
        return [(CHANNEL_UNITS[channel], 0.0, None)]
    found = physics.proposal(channel, finite) if len(finite) >= physics.ENOUGH else None
    if found is not None and channel not in ("command", "temperature"):
        units = dict.fromkeys((found.unit, *found.choices))
    elif channel == "contraction":
        units = dict.fromkeys(["%" if len(finite) and np.max(np.abs(finite)) > 1.5 else "1"])
    elif channel == "command":
        units = dict.fromkeys(["1"])
    elif channel == "temperature":
        units = dict.fromkeys(["degC" if len(finite) and np.max(np.abs(finite)) < 200.0 else "K"])
    else:
        units = dict.fromkeys((CHANNEL_UNITS[channel], *physics.LEFT_OUT.get(channel, ())))
    return [(unit, -_RANK * rank, None) for rank, unit in enumerate(units)]


#: Channel -> a unit that it may have, where the stated one is raw.
LEAST = dict(CHANNEL_UNITS.items())


def _signed(
    i: int, channel: str, unit: str, score: float, scale: Scale | None, own: Sequence[Evidence], evidence:
        Sequence[Evidence]
) -> list[Option]:  # fmt: skip
    """The uses with each sign and reference, by what is said of them."""
    scaling = (1.0, 0.0) if scale is None else (scale.factor, scale.offset)
    zero = next((e.value for e in evidence if e.facet == f"zero:{channel}" and e.target in (i, FILE)), 0.0)
    if channel == "pressure":
        near, far = _references(own), _references([e for e in evidence if e.target == FILE])
        said = (
            (near[True] - near[False]) if max(near.values()) else min(far[True], 6.0) - min(far[False], 6.0)
        )
        if scale is not None and scale.absolute is not None:
            said = 6.0 if scale.absolute else -6.0
        return [
            Option(
                score + (0.5 if absolute else -0.5) * (said - GAUGE),
                i,
                Use(channel, unit, 1, absolute, *scaling, zero),
            )
            for absolute in (False, True)
        ]
    facet = {"force": "sign_force", "displacement": "sign_stroke", "contraction": "sign_stroke"}.get(channel)
    if facet is None:
        return [Option(score, i, Use(channel, unit, 1, False, *scaling, zero))]
    near = [e for e in own if e.facet == facet]
    far = [e for e in evidence if e.target == FILE and e.facet == facet]
    said = sum(
        e.weight * e.value for e in (near if near and max(e.weight for e in near) > 2.0 else [*near, *far])
    )
    said += _PULL if channel == "force" else _SHORTER
    return [
        Option(score + 0.5 * sign * said, i, Use(channel, unit, sign, False, *scaling, zero))
        for sign in (1, -1)
    ]


def _references(claims: Sequence[Evidence]) -> dict[bool, float]:
    """What is said for absolute (True) and for gauge (False)."""
    return {a: sum(e.weight for e in claims if e.facet == "absolute" and e.value is a) for a in (True, False)}


def _chosen(i: int, table: Table, evidence: Sequence[Evidence], facts: Facts, choice: Choice) -> list[Option]:
    """The uses of a column that a user named: only what the answer leaves open varies."""
    if choice.channel not in SLOTS:
        return []
    own = [e for e in evidence if e.target == i]
    scale = (
        answered_scale(choice.scale)
        if choice.scale
        else next((e.value for e in own if e.facet == "scale"), None)
    )
    if scale is not None and dimension_of(scale.unit) not in FITTING[choice.channel]:
        scale = None
    stated = next((e.value for e in own if e.facet == "unit"), None)
    if (
        scale is None
        and stated is not None
        and dimension_of(stated) in RAW
        and dimension_of(choice.unit or stated) in RAW
        and choice.channel != "command"
    ):
        return []  # its scale is asked
    if choice.unit is not None and scale is None:
        units: list[tuple[str, float, Scale | None]] = [(choice.unit, 0.0, None)]
    else:
        units = _units(i, choice.channel, table, own, scale, si=any(e.facet == "si" for e in evidence))
    options = [
        o
        for unit, cost, scaling in units
        for o in _signed(i, choice.channel, unit, YOU + cost, scaling, own, evidence)
    ]
    if choice.channel in ("force", "displacement", "contraction"):
        options = [o for o in options if o.use.sign == choice.sign]
    elif choice.sign == -1:
        options = [o._replace(use=o.use._replace(sign=-1)) for o in options]
    if choice.absolute is None and not any(e.facet == "absolute" and e.target in (i, FILE) for e in evidence):
        options = [o for o in options if not o.use.absolute]
    if choice.absolute is not None:
        options = [o for o in options if o.use.absolute == choice.absolute]
    return sorted(options, key=lambda option: -option.score)


class _Scorer:
    """Scores of uses, alone and together, each computed once."""

    def __init__(self, table: Table, facts: Facts) -> None:
        self.table, self.facts = table, facts
        self.pick = np.unique(np.linspace(0, max(table.rows - 1, 0), physics.ROWS).astype(int))
        self.ambient = facts.ambient[self.pick] if isinstance(facts.ambient, np.ndarray) else facts.ambient
        self._values: dict[tuple[int, Use], Array] = {}
        self._joint: dict[tuple[object, ...], Terms] = {}

    def look(self, i: int, use: Use) -> Array:
        """Some readings of a column in SI."""
        key = (i, use)
        if key not in self._values:
            self._values[key] = physics.core(
                value_of(self.table.columns[i].values[self.pick], use, self.ambient)
            )
        return self._values[key]

    def alone(self, option: Option) -> Terms:
        """What one column says by itself."""
        values = self.look(option.column, option.use)
        if self.table.rows < physics.ENOUGH:
            return []  # so few readings show nothing
        return physics.alone(
            option.use.channel, values[np.isfinite(values)], self.facts.rest, len(self.table.titles)
        )

    def joint(self, p: Option | None, f: Option | None, x: Option | None) -> Terms:
        """What pressure, force and stroke say together; a constant of the test stands for a missing
        pressure.
        """
        key = tuple(o and (o.column, o.use) for o in (p, f, x))
        if key not in self._joint:
            arrays = [self.look(o.column, o.use) if o else None for o in (p, f, x)]
            if arrays[0] is None and "pressure" in self.facts.held:
                arrays[0] = self.facts.held["pressure"][self.pick]
            there = [a for a in arrays if a is not None]
            good = np.all([np.isfinite(a) for a in there], axis=0) if there else np.zeros(0, bool)
            terms: Terms = []
            if good.sum() >= physics.ENOUGH:
                pp, ff, xx = (None if a is None else a[good] for a in arrays)
                absolute = p is not None and p.use.absolute
                air = self.ambient[good] if isinstance(self.ambient, np.ndarray) else self.ambient
                raw = pp + air if pp is not None and absolute else pp
                channel = x.use.channel if x else "length"
                with np.errstate(all="ignore"):
                    terms = physics.together(raw, ff, channel, xx, self.facts.diameter, gauge=not absolute)
            self._joint[key] = terms
        return self._joint[key]


def decide(table: Table, evidence: Sequence[Evidence], facts: Facts) -> Decision:
    """The best assignment of a table, and what comes next to it."""
    scorer = _Scorer(table, facts)
    slots: dict[str, list[Option]] = {slot: [] for slot in dict.fromkeys(SLOTS.values())}
    against: dict[str, tuple[tuple[str, float], ...]] = {}
    for i in range(len(table.columns)):
        for option in uses_of(i, table, evidence, facts):
            slots[SLOTS[option.use.channel]].append(option)
    for slot, options in slots.items():
        scored = [o._replace(score=o.score + sum(v for _, v in scorer.alone(o))) for o in options]
        scored.sort(key=lambda o: -o.score)
        slots[slot] = scored[: KEPT if slot != "stroke" else 2 * KEPT]
    ranked = _ranked(slots, scorer)
    score, winner = ranked[0]
    uses: dict[str, tuple[int, Use]] = {o.use.channel: (o.column, o.use) for o in winner if o is not None}
    taken = {o.column for o in winner if o is not None}
    for slot in ("time", "command", "diameter", "temperature", "velocity", "angle", "torque", "lever"):
        best = next(
            (
                o
                for o in slots[slot]
                if o.column not in taken
                and o.score > 0.0
                and _is_share(slot, o, table)
                and _is_said(o, evidence, facts)
            ),
            None,
        )
        if best is not None:
            uses[best.use.channel] = best.column, best.use
            taken.add(best.column)
    for option in sorted(slots["stroke"], key=lambda o: -o.score):  # the same stroke in another form
        if (
            option.use.channel not in uses
            and option.column not in taken
            and option.score >= 2.0
            and any(c in uses for c in STROKES)
        ):
            uses[option.use.channel] = option.column, option.use
            taken.add(option.column)
    if (other := _counter(uses, slots["pressure"], taken, table)) is not None:
        uses["counter_pressure"] = other.column, other.use._replace(channel="counter_pressure")
    for channel, (i, use) in uses.items():
        bad = [(t, v) for t, v in scorer.alone(Option(9.0, i, use)) if v <= -3.0]
        if bad:
            against[channel] = tuple(bad)
    return Decision(
        uses,
        {slot: tuple(options) for slot, options in slots.items()},
        tuple(_rivals(ranked)),
        tuple(scorer.joint(*winner)),
        against,
        score,
    )


_SAME_PRESSURE = 0.95  # correlation from which a second pressure is that of the same muscle


def _counter(
    uses: Mapping[str, tuple[int, Use]], pressures: Sequence[Option], taken: set[int], table: Table
) -> Option | None:
    """The pressure of a second muscle, where a joint's torque over its angle was measured."""
    if not {"torque", "angle", "pressure"} <= set(uses) or "force" in uses:
        return None
    mine = table.columns[uses["pressure"][0]].values
    for option in sorted(pressures, key=lambda o: -o.score):
        other = table.columns[option.column].values
        both = np.isfinite(mine) & np.isfinite(other)
        if option.column in taken or option.score <= 0.0 or both.sum() < 3:
            continue
        if not (np.ptp(mine[both]) and np.ptp(other[both])):
            return option
        if np.corrcoef(mine[both], other[both])[0, 1] < _SAME_PRESSURE:
            return option
    return None


_ASIDE_SLOTS = ("velocity", "diameter", "angle", "torque", "lever")


def _is_said(option: Option, evidence: Sequence[Evidence], facts: Facts) -> bool:
    """Whether more than a letter without a unit says that a column is something that nothing has to be read
    from.
    """
    if option.use.channel not in _ASIDE_SLOTS or option.column in facts.chosen:
        return True
    own = [e for e in evidence if e.target == option.column]
    return any(
        e.facet == "unit" or (e.facet == "channel" and e.value == option.use.channel and e.rule != "letter")
        for e in own
    )


def _is_share(slot: str, option: Option, table: Table) -> bool:
    """Whether a command lies between -1 and 1 in all rows; of other slots nothing is asked."""
    if slot != "command":
        return True
    values = value_of(table.columns[option.column].values, option.use, 0.0)
    return bool(np.nanmax(np.abs(values)) <= 1.001)


def _ranked(
    slots: Mapping[str, Sequence[Option]], scorer: _Scorer
) -> list[tuple[float, tuple[Option | None, ...]]]:
    """All combinations of a pressure, a force and a stroke, the best first; each may be absent."""
    aside = [
        {o.column: o.score for o in reversed(slots[slot]) if o.score > 0.0}
        for slot in slots
        if slot not in _MAIN
    ]
    named = [any(o.named for o in slots[slot]) for slot in _MAIN]
    found = []
    for combination in itertools.product(*([*slots[slot], None] for slot in _MAIN)):
        chosen = [o for o in combination if o is not None]
        columns = {o.column for o in chosen}
        if len(columns) < len(chosen):
            continue
        score = sum(o.score for o in chosen) + sum(v for _, v in scorer.joint(*combination))
        score -= _UNREAD * sum(n and o is None for n, o in zip(named, combination, strict=True))
        score += sum(
            max((s for column, s in of_slot.items() if column not in columns), default=0.0)
            for of_slot in aside
        )
        found.append((score, combination))
    found.sort(key=lambda item: -item[0])
    return found


_PARTS = {
    "column": lambda o: o and o.column, "unit": lambda o: o and (o.use.unit, o.use.scale),
    "sign": lambda o: o and o.use.sign,
    "reference": lambda o: o and o.use.absolute, "channel": lambda o: o and o.use.channel,
}  # fmt: skip


def _rivals(ranked: Sequence[tuple[float, tuple[Option | None, ...]]]) -> list[Rival]:
    """For each part of the winner the best answer without it."""
    top, winner = ranked[0]
    found = []
    for place, slot in enumerate(_MAIN):
        mine = winner[place]
        if mine is None:
            continue
        for part, read in _PARTS.items():
            for score, combination in ranked:
                other = combination[place]
                if read(other) == read(mine) or (
                    part != "column" and (other is None or other.column != mine.column)
                ):
                    continue
                found.append(Rival(slot, part, top - score, other))
                break
    return found


def unit_is_stated(i: int, evidence: Sequence[Evidence]) -> bool:
    """Whether the file says the unit of a column."""
    return any(e.target == i and e.facet in ("unit", "unit_word", "scale") for e in evidence)
