"""A parameter of an effect, and the source of a figure."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

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


class MuscleSize(NamedTuple):
    """Size of a muscle, SI; 0 = not known.

    Attributes:
        force: blocked force at `USUAL_PRESSURE` [N].
        length: at rest [m].
        diameter: of the braid at rest [m].
    """

    force: float = 0.0
    length: float = 0.0
    diameter: float = 0.0

    def over_usual(self, powers: tuple[int, int, int]) -> float:
        """Product of the three over those of `USUAL_SIZE`, each to a power; what is not known counts as 1."""
        factor = 1.0
        for own, usual, power in zip(self, USUAL_SIZE, powers, strict=True):
            factor *= (own / usual) ** power if own > 0.0 else 1.0
        return factor


UNKNOWN_SIZE = MuscleSize()
#: Gauge pressure at which the force of a muscle counts as its size [Pa].
USUAL_PRESSURE = 8e5
#: Of a muscle for which bounds hold as they are declared: one of 20 mm.
USUAL_SIZE = MuscleSize(2000.0, 0.3, 0.02)
#: Unit -> powers of force, length and diameter in which a quantity goes with the size of a muscle.
_POWERS = {
    "N": (1, 0, 0), "N/K": (1, 0, 0), "kg": (1, 0, 0), "m2": (1, 0, 0), "1/N": (-1, 0, 0),
    "N/m": (1, -1, 0), "N*s/m": (1, -1, 0), "N*s/(m*Pa)": (1, -1, 0), "m/N": (-1, 1, 0),
    "m": (0, 1, 0), "m/s": (0, 1, 0), "m3": (0, 1, 2), "m3/(s*Pa)": (0, 1, 2),
}  # fmt: skip
_LENIENT = 1.5  # share of a bound that a change of the muscle's dimensions may make
_ACROSS, _SAME, _AS_FORCE = (0, 0, 1), (0, 0, 0), (1, 0, 0)


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
        measured: range of the values that real muscles were found to have, where the bounds are wider: a fit
            may go beyond it, and its value is implausible then.
        reference: whether it states for which muscle the other parameters hold; a search for the missing
            physics never frees it.
        across: whether it is a length across the muscle, which goes with its diameter.
        with_force: whether the bounds of a number without a unit go with the blocked force.
        default_at: blocked force at `USUAL_PRESSURE` of the muscle for which the default is stated [N]; that
            of another muscle is the same share of its own (`default_of`). None = the default is the same for
            all muscles.
        of_joint: the field of the joint of a drive that states it, e.g. "friction" or "link.moment".
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
    measured: tuple[float, float] | None = None
    across: bool = False
    with_force: bool = False
    default_at: float | None = None
    of_joint: str = ""

    @property
    def powers(self) -> tuple[int, int, int]:
        """Powers of force, length and diameter of the muscle in which the bounds go with its size."""
        if self.across:
            return _ACROSS
        return _AS_FORCE if self.with_force else _POWERS.get(self.unit, _SAME)

    @property
    def grows(self) -> bool:
        """Whether the bounds of a muscle of another size are others."""
        return self.powers != _SAME

    def default_of(self, size: MuscleSize) -> float:
        """Default for a muscle of this size, to three digits.

        Where its force is not known: the default as it is declared.
        """
        if self.default_at is None or not size.force > 0.0:
            return self.default
        lower, upper = self.bounds(size)
        scaled = float(f"{self.default * size.force / self.default_at:.3g}")
        return min(max(scaled, lower), upper)

    def bounds(self, size: MuscleSize = UNKNOWN_SIZE) -> tuple[float, float]:
        """Bounds for a muscle of this size: the same shares of its force and dimensions.

        They are declared for `USUAL_SIZE`, move away from 0 with the size, and never towards it.
        """
        factor = max(1.0, size.over_usual(self.powers))
        return min(self.lower, factor * self.lower), max(self.upper, factor * self.upper)

    def allowed(self, size: MuscleSize) -> tuple[float, float]:
        """Range of values that are not refused: wider than the bounds where these go with the size.

        A fit may have changed the dimensions that its bounds were made for.
        """
        lower, upper = self.bounds(size)
        low, high = (_LENIENT * end for end in (lower, upper))
        return low if lower < self.lower else lower, high if upper > self.upper else upper

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
        low, high = self.measured or (self.lower, self.upper)
        if not self.lower <= low <= self.default <= high <= self.upper:
            raise ValueError(f"parameter '{self.name}': measured range without default or beyond the bounds")
        if self.off is not None and not self.lower <= self.off <= self.upper:
            raise ValueError(f"parameter '{self.name}': off value {self.off} is outside its bounds")
