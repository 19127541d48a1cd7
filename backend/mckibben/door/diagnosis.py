"""A diagnosis: which physical effect a model is missing, and the model with it."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Generic

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.diagnose.doubts import DoubtfulEntry
from mckibben.application.diagnose.result import (
    Baseline,
    CandidateResult,
    DiagnosisResult,
    NoiseFloor,
    PathPoint,
    Verdict,
)
from mckibben.documents.studio import Studio
from mckibben.door.comparison import Parameters, parameters_of
from mckibben.door.frames import frame_of_rows
from mckibben.door.result import ModelT, Result
from mckibben.report.summary import Summary
from mckibben.report.summary.diagnosis import summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Diagnosis(Result, Generic[ModelT]):
    """The missing effects of a model with the evidence, from `Model.diagnose`; SI."""

    __slots__ = ("_model", "_name", "_question", "_result", "_studio")

    _result: DiagnosisResult
    _model: ModelT
    _name: str
    _question: ModelQuestion
    _studio: Studio

    def __init__(
        self, result: DiagnosisResult, model: ModelT, name: str, question: ModelQuestion, of: Studio
    ) -> None:
        self._set(_result=result, _model=model, _name=name, _question=question, _studio=of)

    @property
    def sentence(self) -> str:
        """The verdict in words."""
        return self._result.verdict.sentence

    @property
    def status(self) -> str:
        """adequate, missing_effects, ambiguous, unknown_effect or unfinished."""
        return self._result.verdict.status

    @property
    def effects(self) -> Sequence[str]:
        """Ids of the missing effects."""
        return tuple(self._result.verdict.effects)

    @property
    def probabilities(self) -> Mapping[str, float]:
        """Effect id -> probability that it is missing, 0 to 1; effects that the data cannot distinguish share
        theirs.
        """
        return MappingProxyType(dict(self._result.verdict.probabilities))

    @property
    def indistinguishable(self) -> Sequence[Sequence[str]]:
        """Groups of effects that these data cannot distinguish."""
        return tuple(tuple(group) for group in self._result.verdict.indistinguishable)

    @property
    def verdict(self) -> Verdict:
        """The whole verdict: also the unexplained share, a proposed term, the next measurement."""
        return self._result.verdict

    @property
    def baseline(self) -> Baseline:
        """Error of the start model as given."""
        return self._result.baseline

    @property
    def noise_floor(self) -> NoiseFloor:
        """Noise of the data, and how it was obtained."""
        return self._result.noise_floor

    @property
    def path(self) -> Sequence[PathPoint]:
        """The error after each addition; the first is the start model."""
        return tuple(self._result.path)

    @property
    def rmse(self) -> float:
        """Error of the best model, in `unit`."""
        return self._result.path[-1].rmse

    @property
    def unit(self) -> str:
        """SI unit of the errors; "1" = multiples of the noise, with several predicted channels."""
        return self._result.unit

    @property
    def candidates(self) -> Sequence[CandidateResult]:
        """Each effect added alone, the best first."""
        return tuple(self._result.candidates)

    @property
    def parameters(self) -> Parameters:
        """Parameters of the best model: effect -> parameter -> value, standard error."""
        return parameters_of(self._result.parameters)

    @property
    def doubts(self) -> Sequence[DoubtfulEntry]:
        """Entries that may be wrong instead (a length, a sign, a unit), the most convincing first; answered
        by ``use`` or ``keep`` of another diagnosis.
        """
        return tuple(self._result.context)

    @property
    def messages(self) -> Sequence[str]:
        """What was assumed, left out or noticed."""
        return tuple(self._result.messages)

    @property
    def model(self) -> ModelT:
        """The best model: fitted muscle, effects and constants, of a transient with its drive."""
        return self._model

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
            for c in self._result.candidates
        ]  # fmt: skip
        return frame_of_rows(names, rows)

    def plot(self) -> Figure:
        """The error after each addition, beside the noise."""
        from mckibben.door.figures.others import diagnosis_figure

        return diagnosis_figure(self._result, f"{self._name}: {self._result.verdict.title}")

    def _files(self, path: Path) -> str:
        """Also ``.html``: the report of ``mckibben diagnose --report``."""
        if path.suffix.lower() in (".html", ".htm"):
            from mckibben.report.diagnosis.gather import ReportOptions, report_of

            return report_of(self._question, self._studio, ReportOptions(), self._result)
        return super()._files(path)

    def _answer(self) -> object:
        return self._result

    def _summary(self) -> Summary:
        return summary_of(self._result)

    def _title(self) -> str:
        return f"Diagnosis of {self._name}: {self._result.verdict.title}"

    def _lead(self) -> Sequence[str]:
        return (self.sentence,)
