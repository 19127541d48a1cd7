"""Summary of a diagnosis."""

from __future__ import annotations

from mckibben.application.diagnose.result import DiagnosisResult, PathPoint
from mckibben.facts.comparison import CHECK, NOISE, SPECIMEN, error_scale
from mckibben.facts.diagnosis import DIAGNOSIS
from mckibben.facts.units import probability_text
from mckibben.report.summary import (
    Summary,
    Table,
    experiment_table,
    in_unit,
    parameter_tables,
    rows_of,
)

_SHOWN = 8  # most candidates listed
_OF_SPECIMENS = ("rmse", "holdout_rmse", "left_out_rmse")


def summary_of(result: DiagnosisResult) -> Summary:
    """Assumptions, experiments, the path, the candidates, parameters, the verdict, notices."""
    summary: Summary = [
        *result.assumptions,
        *(experiment_table(each.file, each.experiment) for each in result.specimens),
        path_table(result),
        *specimen_tables(result),
        candidate_table(result),
        *parameter_tables(result.parameters),
        result.verdict.sentence,
    ]
    if result.windows is not None:
        summary.append(result.windows.sentence)
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
    rows.append([NOISE["rmse"].words, _error(result, result.noise_floor.rmse), result.noise_floor.how])
    if result.validation is not None:
        rows.append([CHECK["rmse"].words, _error(result, result.validation.rmse), ""])
    title = f"Error of the predicted {result.predicted} ({result.kind}, {rows_of(result)})"
    return Table(title, ["after adding", DIAGNOSIS["rmse"].label, DIAGNOSIS["holdout_rmse"].label], rows)


def specimen_tables(result: DiagnosisResult) -> list[Table]:
    """The error of the best model on each of several specimens, also where it was not fitted to it."""
    if not any(each.left_out_rmse is not None for each in result.specimens):
        return []
    rows = [
        [each.file, *(_error(result, getattr(each, name)) for name in _OF_SPECIMENS)]
        for each in result.specimens
    ]
    return [Table(SPECIMEN.title, ["specimen", *(SPECIMEN[name].label for name in _OF_SPECIMENS)], rows)]


def _step_name(number: int, step: PathPoint) -> str:
    if step.added is None:
        return "start model" if number == 0 else "refitted"
    return f"{step.added} (correction)" if step.correction else step.added


def candidate_table(result: DiagnosisResult) -> Table:
    """The best single additions."""
    return Table(
        "One effect alone",
        [
            "effect",
            *(DIAGNOSIS[name].label for name in ("rmse", "gain_percent", "probability")),
            "indistinguishable from",
        ],
        [
            [
                c.effect,
                _error(result, c.rmse),
                f"{c.gain_percent:.1f} {DIAGNOSIS['gain_percent'].scale.unit}",
                "" if c.probability is None else probability_text(c.probability),
                ", ".join(c.twins),
            ]
            for c in result.candidates[:_SHOWN]
        ],
    )


def _error(result: DiagnosisResult, value: float | None) -> str:
    return in_unit(value, error_scale(result.unit))
