"""Drives for the tests of the linear view: where the equations are smooth, and where something switches."""

from __future__ import annotations

from typing import Any

from mckibben.documents.drive_reading import drive_of, preset_document, read_document
from mckibben.simulation.drive.parts import Drive
from tests.shipped import shipped_studio

STUDIO = shipped_studio()
_LIFT: dict[str, Any] = {
    "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
    "effects": {"bladder_elasticity": {}, "viscous_damping": {"coefficient": "120 N*s/m"}},
    "supply": {"pressure": "6 bar"},
    "valve": {"preset": "MPYE-5-1/8-HF"},
    "load": {"mass": "10 kg"},
    "command": {"shape": "step", "level": 0.0, "initial": 0.0},
    "duration": "1 s",
}
_REGULATED = {**_LIFT, "valve": {"preset": "VPPM-6"}}
DOCUMENTS: dict[str, dict[str, Any]] = {
    "regulator": _REGULATED,
    "regulator, tube, lever": {
        **_REGULATED,
        "tube": {"inside_diameter": "4 mm", "length": "1 m"},
        "load": {"mass": "4 kg", "arrangement": "lever", "lever_ratio": 0.5},
    },
    "regulator, spring, lags": {
        **_REGULATED,
        "effects": {
            **_LIFT["effects"], "spool_lag": {}, "creep": {}, "sensor_lag": {"stroke_time": "10 ms"},
        },
        "load": {"mass": "3 kg", "arrangement": "horizontal", "spring": "2000 N/m", "force": "20 N"},
        "gas": {"polytropic_exponent": 1.2},
    },
    "valve feeding a leak": {
        **_LIFT, "effects": {**_LIFT["effects"], "leak": {"conductance": "0.05 l/(s*bar)"}},
    },
    "valve": _LIFT,
    "valve and tube": {**_LIFT, "tube": {"inside_diameter": "4 mm", "length": "1 m"}},
    "valve with dead band": {
        **_LIFT, "effects": {**_LIFT["effects"], "valve_deadband": {"half_width": "4 %"}},
    },
    "friction": {**_REGULATED, "effects": {**_LIFT["effects"], "coulomb_friction": {"force": "10 N"}}},
    **{
        effect: {**_REGULATED, "effects": {**_LIFT["effects"], effect: {}}}
        for effect in ("dahl", "bouc_wen", "maxwell_slip")
    },
    "regulator with hysteresis": {
        **_REGULATED, "effects": {**_LIFT["effects"], "valve_hysteresis": {"width": "1 %"}},
    },
    "pair": {
        **_REGULATED,
        "load": {"mass": "2 kg", "arrangement": "antagonist", "pulley_radius": "20 mm"},
    },
}  # fmt: skip
SMOOTH = ("regulator", "regulator, tube, lever", "regulator, spring, lags", "valve feeding a leak")


def drive(name: str) -> Drive:
    """One of the drives above, or a preset."""
    document = read_document(DOCUMENTS[name], name) if name in DOCUMENTS else preset_document(name, STUDIO)
    return drive_of(document, STUDIO).drive
