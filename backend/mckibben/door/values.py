"""Arguments of the Python door in SI: numbers, texts with units, sequences and arrays of both."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mckibben.physics.errors import InputError
from mckibben.physics.units import Reference, si

#: A number in SI units, or a text with a unit ("300 mm").
Quantity: TypeAlias = float | str
#: One quantity or many.
Quantities: TypeAlias = float | str | Sequence[float | str] | NDArray[Any]
FloatArray: TypeAlias = NDArray[np.float64]


def array_of(value: Quantities, unit: str, name: str, reference: Reference | None = None) -> FloatArray:
    """The values in SI, with the shape of the argument.

    Args:
        value: the argument.
        unit: SI unit.
        name: of the argument, for messages.
        reference: of a pressure.

    Raises:
        InputError: not a finite number, or a text without a unit that fits.
    """
    if isinstance(value, str) or np.isscalar(value):
        return np.array(_number(value, unit, name, reference))
    try:
        values = np.asarray(value)
    except ValueError as error:  # rows of different length
        raise InputError(f"{name}: is no array: {error}", hint="rows of equal length") from error
    if values.dtype.kind in "fiu":
        numbers = values.astype(np.float64)
    else:
        # Texts beside numbers: numpy would make texts of all.
        flat: list[Any] = np.asarray(value, dtype=object).ravel().tolist()
        numbers = np.array([_number(item, unit, name, reference) for item in flat], dtype=np.float64)
        numbers = numbers.reshape(values.shape)
    if not np.all(np.isfinite(numbers)):
        place = int(np.flatnonzero(~np.isfinite(numbers.ravel()))[0])
        raise InputError(f"{name}: value {place + 1} is not a finite number", hint="leave such rows out")
    return numbers


def _number(value: object, unit: str, name: str, reference: Reference | None) -> float:
    try:
        return si(value, unit, reference=reference)
    except InputError as error:
        raise InputError(f"{name}: {error.message}", hint=error.hint) from error


def number_of(value: Quantity, unit: str, name: str, reference: Reference | None = None) -> float:
    """One value in SI.

    Raises:
        InputError: as `array_of`.
    """
    return _number(value, unit, name, reference)


def names_of(value: str | Sequence[str]) -> tuple[str, ...]:
    """One name, or several."""
    return (value,) if isinstance(value, str) else tuple(value)
