"""Elements of a drawing (axes, lines, dots, bands, rules) and the colours of all drawings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from numpy.typing import ArrayLike

INK, SOFT, GRID, EDGE = "#17212b", "#4d5b6a", "#e4e9ee", "#8b98a6"
ACCENT, SECOND = "#1257b8", "#b93815"


@dataclass(frozen=True)
class Axis:
    """An axis.

    Attributes:
        title: quantity.
        unit: "" for none.
        zero: include zero in the range.
        ends: range; None to fit the marks.
        bare: without numbers and title, for all but the lowest drawing of a stack.
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
    """A curve with gaps at values that are not finite. An empty ``label`` keeps it out of the legend."""

    x: ArrayLike
    y: ArrayLike
    label: str = ""
    colour: str = ACCENT
    dash: str | None = None
    width: float = 1.5


@dataclass(frozen=True)
class Dots:
    """Points, with optional ``names`` beside them, placed above or ``below``."""

    x: ArrayLike
    y: ArrayLike
    label: str = ""
    colour: str = ACCENT
    size: float = 3.0
    names: Sequence[str] = ()
    below: bool = False


@dataclass(frozen=True)
class Band:
    """A range of y, shaded over the whole width."""

    low: float
    high: float
    label: str = ""


@dataclass(frozen=True)
class Rule:
    """A vertical line at a value of x."""

    x: float
    label: str = ""
    colour: str = SOFT
    dash: str | None = "4 3"


Mark = Line | Dots | Band | Rule
