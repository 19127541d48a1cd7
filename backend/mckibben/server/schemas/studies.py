"""Answer of ``/api/studies``: the table of all runs, statistics, sensitivities, Pareto front."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, JsonValue

from mckibben.documents.strict import Strict
from mckibben.documents.study import Subject
from mckibben.server.schemas.common import streamed

_IN = "in the unit of the figure"


class StudyEstimate(Strict):
    """A value with its confidence interval."""

    value: float | None = Field(description="The value.")
    low: float | None = Field(description="Lower end; null where the runs do not give one.")
    high: float | None = Field(description="Upper end; null where the runs do not give one.")


class StudyColumnAnswer(Strict):
    """A column of the table."""

    name: str = Field(description="Key in the table: the path of the quantity or figure.")
    kind: Literal["quantity", "figure"] = Field(description="Whether it was varied or watched.")
    unit: str | None = Field(description="SI unit; null for texts and plain numbers.")


class StudyFigureSummary(Strict):
    """A figure over all runs that have it."""

    figure: str = Field(description="Path of the figure.")
    unit: str = Field(description="Its SI unit.")
    count: int = Field(description="Runs that have it.")
    missing: int = Field(description="Runs that lack it.")
    mean: StudyEstimate | None = Field(description=f"Mean, {_IN}.")
    deviation: StudyEstimate | None = Field(description=f"Standard deviation, {_IN}.")
    least: float | None = Field(description=f"Smallest value, {_IN}.")
    most: float | None = Field(description=f"Largest value, {_IN}.")
    percentiles: dict[str, StudyEstimate] = Field(
        description=f"Percent, 1 to 99 -> percentile, {_IN}; its interval holds for any distribution."
    )


class StudyCorrelation(Strict):
    """Spearman's rank correlation of a quantity and a figure."""

    figure: str = Field(description="Path of the figure.")
    quantity: str = Field(description="Name of the quantity.")
    rank_correlation: float | None = Field(description="-1 to 1; null where one of them does not vary.")


class StudyInfluence(Strict):
    """Influence of a quantity on a figure; each error is the half width of a confidence interval."""

    figure: str = Field(description="Path of the figure.")
    quantity: str = Field(description="Name of the quantity.")
    first: float | None = Field(description="Sobol: share of the variance due to the quantity alone.")
    first_error: float | None = Field(description="Its error.")
    total: float | None = Field(description="Sobol: share of the variance with all its interactions.")
    total_error: float | None = Field(description="Its error.")
    mean: float | None = Field(description=f"Morris: mean elementary effect, {_IN}.")
    mean_size: float | None = Field(description=f"Morris: mean magnitude of the effects, {_IN}.")
    mean_size_error: float | None = Field(description="Its error.")
    deviation: float | None = Field(
        description=f"Morris: standard deviation of the effects, {_IN}; large where the influence is not "
        "linear or depends on other quantities."
    )


class StudySensitivity(Strict):
    """Influences on a figure."""

    figure: str = Field(description="Path of the figure.")
    influences: list[StudyInfluence] = Field(description="Of each quantity; empty with too few runs.")
    blocks: int = Field(description="Blocks of runs used; one with a failed run is left out.")
    planned_blocks: int = Field(description="Blocks of runs in the plan.")


class StudyProbability(Strict):
    """Share of the runs that keep a limit; one that failed does not keep it."""

    what: str = Field(description="The figure of the limit, or 'all'.")
    kept: int = Field(description="Runs that keep it.")
    runs: int = Field(description="All runs.")
    probability: StudyEstimate = Field(description="kept / runs, with the interval of Clopper and Pearson.")


class StudyDesign(Strict):
    """A design of a robust study."""

    design: int = Field(description="Its number in the plan.")
    values: dict[str, float | str] = Field(description="Quantity -> value.")
    probabilities: list[StudyProbability] = Field(description="Of each limit, then of all.")


class StudyAnswer(Strict):
    """All runs of a study, and what they show; SI."""

    title: str = Field(description="Title of the study.")
    method: str = Field(description="Name of the method.")
    columns: list[StudyColumnAnswer] = Field(description="Quantities and figures of the table.")
    table: dict[str, list[float | str | None]] = Field(
        description="Column -> values, one for each run that was made; also run, outcome and message. "
        "null where a figure does not exist; the message says why."
    )
    outcomes: dict[str, int] = Field(description="How runs ended -> number of runs.")
    summary: list[StudyFigureSummary] = Field(description="Each figure over all runs.")
    correlations: list[StudyCorrelation] = Field(description="Rank correlations; of random runs alone.")
    sensitivity: list[StudySensitivity] = Field(description="Of the methods sobol and morris.")
    front: list[int] = Field(
        description="Numbers of the runs on the Pareto front; of one goal the best run; empty without goals."
    )
    probabilities: list[StudyProbability] = Field(description="Of keeping the limits; of random runs alone.")
    designs: list[StudyDesign] = Field(description="Of a robust study, the most probable to keep all first.")
    runs: int = Field(description="Runs that were made.")
    planned: int = Field(description="Runs of the plan.")
    kept: int = Field(description="Runs that were kept from before and not made again.")
    goals: list[str] = Field(description="Figures of the goals.")
    confidence: float = Field(description="Confidence level of all intervals.")
    seed: int | None = Field(description="Seed of the random numbers; null without.")
    outcome: Literal["completed", "timed_out", "cancelled"] = Field(description="How the study ended.")
    message: str | None = Field(description="Advice if the study did not complete.")
    remarks: list[str] = Field(description="Runs that failed, figures that are missing.")
    wall_ms: float = Field(description="Computing time in ms.")


class StudyOptionsRequest(Strict):
    """Which subject."""

    subject: Subject = Field(description="What is to be studied.")


class StudyQuantityOption(Strict):
    """A quantity that can be varied."""

    path: str = Field(description="Path in the document of the subject.")
    unit: str = Field(description="SI unit.")
    value: float | None = Field(
        description="Present value in SI; null for a plain gain, whose unit the document does not state."
    )


class StudyFigureOption(Strict):
    """A figure that can be watched."""

    path: str = Field(description="Path of the figure.")
    unit: str = Field(description="SI unit.")


class StudyOptionsAnswer(Strict):
    """What a study of a subject can vary and watch."""

    kind: Literal["drive", "task"] = Field(description="What the subject is.")
    quantities: list[StudyQuantityOption] = Field(description="Quantities, in the order of the document.")
    figures: list[StudyFigureOption] = Field(description="Figures.")
    document: dict[str, JsonValue] = Field(
        description="The document of the subject with the effects of its presets stated."
    )
    parquet: bool = Field(description="Whether the server can write tables as Parquet.")


class StudyKeptAnswer(Strict):
    """What is kept of a study."""

    runs: int = Field(description="Runs that are kept from before.")


StudyEvents = streamed(
    '{"table": columns of new runs, "planned": runs of the plan, "kept": how many so far are from before} or '
    "absent; runs come as they end"
)
