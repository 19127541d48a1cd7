"""Vectors written out in a script: ``p = [0.1 0.2 ...]; % bar``, ``F = np.array([...])``, ``x <- c(...)``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.unit_words import dimension_of, unit_of

_NUMBER = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[Nn]a[Nn]|NA"
_ASSIGNED = re.compile(
    r"(?m)^[ \t]*(?:(?:const|var|let|static|double|float|real)\s+)*(?P<name>[A-Za-z_][\w.]*)"
    r"(?:\s*\[[0-9]*\])?[ \t]*(?:=|<-|:=|:)[ \t]*"
    r"(?:(?:np\.|numpy\.|pd\.)?(?:array|asarray|list|vector|c|Series)(?:\s*\((?=\s*[\[({])|(?=\s*\()))?[ \t]*"
    r"(?P<open>[\[({]|(?=[-+.0-9]))"
)
_SCALAR = re.compile(rf"(?P<number>{_NUMBER})\s*(?P<rest>[;,]?[^\n]*)")
_CONTINUED = re.compile(r"\.\.\.[^\n]*\n|\\\n")
_COMMENT = re.compile(r"(?:%|#|//|/\*|--)\s*(?P<text>[^\n]*?)\s*(?:\*/)?\s*$")
_FEWEST = 3  # readings
_SHARE = 0.5  # of the text, that the vectors take


class _Vector(NamedTuple):
    """A list of numbers that a name is given."""

    name: str
    numbers: list[float]
    remark: str
    first: int
    last: int


def vectors_of_script(text: str) -> tuple[dict[str, Any], list[tuple[str, str]]] | None:
    """(named vectors and single numbers, remarks with their places) of a script; None = the text is none.

    A script gives two names and more lists of equal length, which are most of its text.
    """
    found = list(_vectors(text))
    long = [vector for vector in found if len(vector.numbers) >= _FEWEST]
    rows = max((len(vector.numbers) for vector in long), default=0)
    equal = [vector for vector in long if len(vector.numbers) == rows]
    if len(equal) < 2 or sum(v.last - v.first for v in long) < _SHARE * len(text.strip()):
        return None
    values: dict[str, Any] = {}
    for vector in found:
        numbers = np.array(vector.numbers)
        values[_head(vector)] = numbers if len(numbers) > 1 else float(numbers[0])
    taken = [(vector.first, vector.last) for vector in found]
    remarks = []
    position = 0
    for number, line in enumerate(text.split("\n"), start=1):
        inside = any(first <= position < last for first, last in taken)
        comment = _COMMENT.search(line)
        if comment is not None and comment["text"] and not inside:
            remarks.append((comment["text"], f"line {number}"))
        position += len(line) + 1
    return values, remarks


def _vectors(text: str) -> Iterator[_Vector]:
    last = 0
    for found in _ASSIGNED.finditer(text):
        if found.start() < last:
            continue
        if not found["open"]:
            scalar = _SCALAR.match(text, found.end())
            if scalar is not None and re.match(r"\s*[;,]?\s*(?:%|#|//|$)", scalar["rest"]):
                last = scalar.end()
                yield _Vector(
                    found["name"], [_float(scalar["number"])], _remark(scalar["rest"]), found.start(), last
                )
            continue
        close = {"[": "]", "(": ")", "{": "}"}[found["open"]]
        end = text.find(close, found.end())
        if end < 0:
            continue
        inside = re.sub(r"(?m)(?:%|#|//)[^\n]*$", " ", _CONTINUED.sub(" ", text[found.end() : end]))
        numbers = re.split(r"[\s,;]+", inside.strip(" \t\n,;[]()"))
        if not all(re.fullmatch(_NUMBER, number) for number in numbers) or _is_matrix(inside):
            continue
        stop = text.find("\n", end)
        last = len(text) if stop < 0 else stop
        yield _Vector(
            found["name"], [_float(n) for n in numbers], _remark(text[end + 1 : last]), found.start(), last
        )


def _is_matrix(inside: str) -> bool:
    """Whether lines or parts between semicolons hold several numbers each: a table, no vector."""
    rows = [row.split() for row in re.split(r"[;\n]", inside.replace(",", " ")) if row.strip()]
    return len(rows) > _FEWEST and ";" in inside and len(rows[0]) > 1 and len({len(row) for row in rows}) == 1


def _remark(text: str) -> str:
    found = _COMMENT.search(text)
    return found["text"] if found else ""


def _float(text: str) -> float:
    return float("nan") if text.lower() in ("nan", "na") else float(text)


def _head(vector: _Vector) -> str:
    """A name with unit and words of the remark behind it: ``p``, "bar, gauge" -> ``p gauge [bar]``."""
    if not vector.remark or taken_apart(vector.name).unit is not None:
        return vector.name
    remark = taken_apart(vector.remark)
    if remark.unit is not None:
        return f"{vector.name} {remark.name} [{remark.unit}]"
    parts = [part.strip(" []()") for part in re.split(r"[,;(]", vector.remark)]
    units = [part for part in parts if (u := unit_of(part)) is not None and dimension_of(u.unit)]
    if len(units) != 1:
        return vector.name
    words = " ".join(part for part in parts if part not in units)
    return f"{vector.name} {words} [{units[0]}]".replace("  ", " ")
