"""What a drawing shows: axes, lines, dots, bands, marked values; and the colours of all drawings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from numpy.typing import ArrayLike

INK, SOFT, GRID, EDGE = "#17212b", "#4d5b6a", "#e4e9ee", "#8b98a6"
ACCENT, SECOND = "#1257b8", "#b93815"


@dataclass(frozen=True)
class Axis:
    """What an axis shows.

    Attributes:
        zero: it begins at (or reaches) zero.
        ends: where it begins and ends; None: as the marks need.
        bare: without numbers and title, of a drawing that stands on another.
    """

    title: str
    unit: str = ""
    zero: bool = False
    ends: tuple[float, float] | None = None
    bare: bool = False

    @property
    def text(self) -> str:
        """Title with unit."""
        return f"{self.title} [{self.unit}]" if self.unit else self.title


@dataclass(frozen=True)
class Line:
    """A curve; gaps where a value is not finite. ``label`` "" leaves it out of the legend."""

    x: ArrayLike
    y: ArrayLike
    label: str = ""
    colour: str = ACCENT
    dash: str | None = None
    width: float = 1.5


@dataclass(frozen=True)
class Dots:
    """Measured points; a large ``size`` marks a single one, as an operating point; ``names`` stand beside,
    above or ``below``.
    """

    x: ArrayLike
    y: ArrayLike
    label: str = ""
    colour: str = ACCENT
    size: float = 3.0
    names: Sequence[str] = ()
    below: bool = False


@dataclass(frozen=True)
class Band:
    """A range of y that is shaded over the whole width."""

    low: float
    high: float
    label: str = ""


@dataclass(frozen=True)
class Rule:
    """A value of x, marked over the whole height."""

    x: float
    label: str = ""
    colour: str = SOFT
    dash: str | None = "4 3"


Mark = Line | Dots | Band | Rule
