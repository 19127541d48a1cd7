"""From a task to drives: ranked proposals from the catalogue, and the reason for each rejection."""

from mckibben.sizing.catalogue import Design, MusclePart, PartsCatalogue, TubePart, ValvePart
from mckibben.sizing.proposal import Proposal
from mckibben.sizing.rejection import Rejection
from mckibben.sizing.search import Sizing, size
from mckibben.sizing.task import DesignLimits, Pair, Task, Uncertainty

__all__ = [
    "Design",
    "DesignLimits",
    "MusclePart",
    "Pair",
    "PartsCatalogue",
    "Proposal",
    "Rejection",
    "Sizing",
    "Task",
    "TubePart",
    "Uncertainty",
    "ValvePart",
    "size",
]
