"""What a file states about the test: conditions, quantities held constant; each with the place that says
it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.reading.chosen import chosen, places
from mckibben.measurement.reading.conditions import CONDITION_UNITS, TEXT_CONDITIONS, condition_value
from mckibben.measurement.reading.correction import Choice, Correction
from mckibben.measurement.reading.decide import YOU, Facts
from mckibben.measurement.reading.evidence import NO_UNIT, of_code
from mckibben.measurement.reading.heads import taken_apart
from mckibben.measurement.reading.lexicon import REFERENCES, folded
from mckibben.measurement.reading.model import BLOCK, FILE, Array, Evidence, Span, Table
from mckibben.measurement.reading.physics import ATMOSPHERE
from mckibben.measurement.reading.units import Quantity, Unit, dimension_of, quantity_si
from mckibben.measurement.reading.zeros import stated_hangers
from mckibben.physics.units import GRAVITY

_SAME = 2e-3  # relative; values that differ by less are the same one, rounded
_STATED = 4.0  # nats from which a value counts as stated; two of them that differ are asked about
_POSSIBLE_AIR = (5e4, 1.1e5)  # Pa; of the air where people work
_OTHER_UNITS = {"diameter": "m"}  # of conditions that only the physics uses
_SIZE = re.compile(r"(?:DMSP|MAS)-(\d{1,3})")
_YOU = Span("you", "")
_ANSWER = Span("your answer", "")
HELD_BY_YOU = "held, as the user says"
#: Conditions of which two values are asked about -> (their name, the option that sets them).
_ASKED = {
    "nominal_length": ("rest length", "--rest-length"), "load_mass": ("load", "--load"),
    "load_force": ("load", "--load"),
    "supply_pressure": ("supply pressure", "--supply"),
}  # fmt: skip


class Stated(NamedTuple):
    """A condition: its value in SI or as text, where it stands, as it is written there."""

    value: float | str
    where: Span
    text: str


class Contradiction(NamedTuple):
    """A condition with two values: its key, its name, the option that sets it, both values with their
    places.
    """

    key: str
    name: str
    option: str
    values: tuple[Stated, Stated]


class Held(NamedTuple):
    """A quantity that was held: its value of each block, as it is written, where that stands, its unit."""

    values: Array
    text: str
    where: str
    unit: str
    by_name: bool = False
    by_you: bool = False


@dataclass(frozen=True)
class Known:
    """What is known beside the columns.

    Attributes:
        conditions: in SI or as text, the user's over those of the file.
        stated: the same with their places.
        contradictions: two values for one condition.
        held: channel -> values of the blocks; only where no column holds the channel they count.
        air: pressure of the surrounding air in each row, where a column holds it [Pa].
        columns: condition -> the column that holds it, and its different values in SI.
        several: channels for which texts name several values.
        kind: that texts name; empty = none, or several.
        chosen: column -> what the user says it is, and None for those that the file itself dismisses.
        dismissed: columns that the file, and not the user, says are not to be read.
        messages: what was assumed.
    """

    conditions: dict[str, float | str]
    stated: Mapping[str, Stated]
    contradictions: tuple[Contradiction, ...]
    held: Mapping[str, Held]
    air: Array | None
    columns: Mapping[str, tuple[int, tuple[float, ...]]]
    several: Mapping[str, tuple[Evidence, ...]]
    kind: str
    chosen: Mapping[int, Choice | None]
    messages: tuple[str, ...] = field(default=())
    dismissed: frozenset[int] = frozenset()

    def facts(self, table: Table) -> Facts:
        """What the decision needs of it."""
        rest = self.conditions.get("nominal_length")
        air = self.conditions.get("ambient_pressure")
        diameter = self.stated["diameter"].value if "diameter" in self.stated else None
        if diameter is None and (size := _SIZE.fullmatch(str(self.conditions.get("muscle", "")))):
            diameter = float(size[1]) / 1e3
        held = {channel: one.values[table.blocks] for channel, one in self.held.items()}
        aside: dict[int, Choice | None] = {i: None for i, _ in self.columns.values()}
        return Facts(
            rest=rest if isinstance(rest, float) and rest > 0.0 else None,
            ambient=self.air
            if self.air is not None
            else air
            if isinstance(air, float) and _POSSIBLE_AIR[0] <= air <= _POSSIBLE_AIR[1]
            else ATMOSPHERE,
            diameter=diameter if isinstance(diameter, float) else None,
            held=held,
            chosen=aside | dict(self.chosen),
        )


def known_of(table: Table, evidence: Sequence[Evidence], name: str, correction: Correction) -> Known:
    """What the evidence and the user say about the test.

    Raises:
        InputError: a condition that cannot be used, or a correction of a column that is not there.
    """
    messages: list[str] = []
    stated: dict[str, Stated] = {}
    contradictions: list[Contradiction] = []
    claims: dict[str, list[Evidence]] = {}
    columns = _columns_of_conditions(table, evidence, correction)
    for e in (*evidence, *_of_columns(table, columns)):
        if e.facet.startswith("condition:") and e.target == FILE:
            claims.setdefault(e.facet.partition(":")[2], []).append(e)
    for key, found in claims.items():
        if key in ("ignore", "sampling_step"):
            continue
        ranked = _ranked(key, found, name, messages)
        stated[key] = ranked[0][1]
        if any(e.rule == NO_UNIT and e.span == stated[key].where for e in found):
            messages.append(f"{key}: no unit given, read as {stated[key].text}")
        if (
            key in _ASKED
            and len(ranked) > 1
            and ranked[1][0] >= _STATED
            and not _is_note(ranked[0][1], found)
        ):
            contradictions.append(Contradiction(key, *_ASKED[key], (ranked[0][1], ranked[1][1])))
    if "load_mass" in stated and "load_force" in stated and "name" in stated["load_mass"].where.where:
        del stated["load_mass"]
    conditions: dict[str, float | str] = {k: s.value for k, s in stated.items() if k not in _OTHER_UNITS}
    heads = {column.head.strip().casefold() for column in table.columns}
    for e in evidence:
        if e.facet == "note" and e.value[0] not in {*conditions, *heads}:
            conditions[e.value[0]] = str(e.value[1]).strip()[:200]
            stated.setdefault(e.value[0], Stated(conditions[e.value[0]], e.span, str(e.value[1])))
    hangers, load = stated_hangers(table), conditions.get("load_mass")
    if len(hangers) == 1 and hangers[0].contained is False and isinstance(load, float):
        more = hangers[0].weight / GRAVITY
        if more < 0.9 * load:
            conditions["load_mass"] = load + more
            place = f"'{hangers[0].span.text[:80]}' ({hangers[0].span.where})"
            messages.append(f"{more:.4g} kg is added to the load for the hanger: {place}")
    for key, value in correction.conditions.items():
        if value is None:
            conditions.pop(key, None)
        else:
            conditions[key] = value
            stated[key] = Stated(value, _YOU, "")
    contradictions = [c for c in contradictions if c.key not in correction.conditions]
    said = {e.value for e in evidence if e.facet == "kind"}
    by_user, held_by_user = chosen(table, correction.columns, name)
    answers = [
        Evidence(FILE, f"held:{channel}", quantity, YOU, _ANSWER, HELD_BY_YOU)
        for channel, quantity in held_by_user.items()
    ]
    held, several = _held(table, (*evidence, *answers), conditions, messages)
    ignored = next((str(s.value) for k, s in stated.items() if k == "ignore"), "")
    unwanted = (
        {n.strip(): None for e in claims.get("ignore", ()) for n in str(e.value).split(",")}
        if not ignored
        else {}
    )
    dismissed = {i: None for k in unwanted for i in places(k, table)[:1] if i not in by_user}
    return Known(
        conditions,
        stated,
        tuple(contradictions),
        held,
        _air_of_rows(table, columns, evidence),
        columns,
        several,
        said.pop() if len(said) == 1 else "",
        {**dismissed, **by_user},
        tuple(messages),
        frozenset(dismissed),
    )


#: Role of a column, dimension of its unit -> the condition that it holds.
_OF_ROLES = {
    ("at rest", "length"): "nominal_length", ("supply", "pressure"): "supply_pressure",
    ("air", "pressure"): "ambient_pressure",
}  # fmt: skip
_ROLE = 2.0  # nats from which a column holds a condition


def _columns_of_conditions(
    table: Table, evidence: Sequence[Evidence], correction: Correction
) -> dict[str, tuple[int, tuple[float, ...]]]:  # fmt: skip
    """Condition -> (column, its different values in SI) of the columns that hold one: a rest length, the
    supply, a load.
    """
    found: dict[str, tuple[int, tuple[float, ...]]] = {}
    loads: dict[int, float] = {}
    named = {
        i for said, choice in correction.columns.items() if choice is not None for i in places(said, table)
    }
    for i, column in enumerate(table.columns):
        own = [e for e in evidence if e.target == i]
        unit = next((e.value for e in own if e.facet == "unit"), None)
        if column.words is not None or i in named or unit is None:
            continue
        roles = {e.value for e in own if e.facet == "role" and e.weight >= _ROLE}
        dimension = dimension_of(unit)
        key = next((_OF_ROLES[role, dimension] for role in roles if (role, dimension) in _OF_ROLES), None)
        if any(
            e.facet == "channel" and e.value in ("displacement", "contraction") and e.rule != "unit"
            for e in own
        ):
            key = None  # "shortening from rest length"
        values = np.unique(column.values[np.isfinite(column.values)])
        if dimension == "mass" and len(values) == 1 and any(_is_of_force(e) for e in own):
            if any(e.rule == "hanging_mass" for e in own):
                key = "load_mass"
            else:
                loads[i] = quantity_si(float(values[0]), unit, "kg")
        if key is None or not len(values):
            continue
        si = tuple(quantity_si(v, unit, CONDITION_UNITS[key]) for v in values[:50].tolist())
        found.setdefault(key, (i, si))
    if found and len(loads) == 1:  # a table that repeats its conditions in each row
        found.setdefault("load_mass", (next(iter(loads)), tuple(loads.values())))
    return found


def _is_of_force(e: Evidence) -> bool:
    """Whether a word claims a force, or a mass that hangs."""
    return e.facet == "channel" and e.value == "force" and e.rule not in ("unit", "letter")


def _of_columns(table: Table, columns: Mapping[str, tuple[int, tuple[float, ...]]]) -> list[Evidence]:
    """The conditions that columns of one value state."""
    found = []
    for key, (i, values) in columns.items():
        if len(values) == 1:
            column = table.columns[i]
            span = Span(f"{table.noun} '{column.title}'", column.title)
            unit = CONDITION_UNITS[key]
            quantity = Quantity(0, 0, values[0], Unit(unit, dimension_of(unit)), f"{values[0]:.6g} {unit}")
            found.append(Evidence(FILE, f"condition:{key}", quantity, 7.0, span, "column"))
    for column in table.columns:
        codes = set(column.words or ()) if column.words is not None else set()
        if len(codes) == 1:
            found += of_code(Span(f"{table.noun} '{column.title}'", next(iter(codes))))
    return found


def _air_of_rows(
    table: Table, columns: Mapping[str, tuple[int, tuple[float, ...]]], evidence: Sequence[Evidence]
) -> Array | None:
    """The pressure of the surrounding air [Pa] in each row, where a column holds several values, or blocks
    have their own.
    """
    i, values = columns.get("ambient_pressure", (-1, ()))
    if len(values) < 2:
        of_block = {
            BLOCK - e.target: quantity_si(e.value.value, e.value.unit.name, "Pa")
            for e in evidence
            if e.facet == "condition:ambient_pressure" and e.target <= BLOCK
        }
        if len(of_block) == len(table.titles) > 1:
            return np.array([of_block[k] for k in range(len(of_block))])[table.blocks]
        return None
    unit = _stated_unit(table, i)
    return np.array([quantity_si(v, unit, "Pa") for v in table.columns[i].values.tolist()])


def _stated_unit(table: Table, i: int) -> str:
    column = table.columns[i]
    unit = taken_apart(column.head, column.unit).unit
    return "Pa" if unit is None else unit.name


def _is_note(best: Stated, found: Sequence[Evidence]) -> bool:
    """Whether the value is one under the name of this program, which nothing else doubts."""
    return any(e.rule == "note" and e.span == best.where for e in found)


def _ranked(
    key: str, found: Sequence[Evidence], name: str, messages: list[str]
) -> list[tuple[float, Stated]]:
    """The values of a condition, with what is said for each, the best first."""
    groups: list[list[tuple[Evidence, float | str]]] = []
    for e in found:
        value = _value(key, e, name, messages)
        for group in groups:
            if _same(group[0][1], value):
                group.append((e, value))
                break
        else:
            groups.append([(e, value)])
    ranked = []
    for group in groups:
        strongest = max(group, key=lambda item: item[0].weight)
        text = (
            strongest[0].value.text if isinstance(strongest[0].value, Quantity) else str(strongest[0].value)
        )
        ranked.append(
            (strongest[0].weight + 0.1 * (len(group) - 1), Stated(strongest[1], strongest[0].span, text))
        )
    return sorted(ranked, key=lambda item: -item[0])


def _value(key: str, e: Evidence, name: str, messages: list[str]) -> float | str:
    if isinstance(e.value, Quantity):
        unit = CONDITION_UNITS.get(key) or _OTHER_UNITS.get(key, "1")
        value = quantity_si(e.value.value, e.value.unit.name, unit)
        if key in ("supply_pressure",) and e.value.unit.absolute:
            value -= ATMOSPHERE
        return value
    if key in (*CONDITION_UNITS, *TEXT_CONDITIONS):
        return condition_value(
            key, str(e.value), where=f"{name}, {e.span.where}, {key}", field=key, messages=messages
        )
    return str(e.value)


def _same(a: float | str, b: float | str) -> bool:
    if isinstance(a, float) and isinstance(b, float):
        return abs(a - b) <= _SAME * max(abs(a), abs(b))
    return a == b


def _held(
    table: Table,
    evidence: Sequence[Evidence],
    conditions: Mapping[str, float | str],
    messages: list[str],
) -> tuple[dict[str, Held], dict[str, tuple[Evidence, ...]]]:
    """Channel -> what was held in each block, or in the file; and channels of which texts name several
    values.
    """
    held: dict[str, Held] = {}
    several: dict[str, tuple[Evidence, ...]] = {}
    blocks = len(table.titles)
    facets = {"held:pressure": "pressure", "held:length": "length", "held:displacement": "displacement",
              "held:contraction": "contraction", "condition:load_mass": "load_mass",
              "condition:load_force": "load_force"}  # fmt: skip
    for facet, channel in facets.items():
        claims = [e for e in evidence if e.facet == facet and isinstance(e.value, Quantity)]
        claims = [e for e in claims if e.rule == HELD_BY_YOU] or claims
        own = {k: _only([e for e in claims if e.target == BLOCK - k]) for k in range(blocks)}
        if blocks > 1 and all(e is not None for e in own.values()):
            values = np.array(
                [_held_value(channel, e, conditions, evidence, k) for k, e in own.items() if e is not None]
            )
            first = next(e for e in own.values() if e is not None)
            held[channel] = Held(values, first.value.text, first.span.where, first.value.unit.name)
            continue
        if facet.startswith("condition"):
            continue
        whole = [e for e in claims if e.target == FILE]
        texts = [e for e in whole if e.rule != "name"]
        names = [e for e in whole if e.rule == "name"]
        chosen = texts or names
        distinct = {round(_held_value(channel, e, conditions, evidence, None), 12): e for e in chosen}
        named = {round(_held_value(channel, e, conditions, evidence, None), 12): e for e in names}
        agreed = set(named) & set(distinct)
        if texts and names and not agreed:
            other = names[0]
            messages.append(f"{other.span.where} states another {channel}, '{other.value.text}'")
        if len(distinct) > 1 and texts and names:
            distinct = {value: distinct[value] for value in agreed} if len(agreed) == 1 else distinct
        if len(distinct) == 1:
            value, e = next(iter(distinct.items()))
            held[channel] = Held(
                np.full(max(blocks, 1), value), e.value.text, e.span.where, e.value.unit.name, not texts,
                e.rule == HELD_BY_YOU,
            )  # fmt: skip
        elif distinct:
            several[channel] = tuple(distinct.values())
    return held, several


def _only(claims: Sequence[Evidence]) -> Evidence | None:
    """The strongest claim; None = there is none, or two as strong ones differ: "from 1 bar to 3 bar"."""
    best = max(claims, key=lambda e: e.weight, default=None)
    if best is None or any(e.weight == best.weight and e.value[2:4] != best.value[2:4] for e in claims):
        return None
    return best


def _held_value(
    channel: str,
    e: Evidence,
    conditions: Mapping[str, float | str],
    evidence: Sequence[Evidence],
    block: int | None,
) -> float:
    unit = {"load_mass": "kg", "load_force": "N"}.get(channel) or CHANNEL_UNITS[channel]
    value = quantity_si(e.value.value, e.value.unit.name, unit)
    if channel != "pressure":
        return value
    absolute = e.value.unit.absolute
    if absolute is None:
        targets = (FILE,) if block is None else (BLOCK - block, FILE)
        marks = [m for m in evidence if m.facet == "absolute" and m.target in targets]
        absolute = (
            max(marks, key=lambda m: m.weight).value
            if marks
            else REFERENCES.get(folded(str(conditions.get("pressure", ""))))
        )
    air = conditions.get("ambient_pressure")
    return value - (air if isinstance(air, float) else ATMOSPHERE) if absolute else value
