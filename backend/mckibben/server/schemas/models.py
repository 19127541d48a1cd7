"""Requests about a model and its measurements, and the experiment behind them.

1. *Before a file is stored.* ``POST /api/measurements/preview?name=...&muscle=DMSP-20`` answers
   ``experiment``: every field that matters for this kind of test, see `FormField`. ``muscle`` is the
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

from typing import Annotated, Any, Literal

from pydantic import Field, StringConstraints

from mckibben.application.compare.residual_map import Over
from mckibben.documents.drive import DriveDocument
from mckibben.documents.experiment import ExperimentInput
from mckibben.documents.muscle import EffectsInput, Muscle
from mckibben.documents.strict import Strict
from mckibben.measurement.preparation import LONGEST, MOST
from mckibben.server.schemas.common import streamed

MeasurementId = Annotated[
    str,
    StringConstraints(pattern=r"^[A-Za-z0-9][A-Za-z0-9./-]{0,63}$"),
    Field(description="SHA-256 id of an uploaded file, or id of a preset measurement or reference curve."),
]
ParameterPath = Annotated[
    str, StringConstraints(pattern=r"^[A-Za-z_][A-Za-z0-9_]*\.[A-Za-z_][A-Za-z0-9_]*$", max_length=128)
]
FreeGeometry = Literal[
    "nominal_length", "braid_diameter", "braid_angle", "wall_thickness", "inside_diameter", "start"
]


Steps = Annotated[
    list[Annotated[str, StringConstraints(min_length=1, max_length=LONGEST)]],
    Field(max_length=MOST, examples=[["range time 2 s to 10 s", "low pass 20 Hz"]]),
]
Hypothesis = Annotated[str, StringConstraints(pattern=r"^[A-Za-z_]+$", max_length=64)]


class UsedMeasurement(Strict):
    """A measurement and its use."""

    id: MeasurementId
    use: Literal["fit", "validation"] = Field("fit", description="Used for the fit, or only for validation.")
    experiment: ExperimentInput | None = Field(
        None, description="What the user says about its experiment; takes precedence over the file."
    )
    prepare: Steps | None = Field(
        None, description="Steps that prepare its data, in their order; null: those of the request."
    )


RangeInput = Annotated[list[float], Field(min_length=2, max_length=2, description="From and to.")]
StatedNoise = float | Annotated[str, Field(min_length=1, max_length=100)]


class ModelRequest(Strict):
    """A model and the measurements it is compared with."""

    muscle: Muscle | None = Field(None, description="Null: the drive's.")
    effects: EffectsInput | None = Field(
        None, description="The effects of the model; null: the drive's, or those of the muscle preset."
    )
    drive: DriveDocument | None = Field(
        None,
        description="Valve, tube, supply and load of transient measurements with a command channel; the "
        "measured command replaces the one stated here.",
    )
    measurement: MeasurementId | None = Field(None, description="One measurement to fit to.")
    measurements: list[UsedMeasurement] = Field(
        default=[],
        max_length=16,
        description="Measurements to fit to or to validate with, instead of 'measurement'.",
    )
    free: list[FreeGeometry] = Field(
        default=[],
        max_length=6,
        description="Geometry to fit as well, within its tolerance; 'start': stroke and speed at the start "
        "of each run under a measured pressure, which a comparison without a fit finds too.",
    )
    freed: list[ParameterPath] = Field(
        default=[], max_length=64, description="Additional parameters to fit, as effect.parameter."
    )
    noise: StatedNoise | None = Field(
        None,
        description="Standard deviation of the predicted channel, when it is known: a number above 0 in SI, "
        "or a text with a unit.",
        examples=["2 N", 2.0],
    )
    experiment: ExperimentInput | None = Field(
        None, description="For every measurement that does not say it in its own 'experiment'."
    )
    accuracy: str | None = Field(
        None,
        min_length=1,
        max_length=200,
        description="Standard deviation of each channel of all measurements (% of the largest value), or "
        "sensors: 'length steel rule'.",
        examples=["length 1 mm, force 0.5 %, pressure 20 mbar"],
    )
    strict: bool = Field(False, description="Refuse instead of assuming what nobody said.")
    prepare: Steps = Field(
        default=[],
        description="Steps that prepare the data of every measurement that states none itself: a range, a "
        "drift, a low pass, another time step, as the command line does.",
    )

    use: list[Hypothesis] = Field(
        default=[],
        max_length=8,
        description="Entries of a diagnosis's 'context' that are wrong as stated: the channel is read in the "
        "other way, a quantity is fitted in diagnoses and fits.",
    )
    keep: list[Hypothesis] = Field(
        default=[], max_length=32, description="Entries of 'context' that are right as stated."
    )

    def chosen(self) -> list[UsedMeasurement]:
        """All measurements, from either field."""
        if self.measurement is None:
            return self.measurements
        single = UsedMeasurement(id=self.measurement, use="fit", experiment=None, prepare=None)
        return [single, *self.measurements]


class ComparisonRequest(ModelRequest):
    """A model, the measurements to compare it with, and whether to fit it."""

    fit: bool = Field(False, description="Fit the effects' parameters to the data.")
    within: dict[Over, RangeInput] = Field(
        default={}, description="Variable -> range (SI) whose rows the answer looks at in 'inside'."
    )
    explain: bool = Field(
        False, description="Also what each effect of the model explains in the range, in 'explains'."
    )
    judge: bool = Field(
        True, description="Also whether what is left is noise, in 'verdict'; takes longer than the rest."
    )
    ties: dict[ParameterPath, ParameterPath] = Field(
        default={},
        max_length=64,
        description="Fitted constant -> the fitted constant whose value it always has, as effect.parameter.",
    )


class DiagnosisRequest(ModelRequest):
    """The start model and the measurements to explain."""


DiagnosisEvents = streamed("a candidate or null")


class HistoryStep(Strict):
    """An earlier model in the user's history."""

    label: str = Field(
        max_length=200, examples=["start model"], description="What the model is called in the report."
    )
    effects: EffectsInput | None = Field(None, description="As in the request.")
    freed: list[ParameterPath] = Field(
        default=[], max_length=64, description="Additional parameters that were fitted, as effect.parameter."
    )
    muscle: Muscle | None = Field(None, description="Null: that of the request.")


class ReportRequest(ComparisonRequest):
    """A comparison request, with further content of the report."""

    history: list[HistoryStep] = Field(default=[], max_length=32, description="Oldest first.")
    title: str = Field("", max_length=200, description="Empty = names of the measurements.")
    diagnose: bool = Field(True, description="Include a diagnosis; takes some seconds.")


ReportAnswer: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "A self-contained HTML file.",
        "content": {"text/html": {"schema": {"type": "string"}}},
    }
}
