"""``mckibben compare``: a model beside measurements."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.application.comparisons import comparison_answer
from mckibben.application.start import Json
from mckibben.cli.data import points_of
from mckibben.cli.options import asked_of
from mckibben.cli.output import figure, remark, rows_of, write_json, write_table
from mckibben.documents.studio import Studio


def run(
    studio: Studio,
    *,
    files: Sequence[str],
    muscle: str,
    ideal: bool,
    effects: Sequence[str],
    drive: str,
    fit: bool,
    free: Sequence[str],
    as_json: bool,
) -> None:
    """Print the comparison.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    points = points_of(files, studio)
    question = asked_of(studio, points, muscle=muscle, ideal=ideal, effects=effects, drive=drive, free=free)
    answer = comparison_answer(question, fit=fit)
    if as_json:
        write_json(answer)
        return
    _write_tables(answer)
    for message in (*answer["messages"], *(flag["message"] for flag in answer["flags"])):
        remark(message)


def _write_tables(answer: Json) -> None:
    unit, scale = ("mm", 1e3) if answer["unit"] == "m" else (answer["unit"].replace("1", "x noise"), 1.0)

    def shown(name: str) -> str:
        value = answer[name]
        return figure(None if value is None else value * scale, unit=f" {unit}")

    write_table(
        f"Predicted {answer['predicted']} ({answer['kind']}, {rows_of(answer)})",
        ["", "value"],
        [
            ["RMS error", shown("rmse")],
            ["RMS error of the largest value", figure(answer["nrmse_percent"], 3, " %")],
            ["RMS error with whole groups left out", shown("holdout_rmse")],
            ["mean error", shown("residual_mean")],
            ["noise floor", shown("noise_floor")],
        ],
    )
    for words in answer["sentences"]:
        remark(words)
    rows = [
        [
            f"{effect}.{name}",
            figure(item["value"], 5),
            figure(item["stderr"], 2) if item["fitted"] else "given",
            item["unit"],
            "at its bound" if item["at_bound"] else "",
        ]
        for effect, own in answer["parameters"].items()
        for name, item in own.items()
    ]
    if rows:
        write_table("Parameters", ["parameter", "value", "± standard error", "unit", ""], rows)
    for pair in answer["correlations"]:
        names = f"{pair['a']} and {pair['b']}"
        remark(f"{names} are correlated ({pair['value']:.3f}): the data hardly tell them apart")
