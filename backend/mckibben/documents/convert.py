"""Conversion of validated pydantic models to plain objects."""

from __future__ import annotations

from mckibben.documents.muscle import MuscleInput
from mckibben.documents.start_model import StatedMuscle
from mckibben.physics.braid import Rhombus


def stated_muscle(muscle: MuscleInput) -> StatedMuscle:
    """The muscle of a request as a plain object."""
    lattice = muscle.rhombus
    return StatedMuscle(
        preset=muscle.preset,
        nominal_length=muscle.nominal_length,
        inside_diameter=muscle.inside_diameter,
        braid_diameter=muscle.braid_diameter,
        braid_angle=muscle.braid_angle,
        wall_thickness=muscle.wall_thickness,
        thread_length=muscle.thread_length,
        turns=muscle.turns,
        rhombus=None if lattice is None else Rhombus(lattice.side, lattice.along, lattice.around),
    )
