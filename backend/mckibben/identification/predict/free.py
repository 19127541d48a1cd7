"""A free parameter of a fit."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Free:
    """A free parameter: name, start, bounds, SI unit, the value at which it has no effect, a usual change.

    ``natural``: its bounds are those of its definition, such as 0 and 1 of a share. ``holds``: constants of
    effects that act exactly as it does, and so keep their values beside it.
    """

    name: str
    start: float
    lower: float
    upper: float
    unit: str
    off: float | None = None
    usual: float | None = None
    natural: bool = False
    holds: frozenset[str] = frozenset()

    @property
    def typical(self) -> float:
        """A change that matters: the usual one, or a hundredth of the range between the bounds."""
        return self.usual or 0.01 * (self.upper - self.lower)
