"""Request and answer of ``/api/comparisons``: a model beside a measurement."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from mckibben.api.schemas.common import Flag, Series, Strict, si_field
from mckibben.api.schemas.curves import MuscleGeometry
from mckibben.api.schemas.muscle import EffectsInput, MuscleInput

MeasurementId = Annotated[
    str,
    StringConstraints(pattern=r"^[A-Za-z0-9][A-Za-z0-9./-]{0,63}$"),
    Field(description="SHA-256 id of an uploaded file, or id of a preset measurement or reference curve."),
]
FreeGeometry = Literal["nominal_length", "braid_diameter", "braid_angle", "wall_thickness", "inside_diameter"]


class ComparisonRequest(Strict):
    """Which model beside which measurement, and whether to fit it."""

    muscle: MuscleInput
    effects: EffectsInput | None = None
    measurement: MeasurementId
    fit: bool = Field(False, description="Fit the effects' parameters to the data.")
    free: list[FreeGeometry] = Field(
        default=[], max_length=5, description="Geometry that is fitted too, within its tolerance."
    )


class FittedParameter(Strict):
    """One parameter as used or fitted."""

    value: float = Field(description="Value in SI.")
    stderr: float | None = Field(description="Standard error; null when not fitted or not determined.")
    unit: str = Field(description="SI unit.")
    at_bound: bool = Field(description="The fit stopped at a bound.")
    fitted: bool = Field(description="The fit was free to change it.")


class Correlation(Strict):
    """How far two fitted parameters can stand in for each other."""

    a: str
    b: str
    value: float = Field(ge=-1.0000001, le=1.0000001)


class ComparisonSeries(Strict):
    """One curve of the comparison, e.g. all points of one pressure."""

    label: str = Field(examples=["3 bar"])
    pressure: float | None = si_field("Pa", "Pressure of the series, when it has one.")
    contraction: Series = si_field("1", "Contraction of each point.")
    length: Series = si_field("m", "Length of each point.")
    x_pressure: Series = si_field("Pa", "Pressure of each point.")
    measured: Series = Field(description="Measured, in the unit of the answer.")
    predicted: Series = Field(description="Predicted, in the unit of the answer.")
    residual: Series = Field(description="Measured minus predicted.")


class ComparisonAnswer(Strict):
    """The model's error in numbers, and the points."""

    kind: str = Field(description="Measurement kind.")
    rows: int
    rows_used: int
    predicted: str = Field(description="The predicted channel.", examples=["force"])
    unit: str = Field(description="SI unit of the predicted channel.", examples=["N"])
    rmse: float | None = Field(description="Root mean square of the residual.")
    nrmse_percent: float | None = Field(description="RMSE over the largest measured magnitude.")
    full_scale: float | None = Field(description="The largest measured magnitude.")
    holdout_rmse: float | None = Field(description="RMSE with whole groups left out of the fit.")
    noise_floor: float | None = Field(description="Noise of the data, when it can be told.")
    residual_mean: float | None
    parameters: dict[str, dict[str, FittedParameter]] = Field(description="Effect -> parameter -> value.")
    correlations: list[Correlation]
    excluded: dict[str, int] = Field(description="Why rows were left out -> how many.")
    messages: list[str]
    geometry: MuscleGeometry
    series: list[ComparisonSeries]
    flags: list[Flag]
