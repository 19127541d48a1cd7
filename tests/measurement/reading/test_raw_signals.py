"""Volts, milliamperes and counts: read by the scale that a file or the user states, else asked about."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.correction import read_correction, spoken_correction
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read, table

SCOPE = """Model,MSO4
Vertical Units,V,V,V
Horizontal Units,s,s,s

Label,Pressure,Pull,Shortening
TIME,CH1,CH2,CH3
"""
SCALES = """# rest length 300 mm
# CH1 pressure transmitter, gauge: 0...10 V = 0...10 bar
# CH2 force by a load cell, amplifier 200 N/V
# CH3 draw-wire sensor, shortening: 0...10 V = 0...100 mm, 0 V at L0
"""
VOLTS = table(TIME, PRESSURE, FORCE / 200.0, STROKE / 10.0)
COUNTS = np.round(48000.0 - 80.0 * STROKE)  # falling as the muscle shortens


def test_scales_in_remarks_name_their_channel() -> None:
    found = read(f"{SCALES}{SCOPE}{VOLTS}")
    assert_is_the_test(found)
    np.testing.assert_allclose(found.columns["time"], TIME)
    assert sum("is scaled: " in message for message in found.messages) == 3


def test_volts_without_a_scale_are_asked_about_in_volts() -> None:
    with pytest.raises(InputError) as caught:
        read(f"# rest length 300 mm\n{SCOPE}{VOLTS}")
    message = str(caught.value)
    assert "signal in V" in message
    assert '"pressure=CH1 Pressure [0 to 10 V = 0 to 10 bar]"' in message
    assert "[mm]" not in message


def test_the_user_says_the_scale() -> None:
    text = f"# rest length 300 mm\n{SCOPE}{VOLTS}".encode()
    options = [
        "pressure=CH1 Pressure [0-10 V = 0-10 bar]",
        "force=CH2 Pull [200 N/V]",
        "displacement=CH3 Shortening [0 to 10 V = 0 to 100 mm]",
    ]
    assert_is_the_test(read_measurement(text, "a.csv", spoken_correction(columns=options)))
    said = read_correction(
        '{"columns": {"CH1 Pressure": {"channel": "pressure", "scale": "0-10 V = 0-10 bar"},'
        '"CH2 Pull": {"channel": "force", "scale": "200 N/V"},'
        '"CH3 Shortening": {"channel": "displacement", "scale": "0-10 V = 0-100 mm"}}}'
    )
    assert_is_the_test(read_measurement(text, "a.csv", said))
    assert "0-10 V" in said.canonical()
    with pytest.raises(InputError, match="not a scale"):
        read_correction('{"columns": {"a": {"channel": "force", "scale": "much"}}}')


@pytest.mark.parametrize("head", ["Encoder", "Encoder [counts]", "Drehgeber"])
def test_counts_as_the_only_stroke_are_asked_about(head: str) -> None:
    text = f"# rest length 300 mm\ntime_s,pressure_bar,force_N,{head}\n{table(TIME, PRESSURE, FORCE, COUNTS)}"
    with pytest.raises(InputError, match="counts per mm") as caught:
        read(text)
    assert "time" not in str(caught.value)
    name = head.partition(" [")[0]
    options = [f"displacement={name} [48000 to 43200 counts = 0 to 60 mm]"]
    found = read_measurement(text.encode(), "a.csv", spoken_correction(columns=options))
    np.testing.assert_allclose(found.columns["displacement"], STROKE / 1e3, atol=1e-5)


def test_counts_beside_a_stroke_are_no_question() -> None:
    head = "# rest length 300 mm\npressure_bar,force_N,stroke_mm,Encoder\n"
    assert_is_the_test(read(head + table(PRESSURE, FORCE, STROKE, COUNTS)))


def test_counts_that_start_nowhere_are_not_scaled() -> None:
    head = "# rest length 300 mm\n# Encoder: 80 counts = 1 mm\npressure_bar,force_N,Encoder [counts]\n"
    with pytest.raises(InputError, match=r"which length has it.*\[43200 to 48000 count = 240 to 300 mm\]"):
        read(head + table(PRESSURE, FORCE, COUNTS))


def test_a_signal_without_a_name_is_asked_for_its_channel_too() -> None:
    text = f"# rest length 300 mm\nTime(s),CH1(V),CH2(V)\n{table(TIME, PRESSURE * 0.5 + 0.5, FORCE / 300.0)}"
    with pytest.raises(InputError) as refused:
        read(text)
    assert "which pressure, force or displacement is which reading" in refused.value.message


def test_the_symbol_of_a_voltage_says_the_channel_whose_scale_is_asked_for() -> None:
    rows = table(TIME, PRESSURE * 0.5 + 0.5, FORCE, 300.0 - STROKE)
    text = f"t_s,U_p_V,F_N,L_mm\n{rows}"
    with pytest.raises(InputError) as refused:
        read(text)
    assert "'U_p_V' is a signal in V, and no text states its scale: which pressure" in refused.value.message
    assert "load" not in refused.value.message
    said = spoken_correction(columns=["pressure=U_p [1-3 V = 1-5 bar]"])
    found = read_measurement(text.encode(), "a.csv", said)
    np.testing.assert_allclose(found.columns["pressure"], (2.0 * (PRESSURE * 0.5 + 0.5) - 1.0) * 1e5)


@pytest.mark.parametrize("name", ["U_p_V", "U_F1_mV", "V_press_V"])
def test_a_measured_channel_is_not_asked_for_again_by_a_voltage(name: str) -> None:
    rows = table(PRESSURE, FORCE, STROKE, PRESSURE)
    found = read(f"pressure_bar,force_N,stroke_mm,{name}\n{rows}")
    assert [column for column, _ in found.unread] == [name]
