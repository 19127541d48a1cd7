"""What must not change the answer of a diagnosis, as a table. One command, one run:

    python -m tests.benchmarks.metamorphic [--only TEXT] [--relation TEXT] [--few] [--long] [--keep FILE]

Each case is a measurement; each relation rewrites its files so that they say the same: another origin of
time, other units, names, order. *Exact* relations must give the same status, the same effects with the same
alternatives, the same error and noise within 1e-3 and the same probabilities within 0.02; of half the
sampling each effect must be in one of the groups. ``--few`` lets the diagnosis choose from six effects only.

On 26 November 2026: 11 cases with 11 to 16 exact relations each that apply to them, 165 in all: every one
holds. Half the sampling: 10 of 11; of the clamped muscle, a threshold takes the place of the effectiveness.
Three shifts and units of time of the logger hold as well.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from mckibben.identification.diagnose.diagnosis import Diagnosis, diagnose
from mckibben.identification.predict import Predictor, predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.measurement.points import Points, joined
from mckibben.measurement.reading import read_measurement
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle
from tests.benchmarks.metamorphic_cases import Sheet, Sheets, cases
from tests.benchmarks.workers import add_keep, examined
from tests.identification.synthetic import CATALOGUE

SAME = 1e-3  # largest relative difference of two errors that are the same
SAME_PROBABILITY = 0.02  # largest difference of two probabilities that are the same
FEW = (
    "bladder_elasticity", "prestress", "force_offset", "length_offset", "coulomb_friction", "viscous_damping",
)  # fmt: skip


@dataclass(frozen=True)
class Relation:
    """Another way of writing the same files; None where it does not apply.

    ``reversed_catalogue``: the effects are given in the reverse order.
    """

    name: str
    rewritten: Callable[[Sheets], Sheets | None]
    exact: bool = True
    reversed_catalogue: bool = False


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


def _as_stroke(sheets: Sheets) -> Sheets | None:
    """The shortening in place of the length."""
    if not all("length" in sheet.columns for sheet in sheets):
        return None
    changed = []
    for sheet in sheets:
        columns = {("displacement" if name == "length" else name): v for name, v in sheet.columns.items()}
        columns["displacement"] = sheet.rest_length - columns["displacement"]
        changed.append(replace(sheet, columns=columns))
    return tuple(changed)


def _absolute(sheets: Sheets) -> Sheets:
    return tuple(
        replace(
            sheet,
            columns={**sheet.columns, "pressure": sheet.columns["pressure"] + 101_325.0},
            names={"pressure": "absolute pressure"},
        )
        for sheet in sheets
    )


def _with_humidity(sheets: Sheets) -> Sheets:
    random = np.random.default_rng(5)
    return tuple(
        replace(
            sheet, columns={**sheet.columns, "humidity": np.round(random.uniform(40, 50, _rows(sheet)), 1)}
        )
        for sheet in sheets
    )


def _disordered(sheets: Sheets) -> Sheets | None:
    """Rows whose time says the history, in no order."""
    if not all("time" in sheet.columns for sheet in sheets):
        return None
    random = np.random.default_rng(6)
    return tuple(sheet.taking(random.permutation(_rows(sheet))) for sheet in sheets)


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
#: Further ones, beside the whole catalogue only.
MORE = (
    Relation("stroke for length", _as_stroke),
    Relation("absolute pressure", _absolute),
    Relation("decimal commas", lambda sheets: tuple(replace(sheet, comma=True) for sheet in sheets)),
    Relation("a column more", _with_humidity),
    Relation("effects reversed", lambda sheets: sheets, reversed_catalogue=True),
    Relation("rows in no order", _disordered),
)


# --- answers


def predictor_for(sheets: Sheets, muscle: Muscle) -> Predictor:
    """The data of a diagnosis, read from the text of the files."""
    files = [Points(read_measurement(sheet.text().encode(), sheet.name)) for sheet in sheets]
    return predictor_of(joined(files).measurement, muscle)


def answer_of(
    sheets: Sheets, muscle: Muscle, catalogue: Mapping[str, Any], start: FitModel | None = None
) -> Diagnosis:
    """The diagnosis of files, by default from the ideal muscle."""
    return diagnose(predictor_for(sheets, muscle), start or FitModel(muscle), catalogue=catalogue)


def probabilities_of(found: Diagnosis) -> dict[str, float]:
    """Probability of each missing effect."""
    return {item.effect: item.probability for item in found.evidence}


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
    stated = probabilities_of(before)
    for effect, probability in probabilities_of(after).items():
        if abs(probability - stated[effect]) > SAME_PROBABILITY:
            return f"probability of {effect} {probability:.3f} instead of {stated[effect]:.3f}"
    return ""


def _shown(found: Diagnosis) -> str:
    return " + ".join("|".join(sorted(group)) for group in groups_of(found)) or "none"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit code is the number of exact relations that do not hold."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--only", default="", help="part of the name of a case")
    parser.add_argument("--relation", default="", help="part of the name of a relation")
    parser.add_argument("--few", action="store_true", help="six effects instead of the catalogue")
    parser.add_argument("--long", action="store_true", help="also the logger: 1.5 minutes for each relation")
    add_keep(parser)
    options = parser.parse_args(arguments)
    chosen = [
        case
        for case in cases()
        if options.only in case.name and (options.long or not case.name.startswith("logger"))
    ]
    asked = [
        (case.name, relation.name, options.few)
        for case in chosen
        for relation in (*RELATIONS, *MORE)
        if options.relation in relation.name and relation.rewritten(case.sheets) is not None
    ]
    failed, counted = 0, 0
    for line in examined(compared, asked, key=lambda one: " | ".join(map(str, one)), keep=options.keep):
        case, relation, _ = line.key.split(" | ")
        exact = next(one.exact for one in (*RELATIONS, *MORE) if one.name == relation)
        counted += exact
        failed += bool(line.result) and exact
        say(f"{'--' if line.result else 'ok'} {case:34}{relation:20}{line.seconds:6.1f} s  {line.result}")
    say(f"{failed} of {counted} exact relations do not hold, in {len(chosen)} cases")
    return failed


def compared(asked: tuple[str, str, bool]) -> str:
    """What a relation changed of the answer of a case; empty for nothing."""
    name, relation_name, few = asked
    case = next(one for one in cases() if one.name == name)
    relation = next(one for one in (*RELATIONS, *MORE) if one.name == relation_name)
    catalogue = {effect: CATALOGUE[effect] for effect in FEW} if few else dict(CATALOGUE)
    sheets = relation.rewritten(case.sheets)
    assert sheets is not None
    if relation.reversed_catalogue:
        catalogue = dict(reversed(catalogue.items()))
    try:
        after = answer_of(sheets, case.muscle, catalogue, case.start)
    except InputError as error:  # a file that is refused is a line of the table, not its end
        return f"refused: {error}"[:120]
    return difference(relation, _plain_answer(name, few), after)


@lru_cache
def _plain_answer(name: str, few: bool) -> Diagnosis:
    case = next(one for one in cases() if one.name == name)
    catalogue = {effect: CATALOGUE[effect] for effect in FEW} if few else CATALOGUE
    return answer_of(case.sheets, case.muscle, catalogue, case.start)


def say(text: str) -> None:
    """One line, at once."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
