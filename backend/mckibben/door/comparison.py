"""A comparison of a model with measurements, and its fitted model."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Generic

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.compare.series import rows_of
from mckibben.door.frames import frame_of
from mckibben.door.problem import reported
from mckibben.door.profile import Profile
from mckibben.door.result import ModelT, ResultOf
from mckibben.identification.fit.comparison import Comparison as ComparedModel
from mckibben.identification.fit.profile import profile
from mckibben.report.summary import Summary
from mckibben.report.summary.comparison import summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Comparison(ResultOf[ComparisonResult], ComparisonResult, Generic[ModelT]):
    """The error of a model on measurements, from `Model.compare`; SI."""

    model: ModelT  # type: ignore - its document is in to_dict()
    """The compared model; after a fit with the fitted numbers and the range it was measured in."""
    _compared: ComparedModel

    @reported
    def profile(self, name: str, *, share: float = 0.95) -> Profile:
        """Profile likelihood of a fitted constant: an interval that need not be symmetric, or has one end.

        At each value all other constants are fitted again; correlated noise is allowed for.

        Args:
            name: as "effect.parameter", "dahl.force", or a geometry field that was freed.
            share: of the interval.

        Raises:
            Problem: no fit was requested, or the constant was not fitted (with the nearest match).
        """
        return Profile.of(profile(self._compared, name, share=share), _name=self._name)

    def to_frame(self) -> pd.DataFrame:
        """All compared rows, SI: channel, group, (time,) pressure, length, contraction, velocity, measured,
        predicted, residual (measured minus predicted). NaN where not known.
        """
        return frame_of(rows_of(self._compared))

    def plot(self) -> Figure:
        """Measured points and the model, and the residual below them."""
        from mckibben.door.figures import comparison_figure

        return comparison_figure(self._result, f"{self._name}: measured and predicted {self.predicted}")

    def _summary(self) -> Summary:
        return summary_of(self._result)

    def _title(self) -> str:
        return f"Comparison with {self._name}: {self.nrmse_percent:.3g} % rms error"

    def _lead(self) -> Sequence[str]:
        return (*self.assumptions, *(run.sentence for run in self.stopped))
