"""Summary of a study: figures, limits, influences, the best runs."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.application.study.study import StudyResult
from mckibben.report.summary.parts import Summary, Table, figure
from mckibben.studies.statistics import Estimate, Probability

_ROWS = 20  # most rows of a table for people; files and JSON have all


def summary_of(result: StudyResult, name: str) -> Summary:
    """Statistics of the figures, then what the method adds, then remarks.

    Args:
        result: the study.
        name: of the study, where it has no title.
    """
    return [
        _figure_table(result, result.title or name),
        *_probability_table(result),
        *_design_table(result),
        *_influence_tables(result),
        *_correlation_table(result),
        *_front_table(result),
        *notices(result),
    ]


def notices(result: StudyResult) -> list[str]:
    """Why the study ended early, and runs without figures."""
    return [*([] if result.message is None else [result.message]), *result.remarks]


def _figure_table(result: StudyResult, name: str) -> Table:
    heads = ["figure", "unit", "runs", "mean", "±", "deviation", "least", "5 %", "50 %", "95 %", "most"]
    rows = [
        [
            item.figure, item.unit, str(item.count), _value_of(item.mean), _half_width(item.mean),
            _value_of(item.deviation), figure(item.least),
            *(_value_of(item.percentiles.get(percent)) for percent in ("5", "50", "95")), figure(item.most),
        ]
        for item in result.summary
    ]  # fmt: skip
    made = (
        f"{result.runs} runs" if result.runs == result.planned else f"{result.runs} of {result.planned} runs"
    )
    return Table(f"{name}: {result.method.replace('_', ' ')}, {made}", heads, rows)


def _value_of(estimate: Estimate | None) -> str:
    return "–" if estimate is None else figure(estimate.value)


def _half_width(estimate: Estimate | None) -> str:
    if estimate is None or estimate.low is None or estimate.high is None:
        return "–"
    return figure(0.5 * (estimate.high - estimate.low), 2)


def _percent(item: Probability) -> str:
    ends = item.probability
    interval = ""
    if ends.low is not None and ends.high is not None:
        interval = f" ({figure(ends.low * 100.0, 3)} … {figure(ends.high * 100.0, 3)})"
    return f"{figure(ends.value * 100.0, 3)} %{interval}"


def _probability_table(result: StudyResult) -> list[Table]:
    rows = [[item.what, _percent(item), f"{item.kept} of {item.runs}"] for item in result.probabilities]
    return (
        [Table("Probability of keeping the limits", ["limit", "probability", "runs"], rows)] if rows else []
    )


def _design_table(result: StudyResult) -> list[Table]:
    if not result.designs:
        return []
    names = list(result.designs[0].values)
    limits = [item.what for item in result.designs[0].probabilities]
    rows = [
        [str(item.design), *map(_value, item.values.values()), *map(_percent, item.probabilities)]
        for item in result.designs[:_ROWS]
    ]
    return [Table("Designs, the most probable first", ["design", *names, *limits], rows)]


def _value(value: object) -> str:
    return figure(value) if isinstance(value, float | int) else str(value if value is not None else "–")


def _influence_tables(result: StudyResult) -> list[Table]:
    tables = []
    for item in result.sensitivity:
        if not item.influences:
            continue
        if item.influences[0].total is not None:
            heads = ["quantity", "total index", "±", "first order", "±"]
            names: Sequence[str] = ("total", "total_error", "first", "first_error")
        else:
            heads = ["quantity", "mean size", "±", "mean", "deviation"]
            names = ("mean_size", "mean_size_error", "mean", "deviation")
        ordered = sorted(item.influences, key=lambda one: -(getattr(one, names[0]) or 0.0))
        rows = [[one.quantity, *(figure(getattr(one, name), 3) for name in names)] for one in ordered]
        tables.append(Table(f"Influences on {item.figure}", heads, rows))
    return tables


def _correlation_table(result: StudyResult) -> list[Table]:
    if not result.correlations:
        return []
    rows = [[item.quantity, item.figure, figure(item.rank_correlation, 3)] for item in result.correlations]
    return [Table("Rank correlations", ["quantity", "figure", "coefficient"], rows[: 2 * _ROWS])]


def _front_table(result: StudyResult) -> list[Table]:
    if not result.front:
        return []
    names = [column.name for column in result.columns]
    place = {run: index for index, run in enumerate(result.table["run"])}
    shown = result.front[:: max(1, -(-len(result.front) // _ROWS))]
    rows = [[str(run), *(_value(result.table[name][place[run]]) for name in names)] for run in shown]
    title = (
        "Best run" if len(result.front) == 1 else f"Pareto front: {len(rows)} of its {len(result.front)} runs"
    )
    return [Table(title, ["run", *names], rows)]
