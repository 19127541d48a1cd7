"""The answer to an inverse question."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from mckibben.application.curves.inverse import InverseFinding
from mckibben.door.curves import Curves
from mckibben.door.frames import frame_of_rows
from mckibben.door.result import ResultOf
from mckibben.report.summary import Summary
from mckibben.report.summary.inverse import summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Inverse(ResultOf[InverseFinding], InverseFinding):
    """The answer to an inverse question, from `Model.inverse`; SI."""

    details: Mapping[str, float | None] = MappingProxyType({})  # type: ignore
    """Further figures in SI: the length, the contraction and the force, and what friction holds."""
    _curves: Callable[[list[float]], Curves]

    @property
    def messages(self) -> Sequence[str]:
        """Remarks on the answer: why there is none, which limit it crosses."""
        return tuple(notice.message for notice in self.flags)

    def to_frame(self) -> pd.DataFrame:
        """One row: the answer under the name of its question, and its details, SI."""
        cells = {**self.details, self.question: self.value}
        return frame_of_rows(tuple(cells), [list(cells.values())])

    def plot(self) -> Figure:
        """Force over contraction at the pressure of the answer, with the point where it is one."""
        known = {**self.details, self.question: self.value}
        pressure = known.get("stroke_pressure", known.get("pressure"))
        figure: Any = self._curves([] if pressure is None else [pressure]).plot()
        contraction, force = known.get("contraction"), known.get("force")
        if contraction is not None and force is not None:
            figure.add_scatter(x=[100.0 * contraction], y=[force], mode="markers", name=self.question)
        return figure

    def _summary(self) -> Summary:
        return summary_of(self, self._name)

    def _title(self) -> str:
        return f"{self.question} of {self._name}"
