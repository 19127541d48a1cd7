"""The functions of a structure evaluated for many sets at once, outside a run."""

from __future__ import annotations

import numpy as np

from mckibben.simulation.integrate.lane_code import LaneFunction, aligned
from mckibben.simulation.integrate.many import constants_of_many, lane_kernels
from mckibben.simulation.integrate.system import CompiledDrive


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
        for index in range(constants.shape[1]):
            self.put(first + index, constants[:, index])
        first += constants.shape[1]
        for index in range(len(drive.model.inputs)):
            self.put(first + index, inputs[..., index])

    def put(self, argument: int, values: np.ndarray | float) -> None:
        """Set an argument of all sets."""
        # Lanes without a set get the numbers of the last one.
        lanes = self._packed.shape[2]
        padded = np.empty(self._blocks * lanes)
        padded[: self.sets] = values
        padded[self.sets :] = padded[self.sets - 1]
        self._packed[:, argument, :] = padded.reshape(self._blocks, lanes)

    def get(self, argument: int) -> np.ndarray:
        """An argument of all sets."""
        return self._packed[:, argument, :].ravel()[: self.sets].copy()

    def call(self, function: LaneFunction) -> np.ndarray:
        """Results of a function of the structure, shape (width, sets)."""
        results = aligned(self._blocks, function.width, self._packed.shape[2])
        self._kernels.call_blocks(function.address, self._packed, results)
        return results.transpose(1, 0, 2).reshape(function.width, -1)[:, : self.sets]
