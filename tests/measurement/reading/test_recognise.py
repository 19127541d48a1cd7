"""Heads of tables in the words of laboratories: channel, unit, reference, or why they are none."""

from __future__ import annotations

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
