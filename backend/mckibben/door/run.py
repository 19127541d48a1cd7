"""A simulated run of a drive."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mckibben.application.run.simulate import SimulationResult, trace_columns, trace_text
from mckibben.documents.drive import DriveDocument
from mckibben.door.frames import frame_of
from mckibben.door.result import ResultOf
from mckibben.report.summary import Summary
from mckibben.report.summary.simulation import notices, summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Run(ResultOf[SimulationResult], SimulationResult):
    """A run, from `Drive.run`; N rows, SI. Positions, speeds and accelerations are positive towards shorter.

    Arrays are read-only, shape (N,). A figure of `timing` that does not exist is None; its ``notes`` say why.
    """

    _document: DriveDocument

    @property
    def messages(self) -> Sequence[str]:
        """Limits that are crossed, values that are assumed or not verified, why a run ended early."""
        return tuple(notices(self))

    def to_frame(self) -> pd.DataFrame:
        """One row for each time, SI, with the names of a measurement file: time_s, command, pressure_Pa,
        displacement_m, velocity_m/s, acceleration_m/s2, force_N, length_m, diameter_m, mass_flow_kg/s and,
        with a controller, reference_m.
        """
        return frame_of(trace_columns(self))

    def plot(self) -> Figure:
        """Position, pressure and force over time."""
        from mckibben.door.figures.others import run_figure

        return run_figure(self, self._name)

    def _files(self, path: Path) -> str:
        """``.csv``: the trace with the conditions that a measurement file has."""
        if path.suffix.lower() == ".csv":
            return trace_text(self._document, self)
        return super()._files(path)

    def _summary(self) -> Summary:
        return summary_of(self, self._name)

    def _title(self) -> str:
        return f"Run of {self._name}: {self.outcome}"
