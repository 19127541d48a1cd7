"""Summary of a diagnosis."""

from __future__ import annotations

from mckibben.application.diagnose.result import DiagnosisResult, PathPoint
from mckibben.report.summary.parts import (
    Summary,
    Table,
    error_unit,
    experiment_tables,
    figure,
    parameter_tables,
    rows_of,
)

_SHOWN = 8  # most candidates listed


def summary_of(result: DiagnosisResult) -> Summary:
    """Assumptions, experiments, the path, the candidates, parameters, the verdict, notices."""
    summary: Summary = [
        *result.assumptions,
        *experiment_tables(result.specimens),
        path_table(result),
        *specimen_tables(result),
        candidate_table(result),
        *parameter_tables(result.parameters),
        result.verdict.sentence,
    ]
    if result.verdict.next_measurement is not None:
        summary.append(f"next: {result.verdict.next_measurement}")
    if result.verdict.proposed_term is not None:
        summary.append(f"proposed term: {result.verdict.proposed_term.formula}")
    summary += result.messages[len(result.assumptions) :]
    reasons: dict[str, list[str]] = {}
    for item in result.not_tried:
        reasons.setdefault(item.why, []).append(item.effect)
    summary += [f"not tried: {', '.join(hidden)} ({why})" for why, hidden in reasons.items()]
    return summary


def path_table(result: DiagnosisResult) -> Table:
    """The error after each addition, and the noise."""
    rows = [
        [
            _step_name(number, step),
            _error(result, step.rmse),
            _error(result, step.holdout_rmse),
        ]
        for number, step in enumerate(result.path)
    ]
    rows.append(["noise floor", _error(result, result.noise_floor.rmse), result.noise_floor.how])
    title = f"Error of the predicted {result.predicted} ({result.kind}, {rows_of(result)})"
    return Table(title, ["after adding", "RMS error", "left-out groups"], rows)


def specimen_tables(result: DiagnosisResult) -> list[Table]:
    """The error of the best model on each of several specimens, also where it was not fitted to it."""
    if not any(each.left_out_rmse is not None for each in result.specimens):
        return []
    rows = [
        [each.file, *(_error(result, value) for value in (each.rmse, each.holdout_rmse, each.left_out_rmse))]
        for each in result.specimens
    ]
    columns = ["specimen", "RMS error", "left-out groups", "left out itself"]
    return [Table("Error of the best model on each specimen", columns, rows)]


def _step_name(number: int, step: PathPoint) -> str:
    if step.added is None:
        return "start model" if number == 0 else "refitted"
    return f"{step.added} (correction)" if step.correction else step.added


def candidate_table(result: DiagnosisResult) -> Table:
    """The best single additions."""
    return Table(
        "One effect alone",
        ["effect", "RMS error", "gain", "missing with", "indistinguishable from"],
        [
            [
                c.effect,
                _error(result, c.rmse),
                f"{c.gain_percent:.1f} %",
                "" if c.probability is None else f"{100.0 * c.probability:.0f} %",
                ", ".join(c.twins),
            ]
            for c in result.candidates[:_SHOWN]
        ],
    )


def _error(result: DiagnosisResult, value: float | None) -> str:
    unit, scale = error_unit(result.unit)
    return figure(None if value is None else value * scale, unit=f" {unit}")
