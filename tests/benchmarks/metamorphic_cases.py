"""Measurements as files that can be written in another way: made up, of `tests.truth`, and measured ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from mckibben.identification.predict.fit_model import FitModel
from mckibben.measurement.reading import read_measurement
from mckibben.physics.muscle import Muscle
from tests.benchmarks.diagnosis import subject_and_start
from tests.benchmarks.workers import own_studio
from tests.identification.synthetic import MUSCLE, cycles, force_map, length_under
from tests.truth.generate import case

DATA = Path(__file__).parents[3] / "shared" / "data"
#: Unit -> its size in SI.
UNITS = {
    "s": 1.0, "ms": 1e-3, "Pa": 1.0, "bar": 1e5, "kPa": 1e3, "psi": 4.4482216152605 / 0.0254**2, "m": 1.0,
    "mm": 1e-3, "inch": 0.0254, "N": 1.0, "lbf": 4.4482216152605, "1": 1.0,
}  # fmt: skip
#: The usual unit and name of a channel in a file.
USUAL = {
    "time": ("s", "time"), "pressure": ("bar", "pressure"), "length": ("mm", "length"),
    "displacement": ("mm", "displacement"), "force": ("N", "force"), "direction": ("1", "direction"),
    "group": ("1", "group"), "contraction": ("1", "contraction"), "humidity": ("1", "humidity"),
}  # fmt: skip


@dataclass(frozen=True)
class Sheet:
    """One file: its name, its comments, its columns in SI, and how they are written.

    ``rest_length``: of its muscle [m], from which strokes count; ``comma``: decimal commas.
    """

    name: str
    comments: tuple[str, ...]
    columns: Mapping[str, np.ndarray]
    units: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)
    rest_length: float = MUSCLE.nominal_length
    comma: bool = False

    def text(self) -> str:
        """The file with all digits of its numbers."""
        heads, written = [], []
        for channel, values in self.columns.items():
            unit = self.units.get(channel, USUAL[channel][0])
            head = self.names.get(channel, USUAL[channel][1])
            heads.append(head if unit == "1" else f"{head} [{unit}]")
            written.append([repr(float(value) / UNITS[unit]) for value in values])
        mark = ";" if self.comma else ","
        rows = [mark.join(row) for row in zip(*written, strict=True)]
        if self.comma:
            rows = [row.replace(".", ",") for row in rows]
        return "\n".join([*(f"# {line}" for line in self.comments), mark.join(heads), *rows]) + "\n"

    def taking(self, rows: np.ndarray) -> Sheet:
        """Some of the rows, in this order."""
        return replace(self, columns={name: values[rows] for name, values in self.columns.items()})


Sheets = tuple[Sheet, ...]


@dataclass(frozen=True)
class Case:
    """Files of one measurement and the muscle they are said to be of."""

    name: str
    sheets: Sheets
    muscle: Muscle = MUSCLE
    start: FitModel | None = None  # None: the ideal muscle


#: Short ones of `tests.truth`.
OF_TRUTH = (
    "bladder-yeoh-isobaric", "linear-spring-isobaric", "prestress-isometric", "coulomb-isobaric",
    "pressure-zero-isobaric", "effectiveness-isometric", "pair-bladder-prestress-isometric",
)  # fmt: skip


def friction(*, direction: float, **_: float) -> float:
    return 15.0 * direction


def cases() -> list[Case]:
    """Made-up measurements, and measured ones where they are beside the project."""
    found = [friction_case(), map_case(), isotonic_case()]
    found += [truth_case(name) for name in OF_TRUTH]
    found += [case for case in (logger_case(), isometric_case()) if case]
    return found


def truth_case(name: str) -> Case:
    """A case of `tests.truth`, from its file."""
    made = case(name)
    _, start = subject_and_start(made, own_studio())
    sheets = []
    for file, text in made.files.items():
        read = read_measurement(text.encode(), file)
        comments = tuple(line.lstrip("# ") for line in text.splitlines() if line.startswith("#"))
        columns = {channel: np.array(values, float) for channel, values in read.columns.items()}
        if not any(line.startswith("kind") for line in comments):
            comments += (f"kind: {made.kind}",)
        sheets.append(Sheet(file, comments, columns, rest_length=start.muscle.nominal_length))
    return Case(name, tuple(sheets), start.muscle, start)


def friction_case(each: int = 30) -> Case:
    """Isobaric cycles at two speeds, one file per pressure, with a wall and Coulomb friction."""
    sheets = []
    for number, level in enumerate((2e5, 4e5, 6e5)):
        made = cycles(friction, noise=1.0, each=each, second=3.0, c10=0.4e6, levels=(level,), seed=number)
        names = ("time", "pressure", "length", "force", "direction")
        columns = {name: np.array(made.columns[name], float) for name in names}
        sheets.append(Sheet(f"level{number}.csv", ("kind: isobaric",), columns))
    return Case("friction, isobaric", tuple(sheets))


def map_case() -> Case:
    """A force map with a wall; its rows have no time."""
    made = force_map(noise=1.0, c10=0.5e6)
    columns = {name: np.array(made.columns[name], float) for name in ("pressure", "length", "force")}
    columns["group"] = np.array(made.columns["group"], float)
    return Case("wall, map", (Sheet("map.csv", ("kind: static",), columns),))


def isotonic_case() -> Case:
    """A muscle with a prestress under 100 N, its pressure raised and lowered over time."""
    random = np.random.default_rng(11)
    pressure = 1e5 * np.concatenate([np.linspace(1.5, 6.0, 60), np.linspace(6.0, 1.5, 60)])
    length = [length_under(100.0, p, prestress=40.0) for p in pressure]
    columns = {
        "time": 0.05 * np.arange(120.0), "pressure": pressure,
        "length": np.array(length) + random.normal(0.0, 5e-5, 120),
    }  # fmt: skip
    return Case("prestress, isotonic", (Sheet("lift.csv", ("kind: isotonic", "load_force: 100 N"), columns),))


def logger_case() -> Case | None:
    """A muscle of 155 mm that lifts 0.3 kg, as its logger wrote it."""
    path = DATA / "logger_S001P001.TXT"
    if not path.exists():
        return None
    lines = [line.split(",") for line in path.read_text().splitlines()[1:] if line.strip()]
    table = np.array([[float(line[place]) for place in (2, 5, 7)] for line in lines])
    columns = {
        "time": 1e-3 * table[:, 0],
        "pressure": UNITS["psi"] * table[:, 1],
        "displacement": 1e-3 * table[:, 2],
    }
    sheet = Sheet(path.name, ("kind: transient", "load_mass: 0.3 kg"), columns)
    muscle = Muscle(0.155, 0.0118, np.radians(24.0), 0.0015, 0.010)
    return Case("logger, transient", (sheet,), muscle)


def isometric_case() -> Case | None:
    """A clamped muscle of 182 mm, pressure up and down."""
    path = DATA / "isometric_10mm_182.csv"
    if not path.exists():
        return None
    made = read_measurement(path.read_bytes(), path.name)
    columns = {
        name: np.array(made.columns[name], float) for name in ("length", "pressure", "force", "direction")
    }
    muscle = Muscle(0.182, 0.0118, np.radians(24.0), 0.0015, 0.010)
    sheet = Sheet(path.name, ("kind: isometric",), columns, rest_length=muscle.nominal_length)
    return Case("clamped, isometric", (sheet,), muscle)
