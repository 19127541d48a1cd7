"""Measured or published points as a Measurement: uploaded files, presets, several files joined."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.kind import common_kind
from mckibben.measurement.measurement import Measurement, build
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.presets import CurvePreset, MeasurementPreset, MysteryPreset, Preset, PresetLibrary

_SHA256_LENGTH = 64
#: Kind of a preset file -> its form, of those that hold points.
POINT_PRESETS: dict[str, type[Preset]] = {
    "measurement": MeasurementPreset,
    "curve": CurvePreset,
    "mystery": MysteryPreset,
}
_KINDS = ("measurements", "curves", "mysteries")


@dataclass(frozen=True, slots=True)
class Points:
    """A measurement, with the number of rows of its source that were left out.

    Attributes:
        measurement: the rows that may be compared.
        left_out: reason -> number of rows left out.
        nominal_length: of the measured sample, if the source states it [m].
        source: source of a preset.
        parts: the joined measurements; empty for a single one.
    """

    measurement: Measurement
    left_out: dict[str, int] = field(default_factory=dict)
    nominal_length: float | None = None
    source: str = ""
    parts: tuple[Points, ...] = ()

    def __post_init__(self) -> None:
        # Rows that could not be read are left out like those a source excludes itself.
        object.__setattr__(self, "left_out", dict(self.measurement.skipped) | self.left_out)


def find_points(identity: str, *, library: PresetLibrary, store: MeasurementStore) -> Points:
    """The points of an uploaded file (SHA-256) or of a measurement or curve preset.

    Raises:
        InputError: code ``not_found``, with the nearest preset id.
    """
    if len(identity) == _SHA256_LENGTH and set(identity) <= set("0123456789abcdef"):
        return Points(store.get(identity))
    points = find_preset(identity, library)
    if points is not None:
        return points
    known = [preset.id for kind in _KINDS for preset in library.list(kind)]
    raise InputError(
        f"there is no measurement '{identity[:80]}'",
        field="measurement",
        hint=did_you_mean(identity, known),
        code="not_found",
    )


def find_preset(identity: str, library: PresetLibrary) -> Points | None:
    """The points of a measurement, curve or mystery preset; None without a preset of this id."""
    for kind in _KINDS:
        for preset in library.list(kind):
            if preset.id.lower() != identity.lower():
                continue
            return points_of(preset)
    return None


def points_of(preset: Preset) -> Points | None:
    """The points of a preset; None of a kind without points."""
    if isinstance(preset, MysteryPreset):
        return mystery_points(preset)
    return preset_points(preset) if isinstance(preset, MeasurementPreset | CurvePreset) else None


def is_preset(document: object) -> TypeGuard[dict[str, Any]]:
    """Whether a JSON document is a preset, by the keys that every preset has."""
    return isinstance(document, dict) and {"schema", "kind", "id"} <= document.keys()


def preset_points(preset: MeasurementPreset | CurvePreset) -> Points:
    """The points of a preset, without those that it excludes.

    Where a maker's curve is zero or below, the muscle is slack: it cannot push.
    """
    used = preset.used
    columns = {name: values[used] for name, values in preset.si_columns().items()}
    if isinstance(preset, MeasurementPreset):
        kind, rest = preset.measurement_kind, preset.nominal_length.si("m")
        slack = np.array(preset.slack, bool)[used] if preset.slack else None
    else:
        kind, rest, slack = "static", None, columns["force"] <= 0.0
    reasons = [f"row {row.index + 1} is not used: {row.why}" for row in preset.excluded]
    measurement = build(
        columns,
        name=preset.id,
        id=_preset_hash(preset),
        kind=kind,
        marked_slack=slack,
        messages=reasons,
    )
    source = f"{preset.source} (grade {preset.grade})"
    return Points(measurement, {"by its source": len(reasons)} if reasons else {}, rest, source)


def mystery_points(preset: MysteryPreset) -> Points:
    """The points of a mystery."""
    measurement = build(
        preset.si_columns(),
        name=preset.id,
        id=_preset_hash(preset),
        kind=preset.measurement_kind,
        conditions=preset.si_conditions(),
    )
    return Points(measurement, nominal_length=preset.nominal_length.si("m"), source=preset.maker)


def _preset_hash(preset: Preset) -> str:
    return hashlib.sha256(f"{preset.kind}:{preset.id}".encode()).hexdigest()


def joined(all_points: Sequence[Points]) -> Points:
    """Several measurements as one; each keeps its groups. Conditions that differ are left out.

    Raises:
        InputError: they are of different kinds, or share no channels.
    """
    if len(all_points) == 1:
        return all_points[0]
    parts = [points.measurement for points in all_points]
    first, kind = parts[0], parts[0].kind
    for part in parts[1:]:
        together = common_kind(kind, part.kind)
        if together is None:
            raise InputError(
                f"{part.name} is {part.kind}, {first.name} is {first.kind}",
                field="kind",
                hint="compare them one after the other; files whose force is predicted go together",
            )
        kind = together
    shared = [name for name in first.columns if all(name in part.columns for part in parts)]
    columns = {name: np.concatenate([part.columns[name] for part in parts]) for name in shared}
    offset, labels = 0, []
    for part in parts:
        group = np.unique(part.columns["group"], return_inverse=True)[1]
        labels.append(group + offset)
        offset += int(group.max()) + 1
    columns["group"] = np.concatenate(labels)
    combined = build(
        columns,
        name=", ".join(part.name for part in parts),
        id=hashlib.sha256("".join(part.id for part in parts).encode()).hexdigest(),
        kind=kind,
        conditions={
            key: value
            for key, value in first.conditions.items()
            if all(part.conditions.get(key) == value for part in parts)
        },
        marked_slack=np.concatenate([part.slack for part in parts]),
        excluded_rows=_excluded(parts),
        starts=_starts(parts),
    )
    messages = [f"{part.name}: {message}" for part in parts for message in part.messages]
    left_out: dict[str, int] = {}
    for points in all_points:
        for reason, count in points.left_out.items():
            left_out[reason] = left_out.get(reason, 0) + count
    rest = {points.nominal_length for points in all_points}
    weights = [part.rows / combined.rows for part in parts]
    shared = {
        name: sum(w * part.shared_noise.get(name, 0.0) ** 2 for part, w in zip(parts, weights, strict=True))
        ** 0.5
        for name in dict.fromkeys(name for part in parts for name in part.shared_noise)
    }
    return Points(
        replace(
            combined,
            messages=tuple(messages),
            in_words=frozenset.intersection(*(part.in_words for part in parts)),
            shared_noise=shared,
        ),
        left_out,
        rest.pop() if len(rest) == 1 else None,
        parts=tuple(all_points),
    )


def _excluded(parts: Sequence[Measurement]) -> dict[str, NDArray[np.bool_]]:
    """The excluded rows of all parts, concatenated."""
    reasons = dict.fromkeys(reason for part in parts for reason in part.excluded_rows)
    return {
        reason: np.concatenate([part.excluded_rows.get(reason, np.zeros(part.rows, bool)) for part in parts])
        for reason in reasons
    }


def _starts(parts: Sequence[Measurement]) -> tuple[int, ...]:
    """First row of each file."""
    offset, result = 0, []
    for part in parts:
        result += [offset + start for start in part.starts]
        offset += part.rows
    return tuple(result)
