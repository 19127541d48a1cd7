"""A measurement as JSON, and the preview of a file."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict

from mckibben.application.start import Json
from mckibben.measurement.measurement import CHANNEL_UNITS, KINDS, Measurement
from mckibben.measurement.read.preview import MissingCondition, Preview, missing_conditions

#: Units a form offers for each channel.
_USUAL_UNITS = {
    "time": ("s", "ms", "min"), "pressure": ("bar", "kPa", "MPa", "mbar", "psi", "Pa"),
    "force": ("N", "kN", "lbf"), "length": ("mm", "m", "cm", "in"), "contraction": ("%", "1"),
    "displacement": ("mm", "m", "cm", "in"), "diameter": ("mm", "m", "in"), "velocity": ("m/s", "mm/s"),
    "command": ("1", "%"), "temperature": ("degC", "K", "degF"),
}  # fmt: skip


def measurement_answer(measurement: Measurement, *, columns: bool = False) -> Json:
    """How a measurement was understood; on request with its columns in SI."""
    segments = measurement.segments
    answer: Json = {
        "id": measurement.id,
        "name": measurement.name,
        "kind": measurement.kind,
        "kind_detected": measurement.kind_detected,
        "kind_reason": measurement.kind_reason,
        "rows": measurement.rows,
        "usable_rows": int(measurement.usable.sum()),
        "excluded": dict(measurement.exclusions),
        "skipped": dict(measurement.skipped),
        "channels": [
            {
                "name": channel.name,
                "column": channel.column,
                "unit": channel.source_unit,
                "si_unit": channel.unit,
                "minimum": channel.minimum,
                "maximum": channel.maximum,
            }
            for channel in measurement.channels
        ],
        "ignored": list(measurement.ignored),
        "conditions": dict(measurement.conditions),
        "missing": _asked(missing_conditions(measurement.kind, measurement.columns, measurement.conditions)),
        "groups": measurement.groups,
        "segments": {
            "signal": segments.signal,
            "sweeps": segments.sweeps,
            "cycles": segments.cycles,
            "held_rows": segments.held_rows,
            "speeds": list(segments.speeds),
        },
        "messages": list(measurement.messages),
    }
    if columns:
        answer["columns"] = dict(measurement.columns) | {
            "slack": measurement.slack,
            "usable": measurement.usable,
            "sweep": segments.sweep,
            "cycle": segments.cycle,
            "motion": segments.direction,
        }
    return answer


def preview_answer(found: Preview) -> Json:
    """What a file would be read as."""
    measurement, problem = found.measurement, found.problem
    return {
        "name": found.name,
        "format": found.format,
        "columns": [asdict(column) for column in found.columns],
        "sample": [list(row) for row in found.sample],
        "rows": found.rows,
        "valid_rows": found.valid,
        "skipped": [
            {"reason": reason, "rows": skip.rows, "first": skip.first}
            for reason, skip in found.skipped.items()
        ],
        "kind": measurement.kind if measurement else None,
        "kind_detected": measurement.kind_detected if measurement else False,
        "kind_reason": measurement.kind_reason if measurement else "",
        "conditions": dict(found.conditions),
        "missing": _asked(found.missing),
        "measurement": measurement_answer(measurement) if measurement else None,
        "problem": None
        if problem is None
        else {
            "code": problem.code,
            "message": problem.message,
            "field": problem.field,
            "hint": problem.hint,
        },
        "only_bad_rows": found.refused,
        "messages": list(found.messages),
        "channel_choices": [
            {"name": name, "si_unit": unit, "units": list(_USUAL_UNITS.get(name, (unit,)))}
            for name, unit in CHANNEL_UNITS.items()
        ],
        "kind_choices": list(KINDS),
    }


def _asked(conditions: Iterable[MissingCondition]) -> list[Json]:
    return [asdict(condition) | {"alternatives": list(condition.alternatives)} for condition in conditions]
