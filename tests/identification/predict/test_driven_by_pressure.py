"""A trace whose pressure was measured needs its load; columns that nothing tells could be the force."""

from __future__ import annotations

import pytest

from mckibben.identification.predict import driven_by_pressure
from mckibben.measurement.reading import read_measurement
from mckibben.physics.errors import InputError
from tests.identification.synthetic import MUSCLE


def test_columns_that_neither_name_nor_unit_tells_could_be_the_force() -> None:
    rows = "\n".join(
        f"{0.01 * i:.2f},{min(i, 40) / 10},{min(i, 40)},{i % 11},{i % 7},{i % 3}" for i in range(120)
    )
    text = f"time [s],pressure [bar],stroke [mm],blorp,Druck Soll [bar],bridge [mV]\n{rows}\n"
    measurement = read_measurement(text.encode(), "trace.csv")
    assert dict(measurement.unread)["Druck Soll [bar]"] == "it is a set value"  # that one is told
    assert measurement.undecided == ("blorp", "bridge [mV]")
    with pytest.raises(InputError) as refused:
        driven_by_pressure(measurement, MUSCLE)
    assert "is the force in one of the unused columns 'blorp', 'bridge [mV]'?" in str(refused.value.hint)
