"""The document of a model that was fitted to measurements, as ``mckibben diagnose --save`` writes it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field, model_validator

from mckibben.documents.drive import DriveDocument
from mckibben.documents.muscle import EffectsInput, MuscleInput
from mckibben.documents.problems import validated
from mckibben.documents.start_model import stated_muscle
from mckibben.documents.strict import Strict
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import GEOMETRY
from mckibben.presets.fit import Covariance, FitRecord, MeasuredSpan

if TYPE_CHECKING:
    from mckibben.documents.start_model import StartModel
    from mckibben.documents.studio import Studio

_HINT = "the file of: mckibben diagnose DATA --save MODEL.json"
Text = Annotated[str, Field(max_length=2000)]


class RangeInput(Strict):
    """The range of a quantity in the data of the model."""

    least: float = Field(description="Smallest value.")
    most: float = Field(description="Largest value.")
    unit: str = Field(description="SI unit.")


class FittedFile(Strict):
    """A measurement that the model was fitted to."""

    name: str = Field(description="Name of the file or preset.")
    sha256: str | None = Field(description="Of the file; null for a preset of the program.")
    rows: int = Field(description="Number of its rows.")
    experiment: dict[str, str] = Field(
        default_factory=dict, description="What it was made with, and who says it, in words."
    )
    prepared: list[Text] = Field(
        default_factory=list, description="Steps that prepared it, in their order, as they are written."
    )


class FitError(Strict):
    """How well the model describes its data."""

    rmse: float = Field(description="Root mean square of the residual.")
    holdout_rmse: float | None = Field(description="The same of groups that were left out of the fit.")
    noise: float | None = Field(description="Noise of the data; null where it cannot be estimated.")
    unit: str = Field(description='SI unit; "1" = relative to the noise of each channel.')


class SavedOrigin(Strict):
    """Where the model comes from."""

    program: str = Field(description="Name and version.")
    made: str = Field(description="Date and time, ISO 8601, UTC.")
    kind: str = Field(description="Kind of the measurements.")
    predicted: str = Field(description="Channel that the model predicts.")
    verdict: str = Field(description="Title of the verdict.")
    error: FitError = Field(description="How well it describes them.")
    files: list[FittedFile] = Field(description="What it was fitted to.")


class SavedModel(Strict):
    """A model with its values: a muscle with its fitted geometry, effects, and of a transient the drive."""

    schema_version: Literal[1] = Field(alias="schema", description="Version of the document.")
    kind: Literal["model"] = Field(description="The word 'model'.")
    muscle: MuscleInput = Field(
        description="Without a length where the model is one of muscles of several lengths."
    )
    effects: EffectsInput = Field(description="Its effects with their numbers.")
    freed: list[str] = Field(
        default_factory=list, description="Constants that the fit changed as well, as effect.parameter."
    )
    free: list[str] = Field(default_factory=list, description="Geometry that the fit changed as well.")
    stated: dict[str, Annotated[float, Field(gt=0.0)]] = Field(
        default_factory=dict, description="What was stated for that geometry instead, SI."
    )
    load_force: float | None = Field(
        None, description="Load of isotonic data that do not state it, as the fit found it [N]."
    )
    drive: DriveDocument | None = Field(
        None, description="Of a transient: valve, tube, supply, load, stops, with muscle and effects."
    )
    envelope: dict[str, RangeInput] = Field(
        default_factory=dict, description="Quantity -> range in which the model was measured."
    )
    errors: dict[str, Annotated[float, Field(ge=0.0)]] = Field(
        default_factory=dict, description="Predicted channel -> error left (rms), SI."
    )
    covariance: Covariance | None = Field(
        None, description="Of the fitted values; null where the data cannot separate them."
    )
    assumed: list[Text] = Field(default_factory=list, description="What nobody said and was assumed.")
    origin: SavedOrigin | None = Field(None, description="Where it comes from; null where nothing is known.")

    @model_validator(mode="after")
    def _known_names(self) -> SavedModel:
        """What is freed is part of the model."""
        for place, name in enumerate(self.freed):
            effect, dot, _ = name.partition(".")
            if not dot or effect not in self.effects:
                raise InputError(
                    f"the model has no effect {effect}",
                    field=f"freed.{place}",
                    hint=did_you_mean(effect, self.effects) if self.effects else "remove it",
                )
        places = [(f"free.{place}", name) for place, name in enumerate(self.free)]
        for field, name in (*places, *((f"stated.{name}", name) for name in self.stated)):
            if name not in GEOMETRY:
                raise InputError(f"'{name}' is no geometry", field=field, hint=did_you_mean(name, GEOMETRY))
        return self

    @model_validator(mode="after")
    def _one_model(self) -> SavedModel:
        """The model inside the drive is the same one."""
        if self.drive is None:
            return self
        mine = self.muscle.model_dump(exclude={"nominal_length"})
        if self.drive.muscle.model_dump(exclude={"nominal_length"}) != mine:
            raise InputError(
                "drive.muscle is not the muscle of the model", field="drive.muscle", hint="change both"
            )
        if self.drive.effects != self.effects:
            raise InputError(
                "drive.effects are not the effects of the model", field="drive.effects", hint="change both"
            )
        return self


def fit_record(saved: SavedModel) -> FitRecord | None:
    """How a saved model was fitted; None where it does not say from what."""
    origin = saved.origin
    if origin is None:
        return None
    return FitRecord(
        files=[file.name[:300] for file in origin.files],
        made=origin.made,
        errors=dict(saved.errors),
        envelope={
            name: MeasuredSpan(least=span.least, most=span.most, unit=span.unit)
            for name, span in saved.envelope.items()
        },
        covariance=saved.covariance,
        stated=dict(saved.stated),
    )


def with_record(start: StartModel, saved: SavedModel, studio: Studio) -> StartModel:
    """A start model with how it was fitted, as long as it is the saved model, whatever its length.

    What its data corrected of the geometry stays so with other effects.
    """
    own = studio.start_model(
        stated_muscle(saved.muscle.model_copy(update={"nominal_length": start.muscle.nominal_length})),
        saved.effects,
    )
    same = (start.muscle, start.effects) == (own.muscle, own.effects)
    return replace(start, fitted=fit_record(saved) if same else start.fitted, stated=dict(saved.stated))


def read_saved_model(document: object, subject: str) -> SavedModel:
    """A saved model from JSON.

    Args:
        document: parsed JSON.
        subject: name of the document in messages.

    Raises:
        InputError: the document is not valid; ``field`` is the path in it.
    """
    if not isinstance(document, dict) or document.get("kind") != "model":
        raise InputError(f'{subject} is no saved model: it has no "kind": "model"', hint=_HINT)
    return validated(SavedModel, document, subject)
