"""Every field of the task with its value and meaning, assumed values, simplifications of the computation."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from pydantic import BaseModel

from mckibben.documents.task import ForceOverStroke, SizingTask
from mckibben.report.document import Head, bullets, heading, paragraph, table
from mckibben.report.html import Child, Html, html
from mckibben.report.sizing.material import Chosen, Entry, SizingMaterial
from mckibben.report.sizing.words import entry_value, field_name

_FULL_DESCRIPTION = frozenset({"load.force_over_stroke"})  # it says how the run uses the force

_NOT_LISTED = frozenset({"schema_version", "title"})
# What an omitted field means, where that is not "none".
_DEFAULT_WORDS = {"uncertainty.hysteresis": "that of the muscle", "load.pair.pulley_radius": "free"}
_LINEAR_ONLY = frozenset({"stroke", "speed"})  # fields that an antagonist pair does not have


def task_section(material: SizingMaterial) -> Html:
    """The stated fields of the task."""
    rows = [
        [field_name(entry.path), entry_value(entry), _meaning(entry)]
        for entry in material.entries
        if entry.stated
    ]
    not_stated = [entry for entry in material.entries if not entry.stated and entry.value is None]
    parts: list[Child] = [
        table([Head("Stated"), Head("Value"), Head("Meaning")], rows),
    ]
    if not_stated:
        names = ", ".join(field_name(entry.path).lower() for entry in not_stated)
        parts.append(paragraph(f"Not stated: {names}.", note=True))
    return html(parts)


def _meaning(entry: Entry) -> str:
    """The description without the reason for the default value."""
    if entry.path in _FULL_DESCRIPTION:
        return entry.about
    first = re.split(r"(?<=[.])\s", entry.about, maxsplit=1)[0]
    return "" if ":" in first else first


def assumptions_section(material: SizingMaterial) -> Html:
    """Default values the task does not state, and simplifications of the computation."""
    rows = [
        [field_name(entry.path), entry_value(entry), entry.about]
        for entry in material.entries
        if not entry.stated and entry.value is not None
    ]
    columns = [
        Head("Assumed"),
        Head("Value"),
        Head("Meaning, and reason for the value", wide=True),
    ]
    parts: list[Child] = [
        heading("Values the task does not state"),
        table(columns, rows) if rows else paragraph("None: the task states every value."),
        heading("Simplifications"),
        bullets(_approximations(material)),
    ]
    return html(parts)


def _approximations(material: SizingMaterial) -> list[str]:
    chosen = material.chosen
    lines = [
        "Static forces come from the static model with the effects of the muscle, with its friction while it "
        "fills. A wider loop than that of the model only affects the specimens of the probability.",
        "Times come from a run of the drive: choked and subsonic flow through valve and tube, energy balance "
        "of the air, a rigid load between two end stops. The valve fills or vents with full flow; nothing "
        "slows the load down before the stop.",
        "The mass of the muscle and the volume and resistance of fittings and silencers are neglected.",
        "Creep, relaxation, warming in operation, wear and ageing are neglected.",
        "The length of the end fittings counts only if the task states it.",
        "The life is an estimate from general knowledge, not a curve of the maker: 10⁷ load cycles without "
        "load, 10⁵ at the largest force or contraction the maker allows, logarithmic in between.",
    ]
    if material.profile[0]:
        lines.insert(
            1,
            "Static figures use the force over the stroke as stated. The run, and so all times, the air and "
            "the probability, use the lowest straight line that is nowhere below it and does not fall: "
            "conservative, not exact.",
        )
    if chosen is None:
        return lines
    lines += _of_drive(material, chosen)
    return lines


def _of_drive(material: SizingMaterial, chosen: Chosen) -> list[str]:
    lines = [f"Air: {chosen.gas}."]
    if chosen.count > 1:
        lines.append(
            f"The {chosen.count} parallel muscles are assumed equal and equally loaded: one is simulated "
            "with its share of the load and of the valve's flow. Unequal muscles carry unequal shares."
        )
    if material.pair:
        lines += [
            "Each muscle of the pair has its rest length at one end of the swing. The run first fills the "
            "second muscle, then swings; the static reserve assumes the second muscle is empty, in the run "
            "it is still venting.",
            "The stiffness is for an empty second muscle.",
        ]
    return lines


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
