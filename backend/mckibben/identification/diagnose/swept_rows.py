"""A residual sweep by sweep, without what a polynomial of each sweep can follow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np

FEWEST_ROWS = 60
#: What a residual may repeat over.
Coordinate = Literal["length", "pressure", "time"]
#: What a line of a file without time repeats over besides.
Over = Literal["length", "pressure", "time", "rows"]
COORDINATES: tuple[Coordinate, ...] = ("length", "pressure", "time")
_DEGREE, _ROWS_PER_DEGREE = 4, 12  # of the polynomial of a sweep
_MOST_ROWS = 6000  # more are thinned


@dataclass(frozen=True)
class SweptRows:
    """Rows of all sweeps, one sweep after the other.

    Attributes:
        inputs: coordinates.
        own: the residual without its mean.
        left: the residual without the polynomial of each sweep.
        whole: sum of squares of ``own``.
        parts: where each sweep is among the rows.
        alike: (rows of all sweeps of one length, shape (sweeps, length), their orthonormal polynomials).
        record: index of the record of each row, from 0.
        sweep: index of the sweep.
    """

    inputs: Mapping[str, np.ndarray]
    own: np.ndarray
    left: np.ndarray
    whole: float
    parts: list[slice]
    alike: list[tuple[np.ndarray, np.ndarray]]
    record: np.ndarray
    sweep: np.ndarray

    @classmethod
    def of(
        cls, residual: np.ndarray, inputs: Mapping[str, np.ndarray], sweeps: Sequence[np.ndarray],
        records: np.ndarray,
    ) -> SweptRows | None:  # fmt: skip
        """The rows; None for too few, or without a rest."""
        step = max(1, -(-sum(map(len, sweeps)) // _MOST_ROWS))
        lines = [np.asarray(sweep)[::step] for sweep in sweeps if len(sweep[::step]) >= _DEGREE]
        if sum(map(len, lines)) < FEWEST_ROWS:
            return None
        ends = np.cumsum([0, *map(len, lines)])
        parts = [slice(int(a), int(b)) for a, b in pairwise(ends)]
        order = np.concatenate(lines)
        sizes = np.diff(ends)
        alike = [
            (ends[:-1][sizes == size, None] + np.arange(size), _polynomials(int(size)))
            for size in np.unique(sizes)
        ]
        own = residual[order] - np.mean(residual[order])
        whole = float(own @ own)
        result = cls(
            inputs={name: inputs[name][order] for name in COORDINATES if name in inputs},
            own=own,
            left=own,
            whole=whole,
            parts=parts,
            alike=alike,
            record=np.unique(records[order], return_inverse=True)[1],
            sweep=np.repeat(np.arange(len(lines)), sizes),
        )
        left = result.projected(own)
        if not float(left @ left) > 1e-12 * whole:
            return None
        return replace(result, left=left)

    @property
    def lines(self) -> list[np.ndarray]:
        """The rows of each sweep."""
        return [np.arange(part.start, part.stop) for part in self.parts]

    def projected(self, columns: np.ndarray) -> np.ndarray:
        """Columns without what the polynomials of the sweeps can follow."""
        result = np.array(columns, dtype=float).reshape(len(columns), -1)
        for rows, basis in self.alike:
            result[rows] -= basis @ (basis.T @ result[rows])
        return result.reshape(columns.shape)


def _polynomials(rows: int) -> np.ndarray:
    degree = min(_DEGREE, rows // _ROWS_PER_DEGREE)
    return np.linalg.qr(np.polynomial.chebyshev.chebvander(np.linspace(-1.0, 1.0, rows), degree))[0]
