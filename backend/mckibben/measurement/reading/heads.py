"""A head of a column taken apart: its name, its unit, what a pressure counts from; and what its words
claim.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any, NamedTuple

from mckibben.measurement.reading.lexicon import EXACT, Rule, rules, word_set, words_of
from mckibben.measurement.reading.units import FITTING, RAW, Unit, dimension_of, reference_of, unit_of

_LAST = re.compile(r"(.*?)\s*[\[({<]([^\[\](){}<>]{0,60}(?:\([^()]{0,20}\))?)[\])}>]\s*")
_WITHIN = re.compile(r"[\[({<]([^\[\](){}<>]{1,40}(?:\([^()]{0,20}\))?)[\])}>](?=[\s,;:./]|$)")
_BEHIND = (
    re.compile(r"([^/]+)\s?/\s?([^/]+)"),
    re.compile(r"(.+),\s?([^,]+)"),
    re.compile(r"(.+)\s(?:in|en|em|v|w)\s(\S+)"),
    re.compile(r"([^:]+):\s?(\S{1,8})"),
)
_SURE = frozenset([
    "mm", "cm", "bar", "mbar", "kPa", "MPa", "hPa", "mmHg", "inHg", "psi", "kN", "daN", "cN", "mN", "lbf",
    "ozf", "kgf", "gf", "ms", "mV", "kg", "pct", "percent", "promille", "permille", "deg", "degC", "degF",
    "psig", "psia", "barg", "bara", "Hz", "kHz", "rpm",
])  # fmt: skip  # no name ends like them
#: "0.1 N", "1e-3 bar": what one count is.
_PART_OF_UNIT = re.compile(r"(?P<share>0[.,]0{0,5}1|1[eE]-\d)\s?\*?\s?(?P<unit>[^\W\d_]{1,5})")
_RUN = re.compile(
    r"(?P<name>.*?[^\W\d_].*?)[\s_,;:-]{1,3}(?P<word>[^\W\d_]+)[\s_]?(?:#|n[or]\.?)?[\s_]?(?P<number>\d{1,3})"
    r"(?:\s?(?P<unit>[\[(][^\[\]()]{1,20}[\])]))?",
    re.I,
)
_MORE_RUNS = frozenset(["run", "trial", "test", "series", "messung", "block"])
#: "ΔL/L0", "(L0-L)/L0": the change of length as a share of the rest length.
_SHARE = re.compile(
    r"(?:.{0,40}[=:\s])?"
    r"(?:(?P<longer>(?:d|Δ|∆|δ|delta[ _]?|Delta[ _]?)[Ll]|\(\s?[Ll]\s?[-−–]\s?[Ll]_?[0₀o]\s?\))"
    r"|\(\s?[Ll]_?[0₀o]\s?[-−–]\s?[Ll]\s?\))\s?/\s?[Ll]_?[0₀o]"
)
_CHANGE = re.compile(r"(?:d|Δ|∆|δ|delta|Delta)[ _]?([Llxs])(?![^\W\d_])")
_DESIRED = re.compile(r"[A-Za-z][0-9]?[ _]?des(?![^\W\d_])")
_VALUE = re.compile(r"[^\W\d_]{1,12}0?\s?[=≈]\s?\d{1,6}(?:[.,]\d{1,6})?\s?[^\W\d_%]{0,4}%?")
_LETTER = re.compile(r"([a-zκε])\d{0,2}")
_LETTERS = {
    "t": "time", "p": "pressure", "f": "force", "l": "length", "x": "displacement", "s": "displacement",
    "d": "diameter", "v": "velocity", "u": "command", "h": "contraction", "k": "contraction",
    "κ": "contraction",
    "ε": "contraction", "e": "contraction",
}  # fmt: skip
_SIGNAL = re.compile(r"([UuVvIi]|(?i:adc|raw|ain|counts?|volts?))_?([pPFfLlsx])\d{0,2}")
_SHARES = frozenset(["h", "k", "e", "ε", "κ", "eps", "epsilon", "kappa"])
_ALONE = frozenset("tpflxdvuκε")  # letters that name a channel without a unit
_VOLTAGES = frozenset(["u", "v", "uout", "vout"])
_LONGEST = 200  # characters of a head that are looked at
_NO_FORCE = ("出力", "入力", "能力", "电力", "電力", "功力")  # "output": no word of a force
_QUANTITY_FIRST = re.compile(r"\d{1,12}(?:[.,]\d{1,9})?\s?[^\W\d_%]{1,6}")
_MOST = 3.0  # nats that the words of a head add to its score


class Head(NamedTuple):
    """A head taken apart: its name without its unit, the unit, whether it says absolute or gauge, and how
    much of the unit one is: 0.1 of "[0.1 N]".
    """

    name: str
    unit: Unit | None
    absolute: bool | None
    share: float = 1.0


class Claim(NamedTuple):
    """What a word of a head claims."""

    facet: str
    value: Any
    weight: float
    rule: str


@lru_cache(maxsize=8192)
def taken_apart(head: str, unit_below: str = "") -> Head:
    """A head into name, unit and reference.

    Units stand in brackets, at the end or before words such as a run, behind ``/``, a comma or "in", behind
    ``_``
    or a blank, or in a cell of their own.

    >>> taken_apart("Druck [bar] (abs)")
    Head(name='Druck', unit=Unit(name='bar', dimension='pressure', absolute=None), absolute=True, share=1.0)
    """
    text = " ".join(head[:_LONGEST].split())
    unit: Unit | None = None
    absolute: bool | None = None
    share = 1.0
    for _ in range(4):
        found = _LAST.fullmatch(text)
        if found is None:
            break
        inside = found[2].strip()
        mark = reference_of(inside)
        if mark is not None and (
            len(inside) > 1 or not inside.isascii() or "pressure" in _channels_of(found[1])
        ):
            absolute = mark
        elif (inner := unit_of(inside) or _first_unit(inside)) is not None and unit is None:
            unit = inner
        elif unit is None and (part := _PART_OF_UNIT.fullmatch(inside)) and (inner := unit_of(part["unit"])):
            unit, share = inner, float(part["share"].replace(",", "."))
        elif inside:
            text = f"{found[1]} {inside}".strip()
            continue
        text = found[1]
    if unit is None:
        text, unit = _within(text)
    below = (unit_of(unit_below) or _first_unit(unit_below)) if unit_below else None
    if unit is None:
        name, behind = _behind(text)
        # A unit that stands apart says more than a letter behind a name: "L_m" in mm.
        apart = below is not None and behind is not None and below.dimension == behind.dimension
        text, unit = (text, below) if apart and below != behind else (name, behind)
    if unit is None and unit_below:
        unit = below
        if unit is None and (part := _PART_OF_UNIT.fullmatch(unit_below.strip(" []()"))):
            unit, share = unit_of(part["unit"]), float(part["share"].replace(",", "."))
    if unit is not None and unit.absolute is not None:
        absolute = unit.absolute
    if absolute is None:
        absolute = _reference_among(words_of(text))
    return Head(text.strip(" _:,"), unit, absolute, share)


def _channels_of(name: str) -> set[Any]:
    """The channels that the words, or a letter with its unit, of a name may stand for."""
    words = words_of(name)
    letters = {_LETTERS[m[1]] for word in words if (m := _LETTER.fullmatch(word)) and m[1] in _LETTERS}
    return {claim.value for claim in _of_words(words) if claim.facet == "channel"} | letters


def _first_unit(text: str) -> Unit | None:
    """The unit before a comma or a blank: ``[bar, gauge]``, ``[mm shortening]``, ``(in ms)``."""
    words = [word for word in re.split(r"[\s,;]+", text) if word]
    if len(words) > 1 and words[0].lower() == "in":
        return unit_of(words[1])
    first = unit_of(words[0]) if len(words) > 1 else None
    if first is None or first.dimension in ("", "ratio") or words[0].lower() in ("in", "a", "at"):
        return None
    mark = _reference_among(words_of(text))
    return first if mark is None or first.dimension != "pressure" else first._replace(absolute=mark)


def _reference_among(words: tuple[str, ...]) -> bool | None:
    said = {
        name == "absolute"
        for name in ("absolute", "gauge")
        if word_set(name).among(w for w in words if len(w) > 2)
    }
    return said.pop() if len(said) == 1 else None


def _within(text: str) -> tuple[str, Unit | None]:
    """The one unit in brackets before other words: "Length (mm) inflating"."""
    found = [
        (match, unit)
        for match in _WITHIN.finditer(text)
        if (unit := unit_of(match[1])) is not None
        and reference_of(match[1]) is None
        and match[1].strip().lower() != "in"
        and not match[1].strip().isdigit()
    ]
    if len({unit.name for _, unit in found}) != 1:
        return text, None
    match, unit = found[0]
    return " ".join(f"{text[: match.start()]} {text[match.end() :]}".split()), unit


def _behind(text: str) -> tuple[str, Unit | None]:
    """The unit behind ``/``, a comma, "in", ``:``, ``_`` or a blank, and the text before it."""
    last = re.split(r"[_\s]", text)[-1]
    direct = "/" in last and unit_of(last) is not None and last != text
    for pattern in () if text.startswith("/") or direct else _BEHIND:
        found = pattern.fullmatch(text)
        unit = unit_of(found[2]) if found else None
        if found and unit is not None and found[2].strip() not in ("1", "-"):
            return found[1].strip(), unit
    bare = text.strip("_ ")
    for sign in ("_", " ", "."):
        name, parted, last = bare.rpartition(sign)
        if not parted or not name:
            continue
        unit = unit_of(last) or (unit_of("N") if last == "n" else None)
        before, again, more = name.rpartition(sign)
        if unit is None and again and (joined := unit_of(f"{more} {last}")) is not None:
            return before, joined
        if unit is not None and _is_sure(name, last, unit):
            return name, unit
    for token in bare.split("_")[1:-1]:  # "pressure_bar_unclipped"
        unit = unit_of(token) if token in _SURE else None
        if unit is not None and any(unit.dimension in FITTING[c] for c in _channels_of(bare) if c in FITTING):
            return bare.replace(f"_{token}", "", 1), unit
    alone = unit_of(bare)
    if alone is not None and (
        bare.lower().startswith("psi") or (alone.dimension == "time" and len(bare) > 1)
    ):
        return text, alone
    return text, None


def _is_sure(name: str, text: str, unit: Unit) -> bool:
    """Whether a last word is a unit: "Force_N" is, "Sensor A" and "p at" are not."""
    words = words_of(name)
    named = {claim.value for claim in _of_words(words) if claim.facet == "channel"}
    if any(unit.dimension in FITTING[channel] for channel in named):
        return True
    letters = {_LETTERS[m[1]] for word in words if (m := _LETTER.fullmatch(word)) and m[1] in _LETTERS}
    if any(unit.dimension in FITTING[channel] for channel in letters):
        return True
    if text in ("V", "mV", "mA") and (named or (words[:1] and words[0] in _VOLTAGES)):
        return True
    return text in _SURE


def without_run(name: str) -> tuple[str, str]:
    """A name without the number of the run behind it, and that number ("" = it has none).

    >>> without_run("Pressure (kPa) Run #2")
    ('Pressure (kPa)', '2')
    """
    found = _RUN.fullmatch(name.strip()[:_LONGEST])
    if found is None or not counts_runs(found["word"]):
        return name, ""
    return f"{found['name'].strip(' _,;:-')} {found['unit'] or ''}".strip(), found["number"]


def counts_runs(word: str) -> bool:
    """Whether a number behind a word counts runs: "run 12", "Versuch 3"."""
    plain = words_of(word)
    return bool(plain) and (plain[0] in _MORE_RUNS or any(c.value == "group" for c in _of_words(plain)))


#: Rule -> dimensions of the unit that a head must have for it.
_DIMENSIONS = {rule.id: rule.dimension for rule in rules("head") if rule.dimension}


_AT_THE_VALVE = next(rule.words for rule in rules("head") if rule.id == "at_the_valve" and rule.words)


@lru_cache(maxsize=8192)
def head_claims(head: str, unit_below: str = "") -> tuple[Claim, ...]:
    """What the words of a head claim; a unit has been taken off."""
    apart = taken_apart(head, unit_below)
    dimension = apart.unit.dimension if apart.unit else ""
    name = without_run(apart.name)[0]
    if _VALUE.fullmatch(head.strip()):
        return (Claim("role", "a value", 6.0, "a value"),)
    if (share := _SHARE.fullmatch(name)) is not None and dimension in ("", "ratio"):
        claims = [Claim("channel", "contraction", 4.0, "change of length")]
        return tuple(
            [*claims, Claim("sign_stroke", -1, 3.0, "change of length")] if share["longer"] else claims
        )
    words = words_of(name)
    found = [
        c for c in _of_words(words) if not (needed := _DIMENSIONS.get(c.rule, ())) or dimension in needed
    ]
    for rule in rules("head"):
        if rule.pattern is not None and rule.pattern.match(head.strip()):
            found += [Claim(facet, value, rule.weight, rule.id) for facet, value in rule.claims.items()]
    if _DESIRED.search(name):
        found.append(Claim("role", "set value", 4.0, "desired"))
    if dimension in RAW:
        found.append(Claim("role", "raw", 6.0, "raw signal"))
    channels = {claim.value for claim in found if claim.facet == "channel"}
    if channels and dimension:
        found = [claim for claim in found if claim.value != "running number"]
    commanded = "command" in channels and any(  # and not only named after the valve
        word_set("@command").knows(word) and not _AT_THE_VALVE.knows(word) for word in words
    )
    if commanded and dimension in ("pressure", "length", "force"):
        found.append(Claim("role", "set value", 4.0, "command in a physical unit"))
    if (
        dimension == "ratio"
        and apart.unit is not None
        and apart.unit.name != "1"
        and channels & {"pressure", "force", "length"}
        and not channels & {"contraction", "command", "displacement"}
    ):
        found.append(Claim("role", "raw", 4.0, "share of a range"))
    if "contraction" in channels and dimension == "length":
        found += [
            Claim("channel", "displacement", 2.8, "contraction as a length"),
            Claim("sign_stroke", 1, 2.0, "contraction as a length"),
        ]
    if "displacement" in channels and dimension == "ratio":
        found.append(Claim("channel", "contraction", 2.5, "stroke as a share"))
    if (change := _CHANGE.match(name)) is not None and dimension in ("", "length"):
        found = [claim for claim in found if claim.facet != "channel"]
        found.append(Claim("channel", "displacement", 3.0, "change"))
        if change[1] in "Ll":
            found.append(Claim("sign_stroke", -1, 2.5, "change"))
    if not any(claim.facet == "channel" for claim in found):
        found += _of_letters(name, words, dimension)
    return tuple(found)


def _of_letters(name: str, words: tuple[str, ...], dimension: str) -> list[Claim]:
    """A letter with its unit, "F1 [N]", "s / mm", or alone in a head."""
    if name == "T" and dimension != "time":
        return [Claim("channel", "temperature", 2.0, "letter")] if dimension in ("temperature", "") else []
    signal = _SIGNAL.fullmatch(name)
    if signal is not None and (dimension in RAW or (not dimension and len(signal[1]) > 1)):
        return [Claim("channel", _LETTERS[signal[2].lower()], 2.0, "letter")]  # "U_p", "adc_F"
    if dimension in RAW:
        return []
    if not dimension and "." in name.strip("."):  # "muscle.p": the last part of a path
        words = words_of(name.strip(".").rpartition(".")[2])
    for word in words:
        match = _LETTER.fullmatch(word)
        letter = match[1] if match else word if word in _SHARES else ""
        channel = "contraction" if letter in _SHARES and dimension == "ratio" else _LETTERS.get(letter)
        if channel is None:
            continue
        if dimension and dimension in FITTING[channel]:
            return [Claim("channel", channel, 2.5, "letter")]
        if not dimension and len(words) == 1 and letter in _ALONE:
            return [Claim("channel", channel, 2.0, "letter")]
    return []


@lru_cache(maxsize=8192)
def _of_words(words: tuple[str, ...]) -> tuple[Claim, ...]:
    """What the words claim; of several channels the last one a little more, since it says what it is."""
    found: dict[str, tuple[Rule, float]] = {}
    channels: dict[str, float] = {}
    joined = ("".join(words),) if len(words) == 2 and len("".join(words)) > 3 else ()  # "X_Value"
    for place, word in enumerate((*words[:40], *joined)):
        ranked = [(rule, rule.words.strength(word)) for rule in rules("head") if rule.words is not None]
        ranked = [(rule, strength) for rule, strength in ranked if strength]
        of_channel = [(s, r) for r, s in ranked if "channel" in r.claims and not word.endswith(_NO_FORCE)]
        if of_channel:
            best = max(strength for strength, _ in of_channel)
            for strength, rule in of_channel:
                if strength == best:  # the longest part of a compound says what it is
                    channels[rule.id] = place
                    found[rule.id] = rule, rule.weight * (1.0 if strength > EXACT else 0.9)
        for rule, strength in ranked:
            alone = len(word) > 1 or len(words) == 1 or word == "#"  # a letter of "i.O.?" says nothing
            if "channel" not in rule.claims and strength > EXACT and alone:
                found[rule.id] = rule, rule.weight
        if not any("role" in rule.claims and s > EXACT for rule, s in ranked):
            for rule in _compound_roles(word):
                found[rule.id] = rule, rule.weight
    last = max(channels.values(), default=0)
    claims = []
    for rule, weight in found.values():
        more = (
            0.4
            if rule.id in channels and channels[rule.id] == last and len(set(channels.values())) > 1
            else 0.0
        )
        claims += [Claim(facet, value, weight + more, rule.id) for facet, value in rule.claims.items()]
    return tuple(claims)


def _compound_roles(word: str) -> list[Rule]:
    """The roles of a compound whose rest names a channel: "Solldruck" is a set value, "Sollwert" is one by
    itself.
    """
    if word and word[0] >= "\u3000":
        return [
            rule
            for rule in rules("head")
            if "role" in rule.claims and rule.words is not None and rule.words.inside(word) > 1
        ]
    found = []
    for rule in rules("head"):
        if "role" not in rule.claims or rule.words is None:
            continue
        for end in range(4, len(word)):
            if word[:end] in rule.words.joining and _names_channel(word[end:].removeprefix("s")):
                found.append(rule)
                break
    return found


@lru_cache(maxsize=8192)
def _names_channel(word: str) -> bool:
    return any(
        rule.words is not None and "channel" in rule.claims and rule.words.strength(word)
        for rule in rules("head")
    )


def head_score(head: str, unit: str = "") -> float:
    """What a head says of channels [nats]; with it the layout tells heads from other texts."""
    if (head[:1].isdigit() and _QUANTITY_FIRST.match(head)) or _VALUE.fullmatch(head.strip()):
        return 0.0
    apart = taken_apart(head, unit)
    best = max((c.weight for c in head_claims(head, unit) if c.facet in ("channel", "role")), default=0.0)
    if apart.unit is None or not dimension_of(apart.unit.name):
        return min(_MOST, best)
    return min(_MOST, best) + (1.0 if apart.unit.dimension not in RAW else -1.0)
