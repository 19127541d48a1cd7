"""Lookup tables for a PLC: force over pressure and contraction, and the pressure for a force."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence

import numpy as np

from mckibben.export.language import MATLAB, words_of
from mckibben.export.lookup import Lookup, left_out, lookup_of
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject

_CSV = "text/csv; charset=utf-8"


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """CSV files, three of them 2-D and one over pressure alone, and the same tables as a MATLAB script."""
    lookup = lookup_of(subject.statics)
    notes = list(subject.about.lines([left_out(lookup, subject.slow), *lookup.notes]))
    pressure, contraction, force = lookup.pressure, lookup.contraction, lookup.force_axis
    tables = (
        ("force", "force [N]", ("pressure_Pa", pressure), lookup.force),
        ("pressure", "gauge pressure [Pa]", ("force_N", force), lookup.inverse),
        ("volume", "volume of the gas [m^3]", ("pressure_Pa", pressure), lookup.volume),
    )
    script = "\n".join(_matlab(stem, notes, lookup))
    return (
        *(_csv(f"{stem}_{name}.csv", notes, what, rows, contraction, v) for name, what, rows, v in tables),
        _lines(f"{stem}_over_pressure.csv", notes, lookup),
        ExportedFile.of_text(f"{stem}.m", script, "text/x-matlab; charset=utf-8"),
    )


def _csv(
    name: str,
    notes: Sequence[str],
    what: str,
    rows: tuple[str, np.ndarray],
    columns: np.ndarray,
    values: np.ndarray,
) -> ExportedFile:
    text = _text([*notes, "", f"Table: {what}; rows {rows[0]}, columns contraction 1 - L/L0."])
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([rows[0], *(f"{value:.9g}" for value in columns)])
    for head, row in zip(rows[1], values, strict=True):
        writer.writerow([f"{head:.9g}", *(_cell(value) for value in row)])
    return ExportedFile.of_text(name, text.getvalue(), _CSV)


def _lines(name: str, notes: Sequence[str], lookup: Lookup) -> ExportedFile:
    """What depends on the pressure alone."""
    columns = {
        "pressure_Pa": lookup.pressure,
        "blocked_force_N": lookup.blocked_force,
        "free_contraction": lookup.free_contraction,
    }
    text = _text([*notes, "", "Table: force at the nominal length and contraction without load."])
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([_cell(value) for value in row] for row in zip(*columns.values(), strict=True))
    return ExportedFile.of_text(name, text.getvalue(), _CSV)


def _text(notes: Sequence[str]) -> io.StringIO:
    """A text that begins with the notes."""
    text = io.StringIO()
    text.writelines(f"#{line[1:]}\n" for line in MATLAB.remarks(notes))
    return text


def _cell(value: float) -> str:
    return "" if np.isnan(value) else f"{value:.9g}"


def _matlab(stem: str, notes: Sequence[str], lookup: Lookup) -> Iterator[str]:
    """A script that sets one structure with breakpoints and tables, as lookup blocks take them."""
    remarks = [
        "force(i, j) is that at pressure(i) and contraction(j), volume too: an n-D lookup block takes them",
        "with the breakpoints pressure and contraction; pressure_for_force with force_axis and contraction.",
        "blocked_force and free_contraction are 1-D tables over pressure. NaN = there is none.",
    ]
    yield from MATLAB.remarks([*notes, "", *remarks])
    name = f"{words_of(stem)}_table"
    yield from _matrix(f"{name}.pressure", lookup.pressure[None, :])
    yield from _matrix(f"{name}.contraction", lookup.contraction[None, :])
    yield from _matrix(f"{name}.force", lookup.force)
    yield from _matrix(f"{name}.volume", lookup.volume)
    yield from _matrix(f"{name}.force_axis", lookup.force_axis[None, :])
    yield from _matrix(f"{name}.pressure_for_force", lookup.inverse)
    yield from _matrix(f"{name}.blocked_force", lookup.blocked_force[None, :])
    yield from _matrix(f"{name}.free_contraction", lookup.free_contraction[None, :])


def _matrix(name: str, values: np.ndarray) -> Iterator[str]:
    yield f"{name} = [ ..."
    for row in values:
        for begin in range(0, len(row), 8):
            part = " ".join("NaN" if np.isnan(value) else f"{value:.9g}" for value in row[begin : begin + 8])
            yield f"  {part}{' ...' if begin + 8 < len(row) else ';'}"
    yield "];"


FORMAT = Format(
    title="Lookup tables",
    note="force and pressure tables for a PLC, CSV and MATLAB, with their interpolation error",
    write=write,
    identifier=True,
    reserved=MATLAB.reserved,
    drives=False,
)
