"""Corrections in the words of a door: an option, a field of a request, an argument of Python.

Messages are made below the doors. There a correction is written as the option that states it,
``--ignore "force_N"``; the other doors say the same in their own words (`in_words_of`). A result class names
the fields whose texts hold corrections in ``CORRECTING``; `result_in_words_of` says them alike.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from enum import Enum, auto
from functools import cache
from typing import Any, ClassVar, Literal, TypeVar, cast, get_args, get_origin, get_type_hints

import numpy as np

from mckibben.physics.errors import InputError

#: Doors with words of their own beside the command line.
Door = Literal["http", "python"]


class _Kind(Enum):
    TEXT = auto()
    LIST = auto()
    COLUMN = auto()  # "force=-Kraft [kN]"
    PAIR = auto()  # "force_zero=2 N"


#: Corrections by the option of the command line -> how their value is written.
CORRECTIONS: dict[str, _Kind] = {
    "column": _Kind.COLUMN,
    "experiment": _Kind.PAIR,
    **dict.fromkeys(("ignore", "effect", "free", "use", "keep"), _Kind.LIST),
    **dict.fromkeys(
        ("rest-length", "load", "supply", "accuracy", "sheet", "head", "noise", "muscle", "drive", "strict"),
        _Kind.TEXT,
    ),
}
_NAMES = {"effect": "effects"}  # where a field is not called as its option
_ARGUMENTS = _NAMES | {"column": "columns"}
#: Whole commands -> what does the same at a door. HTTP has no saved models to write.
_COMMANDS: dict[Door, dict[str, str]] = {
    "http": {
        "use mckibben compare DATA --model": "POST /api/comparisons",
        "use mckibben curves --muscle": "POST /api/curves",
        "use mckibben diagnose": "send it to /api/measurements",
        "use mckibben joint": "POST /api/joints",
        "use mckibben presets": "GET /api/presets",
        "use mckibben simulate": "POST /api/simulations",
        "use mckibben size": "POST /api/sizings",
        "use mckibben study": "POST /api/studies",
    },
    "python": {
        "mckibben diagnose DATA --save MODEL.json": 'model.diagnose(data).model.save("model.json")',
        "use mckibben compare DATA --model": "use mk.load",
        "use mckibben curves --muscle": "use mk.load",
        "use mckibben diagnose": "use mk.read",
        "use mckibben joint": "use mk.Joint.load",
        "use mckibben presets": "use mk.presets",
        "use mckibben simulate": "use mk.Drive.load",
        "use mckibben size": "use mk.size",
        "use mckibben study": "use mk.study",
    },
}
_VALUE = r""" ("[^"]*"|'[^']*'|[A-Z_]{3,}(?:\.json)?|[a-z]+(?:_[a-z]+)+)"""
_OPTION = re.compile(rf"--([a-z]+(?:-[a-z]+)*)(?:{_VALUE})?")


def in_words_of(door: Door, text: str) -> str:
    """A message with its corrections in the words of a door.

    >>> in_words_of("http", 'leave it out: --ignore "force_N"')
    'leave it out: "ignore": ["force_N"]'
    >>> in_words_of("python", 'leave it out: --ignore "force_N", or state --rest-length')
    'leave it out: ignore=["force_N"], or state rest_length'
    """

    def worded(found: re.Match[str]) -> str:
        if (kind := CORRECTIONS.get(found[1])) is None:
            return found[0]
        names = _NAMES if door == "http" else _ARGUMENTS
        name = names.get(found[1], found[1].replace("-", "_"))
        value = None if found[2] is None else found[2].strip("\"'")
        if value is None or (value == found[2] and (value.isupper() or value.endswith(".json"))):
            return name  # a word that stands for any value, as COLUMN
        if door == "http":
            return f'"{name}": {json.dumps(_http(value, kind), ensure_ascii=False)}'
        return f"{name}={json.dumps(_python(value, kind), ensure_ascii=False)}"

    for command, said in _COMMANDS[door].items():
        text = text.replace(command, said)
    return _OPTION.sub(worded, text)


def error_in_words_of(door: Door, error: InputError) -> InputError:
    """The error with message and hint in the words of a door."""
    hint = None if error.hint is None else in_words_of(door, error.hint)
    return InputError(in_words_of(door, error.message), field=error.field, hint=hint, code=error.code)


ResultT = TypeVar("ResultT")
_PLAIN = (str, float, int)  # a list or mapping of these holds no results
_NO_TEXT = frozenset({float, int, bool, type(None), np.ndarray})


def result_in_words_of(door: Door, result: ResultT) -> ResultT:
    """The result with its corrections in the words of a door; what has none is returned itself."""
    return cast(ResultT, _reworded(door, result))


def _reworded(door: Door, value: Any, *, corrects: bool = False) -> Any:
    """A value inside of a result; its texts are rewritten only where the field is one that corrects."""
    if type(value) in _NO_TEXT:
        return value
    if isinstance(value, str):
        said = in_words_of(door, value) if corrects else value
        return value if said == value else said
    if is_dataclass(value) and not isinstance(value, type):
        if not _corrects(type(value)):
            return value
        named: tuple[str, ...] = getattr(value, "CORRECTING", ())
        changed = {}
        for name in value.__dataclass_fields__:
            old = getattr(value, name)
            if type(old) not in _NO_TEXT:
                new = _reworded(door, old, corrects=name in named)
                if new is not old:
                    changed[name] = new
        return replace(value, **changed) if changed else value
    inside = (
        value.values() if isinstance(value, Mapping) else value if isinstance(value, list | tuple) else ()
    )
    if not corrects and isinstance(next(iter(inside), 0), _PLAIN):
        return value
    if isinstance(value, list | tuple):
        parts = [_reworded(door, part, corrects=corrects) for part in value]
        same = all(new is old for new, old in zip(parts, value, strict=True))
        return value if same else parts if isinstance(value, list) else tuple(parts)
    if isinstance(value, Mapping):
        pairs = {key: _reworded(door, part, corrects=corrects) for key, part in value.items()}
        return value if all(new is value[key] for key, new in pairs.items()) else pairs
    return value


@cache
def _corrects(kind: type) -> bool:
    """Whether a result class, or one inside of it, has fields that hold corrections."""
    if hasattr(kind, "CORRECTING"):
        return True
    kinds = get_type_hints(kind)
    return any(_may_correct(kinds[field.name]) for field in fields(cast(Any, kind)))


def _may_correct(kind: Any) -> bool:
    """Whether a value of an annotated type may hold corrections; of any type, it may."""
    if is_dataclass(kind):
        return _corrects(cast(type, kind))
    if kind in (Any, object) or isinstance(kind, TypeVar):
        return True
    of = get_origin(kind)
    return of not in (np.ndarray, ClassVar) and any(map(_may_correct, get_args(kind)))


def _http(value: str, kind: _Kind) -> object:
    if kind is _Kind.PAIR:
        name, _, said = value.partition("=")
        return {name: said}
    return value if kind is _Kind.TEXT else [value]


def _python(value: str, kind: _Kind) -> object:
    if kind in (_Kind.PAIR, _Kind.COLUMN):
        name, _, said = value.partition("=")
        return {name: said}
    return value if kind is _Kind.TEXT else [value]
