"""Pressure texts that say what they are counted from: gauge or absolute."""

from __future__ import annotations

import pytest

from mckibben.physics.errors import InputError
from mckibben.physics.units import absolute_text, si

ATMOSPHERE, PSI = 101_325.0, 6894.757293168

GAUGE = {
    "3 bar(g)": 3e5, "3 barg": 3e5, "3 bar g": 3e5, "3bar (gauge)": 3e5, "30 psig": 30 * PSI,
    "0.3 MPa(g)": 3e5, "300 kPag": 3e5,
}  # fmt: skip
ABSOLUTE = {
    "3 bar(a)": 3e5, "3 bara": 3e5, "3 bar abs": 3e5, "30 psia": 30 * PSI, "0.3 MPa(abs)": 3e5,
    "300 kPa (a)": 3e5, "300 kPaa": 3e5,
}  # fmt: skip


@pytest.mark.parametrize("text", GAUGE)
def test_a_gauge_text(text: str) -> None:
    assert si(text, "Pa", reference="gauge") == pytest.approx(GAUGE[text], rel=1e-9)
    assert si(text, "Pa", reference="absolute") == pytest.approx(GAUGE[text] + ATMOSPHERE, rel=1e-9)
    assert si(text, "Pa") == pytest.approx(GAUGE[text], rel=1e-9)  # a difference or a gauge pressure
    assert not absolute_text(text)


@pytest.mark.parametrize("text", ABSOLUTE)
def test_an_absolute_text(text: str) -> None:
    assert si(text, "Pa", reference="absolute") == pytest.approx(ABSOLUTE[text], rel=1e-9)
    assert si(text, "Pa", reference="gauge") == pytest.approx(ABSOLUTE[text] - ATMOSPHERE, rel=1e-9)
    assert si(text, "Pa", reference="gauge", ambient=8e4) == pytest.approx(ABSOLUTE[text] - 8e4, rel=1e-9)
    assert absolute_text(text)
    with pytest.raises(InputError, match="is an absolute pressure"):
        si(text, "Pa")


@pytest.mark.parametrize("text", ["3 bar(x)", "3 barga", "3 m(g)", "3 (g)", "3 bar(a"])
def test_other_words_are_refused(text: str) -> None:
    with pytest.raises(InputError):
        si(text, "Pa", reference="gauge")


def test_without_a_word_the_number_is_as_needed() -> None:
    for reference in ("gauge", "absolute", None):
        assert si("3 bar", "Pa", reference=reference) == 3e5
        assert si(3e5, "Pa", reference=reference) == 3e5


def test_units_that_end_in_the_same_letters_keep_their_meaning() -> None:
    assert si("2 MPa", "Pa", reference="gauge") == 2e6
    assert si("5 g", "kg") == pytest.approx(0.005)
    assert si("2 a", "s") > 6e7  # a year
