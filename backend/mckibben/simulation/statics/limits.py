"""Limits of a muscle, and the flags of the limits that a result crosses."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

_PERMITTED = ", the limit of the maker of the muscle"  # whose limit it is


class FlagCode(StrEnum):
    """Code of a crossed limit; results are flagged, never clipped."""

    OUT_OF_REACH = "out_of_reach"
    OVER_FORCE_LIMIT = "over_force_limit"
    OVER_CONTRACTION_LIMIT = "over_contraction_limit"
    OVER_PRETENSION_LIMIT = "over_pretension_limit"
    OVER_PRESSURE = "over_pressure"


@dataclass(frozen=True, slots=True)
class LimitFlag:
    """A crossed limit in words, and the input it belongs to."""

    code: FlagCode
    message: str
    field: str | None = None


@dataclass(frozen=True, slots=True)
class MuscleLimits:
    """Limits stated by the maker; None where not known.

    Attributes:
        max_pressure: operating pressure, gauge [Pa].
        max_force: lifting force [N].
        max_contraction: contraction ratio [-].
        max_pretension: stretch beyond the nominal length as a positive ratio [-].
    """

    max_pressure: float | None = None
    max_force: float | None = None
    max_contraction: float | None = None
    max_pretension: float | None = None

    def flags(
        self,
        *,
        pressure: float | None = None,
        force: float | None = None,
        contraction: float | None = None,
    ) -> list[LimitFlag]:
        """The limits that a state crosses."""
        found: list[LimitFlag] = []
        if pressure is not None and self.max_pressure is not None and _above(pressure, self.max_pressure):
            found.append(
                LimitFlag(
                    FlagCode.OVER_PRESSURE,
                    f"{pressure / 1e5:.3g} bar is above {self.max_pressure / 1e5:.3g} bar{_PERMITTED}",
                    "pressures",
                )
            )
        if force is not None and self.max_force is not None and _above(force, self.max_force):
            found.append(
                LimitFlag(
                    FlagCode.OVER_FORCE_LIMIT,
                    f"{force:.4g} N is above {self.max_force:.4g} N{_PERMITTED}",
                    "load",
                )
            )
        if contraction is None:
            return found
        if self.max_contraction is not None and _above(contraction, self.max_contraction):
            found.append(
                LimitFlag(
                    FlagCode.OVER_CONTRACTION_LIMIT,
                    f"a contraction of {contraction * 100:.3g} % is above "
                    f"{self.max_contraction * 100:.3g} %{_PERMITTED}",
                )
            )
        if self.max_pretension is not None and _above(-contraction, self.max_pretension):
            found.append(
                LimitFlag(
                    FlagCode.OVER_PRETENSION_LIMIT,
                    f"a stretch of {-contraction * 100:.3g} % is above "
                    f"{self.max_pretension * 100:.3g} %{_PERMITTED}",
                )
            )
        return found


def _above(value: float, limit: float) -> bool:
    return value > limit * (1.0 + 1e-9)
