"""What a gauge says when the muscle is vented: a reading below zero is the sensor's, not the muscle's.

Without a vacuum the gauge pressure of a muscle is never below zero. Where the lowest readings form a plateau
clearly below it, the muscle was vented there and the plateau is the zero error of the sensor, whatever the
force or stroke could say of it.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from mckibben.physics.effect import Effect

_LEAST = 5e3  # Pa below zero; less is noise or weather
_PLATEAU = 3e3  # Pa; readings this near the lowest belong to it
_ROWS = 4  # of the plateau, at least


class GaugeZero(NamedTuple):
    """The sensor effect that the vented rows call for, its parameter and the value they give [Pa]."""

    effect: Effect
    parameter: str
    value: float
    rows: int

    @property
    def message(self) -> str:
        """What was seen, in words."""
        return (
            f"the gauge reads {self.value / 1e5:.2f} bar in {self.rows} vented rows: a muscle without vacuum "
            "is never below zero, so this is the sensor's zero error; it is taken from there, not fitted"
        )


def vented(pressure: np.ndarray, candidates: Iterable[Effect]) -> GaugeZero | None:
    """The zero error of the pressure sensor that readings below zero prove; None when there are none.

    Args:
        pressure: gauge readings [Pa].
        candidates: effects that could be added.
    """
    lowest = float(np.min(pressure))
    plateau = pressure[pressure <= lowest + _PLATEAU]
    value = float(np.median(plateau))
    if value > -_LEAST or len(plateau) < _ROWS:
        return None
    for effect in candidates:
        if "pressure_sensor" not in effect.slots:
            continue
        for p in effect.parameters:
            moves = (
                effect.call("pressure_sensor", {}, {**effect.off, p.name: value}) if p.unit == "Pa" else None
            )
            if moves is not None and tuple(moves) == (1.0, value) and p.lower < value < p.upper:
                return GaugeZero(effect, p.name, value, len(plateau))
    return None
