"""Request and answer of ``/api/comparisons``: a model compared with measurements."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from mckibben.documents.drive import DriveDocument
from mckibben.documents.experiment import ExperimentInput
from mckibben.documents.muscle import EffectsInput, MuscleInput
from mckibben.documents.strict import Series, Strict, si_field
from mckibben.server.schemas.common import Flag
from mckibben.server.schemas.curves import MuscleGeometry
from mckibben.server.schemas.experiments import Absorbed, ExperimentValue, Specimen
from mckibben.server.schemas.measurements import UnreadColumn

MeasurementId = Annotated[
    str,
    StringConstraints(pattern=r"^[A-Za-z0-9][A-Za-z0-9./-]{0,63}$"),
    Field(description="SHA-256 id of an uploaded file, or id of a preset measurement or reference curve."),
]
ParameterPath = Annotated[
    str, StringConstraints(pattern=r"^[A-Za-z_][A-Za-z0-9_]*\.[A-Za-z_][A-Za-z0-9_]*$", max_length=128)
]
FreeGeometry = Literal["nominal_length", "braid_diameter", "braid_angle", "wall_thickness", "inside_diameter"]


Hypothesis = Annotated[str, StringConstraints(pattern=r"^[A-Za-z_]+$", max_length=64)]


class UsedMeasurement(Strict):
    """A measurement and its use."""

    id: MeasurementId
    use: Literal["fit", "validation"] = Field("fit", description="Used for the fit, or only for validation.")
    experiment: ExperimentInput | None = Field(
        None, description="What the user says about its experiment; takes precedence over the file."
    )


StatedNoise = float | Annotated[str, Field(min_length=1, max_length=100)]


class ModelRequest(Strict):
    """A model and the measurements it is compared with."""

    muscle: MuscleInput | None = Field(None, description="Null: the drive's.")
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
        default=[], max_length=5, description="Geometry to fit as well, within its tolerance."
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
        return [UsedMeasurement(id=self.measurement, use="fit", experiment=None), *self.measurements]


class ComparisonRequest(ModelRequest):
    """A model, the measurements to compare it with, and whether to fit it."""

    fit: bool = Field(False, description="Fit the effects' parameters to the data.")


EffectsJson = dict[str, dict[str, float | str]]


class FittedParameter(Strict):
    """One parameter as used or fitted."""

    value: float = Field(description="Value in SI.")
    stderr: float | None = Field(description="Standard error; null when not fitted or not determined.")
    unit: str = Field(description="SI unit.")
    at_bound: bool = Field(description="The fit stopped at a bound.")
    fitted: bool = Field(description="Whether the fit could change it.")


class Correlation(Strict):
    """Correlation of two fitted parameters."""

    a: str = Field(description="First parameter, as effect.parameter.")
    b: str = Field(description="Second parameter, as effect.parameter.")
    value: float = Field(ge=-1.0000001, le=1.0000001, description="Coefficient of correlation, -1 to 1.")


class ComparisonSeries(Strict):
    """One curve of the comparison, e.g. all points of one pressure."""

    label: str = Field(examples=["3 bar"], description="Name of the curve.")
    channel: str = Field(description="The predicted channel.", examples=["force"])
    unit: str = Field(description="SI unit of measured, predicted and residual.")
    use: Literal["fit", "validation"] = Field(description="Used for the fit, or only for validation.")
    pressure: float | None = si_field("Pa", "Pressure of the series, when it has one.")
    time: Series | None = si_field("s", "Time of each point.")
    contraction: Series = si_field("1", "Contraction of each point.")
    length: Series = si_field("m", "Length of each point.")
    x_pressure: Series = si_field("Pa", "Pressure of each point.")
    velocity: Series = si_field("m/s", "dL/dt of each point.")
    direction: Series = Field(description="-1 shortening, 1 lengthening, 0 at rest or unknown.")
    measured: Series = Field(description="Measured.")
    predicted: Series = Field(description="Predicted.")
    residual: Series = Field(description="Measured minus predicted.")


class ChannelError(Strict):
    """Error of one of several predicted channels, SI."""

    rmse: float = Field(description="Root mean square of the residual.")
    unit: str = Field(description="SI unit of the figures.")
    noise_floor: float = Field(description="Noise of the channel.")
    full_scale: float = Field(description="The largest measured magnitude.")


class ResidualProfile(Strict):
    """The residual over one variable."""

    over: str = Field(examples=["pressure"], description="The variable.")
    share_explained: float = Field(description="Share of its mean square explained by this variable.")
    worst: str = Field(description="The range with the largest error.", examples=["pressure 5.5 to 6 bar"])
    rmse: float = Field(description="Error in that range.")
    edges: Series = Field(description="Boundaries of the ranges, SI; one more than ranges.")
    mean: Series = Field(description="Mean residual of each range, SI.")
    rms: Series = Field(description="Root mean square of the residual of each range, SI.")
    count: list[int] = Field(description="Number of points of each range.")


class HeatMap(Strict):
    """The residual over two variables; rows are y, null where there are no points."""

    x: str = Field(description="The variable of the columns.")
    y: str = Field(description="The variable of the rows.")
    x_edges: Series = Field(description="Boundaries of the columns, SI; one more than columns.")
    y_edges: Series = Field(description="Boundaries of the rows, SI; one more than rows.")
    mean: list[Series] = Field(description="Mean residual of each cell, SI.")
    rms: list[Series] = Field(description="Root mean square of the residual of each cell, SI.")
    count: list[list[int]] = Field(description="Number of points of each cell.")


class ResidualPart(Strict):
    """A part of the squared residual; the shares of all parts add up to 1."""

    of: str = Field(
        description="'offset', a variable, 'together' (several variables) or 'rest': what follows none."
    )
    share: float = Field(description="0 to 1; each part has only what the ones before it left.")


class WhitenessAnswer(Strict):
    """Whether the residual looks like noise."""

    autocorrelation: Series = Field(
        description="Autocorrelation of the residual at the lags 1, 2, ... within sweeps."
    )
    band: float = Field(description="Half-width of the 95 % band of noise.")
    outside: float = Field(description="Share of the lags outside the band.")
    runs: float = Field(description="Number of runs of one sign over that expected of noise.")
    white: bool = Field(description="Few lags are outside the band, and the number of runs is that of noise.")


class CrossCorrelationAnswer(Strict):
    """Correlation of the residual of a channel with the input of the test."""

    channel: str = Field(description="The predicted channel.")
    input: str = Field(description="Name of the input.")
    lags: list[int] = Field(description="Rows by which the residual comes after the input; negative: before.")
    correlation: Series = Field(description="At each lag, -1 to 1.")
    band: float = Field(description="Half-width of the 95 % band of a residual independent of the input.")
    outside: float = Field(description="Share of the lags outside the band.")


class Loop(Strict):
    """Area of the force residual over a closed path: energy dissipation that the model misses."""

    group: int = Field(description="Number of the sweep or cycle.")
    area: float = si_field("J", "Positive: the model lacks friction.")
    span: float = si_field("m", "Travel between the reversals.")


class ValidationAnswer(Strict):
    """The error of the model on measurements not used for the fit."""

    rmse: float | None = Field(description="Root mean square of the residual.")
    nrmse_percent: float | None = Field(description="RMSE over the largest measured magnitude.")
    rows_used: int = Field(description="Number of compared rows.")
    series: list[ComparisonSeries] = Field(description="The points, curve by curve.")


class StoppedRun(Strict):
    """A run of the model that ended before the last row of its record."""

    of: str = Field(description="Measurement; empty for a single one.")
    run: int = Field(description="Number of the run within it, from 1; 0 for the only one.")
    reached: float | None = si_field("s", "Time of the last row that it reached; null where it never began.")
    duration: float = si_field("s", "Duration of the record.")
    share: float = Field(description="Share of the compared rows that it did not reach.")
    reason: str = Field(description="Why it ended.")


class ComparisonAnswer(Strict):
    """The figures of the model's error, and the points."""

    kind: str = Field(description="Measurement kind.")
    rows: int = Field(description="Number of rows of the measurements.")
    rows_used: int = Field(description="Number of compared rows.")
    predicted: str = Field(description="The predicted channel, or several.", examples=["force"])
    unit: str = Field(
        description='SI unit of the error; "1" = relative to the noise of each channel.', examples=["N"]
    )
    rmse: float | None = Field(description="Root mean square of the residual.")
    nrmse_percent: float | None = Field(description="RMSE over the largest measured magnitude.")
    full_scale: float | None = Field(description="The largest measured magnitude.")
    holdout_rmse: float | None = Field(description="RMSE with whole groups left out of the fit.")
    fitted: int = Field(description="Number of fitted values; with 0 no group was left out of anything.")
    noise_floor: float | None = Field(description="Noise of the data, if it can be estimated.")
    noise_how: str = Field(description="How the noise was estimated.")
    residual_mean: float | None = Field(description="Mean of the residual.")
    channels: dict[str, ChannelError] = Field(description="Error of each channel when there are several.")
    parameters: dict[str, dict[str, FittedParameter]] = Field(description="Effect -> parameter -> value.")
    correlations: list[Correlation] = Field(description="Correlations of the fitted parameters.")
    excluded: dict[str, int] = Field(description="Reason for leaving rows out -> number of rows.")
    where: list[ResidualProfile] = Field(description="The residual over each variable that it may depend on.")
    heat_map: HeatMap | None = Field(
        description="The residual over two variables; null where there are too few points."
    )
    parts: list[ResidualPart] = Field(description="What the squared residual is made of.")
    whiteness: WhitenessAnswer = Field(
        description="Autocorrelation and runs of the residual: does it look like noise?"
    )
    cross: list[CrossCorrelationAnswer] = Field(
        description="Correlation of the residual with the input that drove the test, of rows with times."
    )
    loops: list[Loop] = Field(
        description="Loops of the force residual, with the energy that the model misses."
    )
    sentences: list[str] = Field(description="Where the model fails, as sentences.")
    validation: ValidationAnswer | None = Field(
        description="The error on measurements not used for the fit; null without them."
    )
    messages: list[str] = Field(description="Remarks on the data.")
    geometry: MuscleGeometry = Field(description="Geometry of the muscle, fitted where it was free.")
    series: list[ComparisonSeries] = Field(description="The points, curve by curve.")
    model: dict[str, EffectsJson] = Field(description="Effects and values in the form of a request.")
    flags: list[Flag] = Field(description="Remarks on the muscle.")
    rmse_beyond_accuracy: float | None = Field(
        description="RMSE of what the accuracy of the readings does not explain; a diagnosis counts with it."
    )
    experiment: dict[str, ExperimentValue] = Field(
        description="Values of the experiment in which all measurements agree, each with its origin."
    )
    assumptions: list[str] = Field(
        description="What nobody said and was assumed; the messages begin with it too."
    )
    specimens: list[Specimen] = Field(description="Each measurement, with its own experiment.")
    absorbed: list[Absorbed] = Field(
        description="Errors of readings within the accuracy, which a fit allows for."
    )
    unread: list[UnreadColumn] = Field(description="Columns of the files that nothing is read from, and why.")
    stopped: list[StoppedRun] = Field(
        description="Runs of the model that ended early; all figures are of the rows that they reached."
    )
