"""JSON documents with bare rows beside a list of their channels."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, assert_is_the_test, read

CHANNELS = [
    {"name": "pressure", "unit": "bar", "reference": "gauge"},
    {"name": "force", "unit": "N"},
    {"name": "displacement", "unit": "mm", "positive": "shortening"},
]
ROWS = np.column_stack([PRESSURE, FORCE, STROKE])


def document(**parts: Any) -> str:
    return json.dumps({"rest_length": {"value": 300, "unit": "mm"}, **parts})


LAYOUTS = {
    "rows": document(channels=CHANNELS, data=ROWS.tolist()),
    "columns": document(channels=CHANNELS, data=ROWS.T.tolist()),
    "apart": document(meta={"fields": CHANNELS}, result={"values": ROWS.tolist()}),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_rows_are_joined_with_the_list_of_their_channels(layout: str) -> None:
    found = read(LAYOUTS[layout], "a.json")
    assert_is_the_test(found)
    assert not any("read as gauge" in message for message in found.messages)  # it is stated


def test_the_sign_and_the_reference_of_a_channel_count() -> None:
    channels = [
        CHANNELS[0] | {"reference": "absolute"}, CHANNELS[1], CHANNELS[2] | {"positive": "lengthening"},
    ]  # fmt: skip
    rows = ROWS * np.array([1.0, 1.0, -1.0]) + np.array([1.01325, 0.0, 0.0])
    found = read(document(channels=channels, data=rows.tolist()), "a.json")
    assert_is_the_test(found)
    assert any("sign reversed" in message for message in found.messages)
