"""Signals that become readings by what a text states: formulas, ranges, sensitivities, points, positions.

The test writes a signal from readings of its own by the stated calibration; reading has to give them back.
"""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.correction import spoken_correction
from mckibben.measurement.reading.positions import lengths_at_zero, pulleys_in
from mckibben.measurement.reading.scales import scales_in
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read, table

REST = "# rest length 300 mm, gauge pressure, tension positive\n"

#: Sentence -> (unit, signal or its unit, factor, value at 0 of the signal) by hand.
FORMULAS = {
    "F [N] = 200*(U_F - 0.5)": ("N", "U_F", 200.0, -100.0),
    "p = 2.5 bar/V * U_p - 1.25 bar": ("bar", "V", 2.5, -1.25),
    "Kraft: F = 203,4 * U (N)": ("N", "U", 203.4, 0.0),
    "force in N = (adc - 512) / 4": ("N", "adc", 0.25, -128.0),
}


#: Sentence -> (value at 0 of the signal, value at 1) by hand.
SCALES = {
    "0.5 V = 0 bar, 4.5 V = 10 bar": (-1.25, 1.25),
    "range 0-10 bar (0-5 V)": (0.0, 2.0),
    "gain 200 N/V, offset 0.12 V": (-24.0, 176.0),
    "200 N = 1 V": (0.0, 200.0),
    "100 % = 10 bar": (0.0, 0.1),
    "0...10 bar -> 4...20 mA": (-2.5, -1.875),
    "4-20 mA = 0-100 mm, 12 mA at the rest length": (-75.0, -68.75),
}


@pytest.mark.parametrize("text", FORMULAS)
def test_a_straight_line_in_a_sentence(text: str) -> None:
    ((scale, _),) = scales_in(text)
    assert (scale.unit, scale.raw) == FORMULAS[text][:2]
    assert (scale.factor, -scale.factor * scale.offset) == pytest.approx(FORMULAS[text][2:])


@pytest.mark.parametrize(
    "text",
    ["F [N] = U * U", "eps = (L0 - L)/L0", "T = 20 degC", "p = 2*U_p - 1", "F [N] = 2*a + 3*b", "x = 3 mm"],
)
def test_what_is_no_straight_line_of_one_signal_is_none(text: str) -> None:
    assert list(scales_in(text)) == []


@pytest.mark.parametrize("text", SCALES)
def test_a_scale_in_a_sentence(text: str) -> None:
    ((scale, _),) = scales_in(text)
    at = (-scale.factor * scale.offset, scale.factor * (1.0 - scale.offset))
    assert at == pytest.approx(SCALES[text])


def test_an_offset_in_the_unit_of_the_result_is_asked_about() -> None:
    rows = table(TIME, PRESSURE, FORCE / 200.0, STROKE)
    with pytest.raises(InputError, match=r"gain 200 N/V, offset 12 N.*contain it.*force_zero=12 N"):
        read(f"{REST}# gain 200 N/V, offset 12 N\nt [s],p [bar],F [V],s [mm]\n{rows}")


def test_two_calibrations_of_one_column_are_none() -> None:
    rows = table(TIME, PRESSURE, FORCE / 200.0, STROKE)
    with pytest.raises(InputError, match=r"two scales for .*'F \[N\] = 200\*U_F' \(line 2\) and"):
        read(f"{REST}# F [N] = 200*U_F\n# F [N] = 210*U_F\nt [s],p [bar],U_F [V],s [mm]\n{rows}")


def test_volts_by_formulas() -> None:
    text = (
        f"{REST}# p [bar] = 1.25*U_p - 0.62\n# F [N] = 251.3*(U_F - 0.102)\n# s [mm] = 20*U_s\n"
        "t [s],U_p [V],U_F [V],U_s [V]\n"
    )
    found = read(text + table(TIME, (PRESSURE + 0.62) / 1.25, FORCE / 251.3 + 0.102, STROKE / 20.0))
    assert_is_the_test(found)


def test_a_bridge_by_its_sensitivity_in_two_lines() -> None:
    remarks = "# load cell: rated load 2000 N\n# load cell: sensitivity 2.0 mV/V\n"
    text = f"{REST}{remarks}# bridge balanced before the test\nt [s],p [bar],load cell [mV/V],s [mm]\n"
    assert_is_the_test(read(text + table(TIME, PRESSURE, FORCE / 1000.0, STROKE)))


def test_the_zero_of_a_bridge_that_nothing_shows_is_asked_about() -> None:
    text = f"{REST}# load cell 2 mV/V, rated load 2000 N\nt [s],p [bar],load cell [mV/V],s [mm]\n"
    with pytest.raises(InputError, match=r"load cell.*zero force.*force_zero"):
        read(text + table(TIME, PRESSURE, FORCE / 1000.0, STROKE))
    slack = read(
        text + table(TIME, PRESSURE, (FORCE - FORCE.min()) / 1000.0, STROKE)
    )  # comes down to nothing
    assert slack.columns["force"].max() == pytest.approx(FORCE.max() - FORCE.min())


def test_per_cent_of_full_scale() -> None:
    text = (
        f"{REST}# Druck: 100 % = 10 bar\n# Kraft: 100 % = 2500 N\n# Hub: 100 % = 150 mm\n"
        "Zeit [s],Druck [%],Kraft [%],Hub [%]\n"
    )
    assert_is_the_test(read(text + table(TIME, PRESSURE * 10.0, FORCE / 25.0, STROKE / 1.5)))


