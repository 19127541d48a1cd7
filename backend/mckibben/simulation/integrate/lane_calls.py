"""The functions of a structure evaluated for many sets at once, outside a run."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mckibben.simulation.integrate.lane_code import LaneFunction, aligned
from mckibben.simulation.integrate.many import constants_of_many, lane_kernels
from mckibben.simulation.integrate.system import CompiledDrive

_NARROW = 1e-13  # bracket of a root


class LaneCalls:
    """Arguments of many sets: states, constants of the run, inputs and switches; states and switches are 0.

    Args:
        drive: the compiled structure.
        parameters: shape (sets, parameters).
        inputs: shape (inputs,) or (sets, inputs).
    """

    def __init__(self, drive: CompiledDrive, parameters: np.ndarray, inputs: np.ndarray) -> None:
        self.drive, self.sets = drive, len(parameters)
        self._kernels = lane_kernels.awaited()
        lanes = self._kernels.lanes
        self._blocks = -(-self.sets // lanes)
        self._packed = aligned(self._blocks, drive.codes.rates.size, lanes)
        constants, first = constants_of_many(drive, parameters), drive.size
        of_lanes = np.minimum(np.arange(self._blocks * lanes), self.sets - 1)  # also of lanes without a set
        blocks = constants[of_lanes].reshape(self._blocks, lanes, -1)
        self._packed[:, first : first + blocks.shape[2], :] = blocks.transpose(0, 2, 1)
        first += blocks.shape[2]
        for index in range(len(drive.model.inputs)):
            self.put(first + index, inputs[..., index])

    def put(self, argument: int, values: np.ndarray | float) -> None:
        """Set an argument of all sets."""
        self._packed[:, argument, :] = self._padded(values) if np.ndim(values) else values

    def _padded(self, values: np.ndarray | float) -> np.ndarray:
        """Values of the sets by block and lane; lanes without a set get the one of the last."""
        padded = np.empty(self._blocks * self._kernels.lanes)
        padded[: self.sets] = values
        padded[self.sets :] = padded[self.sets - 1]
        return padded.reshape(self._blocks, -1)

    def get(self, argument: int) -> np.ndarray:
        """An argument of all sets."""
        return self._packed[:, argument, :].ravel()[: self.sets].copy()

    def call(self, function: LaneFunction) -> np.ndarray:
        """Results of a function of the structure, shape (width, sets)."""
        results = aligned(self._blocks, function.width, self._packed.shape[2])
        self._kernels.call_blocks(function.address, self._packed, results)
        return results.transpose(1, 0, 2).reshape(function.width, -1)[:, : self.sets]

    def roots(
        self,
        function: LaneFunction,
        result: int,
        follows: Mapping[int, tuple[np.ndarray | float, float]],
        bracket: tuple[np.ndarray, np.ndarray],
        wanted: np.ndarray,
        line: tuple[float, float] = (0.0, 1.0),
    ) -> np.ndarray:
        """Where a result of a function is zero, shape (sets,).

        Args:
            function: the function of the structure.
            result: number of its result.
            follows: arguments that are ``offset + slope * x`` of the x that is sought: number -> (offset of
                each set, slope). They are overwritten.
            bracket: ends for each set; the line must be positive at the first and not at the second.
            wanted: sets whose root is wanted; the others get the first end.
            line: (a, b): where a + b * result is zero, instead of the result.
        """
        low, high = (np.ascontiguousarray(self._padded(end)) for end in bracket)
        chosen = np.zeros(low.size, bool)
        chosen[: self.sets] = wanted
        offsets = np.stack([self._padded(offset) for offset, _ in follows.values()], axis=1)
        self._kernels.find_roots(
            function.address,
            result,
            np.array(line),
            np.array(list(follows), np.int64),
            np.array([slope for _, slope in follows.values()]),
            np.ascontiguousarray(offsets),
            self._packed,
            aligned(self._blocks, function.width, self._kernels.lanes),
            low,
            high,
            chosen.reshape(low.shape),
            _NARROW,
        )
        return low.ravel()[: self.sets]
