"""Conditions that a file says twice, that its readings rule out, or that it writes in words."""

from __future__ import annotations

import io

import openpyxl
import pytest

from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.correction import spoken_correction
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, assert_is_the_test, read, table

HEAD = "pressure_bar,force_N,stroke_mm\n"
LENGTHS = "pressure_bar,force_N,length_mm\n"


def test_two_rest_lengths_are_asked_about() -> None:
    rows = f"{HEAD}{table(PRESSURE, FORCE, STROKE)}"
    text = f"# Muskel, Ruhelänge 300 mm\n# initial length 28 cm (second clamp)\n{rows}"
    with pytest.raises(InputError, match=r"300 mm \(line 1\) and 28 cm \(line 2\)"):
        read(text)
    decided = spoken_correction(rest_length="300 mm")
    assert_is_the_test(read_measurement(text.encode(), "a.csv", decided))
    assert_is_the_test(read(f"# Muskel, Ruhelänge 300 mm\n# initial length 30,0 cm\n{rows}"))


def test_two_loads_count_only_where_no_force_is_measured() -> None:
    above = "# load 5 kg\n# later a hanging weight of 8 kg\n# rest length 300 mm\n"
    with pytest.raises(InputError, match="two values for the load, 5 kg"):
        read(f"{above}pressure_bar,stroke_mm\n{table(PRESSURE, STROKE)}")
    assert_is_the_test(read(f"{above}{HEAD}{table(PRESSURE, FORCE, STROKE)}"))


@pytest.mark.parametrize("length", ["30 mm", "900 mm"])
def test_a_rest_length_that_allows_no_reading_is_asked_about(length: str) -> None:
    text = f"# rest length {length}\n{LENGTHS}{table(PRESSURE, FORCE, 300.0 - STROKE)}"
    with pytest.raises(
        InputError, match=rf"read as {length} \(line 1\), the lengths measured are 240 to 300 mm"
    ):
        read(text)
    assert read(text.replace(length, "300 mm")).conditions["nominal_length"] == pytest.approx(0.3)


@pytest.mark.parametrize(
    "cells",
    [
        ("Longitud inicial L0 (sin carga y sin presión):", 30.0, "cm"),
        ("Ruhelänge (ohne Druck)", "cm", 30.0),
        ("Rest length L0", "30,0", "cm"),
        ("Rest length [cm]", 30, None),
    ],
)
def test_the_unit_of_a_condition_stands_in_a_cell_beside_it(cells: tuple[object, ...]) -> None:
    book = openpyxl.Workbook()
    sheet = book.active
    assert sheet is not None
    sheet.append(["A test of a muscle"])
    sheet.append(list(cells))
    sheet.append([])
    sheet.append(["pressure (bar)", "force (N)", "length (mm)"])
    for row in zip(PRESSURE.tolist(), FORCE.tolist(), (300.0 - STROKE).tolist(), strict=True):
        sheet.append(list(row))
    data = io.BytesIO()
    book.save(data)
    found = read(data.getvalue(), "a.xlsx")
    assert found.conditions["nominal_length"] == pytest.approx(0.3)


def test_numbers_in_words_are_said() -> None:
    found = read(f"# bei drei Bar begonnen\n{HEAD}{table(PRESSURE, FORCE, STROKE)}")
    assert any(
        "'drei Bar' (line 1) is a number in words, which is not read" in message for message in found.messages
    )
    plain = read(f"# a bar of steel, three runs\n{HEAD}{table(PRESSURE, FORCE, STROKE)}")
    assert not any("in words" in message for message in plain.messages)
