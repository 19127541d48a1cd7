"""Summary of a comparison."""

from __future__ import annotations

from mckibben.application.compare.compare import ComparisonResult
from mckibben.report.summary.parts import (
    Summary,
    Table,
    error_unit,
    experiment_tables,
    figure,
    parameter_tables,
    rows_of,
)


def summary_of(result: ComparisonResult) -> Summary:
    """Assumptions, experiments, the error, where the model fails, parameters, notices."""
    return [
        *result.assumptions,
        *experiment_tables(result.specimens),
        error_table(result),
        *result.sentences,
        *parameter_tables(result.parameters),
        *(
            f"{pair.a} and {pair.b} are strongly correlated ({pair.value:.3f})"
            for pair in result.correlations
        ),
        *result.messages[len(result.assumptions) :],
        *(notice.message for notice in result.flags),
    ]


def error_table(result: ComparisonResult) -> Table:
    """The error in the unit that it is shown in."""
    unit, scale = error_unit(result.unit)

    def shown(value: float | None) -> str:
        return figure(None if value is None else value * scale, unit=f" {unit}")

    return Table(
        f"Predicted {result.predicted} ({result.kind}, {rows_of(result)})",
        ["", "value"],
        [
            ["RMS error", shown(result.rmse)],
            ["RMS error of the largest value", figure(result.nrmse_percent, 3, " %")],
            ["RMS error with whole groups left out", shown(result.holdout_rmse)],
            ["mean error", shown(result.residual_mean)],
            ["noise floor", shown(result.noise_floor)],
        ],
    )
