"""Every field of a sizing task with its value and meaning: what was stated, and what was assumed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from pydantic import BaseModel

from mckibben.documents.task import ForceOverStroke, SizingTask
from mckibben.report.sizing.material import Entry

_NOT_LISTED = frozenset({"schema_version", "title"})
# What an omitted field means, where that is not "none".
_DEFAULT_WORDS = {"uncertainty.hysteresis": "that of the muscle", "load.pair.pulley_radius": "free"}
_LINEAR_ONLY = frozenset({"stroke", "speed"})  # fields that an antagonist pair does not have


def entries_of(document: SizingTask, considered: Mapping[str, Sequence[str]]) -> list[Entry]:
    """The fields of a task that apply to it.

    Args:
        document: the task.
        considered: kind of part -> ids tried in the search.
    """
    pair = document.load.pair is not None
    entries = []
    for entry in _entries(document, ""):
        of_load = entry.path.startswith("load.")
        if pair and (entry.path in _LINEAR_ONLY or (of_load and not entry.path.startswith("load.pair"))):
            continue
        if not pair and entry.path == "load.pair":
            continue
        if entry.value is None and entry.path in _DEFAULT_WORDS:
            entry = entry._replace(value=_DEFAULT_WORDS[entry.path])
        if entry.path == "operation.air_price":
            entry = entry._replace(value=f"{entry.value:g} {document.operation.currency}/m³")
        kind = entry.path.removeprefix("catalogue.")
        if kind in considered and entry.value is None:
            entry = entry._replace(value=", ".join(considered[kind]) or "none")
        entries.append(entry)
    return entries


def _entries(model: BaseModel, prefix: str, *, parent_stated: bool = True) -> Iterator[Entry]:
    for name, field in type(model).model_fields.items():
        value = getattr(model, name)
        if name in _NOT_LISTED:
            continue
        path = f"{prefix}{name}"
        is_stated = parent_stated and name in model.model_fields_set
        if isinstance(value, BaseModel) and not isinstance(value, ForceOverStroke):
            yield from _entries(value, f"{path}.", parent_stated=is_stated)
        else:
            yield Entry(path, _shown(value), is_stated, field.description or "")


def _shown(value: object) -> float | str | None:
    match value:
        case None | str():
            return value
        case int() | float():
            return float(value)
        case ForceOverStroke():
            points = zip(value.strokes, value.forces, strict=True)
            return "; ".join(f"{force:.4g} N at {stroke * 1e3:.4g} mm" for stroke, force in points)
        case _:
            return ", ".join(map(str, value)) if isinstance(value, list) else str(value)
