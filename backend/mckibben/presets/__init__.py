"""Presets: muscles, valves, tubes, fittings, curves, measurements, designs, drives, tasks, mysteries.

Each is one JSON file. Every physical value carries its unit, source and grade. A file that cannot be used
becomes a `LibraryProblem` and the others still load.
"""

from mckibben.presets.library import LibraryProblem, PresetLibrary
from mckibben.presets.mystery import MysteryPreset
from mckibben.presets.quantity import Quantity
from mckibben.presets.schema import (
    DesignPreset,
    DrivePreset,
    FittingPreset,
    MusclePreset,
    Preset,
    TaskPreset,
    TubePreset,
    ValvePreset,
)
from mckibben.presets.table import CurvePreset, MeasurementPreset

__all__ = [
    "CurvePreset",
    "DesignPreset",
    "DrivePreset",
    "FittingPreset",
    "LibraryProblem",
    "MeasurementPreset",
    "MusclePreset",
    "MysteryPreset",
    "Preset",
    "PresetLibrary",
    "Quantity",
    "TaskPreset",
    "TubePreset",
    "ValvePreset",
]
