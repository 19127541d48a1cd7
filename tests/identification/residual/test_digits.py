"""Three significant digits in sentences."""

from __future__ import annotations

import math

import pytest

from mckibben.identification.residual.digits import brief


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1.9, "1.90"), (0.99951, "1.00"), (239.4, "239"), (1529.0, "1530"), (0.00184, "0.00184"),
        (3.21e-7, "3.21e-07"), (0.0, "0"), (math.inf, "inf"),
    ],
)  # fmt: skip
def test_three_digits(value: float, text: str) -> None:
    assert brief(value) == text
