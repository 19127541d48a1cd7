"""Results describe themselves: every field has a sentence and, where it has one, a known unit."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any, cast

import numpy as np
import pytest
from pydantic import BaseModel, TypeAdapter, ValidationError

import mckibben
from mckibben.application.curves.curves import CurvesResult
from mckibben.facts.result import Number, Rows, Series, described, result_class
from mckibben.physics.units import si
from mckibben.server import schemas
from mckibben.simulation.timing.table import PhaseFigures


def modules(package: Any, prefix: str) -> Iterator[Any]:
    for module in pkgutil.walk_packages(package.__path__, prefix):
        if not module.name.endswith(("__main__", "migrations.env")) and ".cli" not in module.name:
            yield importlib.import_module(module.name)


def classes() -> list[type]:
    """Every result class of the program."""
    return [
        item
        for module in modules(mckibben, "mckibben.")
        for item in vars(module).values()
        if inspect.isclass(item)
        and item.__module__ == module.__name__
        and is_dataclass(item)
        and "__pydantic_config__" in vars(item)
    ]


def names(cls: type) -> frozenset[str]:
    return frozenset(field.name for field in fields(cast(Any, cls)))


CLASSES = classes()


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_every_field_is_described_with_a_known_unit(cls: type) -> None:
    assert inspect.getdoc(cls)
    for name, field in described(cls).items():
        assert field.text.endswith((".", ".)")), name
        if field.unit not in (None, "1"):
            assert si(f"1 {field.unit}", field.unit) == 1.0, name


def test_there_are_many() -> None:
    assert len(CLASSES) > 100


def test_no_schema_of_the_server_repeats_a_result() -> None:
    results = {names(cls): cls for cls in CLASSES if len(names(cls)) > 2}
    for module in modules(schemas, "mckibben.server.schemas."):
        for item in vars(module).values():
            own = inspect.isclass(item) and item.__module__ == module.__name__
            if own and issubclass(item, BaseModel) and not item.__name__.endswith(("Request", "Input")):
                assert frozenset(item.model_fields) not in results, item.__name__


def test_a_field_without_a_docstring_is_an_error() -> None:
    @result_class
    class Silent:
        """It says nothing of its field."""

        length: float

    with pytest.raises(LookupError, match=r"Silent\.length has no docstring"):
        described(Silent)


def test_a_figure_describes_its_field() -> None:
    field = described(PhaseFigures)["rise_time"]
    assert field.text.startswith("Rise time (10–90 %): ")
    assert field.unit == "s"


@result_class
class Example:
    """A result with each kind of array."""

    values: Series
    """Numbers [N]."""
    rows: Rows
    """Numbers [1/s]."""
    best: Number
    """The best of them [-]."""


def test_its_schema_has_descriptions_units_and_gaps() -> None:
    schema = TypeAdapter(Example).json_schema(mode="serialization")
    number = {"anyOf": [{"type": "number"}, {"type": "null"}]}
    assert schema["properties"]["values"] == {
        "title": "Values", "type": "array", "items": number, "description": "Numbers.", "unit": "N",
    }  # fmt: skip
    assert schema["properties"]["rows"]["items"] == {"type": "array", "items": number}
    assert schema["properties"]["best"]["unit"] == "1"
    assert schema["additionalProperties"] is False
    assert schema["required"] == ["values", "rows", "best"]


@pytest.mark.parametrize(
    "text",
    [
        '{"values": [1, "a"], "rows": [[1]], "best": 1}',
        '{"values": [1], "rows": [1], "best": 1}',
        '{"values": [1], "rows": [[1]], "best": 1, "more": 2}',
        '{"values": [1], "rows": [[1]]}',
    ],
)
def test_other_answers_are_refused(text: str) -> None:
    with pytest.raises(ValidationError):
        TypeAdapter(Example).validate_json(text)
    TypeAdapter(Example).validate_json('{"values": [1, null], "rows": [[1, null]], "best": null}')


def test_a_result_does_not_change() -> None:
    values = np.zeros(1)
    result = Example(values, np.zeros((1, 1)), 0.0)
    values[0] = 2.0  # who made it may go on with its own array
    assert np.shares_memory(result.values, values)
    with pytest.raises(AttributeError):
        result.best = 1.0  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        result.rows[0, 0] = 1.0
    assert CurvesResult in CLASSES
