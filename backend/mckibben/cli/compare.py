"""``mckibben compare``: a model beside measurements."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mckibben.api.answers.comparisons import comparison_answer
from mckibben.api.answers.measured import Points, find_preset, joined
from mckibben.api.answers.start import Json
from mckibben.cli.options import start_model
from mckibben.cli.output import figure, remark, write_json, write_table
from mckibben.identification.read import read_measurement
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import GEOMETRY
from mckibben.studio import Studio

_MAX_BYTES = 200_000_000


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
    for name in free:
        if name not in GEOMETRY:
            raise InputError(f"--free {name}: there is no such geometry", hint=did_you_mean(name, GEOMETRY))
    points = joined([_read(name, studio) for name in files])
    named = str(points.measurement.conditions.get("muscle", ""))
    start = start_model(studio, muscle, ideal=ideal, effects=effects, drive=drive, named=named)
    answer = comparison_answer(studio, start, points, fit=fit, free=free)
    if as_json:
        write_json(answer)
        return
    _write_tables(answer)
    for message in (*answer["messages"], *(flag["message"] for flag in answer["flags"])):
        remark(message)


def _read(name: str, studio: Studio) -> Points:
    """A file, or a preset measurement or curve when there is no such file."""
    path = Path(name)
    try:
        if not path.exists():
            preset = find_preset(name, studio.library)
            if preset is not None:
                return preset
            raise InputError(f"{name}: there is no such file", hint=_near_file(path))
        if path.is_dir():
            raise InputError(f"{name}: is a folder", hint=f"name a file in it, e.g. {path / '*.csv'}")
        if path.stat().st_size > _MAX_BYTES:
            raise InputError(f"{name}: is larger than {_MAX_BYTES // 1_000_000} MB", hint="split the file")
        return Points(read_measurement(path.read_bytes(), path.name))
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"{name[:200]!r}: cannot be read: {reason}", hint="name a readable file") from error


def _near_file(path: Path) -> str | None:
    folder = path.parent
    if not folder.is_dir():
        return f"there is no folder {folder}"
    names = [entry.name for entry in folder.iterdir() if entry.suffix == path.suffix]
    return did_you_mean(path.name, names)


def _write_tables(answer: Json) -> None:
    unit, scale = ("mm", 1e3) if answer["unit"] == "m" else (answer["unit"], 1.0)

    def shown(name: str) -> str:
        value = answer[name]
        return figure(None if value is None else value * scale, unit=f" {unit}")

    used = f"{answer['rows_used']} of {answer['rows']} rows"
    reasons = "".join(f", {count} left out: {reason}" for reason, count in answer["excluded"].items())
    write_table(
        f"Predicted {answer['predicted']} ({answer['kind']}, {used}{reasons})",
        ["", "value"],
        [
            ["RMS error", shown("rmse")],
            ["RMS error of the largest value", figure(answer["nrmse_percent"], 3, " %")],
            ["RMS error with whole groups left out", shown("holdout_rmse")],
            ["mean error", shown("residual_mean")],
            ["noise floor", shown("noise_floor")],
        ],
    )
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
