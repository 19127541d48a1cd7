"""The reason for or against a candidate: its declared signature compared with the residual."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mckibben.physics.effect import Effect

_CLEAR = 0.15  # share of the mean square from which the residual counts as odd in the direction


@dataclass(frozen=True)
class ResidualTraits:
    """Features of a residual.

    Attributes:
        odd: share of its mean square that changes sign with the direction of motion; None when unknown.
        pressure_power: exponent n of a fit of its size to P^n; None without a range of pressures.
    """

    odd: float | None
    pressure_power: float | None


def traits_of(residual: np.ndarray, variables: Mapping[str, np.ndarray]) -> ResidualTraits:
    """Parity of a residual and its growth with pressure."""
    whole = float(np.mean(residual**2))
    if not whole > 0.0:
        return ResidualTraits(None, None)
    odd = None
    direction = variables.get("direction")
    if direction is not None and np.any(direction > 0) and np.any(direction < 0):
        forward, backward = residual[direction > 0], residual[direction < 0]
        odd = float((0.5 * (np.mean(forward) - np.mean(backward))) ** 2 / whole)
    power = None
    pressure = variables.get("pressure")
    if pressure is not None and np.max(pressure) > 2.0 * max(float(np.min(pressure)), 1e3):
        edges = np.unique(np.quantile(pressure, np.linspace(0.0, 1.0, 7)))
        bins = np.clip(np.searchsorted(edges, pressure, side="right") - 1, 0, len(edges) - 2)
        centres, sizes = [], []
        for number in range(len(edges) - 1):
            rows = bins == number
            if np.count_nonzero(rows) >= 3 and np.mean(pressure[rows]) > 0.0:
                centres.append(np.log(np.mean(pressure[rows])))
                sizes.append(0.5 * np.log(np.mean(residual[rows] ** 2) + 1e-30))
        if len(centres) >= 3:
            power = float(np.polyfit(centres, sizes, 1)[0])
    return ResidualTraits(odd, power)


def why(effect: Effect, traits: ResidualTraits, *, gain: float) -> str:
    """The reason for or against a candidate, in words.

    Args:
        effect: the candidate.
        traits: features of the residual before the candidate is added.
        gain: relative reduction of the rms error.
    """
    signature = effect.signature
    agreeing, against = [], []
    if traits.odd is not None and signature.direction is not None:
        is_odd = traits.odd > _CLEAR
        words = (
            "changes sign with the direction of motion"
            if is_odd
            else "keeps its sign when the motion reverses"
        )
        (agreeing if is_odd == (signature.direction == "odd") else against).append(words)
    if traits.pressure_power is not None and signature.pressure_power is not None:
        nearest = 0.0 if traits.pressure_power < 0.4 else 1.0 if traits.pressure_power < 1.5 else 2.0
        words = {
            0.0: "hardly depends on pressure",
            1.0: "grows about in proportion to pressure",
            2.0: "grows faster than pressure",
        }[nearest]
        (agreeing if nearest == signature.pressure_power else against).append(words)
    text = f"{effect.title} is {signature.text}"
    if agreeing:
        text += f"; the residual {' and '.join(agreeing)}, as it would"
    if against:
        text += f"; {'but' if agreeing else 'the residual'} {' and '.join(against)}, which speaks against it"
    if gain > 0.005:
        return f"{text}. It lowers the error by {100.0 * gain:.0f} %."
    return f"{text}. It does not lower the error."
