"""The muscle: its geometry at rest, as numbers or symbols."""

from __future__ import annotations

from collections.abc import Iterable
from math import acos, degrees, isfinite
from typing import NamedTuple

from mckibben.physics import ideal
from mckibben.physics.braid import Braid, braid_from_diameter
from mckibben.physics.errors import InputError
from mckibben.physics.ops import Value
from mckibben.physics.parameter import USUAL_PRESSURE, MuscleSize

# Fields that a fit may change; symbols of the compiled model.
GEOMETRY = ("nominal_length", "braid_diameter", "braid_angle", "wall_thickness", "inside_diameter")

HIGHEST_PRESSURE = 1.6e6  # of any muscle, gauge [Pa]
NEUTRAL_ANGLE = acos(3.0**-0.5)  # 54.7356 degrees: no force at any pressure

# Wall of a muscle that does not state it: 1.8 mm in DMSP-10 and DMSP-20 (Martens & Boblan 2017), 0.5 to
# 1.6 mm in hand-made ones; at most this share of the diameter, so that a thin muscle keeps a bore.
_TYPICAL_WALL = 1.5e-3
_TYPICAL_WALL_SHARE = 0.15

# Field -> (smallest, largest) accepted [m].
_RANGES = {
    "nominal_length": (1e-3, 50.0),
    "braid_diameter": (1e-4, 1.0),
    "wall_thickness": (0.0, 0.1),
    "inside_diameter": (0.0, 1.0),
}


def assumption(muscle: Muscle, field: str) -> str:
    """Note on a field with an assumed typical value (`Muscle.assuming`)."""
    value = 1e3 * getattr(muscle, field)
    return (
        f"the {field.replace('_', ' ')} of the muscle is not stated: {value:.3g} mm is assumed; only its "
        "product with the modulus of the wall acts"
    )


class Muscle(NamedTuple):
    """A muscle at rest, SI units.

    Attributes:
        nominal_length: length L0 between the fittings at rest [m]; contraction is measured from here.
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

    def blocked_force(self, pressure: float = HIGHEST_PRESSURE) -> float:
        """Force of the ideal muscle at its nominal length [N], 0 of one that does not pull there.

        Args:
            pressure: gauge [Pa], of which at most `HIGHEST_PRESSURE` counts.
        """
        force = ideal.blocked_force(
            diameter=self.braid_diameter,
            braid_angle=self.braid_angle,
            pressure=min(pressure, HIGHEST_PRESSURE),
        )
        return max(float(force), 0.0)

    @property
    def size(self) -> MuscleSize:
        """With the blocked force at `USUAL_PRESSURE`."""
        return MuscleSize(
            self.blocked_force(USUAL_PRESSURE), float(self.nominal_length), float(self.braid_diameter)
        )

    def contraction(self, length: Value) -> Value:
        """Contraction ratio 1 - L/L0 of a length (positive = shorter)."""
        return 1.0 - length / self.nominal_length

    def assuming(self, fields: Iterable[str]) -> Muscle:
        """This muscle with a typical value for each of the fields that is not known (0).

        A wall is 1.5 mm, at most 15 % of the braid diameter. Other fields have no typical value and stay 0.
        """
        if "wall_thickness" not in fields or self.wall_thickness != 0.0:
            return self
        return self._replace(wall_thickness=min(_TYPICAL_WALL, _TYPICAL_WALL_SHARE * self.braid_diameter))

    def checked(self) -> Muscle:
        """This muscle, after checking that its geometry describes one that can pull.

        Raises:
            InputError: a length or the braid angle is out of range; names the field.
        """
        for name, (smallest, largest) in _RANGES.items():
            value = getattr(self, name)
            if not isfinite(value) or not smallest <= value <= largest:
                raise InputError(
                    f"{name.replace('_', ' ')} {value * 1e3:.6g} mm is not between "
                    f"{smallest * 1e3:g} mm and {largest * 1e3:g} mm",
                    field=f"muscle.{name}",
                )
        angle = self.braid_angle
        if not isfinite(angle) or angle <= 0.0:
            raise InputError(
                f"braid angle {degrees(angle):.6g}° must be above 0°",
                field="muscle.braid_angle",
                hint="e.g. '25 deg', the angle between thread and muscle axis at rest",
            )
        if angle >= NEUTRAL_ANGLE:
            raise InputError(
                f"braid angle {degrees(angle):.6g}° is not below the neutral angle 54.7356°: "
                "the muscle would lengthen instead of contract",
                field="muscle.braid_angle",
                hint="real muscles have 20° to 35° at rest",
            )
        if 2.0 * self.wall_thickness >= self.braid_diameter + self.wall_thickness:
            raise InputError(
                f"a wall of {self.wall_thickness * 1e3:.6g} mm leaves no bore in a braid of "
                f"{self.braid_diameter * 1e3:.6g} mm",
                field="muscle.wall_thickness",
            )
        return self
