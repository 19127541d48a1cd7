"""What words cannot tell, physics or the user does; what neither tells is asked."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading.physics import ATMOSPHERE
from tests.measurement.reading.bench import (
    ABOVE,
    FORCE,
    PRESSURE,
    REST,
    SI,
    STROKE,
    TIME,
    Array,
    asked,
    assert_is,
    plain,
    read,
    refusal,
    said,
    table,
)

BAR, MM = PRESSURE / 1e5, STROKE * 1e3
HEADS = "time [s],pressure [bar],force [N],stroke [mm]"


def text(heads: str, *columns: Array, above: str = ABOVE) -> str:
    return f"{above}{heads}\n{table(*columns)}\n"


@pytest.mark.parametrize(("force", "stroke"), [(-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)])
def test_physics_settles_signs_that_no_word_says_and_it_is_said(force: float, stroke: float) -> None:
    data = text(HEADS, TIME, BAR, force * FORCE, stroke * MM)
    found = read(data)
    assert_is(found)
    turned = {f"sign of {name}" for name, sign in (("force", force), ("displacement", stroke)) if sign < 0}
    assert turned <= set(asked(data))
    assert sum("sign reversed" in message for message in found.messages) >= len(turned)


def test_words_beside_the_table_say_signs_and_the_message_names_them() -> None:
    found = read(text(HEADS, TIME, BAR, -FORCE, MM, above=f"{ABOVE}# compression positive\n"))
    assert_is(found)
    assert any("compression positive" in message for message in found.messages)


@pytest.mark.parametrize(
    ("head", "column", "above"),
    [
        ("pressure [bar abs]", (PRESSURE + ATMOSPHERE) / 1e5, ABOVE),
        ("pressure [bara]", (PRESSURE + ATMOSPHERE) / 1e5, ABOVE),
        ("pressure [kPa]", (PRESSURE + 1e5) / 1e3, f"{ABOVE}# absolute pressure, barometer 1000 hPa\n"),
        ("pressure [psig]", PRESSURE / 6894.757293168361, ABOVE),
        ("pressure [kgf/cm2]", PRESSURE / 98066.5, ABOVE),
    ],
)
def test_units_and_references_of_pressure(head: str, column: Array, above: str) -> None:
    assert_is(read(text(f"time [s],{head},force [N],stroke [mm]", TIME, column, FORCE, MM, above=above)))


def test_a_pressure_that_shows_the_air_at_rest_is_asked_about() -> None:
    pressure = np.where(TIME < 8.0, 0.0, PRESSURE)
    force = np.where(TIME < 8.0, 0.0, FORCE)
    stroke = np.where(TIME < 8.0, 0.0, STROKE)
    data = text(
        "time [s],pressure [bar],force [N],stroke [mm]",
        TIME,
        (pressure + ATMOSPHERE) / 1e5,
        force,
        stroke * 1e3,
    )
    assert asked(data)["reference of pressure"]
    answered = read(data, correction=said(["pressure=pressure [bar(a)]"]))
    np.testing.assert_allclose(answered.columns["pressure"], pressure, atol=1.0)


def test_a_unit_that_nobody_says_is_asked_for_with_its_proposal() -> None:
    data = text("time [s],pressure,force [N],stroke [mm]", TIME, BAR, FORCE, MM)
    assert asked(data)["unit of pressure"]
    assert_is(read(data, correction=said(["pressure=pressure [bar]"])))
    si = text("time,pressure,force,displacement", TIME, PRESSURE, FORCE, STROKE)
    assert_is(read(si))  # SI throughout needs no question


def test_a_word_in_brackets_that_is_no_unit_is_asked_about() -> None:
    assert asked(text("time [s],pressure [parsnip],force [N],stroke [mm]", TIME, PRESSURE, FORCE, MM))[
        "unit of pressure"
    ]


def test_a_unit_of_something_else_is_asked_about() -> None:
    assert asked(text("time [s],pressure [kg],force [N],stroke [mm]", TIME, BAR, FORCE, MM))[
        "unit of pressure"
    ]


@pytest.mark.parametrize(
    ("heads", "columns", "subject"),
    [
        (f"{HEADS},Traverse [mm]", (TIME, BAR, FORCE, MM, MM + FORCE / 500), "Traverse"),
        ("time [s],p_soll [bar],force [N],stroke [mm]", (TIME, BAR, FORCE, MM), "p_soll"),
        (
            "time [s],pressure [bar],force top [N],force bottom [N],stroke [mm]",
            (TIME, BAR, FORCE, 0.8 * FORCE, MM),
            "force",
        ),
        ("time [s],pressure [V],force [N],stroke [mm]", (TIME, BAR / 2, FORCE, MM), "pressure"),
        ("time [s],a,b,c", (TIME, BAR, FORCE, MM), "column"),
    ],
)
def test_what_is_always_asked(heads: str, columns: tuple[Array, ...], subject: str) -> None:
    assert subject in refusal(text(heads, *columns)) or any(
        subject in about for about in asked(text(heads, *columns))
    )


def test_a_position_that_grows_as_the_muscle_lengthens_has_no_zero() -> None:
    data = text("time [s],pressure [bar],force [N],position [mm]", TIME, BAR, FORCE, 60.0 - MM)
    assert asked(data)["zero of displacement"]
    found = read(data, correction=said(["length=position [0 to 60 mm = 240 to 300 mm]"]))
    np.testing.assert_allclose(found.columns["length"], REST - STROKE, atol=1e-6)


def test_a_position_of_the_machine_is_asked_about_once() -> None:
    data = text("time [s],pressure [bar],force [N],position [mm]", TIME, BAR, FORCE, 731.0 - MM)
    assert [about for about, stops in asked(data).items() if stops] == ["zero of displacement"]
    found = read(data, correction=said(["length=position [671 to 731 mm = 240 to 300 mm]"]))
    np.testing.assert_allclose(found.columns["length"], REST - STROKE, atol=1e-6)


@pytest.mark.parametrize(("head", "read_so"), [("line pressure", True), ("supply pressure", False)])
def test_the_only_pressure_is_no_supply_where_it_has_several_levels(head: str, *, read_so: bool) -> None:
    noise = 0.01 * np.sin(37.0 * np.arange(len(BAR)))
    data = text(f"time [s],{head} [bar],force [N],stroke [mm]", TIME, BAR + noise, FORCE, MM)
    assert any("column" in about for about in asked(data)) is not read_so
    if read_so:
        np.testing.assert_allclose(read(data).columns["pressure"], (BAR + noise) * 1e5, atol=1.0)


@pytest.mark.parametrize(
    "scale",
    [
        "pressure: 2 bar/V", "pressure sensor 0-10 V = 0-20 bar", "pressure 0.5 V = 1 bar, 4.5 V = 9 bar",
        "pressure: 1 V = 2 bar",
    ],
)  # fmt: skip
def test_volts_are_read_by_the_scale_that_a_text_states(scale: str) -> None:
    above = f"{ABOVE}# {scale}\n"
    assert_is(
        read(text("time [s],pressure [V],force [N],stroke [mm]", TIME, BAR / 2, FORCE, MM, above=above))
    )


def test_a_voltage_of_a_valve_can_wait() -> None:
    data = text(f"{HEADS},valve [V]", TIME, BAR, FORCE, MM, 5.0 + 0.0 * TIME)
    assert asked(data)["scale of command"] is False
    assert_is(read(data))


def test_what_the_user_says_is_never_overruled() -> None:
    data = text(HEADS, TIME, BAR, FORCE, MM)
    kept = read(data, correction=said(["force=-force [kN]", "pressure=pressure [psi]"]))
    np.testing.assert_allclose(kept.columns["force"], -1e3 * FORCE, rtol=1e-6)
    np.testing.assert_allclose(kept.columns["pressure"], BAR * 6894.757293168361, rtol=1e-6)


def test_two_stated_lengths_are_asked_about_and_the_users_holds() -> None:
    data = text(HEADS, TIME, BAR, FORCE, MM, above="# rest length 300 mm\n# Ruhelänge 290 mm\n")
    assert asked(data)["rest length"]
    assert read(data, correction=said(rest_length="300 mm")).conditions["nominal_length"] == REST


def test_an_impossible_rest_length_is_asked_about() -> None:
    assert asked(text(HEADS, TIME, BAR, FORCE, MM, above="# rest length 30 mm\n"))["rest length"]


def test_a_force_from_a_torque_and_its_lever_row_by_row() -> None:
    arm = 30.0 + 5.0 * np.sin(TIME)
    data = text(
        "time [s],pressure [bar],torque [N*m],moment arm [mm],stroke [mm]",
        TIME,
        BAR,
        FORCE * arm / 1e3,
        arm,
        MM,
    )
    assert_is(read(data))


@pytest.mark.parametrize("column", ["L0 [mm]", "Ruhelänge [mm]"])
def test_a_column_of_one_value_is_a_condition(column: str) -> None:
    assert_is(read(text(f"{HEADS},{column}", TIME, BAR, FORCE, MM, 300.0 + 0.0 * TIME, above="")), SI)


def test_a_cell_that_is_no_number_stops_the_reading_until_its_row_may_go() -> None:
    lines = plain().splitlines()
    lines[8] = lines[8].replace(",", ",oops", 1)
    data = "\n".join(lines)
    assert "row 9" in refusal(data)
    skipping = said()
    from dataclasses import replace

    found = read(data, correction=replace(skipping, skip_bad_rows=True))
    assert found.rows == len(TIME) - 1
    assert sum(found.skipped.values()) == 1


def test_marks_for_no_reading_are_left_out_with_a_count() -> None:
    lines = plain().splitlines()
    for row, mark in ((8, "OL"), (11, "NaN"), (14, "-9999")):
        cells = lines[row].split(",")
        lines[row] = ",".join([cells[0], cells[1], mark, cells[3]])
    assert read("\n".join(lines)).rows == len(TIME) - 3
