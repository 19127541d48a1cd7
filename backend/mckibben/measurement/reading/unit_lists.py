"""Names and units of the columns of a table that stand together in one place: a list, a text that lists them,
or pairs of name and unit.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from mckibben.measurement.reading.heads import head_claims, head_score
from mckibben.measurement.reading.lexicon import word_set, words_of
from mckibben.measurement.reading.units import FITTING, unit_of

_PAIR = re.compile(r"\s*(?P<name>[^:=]+?)\s*(?:[:=]|->)\s*(?P<unit>.*?)\s*")
_MORE_WORDS = 2  # beside "unit" in the name of an attribute: "unit_label", "unité de mesure"


def names_units(key: str) -> bool:
    """Whether the name of an attribute or field says that it holds units: ``units``, ``Einheiten``."""
    words = words_of(key)
    return len(words) <= 1 + _MORE_WORDS and any(word in word_set("unit").words for word in words)


def units_said(said: Mapping[str, object]) -> dict[tuple[str, ...], str]:
    """Words of a name -> the unit that an entry of its own says of it: ``F_unit``, ``unidade_F``."""
    found: dict[tuple[str, ...], str] = {}
    for key, value in said.items():
        if isinstance(value, str) and unit_of(value) is not None:
            words = words_of(key)
            own = tuple(word for word in words if word not in word_set("unit").words)
            if len(own) < len(words):
                found.setdefault(own, value)
    return found


def unit_said(name: str, said: Mapping[str, object]) -> str | None:
    """The unit that an entry of its own says of a name; None without one."""
    return units_said(said).get(words_of(name))


def unit_among(name: str, attributes: Mapping[str, object]) -> str | None:
    """The unit of a variable among its attributes: the one that says so, else the only one that fits."""
    texts = {key: value.strip() for key, value in attributes.items() if isinstance(value, str)}
    for key, text in texts.items():
        if names_units(key) and unit_of(text) is not None:
            return text
    fitting = {text for text in texts.values() if _can_be_unit(name, text)}
    return fitting.pop() if len(fitting) == 1 else None


def _can_be_unit(name: str, text: str) -> bool:
    unit = unit_of(text)
    channels = [claim.value for claim in head_claims(name) if claim.facet == "channel"]
    fitting = [d for channel in channels for d in FITTING[channel]] or _CARRIED
    return unit is not None and unit.dimension in fitting


_CARRIED = ["pressure", "force"]  # what is hardly ever written for something else


def names_of_columns(said: Mapping[str, object]) -> Iterator[list[str]]:
    """The lists of names beside a table: lists of texts, and texts that list them, ``"time, force"``, more
    than half of which name a quantity.
    """
    for key, value in said.items():
        if names_units(key):
            continue
        if isinstance(value, list | tuple) and value and all(isinstance(v, str) for v in value):
            yield [v.strip() for v in value]
        elif isinstance(value, str) and (names := _names_in(value)):
            yield names


def _names_in(text: str) -> list[str]:
    """The names that a text lists; [] = it lists none."""
    for sign in (r"[;|\t\n]", r","):
        parts = [part.strip().strip("\"'") for part in re.split(sign, text.strip().strip("{}[]()"))]
        named = sum(len(part) <= _LONGEST_NAME and head_score(part) > 0.0 for part in parts)
        if len(parts) > 1 and all(parts) and named > len(parts) // 2:
            return parts
    return []


_LONGEST_NAME = 40


def units_of_columns(names: Sequence[str], said: Mapping[str, object]) -> list[str | None]:
    """The unit of each column as what stands beside the table says; None where nothing does.

    It is a list of as many units, a text of one (``"s, bar, N"``), a text of pairs (``"t: s, F: N"``), or an
    entry of its own (``F_unit``, ``FIELD_1_UNITS``).
    """
    for key, value in said.items():
        if not names_units(key):
            continue
        if isinstance(value, list | tuple) and len(value) == len(names):
            return [str(unit) for unit in value]
        if isinstance(value, str) and (found := _of_text(names, value)) is not None:
            return found
    return [_own(number, name, said) for number, name in enumerate(names)]


def _of_text(names: Sequence[str], text: str) -> list[str | None] | None:
    bare = text.strip().strip("{}[]()")
    for sign in (r"[;|\n]", r",", r"\s+"):
        parts = [part.strip().strip("\"'") for part in re.split(sign, bare)]
        pairs = [_PAIR.fullmatch(part.replace('"', "").replace("'", "")) for part in parts if part]
        by_name = {pair["name"]: pair["unit"] for pair in pairs if pair is not None}
        if sum(name in by_name for name in names) > 1:
            return [by_name.get(name) for name in names]
        if (
            len(parts) == len(names) > 1
            and sum(unit_of(part) is not None for part in parts) > len(parts) // 2
        ):
            return list(parts)
    return None


def _own(number: int, name: str, said: Mapping[str, object]) -> str | None:
    for key in (f"{name}_unit", f"{name}_units", f"FIELD_{number}_UNIT", f"FIELD_{number}_UNITS"):
        if isinstance(value := said.get(key), str):
            return value
    return unit_said(name, said)
