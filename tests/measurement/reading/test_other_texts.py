"""Texts with remarks, scales and tables that lie on their side; texts of other kinds are refused by name."""

from __future__ import annotations

import json

import numpy as np
import pytest

from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read

ROWS = list(zip(TIME, PRESSURE, FORCE, STROKE, strict=True))
NAMES = ("t", "p", "F", "s")
UNITS = ("s", "bar", "N", "mm")


@pytest.mark.parametrize(
    ("name", "text", "what"),
    [
        ("a.yaml", "t_s: [0, 1]\np_bar: [1, 2]\n", "a YAML text"),
        ("a.yml", "- t_s: 0\n  p_bar: 1\n", "a YAML text"),
        ("a.toml", "t_s = [0, 1]\n", "a TOML text"),
        ("a.xml", "<data/>", "an XML text"),
        ("a.txt", "\ufeff \n<?xml version='1.0'?><data/>", "an XML text"),
        ("a.xls", "<html><table><tr><td>1</td></tr></table></html>", "a web page"),
        ("a.html", "<!DOCTYPE html><p>", "a web page"),
        ("a.tex", "\\begin{tabular}1 & 2\\end{tabular}", "a LaTeX text"),
        ("a.m", "p = [1 2 3]; % bar\n", "a script"),
        ("a.PY", "p = [1, 2, 3]\n", "a script"),
    ],
)
def test_a_text_that_is_no_table_is_refused_by_its_kind(name: str, text: str, what: str) -> None:
    with pytest.raises(InputError) as caught:
        read(text, name)
    assert caught.value.message == f"{name}: no column can be read: {what} is not a table that mckibben reads"
    assert (caught.value.field, caught.value.hint) == ("file", "save it as CSV or XLSX")


@pytest.mark.parametrize("name", ["a.yaml", "a.txt"])
@pytest.mark.parametrize("text", ["a: " + "[1," * 99, "[" * 300, "<a" * 150, "#" * 300, "\\SI[" * 60])
def test_short_texts_that_kept_their_readers_busy_are_refused(name: str, text: str) -> None:
    with pytest.raises(InputError) as caught:
        read(text, name)
    assert caught.value.message.startswith(name)
    assert caught.value.field


def test_a_table_on_its_side() -> None:
    lines = ["# rest length 300 mm"]
    heads = ("time [s]", "pressure [bar]", "force [N]", "shortening [mm]")
    lines += [
        f"{n};" + ";".join(f"{v:g}" for v in values)
        for n, values in zip(heads, zip(*ROWS, strict=True), strict=True)
    ]
    found = read("\n".join(lines))
    assert_is_the_test(found)
    assert any("is read turned" in message for message in found.messages)


def test_a_page_of_mean_values_with_deviations() -> None:
    rows = "\n".join(f"{t:g};{p:g};{f:g} ± 1.5;{s:g}" for t, p, f, s in ROWS)
    assert_is_the_test(read(f"# rest length 300 mm\nt [s];p [bar];F [N];shortening [mm]\n{rows}\n"))


def test_units_told_in_a_sentence() -> None:
    rows = "\n".join(";".join(f"{v:g}" for v in row) for row in ROWS)
    text = "muscle of 300 mm rest length\ntime in s, pressure in bar, force in N, shortening in mm\n"
    assert_is_the_test(read(f"{text}time;pressure;force;shortening\n{rows}\n"))


def test_columns_told_in_a_sentence_over_two_lines() -> None:
    rows = "\n".join(" ".join(f"{v:9g}" for v in row) for row in ROWS)
    text = (
        "A muscle of 300 mm rest length.\nThe four columns are: time in seconds, gauge pressure in bar,\n"
        f"force in newtons, and shortening in millimetres.\n\n{rows}\n"
    )
    assert_is_the_test(read(text))


def test_names_that_go_on_in_the_next_line() -> None:
    rows = "\n".join("".join(f"{v:12g}" for v in row) for row in ROWS)
    text = (
        "   RELAXED LENGTH 300 MM   GAUGE PRESSURE\n\n"
        "        TIME    PRESSURE       FORCE     MUSCLE\n"
        "                                     SHORTENING\n"
        f"         SEC         BAR           N          MM\n{rows}\n"
    )
    assert_is_the_test(read(text))


def test_numbers_kept_with_a_scale() -> None:
    channels = [
        {"name": "time", "unit": "s", "data": TIME.tolist()},
        {
            "name": "pressure",
            "unit": "bar",
            "scale": 0.001,
            "offset": 0.0,
            "data": np.round(PRESSURE * 1e3).tolist(),
        },
        {
            "name": "force",
            "unit": "N",
            "scale": 0.1,
            "offset": -50.0,
            "data": np.round(FORCE * 10 + 500).tolist(),
        },
        {"name": "shortening", "unit": "mm", "data": STROKE.tolist()},
    ]
    assert_is_the_test(read(json.dumps({"rest_length": "300 mm", "channels": channels}), "a.json"))


def test_thousands_of_remarks_are_not_all_searched() -> None:
    remarks = "".join(f"# run {number} was quiet\n" for number in range(3000))
    rows = "".join(f"{p},{10 * k},{100 - k}\n" for p in (1, 2) for k in range(5))
    found = read(f"# rest length 300 mm\n{remarks}p [bar],x [mm],F [N]\n{rows}")
    assert found.conditions["nominal_length"] == pytest.approx(0.3)
    assert any("only the first 2000 texts" in message for message in found.messages)
