"""Columns computed from others: seconds with nanoseconds, volts by a stated scale, numbers for none."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading.scales import scales_in
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read, table


def test_seconds_and_nanoseconds_are_one_time() -> None:
    seconds, rest = np.floor(TIME), (TIME % 1.0) * 1e9
    rows = table(1_700_000_000 + seconds, rest, PRESSURE, FORCE, STROKE)
    found = read(f"stamp.secs,stamp.nsecs,pressure_bar,force_N,stroke_mm\n{rows}")
    assert_is_the_test(found, rest=False)
    np.testing.assert_allclose(found.columns["time"], TIME, atol=1e-9)
    assert any("sum of 'stamp.secs' and 'stamp.nsecs'" in message for message in found.messages)


SCALES = {
    "B = load cell, 1 V = 200 N": (200.0, 0.0, "V", "N"),
    "B: pressure 0-10 V for 0-10 bar(g)": (1.0, 0.0, "V", "bar"),
    "B: pressure, 4..20 mA = 0..8 bar": (0.5, -2.0, "mA", "bar"),
    "B = force 20 mV/N": (0.05, 0.0, "mV", "N"),
    "B = stroke 8 mm/V": (8.0, 0.0, "V", "mm"),
    "B = valve, 5 V closed, 10 V open": (0.2, -1.0, "V", "1"),
}


@pytest.mark.parametrize("text", SCALES)
def test_scales(text: str) -> None:
    ((found, _),) = scales_in(text)
    offset = -found.factor * found.offset
    assert (found.factor, offset, found.raw, found.unit) == pytest.approx(SCALES[text])


def test_a_scale_says_what_its_pressure_counts_from() -> None:
    assert [scale.absolute for scale, _ in scales_in("0-10 V = 0-10 bar(a)")] == [True]


def test_volts_are_read_by_the_scales_of_the_file_and_asked_about_without() -> None:
    said = (
        "CH1: pressure 0-10 V = 0-10 bar\nCH2: load cell 200 N/V\nCH3: stroke 20 mm/V\nrest length 300 mm\n"
    )
    rows = table(PRESSURE, FORCE / 200.0, STROKE / 20.0)
    found = read(f"{said}CH1 [V],CH2 [V],CH3 [V]\n{rows}")
    assert_is_the_test(found)
    assert sum("is scaled: " in message for message in found.messages) == 3
    with pytest.raises(InputError):
        read(f"CH1 [V],CH2 [V],CH3 [V]\n{rows}")


@pytest.mark.parametrize("value", [9.9e37, -9999.0])
def test_a_number_that_stands_for_none_is_left_out(value: float) -> None:
    force = FORCE.copy()
    force[4] = value
    found = read(f"pressure_bar,force_N,stroke_mm\n{table(PRESSURE, force, STROKE)}")
    assert found.rows == len(FORCE) - 1
    assert found.skipped == {f"{value:g} means no reading": 1}


def test_dates_of_spreadsheets_and_minutes_with_seconds() -> None:
    serial = "Czas;pressure_bar;force_N;stroke_mm\n" + "\n".join(
        f"{45300.25 + t / 86400:.10f};{p};{f};{s}"
        for t, p, f, s in zip(TIME, PRESSURE, FORCE, STROKE, strict=True)
    )
    np.testing.assert_allclose(read(serial).columns["time"], TIME, atol=2e-5)
    rows = [
        f"0:{i + 3:02d};{p};{f};{s}" for i, (p, f, s) in enumerate(zip(PRESSURE, FORCE, STROKE, strict=True))
    ]
    found = read("Zeit;pressure_bar;force_N;stroke_mm\n" + "\n".join(rows))
    assert found.columns["time"].tolist() == list(range(len(TIME)))


def test_conditions_glued_in_the_name_and_the_air_of_the_file() -> None:
    rows = f"time_s,pressure_bar,stroke_mm\n{table(TIME, PRESSURE, STROKE)}"
    found = read(rows, "lift_dmsp20_L250mm_m4.5kg_ps6bar.csv").conditions
    assert (found["nominal_length"], found["load_mass"], found["supply_pressure"]) == (0.25, 4.5, 6e5)
    head = "Barometer: 1000 hPa\nPressure [bar abs],Force [N],Stroke [mm]\n"
    assert_is_the_test(read(head + table(PRESSURE + 1.0, FORCE, STROKE)), rest=False)
