"""A comparison of a model with measurements, and its fitted model."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Generic

from mckibben.application.compare.compare import Compared, ComparisonResult
from mckibben.application.compare.series import rows_of
from mckibben.door.frames import frame_of
from mckibben.door.result import ModelT, Result
from mckibben.identification.fit.comparison import Correlation, ParameterValue
from mckibben.identification.predict.predictor import StoppedRun
from mckibben.report.summary import Summary
from mckibben.report.summary.comparison import summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure

#: Effect id -> parameter -> value with its standard error; "geometry" holds what belongs to no effect.
Parameters = Mapping[str, Mapping[str, ParameterValue]]


def parameters_of(table: Mapping[str, Mapping[str, ParameterValue]]) -> Parameters:
    """The table, read-only."""
    return MappingProxyType({name: MappingProxyType(dict(values)) for name, values in table.items()})


class Comparison(Result, Generic[ModelT]):
    """The error of a model on measurements, from `Model.compare`; SI."""

    __slots__ = ("_compared", "_model", "_name")

    _compared: Compared
    _model: ModelT
    _name: str

    def __init__(self, compared: Compared, model: ModelT, name: str) -> None:
        self._set(_compared=compared, _model=model, _name=name)

    @property
    def _result(self) -> ComparisonResult:
        return self._compared.result

    @property
    def rmse(self) -> float:
        """Root mean square of measured minus predicted, in `unit`."""
        return self._result.rmse

    @property
    def nrmse_percent(self) -> float:
        """`rmse` over the largest measured magnitude [%]."""
        return self._result.nrmse_percent

    @property
    def holdout_rmse(self) -> float | None:
        """`rmse` on groups that the fit did not see; None with one group."""
        return self._result.holdout_rmse

    @property
    def noise_floor(self) -> float | None:
        """Standard deviation of the noise of the data; None where it cannot be estimated."""
        return self._result.noise_floor

    @property
    def residual_mean(self) -> float:
        """Mean of measured minus predicted."""
        return self._result.residual_mean

    @property
    def unit(self) -> str:
        """SI unit of the errors; "1" = multiples of the noise, with several predicted channels."""
        return self._result.unit

    @property
    def kind(self) -> str:
        """Kind of the measurement."""
        return self._result.kind

    @property
    def predicted(self) -> str:
        """The predicted channel, or several."""
        return self._result.predicted

    @property
    def rows(self) -> int:
        """Number of rows of the measurements."""
        return self._result.rows

    @property
    def rows_used(self) -> int:
        """Number of compared rows."""
        return self._result.rows_used

    @property
    def excluded(self) -> Mapping[str, int]:
        """Reason -> number of rows that are not compared."""
        return MappingProxyType(self._result.excluded)

    @property
    def parameters(self) -> Parameters:
        """Effect -> parameter -> value, standard error, whether it is at its bound."""
        return parameters_of(self._result.parameters)

    @property
    def correlations(self) -> Sequence[Correlation]:
        """Pairs of fitted parameters that are strongly correlated."""
        return tuple(self._result.correlations)

    @property
    def stopped(self) -> Sequence[StoppedRun]:
        """Runs of the model that ended early; all figures are of the rows that they reached."""
        return tuple(self._result.stopped)

    @property
    def sentences(self) -> Sequence[str]:
        """Runs that stopped, where the model fails, and whether the rest is noise."""
        return tuple(self._result.sentences)

    @property
    def messages(self) -> Sequence[str]:
        """What was assumed, left out or noticed."""
        return tuple(self._result.messages)

    @property
    def model(self) -> ModelT:
        """The compared model; after a fit with the fitted numbers and the range it was measured in."""
        return self._model

    def to_frame(self) -> pd.DataFrame:
        """All compared rows, SI: channel, group, (time,) pressure, length, contraction, velocity, measured,
        predicted, residual (measured minus predicted). NaN where not known.
        """
        return frame_of(rows_of(self._compared.comparison))

    def plot(self) -> Figure:
        """Measured points and the model, and the residual below them."""
        from mckibben.door.figures.statics import comparison_figure

        return comparison_figure(self._result, f"{self._name}: measured and predicted {self.predicted}")

    def _answer(self) -> object:
        return self._result

    def _summary(self) -> Summary:
        return summary_of(self._result)

    def _title(self) -> str:
        return f"Comparison with {self._name}: {self.nrmse_percent:.3g} % rms error"

    def _lead(self) -> Sequence[str]:
        return (*self._result.assumptions, *(run.sentence for run in self._result.stopped))
