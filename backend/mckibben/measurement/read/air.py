"""The surrounding air, which an absolute pressure contains: its unit, one value or one per row."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isclose

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.question import Question
from mckibben.measurement.read.cells import CellTable
from mckibben.measurement.read.conditions import ATMOSPHERE, Constant, Note, condition_value
from mckibben.measurement.read.plain_head import HeaderColumn
from mckibben.physics.units import convert

_SAME = 1e-3  # relative; values that differ by less are the same one, rounded
AIR = "ambient_pressure"
_POSSIBLE = (5e4, 1.1e5)  # Pa; of the air where people work
#: Unit -> what a barometer shows in it, from 2000 m above the sea to a high at the sea; none overlap.
_SHOWN = {
    "bar": (0.78, 1.09), "psi": (11.3, 15.8), "inHg": (23.0, 32.3), "kPa": (78.0, 109.0),
    "mmHg": (585.0, 815.0), "hPa": (815.0, 1090.0), "Pa": (7.8e4, 1.09e5),
}  # fmt: skip

Air = float | NDArray[np.float64]


def unit_of_air(value: str | float) -> str | None:
    """The unit in which a number without one is the pressure of the air; None = in no usual one.

    >>> unit_of_air("953.1"), unit_of_air(101.3), unit_of_air(21.5)
    ('hPa', 'kPa', None)
    """
    try:
        number = float(str(value).replace(",", "."))
    except ValueError:
        return None
    return next((unit for unit, (low, high) in _SHOWN.items() if low <= number < high), None)


def is_possible(air: float) -> bool:
    """Whether a pressure [Pa] can be that of the surrounding air."""
    return _POSSIBLE[0] <= air <= _POSSIBLE[1]


def ambient_of(conditions: Mapping[str, float | str]) -> float:
    """Pressure of the surrounding air [Pa]: that of the file where it states a possible one."""
    said = conditions.get(AIR)
    return said if isinstance(said, float) and is_possible(said) else ATMOSPHERE


def column_of_air(
    constants: Sequence[Constant], columns: Sequence[HeaderColumn], conditions: Mapping[str, float | str]
) -> Constant | None:
    """The column of the barometer where its values differ and an absolute pressure needs it."""
    said = str(conditions.get("pressure", "")).lower()
    absolute = any(
        c.use == "pressure" and (c.absolute or (c.absolute is None and said[:3] == "abs")) for c in columns
    )
    found = [c for c in constants if c.key == AIR and len(c.values) > 1]
    return found[0] if absolute and len(found) == 1 and AIR not in conditions else None


def air_of_rows(table: CellTable, column: Constant) -> NDArray[np.float64]:
    """The pressure of the air [Pa] in each row, from a column of the barometer."""
    unit = column.values[0].partition(" ")[2] or "Pa"
    return convert(table.numbers[column.place], unit, "Pa")


def air_questions(
    conditions: Mapping[str, float | str], used: Mapping[str, HeaderColumn], notes: Sequence[Note]
) -> list[Question]:
    """A question where the air that a file states cannot be, or is stated twice: a pressure would be wrong.

    Only an absolute pressure needs it; the zero of that pressure, by the user, is an answer.
    """
    said = conditions.get(AIR)
    column = used.get("pressure")
    if column is None or not column.absolute or not isinstance(said, float) or "pressure_zero" in conditions:
        return []
    stated = list(dict.fromkeys(str(note.value) for note in notes if note.key == AIR))
    values = [condition_value(AIR, value, where=AIR, field=AIR) for value in stated]
    twice = any(isinstance(v, float) and not isclose(v, said, rel_tol=_SAME) for v in values)
    if is_possible(said) and not twice:
        return []
    what = (
        f"is stated as {' and as '.join(stated[:3])}, which one is right"
        if twice
        else f"is read as {said:.6g} Pa, which is impossible; what was it"
    )
    air = said if is_possible(said) else ATMOSPHERE
    return [
        Question(
            "pressure of the surrounding air",
            f"column '{column.header}' is absolute, and the pressure of the surrounding air {what}",
            f"keep one value in the file, or state how much it exceeded {air / 100.0:g} hPa: "
            '--experiment "pressure_zero=-6 hPa"',
            column.header,
        )
    ]