@pytest.mark.parametrize("head", ["load cell [mV/V]", "Kraft [% FS]", "force [%]"])
def test_a_signal_without_its_scale_is_asked_about(head: str) -> None:
    with pytest.raises(InputError) as caught:
        read(f"{REST}t [s],p [bar],{head},s [mm]\n" + table(TIME, PRESSURE, FORCE / 25.0, STROKE))
    assert head.partition(" [")[0] in str(caught.value)
    assert "scale" in str(caught.value)


def test_a_position_without_its_zero_is_asked_about() -> None:
    with pytest.raises(InputError, match="which length has it"):
        read(
            "# rest length 300 mm\nt [s],p [bar],F [N],laser [mm]\n"
            + table(TIME, PRESSURE, FORCE, 152.4 - STROKE)
        )


def test_a_crosshead_that_counts_from_the_shortest_length() -> None:
    """Its zero stands in a text, or is asked about: reversed, it would stretch the muscle by 20 %."""
    head = "Ruhelänge 300 mm\n{}Druck [bar],Kraft [N],Traversenweg [mm]\n"
    rows = table(PRESSURE, FORCE, 60.0 - STROKE)
    told = read(head.format("Länge bei Traversenweg 0: 240 mm\n") + rows)
    assert told.columns["length"] == pytest.approx(0.3 - 1e-3 * STROKE)
    with pytest.raises(InputError, match=r'length=Traversenweg \[0 to 60 mm = 240 to 300 mm\]"'):
        read(head.format("") + rows)
    answer = spoken_correction(columns=["length=Traversenweg [0 to 60 mm = 240 to 300 mm]"])
    answered = read_measurement((head.format("") + rows).encode(), "a.csv", answer)
    assert answered.columns["length"] == pytest.approx(0.3 - 1e-3 * STROKE)
    reversed_sign = spoken_correction(columns=["displacement=-Traversenweg"])
    with pytest.raises(InputError, match="stretch the muscle by up to 60 mm"):
        read_measurement((head.format("") + rows).encode(), "a.csv", reversed_sign)


@pytest.mark.parametrize(
    "text",
    [
        "Länge bei Traversenweg 0\t228,0 mm",
        "muscle length at crosshead zero: 22.8 cm",
        "length at position = 0: 228 mm",
        "Grip separation at zero traverse: 228 mm",
        "zero of the crosshead at a length of 228 mm",
        "muscle length = crosshead + 228 mm",
    ],
)
def test_a_length_where_a_position_is_zero(text: str) -> None:
    assert list(lengths_at_zero(text, {"traversenweg"})) == pytest.approx([0.228])


@pytest.mark.parametrize(
    "text", ["Ruhelänge 300 mm", "stroke zero at the rest length of 300 mm", "at 0 bar the length is 300 mm"]
)
def test_what_is_no_length_where_a_position_is_zero(text: str) -> None:
    assert list(lengths_at_zero(text, {"traversenweg"})) == []


@pytest.mark.parametrize(
    ("text", "radii"),
    [
        ("wire over a pulley of 25 mm radius, angle 0 at the rest length", [0.025]),
        ("Seilrolle, Durchmesser 50 mm", []),  # the number stands in a clause of its own
        ("Seilrolle mit Durchmesser 50 mm", [0.025]),
        ("tube of 25 mm radius at the inlet", []),
    ],
)
def test_the_radius_of_a_pulley(text: str, radii: list[float]) -> None:
    assert list(pulleys_in(text)) == pytest.approx(radii)


def test_a_position_with_its_reading_at_the_rest_length() -> None:
    falls = "The laser reads 152.4 mm at the rest length; its reading falls as the muscle shortens."
    rows = table(TIME, PRESSURE, FORCE, 152.4 - STROKE)
    found = read(f"# rest length 300 mm\n# {falls}\nt [s],p [bar],F [N],laser [mm]\n{rows}")
    assert_is_the_test(found)
    assert any("its sign reversed: '# The laser reads" in message for message in found.messages)


def test_two_scales_in_one_sentence() -> None:
    """Each is of the signal that measures it; the mass that is lifted is the load."""
    above = "# rest length 300 mm\n# p: 1 bar/V, x: 20 mm/V (up positive); lifts 12 kg\n"
    measured = read(f"{above}t [s],Druck [V],Weg [V]\n{table(TIME, PRESSURE, STROKE / 20.0)}")
    assert measured.columns["pressure"] == pytest.approx(1e5 * PRESSURE)
    assert measured.columns["displacement"] == pytest.approx(1e-3 * STROKE)
    assert measured.conditions["load_mass"] == 12.0


def test_a_scale_whose_sentence_says_the_sign_in_another_word() -> None:
    told = "# rest length 300 mm\n# LVDT: 10 mm/V, 0 V at rest length, positive = contraction\n"
    measured = read(f"{told}p(bar),F(N),X(V)\n{table(PRESSURE, FORCE, STROKE / 10.0)}")
    assert_is_the_test(measured)


def test_the_angle_of_a_pulley() -> None:
    text = "# rest length 300 mm\n# wire over a pulley of 25 mm radius, angle 0 at the rest length\n"
    angle = np.degrees(STROKE / 25.0)
    assert_is_the_test(read(f"{text}t [s],p [bar],F [N],angle [deg]\n" + table(TIME, PRESSURE, FORCE, angle)))
    with pytest.raises(InputError):
        read("# rest length 300 mm\nt [s],p [bar],F [N],angle [deg]\n" + table(TIME, PRESSURE, FORCE, angle))
