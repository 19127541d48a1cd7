"""What leaves the program: frozen dataclasses whose attribute docstrings say what each field is, once.

    @result_class
    class HysteresisLoop:
        '''Width of the loop of filling and venting at the load.'''

        pressure: FiniteSeries
        '''Gauge pressures of the curves [Pa].'''

The unit stands in the first square brackets, ``[-]`` for a plain number. Where the fields are figures, the
class names their group, ``FIGURES = "timing"``, and a field without a docstring is described by its figure.
The description of the HTTP interface, the types of the page and the documentation of the Python door are made
from these declarations; JSON is written from the values. Nothing here imports pydantic, which reads
``__pydantic_config__`` and the annotations where a schema is wanted.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass, fields
from functools import cache
from inspect import getsourcefile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Self, TypeVar, cast, dataclass_transform

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.groups import GROUPS

ClassT = TypeVar("ClassT")
ValueT = TypeVar("ValueT")

_UNIT = re.compile(r" ?\[([^\[\]]+)\]")


@dataclass_transform(frozen_default=True)
def result_class(cls: type[ClassT]) -> type[ClassT]:
    """A frozen dataclass with slots and read-only arrays that describes itself by its attribute docstrings.

    ``JSON_KEYS``, field -> key, renames what cannot be the name of a field, such as "from".
    """
    keys: Mapping[str, str] = getattr(cls, "JSON_KEYS", {})
    config = {
        "extra": "forbid",
        "strict": True,
        "allow_inf_nan": False,
        "json_schema_serialization_defaults_required": True,
        "alias_generator": lambda name: keys.get(name, name),
        "validate_by_name": True,
        "json_schema_extra": _describe,
    }
    described_class: Any = cls
    described_class.__pydantic_config__ = config
    checked = getattr(cls, "__post_init__", None)

    def complete(self: Any) -> None:
        if checked is not None:
            checked(self)
        _freeze_arrays(self)

    described_class.__post_init__ = complete
    return dataclass(frozen=True, slots=True)(cls)


def _freeze_arrays(result: Any) -> None:
    """Replace the arrays of a new result by views that refuse to be written to; who made them keeps them."""
    for name in type(result).__dataclass_fields__:
        value = getattr(result, name)
        if isinstance(value, np.ndarray):
            object.__setattr__(result, name, read_only(value))


class Deferring:
    """Base of a `result_class` whose fields may be computed when they are first read.

    Most who ask in a loop read few of them. Two threads that read a field at once may both compute it.
    """

    __slots__ = ("_later",)

    _later: Mapping[str, Callable[[], Any]]

    @classmethod
    def deferred(cls, **later: Callable[[], Any]) -> Self:
        """A result of functions, one for each field.

        Raises:
            TypeError: a field without a function, or a function without a field.
        """
        if later.keys() != (known := _names_of(cls)):
            raise TypeError(f"{cls.__name__}: {', '.join(sorted(later.keys() ^ known))} missing or unknown")
        made = cls.__new__(cls)
        object.__setattr__(made, "_later", later)
        return made

    if not TYPE_CHECKING:  # a checker would take any name for a field

        def __getattr__(self, name: str) -> Any:
            if name not in type(self).__dataclass_fields__:
                raise AttributeError(f"{type(self).__name__} has no {name!r}", name=name, obj=self)
            value = self._later[name]()
            if isinstance(value, np.ndarray):
                value = read_only(value)
            object.__setattr__(self, name, value)
            return value


@cache
def _names_of(cls: type) -> frozenset[str]:
    return frozenset(field.name for field in fields(cast(Any, cls)))


def once(compute: Callable[[], ValueT]) -> Callable[[], ValueT]:
    """The function, which is called at most once: for what several fields of a `Deferring` rest on."""
    found: list[ValueT] = []

    def value() -> ValueT:
        if not found:
            found.append(compute())
        return found[0]

    return value


def read_only(values: NDArray[Any]) -> NDArray[Any]:
    """The values as a view that refuses to be written to."""
    view = values.view()
    view.flags.writeable = False
    return view


class _List:
    """An array as a list for the schemas of pydantic: of numbers, of lists, of booleans ..."""

    __slots__ = ("_items",)

    def __init__(self, items: Mapping[str, Any]) -> None:
        self._items = items

    def __get_pydantic_core_schema__(self, source: object, handler: object) -> Mapping[str, Any]:
        return {"type": "list", "items_schema": self._items}


class _Gap:
    """A number that JSON holds as null where it is NaN."""

    __slots__ = ()

    def __get_pydantic_core_schema__(self, source: object, handler: object) -> Mapping[str, Any]:
        return _GAP


_NUMBER: Mapping[str, Any] = {"type": "float", "allow_inf_nan": False}
_GAP: Mapping[str, Any] = {"type": "nullable", "schema": _NUMBER}

#: Numbers, shape (N,), all finite.
FiniteSeries = Annotated[NDArray[np.float64], _List(_NUMBER)]
#: Numbers, shape (N,); NaN where there is none, null in JSON.
Series = Annotated[NDArray[np.float64], _List(_GAP)]
#: Numbers, shape (P, N), all finite.
FiniteRows = Annotated[NDArray[np.float64], _List({"type": "list", "items_schema": _NUMBER})]
#: Numbers, shape (P, N); NaN where there is none, null in JSON.
Rows = Annotated[NDArray[np.float64], _List({"type": "list", "items_schema": _GAP})]
#: Truth values, shape (N,).
Booleans = Annotated[NDArray[np.bool_], _List({"type": "bool"})]
#: Whole numbers, shape (N,).
Integers = Annotated[NDArray[np.int64], _List({"type": "int"})]
#: Whole numbers, shape (P, N).
IntegerRows = Annotated[NDArray[np.int64], _List({"type": "list", "items_schema": {"type": "int"}})]
#: Numbers or truth values, shape (N,); NaN where there is none, null in JSON.
Column = Annotated[
    NDArray[Any],
    _List({"type": "nullable", "schema": {"type": "union", "choices": [_NUMBER, {"type": "bool"}]}}),
]
#: A number; NaN where there is none, null in JSON.
Number = Annotated[float, _Gap()]


@dataclass(frozen=True, slots=True)
class Described:
    """What a field is: a sentence, and its SI unit; None of what has none, such as a text."""

    text: str
    unit: str | None


def described(cls: type) -> dict[str, Described]:
    """Field -> what it is, from its attribute docstring or its figure; fields of base classes first.

    Raises:
        LookupError: a field with neither.
    """
    texts: dict[str, str] = {}
    for base in reversed(cls.__mro__[:-1]):
        texts |= _of_module(getsourcefile(base) or "").get(base.__qualname__, {})
    figures = GROUPS.get(getattr(cls, "FIGURES", ""), {})
    found: dict[str, Described] = {}
    for field in fields(cast(Any, cls)):
        if text := texts.get(field.name):
            unit = _UNIT.search(text)
            found[field.name] = Described(
                _UNIT.sub("", text, count=1), None if unit is None else "1" if unit[1] == "-" else unit[1]
            )
        elif figure := figures.get(field.name):
            found[field.name] = Described(f"{figure.label}: {figure.definition}", figure.unit or None)
        else:
            raise LookupError(f"{cls.__qualname__}.{field.name} has no docstring")
    return found


@cache
def _of_module(path: str) -> dict[str, dict[str, str]]:
    """Class -> field -> attribute docstring, of one file, which is parsed once."""
    found: dict[str, dict[str, str]] = {}

    def walk(body: list[ast.stmt], prefix: str) -> None:
        for node in body:
            if isinstance(node, ast.ClassDef):
                found[f"{prefix}{node.name}"] = dict(_documented(node))
                walk(node.body, f"{prefix}{node.name}.")

    walk(ast.parse(Path(path).read_text("utf-8")).body if path else [], "")
    return found


def _documented(node: ast.ClassDef) -> list[tuple[str, str]]:
    """The annotated names of a class with the texts that follow them."""
    pairs = zip(node.body, node.body[1:], strict=False)
    return [
        (field.target.id, " ".join(text.value.value.split()))
        for field, text in pairs
        if isinstance(field, ast.AnnAssign)
        and isinstance(field.target, ast.Name)
        and isinstance(text, ast.Expr)
        and isinstance(text.value, ast.Constant)
        and isinstance(text.value.value, str)
    ]


def _describe(schema: dict[str, Any], cls: type) -> None:
    """Put the descriptions and units of a class into its JSON schema."""
    keys: Mapping[str, str] = getattr(cls, "JSON_KEYS", {})
    if hasattr(cls, "to_document"):  # which leaves out what has its default
        schema["required"] = [item.name for item in fields(cast(Any, cls)) if item.default is MISSING]
    for name, field in described(cls).items():
        part = schema["properties"][keys.get(name, name)]
        part["description"] = re.sub(r"\b(None|NaN)\b", "null", field.text)
        if field.unit is not None:
            part["unit"] = field.unit
