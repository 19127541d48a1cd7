"""Data outside the ranges in which a model was measured are told, data inside are not."""

from __future__ import annotations

import pytest

from mckibben.application.envelope import MeasuredRange, beyond

UNITS = {
    "pressure": "Pa", "contraction": "1", "speed": "m/s", "temperature": "K", "rest_length": "m", "mass": "kg"
}  # fmt: skip


def ranges(**given: tuple[float, float]) -> dict[str, MeasuredRange]:
    return {name: MeasuredRange(*ends, UNITS[name]) for name, ends in given.items()}


@pytest.mark.parametrize(
    ("known", "data", "told"),
    [
        (
            {"pressure": (1e5, 6e5)},
            {"pressure": (2e5, 7e5)},
            ["pressure up to 7 bar: the model was measured up to 6 bar"],
        ),
        (
            {"pressure": (2e5, 6e5)},
            {"pressure": (0.5e5, 4e5)},
            ["pressure down to 0.5 bar: the model was measured from 2 bar"],
        ),
        (
            {"contraction": (0.0, 0.16)},
            {"contraction": (-0.02, 0.24)},
            [
                "contraction up to 24 %: the model was measured up to 16 %",
                "contraction down to -2 %: the model was measured from 0 %",
            ],
        ),
        (
            {"rest_length": (0.3, 0.3)},
            {"rest_length": (0.25, 0.25)},
            ["rest length down to 250 mm: the model was measured at 300 mm"],
        ),
        (
            {"temperature": (293.15, 293.15)},
            {"temperature": (293.15, 323.15)},
            ["muscle temperature up to 50 °C: the model was measured at 20 °C"],
        ),
        (
            {"pressure": (1e5, 6e5)},
            {"pressure": (1e5, 6e5), "speed": (0.0, 0.25)},
            ["speed up to 250 mm/s: the model was measured without time"],
        ),
    ],
)
def test_what_lies_outside_is_told(known: dict, data: dict, told: list[str]) -> None:
    assert beyond(ranges(**known), ranges(**data)) == told


def test_what_lies_inside_or_hardly_outside_is_not() -> None:
    known = ranges(pressure=(1e5, 6e5), contraction=(0.0, 0.2), speed=(0.0, 0.1))
    assert beyond(known, known) == []
    assert beyond(known, ranges(pressure=(0.95e5, 6.1e5), contraction=(-0.003, 0.203))) == []
    assert beyond(known, ranges(speed=(0.0, 0.115), mass=(5.0, 5.0))) == []


def test_of_an_unknown_envelope_nothing_is_told() -> None:
    assert beyond({}, ranges(pressure=(1e5, 9e5), speed=(0.0, 1.0))) == []
