"""Results as JSON text: field names, renamed keys, arrays of any length, numbers that JSON lacks."""

from __future__ import annotations

import json
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
import pytest

from mckibben.application import json_text
from mckibben.application.json_text import to_json


@dataclass(frozen=True)
class Interval:
    JSON_KEYS: ClassVar = {"begin": "from"}

    begin: float
    score: float = 0.0


@dataclass(frozen=True)
class Columns:
    values: Any


def written(content: object) -> Any:
    return json.loads(to_json(content))


def test_a_field_may_go_by_another_key() -> None:
    assert written([Interval(1.5, 2.0)]) == [{"from": 1.5, "score": 2.0}]


def test_numbers_that_json_lacks_are_null() -> None:
    assert written(Columns(np.array([1.0, np.nan, np.inf]))) == {"values": [1.0, None, None]}


@pytest.mark.parametrize(
    "values",
    [np.arange(12.0).reshape(3, 4).T, np.float64(2.5), MappingProxyType({"a": 1}), np.arange(5)[::2]],
    ids=["transposed", "scalar", "mapping", "strided"],
)
def test_what_orjson_does_not_take_by_itself(values: Any) -> None:
    plain = values.tolist() if hasattr(values, "tolist") else dict(values)
    assert written(Columns(values)) == {"values": plain}


@pytest.mark.parametrize("count", [0, 1, 9, 10, 11, 25])
def test_a_long_array_is_written_in_pieces_and_reads_the_same(
    monkeypatch: pytest.MonkeyPatch, count: int
) -> None:
    sizes: list[int] = []
    whole = json_text.to_json

    def counted(content: object) -> bytes:
        sizes.append(np.size(content) if isinstance(content, np.ndarray) else 0)
        return whole(content)

    monkeypatch.setattr(json_text, "_AT_ONCE", 10)
    monkeypatch.setattr(json_text, "to_json", counted)
    values = np.linspace(0.0, 1.0, count)
    assert json.loads(json_text.to_json(Columns(values))) == {"values": values.tolist()}
    nested = json.loads(json_text.to_json(Columns({"x": values, "y": np.arange(3)})))
    assert nested == {"values": {"x": values.tolist(), "y": [0, 1, 2]}}
    assert max(sizes) <= 10
