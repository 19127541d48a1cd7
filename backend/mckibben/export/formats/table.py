"""Lookup tables for a PLC: force over pressure and contraction, and the pressure for a force.

The error of interpolating in them is measured, not estimated: at three points within each cell in both
directions, bilinear interpolation is compared with the model. Where a muscle goes slack the force has a
kink, so the error of the cells around it is stated apart.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.export.language import MATLAB, words_of
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject
from mckibben.simulation.statics.inverse import contraction_at
from mckibben.simulation.statics.model import StaticModel

PRESSURES, CONTRACTIONS, FORCES = 25, 41, 25  # breakpoints
_HIGHEST = 6e5  # Pa, where the maker states no limit
_LARGEST = 0.25  # contraction, where the maker states no limit
_STEPS, _NEAR = 60, 1e-6  # of Newton's method, and the last step that ends it [Pa]
_BETWEEN = (0.25, 0.5, 0.75)  # places within a cell


@dataclass(frozen=True)
class Lookup:
    """Tables on evenly spaced breakpoints, SI; pressures gauge.

    Attributes:
        pressure, contraction, force_axis: breakpoints.
        force, volume: at pressures (rows) and contractions (columns); at rest, without direction.
        inverse: pressure for the forces (rows) at contractions; NaN where no permitted pressure gives it.
        blocked_force, free_contraction: over pressure: force at the rest length, contraction without load,
            NaN where there is none.
        force_error, force_error_pulling: largest error of bilinear interpolation between breakpoints, in all
            cells and in those in which the muscle pulls at all corners [N].
        volume_error: of the volume [m^3].
        pressure_error: of the inverse table, in cells without NaN [Pa].
        blocked_error, free_error: of linear interpolation over pressure [N], [-].
    """

    pressure: np.ndarray
    contraction: np.ndarray
    force_axis: np.ndarray
    force: np.ndarray
    volume: np.ndarray
    inverse: np.ndarray
    blocked_force: np.ndarray
    free_contraction: np.ndarray
    force_error: float
    force_error_pulling: float
    volume_error: float
    pressure_error: float
    blocked_error: float
    free_error: float

    @property
    def notes(self) -> list[str]:
        """Where the tables end, and how exact they are."""
        largest = float(np.max(self.force))
        return [
            f"Between breakpoints (bilinear, measured at {len(_BETWEEN) ** 2} points of every cell): force "
            f"within {self.force_error:.3g} N ({100.0 * self.force_error / largest:.2g} % of the largest), "
            f"within {self.force_error_pulling:.3g} N where all corners of the cell pull; volume within "
            f"{self.volume_error:.3g} m^3; pressure for a force within {self.pressure_error:.3g} Pa. Over "
            f"pressure alone (linear): blocked force within {self.blocked_error:.3g} N, free contraction "
            f"within {self.free_error:.3g}.",
            f"Pressures above {self.pressure[-1]:.6g} Pa, contractions outside {self.contraction[0]:.4g} to "
            f"{self.contraction[-1]:.4g}.",
        ]


def left_out(lookup: Lookup, slow: StaticModel) -> str:
    """What motion changes, with the largest change by friction and hysteresis, which is measured.

    Args:
        lookup: the tables, without direction.
        slow: the model with friction that has memory fully built up in its direction.
    """
    lengths = slow.muscle.nominal_length * (1.0 - lookup.contraction)
    loops = (slow.curves(lookup.pressure, lengths, direction=each).force for each in (-1.0, 1.0))
    change = max(_largest(loop - lookup.force) for loop in loops)
    moved = f"changes the force by up to {change:.3g} N" if change > 0.0 else "does not change the force"
    return (
        "Velocity, direction and memory: the tables hold for a muscle at rest. A long slow motion, after "
        f"which friction and hysteresis are fully built up, {moved}."
    )


def lookup_of(model: StaticModel) -> Lookup:
    """The tables of a model within the limits of its maker."""
    limits, rest = model.limits, model.muscle.nominal_length
    pressure = np.linspace(0.0, limits.max_pressure or _HIGHEST, PRESSURES)
    stretch = max(-(limits.max_pretension or 0.0), 1.0 - model.longest / rest)
    contraction = np.linspace(stretch, limits.max_contraction or _LARGEST, CONTRACTIONS)
    curves = model.curves(pressure, rest * (1.0 - contraction))
    strongest = float(np.max(curves.force))
    force_axis = np.linspace(0.0, min(strongest, limits.max_force or strongest), FORCES)
    highest = float(pressure[-1])
    inverse = _inverse(model, force_axis, contraction, highest)
    between = [np.add.outer(axis[:-1], _steps(axis)).ravel() for axis in (pressure, contraction, force_axis)]
    exact = model.curves(between[0], rest * (1.0 - between[1]))
    forces, volumes = (
        np.abs(_bilinear(pressure, contraction, table, *between[:2]) - values)
        for table, values in ((curves.force, exact.force), (curves.volume, exact.volume))
    )
    pulling = np.minimum.reduce([curves.force[a:b, c:d] for a, b in _HALVES for c, d in _HALVES]) > 0.0
    lines = [_over_pressure(model, each) for each in (pressure, between[0])]
    width = len(_BETWEEN)
    of_pulling = np.kron(pulling, np.ones((width, width), bool))
    return Lookup(
        pressure=pressure,
        contraction=contraction,
        force_axis=force_axis,
        force=curves.force,
        volume=curves.volume,
        inverse=inverse,
        blocked_force=lines[0][0],
        free_contraction=lines[0][1],
        force_error=_largest(forces),
        force_error_pulling=_largest(np.where(of_pulling, forces, np.nan)),
        volume_error=_largest(volumes),
        pressure_error=_largest(
            _bilinear(force_axis, contraction, inverse, between[2], between[1])
            - _inverse(model, between[2], between[1], highest)
        ),
        blocked_error=_largest(np.interp(between[0], pressure, lines[0][0]) - lines[1][0]),
        free_error=_largest(np.interp(between[0], pressure, lines[0][1]) - lines[1][1]),
    )


def _over_pressure(model: StaticModel, pressure: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Blocked force [N] and free contraction [-]."""
    blocked = model.force(length=model.muscle.nominal_length, pressure=pressure)
    return blocked, contraction_at(model, load=0.0, pressures=pressure)


