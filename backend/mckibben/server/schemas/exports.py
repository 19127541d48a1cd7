"""Request and answers of ``/api/exports``: a model or drive as files for other programs."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field

from mckibben.documents.drive import DriveOrId
from mckibben.documents.muscle import EffectsInput, Muscle
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.strict import Strict


class ExportRequest(Strict):
    """What is taken along, and how: exactly one of muscle, model and drive."""

    format_id: Annotated[
        str,
        Field(
            alias="as",
            max_length=40,
            description="Id of a format; GET /api/exports lists them.",
            examples=["c"],
        ),
    ]
    muscle: Muscle | None = Field(None, description="A muscle, with its effects.")
    effects: EffectsInput | None = Field(
        None, description="The effects of the muscle; null: those of the preset."
    )
    model: SavedModel | None = Field(
        None, description="A model that was fitted to measurements, with its drive if it has one."
    )
    drive: DriveOrId | None = Field(None, description="A drive document, or the id of a drive preset.")
    title: Annotated[str, Field(max_length=200)] = Field(
        "", description="Title in the files. Default: that of the document, or preset and length."
    )
    name: Annotated[str, Field(max_length=100)] | None = Field(
        None, description="Name of the files without its ending. Default: made from the title."
    )


class ExportFormat(Strict):
    """A format."""

    id: str = Field(description="What ``as`` takes.", examples=["c"])
    title: str = Field(description="Its name for display.", examples=["C99"])
    note: str = Field(description="What is in it, in a few words.")
    drives: bool = Field(description="Whether it holds a whole drive; otherwise the muscle of one.")
    muscles: bool = Field(description="Whether it holds a muscle alone; otherwise it needs a drive.")


class FormatsAnswer(Strict):
    """The formats."""

    formats: list[ExportFormat] = Field(description="By id.")


ExportAnswer: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The file; several files as a zip file. Its name is in Content-Disposition.",
        "content": {
            "*/*": {"schema": {"type": "string", "format": "binary"}},
        },
    }
}
