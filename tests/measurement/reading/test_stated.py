"""What texts beside a table, names of files and properties say of the test."""

from __future__ import annotations

TEXTS = {
    "Einspannlänge L0 250,00 mm": {"nominal_length": "250.00 mm"},
    "Initial length 280.00 mm": {"nominal_length": "280.00 mm"},
    "Longueur à vide : 280 mm": {"nominal_length": "280 mm"},
    "Lunghezza a riposo 300,0 mm": {"nominal_length": "300.0 mm"},
    "Anfangslänge (mm): 250": {"nominal_length": "250 mm"},
    "DMSP-20, L0=280mm, load 10 kg": {
        "muscle": "DMSP-20", "nominal_length": "280 mm", "load_mass": "10 kg",
    },
    "Last 60 N, Versorgung 6 bar": {"load_force": "60 N", "supply_pressure": "6 bar"},
    "Prüfling DMSP-10-260N": {"sample": "DMSP-10-260N", "muscle": "DMSP-10", "nominal_length": "260 mm"},
    "Compression positive: a pulling muscle reads negative": {"force_sign": "compression positive"},
    "Druck ist Überdruck": {"pressure": "gauge"},
    "all pressures are absolute": {"pressure": "absolute"},
    "CH1 absolute pressure; barometer 94.6 kPa (lab at 570 m)": {
        "reference_of_ch1": "absolute", "ambient_pressure": "94.6 kPa",
    },
    "Drücke absolut, Luftdruck 968 mbar": {"pressure": "absolute", "ambient_pressure": "968 mbar"},
    "Pressure is gauge, supply 7 bar absolute": {"pressure": "gauge", "supply_pressure": "7 bar"},
    "ambient pressure, absolute": {},
    "Давление абсолютное, барометр 745 мм рт.ст.": {"pressure": "absolute", "ambient_pressure": "745 torr"},
    "L0 = 2.500E+02 mm": {"nominal_length": "2.500E+02 mm"},
    "Longitud inicial L0 (sin carga): 18.5 cm": {"nominal_length": "18.5 cm"},
    "Extension positive = muscle gets longer, zero at rest": {"stroke_sign": "extension positive"},
    "x: + = shortening": {"stroke_sign": "shortening positive"},
    "Weg positiv, wenn der Muskel kürzer wird": {"stroke_sign": "shortening positive"},
    "extension: positive when shortening": {"stroke_sign": "shortening positive"},
    "force is positive when the muscle is stretched": {},
    "Range: -10 to +10 V": {},
    "Datum 14.03.2024": {"date": "14.03.2024"},
    "Vorkraft 5 N": {},
    "Maximum Load 500 N": {},
    "Load cell 2 kN": {},
    "Sample rate: 10": {},
    "P15RVA1 10bar, 2,0 mV/V": {},
    "Length 250 mm": {},  # of what?
}  # fmt: skip
