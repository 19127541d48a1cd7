"""The sizing report: task, drive, curves, run, margins, uncertainty, alternatives, parts, equations."""

from mckibben.report.command import Command
from mckibben.report.sizing.material import (
    Chosen,
    Entry,
    ForceCurves,
    KnownFigure,
    Margin,
    Part,
    SizingMaterial,
    SpecimenSpread,
)
from mckibben.report.sizing.writing import sizing_report
from mckibben.report.sources import Figure

__all__ = [
    "Chosen",
    "Command",
    "Entry",
    "Figure",
    "ForceCurves",
    "KnownFigure",
    "Margin",
    "Part",
    "SizingMaterial",
    "SpecimenSpread",
    "sizing_report",
]
