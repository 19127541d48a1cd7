"""The noise of a question: a number in SI, or a text with a unit of what is predicted."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, cast

import pytest

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.compare.stated_question import with_noise
from mckibben.physics.errors import InputError


@dataclass(frozen=True)
class Asked:
    """What `with_noise` reads of a question of some channels."""

    unit: str = "N"
    channels: int = 1
    noise: float | None = None

    @property
    def predictor(self) -> Any:
        return SimpleNamespace(unit=self.unit, channels=[None] * self.channels)


def level(noise: float | str | None, asked: Asked | None = None, name: str = "noise") -> float | None:
    return with_noise(cast(ModelQuestion, asked or Asked()), noise, name=name).noise


@pytest.mark.parametrize(
    ("stated", "unit", "found"),
    [
        (2.0, "N", 2.0), ("2", "N", 2.0), ("2 N", "N", 2.0), ("0.5 kN", "N", 500.0),
        ("40 um", "m", 4e-5), ("1 kgf", "N", 9.80665), (None, "N", None),
    ],
)  # fmt: skip
def test_numbers_are_si_and_texts_have_a_unit(stated: float | str, unit: str, found: float | None) -> None:
    assert level(stated, Asked(unit)) == (None if found is None else pytest.approx(found))


@pytest.mark.parametrize("stated", [0.0, -1.0, "0 N", "-2 N", float("nan"), float("inf"), "inf", "nan"])
def test_it_is_above_zero_and_finite(stated: float | str) -> None:
    with pytest.raises(InputError, match="standard deviation above 0") as refused:
        level(stated, name="--noise")
    assert refused.value.message.startswith(f"--noise {stated}")
    assert refused.value.field == "noise"


@pytest.mark.parametrize("stated", ["2 bar", "2 mm", "little", ""])
def test_another_unit_says_which_would_be_right(stated: str) -> None:
    with pytest.raises(InputError, match="neither a number in N nor one with a unit") as refused:
        level(stated)
    assert refused.value.field == "noise"


def test_a_unit_needs_one_channel() -> None:
    assert level(5.0, Asked("1", channels=2)) == 5.0  # the diagnosis itself refuses it
    with pytest.raises(InputError, match="several predicted channels"):
        level("5 N", Asked("1", channels=2))
