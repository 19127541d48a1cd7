"""What the pressure counts from: absolute wherever a file says it, less the air that the file states."""

from __future__ import annotations

import numpy as np
import pytest

from tests.measurement.reading.isobaric import FORCE, PRESSURE, ROWS, STROKE, assert_is_the_test, read, table

AMP = """Vendor,GRAPHTEC
CH,Signal name,Input,Range,Unit
CH1,P muscle{mark},DC,5V,kPa
CH2,Force,DC,5V,N
CH3,Stroke,DC,5V,mm
{said}
Data
Number,CH1,CH2,CH3
NO.,kPa,N,mm
"""


@pytest.mark.parametrize(
    ("mark", "said", "air"),
    [
        (" abs", "", 101.325),
        (" abs", "Note,barometer 94.6 kPa", 94.6),
        ("", "Note,CH1 absolute pressure; barometer 94.6 kPa", 94.6),
        ("", "Note,Drücke absolut, Luftdruck 946 mbar", 94.6),
        (",abs", "Note,barometer 94.6 kPa", 94.6),
        ("", "Note,CH4 absolute pressure; barometer 94.6 kPa", 94.6),
        ("", "Note,CH2 absolute pressure; barometer 94.6 kPa", 0.0),
        ("", "Note,barometer 94.6 kPa", 0.0),
    ],
)
def test_absolute_wherever_the_file_says_it(mark: str, said: str, air: float) -> None:
    rows = table(np.arange(ROWS), PRESSURE * 100.0 + air, FORCE, STROKE)
    found = read(AMP.format(mark=mark, said=f"{said}\nrest length 300 mm") + rows)
    assert_is_the_test(found)
    assert any("absolute pressure" in message for message in found.messages) == (air > 0.0)
