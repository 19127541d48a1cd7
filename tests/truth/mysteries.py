"""Eight cases as data sets to practise on: a story, the start model, the readings, and the sealed answer.

``python -m tests.truth.mysteries FOLDER`` writes ``<id>.json`` for each into the folder. The seal is base64
of JSON: enough that nobody reads the answer by accident.
"""

from __future__ import annotations

import base64
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tests.truth.cases import Case
from tests.truth.generate import case
from tests.truth.muscle import ATMOSPHERE, Array
from tests.truth.stories import MYSTERIES, Mystery
from tests.truth.tables import STYLES, Style

MOST_ROWS = 1500
#: channel -> unit of the data set, its size in SI, and decimals: a tenth of the noise or finer.
UNITS = {
    "time": ("s", 1.0, 4),
    "pressure": ("bar", 1e5, 4),
    "length": ("mm", 1e-3, 3),
    "displacement": ("mm", 1e-3, 3),
    "force": ("N", 1.0, 2),
    "command": ("1", 1.0, 4),
}
#: The right answer where no catalogue has the effect: a term of one's own.
TERM = "custom"
_SOURCE = "computed by an independent model"
_WIDTH = 100


def document(mystery: Mystery) -> dict[str, Any]:
    """The data set of a mystery, numbers of the columns as lists."""
    made = case(mystery.case, mystery.seed)
    columns = columns_of(made)
    rows = len(columns["pressure"])
    step = -(-rows // MOST_ROWS)
    return {
        "schema": 1,
        "kind": "mystery",
        "id": mystery.id,
        "title": mystery.title,
        "maker": "synthetic",
        "description": f"Not a real measurement: {_SOURCE}, with realistic sensor noise.",
        "story": mystery.story,
        "measurement_kind": made.kind,
        "nominal_length": _quantity(made.muscle["nominal_length"]),
        "muscle": made.muscle,
        "effects": made.effects,
        **({"drive": made.drive} if made.drive else {}),
        **_conditions(made),
        "data_columns": {
            name: {"unit": UNITS[name][0], "values": _shown(values[::step], name)}
            for name, values in columns.items()
        },
        "sealed": _seal(mystery, made),
    }


def columns_of(made: Case) -> dict[str, Array]:
    """The readings of a case in SI, by channel; what a style writes as contraction comes back as length."""
    (text,) = made.files.values()
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    style = max(
        STYLES, key=lambda style: sum(name in style.names.values() for name in _cells(lines[0], style))
    )
    channels = {header: channel for channel, header in style.names.items()}
    header = _cells(lines[0], style)
    table = [_cells(line, style) for line in lines[1:]]
    found = {}
    for place, title in enumerate(header):
        if title not in channels:
            continue
        name = channels[title]
        values = np.array([float(row[place].replace(style.decimal, ".")) for row in table])
        values = values / style.factors.get(name, 1.0)
        if name == "pressure" and style.absolute:
            values = values - ATMOSPHERE
        if name == "contraction":
            rest = _number(made.muscle["nominal_length"])[0] * 1e-3
            name, values = "length", rest * (1.0 - values)
        found[name] = values
    return {name: found[name] for name in UNITS if name in found}


def _cells(line: str, style: Style) -> list[str]:
    return line.split(style.separator)


def _shown(values: Array, name: str) -> list[float]:
    _, size, digits = UNITS[name]
    shown = [round(float(value), digits) for value in values / size]
    return [int(value) if value == int(value) else value for value in shown]


def _number(text: str) -> tuple[float, str]:
    value, _, unit = text.partition(" ")
    return float(value), unit


def _quantity(text: str) -> dict[str, Any]:
    value, unit = _number(text)
    return {"value": value, "unit": unit, "source": _SOURCE, "grade": "D"}


def _conditions(made: Case) -> dict[str, Any]:
    (text,) = made.files.values()
    said = dict(line[2:].split(": ", 1) for line in text.splitlines() if line.startswith("# "))
    said.pop("kind", None)
    return {"conditions": {name: _quantity(value) for name, value in said.items()}} if said else {}


def _seal(mystery: Mystery, made: Case) -> str:
    accepted = [sorted(ids) for ids in made.hidden] + ([[TERM]] if made.unknown else [])
    hidden = [
        {"title": title, "what": what, "effects": ids}
        for (title, what), ids in zip(mystery.told, accepted, strict=True)
    ]
    text = json.dumps({"hidden": hidden, "text": mystery.text}, ensure_ascii=False)
    return base64.b64encode(text.encode()).decode()


def text_of(content: dict[str, Any]) -> str:
    """JSON with two spaces, and rows of numbers that fill a line."""
    columns = content["data_columns"]
    marks = {f"@{name}@": _wrapped(column["values"]) for name, column in columns.items()}
    bare = content | {
        "data_columns": {name: column | {"values": f"@{name}@"} for name, column in columns.items()}
    }
    text = json.dumps(bare, indent=2, ensure_ascii=False)
    for mark, rows in marks.items():
        text = text.replace(f'"{mark}"', f"[\n{rows}\n      ]")
    return text + "\n"


def _wrapped(values: Sequence[float]) -> str:
    lines, line = [], " " * 8
    for place, value in enumerate(values):
        cell = f"{value}," if place < len(values) - 1 else f"{value}"
        if len(line) + len(cell) >= _WIDTH:
            lines.append(line.rstrip())
            line = " " * 8
        line += f"{cell} "
    return "\n".join([*lines, line.rstrip()])


def write(folder: Path) -> None:
    """Write every data set."""
    folder.mkdir(parents=True, exist_ok=True)
    for mystery in MYSTERIES:
        (folder / f"{mystery.id}.json").write_text(text_of(document(mystery)), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python -m tests.truth.mysteries FOLDER")
    write(Path(sys.argv[1]))
