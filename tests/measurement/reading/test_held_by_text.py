"""The pressure of a test that no column holds."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading import read_correction, spoken_correction
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, STROKE, read, table

ROWS = "force_N,stroke_mm\n" + table(FORCE, STROKE)


@pytest.mark.parametrize(
    ("above", "name", "bar", "said"),
    [
        ("", "x_4bar.csv", 4.0, "the file's name: '4bar'"),
        ("# Pressione relativa costante 4,0 bar\n", "x_4bar.csv", 4.0, "line 1"),
        ("# constant muscle pressure 3 bar\n", "x_4bar.csv", 3.0, "states another pressure, '4bar'"),
        ("# pressure: 3 bar\n", "a.csv", 3.0, "pressure is taken from"),
        ("# pressure absolute 400 kPa\n# barometer 100 kPa\n", "a.csv", 3.0, "line 1"),
        ("# supply pressure 7 bar\n", "x_4bar.csv", 4.0, "the file's name"),
    ],
)
def test_a_line_beats_the_name(above: str, name: str, bar: float, said: str) -> None:
    found = read(f"{above}{ROWS}", name)
    np.testing.assert_allclose(found.columns["pressure"], bar * 1e5)
    assert any(said in message for message in found.messages)


def test_several_pressures_of_texts_are_asked_about() -> None:
    above = "# pressure 3 bar at first\n# pressure 4 bar later\n"
    with pytest.raises(InputError, match="state several: '3 bar'"):
        read(above + ROWS, "x_5bar.csv")
    np.testing.assert_allclose(read(above + ROWS, "x_4bar.csv").columns["pressure"], 4e5)


def test_a_pressure_that_nothing_states_is_asked_for_and_said_by_the_user() -> None:
    with pytest.raises(InputError, match='which one was it: --column "pressure=3 bar"'):
        read(ROWS)
    said = spoken_correction(columns=["pressure=2.5 bar"])
    found = read(ROWS, correction=said)
    np.testing.assert_allclose(found.columns["pressure"], 2.5e5)
    assert any("pressure is taken from your answer: '2.5 bar'" in message for message in found.messages)
    as_json = read_correction('{"columns": {"2.5 bar": {"channel": "pressure"}}}')
    assert read(ROWS, correction=as_json).id == found.id
    with pytest.raises(InputError, match="there is no column '2\\.5 kg'"):
        read(ROWS, correction=spoken_correction(columns=["pressure=2.5 kg"]))


def test_what_the_user_says_was_held_beats_the_texts_and_never_a_column() -> None:
    said = spoken_correction(columns=["pressure=2.5 bar"])
    above = "# pressure 3 bar at first\n# pressure 4 bar later\n"
    np.testing.assert_allclose(read(above + ROWS, correction=said).columns["pressure"], 2.5e5)
    with pytest.raises(InputError, match=r"'2\.5 bar' is said to be the pressure, which a column holds"):
        read("p_bar,force_N,stroke_mm\n" + table(FORCE * 0 + 3.0, FORCE, STROKE), correction=said)


def test_words_that_stand_for_pressures_get_their_values() -> None:
    half = len(FORCE) // 2
    steps = ["I"] * half + ["II"] * (len(FORCE) - half)
    rows = [f"{s},{f:.6f},{x:.6f}" for s, f, x in zip(steps, FORCE, STROKE, strict=True)]
    text = "\n".join(["Druckstufe,force_N,stroke_mm", *rows])
    asked = r'I, II, and nothing says .*--column "pressure=Druckstufe \[I = 1 bar, II = 2 bar\]"'
    with pytest.raises(InputError, match=asked):
        read(text)
    found = read(text, correction=spoken_correction(columns=["pressure=Druckstufe [I = 2, II = 3.5 bar]"]))
    np.testing.assert_allclose(found.columns["pressure"], [2e5] * half + [3.5e5] * (len(FORCE) - half))
    absolute = spoken_correction(columns=["pressure=Druckstufe [I = 2, II = 3 bar(a)]"])
    assert read(text, correction=absolute).columns["pressure"][0] == pytest.approx(2e5 - 101_325.0)
    with pytest.raises(InputError, match="no value is said for 'II'"):
        read(text, correction=spoken_correction(columns=["pressure=Druckstufe [I = 2 bar, III = 3 bar]"]))
    with pytest.raises(InputError, match="holds numbers, and no words"):
        read(text, correction=spoken_correction(columns=["force=force_N [I = 2 N, II = 3 N]"]))
