"""Habits of loggers: formulas of counts, conditions in each row, notes before the names, bare numbers."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading import preview_here, read_here
from mckibben.measurement.reading.correction import Correction
from mckibben.measurement.reading.scales import scales_in
from tests.measurement.reading.bench import FORCE, PRESSURE, STROKE, TIME, asked, assert_is, read, table

MM, BAR = STROKE * 1e3, PRESSURE / 1e5


@pytest.mark.parametrize(
    ("text", "factor", "offset", "unit"),
    [
        ("p = 1.25*U_p - 0.62 bar", 1.25, 0.496, "bar"),
        ("pressure_bar = (adc0 - 205) / 163.8   (gauge)", 1 / 163.8, 205.0, "bar"),
        ("stroke_mm = adc1 * 0.0244 - 2.5", 0.0244, 2.5 / 0.0244, "mm"),
        ("F [N] = 2 * (raw/1023*5 - 0.5) * 100", 1000 / 1023, 102.3, "N"),
        ("p_kPa = 600 - 0.5 x adc", -0.5, 1200.0, "kPa"),
    ],
)
def test_a_formula_is_a_scale(text: str, factor: float, offset: float, unit: str) -> None:
    ((scale, _),) = scales_in(text)
    assert scale.unit == unit
    np.testing.assert_allclose((scale.factor, scale.offset), (factor, offset))


@pytest.mark.parametrize("text", ["p_bar = adc * adc", "p_bar = 1 / adc", "p_bar = (adc", "p_bar = a * b"])
def test_what_is_no_line_is_no_scale(text: str) -> None:
    assert not list(scales_in(text))


def test_counts_are_read_by_their_formulas() -> None:
    counts = [np.round(PRESSURE / 1e5 * 163.8 + 205), np.round(MM * 40)]
    text = "# L0 = 300 mm, load mass 20 kg\n# p_bar = (a0 - 205) / 163.8 (gauge)\n# stroke_mm = a1 / 40\n"
    found = read(text + "millis\ta0\ta1\n" + table(TIME * 1e3, *counts, separator="\t"))
    np.testing.assert_allclose(found.columns["pressure"], PRESSURE, atol=500.0)
    np.testing.assert_allclose(found.columns["displacement"], STROKE, atol=2e-5)


def test_conditions_that_stand_in_each_row_are_no_channels() -> None:
    fixed = np.full(len(TIME), 8.0), np.full(len(TIME), 300.0)
    found = read("t_s;p_bar;Hub_mm;Last_kg;Ruhelaenge_mm\n" + table(TIME, BAR, MM, *fixed, separator=";"))
    assert (found.conditions["load_mass"], found.conditions["nominal_length"]) == (8.0, 0.3)
    assert "force" not in found.columns


def test_notes_before_the_names_are_no_names() -> None:
    notes = "Model,A1\nNote,force cell 0 to 2 kN on the upper plate\nNote,rest length 300 mm\n"
    found = read(notes + "TIME [s],p [bar],F [N],s [mm]\n" + table(TIME, BAR, FORCE, MM))
    assert_is(found, {"pressure": PRESSURE, "force": FORCE, "displacement": STROKE})


def test_the_columns_of_a_file_without_heads_are_asked() -> None:
    rows = "\n".join(f"{4 * k} {k % 300} {0.1 * (k % 200):.1f}" for k in range(600))
    found = [q.column for q in preview_here(rows.encode(), "bare.txt", Correction()).questions if q.stops]
    assert {"column 2", "column 3"} <= set(found)


def test_every_signal_without_a_scale_is_asked() -> None:
    data = "t [s];pressure [ADC];stroke [ADC]\n" + table(
        TIME, np.round(BAR * 99), np.round(MM * 9), separator=";"
    )
    assert {"scale of pressure", "scale of displacement"} <= set(asked(data, "counts.csv"))
    with pytest.raises(Exception, match="no text states its scale"):
        read_here(data.encode(), "counts.csv", Correction())


@pytest.mark.parametrize(
    ("text", "factor", "offset"),
    [
        ("Ch A: 0-10 bar = 0-10 V", 1.0, 0.0),
        ("0 bar = 0.5 V, 10 bar = 4.5 V", 2.5, 0.5),
        ("0.5 V = 0 bar(g) and 4.5 V = 10 bar(g)", 2.5, 0.5),
        ("10 bar = 5 V", 2.0, 0.0),
        ("pressure 0 to 10 bar corresponds to 4 to 20 mA", 0.625, 4.0),
    ],
)
def test_a_calibration_is_read_both_ways_round(text: str, factor: float, offset: float) -> None:
    ((scale, _),) = scales_in(text)
    np.testing.assert_allclose((scale.factor, scale.offset), (factor, offset))


def test_channels_have_letters_too() -> None:
    text = "Ch A: 0-10 bar = 0-10 V\nCh B: LVDT 5 mm/V, shortening positive\nL0 = 300 mm, load 8 kg\n"
    found = read(text + "Time,Channel A,Channel B\n(s),(V),(V)\n" + table(TIME, BAR, MM / 5))
    assert_is(found, {"pressure": PRESSURE, "displacement": STROKE})
    assert any("'Channel A' is scaled" in message for message in found.messages)


def test_the_last_part_of_a_path_is_a_name() -> None:
    data = f'"time","pam.p","pam.F","pam.L"\n{table(TIME, PRESSURE, FORCE, 0.3 - STROKE)}\n'
    found = read(data)
    np.testing.assert_allclose(found.columns["length"], 0.3 - STROKE, atol=1e-6)
    np.testing.assert_allclose(found.columns["pressure"], PRESSURE, atol=1.0)


def test_a_voltage_is_called_by_its_subscript() -> None:
    text = "L0 = 300 mm\nSensor 1: 1..5 V = 0..10 bar\nSensor 2: 0..10 V = 0..2000 N\n"
    found = read(text + "t [s],U_p [V],U_F [V],s [mm]\n" + table(TIME, BAR * 0.4 + 1, FORCE / 200, MM))
    np.testing.assert_allclose(found.columns["pressure"], PRESSURE, atol=1.0)
    np.testing.assert_allclose(found.columns["force"], FORCE, atol=0.01)


def test_two_scales_of_one_signal_are_asked() -> None:
    text = "# L0 = 300 mm\n# p_bar = (a0 - 205) / 163.8\n# p_bar = (a0 - 210) / 163.8\n"
    counts = np.round(BAR * 163.8 + 205)
    data = text + "t_s;a0;F_N;s_mm\n" + table(TIME, counts, FORCE, MM, separator=";")
    assert asked(data).get("scale of pressure") is True
