"""How well data determine a fitted constant: its profile likelihood."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mckibben.door.frames import frame_of
from mckibben.door.result import ResultOf
from mckibben.identification.fit.profile import Profile as ProfileResult
from mckibben.report.summary import Summary
from mckibben.report.summary.profile import sentence_of, summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Profile(ResultOf[ProfileResult], ProfileResult):
    """The profile likelihood of a constant, from `Comparison.profile`; SI. Arrays are read-only."""

    @property
    def sentence(self) -> str:
        """The interval in words."""
        return sentence_of(self._result, "" if self.unit == "1" else f" {self.unit}")

    def to_frame(self) -> pd.DataFrame:
        """One row for each value that was tried: value, deviance, rmse."""
        return frame_of({"value": self.value, "deviance": self.deviance, "rmse": self.rmse})

    def plot(self) -> Figure:
        """The deviance over the constant, and the limit of the interval."""
        from mckibben.door.figures import profile_figure

        return profile_figure(self._result)

    def _summary(self) -> Summary:
        return summary_of(self._result)

    def _title(self) -> str:
        return f"Profile of {self.name}"

    def _lead(self) -> Sequence[str]:
        return (self.sentence,)
