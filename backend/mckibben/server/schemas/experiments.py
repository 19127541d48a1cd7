"""The experiment behind a measurement, in previews, requests and answers.

1. *Before a file is stored.* ``POST /api/measurements/preview?name=...&muscle=DMSP-20`` answers
   ``experiment``: every field that matters for this kind of test, see `ExperimentField`. ``muscle`` is the
   id of the preset that the user has chosen (may be left out).
2. *For stored measurements and presets.* ``POST /api/experiments`` takes the body of a diagnosis
   (``DiagnosisRequest``) and answers the same per measurement, with what the request says included: call it
   again after each change of muscle, drive or value. ``problem`` holds a conflict, or a missing value.
3. *In comparisons, diagnoses and reports* a request states, additions only:

   - ``measurements: [{"id": ..., "use": "fit", "experiment": {"rest_length": "250 mm", "load": "3 kg"}}]``;
   - ``experiment: {...}`` beside ``measurement`` or ``measurements``: for every measurement that does not say
     it itself;
   - ``accuracy: "length 1 mm, force 0.5 %, pressure 20 mbar"`` for all measurements;
   - ``strict: true``: refuse instead of assuming.

   A value is a text with unit (or an SI number), or ``{"value": "250 mm", "origin": "suggested"}`` for a
   proposal that the user took over. ``muscle.nominal_length`` of the request counts as said by the user,
   unless it is the default of the preset. A file with another rest length (by more than 2 %) is then a
   conflict (422, ``field`` "measurements.0.experiment.rest_length") that ``experiment.rest_length`` decides.
4. *Answers* hold ``experiment`` (fields in which all measurements agree), ``assumptions`` (sentences; they
   also begin ``messages`` and the sentence of the verdict), ``specimens`` (one per measurement, with its own
   ``experiment``) and ``absorbed`` (what the stated accuracy took up).
"""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from mckibben.documents.strict import Strict
from mckibben.server.schemas.common import ErrorDetail

OriginName = Literal["file", "you", "preset", "suggested", "assumed"]


class ExperimentValue(Strict):
    """One value of the experiment, and who says it."""

    value: float | str = Field(description="In SI, or a text.", examples=[0.3])
    unit: str = Field(description='SI unit; "" of a text, "1" of a share.', examples=["m"])
    origin: OriginName = Field(
        description="The file, the user (you), a preset that was chosen, a proposal that the user took over "
        "(suggested), or nobody (assumed)."
    )
    where: str = Field(
        description="Line or cell of the file, option or field, or the preset.", examples=["line 4"]
    )


class ExperimentField(Strict):
    """A field of the experiment, for a form."""

    field: str = Field(
        description="Name: the key of 'experiment' in a request. 'accuracy_length' and the like are parts "
        "of its 'accuracy'.",
        examples=["rest_length"],
    )
    title: str = Field(description="In words.", examples=["Rest length"])
    value: float | str | None = Field(description="In SI, or a text; null = nobody said it.", examples=[0.3])
    unit: str = Field(description='SI unit; "" of a text.', examples=["m"])
    units: list[str] = Field(description="Units for a form.", examples=[["mm", "m"]])
    origin: OriginName | None = Field(description="Who says it; null with value.")
    where: str = Field(description="Place in the file, or the preset.", examples=["line 4"])
    required: bool = Field(description="This kind of test needs it.")
    unanswered: bool = Field(
        description="Required, and neither the file nor the user says it: ask before the first diagnosis. "
        "With origin 'assumed' a diagnosis goes on with the value; with value null it does not."
    )
    question: str = Field(description="The question of the field.", examples=["How long is the muscle?"])
    why: str = Field(description="What it is needed for.")
    proposed: float | str | None = Field(description="A value that the data suggest, SI; never used unasked.")
    least: float | None = Field(description="Smallest allowed value, SI.")
    most: float | None = Field(description="Largest allowed value, SI.")
    choices: list[str] = Field(description="Allowed texts, or proposals of texts; empty = any.")
    closed: bool = Field(description="Only the choices are allowed.")
    example: str = Field(examples=["250 mm"], description="A valid value, as a text.")
    option: str = Field(description="What says it on the command line.", examples=['--rest-length "250 mm"'])


class StatedExperiment(Strict):
    """The experiment of one measurement of a request."""

    id: str = Field(description="Id as in the request.")
    name: str = Field(description="Name of the file or preset.")
    kind: str = Field(description="Measurement kind.")
    experiment: list[ExperimentField] = Field(description="Its fields.")


class ExperimentAnswer(Strict):
    """What is said about the experiment of each measurement, and what is open."""

    measurements: list[StatedExperiment] = Field(description="One entry per measurement of the request.")
    assumptions: list[str] = Field(
        description="What a diagnosis would assume, in the words with which it begins."
    )
    problem: ErrorDetail | None = Field(
        description="A conflict, or a missing value without which the diagnosis is refused."
    )


class Absorbed(Strict):
    """What the accuracy of the measurement took up instead of the model: an error of a clamp or a sensor."""

    channel: str = Field(examples=["length"], description="The channel.")
    of: str = Field(description="What it belongs to.", examples=["clamped at 251.2 mm"])
    value: float = Field(description="Estimated error of the reading, SI.")
    stderr: float = Field(description="Its standard error, SI.")
    accuracy: float = Field(description="Stated or assumed standard deviation, SI.")
    unit: str = Field(examples=["m"], description="SI unit of value, stderr and accuracy.")
    rms: float = Field(description="What it changes of the predicted channel, SI.")


class Specimen(Strict):
    """One measurement of several."""

    file: str = Field(description="Name of the file or preset.")
    rows_used: int = Field(description="Number of rows used.")
    rmse: float | None = Field(description="Error of the model on it; of the best model in a diagnosis.")
    holdout_rmse: float | None = Field(description="The same with whole groups left out of the fit.")
    left_out_rmse: float | None = Field(
        default=None,
        description="Of a diagnosis of several: error of the model fitted to the other specimens alone.",
    )
    left_out_percent: float | None = Field(
        default=None, description="The same in percent of the largest magnitude measured on it."
    )
    experiment: dict[str, ExperimentValue] = Field(
        description="Values of its experiment, each with its origin."
    )
