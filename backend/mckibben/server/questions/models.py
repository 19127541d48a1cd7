"""Conversion of a comparison or diagnosis request."""

from __future__ import annotations

from mckibben.application.model_question import ModelQuestion, question_of
from mckibben.documents.convert import stated_muscle
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.measurement.points import Points, find_points, joined
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError, fields_inside
from mckibben.server.schemas.comparisons import ModelRequest
from mckibben.simulation.drive.parts import Drive


def model_question(body: ModelRequest, studio: Studio, store: MeasurementStore) -> ModelQuestion:
    """The question of a request.

    Raises:
        InputError: an unknown preset, effect, parameter or measurement, or no model or data.
    """
    start, drive = _model(body, studio)
    used: dict[str, list[Points]] = {"fit": [], "validation": []}
    studio.static_model(start)  # errors of the model are reported before those of the data
    for place, item in enumerate(body.chosen()):
        field = "measurement" if body.measurement is not None else f"measurements.{place}.id"
        try:
            used[item.use].append(find_points(item.id, library=studio.library, store=store))
        except InputError as error:
            raise error.at(field) from error
    if not used["fit"]:
        raise InputError("no measurement to fit to", field="measurements", hint='give one the use "fit"')
    return question_of(
        start,
        studio,
        joined(used["fit"]),
        drive=drive,
        validation=joined(used["validation"]) if used["validation"] else None,
        free=body.free,
        freed=body.freed,
        noise=body.noise,
    )


def _model(body: ModelRequest, studio: Studio) -> tuple[StartModel, Drive | None]:
    """The start model and the drive; muscle and effects of the request replace those of the drive."""
    if body.drive is None:
        if body.muscle is None:
            raise InputError(
                "a muscle or a drive is needed", field="muscle", hint='e.g. {"preset": "DMSP-20"}'
            )
        return studio.start_model(stated_muscle(body.muscle), body.effects), None
    overrides = {"muscle": body.muscle, "effects": body.effects}
    document = body.drive.model_copy(
        update={name: value for name, value in overrides.items() if value is not None}
    )
    try:
        with fields_inside("drive"):
            annotated = drive_of(document, studio, measured=True)
    except InputError as error:
        field = (error.field or "").removeprefix("drive.")
        raise (error.at(field) if field.startswith(tuple(overrides)) else error) from error
    return annotated.start, annotated.drive
