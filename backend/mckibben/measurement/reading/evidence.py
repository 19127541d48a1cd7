"""A table and the texts around it -> claims. The rules are data; this module only applies them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import PurePath
from typing import NamedTuple

import numpy as np

from mckibben.measurement.reading.conditions import CONDITION_UNITS, TEXT_CONDITIONS, key_of
from mckibben.measurement.reading.heads import Claim, head_claims, taken_apart
from mckibben.measurement.reading.lexicon import (
    REFERENCES,
    Rule,
    folded,
    pattern_of,
    rules,
    word_set,
    words_of,
)
from mckibben.measurement.reading.limits import MAX_TEXT
from mckibben.measurement.reading.model import BLOCK, FILE, Column, Evidence, Span, Table
from mckibben.measurement.reading.positions import of_positions
from mckibben.measurement.reading.scales import Scale, scales_in
from mckibben.measurement.reading.subjects import Piece, pieces_of
from mckibben.measurement.reading.units import (
    BRIDGE,
    RAW,
    Quantity,
    Unit,
    number_of,
    quantities,
    quantity_si,
    unit_of,
)
from mckibben.measurement.reading.zeros import of_zeros
from mckibben.resources import presets_folder

#: What a unit alone says of a column [nats].
BY_UNIT = {
    "pressure": (("pressure", 2.5),), "force": (("force", 2.5),), "time": (("time", 2.0),),
    "length": (("length", 0.8), ("displacement", 0.8)), "ratio": (("contraction", 0.4), ("command", 0.4)),
    "mass": (("force", 1.2),), "temperature": (("temperature", 4.0),), "speed": (("velocity", 2.0),),
    "angle": (("angle", 2.0),), "torque": (("torque", 2.5),),
}  # fmt: skip
_UNIT_STATED, _CLOCK_SHOWN, _TEXTS, _COUNTS, _SINCE_1970 = 5.0, 5.0, 6.0, 3.0, 4.0
_EVEN = 4.0  # nats of even steps, from row to row of a long record
_LONG_RECORD = 100  # rows
_OVER = 0.35  # of the weight of a head, that texts over it have
NAME = "the file's name"
_CLAUSES = re.compile(
    r"(?:,(?!\s?(?:wenn|when|if|falls|quand|si|quando|cuando|se|als|om)\b)|[;.|()\[\]])(?!\d)|\s[/–-]\s|\s(?:and|und|et|e|y|og|och|en|i|a|ve|и|та)\s"
)
_SIGN_BEFORE = re.compile(r"(?<![\w.,+-])\(?(?P<sign>[+−-])\)?(?=\s?(?:[A-Za-z]\w{0,2}\s?)?(?:=|≙|->|→))")
_SIGN_BEHIND = re.compile(
    r"(?<=[^\W\d_])\s?[:=]?\s?\(?(?P<sign>\+)\)?(?=\s?(?:[,;.)/]|$))|(?<=[^\W\d_])\s?[:=]?\s\(?(?P<minus>[−-])\)?(?=\s?(?:[,;.)/]|$))"
)
_L_ZERO = re.compile(r"(?<![^\W_])[Ll](?:_\{?0\}?|_?o(?=\s?[=:≈])|[ ]0(?=\s?[=:≈])|₀)")
_NO_PRESSURE = re.compile(
    r"(?<![\w.,])(?:p\s?=\s?)?0(?:[.,]0{1,4})?\s?(?:mbar|bar|hPa|kPa|MPa|Pa|psig?)(?:\s?\(g\))?(?!\w)"
    r"|(?i:(?<!\w)(?:without|no|ohne|sans|senza|sin|sem)\s(?:pressure|druck|pression|pressione|presión|pressão)(?!\w))"
)
_AT_PRESSURE = re.compile(
    r"(?i)[\s(,]{0,3}(?:at|bei|@|à|a|con|mit|with|under)?\s?[0-9.,]{0,6}[1-9][0-9.,]{0,6}\s?(?:mbar|bar|[hkM]?Pa|psi)(?!\w)"
)
_TO = r"(?:to|bis|à|a|al|hasta|até|tot|до|-|–|→|\.{2,3}|…)"
_BOUND = r"(?<![^\W_])(?<!\.)(?!0\d)\d{1,4}(?:[.,]\d{1,4})?"
_RANGE_BEFORE = re.compile(
    rf"(?i)(?:unpressurized|{_BOUND}\s?[^\W\d_]{{1,4}})\s{{0,3}}{_TO}\s?$"
    rf"|{_BOUND}(?:[-–…]|\.{{2,3}}|\s(?:to|bis|à)\s)$"
)
_RANGE_BEHIND = re.compile(rf"(?i)\s?{_TO}\s?\d")
_MERCURY = re.compile(
    r"(?i)мм\s?рт\.?\s?ст\.?|mm\s?hg\b|mm\s(?:of\s|de\s|di\s)?(?:mercur\w{0,6}|quecksilber\w{0,6}|qs\b)"
)
#: "CH1", "Kanal 2", "Ch A": a channel by its number or its letter.
_CHANNEL = re.compile(
    r"(?i)(?<![^\W_])(?:(?:ch|chan|channel|kanal|canal|voie|ai|input|in)[ _-]?0?(\d{1,2})"
    r"|(?:ch|chan|channel|kanal|canal|voie)[ _-]?([a-h]))(?![^\W_])"
)
_NOTE = re.compile(r"[#%/!;\s]{0,10}(?P<key>[A-Za-z][A-Za-z_ -]{0,30}?0?)\s?[:=]\s?(?P<value>.{1,900})")
_CODE = re.compile(
    r"(?<![A-Za-z0-9])([A-Za-z]{2,6})[-_ ]?([0-9]{1,3})(?:-([0-9]{2,4})(?![0-9]))?(?![0-9a-z])"
)
_OTHER_GAUGES = re.compile(
    r"(?i)(?:strain|dial|length|load|force|displacement|feeler)[ -]?gau?ges?|gau?ge length|"
    r"positive[ -]displacement"
)
_BEHIND_UPTO = re.compile(r"[,;.:(](?!\d)|\s(?:and|with|und|mit|et|avec|con|com|og|och)\s")
_LEADS = re.compile(r"(?::|\.{2,}|_{2,}|…)\s*$")  # to a value: "Relaxed length, no pressure ...... 12 in"
_OF_THE_NEXT = re.compile(r"\s?\([^()]{0,60}")
_SCALED = re.compile(
    r"(?i)[0-9]\s?(?:%|m?V|m?A|counts?|digits?)\s?(?:=|≙|->|→)|(?:=|≙|->|→)\s?[0-9.]{1,8}\s?(?:V|mA|counts?)"
)
_HELD_BY = {"length": "length", "mass": "load_mass", "pressure": "pressure", "ratio": "contraction"}
_SHORT_LENGTH = 0.08  # m; a title that says less without a word names a stroke, not a length
_COLUMN_SAMPLE = 5000


#: What says that a number stands for something.
_MEANS = re.compile(
    r"(?i)=|:|->|\b(?:marks?|means?|denotes?|indicates?|stands?|is|are|bedeutet|heißt|kennzeichnet|steht|signifie|"
    r"indique|significa|indica|oznacza|znamená|betekent|betyder|was|were|entered|written|recorded|as)\b"
)
_LOST = re.compile(r"(?<![\w.])([-+]?\d{1,7}(?:[.,]\d{1,6})?)(?![\w.]*\d)")


def stated_marks(table: Table) -> tuple[tuple[float, Span], ...]:
    """Numbers that texts say to stand for a lost reading: "a force of -1.0 marks a lost sample", "NoValue:
    -9999".
    """
    found = []
    for span in table.texts:
        for clause in re.split(r"[;|]|,\s|[.](?=\s|$)", span.text[:MAX_TEXT]):
            words = words_of(clause)
            named = word_set("no_reading").among(words) or "novalue" in words or {"no", "value"} <= {*words}
            numbers = list(_LOST.finditer(clause)) if named and _MEANS.search(clause) else ()
            if len(numbers) != 1 or clause[numbers[0].end() :].lstrip().startswith("%"):
                continue  # "error = 0.5 %" is a size
            if not word_set("deviation_words").among(words_of(clause[: numbers[0].start()])[-2:]):
                found.append((number_of(numbers[0][1]), span))
    return tuple(found)


#: Rule of files in the form of this program, whose pressures are gauge where they say nothing else.
OWN_FORM = "own form"


def evidence_of(table: Table, name: str) -> list[Evidence]:
    """All claims about the columns, the blocks and the file."""
    found: list[Evidence] = []
    for i, column in enumerate(table.columns):
        found += of_column(i, column)
    found = _only_pressure(found, table)
    for span in table.texts:
        found += _of_text(span, FILE, table)
    found += [*of_bridge(table), *of_zeros(table), *of_positions(table)]
    found += _of_counts(table, found)
    for k, spans in enumerate(table.titles):
        for span in spans if len(table.titles) > 1 else ():
            found += _of_title(span, BLOCK - k)
    found += _of_name(Span(NAME, PurePath(name).stem))
    for span in table.texts:
        if span.where.startswith("name of sheet"):
            found += [e._replace(rule="sheet") for e in _of_name(span)]
    kind = next((e for e in found if e.facet == "condition:kind" and e.rule == "note"), None)
    if kind is not None and not any(e.facet == "absolute" for e in found):
        found.append(Evidence(FILE, "absolute", False, _UNIT_STATED, kind.span, OWN_FORM))
    return found


_MOST_COUNTS = 2**16


def _of_counts(table: Table, found: Sequence[Evidence]) -> list[Evidence]:
    """Whole numbers without a unit, where a text says that readings are counts: "both raw 10 bit"."""
    rule = _text_rule("raw_counts")
    said = next((span for span in table.texts if pattern_of(rule).search(span.text[:MAX_TEXT])), None)
    aside = {e.target for e in found if e.facet in ("unit", "scale", "unit_word") or e.value in _NO_COUNTS}
    counts = []
    for i, column in enumerate(table.columns if said else ()):
        values = column.values[np.isfinite(column.values)]
        whole = len(values) > 0 and np.all(values == np.round(values)) and values.min() >= 0.0
        if said and i not in aside and column.words is None and whole and values.max() < _MOST_COUNTS:
            counts.append(Evidence(i, "role", "raw", rule.weight, said, rule.id))
    return counts


_NO_COUNTS = ("time", "group", "direction", "command", "running number", "remark")
_MOVES = 0.25  # of its largest reading, by which no supply of a test moves
_SCATTERED = 0.2  # different values by row, from which a series was measured and not set


def _only_pressure(found: list[Evidence], table: Table) -> list[Evidence]:
    """The only pressure, called like a supply but of several levels, is what the valve gave the muscle; in
    the line it was measured where it scatters.
    """
    pressures = {e.target for e in found if e.facet == "channel" and e.value == "pressure"}
    supply = {e.target: e for e in found if e.facet == "role" and e.value == "supply"}
    if len(pressures) != 1 or not pressures <= set(supply):
        return found
    (i,) = pressures
    values = np.abs(table.columns[i].values[np.isfinite(table.columns[i].values)])
    if not len(values) or np.ptp(values) < _MOVES * np.max(values):
        return found
    measured = supply[i].rule == "role_line" and len(np.unique(values)) >= _SCATTERED * len(values)
    given = [] if measured else [supply[i]._replace(value="at the valve", weight=0.5)]
    return [*(e for e in found if e is not supply[i]), *given]


def of_column(i: int, column: Column) -> list[Evidence]:
    """What a column claims by its head, by what stands over it, and by what its cells are."""
    found: list[Evidence] = []
    span = Span(column.where, column.head)
    unit = _unit_of(column)
    for claim in head_claims(column.head[:200], column.unit):
        found.append(_from_claim(i, claim, span, 1.0))
    for text in column.above:
        found += [_from_claim(i, c, Span(column.where, text), _OVER) for c in head_claims(text[:200])]
    for where in column.described:
        text = where.text
        scales = [scale for scale, _ in scales_in(text[:MAX_TEXT])]  # "p 1 bar/V (gauge)"
        found += [Evidence(i, "scale", scale, scale.weight, where, scale.rule) for scale in scales]
        found += [
            _from_claim(i, c, where, 0.9)
            for c in (
                head_claims(text.replace(scales[0].text, "")[:200], scales[0].unit)
                if scales
                else head_claims(text[:200])
            )
            if c.facet != "role" or c.value == "set value"
        ]
    absolute = taken_apart(column.head, column.unit).absolute
    share = taken_apart(column.head, column.unit).share
    if unit is not None and share != 1.0:
        part = Scale(share, 0.0, unit.name, rule="part of a unit", text=column.unit or column.head)
        found.append(Evidence(i, "scale", part, part.weight, span, part.rule))
    described = tuple(span.text for span in column.described)
    texts = [t for t in (*column.above, *described) if absolute is None]
    for text in texts:
        absolute = taken_apart(text[:200]).absolute if absolute is None else absolute
    if absolute is not None:
        said = Span(column.where, f"{column.head} {column.unit}".strip())
        found.append(Evidence(i, "absolute", absolute, _UNIT_STATED, said, "reference"))
    if unit is not None:
        found.append(
            Evidence(
                i, "unit", unit.name, _UNIT_STATED, Span(column.where, column.unit or column.head), "unit"
            )
        )
        found += [Evidence(i, "channel", c, w, span, "unit") for c, w in BY_UNIT.get(unit.dimension, ())]
        if unit.dimension in RAW:
            found.append(Evidence(i, "role", "raw", _TEXTS, span, "raw signal"))
    return [*found, *_of_cells(i, column, unit, span)]


def _from_claim(i: int, claim: Claim, span: Span, factor: float) -> Evidence:
    facet = "unit_word" if claim.facet == "unit" else claim.facet
    return Evidence(i, facet, claim.value, claim.weight * factor, span, claim.rule)


def _unit_of(column: Column) -> Unit | None:
    """The unit of a column, in its head, below it, or in the row that describes it."""
    unit = taken_apart(column.head, column.unit).unit
    if unit is None:
        for text in (*(s.text for s in column.described), *(t for t in column.above if not quantities(t))):
            unit = unit or unit_of(text) or taken_apart(text[:200]).unit
    return unit


def _of_cells(i: int, column: Column, unit: Unit | None, span: Span) -> list[Evidence]:
    """What the cells themselves show: times of day, words, counts, seconds since 1970."""
    found: list[Evidence] = []
    if column.clock:
        found.append(Evidence(i, "channel", "time", _CLOCK_SHOWN, span, "times of day"))
    if column.words is not None:
        found.append(Evidence(i, "role", "words", _TEXTS, span, "words"))
        return found
    values = column.values[np.isfinite(column.values)][:_COLUMN_SAMPLE]
    if len(values) > 5 and unit is None and np.all(np.diff(values) == 1.0) and values[0] in (0.0, 1.0):
        found.append(
            Evidence(i, "role", "running number", _COUNTS, Span(span.where, "counts 1, 2, 3, ..."), "counts")
        )
    if not len(values):
        return found
    low, high = float(np.min(values)), float(np.max(values))
    steps = np.diff(values)
    even = len(values) >= _LONG_RECORD and steps[0] > 0.0 and np.ptp(steps) <= 1e-3 * steps[0]
    even = even and not found  # a running number
    if even and unit is None and not head_claims(column.head[:200]):
        since = Span(span.where, f"grows by {steps[0]:.6g} from row to row")
        found.append(Evidence(i, "channel", "time", _EVEN, since, "even steps"))
    for name, size in (("s", 1e9), ("ms", 1e12), ("us", 1e15), ("ns", 1e18)):
        if 0.9 * size < low and high < 4.0 * size and (unit is None or unit.name == name):
            since = Span(span.where, f"counts {name} since 1970")
            found.append(Evidence(i, "unit_word", name, _SINCE_1970, since, "since 1970"))
            found.append(Evidence(i, "channel", "time", _CLOCK_SHOWN, since, "since 1970"))
    if (
        unit is None
        and low > 36_000.0
        and high < 80_000.0
        and high - low < 60.0
        and np.any(values != np.round(values))
    ):
        since = Span(span.where, "counts days as spreadsheets do")
        found.append(Evidence(i, "unit_word", "day", _SINCE_1970, since, "serial days"))
    return found


class _Context(NamedTuple):
    """A quantity of a text with the words before it and behind it."""

    quantity: Quantity
    before: tuple[str, ...]
    label: tuple[str, ...]
    behind: tuple[str, ...]
    further: tuple[str, ...]
    pressed: bool
    ranged: bool


def _contexts(text: str) -> list[_Context]:
    """The quantities of a text, each with the words since the one before it, and those up to the next one."""
    text = _MERCURY.sub("mmHg", text[:MAX_TEXT])
    text = _NO_PRESSURE.sub(" unpressurized ", _L_ZERO.sub("L0", text))
    found = quantities(text)
    begin = 0
    contexts = []
    for k, quantity in enumerate(found):
        label = text[begin : quantity.begin]  # "L at rest, vented: 28 cm"
        pieces = re.split(r"[;,](?!\d)(?![^()]{0,60}\))", label)
        worded = [n for n, p in enumerate(pieces) if any(w != quantity.unit.name for w in words_of(p))]
        # Not what stands behind another quantity.
        mine = bool(worded) and (worded[-1] > 0 or k == 0 or len(pieces) == 1)
        before = pieces[worded[-1]] if mine else ""
        upto = found[k + 1].begin if k + 1 < len(found) else len(text)
        begin = quantity.end
        next_to_it = text[begin : min(upto, begin + 60)]
        if _OF_THE_NEXT.fullmatch(next_to_it) and upto < len(text):
            next_to_it = ""  # "clamped at 114 mm (free length 120 mm)"
        behind, *more = _BEHIND_UPTO.split(next_to_it.lstrip(" ("))
        whole = upto == len(text) or len(more) > 1  # no clause of the next quantity
        contexts.append(
            _Context(
                quantity,
                words_of(before),
                words_of(label) if _LEADS.search(before) else (),
                words_of(behind),
                words_of(more[0]) if more and whole else (),
                _AT_PRESSURE.match(text, quantity.end) is not None,
                _RANGE_BEHIND.match(text, quantity.end) is not None
                or _RANGE_BEFORE.search(text[max(0, quantity.begin - 30) : quantity.begin]) is not None,
            )
        )
    return contexts


def _of_text(span: Span, target: int, table: Table) -> list[Evidence]:
    """What one text claims."""
    found: list[Evidence] = []
    text = span.text[:MAX_TEXT]
    noted = _of_note(span, named=table.format in ("json", "mat", "hdf5") and target == FILE)
    key, _, rest = text.partition(":")
    if noted is not None and rest and _is_head(key.strip("#%/!; "), table) and not rest.strip()[:1].isdigit():
        noted = None  # what stands behind the name of a column describes it
    if noted is not None and noted.facet.partition(":")[2] in (
        *CONDITION_UNITS,
        "kind",
        "ignore",
        "bad_rows",
    ):
        return [noted]
    pieces = pieces_of(text, table)
    scales = [e for piece in pieces for e in _scales_of(piece, span, table)]
    if noted is not None and not (scales and noted.facet == "note"):
        found += [noted, *_bare_rest_length(noted)]
    if noted is not None and noted.facet == "condition:pressure":
        absolute = REFERENCES.get(folded(str(noted.value)), str(noted.value).lower().startswith("abs"))
        found.append(Evidence(FILE, "absolute", absolute, 6.0, span, "note"))
    if noted is not None and noted.facet == "condition:muscle":
        plain = re.split(r"[,;]\s", str(noted.value))[0]
        codes = (e.value for e in of_code(span) if e.facet == "condition:muscle")
        found[-1] = noted._replace(value=plain if ":" in plain else next(codes, plain))  # "DMSP-20:800mm"
    for piece in pieces:
        said = _of_clauses(Span(span.where, piece.text), table, piece.column)
        found += [e._replace(span=span) for e in said]
        found += _of_subject(piece, span, table)
    claims = (_of_quantity(context, target, span) for context in _contexts(text))
    found += [claim for claim in claims if claim is not None]
    for rule in rules("text"):
        for facet, value in rule.claims.items():
            if facet == "kind" and pattern_of(rule).search(folded(text)):
                found.append(Evidence(FILE, "kind", value, rule.weight, span, rule.id))
            elif facet == "si" and pattern_of(rule).search(text):
                found.append(Evidence(FILE, "si", True, rule.weight, span, rule.id))
            elif facet == "unread" and (match := pattern_of(rule).search(text)):
                found.append(
                    Evidence(FILE, facet, f"'{match[0]}' ({span.where}) is {value}", 1.0, span, rule.id)
                )
            elif facet == "role" and (match := pattern_of(rule).search(text)) and "what" in match.groupdict():
                if not any(c.value == "time" for c in head_claims(match["what"])):
                    found += [
                        Evidence(i, "role", value, rule.weight, span, rule.id)
                        for i, column in enumerate(table.columns)
                        if any(c.rule == "axis_of_a_logger" for c in head_claims(column.head[:200]))
                    ]
            elif (
                facet == "condition"
                and (match := pattern_of(rule).search(text))
                and (name := unit_of_air(match["value"]))
            ):
                unit = Unit(name, "pressure")
                quantity = Quantity(match.start(), match.end(), number_of(match["value"]), unit, match[0])
                found.append(Evidence(FILE, f"condition:{value}", quantity, rule.weight, span, rule.id))
    found += [
        *_of_description(span, table),
        *_of_legend(span, table),
        *_of_list(span, table),
        *_of_zero(span),
        *scales,
        *of_code(span),
    ]
    return [e for e in found if e is not None]


#: Unit -> what a barometer shows in it, from 2000 m above the sea to a high at the sea; none overlap.
_SHOWN_BY_BAROMETERS = {
    "bar": (0.78, 1.09), "psi": (11.3, 15.8), "inHg": (23.0, 32.3), "kPa": (78.0, 109.0),
    "mmHg": (585.0, 815.0),
    "hPa": (815.0, 1090.0), "Pa": (7.8e4, 1.09e5),
}  # fmt: skip


def unit_of_air(value: str) -> str | None:
    """The unit in which a number without one is the pressure of the air; None = in no usual one.

    >>> unit_of_air("953.1"), unit_of_air("101.3"), unit_of_air("21.5")
    ('hPa', 'kPa', None)
    """
    number = number_of(value)
    return next((unit for unit, (low, high) in _SHOWN_BY_BAROMETERS.items() if low <= number < high), None)


def _is_head(name: str, table: Table) -> bool:
    return any(column.head.strip().casefold() == name.casefold() for column in table.columns)


def _of_note(span: Span, *, named: bool = False) -> Evidence | None:
    """A condition under the name of this program: ``load_mass: 12 kg``, ``kind: static``."""
    match = _NOTE.fullmatch(span.text.strip())
    if match is None:
        return None
    key, unit = key_of(match["key"])
    value = match["value"].strip().strip('";,')
    if key in ("kind", "ignore", "bad_rows", *CONDITION_UNITS, *TEXT_CONDITIONS):
        if (
            key == "pressure"
            and folded(value) not in REFERENCES
            and not value.lower().startswith(("abs", "gau", "rel"))
        ):
            return None
        return Evidence(FILE, f"condition:{key}", f"{value} {unit}" if unit else value, 9.0, span, "note")
    if span.text.lstrip().startswith("#") or named:
        return Evidence(FILE, "note", (key, value), 1.0, span, "note")
    return None


def _bare_rest_length(noted: Evidence) -> list[Evidence]:
    """A rest length without a unit, ``L0: 250``: in the one of mm and m in which a muscle can have it."""
    key, value = noted.value if noted.facet == "note" else ("", "")
    if re.fullmatch(r"\d{1,4}(?:[.,]\d{1,4})?", value.strip()) is None:
        return []
    words = words_of(_L_ZERO.sub("L0", f"{key.replace('_', ' ')} ="))
    number = number_of(value)
    unit = next((u for u, (low, high) in _MUSCLES.items() if low <= number < high), None)
    if unit is None or (
        not word_set("l0|rest_length").among(words)
        and not (word_set("at_rest").among(words) and word_set("@length").among(words))
    ):
        return []
    quantity = Quantity(0, 0, number, Unit(unit, "length"), f"{value.strip()} {unit}")
    return [Evidence(FILE, "condition:nominal_length", quantity, 4.0, noted.span, NO_UNIT)]


NO_UNIT = "no unit"
_MUSCLES = {"m": (0.02, 5.0), "mm": (20.0, 5000.0)}  # lengths of muscles


def _scales_of(piece: Piece, span: Span, table: Table) -> list[Evidence]:
    """The calibrations in a part of a text: of the column that it is about, or of the one they fit."""
    unit = None if piece.column is None else _unit_of(table.columns[piece.column])
    raw = piece.column if unit is None or unit.dimension in RAW else None
    return [e._replace(span=span) for e in _of_scales(Span(span.where, piece.text), table, raw)]


def _of_subject(piece: Piece, span: Span, table: Table) -> list[Evidence]:
    """What a part of a text calls the column that it is about, where its head names nothing."""
    if piece.column is None:
        return []
    column = table.columns[piece.column]
    if any(c.facet == "channel" for c in head_claims(column.head[:200], column.unit)):
        return []
    words = re.split(r"[,;(]|\.\s|\d", piece.text)[0]
    return [
        _from_claim(piece.column, claim, span, 0.9)
        for claim in head_claims(words[:200])
        if claim.rule != "letter"
    ]


def _of_clauses(span: Span, table: Table, subject: int | None = None) -> list[Evidence]:
    """Signs and references that the clauses of a text say; ``subject``: the column that it is about."""
    found: list[Evidence] = []
    text = _OTHER_GAUGES.sub(" ", span.text[:MAX_TEXT])
    text = _SIGN_BEHIND.sub(lambda m: " plus" if m["sign"] else " minus", text)
    text = _SIGN_BEFORE.sub(lambda m: " plus " if m["sign"] == "+" else " minus ", text)
    owner = subject if subject is not None else _column_named(text, table)
    unit = None if subject is None else _unit_of(table.columns[subject])
    about = () if unit is None or unit.dimension not in ("pressure", "force") else (unit.dimension,)
    plain = re.sub(r"\([^()]{0,60}\)", " ", text)  # "tension (pull) is negative"
    clauses = dict.fromkeys(" ".join(c.split()) for c in (*_CLAUSES.split(text), *_CLAUSES.split(plain)))
    pieces = [(rules("clause"), clause) for clause in clauses]
    for those, clause in (*pieces, (rules("sentence"), text)):
        words = words_of(clause)
        if not words or len(words) > 40:
            continue
        words = (*words, *about)
        for rule in those:
            if all(word_set(name).among(words) for name in rule.needs) and not any(
                word_set(n).among(words) for n in rule.without
            ):
                for facet, value in rule.claims.items():
                    column = _column_named(clause, table)
                    target = column if column is not None else owner if owner is not None else FILE
                    found.append(
                        Evidence(target, facet, value, rule.weight, Span(span.where, span.text), rule.id)
                    )
    return found


def _column_named(text: str, table: Table) -> int | None:
    """The one column whose head a text begins with, or whose number it names; None = none, or several."""
    number = _CHANNEL.search(text)
    found = set()
    for i, column in enumerate(table.columns):
        head = column.head.strip()
        same = _CHANNEL.search(head) if number else None
        if number and same and (number[1] or number[2]).lower() == (same[1] or same[2]).lower():
            found.add(i)
        name = taken_apart(head, column.unit).name
        if len(name) > 0 and re.match(rf"[\s#%/*-]{{0,6}}{re.escape(name)}(?![^\W_])", text, re.IGNORECASE):
            found.add(i)
    return found.pop() if len(found) == 1 else None


def _of_quantity(context: _Context, target: int, span: Span) -> Evidence | None:
    """What a quantity is, by the words around it: the claim with most weight."""
    best: Evidence | None = None
    quantity, before, behind = context.quantity, context.before, context.behind
    if context.label and context.label != before:
        plain = _of_quantity(context._replace(label=()), target, span)
        return plain or _of_quantity(context._replace(before=context.label, label=()), target, span)
    for rule in rules("quantity"):
        after = behind or context.further if rule.both else behind
        if quantity.unit.dimension not in rule.dimension or not _fires(rule, before, after):
            continue
        ((facet, key),) = rule.claims.items()
        if (context.pressed and key == "nominal_length") or (context.ranged and facet == "held"):
            continue
        if best is None or rule.weight > best.weight:
            best = Evidence(target, f"{facet}:{key}", quantity, rule.weight, span, rule.id)
    return best


def _fires(rule: Rule, before: tuple[str, ...], behind: tuple[str, ...]) -> bool:
    """Whether the words around a quantity are those of a rule."""
    if any(word_set(name).among(before[-6:]) for name in rule.without) or "nothing" in behind:
        return False
    ahead = bool(rule.needs) and all(word_set(name).among(before) for name in rule.needs)
    after = bool(rule.behind) and all(word_set(name).among(behind) for name in rule.behind)
    after = after and not any(word_set(name).among(behind[:3]) for name in rule.without)
    return (ahead and after) if rule.both else (ahead or after)


def _of_title(span: Span, target: int) -> list[Evidence]:
    """The quantities that hold in one block; without words their unit says what they are."""
    found: list[Evidence] = []
    if _SCALED.search(span.text):
        return found
    for context in _contexts(span.text):
        evidence = _of_quantity(context, target, span)
        quantity = context.quantity
        channel = None if context.ranged else _HELD_BY.get(quantity.unit.dimension)
        if evidence is None and channel is not None:
            if channel == "length" and quantity_si(quantity.value, quantity.unit.name, "m") < _SHORT_LENGTH:
                channel = "displacement"
            facet = "condition" if channel == "load_mass" else "held"
            evidence = Evidence(target, f"{facet}:{channel}", quantity, 2.0, span, "bare")
        if evidence is not None:
            found.append(evidence)
    clauses = _of_clauses(span, Table((), (), np.zeros(0, np.intp)))
    return [*found, *(e._replace(target=target) if e.target == FILE else e for e in clauses)]


_HELD_STEM = re.compile(r"(?i)(?<![^\W\d_])(?:iso(?![^\W\d_])|isometr|clamped|eingespannt)")


def _of_name(span: Span) -> list[Evidence]:
    """What the name of the file, or of its sheet, says: ``Zug_1,5bar``, ``step_L360mm``, ``load20kg``."""
    stem = span.text
    found: list[Evidence] = []
    text = re.sub(r"(?<=\d)_(?=[A-Za-zµ])", " ", re.sub(r"(?<=\d)p(?=\d)", ".", stem))
    for context in _contexts(text):
        quantity = context.quantity
        evidence = _of_quantity(context, FILE, span)
        if (
            quantity.unit.dimension == "length"
            and context.before[-1:] in (("l",), ("length",))
            and not _HELD_STEM.search(stem)
        ):
            found.append(Evidence(FILE, "condition:nominal_length", quantity, 1.5, span, "name"))
        if evidence is None and not context.ranged:
            channel = _HELD_BY.get(quantity.unit.dimension)
            if channel in ("pressure", "length"):
                evidence = Evidence(FILE, f"held:{channel}", quantity, 1.5, span, "name")
            elif channel == "load_mass":
                evidence = Evidence(FILE, "condition:load_mass", quantity, 2.0, span, "name")
        if evidence is not None:
            found.append(evidence._replace(weight=min(evidence.weight, 2.5), rule="name"))
    found += [e._replace(weight=0.5 * e.weight) for e in of_code(span)]
    return found


@cache
def known_muscles() -> frozenset[str]:
    """Ids of the muscles that come with the program."""
    return frozenset(path.stem.upper() for path in (presets_folder() / "muscles").glob("*.json"))


def of_code(span: Span) -> list[Evidence]:
    """Muscle and rest length in an order code of a known muscle: ``DMSP-20-250N`` is 250 mm of a DMSP-20."""
    found: list[Evidence] = []
    for match in _CODE.finditer(span.text[:MAX_TEXT].replace("_", "-")):
        code = f"{match[1]}-{match[2]}".upper()
        if code in known_muscles():
            found.append(Evidence(FILE, "condition:muscle", code, 3.0, span, "order code"))
            if match[3]:
                length = Quantity(match.start(), match.end(), float(match[3]), Unit("mm", "length"), match[0])
                found.append(Evidence(FILE, "condition:nominal_length", length, 2.5, span, "order code"))
    return found


def _of_legend(span: Span, table: Table) -> list[Evidence]:
    """Units that a text gives to columns by their names: ``units: t[ms] p[mbar, gauge]``."""
    found: list[Evidence] = []
    rule = _text_rule("legend")
    for match in pattern_of(rule).finditer(span.text[:MAX_TEXT]):
        words = match["unit"].split()
        unit = unit_of(match["unit"]) or (unit_of(words[0]) if words else None)
        for i, column in enumerate(table.columns):
            if unit is not None and column.head.strip() == match["head"] and _unit_of(column) is None:
                more = f"{' '.join(words[1:])} {match['more'] or ''}".strip()
                made = Column(f"{column.head} {more}", np.zeros(0), span.where, unit.name)
                found += [
                    e._replace(span=span)
                    for e in of_column(i, made)
                    if e.facet != "channel" or e.rule != "letter"
                ]
                if unit.absolute is not None:
                    found.append(Evidence(i, "absolute", unit.absolute, rule.weight, span, rule.id))
    return found


_DESCRIBES = re.compile(
    r"\s{0,3}(?P<link>[=:]|\s(?:in|is|unit|units|dtype)\s?=?:?)\s?(?P<words>[^,;=|]{1,80})|\s{1,3}(?P<bracket>\[[^\[\]]{1,20}\])"
)
_UNIT_BEHIND = re.compile(r",\s{0,3}(?P<unit>[^\s,;|]{1,12})\s{0,3}(?:[,;|]|$)")
_UNIT_KEY = re.compile(r"(?i)(?<![^\W_])units?\s?[=:]\s?(?P<unit>\S{1,12})")


def _of_description(span: Span, table: Table) -> list[Evidence]:
    """What a text says of a column by its name: ``p = Absolutdruck in mbar``, ``time in s``, ``/rig/p:
    kPa``.
    """
    found: list[Evidence] = []
    text = span.text[:MAX_TEXT]
    for i, column in enumerate(table.columns):
        head = column.head.strip()
        name = taken_apart(head, column.unit).name
        if not name or len(name) > 40 or name[0].isdigit():
            continue
        place = re.search(rf"(?<![^\W_])(?<!_){re.escape(name)}(?![^\W_])", text)
        if place is None:
            continue
        at = place.start()
        match = _DESCRIBES.match(text, at + len(name))
        if match is None:
            continue
        words = (match["bracket"] or match["words"]).strip()
        key = _UNIT_KEY.search(text, at)
        unit = (
            (unit_of(key["unit"]) if key else None)
            or unit_of(words)
            or unit_of(
                words.split()[0] if match["link"] and match["link"].strip() in ("in", "unit", "units") else ""
            )
        )
        apart = taken_apart(words)
        behind = _UNIT_BEHIND.match(text, match.end())
        unit = unit or apart.unit or (unit_of(behind["unit"]) if behind else None)
        if unit is not None and not unit.dimension:
            unit = None
        if (
            _unit_of(column) is None
            and unit is not None
            and (key or not any(c.isdigit() for c in words.split("[")[0][:20].split(" ")[0]))
        ):
            made = Column(
                f"{head} {words}" if not unit_of(words) else head, np.zeros(0), span.where, unit.name
            )
            found += [
                e._replace(span=span)
                for e in of_column(i, made)
                if e.facet in ("unit", "channel", "absolute", "sign_stroke", "sign_force")
                and e.rule != "letter"
            ]
            if unit.absolute is not None:
                found.append(Evidence(i, "absolute", unit.absolute, _UNIT_STATED, span, "description"))
        elif unit is None and match["words"] and not head_claims(head[:200], column.unit):
            found += [
                _from_claim(i, c, span, 0.9)
                for c in head_claims(words[:200])
                if c.facet == "channel" and c.rule != "letter"
            ]
        if apart.absolute is not None and match["words"] and taken_apart(head, column.unit).absolute is None:
            found.append(Evidence(i, "absolute", apart.absolute, _UNIT_STATED, span, "description"))
    return found


def _of_list(span: Span, table: Table) -> list[Evidence]:
    """Names that a text gives to columns by their numbers, where they have none of their own."""
    found: list[Evidence] = []
    rule = _text_rule("column_list")
    for match in pattern_of(rule).finditer(span.text[:MAX_TEXT]):
        for i in _numbered(int(match["number"]), table):
            words = re.sub(r"\s+in\s+(\S{1,8})$", r" [\1]", match["words"].strip())
            made = Column(words, np.zeros(0), span.where)
            found += [e._replace(span=span) for e in of_column(i, made) if e.rule not in ("words", "counts")]
    return found


def _numbered(number: int, table: Table) -> Iterator[int]:
    """The column that a number means: one whose head has it, else that place, where no head names a
    channel.
    """
    heads = [c.head for c in table.columns]
    named = [
        i
        for i, h in enumerate(heads)
        if re.search(rf"(?i)(?:ch|channel|kanal|ai|column|col|spalte)[ _-]?{number}(?!\d)", h)
    ]
    if len(named) == 1:
        yield named[0]
    elif 0 < number <= len(heads) and not any(
        c.facet == "channel" for c in head_claims(heads[number - 1][:200])
    ):
        yield number - 1


def _of_zero(span: Span) -> list[Evidence]:
    """The reading of a sensor at the rest length."""
    rule = _text_rule("zero_reading")
    match = pattern_of(rule).search(span.text[:MAX_TEXT])
    unit = unit_of(match["unit"]) if match else None
    if match is None or unit is None:
        return []
    value = quantity_si(float(match["value"].replace(",", ".")), unit.name, "m")
    return [Evidence(FILE, "zero:displacement", value, rule.weight, span, rule.id)]


def _of_scales(span: Span, table: Table, subject: int | None) -> list[Evidence]:
    """Calibrations of raw columns; ``subject``: the one that the text is about."""
    found = []
    for scale, around in scales_in(span.text[:MAX_TEXT]):
        i = _scaled_column(scale, around, table) if subject is None else subject
        if i is not None:
            found.append(Evidence(i, "scale", scale, scale.weight, span, scale.rule))
            channels = (
                [c for c, _ in BY_UNIT.get(_dimension(scale.unit), ())]
                if scale.rule != "valve states"
                else ["command"]
            )
            if scale.raw == "count" and not scale.offset and "displacement" in channels:
                channels = ["displacement"]  # where its counts begin, is not known
                found.append(Evidence(i, "zero_open", True, 2.0, span, "counts"))
            claims = {
                c.value
                for c in head_claims(table.columns[i].head[:200], table.columns[i].unit)
                if c.facet == "channel"
            }
            if not claims & set(channels):
                found += [
                    Evidence(i, "channel", c, 3.0 if c != "length" else 1.0, span, "scale") for c in channels
                ]
            found += [_from_claim(i, c, span, 1.0) for c in head_claims(scale.name) if c.facet == "channel"]
            if scale.absolute is not None:
                found.append(Evidence(i, "absolute", scale.absolute, scale.weight, span, scale.rule))
    return found


def _scaled_column(scale: Scale, around: str, table: Table) -> int | None:
    """The raw column that a calibration is of: it is named beside it, or it is called like what it leads
    to.
    """
    words = set(words_of(around))
    scores: list[tuple[float, int]] = []
    channels = {c for c, _ in BY_UNIT.get(_dimension(scale.unit), ())} | (
        {"displacement", "length"} if _dimension(scale.unit) == "length" else set()
    )
    named = _column_named(around, table)
    for i, column in enumerate(table.columns):
        unit = _unit_of(column)
        raw = (
            unit is None
            or unit.dimension in RAW
            or (unit.name == "%" and (scale.raw == "%" or scale.rule == "valve states"))
        )
        if column.words is not None or column.clock or not raw:
            continue
        claims = {c.value for c in head_claims(column.head[:200], column.unit) if c.facet == "channel"}
        if scale.rule == "valve states" and "command" not in claims and named != i:
            continue
        served = _is_served(_dimension(scale.unit), table)
        if claims and not claims & channels and ("command" not in claims or served):
            continue  # a command says what was wanted of what another column shows
        head = words_of(taken_apart(column.head, column.unit).name)
        score = 2.0 * bool(claims & channels) + 1.5 * len(words & set(head)) + (3.0 if named == i else 0.0)
        score += 4.0 if scale.raw and scale.raw == taken_apart(column.head, column.unit).name else 0.0
        score += 0.5 if unit is not None and scale.raw and unit.name == scale.raw else 0.0
        scores.append((score, i))
    if not scores:
        return None
    if len(scores) == 1 and scale.raw and not _is_served(_dimension(scale.unit), table):
        of_one = _unit_of(table.columns[scores[0][1]])
        scores = [(scores[0][0] + 1.0 * (of_one is not None and of_one.name == scale.raw), scores[0][1])]
    best, i = max(scores)
    return i if best >= 1.5 and sum(s == best for s, _ in scores) == 1 else None


_BRIDGED = re.compile(r"(?<![\w.,])(?P<output>\d{1,3}(?:[.,]\d{1,6})?)\s?mV\s?/\s?V(?![\w/])")
NO_ZERO = "rated load, no zero"  # a load cell whose reading without a load is not known
_RATED = re.compile(r"(?<![\w.,])(?P<value>\d{1,7}(?:[.,]\d{1,4})?)\s?(?P<unit>[^\W\d_]{1,4})(?![\w/])")


def of_bridge(table: Table) -> list[Evidence]:
    """The scale of the only column in mV/V, by the output of its load cell at the rated load; both may stand
    in texts of their own.
    """
    raw = [i for i, c in enumerate(table.columns) if (unit := _unit_of(c)) and unit.dimension == "bridge"]
    outputs: dict[float, Span] = {}
    loads: dict[float, tuple[Span, float, str]] = {}
    zeros: set[float] = set()
    balanced = False
    for span in table.texts if len(raw) == 1 else ():
        text = span.text[:MAX_TEXT]
        balanced |= word_set("balanced|zero_offset").among(words_of(text))
        bridged = list(_BRIDGED.finditer(text))
        for match in bridged:
            before = re.split(r"[,;.(]\s", text[: match.start()])[-1]
            value = number_of(match["output"])
            if word_set("zero_offset").among(words_of(before)):
                zeros.add(value)
            elif value:
                outputs.setdefault(value, span)
        if bridged or word_set("rated").among(words_of(text)):
            for match in _RATED.finditer(_BRIDGED.sub(" ", text)):
                unit = unit_of(match["unit"])
                if unit is not None and unit.dimension in ("force", "mass"):
                    value = number_of(match["value"])
                    loads.setdefault(
                        quantity_si(value, unit.name, "N" if unit.dimension == "force" else "kg"),
                        (span, value, unit.name),
                    )
    if len(outputs) != 1 or len(loads) != 1 or len(zeros) > 1:
        return []
    (output,), ((span, load, unit_name),) = outputs, loads.values()
    rule = "rated load" if balanced or zeros else NO_ZERO
    scale = Scale(load / output, next(iter(zeros), 0.0), unit_name, BRIDGE, rule, _TEXTS, span.text[:80])
    return [
        Evidence(raw[0], "scale", scale, _TEXTS, span, rule),
        Evidence(raw[0], "channel", "force", 3.0, span, rule),
    ]


def _is_served(dimension: str, table: Table) -> bool:
    """Whether another column is in a unit of a dimension."""
    return any(
        (unit := _unit_of(column)) is not None and unit.dimension == dimension for column in table.columns
    )


def _dimension(unit: str) -> str:
    found = unit_of(unit)
    return "" if found is None else found.dimension


def _text_rule(id: str) -> Rule:
    return next(rule for rule in rules("text") if rule.id == id)
