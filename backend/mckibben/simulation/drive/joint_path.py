r"""The paths of the muscles of a joint in a run: polynomials of the angle, as the equations take them.

Each length is interpolated at Chebyshev's points between the stops, and the lever is the exact derivative of
that polynomial, so that no work is lost on a closed way. Formulas and points are met to rounding; a table
with a corner is smoothed by as much as `JointPath.deviation` says.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial
from numpy.typing import NDArray

from mckibben.physics.drive_terms import PATH_DEGREE
from mckibben.physics.errors import InputError
from mckibben.physics.muscle_path import MusclePath

Array = NDArray[np.float64]

_CHECKED = 401


@dataclass(frozen=True)
class JointPath:
    """The muscles of a joint along its angle.

    Attributes:
        lengths: of each muscle, a polynomial of x = (angle - middle) / half [m].
        low, high: angles of the stops [rad].
        rim: radius at which the coordinate of the drive counts, angle = stroke / rim [m].
        spring_rest: angle at which the torsion spring is relaxed [rad].
        deviation: largest difference of a polynomial from the stated length [m].
    """

    lengths: tuple[Polynomial, ...]
    low: float
    high: float
    rim: float
    spring_rest: float = 0.0
    deviation: float = 0.0

    @property
    def middle(self) -> float:
        """Middle of the range of angles [rad]."""
        return 0.5 * (self.low + self.high)

    @property
    def half(self) -> float:
        """Half of the range of angles [rad]."""
        return 0.5 * (self.high - self.low)

    def length(self, number: int, stroke: Array | float) -> Array:
        """Distance of the fittings of a muscle at strokes of the rim [m]."""
        x = (np.asarray(stroke, float) / self.rim - self.middle) / self.half
        return np.asarray(self.lengths[number](x))

    def path(self, number: int) -> MusclePath:
        """The same as a path over the angle."""
        length = self.lengths[number]
        lever, slope = length.deriv(1), length.deriv(2)

        def of(polynomial: Polynomial, factor: float) -> Callable[[Array], Array]:
            return lambda angle: factor * polynomial((angle - self.middle) / self.half)

        return MusclePath(
            of(length, 1.0), of(lever, -1.0 / self.half), of(slope, -1.0 / self.half**2), self.low, self.high
        )

    @property
    def constants(self) -> dict[str, float]:
        """Constants of a run, by name."""
        table = {
            "rim": self.rim,
            "spring_rest": self.rim * self.spring_rest,
            "path_middle": self.middle,
            "path_half": self.half,
        }
        for begin, length in zip(("", "counter_"), self.lengths, strict=False):
            lever = -length.deriv() / self.half
            for name, polynomial, count in (
                ("path_length", length, PATH_DEGREE + 1),
                ("path_lever", lever, PATH_DEGREE),
            ):
                padded = np.zeros(count)
                padded[: len(polynomial.coef)] = polynomial.coef
                table |= {f"{begin}{name}_{power}": float(value) for power, value in enumerate(padded)}
        return table


def refuse_path(path: JointPath | None, what: str) -> None:
    """Refuse what is made for strokes along a line or on a pulley.

    Args:
        path: of a drive.
        what: that is asked for, to be read before "of a joint".

    Raises:
        InputError: the drive has a path.
    """
    if path is not None:
        raise InputError(
            f"{what} of a joint whose levers change with its angle is not there yet",
            field="load.arrangement",
            hint='a pair on a pulley: "arrangement": "antagonist"',
        )


def joint_path(
    paths: tuple[MusclePath, ...], *, low: float, high: float, spring_rest: float = 0.0
) -> JointPath:
    """The paths between two stops [rad] as polynomials.

    The rim has the lever of the first muscle in the middle.
    """
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    check = np.linspace(-1.0, 1.0, _CHECKED)
    lengths, deviation = [], 0.0
    for path in paths:

        def stated(x: Array, path: MusclePath = path) -> Array:
            return np.asarray(path.length(middle + half * x), float) + 0.0 * x

        found = Chebyshev.interpolate(stated, PATH_DEGREE).convert(kind=Polynomial)
        lengths.append(found)
        deviation = max(deviation, float(np.max(np.abs(found(check) - stated(check)))))
    rim = abs(float(paths[0].lever(np.asarray(middle))))
    return JointPath(tuple(lengths), low, high, rim, spring_rest, deviation)