_HALVES = ((None, -1), (1, None))


def _steps(axis: np.ndarray) -> np.ndarray:
    return np.array(_BETWEEN) * (axis[1] - axis[0])


def _bilinear(
    rows: np.ndarray, columns: np.ndarray, table: np.ndarray, at_rows: np.ndarray, at_columns: np.ndarray
) -> np.ndarray:
    """Bilinear interpolation at the grid of two axes."""
    across = np.array([np.interp(at_columns, columns, row) for row in table])
    return np.array([np.interp(at_rows, rows, column) for column in across.T]).T


def pressures_for(model: StaticModel, forces: np.ndarray, lengths: np.ndarray, highest: float) -> np.ndarray:
    """Gauge pressure [Pa] for each force [N] at each length [m]; NaN where none up to ``highest`` gives it.

    Newton's method kept inside a shrinking bracket, at rest and without direction.
    """
    low, high = np.zeros(len(forces)), np.full(len(forces), highest)

    def excess(pressure: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        out = model.outputs(length=lengths, pressure=pressure)
        return out["force"] - forces, out["force_by_pressure"]

    reachable = (excess(low)[0] <= 0.0) & (excess(high)[0] >= 0.0)
    pressure = 0.5 * high
    with np.errstate(divide="ignore", invalid="ignore"):
        for _ in range(_STEPS):
            value, slope = excess(pressure)
            high = np.where(value >= 0.0, pressure, high)
            low = np.where(value >= 0.0, low, pressure)
            newton = pressure - value / slope
            inside = (newton >= low) & (newton <= high)
            following = np.where(inside, newton, 0.5 * (low + high))
            done = ~reachable | (np.abs(following - pressure) < _NEAR)
            pressure = following
            if done.all():
                break
    return np.where(reachable, pressure, np.nan)


def _inverse(model: StaticModel, forces: np.ndarray, contractions: np.ndarray, highest: float) -> np.ndarray:
    """Pressure at each force (rows) and contraction."""
    lengths = model.muscle.nominal_length * (1.0 - contractions)
    shape = (len(forces), len(contractions))
    given = np.repeat(forces, shape[1]), np.tile(lengths, shape[0])
    return pressures_for(model, *given, highest).reshape(shape)


def _largest(errors: np.ndarray) -> float:
    """The largest error that is a number; 0 without one."""
    return float(np.nanmax(np.abs(errors), initial=0.0))


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
    text = _text([*notes, "", "Table: force at the rest length and contraction without load."])
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
