"""Questions that the numbers raise: signs, the reference of the pressure, zeros, and what the test was."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.question import Question
from mckibben.measurement.read.evidence import Array, Evidence, bare_name
from mckibben.measurement.read.plain_head import HeaderColumn
from mckibben.measurement.read.plausible import ENOUGH
from mckibben.measurement.read.questions import column_option
from mckibben.measurement.read.signs import SHORTENING_POSITIVE, STROKE_SIGN
from mckibben.physics.units import convert

_STRETCHED = 0.08  # of the rest length; braids of up to 22 degrees lock there, others hardly go further
REVERSE, KEEP = "reverse the sign", "keep the sign"


def physical_questions(evidence: Evidence) -> list[Question]:
    """Signs, reference of the pressure, zero of the force."""
    return [*_signs(evidence), *_reference(evidence), *_tare(evidence)]


def _signs(evidence: Evidence) -> list[Question]:
    asked = []
    force = evidence.channels.get("force")
    column = evidence.used.get("force")
    if force is not None and column is not None and column.origin != "you" and mostly_negative(force):
        asked.append(
            Question(
                "sign of force",
                f"{evidence.noun} '{column.header}' is negative in nearly all rows, but a pulling force "
                "is positive here; reverse its sign if the file counts compression as positive",
                column_option("force", bare_name(column), sign=-1),
                column.header,
                REVERSE,
                (REVERSE, KEEP),
            )
        )
        force = -force
    for channel in ("displacement", "contraction"):
        stroke, column = evidence.channels.get(channel), evidence.used.get(channel)
        if stroke is not None and column is not None and column.origin != "you":
            asked += _sign_of_stroke(evidence, channel, stroke, force)
    return asked


def _sign_of_stroke(evidence: Evidence, channel: str, stroke: Array, force: Array | None) -> list[Question]:
    column = evidence.used[channel]
    against = runs_against(stroke, evidence.channels.get("pressure"), force)
    falls = mostly_negative(stroke)
    stated = evidence.conditions.get(STROKE_SIGN) == SHORTENING_POSITIVE
    if against is False or not (falls or against or (column.extends and not stated)):
        return []
    reversed_sign = column_option(channel, bare_name(column), sign=-1)
    rest, most = evidence.conditions.get("nominal_length"), float(np.max(stroke))
    if channel == "displacement" and isinstance(rest, float) and not falls and most > _STRETCHED * rest:
        return [_zero_of_stroke(evidence, column, rest, most)]
    could_be_length = channel == "displacement" and float(np.min(stroke)) > 0.0
    as_length = f" or {column_option('length', bare_name(column))}" if could_be_length else ""
    return [
        Question(
            f"sign of {channel}",
            f"{evidence.noun} '{column.header}' {'falls' if falls else 'grows'} as the muscle "
            f"{'shortens' if falls else 'lengthens'}, but shortening is positive here; reverse its sign",
            f"{reversed_sign}{as_length}",
            column.header,
            REVERSE,
            (REVERSE, KEEP),
        )
    ]


def _zero_of_stroke(evidence: Evidence, column: HeaderColumn, rest: float, most: float) -> Question:
    """A reading that grows as the muscle lengthens, from a zero at which it cannot be at its rest length."""
    unit = column.unit or "m"
    reach, whole = (float(convert([value], "m", unit)[0]) for value in (most, rest))
    length = f"0 to {reach:.4g} {unit} = {whole - reach:.4g} to {whole:.4g} {unit}"
    return Question(
        "zero of displacement",
        f"{evidence.noun} '{column.header}' grows as the muscle lengthens, up to {reach:.4g} {unit}: a "
        f"muscle of {whole:.4g} {unit} is not at its rest length where it shows 0; which length has it "
        "there and at the end",
        column_option("length", bare_name(column), length),
        column.header,
    )


def mostly_negative(values: Array) -> bool:
    """Whether values lie below zero nearly throughout."""
    low, high = float(np.min(values)), float(np.max(values))
    return low < 0.0 and -low > 4.0 * max(high, 0.0)


def runs_against(stroke: Array, pressure: Array | None, force: Array | None) -> bool | None:
    """Whether the stroke runs against physics: pulled harder, a muscle becomes longer, more air shortens it.

    Units do not matter. None = the readings do not show it.
    """
    if np.ptp(stroke) == 0.0 or pressure is None:
        return None
    if force is not None and np.ptp(force) > 0.02 * np.max(np.abs(force)):
        basis = np.column_stack([np.ones(len(stroke)), _scaled(pressure), _scaled(stroke)])
        weights, *_ = np.linalg.lstsq(basis, _scaled(force), rcond=None)
        return None if abs(weights[2]) < 0.2 else bool(weights[2] > 0.0)
    if np.ptp(pressure) == 0.0:
        return None
    together = float(np.corrcoef(pressure, stroke)[0, 1])
    return None if abs(together) < 0.6 else together < 0.0


def _scaled(values: Array) -> Array:
    span = float(np.ptp(values))
    return (values - np.mean(values)) / (span or 1.0)


_REST_BAND = (0.9e5, 1.1e5)  # Pa; the air outside


def _reference(evidence: Evidence) -> list[Question]:
    """A pressure that shows about 1 bar while the muscle does nothing may count from vacuum."""
    pressure, column = evidence.channels.get("pressure"), evidence.used.get("pressure")
    if pressure is None or column is None or column.absolute is not None or column.origin == "you":
        return []
    if "pressure" in evidence.conditions:
        return []
    lowest = float(np.min(pressure))
    if not _REST_BAND[0] <= lowest <= _REST_BAND[1] or np.ptp(pressure) < 0.2e5:
        return []
    at_rest = pressure <= lowest + 0.03e5
    if not _idle(evidence, at_rest):
        return []
    return [
        Question(
            "reference of pressure",
            f"{evidence.noun} '{column.header}' shows {lowest / 1e5:.2f} bar at rest; is it absolute or "
            "gauge pressure",
            f"{column_option('pressure', bare_name(column), f'{column.unit}(a)')} or "
            f"{column_option('pressure', bare_name(column), f'{column.unit}(g)')}",
            column.header,
            "absolute",
            ("absolute", "gauge"),
        )
    ]


def _idle(evidence: Evidence, rows: NDArray[np.bool_]) -> bool:
    """Whether the muscle neither pulls nor moves in these rows."""
    force = evidence.channels.get("force")
    if force is not None and np.ptp(force) > 0.05 * np.max(np.abs(force)):
        shown = force[rows][force[rows] != 0.0]  # an exact 0 is a slack muscle or a clipped table
        if not len(shown) or np.max(np.abs(shown)) > 0.05 * np.max(np.abs(force)):
            return False
        # A muscle that is short already pulls little at any pressure: only a long one shows that it is idle.
        shortened = _shortened(evidence)
        return shortened is None or bool(np.min(shortened[rows]) <= 0.1 * np.max(shortened))
    for channel in ("displacement", "contraction"):
        stroke = evidence.channels.get(channel)
        if stroke is not None and np.ptp(stroke) > 0.0:
            return bool(np.max(np.abs(stroke[rows])) <= 0.05 * np.max(np.abs(stroke)))
    return False


def _shortened(evidence: Evidence) -> Array | None:
    """How far the muscle is shortened in each row, from its longest; None where that does not change."""
    for channel in STROKES:
        stroke = evidence.channels.get(channel)
        if stroke is not None and np.ptp(stroke) > 0.005 * np.max(np.abs(stroke)):
            return np.max(stroke) - stroke if channel == "length" else stroke - np.min(stroke)
    return None


def _tare(evidence: Evidence) -> list[Question]:
    """A force at rest, without pressure and stroke: the sensor was not set to zero."""
    force, pressure = evidence.channels.get("force"), evidence.channels.get("pressure")
    column = evidence.used.get("force")
    stroke = evidence.channels.get("displacement")
    if force is None or pressure is None or stroke is None or column is None or np.ptp(force) == 0.0:
        return []
    if evidence.weighed:
        return []
    rows = (np.abs(pressure) < 0.03e5) & (np.abs(stroke) < 0.01 * max(float(np.max(np.abs(stroke))), 1e-9))
    if np.count_nonzero(rows) < ENOUGH:
        return []
    offset = float(np.median(force[rows]))
    if "force_zero" in evidence.conditions or abs(offset) < 0.02 * float(np.max(np.abs(force))):
        return []
    return [
        Question(
            "zero of force",
            f"{evidence.noun} '{column.header}' shows {offset:.3g} N at rest, without pressure and stroke; "
            "it is not subtracted; is it an offset of the sensor",
            f'--experiment "force_zero={offset:.3g} N"',
            column.header,
            f"{offset:.3g} N",
            (),
            stops=False,
        )
    ]


def context_questions(evidence: Evidence) -> list[Question]:
    """What the test was, where the file does not say it and a comparison needs it."""
    asked = []
    channels, conditions = evidence.channels, evidence.conditions
    strokes = [channel for channel in STROKES if channel in channels]
    if strokes == ["displacement"] and "nominal_length" not in conditions:
        asked.append(
            Question(
                "rest length",
                "the file states no rest length (L0) of the muscle; a stroke alone gives no contraction",
                '--rest-length "300 mm"',
                stops=False,
            )
        )
    loaded = "load_mass" in conditions or "load_force" in conditions or "force" in channels
    if not loaded and (strokes or "pressure" in channels) and "diameter" not in channels:
        asked.append(
            Question(
                "load",
                "the file states no load, which decides how far the muscle shortens",
                '--load "6 kg"',
                stops=False,
            )
        )
    if "command" in channels and "supply_pressure" not in conditions:
        asked.append(
            Question(
                "supply",
                "the file states no supply pressure, from which the valve fills the muscle",
                '--supply "6 bar"',
                stops=False,
            )
        )
    return asked
