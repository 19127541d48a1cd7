"""What stands among readings or is said of them: events, slow signals, hangers, lost samples, lengths."""

from __future__ import annotations

import json

import numpy as np
import pytest

from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.correction import Correction
from mckibben.measurement.reading.evidence import stated_marks
from mckibben.measurement.reading.model import Span, Table
from mckibben.measurement.reading.zeros import hangers_in
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read, table

HEAD = "# rest length 300 mm\nt [s],p [bar],F [N],shortening [mm]\n"
KILOGRAM = 9.80665  # N, standard gravity


def lines() -> list[str]:
    return table(TIME, PRESSURE, FORCE, STROKE).split("\n")


def test_events_between_readings_are_said_and_left_out() -> None:
    rows = lines()
    rows.insert(10, "4.9,valve opened to fill,,")
    rows.insert(30, "14.4,operator pressed stop,,")
    found = read(HEAD + "\n".join(rows))
    assert_is_the_test(found)
    assert any("valve opened to fill" in message for message in found.messages)


def test_a_reading_with_a_wrong_cell_is_no_event() -> None:
    rows = lines()
    rows[10] = rows[10].rsplit(",", 1)[0] + ",wrong"
    with pytest.raises(InputError, match="wrong"):
        read(HEAD + "\n".join(rows))


def test_a_signal_that_was_sampled_more_slowly_is_not_carried_on() -> None:
    time = np.arange(100) * 0.1
    pressure = 1.0 + np.concatenate([np.arange(50), np.arange(50)[::-1]]) / 12.5
    rows = [
        f"{t:g};{p:g};{f'{40 * p:g}' if n % 5 == 0 else ''};{'285' if n % 5 == 0 else ''}"
        for n, (t, p) in enumerate(zip(time, pressure, strict=True))
    ]
    found = read("# rest length 300 mm\nt [s];p [bar];F [N];L [mm]\n" + "\n".join(rows))
    np.testing.assert_allclose(found.columns["pressure"], pressure[::5] * 1e5)
    np.testing.assert_allclose(found.columns["force"], 40.0 * pressure[::5])


#: Sentence -> (weight in kg, whether the loads contain it).
HANGERS = {
    "The hanger weighs 0.45 kg and is not included in the masses": (0.45, False),
    "masses include the 450 g hanger": (0.45, True),
    "weights on a 450 g hanger": (0.45, None),
    "Gehänge 0,45 kg kommt dazu": (0.45, False),
}


@pytest.mark.parametrize("text", HANGERS)
def test_what_a_sentence_says_of_a_hanger(text: str) -> None:
    (hanger,) = hangers_in(Span("line 1", text))
    mass, contained = HANGERS[text]
    np.testing.assert_allclose(hanger.weight, mass * KILOGRAM)
    assert hanger.contained is contained


@pytest.mark.parametrize("text", ["a mass of 5 kg", "the hanger is made of steel", "hanger length 45 mm"])
def test_what_is_no_hanger_with_a_mass(text: str) -> None:
    assert list(hangers_in(Span("line 1", text))) == []


def test_a_hanger_is_added_to_the_load_of_the_whole_test() -> None:
    rows = table(TIME, PRESSURE, STROKE)
    head = "# rest length 300 mm\n# load 5 kg\n# plus a hanger of 0.5 kg\n"
    found = read(f"{head}t [s],p [bar],shortening [mm]\n{rows}")
    assert found.conditions["load_mass"] == pytest.approx(5.5)
    assert any("0.5 kg is added to the load for the hanger" in message for message in found.messages)


MASSES = np.repeat([5.0, 10.0, 20.0], 8)
LENGTHS = 290.0 - np.tile(np.arange(8.0), 3) * 5.0 + MASSES / 5.0
LOADED = "mass [kg];p [bar];length [mm]\n" + table(
    MASSES, np.tile(np.arange(1.0, 9.0) / 1.5, 3), LENGTHS, separator=";"
)


def test_a_hanger_is_added_where_the_file_says_that_the_masses_lack_it() -> None:
    found = read(f"# rest length 300 mm\n# the hanger (0.5 kg) is not included in the mass\n{LOADED}")
    np.testing.assert_allclose(found.columns["force"], (MASSES + 0.5) * KILOGRAM)
    assert any(message.startswith("4.90332 N is added to the force: ") for message in found.messages)
    included = read(f"# rest length 300 mm\n# the mass includes the hanger of 0.5 kg\n{LOADED}")
    np.testing.assert_allclose(included.columns["force"], MASSES * KILOGRAM)


