"""Summary of a study: figures, limits, influences, the best runs."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.application.study.study import StudyColumn, StudyResult
from mckibben.facts.study import INFLUENCE, STUDY, SUMMARY, WATCHED
from mckibben.facts.units import Scale
from mckibben.report.figures import pretty
from mckibben.report.summary import Summary, Table, figure
from mckibben.studies.statistics import Estimate, FigureSummary, Probability

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
    shares = ("5", "50", "95")
    heads = [
        "figure", "unit", SUMMARY["count"].words, SUMMARY["mean"].words,
        f"± ({_level(result)})",
        *(SUMMARY[name].words for name in ("deviation", "least")),
        *(f"{share} %" for share in shares), SUMMARY["most"].words,
    ]  # fmt: skip
    rows = [_figure_row(item, shares) for item in result.summary]
    made = (
        f"{result.runs} runs" if result.runs == result.planned else f"{result.runs} of {result.planned} runs"
    )
    return Table(f"{name}: {result.method.replace('_', ' ')}, {made}", heads, rows)


def _level(result: StudyResult) -> str:
    return f"{100.0 * result.confidence:.4g} %"


def _figure_row(item: FigureSummary, shares: Sequence[str]) -> list[str]:
    each = WATCHED[item.figure]
    scale, difference = each.scale, each.scale._replace(offset=0.0)
    return [
        each.label, pretty(scale.unit), str(item.count), _value_of(item.mean, scale),
        _half_width(item.mean, difference), _value_of(item.deviation, difference), _shown(item.least, scale),
        *(_value_of(item.percentiles.get(percent), scale) for percent in shares), _shown(item.most, scale),
    ]  # fmt: skip


def _shown(value: float | None, scale: Scale, digits: int = 4) -> str:
    return figure(None if value is None else scale.of(value), digits)


def _value_of(estimate: Estimate | None, scale: Scale) -> str:
    return _shown(None if estimate is None else estimate.value, scale)


def _half_width(estimate: Estimate | None, scale: Scale) -> str:
    if estimate is None or estimate.low is None or estimate.high is None:
        return "–"
    return _shown(0.5 * (estimate.high - estimate.low), scale, 2)


def _label(path: str) -> str:
    """A watched figure in words; a quantity, and "all", as they are called in the study."""
    return WATCHED[path].label if path in WATCHED else path


def _percent(item: Probability) -> str:
    ends = item.probability
    interval = ""
    if ends.low is not None and ends.high is not None:
        interval = f" ({figure(ends.low * 100.0, 3)} … {figure(ends.high * 100.0, 3)})"
    return f"{figure(ends.value * 100.0, 3)} %{interval}"


def _probability_table(result: StudyResult) -> list[Table]:
    rows = [
        [_label(item.what), _percent(item), f"{item.kept} of {item.runs}"] for item in result.probabilities
    ]
    title = STUDY["probability"].label
    return [Table(title, ["limit", "probability", "runs"], rows)] if rows else []


def _design_table(result: StudyResult) -> list[Table]:
    if not result.designs:
        return []
    names = list(result.designs[0].values)
    limits = [_label(item.what) for item in result.designs[0].probabilities]
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
        names: Sequence[str] = ("mean_size", "mean_size_error", "mean", "deviation")
        if item.influences[0].total is not None:
            names = ("total", "total_error", "first", "first_error")
        difference = WATCHED[item.figure].scale._replace(offset=0.0)
        in_unit = names[0] == "mean_size"
        scale = difference if in_unit else INFLUENCE[names[0]].scale
        heads = ["quantity", *(INFLUENCE[name].words for name in names)]
        ordered = sorted(item.influences, key=lambda one: -(getattr(one, names[0]) or 0.0))
        rows = [[one.quantity, *(_shown(getattr(one, name), scale, 3) for name in names)] for one in ordered]
        unit = f" ({pretty(scale.unit)})" if scale.unit else ""
        title = f"Influences on {_label(item.figure)}{unit}, ± at {_level(result)} confidence"
        tables.append(Table(title, heads, rows))
    return tables


def _correlation_table(result: StudyResult) -> list[Table]:
    if not result.correlations:
        return []
    rows = [
        [item.quantity, _label(item.figure), figure(item.rank_correlation, 3)] for item in result.correlations
    ]
    each = INFLUENCE["rank_correlation"]
    return [Table(f"{each.label}s", ["quantity", "figure", each.words], rows[: 2 * _ROWS])]


def _front_table(result: StudyResult) -> list[Table]:
    if not result.front:
        return []
    place = {run: index for index, run in enumerate(result.table["run"])}
    shown = result.front[:: max(1, -(-len(result.front) // _ROWS))]
    rows = [
        [str(run), *(_cell(column, result.table[column.name][place[run]]) for column in result.columns)]
        for run in shown
    ]
    label = STUDY["front"].label
    title = "Best run" if len(result.front) == 1 else f"{label}: {len(rows)} of its {len(result.front)} runs"
    return [Table(title, ["run", *map(_head, result.columns)], rows)]


def _head(column: StudyColumn) -> str:
    """A figure with its unit; a quantity by its path, in SI."""
    unit = WATCHED[column.name].scale.unit if column.name in WATCHED else column.unit or ""
    return f"{_label(column.name)} ({pretty(unit)})" if unit not in ("", "1") else _label(column.name)


def _cell(column: StudyColumn, value: object) -> str:
    if column.name in WATCHED and isinstance(value, float | int):
        return _shown(value, WATCHED[column.name].scale)
    return _value(value)
