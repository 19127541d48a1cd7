"""Conversion of a linearisation request."""

from __future__ import annotations

from mckibben.application.linear.linearise import LinearQuestion
from mckibben.application.linear.text import checked, stated_condition
from mckibben.documents.drive_files import preset_document
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError, fields_inside
from mckibben.server.schemas.linearisations import LinearisationRequest, LinearPointInput
from mckibben.simulation.linear.point import Condition
from mckibben.simulation.linear.trials import Goals


def linear_question(body: LinearisationRequest, studio: Studio) -> LinearQuestion:
    """The question of a request.

    Raises:
        InputError: the drive cannot be used; its fields begin with ``drive``.
    """
    with fields_inside("drive"):
        document = body.drive if not isinstance(body.drive, str) else preset_document(body.drive, studio)
        annotated = drive_of(document, studio, measured=True)
    goals = None
    if body.design is not None:
        goals = checked(
            Goals(body.design.overshoot, body.design.settling, body.design.step, body.design.unsaturated)
        )
    return LinearQuestion(
        annotated,
        at=None if body.at is None else _condition(body.at),
        input=body.input,
        output=body.output,
        amplitudes=None if body.amplitudes is None else tuple(body.amplitudes),
        goals=goals,
    )


def _condition(at: LinearPointInput) -> Condition:
    stated = {name: value for name, value in at if value is not None}
    if len(stated) != 1:
        raise InputError(
            f"{len(stated)} values state the operating point; one does",
            field="at",
            hint='e.g. {"position": "40 mm"}',
        )
    ((kind, value),) = stated.items()
    return stated_condition(kind, value)
