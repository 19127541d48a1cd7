"""Zeros that texts state are subtracted or asked about; none passes in silence."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading.correction import Correction
from mckibben.measurement.reading.model import Span
from mckibben.measurement.reading.zeros import zeros_in
from tests.measurement.reading.bench import (
    ABOVE,
    FORCE,
    PRESSURE,
    REST,
    STROKE,
    TIME,
    Array,
    asked,
    read,
    table,
)

BAR, MM = PRESSURE / 1e5, STROKE * 1e3
HEADS = "time [s],pressure [bar],force [N],stroke [mm]"
OVER_ALL = f"time [s],pressure [bar],force [N],length [mm]\n{table(TIME, BAR, FORCE, 360.0 - MM)}\n"
ZEROS = {
    "LOAD CELL TARE 4.20 LBF IS INCLUDED IN THE FORCE READINGS - SUBTRACT": ("force", 18.68254, True),
    "Tara 2,1 N nicht abgezogen": ("force", 2.1, True),
    "tare not subtracted: 2.5 N": ("force", 2.5, True),
    "the tare of 300 g must be subtracted": ("force", 2.941995, True),
    "tare de 3,5 N non déduite": ("force", 3.5, True),
    "tare 4 N, already subtracted": ("force", 4.0, False),
    "tare: 4 N": ("force", 4.0, None),
    "zero of the load cell, tare 4.2": ("force", 4.2, None),
    "tare 3 N is included, do not subtract": ("force", 3.0, None),
    "rest length 300 mm, tare 4.25 N not subtracted": ("force", 4.25, True),
    "Nulpunt krachtopnemer: -4,7 N, niet gecorrigeerd, nog aftrekken": ("force", -4.7, True),
    "Offset Kraftsensor 3,2 N (noch abzuziehen)": ("force", 3.2, True),
    "décalage du capteur de force 2 N, corrigé": ("force", 2.0, False),
    "load cell zero 2.5 N": ("force", 2.5, None),
    "load cell shows 3 N with nothing attached": ("force", 3.0, None),
    "Nullpunkt Drucksensor 12 mbar, nicht korrigiert": ("pressure", 1200.0, True),
    "pressure sensor offset 0.02 bar": ("pressure", 2000.0, None),
    "stroke offset 1.5 mm, not subtracted": ("displacement", 0.0015, True),
    "lengte over alles, inclusief 2 koppelingen van 31 mm": ("length", 0.062, True),
    "Länge inklusive Armaturen (2 x 31 mm)": ("length", 0.062, True),
    "length including fittings of 31 mm each": ("length", 0.062, True),
    "length including fittings, 62 mm": None,
    "length including the fittings of 62 mm": ("length", 0.062, None),
    "operator: Tara, load 5 kg": None,
    "tare done before each run": None,
    "tare pressure 0.1 bar": None,
    "Tare: 0 N": None,
    "load cell 200 N, tared": None,
    "load cell 0 - 500 N": None,
    "Target 5 N": None,
    "force at zero stroke 510 N": None,
    "rest length 250 mm without fittings": None,
    "rest length 250 mm including 2 fittings of 20 mm": None,
    "zero balance 0.02 mV/V, rated load 500 N": None,
    "barometer offset 3 hPa": None,
}


@pytest.mark.parametrize("sentence", ZEROS)
def test_what_a_sentence_says_of_a_zero(sentence: str) -> None:
    found = list(zeros_in(Span("line 1", sentence)))
    wanted = ZEROS[sentence]
    assert len(found) == (wanted is not None)
    if wanted is not None:
        assert (found[0].channel, found[0].contained) == (wanted[0], wanted[2])
        assert found[0].value == pytest.approx(wanted[1], rel=1e-5)


@pytest.mark.parametrize(
    ("said", "columns"),
    [
        ("force offset 4.25 N, not subtracted", (TIME, BAR, FORCE + 4.25, MM)),
        ("pressure sensor zero offset 30 mbar not corrected", (TIME, BAR + 0.03, FORCE, MM)),
        ("stroke offset 1.5 mm, still to be subtracted", (TIME, BAR, FORCE, MM + 1.5)),
    ],
)
def test_a_zero_that_the_readings_contain_is_subtracted_and_said(
    said: str, columns: tuple[Array, ...]
) -> None:
    found = read(f"{ABOVE}# {said}\n{HEADS}\n{table(*columns)}\n")
    np.testing.assert_allclose(found.columns["force"], FORCE, atol=1e-4)
    np.testing.assert_allclose(found.columns["pressure"], BAR * 1e5, atol=20.0)
    np.testing.assert_allclose(found.columns["displacement"], STROKE, atol=1e-6)
    assert any("is subtracted from the" in message for message in found.messages)


def test_a_head_states_a_zero_too() -> None:
    head = "time [s],pressure [bar],force (offset 4.25 N not subtracted) [N],stroke [mm]"
    found = read(f"{ABOVE}{head}\n{table(TIME, BAR, FORCE + 4.25, MM)}\n")
    np.testing.assert_allclose(found.columns["force"], FORCE, atol=1e-4)


def test_what_the_user_says_of_the_zero_counts_once() -> None:
    data = f"{ABOVE}# tare 4.25 N not subtracted\n{HEADS}\n{table(TIME, BAR, FORCE + 4.25, MM)}\n"
    found = read(data, correction=Correction(conditions={"force_zero": 4.25}))
    np.testing.assert_allclose(found.columns["force"], FORCE + 4.25, atol=1e-4)  # less it in the experiment


def test_a_length_over_all_is_read_less_its_fittings() -> None:
    data = f"{ABOVE}# length over all, including 2 fittings of 30 mm\n{OVER_ALL}"
    np.testing.assert_allclose(read(data).columns["length"], REST - STROKE, atol=1e-6)


def test_a_length_over_all_that_nothing_explains_is_asked_about() -> None:
    assert "rest length" in asked(f"{ABOVE}{OVER_ALL}")


@pytest.mark.parametrize(
    ("said", "about"),
    [
        ("tare 4.25 N", "zero of force"),
        ("load cell zero 4.25 N", "zero of force"),
        ("pressure sensor offset 0.03 bar", "zero of pressure"),
        ("stroke offset 1.5 mm", "zero of displacement"),
        ("tare 4 N not subtracted; tare 5 N not subtracted", "zero of force"),
    ],
)
def test_a_zero_of_which_nothing_says_whether_it_is_contained_is_asked_about(said: str, about: str) -> None:
    assert about in asked(f"{ABOVE}# {said}\n{HEADS}\n{table(TIME, BAR, FORCE, MM)}\n")
