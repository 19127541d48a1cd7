"""Cubic polynomials between the rows of a table, on numbers, arrays and symbols."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mckibben.physics import ops
from mckibben.physics.ops import Value

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Polynomials between breaks; the outermost go on beyond the ends.

    Attributes:
        breaks: ascending, shape (pieces + 1,).
        coefficients: of powers of the distance from the left break, the highest first, shape (powers,
            pieces).
    """

    breaks: Array
    coefficients: Array

    def __call__(self, at: Value) -> Value:
        """Value at a number, an array or a symbol."""
        if not ops.is_symbolic(at):
            values = np.asarray(at, float)
            last = len(self.breaks) - 2
            piece = np.clip(np.searchsorted(self.breaks, values, side="right") - 1, 0, last)
            beyond = values - self.breaks[piece]
            found = self.coefficients[0][piece]
            for row in self.coefficients[1:]:
                found = found * beyond + row[piece]
            return found
        pieces: list[Value] = []
        for begin, own in zip(self.breaks[:-1].tolist(), self.coefficients.T.tolist(), strict=True):
            value: Value = own[0]
            for coefficient in own[1:]:
                value = value * (at - begin) + coefficient
            pieces.append(value)
        found = pieces[-1]
        for end, value in reversed(list(zip(self.breaks[1:-1].tolist(), pieces, strict=False))):
            found = ops.where(ops.greater(end, at), value, found)
        return found

    def derivative(self) -> Pieces:
        """The exact derivative."""
        powers = np.arange(len(self.coefficients) - 1, 0, -1.0)
        return Pieces(self.breaks, self.coefficients[:-1] * powers[:, None])

    def integral(self) -> Pieces:
        """The exact integral, 0 at the first break."""
        powers = np.arange(len(self.coefficients), 0, -1.0)
        raised = np.vstack([self.coefficients / powers[:, None], np.zeros(len(self.breaks) - 1)])
        width = np.diff(self.breaks)
        ends = np.zeros(len(width))
        for row in raised:
            ends = ends * width + row
        raised[-1] = np.concatenate([[0.0], np.cumsum(ends)[:-1]])
        return Pieces(self.breaks, raised)

    def negative(self) -> Pieces:
        """The same with the opposite sign."""
        return Pieces(self.breaks, -self.coefficients)


def monotone(*, x: Array, y: Array) -> Pieces:
    """Piecewise cubics through rows that are nowhere beyond their neighbours, with a continuous slope.

    Args:
        x: ascending, at least two.
        y: of the same rows.

    Source: Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300, doi 10.1137/0905021; ends by a
        parabola through three rows, limited (Moler, Numerical Computing with MATLAB (2004), 3.6).
    """
    width, slope = np.diff(x), np.diff(y) / np.diff(x)
    if len(x) == 2:
        return _hermite(x, y, np.array([slope[0], slope[0]]))
    inner = np.zeros(len(x) - 2)
    left, right = slope[:-1], slope[1:]
    same = left * right > 0.0
    one, two = 2.0 * width[1:] + width[:-1], width[1:] + 2.0 * width[:-1]
    inner[same] = (one + two)[same] / (one[same] / left[same] + two[same] / right[same])
    ends = [_end(width[0], width[1], slope[0], slope[1]), _end(width[-1], width[-2], slope[-1], slope[-2])]
    return _hermite(x, y, np.concatenate([[ends[0]], inner, [ends[1]]]))


def _end(near: float, far: float, slope: float, next_slope: float) -> float:
    """Slope at an end."""
    found = ((2.0 * near + far) * slope - near * next_slope) / (near + far)
    if found * slope <= 0.0:
        return 0.0
    if slope * next_slope <= 0.0 and abs(found) > 3.0 * abs(slope):
        return 3.0 * slope
    return float(found)


def spline(*, x: Array, y: Array) -> Pieces:
    """The cubic spline through rows whose third derivative is continuous at the second row from each end.

    Two rows give a line, three a parabola; arguments as `monotone`.

    Source: de Boor, A Practical Guide to Splines (1978), chapter IV.
    """
    count = len(x)
    if count < 4:
        return _through(x, y)
    width, slope = np.diff(x), np.diff(y) / np.diff(x)
    matrix, right = np.zeros((count, count)), np.zeros(count)
    for row in range(1, count - 1):
        matrix[row, row - 1 : row + 2] = width[row], 2.0 * (width[row - 1] + width[row]), width[row - 1]
        right[row] = 3.0 * (width[row] * slope[row - 1] + width[row - 1] * slope[row])
    for row, a, b, near, far in (
        (0, width[0], width[1], slope[0], slope[1]),
        (count - 1, width[-1], width[-2], slope[-1], slope[-2]),
    ):
        beside = 1 if row == 0 else count - 2
        matrix[row, row], matrix[row, beside] = b, a + b
        right[row] = ((a + 2.0 * (a + b)) * b * near + a * a * far) / (a + b)
    return _hermite(x, y, np.asarray(np.linalg.solve(matrix, right), np.float64))


def _through(x: Array, y: Array) -> Pieces:
    """The line or the parabola through two or three rows."""
    powers = np.polyfit(x - x[0], y, len(x) - 1)
    slopes = np.polyval(np.polyder(powers), x - x[0])
    return _hermite(x, y, np.asarray(slopes, float) * np.ones(len(x)))


def _hermite(x: Array, y: Array, slopes: Array) -> Pieces:
    """Cubics with these values and slopes at the rows."""
    width, slope = np.diff(x), np.diff(y) / np.diff(x)
    bend = (slopes[:-1] + slopes[1:] - 2.0 * slope) / width**2
    middle = (slope - slopes[:-1]) / width - bend * width
    return Pieces(np.asarray(x, float), np.array([bend, middle, slopes[:-1], y[:-1]]))
