"""What a diagnosis tells: candidates, path, verdict, and models that can be sent back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mckibben.application.compare import ModelDocument
from mckibben.application.model_question import EffectDocument
from mckibben.application.muscle_summary import GeometrySummary
from mckibben.identification.diagnose.diagnosis import NotTried
from mckibben.identification.diagnose.verdict import Status
from mckibben.identification.fit.comparison import ChannelMisfit, Correlation, ParameterTable, ParameterValue
from mckibben.identification.residual.profiles import Profile

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Baseline:
    """The start model as given: error, in percent of full scale, on groups left out."""

    rmse: float
    nrmse_percent: float | None
    holdout_rmse: float


@dataclass(frozen=True, slots=True)
class NoiseFloor:
    """Below this error there is nothing to learn; None when the data do not tell it; and from what."""

    rmse: float | None
    how: str


@dataclass(frozen=True, slots=True)
class CandidateResult:
    """The start model with one more effect, all numbers refitted.

    Attributes:
        effect, title, equation: id, name and LaTeX of the effect.
        gain_percent: share of the error that it takes away.
        score_change: change of the score; negative is better.
        twins: candidates that these data cannot tell from it.
        why: what speaks for and against it.
        freed: further constants that were freed.
        next_measurement: what would tell it from its first twin.
        model: as a caller gives it.
    """

    JSON_KEYS: ClassVar = {"score_change": ("score_change", "delta_bic")}  # the old name, for one version

    effect: str
    title: str
    rmse: float
    holdout_rmse: float
    gain_percent: float
    score_change: float
    parameters: dict[str, ParameterValue]
    twins: list[str]
    why: str
    equation: str
    freed: list[str]
    next_measurement: str | None
    model: ModelDocument


@dataclass(frozen=True, slots=True)
class PathPoint:
    """The error after each addition; the first is the start model as given."""

    added: str | None
    rmse: float
    holdout_rmse: float
    model: ModelDocument
    freed: list[str]


@dataclass(frozen=True, slots=True)
class TermCurve:
    """A proposed term and the residual it is for, over one variable."""

    x: str
    values: Array
    term: Array
    residual: Array


@dataclass(frozen=True, slots=True)
class TermProposal:
    """A formula for what no catalogued effect explains; share: of the residual's mean square."""

    formula: str
    coefficients: dict[str, float]
    share: float
    model: ModelDocument
    curve: TermCurve


@dataclass(frozen=True, slots=True)
class ExperimentProposal:
    """What would separate two effects that look alike; separation: standard deviations of one reading."""

    pair: list[str]
    declared: str
    protocol: str
    separation: float


@dataclass(frozen=True, slots=True)
class Verdict:
    """The answer.

    Attributes:
        status: adequate, missing_effects, ambiguous or unknown_effect; title: the same in words.
        effects: what is missing.
        indistinguishable: groups that these data cannot tell apart.
        unexplained_share, unexplained_in: structure that is left, and in what.
        next_measurement: what to measure next.
        sentence: everything in one to three sentences.
    """

    status: Status
    title: str
    effects: list[str]
    indistinguishable: list[list[str]]
    unexplained_share: float
    unexplained_in: list[str]
    proposed_term: TermProposal | None
    next_measurement: str | None
    experiments: list[ExperimentProposal]
    sentence: str


@dataclass(frozen=True, slots=True)
class DiagnosedModel:
    """The model a diagnosis ends with, as a caller gives it."""

    muscle: dict[str, float]
    effects: EffectDocument


@dataclass(frozen=True, slots=True)
class DiagnosisResult:
    """What a model is missing, and how sure that is; SI.

    Attributes:
        kind, predicted, unit: as of a comparison.
        rows, rows_used, excluded: of the data, those that count, why not the others -> how many.
        where: the start model's residual over each variable.
        candidates: single additions, the best first.
        path: the best model, in the order of adding that lowers the error fastest.
        parameters, correlations, geometry, model, freed: of the best model.
        not_tried: effects that were no candidates, with the reason.
        messages: what has to be said.
    """

    rows: int
    rows_used: int
    excluded: dict[str, int]
    kind: str
    predicted: str
    unit: str
    baseline: Baseline
    noise_floor: NoiseFloor
    channels: dict[str, ChannelMisfit]
    where: list[Profile]
    candidates: list[CandidateResult]
    path: list[PathPoint]
    verdict: Verdict
    parameters: ParameterTable
    correlations: list[Correlation]
    geometry: GeometrySummary
    model: DiagnosedModel
    freed: list[str]
    not_tried: list[NotTried]
    messages: list[str]
