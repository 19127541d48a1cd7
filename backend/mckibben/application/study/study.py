"""Studies: many runs of a drive or a task, as a table with statistics, sensitivities, Pareto front."""

from __future__ import annotations

import hashlib
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal, Protocol

import numpy as np
import orjson

from mckibben.application.muscle_summary import curve_fit_notices
from mckibben.application.study.subject import StudySubject, evaluator, subject_of
from mckibben.application.study.variables import goals_of, limits_of, plan_of, variables_of
from mckibben.documents.studio import Studio
from mckibben.documents.study import MOST_RUNS, StudyDocument
from mckibben.documents.study_fields import StudyField
from mckibben.facts.result import result_class
from mckibben.facts.study import STUDY
from mckibben.physics.errors import fields_inside
from mckibben.simulation.outcome import Outcome, OutcomeName, Watch
from mckibben.studies.drive_runs import figures_named
from mckibben.studies.optimise import FigureGoal, FigureLimit, front
from mckibben.studies.plan import Plan, RobustPlan
from mckibben.studies.run import Workers, in_threads, run_plan
from mckibben.studies.sensitivity import MorrisPlan, Sensitivity, SobolPlan
from mckibben.studies.statistics import (
    FigureCorrelation,
    FigureSummary,
    Probability,
    correlations,
    probabilities,
    probability,
    summaries,
)
from mckibben.studies.table import Evaluate, Figure, Row, StudyTable
from mckibben.studies.variable import Variable
from mckibben.version import __version__

Array = np.ndarray
_ENDED = {
    Outcome.TIMED_OUT: "The study took too long and was stopped. Ask for fewer runs or use the command line.",
    Outcome.CANCELLED: "The study was cancelled; the results are those of the runs made before.",
}
_SHOWN_FAILURES = 3


@dataclass(frozen=True)
class StudyQuestion:
    """A study, ready to run.

    Attributes:
        document: as given by the caller.
        subject: what is studied.
        variables, fields: the varied quantities, and their fields in the document of the subject.
        figures, goals, limits: in SI.
        plan: the runs.
        studio: presets and effects.
    """

    document: StudyDocument
    subject: StudySubject
    variables: tuple[Variable, ...]
    fields: tuple[StudyField, ...]
    figures: tuple[Figure, ...]
    goals: tuple[FigureGoal, ...]
    limits: tuple[FigureLimit, ...]
    plan: Plan
    studio: Studio

    @property
    def fingerprint(self) -> str:
        """Of everything that the rows depend on; title, confidence and further fields do not change it."""
        return fingerprint_of(self.document, self.subject)

    def document_of(self, run: Sequence[float]) -> dict[str, object]:
        """The document of the subject with the values of a run."""
        return self.subject.with_point(self.variables, self.fields, run)


@result_class
class StudyColumn:
    """A column of the table: "quantity" or "figure", its SI unit; None for texts and plain numbers."""

    name: str
    """Key in the table: the path of the quantity or figure."""
    kind: Literal["quantity", "figure"]
    """Whether it was varied or watched."""
    unit: str | None
    """SI unit; None for texts and plain numbers."""


@result_class
class RobustDesign:
    """A design of a robust study: values of its quantities, and the probability of keeping each limit."""

    design: int
    """Its number in the plan."""
    values: dict[str, float | str]
    """Quantity -> value."""
    probabilities: list[Probability]
    """Of each limit, then of all."""


@result_class
class StudyResult:
    """All runs of a study, and what they show; SI."""

    FIGURES: ClassVar = STUDY.name

    title: str
    """Title of the study."""
    method: str
    """Name of the method."""
    columns: list[StudyColumn]
    """Quantities and figures of the table."""
    table: dict[str, list[float | str | None]]
    """Column -> values, one for each run that was made; also run, outcome and message. None where a figure
    does not exist; the message says why.
    """
    outcomes: dict[str, int]
    """How runs ended -> number of runs."""
    summary: list[FigureSummary]
    """Each figure over all runs that have it."""
    correlations: list[FigureCorrelation]
    """Rank correlations; of random runs alone."""
    sensitivity: list[Sensitivity]
    """Of the methods sobol and morris."""
    front: list[int]
    probabilities: list[Probability]
    """Of keeping the limits; of random runs alone with intervals."""
    designs: list[RobustDesign]
    """Of a robust study, the most probable to keep all first."""
    runs: int
    planned: int
    kept: int
    goals: list[str]
    """Figures of the goals."""
    confidence: float
    seed: int | None
    outcome: OutcomeName
    """"completed", or how the study ended early."""
    message: str | None
    """Advice if the study did not complete."""
    remarks: list[str]
    """Runs that failed, figures that are missing."""
    wall_ms: float
    """Computing time in ms."""