def test_a_hanger_that_the_masses_may_contain_is_asked_about() -> None:
    text = f"# rest length 300 mm\n# weights on a hanger of 0.5 kg\n{LOADED}".encode()
    with pytest.raises(InputError, match="hanger"):
        read(text)
    answered = read_measurement(text, "a.csv", Correction(conditions={"force_zero": 0.0}))
    np.testing.assert_allclose(answered.columns["force"], MASSES * KILOGRAM)


def test_numbers_that_a_text_says_to_be_no_reading() -> None:
    rows = lines()
    cells = rows[7].split(",")
    cells[2] = "-1.0"
    rows[7] = ",".join(cells)
    found = read(f"# a force of -1.0 marks a lost sample\n{HEAD}" + "\n".join(rows))
    assert found.rows == len(rows) - 1
    assert min(found.columns["force"]) > 0.0
    assert any("means no reading" in message for message in found.messages)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("9999 = sensor error", [9999.0]), ("lost samples are entered as -1.0", [-1.0]),
        ("max. force error 0.5 N", []), ("3 samples lost", []), ("error = 0.5 %", []), ("error = 0.5", []),
        ("-1.0 is the lowest force", []), ("NoValue: -9999", [-9999.0]),
    ],
)  # fmt: skip
def test_which_numbers_stand_for_no_reading(text: str, expected: list[float]) -> None:
    beside = Table((), (Span("line 1", text),), np.zeros(0, np.intp))
    assert [mark for mark, _ in stated_marks(beside)] == expected


def test_keys_and_values_with_units_and_time_stamps() -> None:
    rows = []
    for t, p, f, s in zip(TIME, PRESSURE, FORCE, STROKE, strict=True):
        rows.append(f"10:02:{t:06.3f} SET  p={p:g} bar")
        rows.append(f"10:02:{t:06.3f} READ p={p:g} bar  F={f:g} N  s={s:g} mm")
    found = read("session of a muscle, rest length 300 mm, s is the shortening\n" + "\n".join(rows), "a.log")
    assert_is_the_test(found)
    np.testing.assert_allclose(found.columns["time"], TIME)


HELD = "t [s],p [bar],F [N]\n" + table(TIME, np.linspace(1.0, 5.0, 40), np.linspace(90.0, 600.0, 40))


def test_a_length_at_which_a_text_says_that_the_muscle_was_held() -> None:
    found = read(f"# rest length 300 mm, clamped at 285 mm (isometric)\n{HELD}")
    np.testing.assert_allclose(found.columns["length"], 0.285)
    assert found.kind == "isometric"


@pytest.mark.parametrize(
    "remark",
    ["tube of 25 mm radius at the inlet", "hose 6 mm", "rest length 300 mm", "stroke of the stage 0-100 mm"],
)
def test_other_lengths_are_not_those_at_which_it_was_held(remark: str) -> None:
    assert "length" not in read(f"# {remark}\n{HELD}").columns
    assert "displacement" not in read(f"# {remark}\n{HELD}").columns


def test_an_isometric_test_without_a_length_is_refused_and_so_are_two() -> None:
    with pytest.raises(InputError, match="length at which"):
        read(f"# isometric test, rest length 300 mm\n{HELD}")
    with pytest.raises(InputError, match="several"):
        read(f"# rest length 300 mm\n# clamped at 285 mm\n# clamped at 270 mm\n{HELD}")


@pytest.mark.parametrize("remark", ["# tare: 4.2", "Tara: 4.2", "# zero of the load cell, tare 4.2"])
def test_a_tare_without_unit_is_asked_about(remark: str) -> None:
    with pytest.raises(InputError) as caught:
        read(f"{remark}\n{HEAD}" + "\n".join(lines()))
    assert "without a unit" in str(caught.value)
    assert 'force_zero=4.2 N"' in str(caught.value)


def test_a_time_in_ticks_keeps_the_name_of_its_column() -> None:
    rows = table(TIME * 100.0 + 5000.0, PRESSURE, FORCE, STROKE)
    found = read(f"# rest length 300 mm\n# 1 tick = 10 ms\ntick,p [bar],F [N],shortening [mm]\n{rows}")
    np.testing.assert_allclose(found.columns["time"], TIME, atol=1e-9)
    assert next(channel.column for channel in found.channels if channel.name == "time") == "tick"


