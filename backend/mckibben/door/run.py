"""A simulated run of a drive."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mckibben.application.run.simulate import SimulationResult
from mckibben.application.run.trace import trace_columns, trace_text
from mckibben.documents.drive import DriveDocument
from mckibben.door.frames import frame_of
from mckibben.door.result import Result
from mckibben.door.values import FloatArray, read_only
from mckibben.report.summary import Summary
from mckibben.report.summary.simulation import notices, summary_of
from mckibben.simulation.timing.table import TimingTable
from mckibben.simulation.timing.tracking import Tracking

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Run(Result):
    """A run, from `Drive.run`; N rows, SI. Positions, speeds and accelerations are positive towards shorter.

    Arrays are read-only, shape (N,).
    """

    __slots__ = ("_document", "_name", "_result")

    _result: SimulationResult
    _document: DriveDocument
    _name: str

    def __init__(self, result: SimulationResult, document: DriveDocument, name: str) -> None:
        self._set(_result=result, _document=document, _name=name)

    @property
    def time(self) -> FloatArray:
        """Time [s]."""
        return read_only(self._result.time)

    @property
    def position(self) -> FloatArray:
        """Position of the load [m]."""
        return read_only(self._result.position)

    @property
    def interval(self) -> tuple[FloatArray, FloatArray] | None:
        """Ends between which 90 % of new readings of the position lie [m]; see `Curves.interval`."""
        found = self._result.interval
        return None if found is None else (read_only(found.low), read_only(found.high))

    @property
    def velocity(self) -> FloatArray:
        """Speed of the load [m/s]."""
        return read_only(self._result.velocity)

    @property
    def acceleration(self) -> FloatArray:
        """Acceleration of the load [m/s²]."""
        return read_only(self._result.acceleration)

    @property
    def pressure(self) -> FloatArray:
        """Gauge pressure in the muscle [Pa]."""
        return read_only(self._result.pressure)

    @property
    def force(self) -> FloatArray:
        """Tension of the muscle [N]."""
        return read_only(self._result.force)

    @property
    def mass_flow(self) -> FloatArray:
        """Flow of air into the muscle [kg/s]."""
        return read_only(self._result.mass_flow)

    @property
    def timing(self) -> TimingTable:
        """Figures of fill (``extend``) and exhaust (``retract``): rise_time, positioning_time, max_speed,
        impact_energy, air_volume_anr and the like, SI. One that does not exist is None; ``notes`` says why.
        """
        return self._result.timing

    @property
    def tracking(self) -> Tracking | None:
        """How a controlled run follows its reference; None without a controller."""
        return self._result.tracking

    @property
    def outcome(self) -> str:
        """completed, or how the run ended early."""
        return self._result.outcome

    @property
    def messages(self) -> Sequence[str]:
        """Limits that are crossed, values that are assumed or not verified, why a run ended early."""
        return tuple(notices(self._result))

    @property
    def details(self) -> SimulationResult:
        """Everything else: flows, volume, temperature, contact with stops, readings of sensors."""
        return self._result

    def to_frame(self) -> pd.DataFrame:
        """One row for each time, SI, with the names of a measurement file: time_s, command, pressure_Pa,
        displacement_m, velocity_m/s, acceleration_m/s2, force_N, length_m, diameter_m, mass_flow_kg/s and,
        with a controller, reference_m.
        """
        return frame_of(trace_columns(self._result))

    def plot(self) -> Figure:
        """Position, pressure and force over time."""
        from mckibben.door.figures.others import run_figure

        return run_figure(self._result, self._name)

    def _files(self, path: Path) -> str:
        """``.csv``: the trace with the conditions that a measurement file has."""
        if path.suffix.lower() == ".csv":
            return trace_text(self._document, self._result)
        return super()._files(path)

    def _answer(self) -> object:
        return self._result

    def _summary(self) -> Summary:
        return summary_of(self._result, self._name)

    def _title(self) -> str:
        return f"Run of {self._name}: {self.outcome}"
