"""A run alone: one lane of the kernel of many runs, so its results are those of the same set among others."""

from __future__ import annotations

from typing import Any

import numpy as np

from mckibben.simulation.integrate.lane_buffers import columns_of, lane_kernels
from mckibben.simulation.integrate.problem import (
    EVENT_WIDTH,
    MOST_EVENTS,
    Solution,
    bounce_of,
    outcome_of,
)
from mckibben.simulation.integrate.recycled import recycled
from mckibben.simulation.integrate.system import CompiledDrive
from mckibben.simulation.outcome import MAX_STEPS


class Alone:
    """Runs of one parameter set, from any state over any segments.

    Args:
        drive: the compiled structure.
        parameters: constants of the run in the order of ``drive.model.parameters``.
        tolerance: relative error per step; the absolute one is this times the scale of the state.
        restitution: see `mckibben.simulation.integrate.engine.integrate`.
    """

    def __init__(
        self, drive: CompiledDrive, *, parameters: np.ndarray, tolerance: float, restitution: float
    ) -> None:
        self.drive, self._tolerance = drive, tolerance
        self._kernels, self._columns = lane_kernels.awaited(), columns_of(drive, None)
        self.constants = drive.codes.constants(parameters)
        self._stops = drive.stops(parameters)[None]
        self._switching = (drive.least, bounce_of(restitution), drive.follows, drive.watched, drive.slides)
        self._absolute = tolerance * drive.scales

    def run(
        self,
        *,
        start: np.ndarray,
        switches: np.ndarray,
        times: np.ndarray,
        inputs: np.ndarray,
        grid: np.ndarray,
        first_step: float,
        measured: int = 0,
        loop: tuple[Any, ...] | None = None,
        max_steps: int = MAX_STEPS,
    ) -> Solution:
        """Integrate from ``times[0]`` to ``times[-1]``, segment by segment.

        Args:
            start, switches: at the first boundary.
            times: segment boundaries, shape (segments + 1,).
            inputs: of each segment, shape (segments, inputs).
            grid: ascending times of the rows within the boundaries.
            first_step: first step that is tried [s].
            measured, loop: of a sampled controller, see
                `mckibben.simulation.integrate.lane_kernel.rodas4_lanes`; ``times`` and ``inputs`` are then
                room for the segments, after the first boundary infinite.
            max_steps: accepted and rejected.
        """
        drive, kernels, rows = self.drive, self._kernels, len(grid)
        lanes = kernels.lanes
        padded = np.full((1, rows + 2 * lanes), np.inf)
        padded[0, :rows] = grid
        out = recycled(1, self._columns.count, (rows + 2 * lanes - 1) // lanes * lanes)
        end, ended = np.empty((1, drive.size)), np.array(switches, dtype=float)[None]
        events, step = np.empty((1, MOST_EVENTS, EVENT_WIDTH)), np.array([float(first_step)])
        counts, statuses = np.zeros((1, 4), np.int64), np.zeros(1, np.int64)
        with self._columns.room(kernels) as arrays:
            kernels.run(
                *self._columns.model,
                self._switching,
                self._stops,
                self.constants[None],
                np.ascontiguousarray(start, dtype=float)[None],
                ended,
                np.ascontiguousarray(times, dtype=float)[None],
                np.ascontiguousarray(inputs, dtype=float)[None],
                step,
                padded,
                self._tolerance,
                self._absolute,
                self._columns.given,
                out,
                end,
                events,
                counts,
                statuses,
                max_steps,
                False,
                measured,
                kernels.no_loop if loop is None else loop,
                arrays,
            )
        steps, rejected, written, happened = counts[0].tolist()
        return Solution(
            out[0, :, :written].T,
            end[0],
            ended[0],
            events[0, :happened].copy(),
            outcome_of(int(statuses[0])),
            steps,
            rejected,
            float(step[0]),
        )
