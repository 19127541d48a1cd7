"""``mckibben diagnose``: which physical effect a model is missing."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mckibben.application.asked import Asked
from mckibben.application.diagnoses import prepare
from mckibben.application.start import Json
from mckibben.cli.data import points_of
from mckibben.cli.options import asked_of
from mckibben.cli.output import figure, progress, remark, rows_of, write_json, write_table
from mckibben.documents.studio import Studio

_SHOWN = 8  # candidates


def run(
    studio: Studio,
    *,
    files: Sequence[str],
    muscle: str,
    ideal: bool,
    effects: Sequence[str],
    drive: str,
    free: Sequence[str],
    noise: float | None,
    as_json: bool,
    report: Path | None = None,
) -> None:
    """Print the diagnosis, and write it down if asked.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    points = points_of(files, studio)
    question: Asked = asked_of(
        studio, points, muscle=muscle, ideal=ideal, effects=effects, drive=drive, free=free, noise=noise
    )
    work = prepare(question, studio)
    with progress("trying effects") as watch:
        answer = work(watch)
    if report is not None:
        from mckibben.cli.report import write

        write(report, studio, question, answer)
    if as_json:
        write_json(answer)
        return
    _write(answer)


def _write(answer: Json) -> None:
    unit, scale = ("mm", 1e3) if answer["unit"] == "m" else (answer["unit"].replace("1", "x noise"), 1.0)

    def shown(value: float | None) -> str:
        return figure(None if value is None else value * scale, unit=f" {unit}")

    rows = [
        [
            step["added"] or ("start model" if number == 0 else "refitted"),
            shown(step["rmse"]),
            shown(step["holdout_rmse"]),
        ]
        for number, step in enumerate(answer["path"])
    ]
    rows.append(["noise floor", shown(answer["noise_floor"]["rmse"]), answer["noise_floor"]["how"]])
    title = f"Error of the predicted {answer['predicted']} ({answer['kind']}, {rows_of(answer)})"
    write_table(title, ["after adding", "RMS error", "left-out groups"], rows)
    write_table(
        "One effect alone",
        ["effect", "RMS error", "gain", "cannot be told from"],
        [
            [c["effect"], shown(c["rmse"]), f"{c['gain_percent']:.1f} %", ", ".join(c["twins"])]
            for c in answer["candidates"][:_SHOWN]
        ],
    )
    parameters = [
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
    if parameters:
        write_table("Parameters", ["parameter", "value", "± standard error", "unit", ""], parameters)
    verdict = answer["verdict"]
    remark(verdict["sentence"])
    for experiment in verdict["experiments"]:
        first, second = experiment["pair"]
        told = experiment["declared"] or experiment["protocol"]
        remark(f"to tell {first} from {second}: {told}")
    if verdict["proposed_term"]:
        remark(f"proposed term: {verdict['proposed_term']['formula']}")
    for message in answer["messages"]:
        remark(message)
    reasons: dict[str, list[str]] = {}
    for item in answer["not_tried"]:
        reasons.setdefault(item["why"], []).append(item["effect"])
    for why, effects in reasons.items():
        remark(f"not tried: {', '.join(effects)} ({why})")
