"""A question typed in one line: what is read, and what is named as not read."""

from __future__ import annotations

import pytest

from mckibben.documents.asked import read_asked

MUSCLES = ("DMSP-10", "DMSP-20", "MAS-20")


def stated(text: str) -> dict[str, object]:
    """The fields that a line fills."""
    line = read_asked(text, MUSCLES)
    return {name: value for name in line.__slots__ if name != "parts" and (value := getattr(line, name))}


def unread(text: str) -> list[str]:
    """The parts that were not read."""
    return [part.text for part in read_asked(text, MUSCLES).parts if part.meaning is None]


QUESTION = "How far does a DMSP-20 of 300 mm at 6 bar lift 20 kg, how stiff, which pressure for 15 %?"


def test_a_question_fills_the_fields() -> None:
    weight = pytest.approx(20 * 9.80665)
    want = {"muscle": "DMSP-20", "nominal_length": 0.3, "pressure": 6e5, "mass": 20.0, "load": weight,
            "contraction": 0.15}  # fmt: skip
    assert stated(QUESTION) == want
    assert unread(QUESTION) == []


@pytest.mark.parametrize(
    ("text", "want"),
    [
        ("dmsp 20 300mm 20*9.81 N", {"muscle": "DMSP-20", "nominal_length": 0.3, "load": 196.2}),
        ("0,2 kN 600 kPa", {"load": 200.0, "pressure": 6e5}),
        ("DMSP-20-310N-RM-CM", {"muscle": "DMSP-20", "nominal_length": 0.31}),
        ("lift 2 N by 6 mm in 1 s, 60 mm of room", {"load": 2.0, "stroke": 0.006, "time": 1.0, "room": 0.06}),
    ],
)  # fmt: skip
def test_units_say_what_a_quantity_is(text: str, want: dict[str, object]) -> None:
    assert stated(text) == {name: pytest.approx(value) for name, value in want.items()}


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("DMSP-20 lying, 6 bar", ["lying"]),
        ("DMSP-99", ["DMSP-99"]),
        ("MAS-20-N-10O-AA", ["MAS-20-N-10O-AA"]),
        ("20 kg 5", ["5"]),
        ("20 kg 30 kg", ["30 kg"]),
        ("45 °C", ["45 °C"]),
        ("1e308 kg", ["1e308 kg"]),
        ("", []),
    ],
)
def test_what_is_not_read_is_named(text: str, names: list[str]) -> None:
    assert unread(text) == names


def test_parts_lie_where_they_stand() -> None:
    assert all(QUESTION[part.start :].startswith(part.text) for part in read_asked(QUESTION, MUSCLES).parts)
