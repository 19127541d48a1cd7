"""Rest lengths in the words of other laboratories, and lengths that are none."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading.evidence import evidence_of
from mckibben.measurement.reading.model import Span, Table

WHOLE = {
    "length 400 mm between fittings": "400 mm",
    "active length: 280 mm": "280 mm",
    "8.27 in from clamp to clamp at zero pressure": "8.27 in",
    "muscle 300 mm between fittings, 20 mm bore": "300 mm",
    "L_active = 0.3 m": "0.3 m",
    "wirksame Länge: 300 mm": "300 mm",
    "Länge 250 mm zwischen den Armaturen": "250 mm",
    "longueur utile 250 mm": "250 mm",
    "lunghezza tra i raccordi 300 mm": "300 mm",
    "comprimento entre terminais 400 mm": "400 mm",
    "długość czynna 250 mm": "250 mm",
    "длина 420 мм между заделками": "420 мм",
    "有効長 250 mm": "250 mm",
    "유효 길이 300 mm": "300 mm",
}


def rest_lengths(text: str) -> list[str]:
    beside = Table((), (Span("line 1", text),), np.zeros(0, np.intp))
    return [e.value.text for e in evidence_of(beside, "x.csv") if e.facet == "condition:nominal_length"]


@pytest.mark.parametrize("text", WHOLE)
def test_a_length_between_the_ends_is_the_rest_length(text: str) -> None:
    assert rest_lengths(text) == [WHOLE[text]]


@pytest.mark.parametrize(
    "text",
    [
        "length between fittings at 3 bar: 240 mm",
        "active length 240 mm at 2 bar",
        "length 150 mm between marks",
        "stroke between end stops 60 mm",
        "5 mm steps between ends",
        "muscle length under load 290 mm",
        "hose length 1.5 m",
        "length when fully contracted 210 mm",
    ],
)
def test_a_length_of_something_else_is_none(text: str) -> None:
    assert rest_lengths(text) == []


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("# L0: 250", ["250 mm"]),
        ("# L0: 0.25", ["0.25 m"]),
        ("# rest length: 250", ["250 mm"]),
        ("# L0: 8", []),
    ],
)
def test_a_rest_length_without_a_unit(text: str, read: list[str]) -> None:
    assert rest_lengths(text) == read
