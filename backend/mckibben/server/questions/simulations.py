"""Conversion of a simulation request."""

from __future__ import annotations

from mckibben.application.run.simulate import SimulationQuestion
from mckibben.documents.drive_files import preset_document
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.studio import Studio
from mckibben.physics.errors import fields_inside
from mckibben.server.schemas.simulations import SimulationRequest


def simulation_question(body: SimulationRequest, studio: Studio) -> SimulationQuestion:
    """The question of a request.

    Raises:
        InputError: the drive cannot be used; fields begin with ``drive``.
    """
    with fields_inside("drive"):
        document = body.drive if not isinstance(body.drive, str) else preset_document(body.drive, studio)
        annotated = drive_of(document, studio)
    return SimulationQuestion(annotated, points=body.points, begin=body.begin, end=body.end)
