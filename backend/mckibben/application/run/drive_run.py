"""The run of a drive, how sure its position is, and where it uses the model of its muscle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mckibben.application.envelope import MeasuredRange, range_of
from mckibben.application.prediction_interval import PositionInterval, position_interval
from mckibben.documents.drive_reading import AnnotatedDrive
from mckibben.simulation.drive.controlled import simulate_controlled
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import Run
from mckibben.simulation.drive.transient import simulate as run_by_command
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.simulation.timing.evaluation import Grid

Array = np.ndarray


def run_drive(annotated: AnnotatedDrive, grid: Grid, watch: Watch | None = None) -> Run:
    """The run on the fine grid."""
    with np.errstate(all="ignore"):  # a diverging run ends with an outcome, not with warnings
        if annotated.drive.controller is not None:
            return simulate_controlled(annotated.drive, grid=grid.time, watch=watch)
        return run_by_command(annotated.drive, grid=grid.time)


def measured_interval(
    annotated: AnnotatedDrive, grid: Grid, run: Run, watch: Watch
) -> PositionInterval | None:
    """The interval of the position at the rows; None too where a run with other values ends early."""
    rows = grid.rows
    if annotated.start.fit is None or run.outcome is not Outcome.COMPLETED:
        return None

    def position_of(drive: Drive) -> Array:
        other = run_drive(replace(annotated, drive=drive), grid, watch)
        position = np.full(len(rows), np.nan)
        if other.outcome is Outcome.COMPLETED:
            position = other.states["stroke"][rows] / drive.load.lever_ratio
        return position

    position = run.states["stroke"][rows] / run.drive.load.lever_ratio
    return position_interval(annotated.start.fit, annotated.drive, position, position_of)


def use_of_run(run: Run) -> dict[str, MeasuredRange]:
    """The ranges in which a run uses the model of its muscle."""
    drive = run.drive
    if not len(run.time):
        return {}
    rest, stroke = drive.muscle.nominal_length, run.states["stroke"]
    speed = float(np.max(np.abs(run.states["speed"])))
    contraction = drive.contraction(stroke)
    ends = (float(pick(contraction)) for pick in (np.min, np.max))
    use = (
        range_of("rest_length", rest)
        | range_of("pressure", float(np.min(run.pressure)), float(np.max(run.pressure)))
        | range_of("contraction", *ends)
        | range_of("speed", 0.0, speed)
        | range_of("temperature", drive.temperature)
        | range_of("mass", drive.load.mass)
        | range_of("supply", drive.supply_pressure)
    )
    return use | range_of("load", drive.load.force) if isinstance(drive.load.force, float | int) else use
