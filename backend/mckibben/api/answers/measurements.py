"""A measurement as JSON."""

from __future__ import annotations

from mckibben.api.answers.start import Json
from mckibben.identification.measurement import Measurement


def measurement_answer(measurement: Measurement, *, columns: bool = False) -> Json:
    """How a measurement was understood; on request with its columns in SI."""
    answer: Json = {
        "id": measurement.id,
        "name": measurement.name,
        "kind": measurement.kind,
        "kind_detected": measurement.kind_detected,
        "rows": measurement.rows,
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
        "groups": measurement.groups,
        "messages": list(measurement.messages),
    }
    if columns:
        answer["columns"] = dict(measurement.columns) | {"slack": measurement.slack}
    return answer
