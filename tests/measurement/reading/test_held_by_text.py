"""The pressure of a test that no column holds."""

from __future__ import annotations

import numpy as np
import pytest

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
