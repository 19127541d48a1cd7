"""The corner at which a regulator rests: one orifice opens on one side of it, the other on the other."""

from __future__ import annotations

from typing import NamedTuple

from mckibben.simulation.linear.model import matrices
from mckibben.simulation.linear.point import OperatingPoint


class Corner(NamedTuple):
    """The two one-sided slopes of the pressure's rate at the outlet of a regulator, by its error [1/s].

    Attributes:
        filling: for a set point above the pressure.
        venting: for one below it.
    """

    filling: float
    venting: float


def corners_of(point: OperatingPoint) -> tuple[Corner, ...]:
    r"""The corners of the regulators of all muscles; none of a drive with a valve.

    .. math:: k_\pm = \left.\frac{\partial \dot p}{\partial e}\right|_{e = \pm 0}

    with the pressure at the outlet p, of the tube where there is one, and the error e, the set point after
    its lag minus p: in a volume at rest an error decays with exp(-k t).
    """
    bound = point.bound
    if bound.drive.regulator is None:
        return ()
    sides = {sign: matrices(point, side=sign, motion=point.motion)[0] for sign in (1, -1)}
    outlets = bound.places("tube_pressure") or bound.places("pressure")
    found = []
    for outlet, source, sense in zip(outlets, bound.places("regulator_pressure"), (1, -1), strict=False):
        row, column = bound.independent.index(outlet), bound.independent.index(source)
        found.append(Corner(float(sides[sense][row, column]), float(sides[-sense][row, column])))
    return tuple(found)


def slopes_in_words(corners: tuple[Corner, ...]) -> str:
    """Both slopes of each: "an error decays with 1003/s while filling and 478/s while venting"."""
    own = [f"{each.filling:.4g}/s while filling and {each.venting:.4g}/s while venting" for each in corners]
    return f"an error decays with {', of the second muscle with '.join(own)}"
