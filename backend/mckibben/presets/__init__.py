"""Presets: real muscles, valves, tubes, fittings, curves, measurements and designs, one JSON file each.

Every physical value carries its unit, source and grade. A file that cannot be used becomes a `Problem` and
the others still load.
"""

from mckibben.presets.library import PresetLibrary, Problem
from mckibben.presets.quantity import Quantity
from mckibben.presets.schema import (
    DesignPreset,
    FittingPreset,
    MusclePreset,
    Preset,
    TubePreset,
    ValvePreset,
)
from mckibben.presets.table import CurvePreset, MeasurementPreset

__all__ = [
    "CurvePreset",
    "DesignPreset",
    "FittingPreset",
    "MeasurementPreset",
    "MusclePreset",
    "Preset",
    "PresetLibrary",
    "Problem",
    "Quantity",
    "TubePreset",
    "ValvePreset",
]
