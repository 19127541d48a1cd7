"""Tares of load cells that texts state."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.correction import Correction
from mckibben.measurement.reading.model import Span
from mckibben.measurement.reading.zeros import zeros_in
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, read, table

TARE = 4.25  # N
ROWS = f"pressure_bar,force_N,stroke_mm\n{table(PRESSURE, FORCE + TARE, STROKE)}"

SENTENCES = {
    "LOAD CELL TARE 4.20 LBF IS INCLUDED IN THE FORCE READINGS - SUBTRACT": (4.2 * 4.4482216152605, True),
    "Tara 2,1 N nicht abgezogen": (2.1, True),
    "tare not subtracted: 2.5 N": (2.5, True),
    "the tare of 300 g must be subtracted": (0.3 * 9.80665, True),
    "tare de 3,5 N non déduite": (3.5, True),
    "tare 4 N, already subtracted": (4.0, False),
    "tare: 4 N": (4.0, None),
    "tare 3 N is included, do not subtract": (3.0, None),
}


@pytest.mark.parametrize("text", SENTENCES)
def test_what_a_sentence_says_of_a_tare(text: str) -> None:
    (found,) = zeros_in(Span("line 1", text))
    assert found.value == pytest.approx(SENTENCES[text][0])
    assert found.contained is SENTENCES[text][1]


@pytest.mark.parametrize(
    "text",
    ["operator: Tara, load 5 kg", "tare done before each run", "tare pressure 0.1 bar", "Tare: 0 N",
     "load cell 200 N, tared", "Target 5 N"],
)  # fmt: skip
def test_no_tare_is_stated(text: str) -> None:
    assert list(zeros_in(Span("line 1", text))) == []


@pytest.mark.parametrize("head", ["rest length 300 mm, tare 4.25 N not subtracted\n\n",
                                  "# tare: 4.25 N not subtracted\n"])  # fmt: skip
def test_a_tare_in_the_readings_is_subtracted_and_said(head: str) -> None:
    found = read(head + ROWS)
    np.testing.assert_allclose(found.columns["force"], FORCE, rtol=1e-6)
    assert any(message.startswith("4.25 N is subtracted from the force: ") for message in found.messages)


def test_a_tare_that_is_subtracted_already_is_said_only() -> None:
    found = read("tare 4.25 N already subtracted\n\n" + ROWS)
    np.testing.assert_allclose(found.columns["force"], FORCE + TARE, rtol=1e-6)
    assert any("already subtracted from the force" in message for message in found.messages)


@pytest.mark.parametrize("head", ["tare 4.25 N\n\n", "# tare_N: 4.25\n", "# tare [N]: 4.25\n",
                                  "tare 4.25 N not subtracted\ntare 5 N not subtracted\n\n"])  # fmt: skip
def test_a_tare_that_may_be_in_the_readings_is_asked_about_until_the_zero_is_stated(head: str) -> None:
    with pytest.raises(InputError) as refused:
        read(head + ROWS)
    assert "a tare of the force" in refused.value.message
    assert "force_zero=4.25 N" in refused.value.message
    told = Correction(conditions={"force_zero": 4.25})
    found = read_measurement((head + ROWS).encode(), "a.csv", told)
    assert found.conditions["force_zero"] == 4.25  # subtracted once, with the experiment
    np.testing.assert_allclose(found.columns["force"], FORCE + TARE, rtol=1e-6)


def test_a_file_without_a_force_has_no_tare() -> None:
    rows = table(PRESSURE, STROKE)
    found = read(f"tare 4.25 N\nload 5 kg\n\npressure_bar,stroke_mm\n{rows}")
    assert "force" not in found.columns
