"""Curves of a muscle: force, stiffness, volume and diameter over its contraction."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mckibben.application.curves.curves import CurvesResult
from mckibben.door.frames import frame_of
from mckibben.door.result import ResultOf
from mckibben.report.summary import Summary
from mckibben.report.summary.curves import summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Curves(ResultOf[CurvesResult], CurvesResult):
    """Static curves, from `Model.curves`; P pressures, N lengths, SI. Arrays are read-only."""

    def to_frame(self) -> pd.DataFrame:
        """One row for each pressure and length, SI.

        Columns: pressure_Pa, contraction, length_m, force_N, stiffness_N/m, stiffness_closed_N/m, volume_m3,
        diameter_m, outer_diameter_m; where they were asked for also stiffness_from_force_N/m and
        stiffness_secant_N/m.
        """
        further = {
            "stiffness_from_force_N/m": self.stiffness_from_force,
            "stiffness_secant_N/m": self.stiffness_secant,
        }
        pressures, lengths = len(self.pressure), len(self.length)
        return frame_of(
            {
                "pressure_Pa": np.repeat(self.pressure, lengths),
                "contraction": np.tile(self.contraction, pressures),
                "length_m": np.tile(self.length, pressures),
                "force_N": self.force.ravel(),
                "stiffness_N/m": self.stiffness.ravel(),
                "stiffness_closed_N/m": self.stiffness_closed.ravel(),
                "volume_m3": np.tile(self.volume, pressures),
                "diameter_m": np.tile(self.diameter, pressures),
                "outer_diameter_m": np.tile(self.outer_diameter, pressures),
                **{name: values.ravel() for name, values in further.items() if values is not None},
            }
        )

    def plot(self) -> Figure:
        """Force over contraction, one curve for each pressure."""
        from mckibben.door.figures import curves_figure

        return curves_figure(self, f"Force of {self._name}")

    def _summary(self) -> Summary:
        return summary_of(self, self._name)

    def _title(self) -> str:
        bars = ", ".join(f"{value / 1e5:g}" for value in self.pressure)
        return f"Curves of {self._name} at {bars} bar"
