"""Static questions: tension at given pressures and lengths, and the arguments of curves."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.application.curves.curves import pressures_of
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.door.values import FloatArray, Quantities, Quantity, array_of, number_of
from mckibben.physics.errors import InputError

_SHORTEST = 0.05  # shortest length accepted, share of the nominal length; no muscle contracts so far
_HIGHEST = 1e8  # Pa


def force_of(
    start: StartModel,
    studio: Studio,
    *,
    pressure: Quantities,
    contraction: Quantities | None,
    length: Quantities | None,
    direction: Quantities,
    unclipped: bool,
) -> FloatArray:
    """Tension [N]; arguments as in `Model.force`.

    Raises:
        InputError: as there.
    """
    senses = np.sign(array_of(direction, "1", "direction"))
    model = studio.slow_model(start, directed=bool(np.any(senses)))
    rest = float(model.muscle.nominal_length)
    if contraction is not None and length is None:
        lengths = np.asarray(rest * (1.0 - array_of(contraction, "1", "contraction")))
    elif length is not None and contraction is None:
        lengths = array_of(length, "m", "length")
    else:
        raise InputError("give either the contraction or the length", hint='e.g. contraction="10 %"')
    shortest, longest = _SHORTEST * rest, model.longest
    outside = lengths[(lengths < shortest) | (lengths > longest)]
    if outside.size:
        raise InputError(
            f"a length of {outside[0] * 1e3:.4g} mm is out of reach",
            hint=f"between {shortest * 1e3:.4g} mm and the braid lock at {longest * 1e3:.4g} mm",
        )
    pressures = array_of(pressure, "Pa", "pressure", "gauge")
    if np.any((pressures < 0.0) | (pressures > _HIGHEST)):
        raise InputError("pressure: a value is not between 0 and 1000 bar", hint="gauge pressures")
    try:
        columns = np.broadcast_arrays(pressures, lengths, senses)
    except ValueError as error:
        shapes = ", ".join(str(values.shape) for values in (pressures, lengths, senses))
        raise InputError(f"arrays of the shapes {shapes} do not fit together") from error
    tension = model.force(
        pressure=columns[0].ravel(),
        length=columns[1].ravel(),
        direction=columns[2].ravel(),
        clipped=not unclipped,
    )
    return np.asarray(tension, dtype=np.float64).reshape(columns[0].shape)


def pressures_in(pressure: str | Sequence[Quantity] | FloatArray) -> tuple[float, ...]:
    """Pressures from a text or a list [Pa].

    Raises:
        InputError: a value that is no pressure.
    """
    if isinstance(pressure, str):
        return pressures_of(pressure.split(","), "pressure")
    values = np.atleast_1d(np.asarray(pressure, dtype=object)).ravel().tolist()
    return pressures_of(values, "pressure")


def optional_number(value: Quantity | None, unit: str, name: str) -> float | None:
    """A value in SI, None for None."""
    return None if value is None else number_of(value, unit, name)


def at_least_two(points: int) -> int:
    """A number of points.

    Raises:
        InputError: it is not between 2 and 100 000.
    """
    if not 2 <= points <= 100_000:
        raise InputError(f"points: {points} is not between 2 and 100 000", hint="e.g. 200")
    return points
