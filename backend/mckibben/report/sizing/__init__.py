"""The report of a sizing: task, drive, curves, run, margins, uncertainty, alternatives, parts, equations."""

from mckibben.report.command import Command
from mckibben.report.sizing.material import (
    Chosen,
    Curves,
    Entry,
    KnownFigure,
    Margin,
    Material,
    Part,
    Spread,
)
from mckibben.report.sizing.writing import sizing_report
from mckibben.report.sources import Figure

__all__ = [
    "Chosen",
    "Command",
    "Curves",
    "Entry",
    "Figure",
    "KnownFigure",
    "Margin",
    "Material",
    "Part",
    "Spread",
    "sizing_report",
]
