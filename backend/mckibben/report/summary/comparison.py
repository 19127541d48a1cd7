"""Summary of a comparison."""

from __future__ import annotations

from mckibben.application.compare.compare import ComparisonResult
from mckibben.facts.comparison import CHECK, COMPARISON, WINDOWS, error_scale
from mckibben.report.summary import (
    Summary,
    Table,
    experiment_table,
    in_unit,
    parameter_tables,
    rows_of,
)

#: Figures that every comparison shows, a dash where one does not exist.
_ALWAYS = (
    "rmse_beyond_accuracy", "rmse", "nrmse_percent", "holdout_rmse", "residual_mean", "noise_floor",
    "over_noise", "fit_percent",
)  # fmt: skip


def summary_of(result: ComparisonResult) -> Summary:
    """Assumptions, experiments, the error, where the model fails, parameters, notices."""
    return [
        *result.assumptions,
        *(experiment_table(each.file, each.experiment) for each in result.specimens),
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
    unit = error_scale(result.unit)
    of_stroke = [] if result.stroke_percent is None else ["stroke_percent"]
    rows = [
        [figure.label, in_unit(getattr(result, name), figure.scale if figure.unit else unit)]
        for name, figure in COMPARISON.items()
        if name in (*_ALWAYS, *of_stroke)
    ]
    windows = result.windows
    if windows is not None:
        of = f", {windows.count} of {windows.length:.3g} s"
        rows += [
            [f"{WINDOWS[name].label}{of if name == 'rmse' else ''}", in_unit(getattr(windows, name), unit)]
            for name in ("rmse", "perfect")
        ]
    if result.validation is not None:
        rows.append([CHECK["rmse"].label, in_unit(result.validation.rmse, unit)])
    return Table(f"Predicted {result.predicted} ({result.kind}, {rows_of(result)})", ["", "value"], rows)