def study_question(document: StudyDocument, studio: Studio, most_runs: int = MOST_RUNS) -> StudyQuestion:
    """The question of a study document.

    Raises:
        InputError: names the field of the study, what is wrong and what would be right.
    """
    subject = subject_of(document.subject, studio)
    variables, fields = _varied(document, subject, studio)
    figures = figures_named(document.figure_paths(), dict(subject.figures))
    limits = limits_of(document, figures)
    plan = plan_of(document, variables, figures, most_runs)
    return StudyQuestion(
        document, subject, variables, fields, figures, goals_of(document), limits, plan, studio
    )


def fingerprint_of(document: StudyDocument, subject: StudySubject) -> str:
    """Of everything that the rows depend on, without the plan; see `StudyQuestion.fingerprint`."""
    whole = document.model_dump(mode="json", by_alias=True, exclude={"title", "confidence", "subject"})
    content = {"study": whole, "subject": subject.content, "version": __version__}
    return hashlib.sha256(orjson.dumps(content, option=orjson.OPT_SORT_KEYS)).hexdigest()


def evaluator_of(document: StudyDocument, studio: Studio) -> Evaluate:
    """The function that runs points of a study, without the plan of all its points.

    Raises:
        InputError: as `study_question`.
    """
    subject = subject_of(document.subject, studio)
    variables, fields = _varied(document, subject, studio)
    return evaluator(subject, variables, fields, document.figure_paths(), studio)


def _varied(
    document: StudyDocument, subject: StudySubject, studio: Studio
) -> tuple[tuple[Variable, ...], tuple[StudyField, ...]]:
    """The varied quantities and their fields; of a robust study those of the design first."""
    fields = []
    for place, quantity in enumerate(document.quantities):
        with fields_inside(f"quantities.{place}.path"):
            fields.append(subject.field(quantity.path, studio))
    varied = list(zip(variables_of(document, fields), fields, strict=True))
    if document.method.type == "robust":
        varied.sort(key=lambda item: item[0].tolerance)
    return tuple(variable for variable, _ in varied), tuple(field for _, field in varied)


class Kept(Protocol):
    """Rows of a study that outlive the process."""

    @property
    def known(self) -> Mapping[int, Row]:
        """Rows by the number of their run."""
        ...

    def add_rows(self, runs: Sequence[int], rows: Sequence[Row]) -> None:
        """Keep rows of finished runs."""
        ...

    def close(self) -> None:
        """No further rows come."""
        ...


def prepare(
    question: StudyQuestion,
    *,
    workers: Workers | None = None,
    journal: Callable[[], Kept] | None = None,
    chunk: int | None = None,
) -> Callable[[Watch], StudyResult]:
    """The study, ready to start. Rows go to ``watch.found`` as they come, those made before first.

    Args:
        question: the study.
        workers: who makes the runs; by default threads of this process.
        journal: opens what keeps the rows; those that it holds are not made again.
        chunk: number of runs that a worker gets at a time.
    """
    paths = [figure.path for figure in question.figures]

    def work(watch: Watch) -> StudyResult:
        began = time.perf_counter()
        makers = workers or in_threads(
            evaluator(question.subject, question.variables, question.fields, paths, question.studio)
        )
        kept, recalled = None if journal is None else journal(), 0

        def tell(runs: Sequence[int], points: Array, rows: Sequence[Row]) -> None:
            if watch.found is not None:
                part = StudyTable.of(
                    question.variables,
                    question.figures,
                    dict(zip(runs, points, strict=True)),
                    dict(zip(runs, rows, strict=True)),
                )
                watch.found({"table": part.columns(), "planned": question.plan.runs, "kept": recalled})

        def finished(runs: Sequence[int], points: Array, rows: Sequence[Row]) -> None:
            if kept is not None:
                kept.add_rows(runs, rows)
            tell(runs, points, rows)

        def recall(runs: Sequence[int], points: Array, rows: Sequence[Row]) -> None:
            nonlocal recalled
            recalled += len(runs)
            tell(runs, points, rows)

        try:
            table, outcome = run_plan(
                question.plan,
                question.figures,
                makers,
                watch,
                known=None if kept is None else kept.known,
                finished=finished,
                recalled=recall,
                chunk=chunk or question.subject.chunk,
            )
        finally:
            if kept is not None:
                kept.close()
        return _result(question, table, outcome, recalled, (time.perf_counter() - began) * 1e3)

    return work


