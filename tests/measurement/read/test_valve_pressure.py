"""A pressure that is named after the valve, beside the command of the valve."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.read import Correction, preview
from mckibben.physics.errors import InputError
from tests.measurement.read.bench import FORCE, PRESSURE, STROKE, TIME, read, table

MEASURED = PRESSURE + 0.01 * np.sin(3.0 * np.arange(len(PRESSURE)))
VOLTS = 0.6 * PRESSURE
ROWS = table(TIME, VOLTS, MEASURED, FORCE, STROKE, separator="\t")


def file(*lines: str, pressure: str = "p_valve", volts: str = "U_valve", rows: str = ROWS) -> str:
    """A log with the units in a row of their own."""
    above = [f"% {line}" for line in ("rest length 300 mm", *lines)]
    heads = [f"t\t{volts}\t{pressure}\tF\tstroke", "s\tV\tbar\tN\tmm"]
    return "\n".join([*above, *heads, rows])


@pytest.mark.parametrize(
    ("line", "volts", "said"),
    [
        ("pressure at the valve outlet (gauge), load cell", "U_valve", "line 2 says 'pressure at the valve"),
        ("load cell 5 kN", "U_valve", "the command is 'U_valve'"),
        ("Druckaufnehmer am Ventil, gemessen", "Kanal B", "line 2 says"),
    ],
)
def test_the_only_pressure_is_the_measured_one(line: str, volts: str, said: str) -> None:
    found = read(file(line, volts=volts), "a.dat")
    np.testing.assert_allclose(found.columns["pressure"], 1e5 * MEASURED, rtol=1e-6)
    assert any("'p_valve' is read as pressure" in message and said in message for message in found.messages)


@pytest.mark.parametrize(
    "pressure", ["p_valve_set", "p_valve_cmd", "p_Ventil_soll", "consigne vanne p", "valve ref"]
)
def test_a_set_point_stays_a_command(pressure: str) -> None:
    shown = preview(file("pressure at the valve outlet", pressure=pressure).encode(), "a.dat", Correction())
    assert not any(column.channel == "pressure" for column in shown.columns)


@pytest.mark.parametrize(
    "text",
    [
        file("p_valve: set pressure of the valve"),
        file("load cell", volts="Kanal B"),  # nothing says that it was measured
        file(rows=table(TIME, VOLTS, PRESSURE, FORCE, STROKE, separator="\t")),  # the command in bar
    ],
)
def test_without_evidence_it_is_asked_about(text: str) -> None:
    with pytest.raises(InputError, match="p_valve"):
        read(text, "a.dat")


def test_a_pressure_beside_it_is_the_pressure() -> None:
    text = "t [s],p_valve [bar],p_muscle [bar],F [N],stroke [mm]\n"
    with pytest.raises(InputError, match="p_valve"):
        read("# rest length 300 mm\n" + text + table(TIME, MEASURED + 0.2, MEASURED, FORCE, STROKE))
