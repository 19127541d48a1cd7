"""Heads of tables in the words of laboratories: channel, unit, reference, or why they are none."""

from __future__ import annotations

from collections import Counter

import pytest

from mckibben.measurement.read import words
from mckibben.measurement.read.head_text import taken_apart, without_run
from mckibben.measurement.read.held import held_quantities
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.words import cells

#: Head -> (channel, unit, absolute).
HEADS = {
    "Prüfzeit": ("time", None, None),
    "Standardkraft [N]": ("force", "N", None),
    "Kraftaufnehmer U10M (kN)": ("force", "kN", None),
    "Wegaufnehmer WA100 [mm]": ("displacement", "mm", None),
    "Innendruck (Ü)": ("pressure", None, False),
    "Druck [bar (a)]": ("pressure", "bar", True),
    "Druck abs. [mbar]": ("pressure", "mbar", True),
    "102 Pressure (psig)": ("pressure", "psi", False),
    "p_abs_mbar": ("pressure", "mbar", True),
    "p / bar": ("pressure", "bar", None),
    "s / mm": ("displacement", "mm", None),
    "F1 [N]": ("force", "N", None),
    "Zeit_s_": ("time", "s", None),
    "Kraft in kN": ("force", "kN", None),
    "Kraft, N": ("force", "N", None),
    "AI 1/Pressure [bar]": ("pressure", "bar", None),
    "Time (hh:mm:ss,ms)": ("time", "clock", None),
    "Pression relative [kPa]": ("pressure", "kPa", False),
    "Effort [daN]": ("force", "daN", None),
    "Raccourcissement [mm]": ("displacement", "mm", None),
    "Presión (kgf/cm2)": ("pressure", "kgf/cm2", None),
    "Corsa [mm]": ("displacement", "mm", None),
    "Forza [N]": ("force", "N", None),
    "Lunghezza [mm]": ("length", "mm", None),
    "Kontraktion [%]": ("contraction", "%", None),
    "Last [kg]": ("force", "kg", None),
    "Kanal 3 [N]": ("force", "N", None),  # by its unit alone
    "dL (база), мм": ("displacement", "mm", None),  # no diameter
    "ΔL [mm]": ("displacement", "mm", None),
    "d [mm]": ("diameter", "mm", None),
    "dx [mm]": ("displacement", "mm", None),
}


@pytest.mark.parametrize("head", HEADS)
def test_what_a_head_means(head: str) -> None:
    found = recognise(head)
    assert (found.channel, found.unit, found.absolute) == HEADS[head]


#: Head -> a word of the reason.
NONE_OF_OURS = {
    "Solldruck [bar]": "set value",
    "Versorgungsdruck [bar]": "supply",
    "Umgebungsdruck [mbar]": "surrounding",
    "nominal length [mm]": "rest",
    "Vorkraft [N]": "preload",
    "Load cell [mV]": "voltage",
    "cDAQ1Mod1/ai0 pressure [V]": "voltage",
    "adc [counts]": "counts",
    "Innendurchmesser [mm]": "size of the tube",
    "Traverse [mm]": "not known",
    "Bemerkung": "remark",
    "Lfd. Nr.": "running number",
    "Sensor A": "not known",
    "valve position": "command and displacement",
}


@pytest.mark.parametrize("head", NONE_OF_OURS)
def test_why_a_head_is_no_channel(head: str) -> None:
    found = recognise(head)
    assert found.channel is None
    assert found.left_out is not None
    assert NONE_OF_OURS[head] in found.left_out.text


def test_units_that_stand_apart() -> None:
    assert recognise("Kraft", "kN")[:2] == ("force", "kN")
    assert recognise("Kraft", "2,0 mV/V")[:2] == ("force", None)
    assert recognise("Druck", "V").channel is None
    assert recognise("Verlängerung", "mm").extends
    assert recognise("dL [mm]").extends
    assert not recognise("dx [mm]").extends


def test_a_thousandth_of_a_pascal_is_no_megapascal() -> None:
    assert recognise("p [mPa]").unit == "mPa"
    assert recognise("p [Mpa]").unit == "MPa"


#: Title -> channel, value and unit of what it holds.
TITLES = {
    "p = 2,5 bar": [("pressure", 2.5, "bar")],
    "--- Run 1: pressure 1 bar ---": [("pressure", 1.0, "bar")],
    "F @ 300 kPa [N]": [("pressure", 300.0, "kPa")],
    "280 mm": [("length", 280.0, "mm")],
    "L = 60 mm": [("length", 60.0, "mm")],
    "Kontraktion 10 %": [("contraction", 10.0, "%")],
    "Last 5 kg": [("force", 5.0, "kg")],
    "Versorgung 6 bar": [],
    "from 1 bar to 3 bar": [],
    "nominal length 300 mm": [],
    "Vorkraft 5 N": [],
    "P15RVA1": [],
}


@pytest.mark.parametrize("title", TITLES)
def test_what_a_title_holds(title: str) -> None:
    assert [(q.channel, q.value, q.unit) for q in held_quantities(title)] == TITLES[title]


def test_a_head_with_its_pressure() -> None:
    head = taken_apart("x bei 2 bar [mm]")
    assert head.unit == "mm"
    assert head.held is not None
    assert (head.held.value, head.held.text) == (2.0, "bei 2 bar")


@pytest.mark.parametrize(
    ("head", "channel", "unit"),
    [
        ("Length (mm) inflating", "length", "mm"),
        ("Kraft [kN] oben", "force", "kN"),
        ("Contraction (%) Run 2", "contraction", "%"),
        ("Force, tension positive (N) Run #1", "force", "N"),
        ("Pressure (in) muscle [bar]", "pressure", "bar"),
        ("Pressure (in) muscle", "pressure", None),  # the inlet, no inches
    ],
)
def test_a_unit_in_brackets_counts_wherever_it_stands(head: str, channel: str, unit: str | None) -> None:
    assert recognise(head)[:2] == (channel, unit)


def test_two_units_within_a_head_are_none() -> None:
    assert recognise("Ratio (mm) to (bar) raw").unit is None


@pytest.mark.parametrize(
    ("head", "name", "run"),
    [
        ("Pressure (kPa) Run #2", "Pressure (kPa)", "2"),
        ("Kraft Versuch 3 [N]", "Kraft [N]", "3"),
        ("Run #1", "Run #1", ""),
        ("Druck Sensor 1", "Druck Sensor 1", ""),
    ],
)
def test_the_number_of_the_run_is_no_part_of_the_name(head: str, name: str, run: str) -> None:
    assert without_run(head) == (name, run)


def test_a_language_has_at_least_twenty_words() -> None:
    """With fewer, files in it are hardly ever read, and its words are mistaken for those of others."""
    tables = [
        value for module in (words, cells) for value in vars(module).values() if isinstance(value, dict)
    ]
    counts: Counter[str] = Counter()
    while tables:
        table = tables.pop()
        tables += [value for value in table.values() if isinstance(value, dict)]
        by_language = {k: v for k, v in table.items() if isinstance(k, str) and isinstance(v, str)}
        if "en" in by_language and "de" in by_language:
            counts.update({language: len(text.split()) for language, text in by_language.items()})
    assert {"en", "de", "zh", "bg"} <= counts.keys()
    assert [language for language, count in counts.items() if count < 20] == []
