"""Rows of a measurement at which the velocity jumps."""

from __future__ import annotations

import itertools

import numpy as np

from mckibben.measurement.motion import RecordedMotion

# The velocity of a row counts as a jump if its uncertainty exceeds both
_UNSURE = 5.0  # times the median uncertainty and
_JUMP = 0.05  # times the speed of the neighbouring rows.
_STILL = 0.25  # speed over that of both neighbours, below which the motion turns
_SUDDEN = 4.0  # change of velocity over the changes before and after, above which it is a jump
_FEW = 0.1  # largest share of rows with jumps; above, the velocity is simply noisy
_CORNER = 0.2  # change of the speed at a row, as a share of the usual speed, from which it may be a corner
_BEYOND = 6.0  # the same over its median at all rows
_MOST_CORNERS = 0.3  # largest share of rows beside corners; above, no way is straight enough to tell


def jumps(time: np.ndarray, length: np.ndarray, moved: RecordedMotion, records: np.ndarray) -> np.ndarray:
    """Mask of the rows at which the velocity jumps within a record; empty if there are many.

    These are rows whose velocity is far less certain than that of the others. Where the velocity changes
    suddenly between two rows, it is the row nearer to the intersection of both straight lines.
    """
    unsure = _UNSURE * float(np.median(moved.velocity_sigma))
    edges = [0, *(np.flatnonzero(np.diff(records)) + 1).tolist(), len(time)]
    parts = [slice(first, last) for first, last in itertools.pairwise(edges)]
    sudden = np.concatenate([
        _jumps_within(time[part], length[part], moved.velocity[part], moved.velocity_sigma[part], unsure)
        for part in parts
    ])  # fmt: skip
    corners = np.concatenate([_corners(time[part], length[part]) for part in parts])
    if np.mean(corners) > _MOST_CORNERS:
        corners[:] = False
    return sudden | corners if np.mean(sudden & ~corners) < _FEW else corners


def _corners(time: np.ndarray, length: np.ndarray) -> np.ndarray:
    """Mask of the rows of one record at which a way that was straight is so no more.

    The rows on both sides of a corner that lies between them: a velocity fitted over neighbours mixes the
    speeds of both sides there. A way that bends all along changes as much before and behind such a row.
    """
    corners = np.zeros(len(time), bool)
    if len(time) < 5:
        return corners
    speed = np.diff(length) / np.diff(time)
    change = np.abs(np.diff(speed))  # at the rows 1 to n - 2
    beside = np.minimum(change[:-2], change[2:])
    usual, scatter = float(np.percentile(np.abs(speed), 75.0)), float(np.median(change))
    corners[2:-2] = change[1:-1] > np.maximum(_SUDDEN * beside, max(_CORNER * usual, _BEYOND * scatter))
    return corners


def _jumps_within(
    time: np.ndarray, length: np.ndarray, velocity: np.ndarray, sigma: np.ndarray, unsure: float
) -> np.ndarray:
    """Mask of the rows of one record at which the velocity jumps, or is less certain than ``unsure``."""
    speed = np.pad(np.abs(velocity), 1)
    size = np.maximum(np.maximum(speed[:-2], speed[2:]), speed[1:-1])
    jumps = np.isfinite(sigma) & (sigma > np.maximum(unsure, _JUMP * size))
    jumps |= speed[1:-1] < _STILL * np.minimum(speed[:-2], speed[2:])
    change = np.pad(np.abs(np.diff(velocity)), 1)
    around = np.maximum(np.maximum(change[:-2], change[2:]), np.hypot(sigma[1:], sigma[:-1]))
    sudden = np.flatnonzero(change[1:-1] > np.maximum(_SUDDEN * around, _JUMP * size[1:]))
    step, lengthened = time[sudden + 1] - time[sudden], length[sudden + 1] - length[sudden]
    before, after = velocity[sudden], velocity[sudden + 1]
    intersection = (lengthened - after * step) / (
        before - after
    )  # time of the intersection after the first row [s]
    jumps[sudden + (intersection > 0.5 * step)] = True
    return jumps
