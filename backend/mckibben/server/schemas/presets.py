"""Answers of ``/api/presets``: each kind of preset in the form of its file, with its origin."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Union

from pydantic import BaseModel, Field, create_model

from mckibben.documents.strict import Strict
from mckibben.presets import (
    CurvePreset,
    DesignPreset,
    DrivePreset,
    FittingPreset,
    MeasurementPreset,
    MusclePreset,
    Preset,
    TaskPreset,
    TubePreset,
    ValvePreset,
)
from mckibben.presets.library import LibraryProblem
from mckibben.server.schemas.models import ModelRequest


class FittedMuscleRequest(ModelRequest):
    """A fitted model with its measurements, and the id of the preset that it becomes."""

    id: str = Field(
        max_length=64, examples=["bench-3-fitted"], description="Of the preset: letters, digits, hyphens."
    )
    title: str = Field("", max_length=120, description="Its name for display; empty = the id.")


PresetKind = Literal[
    "muscles", "valves", "tubes", "fittings", "measurements", "curves", "designs", "drives", "tasks"
]  # fmt: skip


def _answer(preset: type[Preset], name: str) -> type[BaseModel]:
    """The fields of a preset file with ``verified`` and ``origin`` added.

    A new model rather than a subclass, because the presets have properties of these names.
    """
    fields: dict[str, Any] = {key: (field.annotation, field) for key, field in preset.model_fields.items()}
    return create_model(
        name,
        __base__=Strict,
        __doc__=preset.__doc__,
        **fields,
        verified=(bool, Field(description="No figure is general knowledge (M) or an estimate (E).")),
        origin=(Literal["built-in", "user"], Field(description="Part of the program, or saved by the user.")),
    )


MuscleAnswer = _answer(MusclePreset, "MuscleAnswer")
_ANSWERS = (
    MuscleAnswer,
    _answer(ValvePreset, "ValveAnswer"),
    _answer(TubePreset, "TubeAnswer"),
    _answer(FittingPreset, "FittingAnswer"),
    _answer(MeasurementPreset, "MeasurementPresetAnswer"),
    _answer(CurvePreset, "CurvePresetAnswer"),
    _answer(DesignPreset, "DesignAnswer"),
    _answer(DrivePreset, "DriveAnswer"),
    _answer(TaskPreset, "TaskAnswer"),
)
PresetAnswer = Annotated[Union[_ANSWERS], Field(discriminator="kind")]  # type: ignore  # noqa: UP007 - built from a tuple


class PresetsAnswer(Strict):
    """All presets of one kind, and the files that could not be loaded."""

    kind: PresetKind = Field(description="The requested kind.")
    presets: list[PresetAnswer] = Field(description="The presets, by id.")  # pyright: ignore
    problems: list[LibraryProblem] = Field(description="Preset files that could not be loaded.")
