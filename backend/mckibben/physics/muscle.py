"""The muscle as the physics sees it: five lengths and an angle, numbers or symbols."""

from __future__ import annotations

from typing import NamedTuple

from mckibben.physics.braid import Braid, braid_from_diameter
from mckibben.physics.ops import Value

# Fields that a fit may free, and that are symbols of the compiled model.
GEOMETRY = ("nominal_length", "braid_diameter", "braid_angle", "wall_thickness", "inside_diameter")


class Muscle(NamedTuple):
    """A muscle at rest, SI units.

    Attributes:
        nominal_length: length L0 between the fittings at rest [m]; contraction is counted from here.
        braid_diameter: diameter D0 of the braid (mid-wall) at ``braid_angle`` [m]; the ideal model's D0.
        braid_angle: angle theta0 between thread and muscle axis at rest [rad].
        wall_thickness: thickness H of the elastomer wall at rest [m]; 0 when it is not known.
        inside_diameter: bore [m].
    """

    nominal_length: Value
    braid_diameter: Value
    braid_angle: Value
    wall_thickness: Value = 0.0
    inside_diameter: Value = 0.0

    @property
    def braid(self) -> Braid:
        """Thread length and turns of the braid at rest."""
        return braid_from_diameter(
            diameter=self.braid_diameter, braid_angle=self.braid_angle, length=self.nominal_length
        )

    def contraction(self, length: Value) -> Value:
        """Contraction ratio 1 - L/L0 of a length (positive = shorter)."""
        return 1.0 - length / self.nominal_length
