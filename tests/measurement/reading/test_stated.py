"""What texts beside a table, names of files and properties say of the test."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading.evidence import evidence_of
from mckibben.measurement.reading.model import FILE, Span, Table
from mckibben.measurement.reading.units import Quantity, quantity_si

SI = {
    "pressure": "Pa", "force": "N", "length": "m", "mass": "kg", "diameter": "m", "temperature": "K",
}  # fmt: skip

#: Text -> what it states of the file, in SI.
TEXTS = {
    "Einspannlänge L0 250,00 mm": {"nominal_length": 0.25},
    "Initial length 280.00 mm": {"nominal_length": 0.28},
    "Longueur à vide : 280 mm": {"nominal_length": 0.28},
    "Lunghezza a riposo 300,0 mm": {"nominal_length": 0.3},
    "Anfangslänge (mm): 250": {"nominal_length": 0.25},
    "DMSP-20, L0=280mm, load 10 kg": {"muscle": "DMSP-20", "nominal_length": 0.28, "load_mass": 10.0},
    "Last 60 N, Versorgung 6 bar": {"load_force": 60.0, "supply_pressure": 6e5},
    "Prüfling DMSP-10-260N": {"muscle": "DMSP-10", "nominal_length": 0.26},
    "Compression positive: a pulling muscle reads negative": {"sign_force": -1},
    "Druck ist Überdruck": {"absolute": False},
    "all pressures are absolute": {"absolute": True},
    "CH1 absolute pressure; barometer 94.6 kPa (lab at 570 m)": {
        "absolute": True, "ambient_pressure": 94.6e3,
    },
    "Drücke absolut, Luftdruck 968 mbar": {"absolute": True, "ambient_pressure": 96.8e3},
    "Pressure is gauge, supply 7 bar absolute": {"absolute": False, "supply_pressure": 7e5},
    "ambient pressure, absolute": {},
    "Давление абсолютное, барометр 745 мм рт.ст.": {"absolute": True, "ambient_pressure": 99_325.2},
    "L0 = 2.500E+02 mm": {"nominal_length": 0.25},
    "Longitud inicial L0 (sin carga): 18.5 cm": {"nominal_length": 0.185},
    "Extension positive = muscle gets longer, zero at rest": {"sign_stroke": -1},
    "x: + = shortening": {"sign_stroke": 1},
    "Weg positiv, wenn der Muskel kürzer wird": {"sign_stroke": 1},
    "extension: positive when shortening": {"sign_stroke": 1},
    "force is positive when the muscle is stretched": {},
    "Vorzeichen: Zug negativ, Verlängerung positiv": {"sign_force": -1, "sign_stroke": -1},
    "tension positive, shortening positive": {"sign_force": 1, "sign_stroke": 1},
    "compression counts positive": {"sign_force": -1},
    "tension (pull) is negative": {"sign_force": -1},
    "effort de traction négatif": {"sign_force": -1},
    "縮みは正, 引張は負": {"sign_force": -1},
    "its reading falls as the muscle shortens": {"sign_stroke": -1},
    "the pressure falls as the muscle shortens": {},
    "positive displacement sensor for extension tests": {},
    "Muscle: DMSP-20, resting length 11 in (vented)": {"muscle": "DMSP-20", "nominal_length": 0.2794},
    "the muscle is 250 mm long when unpressurised": {"nominal_length": 0.25},
    "Länge bei 0 bar: 30 cm": {"nominal_length": 0.3},
    "longueur sans pression 0,3 m": {"nominal_length": 0.3},
    "L_0 = 0.25 m, Masse angehängt 5 kg": {"nominal_length": 0.25, "load_mass": 5.0},
    "L0_mm: 250": {"nominal_length": 0.25},
    "stroke 30 mm rest length 250 mm": {"nominal_length": 0.25},
    "12 kg hung from the lower end": {"load_mass": 12.0},
    "shop air at 90 psi": {"supply_pressure": 620_528.156},
    "strain gauge amplifier, pressure sensor new": {},
    "Range: -10 to +10 V": {},
    "Vorkraft 5 N": {},
    "Maximum Load 500 N": {},
    "Load cell 2 kN": {},
    "Sample rate: 10": {},
    "P15RVA1 10bar, 2,0 mV/V": {},
    "Length 250 mm": {},  # of what? It counts only where nothing else says the length
}  # fmt: skip


@pytest.mark.parametrize(
    ("text", "held"),
    [
        ("pressure 2 bar", ["2 bar"]),
        ("pressure swept from 0 bar to 6 bar", []),
        ("pressure 1 to 3 bar", []),
        ("Druck 0-6 bar", []),
        ("run 3 - 2 bar", []),  # of what?
    ],
)
def test_a_pressure_that_was_held_is_no_end_of_a_range(text: str, held: list[str]) -> None:
    beside = Table((), (Span("line 4", text),), np.zeros(0, np.intp))
    found = [e for e in evidence_of(beside, "a.csv") if e.facet == "held:pressure"]
    assert [e.value.text for e in found] == held


@pytest.mark.parametrize("text", TEXTS)
def test_what_a_text_states(text: str) -> None:
    beside = Table((), (Span("line 4", text),), np.zeros(0, np.intp))
    found = {}
    for e in evidence_of(beside, "a.csv"):
        facet = e.facet.removeprefix("condition:")
        if e.target == FILE and facet != "zero_known" and not facet.startswith("held:"):
            si = isinstance(e.value, Quantity)
            found[facet] = (
                quantity_si(e.value.value, e.value.unit.name, SI[e.value.unit.dimension]) if si else e.value
            )
            assert e.span.where == "line 4"
    assert found == pytest.approx(TEXTS[text])
