"""The compiled static model over many rows."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.muscle import Muscle
from mckibben.simulation.statics import compiled as compiling
from mckibben.simulation.statics.compiled import CompiledState

MUSCLE = Muscle(0.3, 0.0218, 0.45, 0.0018, 0.02)


def test_many_rows_are_computed_in_short_calls_with_the_same_result(monkeypatch: pytest.MonkeyPatch) -> None:
    effect = default_catalogue()["bladder_elasticity"]
    compiled = CompiledState((effect,))
    constants = compiled.pack(MUSCLE, {effect.id: effect.defaults})
    state: dict[str, Any] = dict.fromkeys(compiled.inputs, 0.0) | {
        "length": np.linspace(0.24, 0.3, 1001), "pressure": 3e5, "temperature": 293.15
    }  # fmt: skip
    whole = compiled(constants, **state)
    rows: list[int] = []
    function = compiled._function

    def counted(values: np.ndarray) -> np.ndarray:
        rows.append(len(values))
        return function(values)

    monkeypatch.setattr(compiled, "_function", counted)
    monkeypatch.setattr(compiling, "_ROWS_AT_ONCE", 300)
    np.testing.assert_array_equal(compiled(constants, **state), whole)
    assert rows == [300, 300, 300, 101]
