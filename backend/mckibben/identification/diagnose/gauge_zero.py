"""Zero error of the pressure sensor, from readings below zero while the muscle is vented.

Without a vacuum the gauge pressure of a muscle is never below zero. Where the lowest readings form a plateau
clearly below zero, the muscle was vented and the plateau is the zero error of the sensor. It need not be
fitted to force or stroke.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from mckibben.identification.thresholds import GAUGE
from mckibben.physics.effect import Effect


class GaugeZero(NamedTuple):
    """The sensor effect that explains the vented rows, its parameter and value [Pa]."""

    effect: Effect
    parameter: str
    value: float
    rows: int

    @property
    def message(self) -> str:
        """Note for the user."""
        return (
            f"the gauge reads {self.value / 1e5:.2f} bar in {self.rows} vented rows: a muscle without vacuum "
            "is never below zero, so this is the sensor's zero error; it is read from these rows, not fitted"
        )


def vented(pressure: np.ndarray, candidates: Iterable[Effect]) -> GaugeZero | None:
    """The zero error of the pressure sensor; None without a plateau below zero.

    Args:
        pressure: gauge readings [Pa].
        candidates: effects that could be added.
    """
    lowest = float(np.min(pressure))
    plateau = pressure[pressure <= lowest + GAUGE.plateau]
    value = float(np.median(plateau))
    if value > -GAUGE.least or len(plateau) < GAUGE.rows:
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
