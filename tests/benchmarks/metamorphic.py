"""What must not change the answer of a diagnosis, as a table. One command, one run:

    python -m tests.benchmarks.metamorphic [--only TEXT] [--few]

Each case is a measurement; each relation rewrites its files so that they say the same: another origin of
time, other units, names, order. *Exact* relations must give the same status, the same effects with the same
alternatives, and the same error and noise within 1e-3; of half the sampling each effect must be
in one of the groups. ``--few`` lets the diagnosis choose from six effects only.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from mckibben.identification.diagnose.diagnosis import Diagnosis, diagnose
from mckibben.identification.predict import Predictor, predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.measurement.points import Points, joined
from mckibben.measurement.read import read_measurement
from mckibben.physics.muscle import Muscle
from tests.identification.synthetic import CATALOGUE, MUSCLE, cycles, force_map, length_under

DATA = Path(__file__).parents[3] / "shared" / "data"
SAME = 1e-3  # largest relative difference of two errors that are the same
FEW = (
    "bladder_elasticity", "prestress", "force_offset", "length_offset", "coulomb_friction", "viscous_damping",
)  # fmt: skip
#: Unit -> its size in SI.
UNITS = {
    "s": 1.0, "ms": 1e-3, "Pa": 1.0, "bar": 1e5, "kPa": 1e3, "psi": 4.4482216152605 / 0.0254**2, "m": 1.0,
    "mm": 1e-3, "inch": 0.0254, "N": 1.0, "lbf": 4.4482216152605, "1": 1.0,
}  # fmt: skip
#: The usual unit and name of a channel in a file.
USUAL = {
    "time": ("s", "time"), "pressure": ("bar", "pressure"), "length": ("mm", "length"),
    "displacement": ("mm", "displacement"), "force": ("N", "force"), "direction": ("1", "direction"),
    "group": ("1", "group"),
}  # fmt: skip


@dataclass(frozen=True)
class Sheet:
    """One file: its name, its comments, its columns in SI, and how they are written."""

    name: str
    comments: tuple[str, ...]
    columns: Mapping[str, np.ndarray]
    units: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)

    def text(self) -> str:
        """The file with all digits of its numbers."""
        heads, written = [], []
        for channel, values in self.columns.items():
            unit = self.units.get(channel, USUAL[channel][0])
            head = self.names.get(channel, USUAL[channel][1])
            heads.append(head if unit == "1" else f"{head} [{unit}]")
            written.append([repr(float(value) / UNITS[unit]) for value in values])
        rows = [",".join(row) for row in zip(*written, strict=True)]
        return "\n".join([*(f"# {line}" for line in self.comments), ",".join(heads), *rows]) + "\n"

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


@dataclass(frozen=True)
class Relation:
    """Another way of writing the same files; None where it does not apply."""

    name: str
    rewritten: Callable[[Sheets], Sheets | None]
    exact: bool = True


# --- cases


def friction(*, direction: float, **_: float) -> float:
    return 15.0 * direction


def cases() -> list[Case]:
    """Made-up measurements, and measured ones where they are beside the project."""
    found = [friction_case(), map_case(), isotonic_case()]
    found += [case for case in (logger_case(), isometric_case()) if case]
    return found


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
    return Case("clamped, isometric", (Sheet(path.name, ("kind: isometric",), columns),), muscle)


# --- relations


def _with_time(change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Sheets], Sheets | None]:
    def rewritten(sheets: Sheets) -> Sheets | None:
        if not all("time" in sheet.columns for sheet in sheets):
            return None
        return tuple(
            replace(sheet, columns={**sheet.columns, "time": change(sheet.columns["time"])})
            for sheet in sheets
        )

    return rewritten


def _in_units(**units: str) -> Callable[[Sheets], Sheets | None]:
    def rewritten(sheets: Sheets) -> Sheets | None:
        if not any(channel in sheet.columns for sheet in sheets for channel in units):
            return None
        return tuple(replace(sheet, units=units) for sheet in sheets)

    return rewritten


def _renamed(sheets: Sheets) -> Sheets:
    names = {
        "time": "Zeit", "pressure": "Druck", "length": "Länge", "displacement": "Weg", "force": "Kraft",
        "direction": "Richtung",
    }  # fmt: skip
    return tuple(replace(sheet, name=f"Messung-{9 - n}.csv", names=names) for n, sheet in enumerate(sheets))


def _reversed_columns(sheets: Sheets) -> Sheets:
    return tuple(replace(sheet, columns=dict(reversed(sheet.columns.items()))) for sheet in sheets)


def _reversed_files(sheets: Sheets) -> Sheets | None:
    return sheets[::-1] if len(sheets) > 1 else None


def _shuffled(sheets: Sheets) -> Sheets | None:
    if any("time" in sheet.columns or "kind: static" not in sheet.comments for sheet in sheets):
        return None
    random = np.random.default_rng(4)
    return tuple(sheet.taking(random.permutation(len(sheet.columns["force"]))) for sheet in sheets)


def _relabelled(sheets: Sheets) -> Sheets | None:
    if not all("group" in sheet.columns for sheet in sheets):
        return None
    return tuple(
        replace(sheet, columns={**sheet.columns, "group": 70.0 - 7.0 * sheet.columns["group"]})
        for sheet in sheets
    )


def _repeated(sheets: Sheets) -> Sheets:
    return tuple(sheet.taking(np.repeat(np.arange(_rows(sheet)), 2)) for sheet in sheets)


def _halved(sheets: Sheets) -> Sheets:
    return tuple(sheet.taking(np.arange(0, _rows(sheet), 2)) for sheet in sheets)


def _rows(sheet: Sheet) -> int:
    return len(next(iter(sheet.columns.values())))


RELATIONS = (
    Relation("time + 6.92 s", _with_time(lambda time: np.round(time + 6.92, 9))),
    Relation("time + 1e6 s", _with_time(lambda time: time + 1e6)),
    Relation("time in ms", _in_units(time="ms")),
    Relation("psi", _in_units(pressure="psi")),
    Relation("kPa, inch, lbf", _in_units(pressure="kPa", length="inch", displacement="inch", force="lbf")),
    Relation("m, Pa", _in_units(pressure="Pa", length="m", displacement="m")),
    Relation("other names", _renamed),
    Relation("columns reversed", _reversed_columns),
    Relation("files reversed", _reversed_files),
    Relation("rows shuffled", _shuffled),
    Relation("groups relabelled", _relabelled),
    Relation("rows repeated", _repeated),
    Relation("half the sampling", _halved, exact=False),
)


# --- answers


def predictor_for(sheets: Sheets, muscle: Muscle) -> Predictor:
    """The data of a diagnosis, read from the text of the files."""
    files = [Points(read_measurement(sheet.text().encode(), sheet.name)) for sheet in sheets]
    return predictor_of(joined(files).measurement, muscle)


def answer_of(sheets: Sheets, muscle: Muscle, catalogue: Mapping[str, Any]) -> Diagnosis:
    """The diagnosis of files from the ideal muscle."""
    return diagnose(predictor_for(sheets, muscle), FitModel(muscle), catalogue=catalogue)


def groups_of(found: Diagnosis) -> set[frozenset[str]]:
    """Each missing effect with those that could replace it."""
    return {
        frozenset({name, *(other.effect for other in found.alternatives if other.of == name)})
        for name in found.added
    }


def difference(relation: Relation, before: Diagnosis, after: Diagnosis) -> str:
    """What a relation changed; empty where nothing that matters."""
    if not relation.exact:
        for group in groups_of(after):
            if not any(group & other for other in groups_of(before)):
                return f"effects {_shown(after)} instead of {_shown(before)}"
        return ""
    if (before.status, before.added) != (after.status, after.added) or groups_of(before) != groups_of(after):
        return f"{after.status} {_shown(after)} instead of {before.status} {_shown(before)}"
    for what, first, second in (
        ("error", before.best.rmse, after.best.rmse),
        ("noise", before.noise, after.noise),
    ):
        if first is None or second is None:
            if first is not second:
                return f"{what} {second} instead of {first}"
        elif abs(second - first) > SAME * first:
            return f"{what} {second:.6g} instead of {first:.6g}"
    return ""


def _shown(found: Diagnosis) -> str:
    return " + ".join("|".join(sorted(group)) for group in groups_of(found)) or "none"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code is the number of exact relations that do not hold."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--only", default="", help="part of the name of a case")
    parser.add_argument("--relation", default="", help="part of the name of a relation")
    parser.add_argument("--few", action="store_true", help="six effects instead of the catalogue")
    given = parser.parse_args(arguments)
    catalogue = {name: CATALOGUE[name] for name in FEW} if given.few else CATALOGUE
    failed = 0
    for case in (case for case in cases() if given.only in case.name):
        before = answer_of(case.sheets, case.muscle, catalogue)
        say(f"{case.name}: {before.status}, {_shown(before)}, error {before.best.rmse:.4g}")
        for relation in RELATIONS:
            sheets = relation.rewritten(case.sheets)
            if sheets is None or given.relation not in relation.name:
                continue
            changed = difference(relation, before, answer_of(sheets, case.muscle, catalogue))
            failed += bool(changed) and relation.exact
            say(f"  {'--' if changed else 'ok'} {relation.name:20} {changed}")
    say(f"{failed} exact relations do not hold")
    return failed


def say(text: str) -> None:
    """One line, at once."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
