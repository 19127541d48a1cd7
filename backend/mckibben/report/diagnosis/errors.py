"""How large the error of a model is, and where it occurs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.application.compare.compare import ComparisonResult
from mckibben.report.diagnosis.map import residual_map
from mckibben.report.diagnosis.units import error_scale
from mckibben.report.document import Head, bullets, paragraph, table
from mckibben.report.figures import Scale, figure, percent, variable
from mckibben.report.html import Child, Html, html

_MOST_SENTENCES, _LEAST_SHARE = 3, 0.05  # variables named in sentences: how many, from which share on
_ROUNDING = 1e-7  # share of the error below which a mean is rounding


def error_table(columns: Sequence[tuple[str, ComparisonResult]]) -> Html:
    """Error figures of one or more comparisons side by side."""
    first = columns[0][1]
    scale = error_scale(first)
    rows: list[list[Child]] = [
        ["RMS error", *(figure(answer.rmse, scale, 3) for _, answer in columns)],
        ["… of the largest measured value", *(_percent(answer.nrmse_percent) for _, answer in columns)],
        [
            "RMS error with whole groups left out of the fit",
            *(figure(answer.holdout_rmse, scale, 3) for _, answer in columns),
        ],
        ["Mean of the residual", *(figure(_mean(answer), scale, 3) for _, answer in columns)],
        [
            f"Noise of the data ({first.noise_how})",
            *(figure(answer.noise_floor, scale, 3) for _, answer in columns),
        ],
        ["Rows used", *(_rows(answer) for _, answer in columns)],
        [
            "Does the residual look like noise?",
            *("yes" if answer.whiteness.white else "no, it has structure" for _, answer in columns),
        ],
    ]
    for name in first.channels:
        words, channel_scale = variable(name)
        rows.append(
            [
                f"RMS error of {words}",
                *(figure(answer.channels[name].rmse, channel_scale, 3) for _, answer in columns),
            ]
        )
        rows.append(
            [
                f"Noise of {words}",
                *(figure(answer.channels[name].noise_floor, channel_scale, 3) for _, answer in columns),
            ]
        )
    if any(answer.validation for _, answer in columns):
        checks = [answer.validation for _, answer in columns]
        rows.append(
            [
                "RMS error on the validation data",
                *(figure(None if check is None else check.rmse, scale, 3) for check in checks),
            ]
        )
        rows.append(
            [
                "… of the largest measured value",
                *(_percent(None if check is None else check.nrmse_percent) for check in checks),
            ]
        )
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


def _percent(value: float | None) -> Html:
    return percent(None if value is None else value / 100.0, 3)


def where_it_fails(answer: ComparisonResult, first: ComparisonResult) -> Html:
    """The residual over each variable: sentences, a table, and a map over two variables.

    Args:
        answer: the comparison.
        first: the first model of the case, which fixes the colours of the map.
    """
    scale = error_scale(answer)
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
        Head("Variable"), Head("Share of the squared error it explains alone", number=True),
        Head("Worst range"), Head("RMS error there", number=True),
    ]  # fmt: skip
    words: list[Child] = [
        html(
            f"{profile.worst}: ", figure(profile.rmse, scale, 3), " rms; this variable alone explains ",
            percent(profile.share_explained), " of the squared error.",
        )
        for profile in answer.where[:_MOST_SENTENCES]
        if profile.share_explained > _LEAST_SHARE
    ]  # fmt: skip
    parts: list[Child] = [bullets([*words, f"{answer.sentences[-1]}."])]
    drawn = residual_map(answer, first)
    if drawn is not None:
        parts.append(drawn)
    if rows:  # below the map: a table may continue on the next page, a map may not
        parts.append(table(columns, rows))
    areas = [loop.area for loop in answer.loops]
    if areas:
        parts.append(
            paragraph(
                "Area of the residual over a closed loop, mean of ", str(len(areas)), " loops: ",
                figure(float(np.mean(areas)), Scale("mJ", 1e-3), 3),
                ". Positive: friction missing in the model dissipates this energy.",
            )
        )  # fmt: skip
    return html(parts)
