"""A parameter of an effect, and the source of a figure."""

from __future__ import annotations

import math
from dataclasses import dataclass

from mckibben.facts.result import result_class

GRADES = {
    "S": "read in the cited source",
    "S2": "read second-hand",
    "C": "computed from cited data",
    "D": "derived or fitted for this project",
    "M": "general knowledge, not verified",
    "E": "engineering estimate, not verified",
    "user": "given by the user",
}
UNVERIFIED_GRADES = frozenset({"M", "E"})

#: Blocked force up to which bounds that grow hold as they are declared [N]: a muscle of 20 mm at 8 bar.
USUAL_BLOCKED_FORCE = 2000.0


@result_class
class Source:
    """Source of a figure, and its grade (a key of `GRADES`)."""

    text: str
    """Short source."""
    grade: str
    """S read in the source, S2 second-hand, C computed, D derived here, M general knowledge and E estimate
    (both unverified), user.
    """

    def __post_init__(self) -> None:
        if self.grade not in GRADES:
            raise ValueError(
                f"grade '{self.grade}' of source '{self.text}' is not one of {', '.join(GRADES)}"
            )

    @property
    def verified(self) -> bool:
        """Whether the figure was read in a source or computed from such figures."""
        return self.grade not in UNVERIFIED_GRADES


@dataclass(frozen=True, slots=True)
class Parameter:
    """One number of an effect, in SI.

    Attributes:
        name: keyword of the physics functions, snake case.
        symbol: LaTeX symbol.
        unit: SI unit as text ("Pa", "1", "N*s/m").
        default: a typical value of a real muscle, at which the effect is visible.
        lower, upper: bounds of the physically plausible range; a fit never leaves them.
        source: source of default and bounds.
        description: what it is, one sentence.
        off: the value at which the effect vanishes, or None when this parameter alone cannot switch it off.
        fitted: whether a fit changes it by default (usually not for a second constant of the same law).
        natural: whether the bounds are limits of the definition, like 0 and 1 of a share; a fit that ends at
            one is then not a sign of an implausible value.
        usual: the value that muscles mostly have; a diagnosis takes it where the data do not tell it.
            None = the default.
        reference: whether it states for which muscle the other parameters hold; a search for the missing
            physics never frees it.
        grows: whether the bounds are those of muscles of up to `USUAL_BLOCKED_FORCE`, and of a stronger one
            the same share of its blocked force (`bounds`).
        default_at: blocked force at `mckibben.physics.muscle.HIGHEST_PRESSURE` of the muscle for which the
            default is stated [N]; that of another muscle is the same share of its own (`default_of`). None =
            the default is the same for all muscles.
    """

    name: str
    symbol: str
    unit: str
    default: float
    lower: float
    upper: float
    source: Source
    description: str
    off: float | None = None
    fitted: bool = True
    natural: bool = False
    reference: bool = False
    usual: float | None = None
    grows: bool = False
    default_at: float | None = None

    def default_of(self, blocked_force: float) -> float:
        """Default for a muscle of this blocked force at the highest pressure [N], to three digits.

        0 = the force is not known: the default as it is declared.
        """
        if self.default_at is None or not blocked_force > 0.0:
            return self.default
        lower, upper = self.bounds(blocked_force)
        scaled = float(f"{self.default * blocked_force / self.default_at:.3g}")
        return min(max(scaled, lower), upper)

    def bounds(self, blocked_force: float) -> tuple[float, float]:
        """Bounds for a muscle of this blocked force at its highest pressure [N]; 0 = not known.

        Those of a parameter that `grows` move away from 0 in proportion to a blocked force above
        `USUAL_BLOCKED_FORCE`, and never towards it.
        """
        factor = max(1.0, blocked_force / USUAL_BLOCKED_FORCE) if self.grows else 1.0
        return min(self.lower, factor * self.lower), max(self.upper, factor * self.upper)

    def __post_init__(self) -> None:
        if not self.name.isidentifier():
            raise ValueError(f"parameter name '{self.name}' is not an identifier")
        numbers = (
            self.default,
            self.lower,
            self.upper,
            *(x for x in (self.off, self.usual) if x is not None),
        )
        if not all(math.isfinite(number) for number in numbers):
            raise ValueError(f"parameter '{self.name}': default, bounds and off value must be finite")
        if not self.lower < self.upper:
            raise ValueError(f"parameter '{self.name}': lower bound {self.lower} is not below {self.upper}")
        if not self.lower <= self.default <= self.upper:
            raise ValueError(
                f"parameter '{self.name}': default {self.default} is outside [{self.lower}, {self.upper}]"
            )
        if self.off is not None and not self.lower <= self.off <= self.upper:
            raise ValueError(f"parameter '{self.name}': off value {self.off} is outside its bounds")