def _result(
    question: StudyQuestion, table: StudyTable, outcome: Outcome, kept: int, wall_ms: float
) -> StudyResult:
    document, plan, method = question.document, question.plan, question.document.method
    level, complete = document.confidence, outcome is Outcome.COMPLETED
    independent = method.type == "monte_carlo"
    random = independent or method.type == "latin_hypercube"
    sensitivity: list[Sensitivity] = []
    blocks = 0
    if complete and isinstance(plan, SobolPlan | MorrisPlan):
        sensitivity, blocks = plan.sensitivity(table, level), plan.blocks
    designs = _designs(question, plan, table) if complete and isinstance(plan, RobustPlan) else []
    best = front(table, question.goals, question.limits) if question.goals else np.zeros(0, np.int64)
    if len(question.goals) == 1:
        best = best[:1]
    return StudyResult(
        title=document.title,
        method=method.type,
        columns=[
            *(StudyColumn(item.name, "quantity", item.unit) for item in question.variables),
            *(StudyColumn(item.path, "figure", item.unit) for item in question.figures),
        ],
        table=table.columns(),
        outcomes=dict(Counter(table.outcomes)),
        summary=summaries(table, level, independent),
        correlations=correlations(table) if random else [],
        sensitivity=sensitivity,
        front=table.runs[best].tolist(),
        probabilities=probabilities(table, question.limits, level, independent) if random else [],
        designs=designs,
        runs=len(table.runs),
        planned=plan.runs,
        kept=kept,
        goals=[goal.figure for goal in question.goals],
        confidence=level,
        seed=getattr(method, "seed", None),
        outcome=outcome.label,
        message=_ENDED.get(outcome),
        remarks=[
            *(str(notice) for notice in curve_fit_notices(question.subject.content.get("curve_fit", ""))),
            *_remarks(table, sensitivity, blocks),
        ],
        wall_ms=wall_ms,
    )


def _designs(question: StudyQuestion, plan: RobustPlan, table: StudyTable) -> list[RobustDesign]:
    """The designs, the most probable to keep all limits first."""
    level, shape = question.document.confidence, (len(plan.designs), plan.specimens)
    each = {limit.figure: limit.kept(table.figure(limit.figure)).reshape(shape) for limit in question.limits}
    every = np.all(list(each.values()), axis=0)
    found = [
        RobustDesign(
            number,
            {v.name: v.shown(x) for v, x in zip(plan.variables, design.tolist(), strict=False)},
            [
                *(probability(name, kept[number], level) for name, kept in each.items()),
                probability("all", every[number], level),
            ],
        )
        for number, design in enumerate(plan.designs)
    ]
    return sorted(found, key=lambda item: -item.probabilities[-1].kept)


def _remarks(table: StudyTable, sensitivity: Sequence[Sensitivity], planned: int) -> list[str]:
    """Runs without figures, and what they do to the results."""
    remarks = []
    failures = Counter(
        (outcome, message) for outcome, message in zip(table.outcomes, table.messages, strict=True) if message
    )
    for (outcome, message), count in failures.most_common(_SHOWN_FAILURES):
        remarks.append(f"{count} of {len(table.runs)} runs {outcome}: {message}")
    if len(failures) > _SHOWN_FAILURES:
        remarks.append(f"{len(failures) - _SHOWN_FAILURES} further messages are in the table")
    for item in sensitivity:
        if item.blocks < planned:
            remarks.append(
                f"{item.figure}: {planned - item.blocks} of {planned} blocks of runs "
                "are left out of the indices because a run has no such figure; they may be biased"
            )
        if not item.influences:
            remarks.append(f"{item.figure}: no indices: it does not vary, or too few runs have it")
    return remarks
