"""A diagnosis: which physical effect a model is missing, and the model with it."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Generic

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.diagnose.doubts import DoubtfulEntry
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.application.text_file import HTML
from mckibben.documents.studio import Studio
from mckibben.door.comparison import Comparison
from mckibben.door.frames import frame_of_rows
from mckibben.door.profile import Profile
from mckibben.door.result import ModelT, ResultOf
from mckibben.identification.diagnose.verdict import Status
from mckibben.report.summary import Summary
from mckibben.report.summary.diagnosis import summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Diagnosis(ResultOf[DiagnosisResult], DiagnosisResult, Generic[ModelT]):
    """The missing effects of a model with the evidence, from `Model.diagnose`; SI."""

    model: ModelT  # type: ignore - its document is in to_dict()
    """The best model: fitted muscle, effects and constants, of a transient with its drive."""
    _question: ModelQuestion
    _studio: Studio
    _again: Callable[[], Comparison[ModelT]]

    def profile(self, name: str, *, share: float = 0.95) -> Profile:
        """Profile likelihood of a constant of the best model; see `Comparison.profile`.

        Raises:
            Problem: the constant was not fitted, with the nearest match.
        """
        return self._again().profile(name, share=share)

    @property
    def sentence(self) -> str:
        """The verdict in words."""
        return self.verdict.sentence

    @property
    def status(self) -> Status:
        """adequate, missing_effects, ambiguous, unknown_effect, undecided or unfinished; see `verdict`."""
        return self.verdict.status

    @property
    def effects(self) -> Sequence[str]:
        """Ids of the missing effects."""
        return tuple(self.verdict.effects)

    @property
    def probabilities(self) -> Mapping[str, float]:
        """Effect -> probability that it, or one of its group, is missing; a group shares one."""
        return self.verdict.probabilities

    @property
    def indistinguishable(self) -> Sequence[Sequence[str]]:
        """Groups of effects that these data cannot distinguish."""
        return self.verdict.indistinguishable

    @property
    def rmse(self) -> float:
        """Error of the best model, in `unit`."""
        return self.path[-1].rmse

    @property
    def doubts(self) -> Sequence[DoubtfulEntry]:
        """`context`: entries that may be wrong instead (a length, a sign, a unit), the most convincing first;
        answered by ``use`` or ``keep`` of another diagnosis.
        """
        return self.context

    def to_frame(self) -> pd.DataFrame:
        """The candidates, the best first: effect, rmse, holdout_rmse, gain_percent, score_change,
        indistinguishable, probability that it or one of its group is missing.
        """
        names = [
            "effect", "rmse", "holdout_rmse", "gain_percent", "score_change", "indistinguishable",
            "probability",
        ]  # fmt: skip
        rows: list[list[object]] = [
            [
                c.effect, c.rmse, c.holdout_rmse, c.gain_percent, c.score_change, ", ".join(c.twins),
                c.probability,
            ]
            for c in self.candidates
        ]  # fmt: skip
        return frame_of_rows(names, rows)

    def plot(self) -> Figure:
        """The error after each addition, beside the noise."""
        from mckibben.door.figures import diagnosis_figure

        return diagnosis_figure(self._result, f"{self._name}: {self.verdict.title}")

    def _files(self, path: Path) -> str:
        """Also ``.html``: the report of ``mckibben diagnose --report``."""
        if path.suffix.lower() in HTML:
            from mckibben.report.diagnosis.gather import ReportOptions, report_of

            return report_of(self._question, self._studio, ReportOptions(), self._result)
        return super()._files(path)

    def _summary(self) -> Summary:
        return summary_of(self._result)

    def _title(self) -> str:
        return f"Diagnosis of {self._name}: {self.verdict.title}"

    def _lead(self) -> Sequence[str]:
        return (self.sentence,)