def test_the_states_of_a_valve_by_numbers() -> None:
    states = np.repeat([1, 2, 0, 1], 10)
    text = "# rest length 300 mm, supply 6 bar, load 5 kg\n# valve_state: 0 = exhaust, 1 = closed, 2 = fill\n"
    rows = table(TIME, PRESSURE, STROKE, states)
    found = read(f"{text}t [s],p [bar],shortening [mm],valve_state\n{rows}")
    np.testing.assert_allclose(found.columns["command"], states - 1.0)


@pytest.mark.parametrize(
    ("remark", "sign"),
    [
        ("sign of the load cell: compression +, tension -", -1.0),
        ("load cell: tension +, compression -", 1.0),
        ("load cell 0-5 kN", 1.0),
    ],
)
def test_a_sign_behind_its_word(remark: str, sign: float) -> None:
    rows = table(TIME, PRESSURE, sign * FORCE, STROKE)
    assert_is_the_test(read(f"# {remark}\n{HEAD}{rows}"))


def test_samples_at_a_rate_and_encoder_steps_in_words() -> None:
    text = (
        "# rest length 300 mm\n# sampled at 200 Hz\n"
        "# encoder: 5 um per count, 0 at the rest length, counts {}\n"
    )
    head = "sample\tp [bar]\tF [N]\tencoder [counts]\n"
    for words, sign in (("up as the muscle shortens", 1.0), ("down as the muscle shortens", -1.0)):
        rows = table(np.arange(len(TIME)), PRESSURE, FORCE, sign * STROKE * 200.0, separator="\t")
        found = read(text.format(words) + head + rows)
        assert_is_the_test(found)
        np.testing.assert_allclose(found.columns["time"], np.arange(len(TIME)) / 200.0)


def test_header_lines_of_json_with_quantities_and_units() -> None:
    units = {"t": "s", "p": "bar", "F": "N", "s": "mm"}
    head = {"type": "header", "L0": {"value": 0.3, "unit": "m"}, "units": units, "s": "shortening"}
    rows = [json.dumps(head)]
    for number, row in enumerate(zip(TIME, PRESSURE, FORCE, STROKE, strict=True)):
        rows.append(json.dumps(dict(zip(("type", *units), ("data", *map(float, row)), strict=True))))
        if number % 10 == 5:
            rows.append(json.dumps({"type": "event", "t": float(row[0]), "msg": "reversal"}))
    assert_is_the_test(read("\n".join(rows), "a.ndjson"))


def test_loads_in_the_titles_of_sections_make_an_isotonic_test() -> None:
    pressure = np.arange(2.0, 6.0, 0.25)
    sections = [
        f"\nload {mass} kg\np [bar]\tL [mm]\n"
        + table(pressure, 290.0 - 10.0 * pressure + mass, separator="\t")
        for mass in (3, 8, 15)
    ]
    found = read("muscle, rest length 300 mm\n" + "\n".join(sections), "a.txt")
    assert found.kind == "isotonic"
    np.testing.assert_allclose(found.columns["force"], np.repeat([3.0, 8.0, 15.0], len(pressure)) * KILOGRAM)


def test_names_above_and_ways_with_units_below() -> None:
    rows = "\n".join(f"{e};{500 - 20 * e};{470 - 20 * e}" for e in range(20))
    found = read(
        f"# rest length 300 mm, pressure 4 bar\nKontraktion;Kraft;\n[%];Belasten [N];Entlasten [N]\n{rows}"
    )
    assert found.rows == 40
    # A load that grows stretches a muscle: loading began at the shortest length, unloading ends there.
    there = np.arange(20)[::-1] / 100.0
    np.testing.assert_allclose(found.columns["contraction"], np.concatenate([there, there[::-1]]))
    np.testing.assert_allclose(found.columns["force"][[0, 19, 20, 39]], [120.0, 500.0, 470.0, 90.0])
    assert found.columns["direction"].tolist() == 20 * [1.0] + 20 * [-1.0]


def test_strokes_of_loading_and_unloading_beside_one_weight() -> None:
    """The weights grow down the table: loading went down it, although the stroke falls, and unloading up."""
    rows = "\n".join(f"{20 + 5 * n};{60 - 2 * n};{57 - 2 * n}" for n in range(12))
    found = read(
        f"# rest length 300 mm, pressure 3 bar\nKraft [N];Hub Belasten [mm];Hub Entlasten [mm]\n{rows}"
    )
    weights = 20.0 + 5.0 * np.arange(12)
    np.testing.assert_allclose(found.columns["force"], np.concatenate([weights, weights[::-1]]))
    assert found.columns["direction"].tolist() == 12 * [1.0] + 12 * [-1.0]
