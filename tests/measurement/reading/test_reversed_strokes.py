"""Strokes that count the other way: turned where nothing leaves a doubt, else asked about."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import preview, read_measurement, spoken_correction
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, table

SIGN = "sign of displacement"


def file(head: str, stroke: np.ndarray = -STROKE, *above: str, pressure: bool = True) -> bytes:
    """A log whose stroke has this head."""
    lines = [f"# {line}" for line in ("rest length 300 mm", *above)]
    columns = (TIME, PRESSURE, FORCE, stroke) if pressure else (TIME, FORCE, stroke)
    heads = f"t [s],{'p [bar],' if pressure else ''}F [N],{head}"
    return "\n".join([*lines, heads, table(*columns)]).encode()


def turned(data: bytes, name: str = "a.csv") -> Measurement:
    """The measurement, of which it is said that its stroke was turned."""
    found = read_measurement(data, name)
    (question,) = [q for q in found.questions if q.about == SIGN]
    assert not question.stops
    assert question.proposed == "reverse the sign"
    assert any("has its sign reversed: no words say it, but so the force falls" in m for m in found.messages)
    return found


def test_a_negative_stroke_that_readings_show_to_shorten_is_turned() -> None:
    assert_is_the_test(turned(file("Axial Displacement [mm]")))


@pytest.mark.parametrize("pressure", [True, False])
@pytest.mark.parametrize("head", ["Extension [mm]", "Verlängerung [mm]", "Allongement (mm)", "ΔL [mm]"])
def test_a_name_that_says_it_is_said_and_not_asked_about(head: str, pressure: bool) -> None:
    found = read_measurement(file(head, pressure=pressure), "a.csv")
    np.testing.assert_allclose(found.columns["displacement"], STROKE / 1e3, atol=1e-9)
    assert any(f"'{head}' has its sign reversed: '{head}' (line 2, column" in m for m in found.messages)
    assert SIGN not in [question.about for question in found.questions]


def test_a_negative_contraction_is_turned() -> None:
    found = read_measurement(file("strain [%]", -STROKE / 3.0), "a.csv")
    np.testing.assert_allclose(found.columns["contraction"], STROKE / 300.0, atol=1e-8)


def test_a_turn_that_neither_readings_nor_words_show_is_asked_about() -> None:
    with pytest.raises(InputError, match=r"sign reversed.*hardly show it"):
        read_measurement(file("stroke [mm]", pressure=False), "a.csv")


def test_a_pressure_in_the_name_of_the_file_is_seen() -> None:
    rows = table(TIME[:20], FORCE[:20], -STROKE[:20])
    data = f"# rest length 300 mm\nt [s],F [N],Axial Displacement [mm]\n{rows}".encode()
    np.testing.assert_allclose(turned(data, "muscle_2bar.csv").columns["displacement"], STROKE[:20] / 1e3)


def test_the_user_may_keep_the_sign_or_confirm_the_turn() -> None:
    data = file("Extension [mm]")
    for minus, sign in (("", -1.0), ("-", 1.0)):
        answer = spoken_correction(columns=[f"displacement={minus}Extension"])
        found = preview(data, "a.csv", answer)
        assert found.points["displacement"] == pytest.approx(sign * STROKE / 1e3)
        assert SIGN not in [question.about for question in found.questions]


def test_strict_refuses_until_it_is_confirmed() -> None:
    data = file("Axial Displacement [mm]")
    with pytest.raises(InputError, match='displacement=-Axial Displacement" or --column "displacement=Axial'):
        read_measurement(data, "a.csv", spoken_correction(strict=True))
    confirmed = spoken_correction(strict=True, columns=["displacement=-Axial Displacement"])
    assert_is_the_test(read_measurement(data, "a.csv", confirmed))


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (file("position [mm]", 60.0 - STROKE), "which length has it"),  # could be a length
        (file("stroke [mm]", -STROKE, "shortening positive"), r"'# shortening positive' \(line 2\) says"),
        (file("stroke [mm]", -np.full(len(STROKE), 20.0)), "hardly show it"),  # held: nothing shows it
    ],
)
def test_what_leaves_a_doubt_is_asked(data: bytes, why: str) -> None:
    with pytest.raises(InputError, match=why):
        read_measurement(data, "a.csv")


def test_what_readings_contradict_is_left_as_it_is() -> None:
    found = read_measurement(file("Extension [mm]", STROKE), "a.csv")
    assert_is_the_test(found)
    assert SIGN not in [question.about for question in found.questions]


def test_ways_of_the_test_are_told_by_the_turned_stroke() -> None:
    ways = ["out"] * 10 + ["back"] * 10
    rows = [
        f"{p:g},{f:g},{s:g},{w}"
        for p, f, s, w in zip(PRESSURE, FORCE, -STROKE, 2 * ways, strict=True)
    ]  # fmt: skip
    plain = "\n".join(rows).replace(",-", ",")
    head = "# rest length 300 mm\np [bar],F [N],{},direction\n"
    found = read_measurement((head.format("Extension [mm]") + "\n".join(rows)).encode(), "a.csv")
    other = read_measurement((head.format("stroke [mm]") + plain).encode(), "a.csv")
    np.testing.assert_array_equal(found.columns["direction"], other.columns["direction"])
    assert [m for m in found.messages if "direction read" in m] == [
        m for m in other.messages if "direction read" in m
    ]


@pytest.mark.parametrize(
    ("head", "way"),
    [
        ("Δl/l0 [-]", -1.0),
        ("dL/L0", -1.0),
        ("∆L/L₀ [%]", -1.0),
        ("(L - L0)/L0 [%]", -1.0),
        ("ε = ΔL/L0 [%]", -1.0),
        ("ΔL/L0 [%]", 1.0),  # of what the muscle becomes shorter: the readings show it
        ("(L0-L)/L0 [%]", 1.0),
    ],
)
def test_a_change_of_length_over_the_rest_length_is_the_contraction(head: str, way: float) -> None:
    """It was left out as "a length at rest", and nothing was left to compare."""
    found = read_measurement(file(head, way * STROKE / (3.0 if "%" in head else 300.0)), "a.csv")
    np.testing.assert_allclose(found.columns["contraction"], STROKE / 300.0, atol=1e-8)
    assert any(f"'{head}' has its sign reversed: '{head}'" in m for m in found.messages) == (way < 0.0)
    assert "sign of contraction" not in [question.about for question in found.questions]


@pytest.mark.parametrize("head", ["Extensometer (mm)", "Crosshead [mm]", "3 <Wire> (mm)"])
def test_a_stroke_without_a_name_below_zero_is_proposed_with_its_sign_reversed(head: str) -> None:
    data = file(head)
    found = preview(data, "a.csv")
    assert found.measurement is not None
    assert_is_the_test(found.measurement)
    (question,) = [q for q in found.questions if q.column == head]
    assert "read as displacement, with its sign reversed, because of its unit" in question.text
    assert (question.proposed, question.stops) == ("displacement", False)
    assert next(column.sign for column in found.columns if column.header == head) == -1
    with pytest.raises(InputError, match=r"shortening positive.*says otherwise"):
        read_measurement(file(head, -STROKE, "shortening positive"), "a.csv")
