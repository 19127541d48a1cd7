"""Curves of a muscle: force, stiffness, volume and diameter over its contraction."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mckibben.application.curves.curves import CurveLimits, CurvesResult, OverPressure
from mckibben.door.frames import frame_of
from mckibben.door.result import Result
from mckibben.door.values import FloatArray, read_only
from mckibben.report.summary import Summary
from mckibben.report.summary.curves import summary_of
from mckibben.simulation.statics.characteristics import Characteristics, OperatingPoint

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Curves(Result):
    """Static curves, from `Model.curves`; P pressures, N lengths, SI. Arrays are read-only."""

    __slots__ = ("_name", "_result")

    _result: CurvesResult
    _name: str

    def __init__(self, result: CurvesResult, name: str) -> None:
        self._set(_result=result, _name=name)

    @property
    def pressure(self) -> FloatArray:
        """Gauge pressure of each curve [Pa], shape (P,)."""
        return read_only(self._result.pressure)

    @property
    def length(self) -> FloatArray:
        """Length of the muscle [m], shape (N,)."""
        return read_only(self._result.length)

    @property
    def contraction(self) -> FloatArray:
        """Contraction 1 - L/L0 [-], shape (N,)."""
        return read_only(self._result.contraction)

    @property
    def force(self) -> FloatArray:
        """Tension [N], shape (P, N); 0 where the muscle is slack."""
        return read_only(self._result.force)

    @property
    def interval(self) -> tuple[FloatArray, FloatArray] | None:
        """Ends between which 90 % of new readings of the force lie [N], each of shape (P, N).

        From the covariance of the fitted values and the error that the fit left; None for a model that was
        not fitted, or was changed since.
        """
        found = self._result.interval
        return None if found is None else (read_only(found.low), read_only(found.high))

    @property
    def stiffness(self) -> FloatArray:
        """dF/dL at constant pressure [N/m], shape (P, N)."""
        return read_only(self._result.stiffness)

    @property
    def stiffness_closed(self) -> FloatArray:
        """dF/dL with a closed valve, at constant mass of air [N/m], shape (P, N)."""
        return read_only(self._result.stiffness_closed)

    @property
    def stiffness_from_force(self) -> FloatArray | None:
        """Stiffness of the ideal muscle with this force, 6 L F/(3 L² - b²) [N/m], shape (P, N).

        Equation (20) of the source paper. NaN at the length at which the ideal muscle has no force and this
        one has; None unless `Model.curves` was asked for it.
        """
        found = self._result.stiffness_from_force
        return None if found is None else read_only(found)

    @property
    def stiffness_secant(self) -> FloatArray | None:
        """Stiffness of the straight line from the length without force, F/(L - L_min) [N/m], shape (P, N).

        Equation (25) of the source paper; None unless `Model.curves` was asked for it.
        """
        found = self._result.stiffness_secant
        return None if found is None else read_only(found)

    @property
    def volume(self) -> FloatArray:
        """Volume of the muscle [m³], shape (N,)."""
        return read_only(self._result.volume)

    @property
    def diameter(self) -> FloatArray:
        """Diameter of the braid [m], shape (N,)."""
        return read_only(self._result.diameter)

    @property
    def characteristics(self) -> Sequence[Characteristics]:
        """Blocked force, free contraction and work of a stroke for each pressure."""
        return tuple(self._result.characteristics)

    @property
    def operating_points(self) -> Sequence[OperatingPoint]:
        """Where the load is held at each pressure; empty without a load."""
        return tuple(self._result.operating_points)

    @property
    def over_pressure(self) -> OverPressure | None:
        """Position at the load and force at the fixed length over the pressure; None without both."""
        return self._result.over_pressure

    @property
    def limits(self) -> CurveLimits:
        """Limits stated by the maker, and those of the braid."""
        return self._result.limits

    @property
    def flags(self) -> Sequence[str]:
        """What to know: limits that are crossed, values that are assumed or not verified."""
        return tuple(notice.message for notice in self._result.flags)

    def to_frame(self) -> pd.DataFrame:
        """One row for each pressure and length, SI.

        Columns: pressure_Pa, contraction, length_m, force_N, stiffness_N/m, stiffness_closed_N/m, volume_m3,
        diameter_m; where they were asked for also stiffness_from_force_N/m and stiffness_secant_N/m.
        """
        result = self._result
        further = {
            "stiffness_from_force_N/m": result.stiffness_from_force,
            "stiffness_secant_N/m": result.stiffness_secant,
        }
        pressures, lengths = len(result.pressure), len(result.length)
        return frame_of(
            {
                "pressure_Pa": np.repeat(result.pressure, lengths),
                "contraction": np.tile(result.contraction, pressures),
                "length_m": np.tile(result.length, pressures),
                "force_N": result.force.ravel(),
                "stiffness_N/m": result.stiffness.ravel(),
                "stiffness_closed_N/m": result.stiffness_closed.ravel(),
                "volume_m3": np.tile(result.volume, pressures),
                "diameter_m": np.tile(result.diameter, pressures),
                **{name: values.ravel() for name, values in further.items() if values is not None},
            }
        )

    def plot(self) -> Figure:
        """Force over contraction, one curve for each pressure."""
        from mckibben.door.figures.statics import curves_figure

        return curves_figure(self._result, f"Force of {self._name}")

    def _answer(self) -> object:
        return self._result

    def _summary(self) -> Summary:
        return summary_of(self._result, self._name)

    def _title(self) -> str:
        bars = ", ".join(f"{value / 1e5:g}" for value in self._result.pressure)
        return f"Curves of {self._name} at {bars} bar"
