"""The words of laboratories by what they mean and by language: one table for heads, preambles and remarks.

Written as people write them, compared without case and accents. A word of five letters or more also counts
as the beginning or end of a longer one; ``*`` says the same of a shorter one (``*weg``, ``усил*``). Chinese,
Japanese and Korean words of two characters or more count wherever they stand.
"""

from __future__ import annotations

from mckibben.measurement.read.words.cells import MARKERS, UNITS
from mckibben.measurement.read.words.channels import CHANNELS
from mckibben.measurement.read.words.columns import COUNTERS, NO_CHANNELS, OTHERS, STATISTIC, VALUES
from mckibben.measurement.read.words.conditions import REFERENCES, REMARKS
from mckibben.measurement.read.words.signs import SIGNS
from mckibben.measurement.read.words.valves import COMMANDED, MEASURED, VALVES
from mckibben.measurement.read.words.ways import DIRECTIONS, HOLDS, MOVES, PHASES, WAYS

__all__ = [
    "CHANNELS",
    "COMMANDED",
    "COUNTERS",
    "DIRECTIONS",
    "HOLDS",
    "MARKERS",
    "MEASURED",
    "MOVES",
    "NO_CHANNELS",
    "OTHERS",
    "PHASES",
    "REFERENCES",
    "REMARKS",
    "SIGNS",
    "STATISTIC",
    "UNITS",
    "VALUES",
    "VALVES",
    "WAYS",
]
