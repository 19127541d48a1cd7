"""Heads of tables in the words of laboratories: channel, unit, reference, or why they are none."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from mckibben.measurement.reading.decide import roles_of
from mckibben.measurement.reading.evidence import evidence_of, of_column
from mckibben.measurement.reading.heads import head_claims, taken_apart, without_run
from mckibben.measurement.reading.model import Column, Span, Table
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import read

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


#: Head -> the role that makes it none.
NONE_OF_OURS = {
    "Solldruck [bar]": "set value",
    "Versorgungsdruck [bar]": "supply",
    "Umgebungsdruck [mbar]": "air",
    "nominal length [mm]": "at rest",
    "Vorkraft [N]": "preload",
    "Load cell [mV]": "raw",
    "cDAQ1Mod1/ai0 pressure [V]": "raw",
    "adc [counts]": "raw",
    "Innendurchmesser [mm]": "tube size",
    "Bemerkung": "remark",
    "Lfd. Nr.": "running number",
}


#: Title -> dimension, value and unit of what it holds.
TITLES = {
    "p = 2,5 bar": [("pressure", 2.5, "bar")],
    "--- Run 1: pressure 1 bar ---": [("pressure", 1.0, "bar")],
    "F @ 300 kPa [N]": [("pressure", 300.0, "kPa")],
    "280 mm": [("length", 280.0, "mm")],
    "L = 60 mm": [("length", 60.0, "mm")],
    "Kontraktion 10 %": [("ratio", 10.0, "%")],
    "Last 5 kg": [("mass", 5.0, "kg")],
    "Versorgung 6 bar": [],
    "nominal length 300 mm": [],
    "Vorkraft 5 N": [],
    "P15RVA1": [],
}


def claims(head: str, unit: str = "") -> tuple[str | None, str | None, bool | None, dict[str, float]]:
    """(channel, unit, absolute, roles) of a head, by the claims with most weight."""
    column = Column(head, np.array([1.0, 3.0, 2.0]), "column 1", unit)
    channels: Counter[str] = Counter()
    found = of_column(0, column)
    for e in found:
        if e.facet == "channel":
            channels[e.value] += e.weight
    first = {e.facet: e.value for e in reversed(found)}
    channel = channels.most_common(1)[0][0] if channels else None
    return channel, first.get("unit"), first.get("absolute"), roles_of(found)


@pytest.mark.parametrize("head", HEADS)
def test_what_a_head_means(head: str) -> None:
    assert claims(head)[:3] == HEADS[head]


@pytest.mark.parametrize("head", NONE_OF_OURS)
def test_why_a_head_is_no_channel(head: str) -> None:
    assert claims(head)[3].get(NONE_OF_OURS[head], 0.0) >= 3.0


@pytest.mark.parametrize("head", ["Standardkraft [N]", "Sensor A", "Kraft [N]"])
def test_no_word_within_another_one_is_a_role(head: str) -> None:
    """Polish "stan" (state) joins no words: a "Standardkraft" is no remark."""
    assert claims(head)[3] == {}


def test_units_that_stand_apart() -> None:
    assert claims("Kraft", "kN")[:2] == ("force", "kN")
    assert claims("Kraft", "2,0 mV/V")[:2] == ("force", None)
    assert claims("Druck", "V")[3]["raw"] >= 3.0


@pytest.mark.parametrize(("head", "sign"), [("Verlängerung [mm]", -1), ("dL [mm]", -1), ("dx [mm]", None)])
def test_what_counts_the_extension(head: str, sign: int | None) -> None:
    signs = [c.value for c in head_claims(head) if c.facet == "sign_stroke"]
    assert signs == ([] if sign is None else [sign])


def test_a_thousandth_of_a_pascal_is_no_megapascal() -> None:
    assert claims("p [mPa]")[1] == "mPa"
    assert claims("p [Mpa]")[1] == "MPa"


@pytest.mark.parametrize("title", TITLES)
def test_what_a_title_holds(title: str) -> None:
    spans = ((Span("line 1", title),), (Span("line 9", "another"),))
    found = evidence_of(Table((), (), np.zeros(0, np.intp), titles=spans), "a.csv")
    held = [e.value for e in found if e.facet.startswith(("held:", "condition:load"))]
    assert [(q.unit.dimension, q.value, q.unit.name) for q in held] == TITLES[title]


def test_a_title_with_two_pressures_holds_none() -> None:
    rows = "\n".join(f"{stroke} {300 - 4 * stroke}" for stroke in range(12))
    blocks = "\n\n".join(
        f"{title}\nstroke[mm] force[N]\n{rows}" for title in ("from 1 bar to 3 bar", "2 bar")
    )
    with pytest.raises(InputError):
        read(f"rest length 300 mm\n\n{blocks}\n")


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
    assert claims(head)[:2] == (channel, unit)


def test_two_units_within_a_head_are_none() -> None:
    assert taken_apart("Ratio (mm) to (bar) raw").unit is None


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
