"""The experiment that a measurement belongs to: what it was made with, each value with its origin.

Fields of an experiment, as the command line, requests and answers name them:

| field | value | needed for |
|---|---|---|
| `muscle` | id of a preset | everything |
| `rest_length` | length of the muscle without air and load [m] | everything |
| `load` | a mass [kg] or a force [N] | isotonic without force column, transient |
| `supply` | supply pressure, gauge [Pa] | transient with a command column |
| `valve`, `tube` | ids of presets; a tube also "4 mm x 1 m" or "none" | transient with a command column |
| `stops` | contractions between which the load can move, "0 % to 25 %" | transient |
| `inclination` | of the motion of the load from the horizontal [rad] | transient |
| `fixed_end` | which end of the muscle is fixed | |
| `force_zero`, `pressure_zero` | reading of the sensor at true zero [N, Pa]; subtracted | |
| `accuracy_*` | standard deviation of a channel, in its unit or as a share of its largest value | |
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

#: Who says a value: the file, the user, a preset that was chosen, a proposal that the user took over, or nobody.
Origin = Literal["file", "you", "preset", "suggested", "assumed"]
ORIGINS: tuple[Origin, ...] = ("file", "you", "preset", "suggested", "assumed")


@dataclass(frozen=True, slots=True)
class ExperimentValue:
    """One value of an experiment.

    Attributes:
        value: SI number or text.
        unit: SI unit, "" of a text.
        origin: who says it.
        where: line or cell of the file, option or field of the request, preset; empty where there is no place.
    """

    value: float | str
    unit: str
    origin: Origin
    where: str = ""


#: Field -> value; fields that nobody stated and that have no sensible value are missing.
Experiment = Mapping[str, ExperimentValue]

NOTHING_STATED: Experiment = MappingProxyType({})
