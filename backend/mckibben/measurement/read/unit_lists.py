"""Units of the columns of a table that stand together in one place: a list, or pairs of name and unit."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from mckibben.measurement.read.unit_words import unit_of

_PAIR = re.compile(r"\s*(?P<name>[^:=]+?)\s*(?:[:=]|->)\s*(?P<unit>.*?)\s*")
_NAMES_UNITS = re.compile(r"(?i)(units?|einheit(en)?|unit(s|_labels?)?|uoms?|columns?_units?)")


def names_units(key: str) -> bool:
    """Whether the name of an attribute or field says that it holds units: ``units``, ``Einheiten``."""
    return _NAMES_UNITS.fullmatch(key) is not None


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
    for key in (
        f"{name}_unit",
        f"{name}_units",
        f"unit_{name}",
        f"FIELD_{number}_UNIT",
        f"FIELD_{number}_UNITS",
    ):
        if isinstance(value := said.get(key), str):
            return value
    return None
