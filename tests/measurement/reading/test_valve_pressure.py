"""A pressure that is named after the valve, beside the command of the valve."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading import Correction, preview
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, read, table

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
        (
            "pressure at the valve outlet (gauge), load cell",
            "U_valve",
            "line 2 says '% pressure at the valve",
        ),
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
    assert [
        q.text for q in shown.questions if q.stops and q.column == pressure and "is a set value" in q.text
    ]


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
    found = read("# rest length 300 mm\n" + text + table(TIME, MEASURED + 0.2, MEASURED, FORCE, STROKE))
    np.testing.assert_allclose(found.columns["pressure"], 1e5 * MEASURED, rtol=1e-6)
    assert ("p_valve [bar]", "it is the pressure at the valve") in found.unread


def steps(*, sensed: bool) -> str:
    """Steps of a valve without any other command; the pressure as it was set, or as a sensor reads it."""
    level = np.repeat([1.0, 3.0, 5.0, 2.0, 4.0], 80)
    time = 0.01 * np.arange(len(level))
    pressure = level.copy()
    if sensed:
        for row in range(1, len(level)):
            pressure[row] = pressure[row - 1] + 0.3 * (level[row] - pressure[row - 1])
        pressure += np.random.default_rng(5).normal(0.0, 0.008, len(level))
    force = 100.0 * pressure + np.random.default_rng(6).normal(0.0, 2.0, len(level))
    length = np.full(len(level), 285.0)
    return "t_s,p_valve_bar,length_mm,force_N\n" + table(time, pressure.round(4), length, force)


def test_a_pressure_that_scatters_as_a_sensor_does_is_read_and_said() -> None:
    found = read(steps(sensed=True))
    assert found.kind == "isometric"
    said = [m for m in found.messages if "'p_valve_bar' is read as pressure" in m]
    assert len(said) == 1
    assert "scatter" in said[0]
    with pytest.raises(InputError, match="p_valve"):
        read(steps(sensed=False))


@pytest.mark.parametrize(
    "head", ["Command (kPa)", "command_kPa", "valve command [kPa]", "Befehl [kPa]", "Commande pression [kPa]"]
)
def test_a_command_in_a_unit_of_pressure_is_a_set_value(head: str) -> None:
    rows = table(TIME, 100.0 * PRESSURE.round(0), 100.0 * MEASURED, FORCE, STROKE)
    found = read(f"# rest length 300 mm\nt [s],{head},Muscle pressure (kPa),F [N],stroke [mm]\n{rows}")
    np.testing.assert_allclose(found.columns["pressure"], 1e5 * MEASURED, rtol=1e-6)
    assert (head, "it is a set value") in found.unread


@pytest.mark.parametrize("head", ["Command (bar)", "command_bar", "set pressure [bar]"])
def test_alone_it_is_asked_about_as_any_set_pressure(head: str) -> None:
    with pytest.raises(InputError, match="is a set value, and no measured pressure is there; take it"):
        read(f"# rest length 300 mm\nt [s],{head},F [N],stroke [mm]\n" + table(TIME, PRESSURE, FORCE, STROKE))


def test_a_command_that_is_a_share_stays_the_command() -> None:
    rows = table(TIME, PRESSURE / 10.0, MEASURED, FORCE, STROKE)
    found = read(f"# rest length 300 mm\nt [s],command,p [bar],F [N],stroke [mm]\n{rows}")
    np.testing.assert_allclose(found.columns["command"], PRESSURE / 10.0, rtol=1e-6)


@pytest.mark.parametrize(
    ("set_value", "reading"),
    [
        ("p_des [bar]", "p_act [bar]"),
        ("Regulator setpoint (bar)", "Regulator feedback (bar)"),
        ("ITV command [bar]", "ITV monitor [bar]"),
        ("Vorgabe Druck [bar]", "Druck [bar]"),
    ],
)
def test_what_was_desired_stands_beside_what_was_read(set_value: str, reading: str) -> None:
    rows = table(TIME, PRESSURE, MEASURED, FORCE, STROKE)
    found = read(f"# rest length 300 mm\nt [s],{set_value},{reading},F [N],stroke [mm]\n{rows}")
    np.testing.assert_allclose(found.columns["pressure"], 1e5 * MEASURED, rtol=1e-6)
    assert (set_value, "it is a set value") in found.unread


def test_a_commanded_position_is_no_stroke() -> None:
    rows = table(STROKE.round(-1), STROKE, MEASURED, FORCE)
    found = read(f"# rest length 300 mm\nAxial Command (mm),Stroke (mm),p [bar],F [N]\n{rows}")
    np.testing.assert_allclose(found.columns["displacement"], STROKE / 1e3, atol=1e-9)
