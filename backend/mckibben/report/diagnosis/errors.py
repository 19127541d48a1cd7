"""How large the error of a model is, and where it occurs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from mckibben.application.compare.compare import ComparisonResult
from mckibben.facts.comparison import CHECK, COMPARISON, RESIDUAL, error_scale
from mckibben.facts.figure import Figure
from mckibben.report.diagnosis.map import residual_drawing
from mckibben.report.document import Head, bullets, paragraph, table
from mckibben.report.figures import Scale, figure, percent, variable
from mckibben.report.html import Child, Html, html

_MOST_SENTENCES, _LEAST_SHARE = 3, 0.05  # variables named in sentences: how many, from which share on
_ROUNDING = 1e-7  # share of the error below which a mean is rounding


def error_table(columns: Sequence[tuple[str, ComparisonResult]]) -> Html:
    """Error figures of one or more comparisons side by side."""
    first = columns[0][1]
    unit = error_scale(first.unit)
    answers = [answer for _, answer in columns]

    def row(each: Figure, values: Iterable[float | None], scale: Scale, of: str = "") -> list[Child]:
        return [
            f"{each.label}{of}",
            *(figure(value, each.scale if each.unit else scale, 3) for value in values),
        ]

    def of_all(name: str, of: str = "") -> list[Child]:
        return row(COMPARISON[name], [getattr(answer, name) for answer in answers], unit, of)

    rows = [of_all("rmse_beyond_accuracy"), of_all("rmse"), of_all("nrmse_percent")]
    if any(answer.stroke_percent is not None for answer in answers):
        rows.append(of_all("stroke_percent"))
    rows += [
        of_all("holdout_rmse"),
        row(COMPARISON["residual_mean"], [_mean(answer) for answer in answers], unit),
        of_all("noise_floor", f" ({first.noise_how})"),
        of_all("over_noise"),
        of_all("fit_percent"),
        [COMPARISON["rows_used"].label, *(_rows(answer) for answer in answers)],
        [
            RESIDUAL["white"].label,
            *("yes" if answer.whiteness.white else "no, it has structure" for answer in answers),
        ],
    ]
    for name in first.channels:
        words, scale = variable(name)
        for each in (COMPARISON["rmse"], COMPARISON["stroke_percent"], COMPARISON["noise_floor"]):
            values = [getattr(answer.channels[name], each.name) for answer in answers]
            if any(value is not None for value in values):
                rows.append(row(each, values, scale, f", {words}"))
    checks = [answer.validation for answer in answers]
    if any(checks):
        rows += [
            row(
                each,
                [None if check is None else getattr(check, each.name) for check in checks],
                unit,
            )
            for each in (CHECK["rmse"], CHECK["nrmse_percent"])
        ]
    names = [Head("", False), *(Head(name, number=True) for name, _ in columns)]
    parts: list[Child] = [table(names, rows, caption=f"Error of the predicted {words_of(first.predicted)}.")]
    if first.rows_used < first.rows:
        reasons = "; ".join(f"{number} {reason}" for reason, number in first.excluded.items())
        parts.append(paragraph(f"Rows left out: {reasons}.", note=True))
    return html(parts)


def _mean(answer: ComparisonResult) -> float | None:
    """Mean of the residual; 0 where only the rounding of the computer keeps it from being 0."""
    mean = answer.residual_mean
    return 0.0 if mean is not None and abs(mean) < _ROUNDING * answer.rmse else mean


def _rows(answer: ComparisonResult) -> str:
    used, rows = answer.rows_used, answer.rows
    return str(rows) if used == rows else f"{used} of {rows}"


def words_of(predicted: str) -> str:
    """The predicted channels in words."""
    return " and ".join(variable(name.strip())[0] for name in predicted.split(","))


def where_it_fails(answer: ComparisonResult, first: ComparisonResult) -> Html:
    """The residual over each variable: sentences, a table, and a map over two variables.

    Args:
        answer: the comparison.
        first: the first model of the case, which fixes the colours of the map.
    """
    scale = error_scale(answer.unit)
    rows = [
        [
            variable(profile.over)[0],
            percent(profile.share_explained),
            profile.worst,
            figure(profile.rmse, scale, 3),
        ]
        for profile in answer.where
    ]
    columns = [
        Head("Variable"), Head(RESIDUAL["share_explained"].label, number=True),
        Head("Worst range"), Head(RESIDUAL["rmse"].label, number=True),
    ]  # fmt: skip
    words: list[Child] = [
        html(
            f"{profile.worst}: ", figure(profile.rmse, scale, 3), " rms; this variable alone predicts ",
            percent(profile.share_explained), " of the squared error.",
        )
        for profile in answer.where[:_MOST_SENTENCES]
        if profile.share_explained > _LEAST_SHARE
    ]  # fmt: skip
    parts: list[Child] = [bullets([*words, f"{answer.sentences[-1]}."])]
    drawn = residual_drawing(answer, first)
    if drawn is not None:
        parts.append(drawn)
    if rows:  # below the map: a table may continue on the next page, a map may not
        parts.append(table(columns, rows))
    mean = answer.mean_loop
    if mean is not None:
        parts.append(
            paragraph(
                RESIDUAL["area"].label, " of the residual, mean of ", str(len(answer.loops)), ": ",
                figure(mean.area, RESIDUAL["area"].scale, 3), ", ", RESIDUAL["friction"].words, " ",
                figure(mean.friction, RESIDUAL["friction"].scale, 3),
                ". Positive: the muscle dissipates more than the model.",
            )
        )  # fmt: skip
    return html(parts)
