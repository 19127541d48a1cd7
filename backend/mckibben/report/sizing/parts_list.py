"""The parts of a proposal, and the sources of their figures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from mckibben.documents.drive_parts import ENTERING
from mckibben.documents.studio import Studio
from mckibben.documents.value_names import value_words
from mckibben.physics.effect import Effect
from mckibben.presets import Preset
from mckibben.presets.order_code import begin_of_order_code
from mckibben.presets.quantity import Quantity, quantities
from mckibben.report.sizing.material import KnownFigure, Part
from mckibben.report.sources import Figure
from mckibben.sizing import Design

# Figures of a muscle preset used in a sizing; the rest length is chosen by the search.
_OF_MUSCLE = (
    "geometry.",
    "effects.",
    "limits.",
    "data.max_hysteresis",
    "data.min_temperature",
    "data.max_temperature",
)
_CHOSEN = "geometry.nominal_length"
_OF_PART = ("effects.", "data.max_pressure", *(f"data.{name}" for name in ENTERING))


def parts_of(design: Design, studio: Studio) -> list[Part]:
    """The parts list of a design."""
    group, library = design.group, studio.library
    muscle = library.muscle(group.muscle.id)
    valve = library.get("valves", group.valve.id)
    length = f"rest length {design.length * 1e3:.4g} mm"
    code = begin_of_order_code(preset=muscle.id, length=design.length)
    parts = [
        _part("muscle", muscle, group.muscles, f"{muscle.title}, {length}", studio.catalogue, code),
        _part("valve", valve, 2 if group.duty.pair else 1, valve.title, studio.catalogue),
    ]
    tube = group.tube.tube
    if tube is not None:
        preset = library.get("tubes", group.tube.id)
        order = f"{preset.title}, {tube.length * 1e3:.4g} mm each"
        parts.append(_part("tube", preset, group.muscles, order, studio.catalogue))
    return parts


def _part(
    kind: str,
    preset: Preset,
    number: int,
    order: str,
    catalogue: Mapping[str, Effect],
    code: str | None = None,
) -> Part:
    return Part(
        kind=kind,
        id=preset.id,
        number=number,
        order=order,
        code=code,
        maker=preset.maker,
        origin=preset.origin,
        figures=[
            KnownFigure(
                _figure_name(path, catalogue), figure.value, figure.unit, _source(figure), figure.note or ""
            )
            for path, figure in quantities(preset)
            if _enters(path, kind)
        ],
        references=preset.references,
    )


def _enters(path: str, kind: str) -> bool:
    if kind == "muscle":
        return path != _CHOSEN and path.startswith(_OF_MUSCLE)
    return path.startswith("effects.") or path in _OF_PART


def _figure_name(path: str, catalogue: Mapping[str, Effect]) -> str:
    section, _, name = path.rpartition(".")
    words = value_words(name)
    if not section.startswith("effects."):
        return words
    return f"{catalogue[section.removeprefix('effects.')].title}: {words}"


def _source(quantity: Quantity) -> Figure:
    return Figure(quantity.source, quantity.grade)


def effect_figures(
    design: Design, studio: Studio, effects: Mapping[str, Mapping[str, float]]
) -> Iterator[tuple[str, Figure]]:
    """ "effect.parameter" -> source of its value in the run: a preset, or the catalogue's default."""
    group, library = design.group, studio.library
    known: dict[str, tuple[str, Quantity]] = {}
    presets = [library.muscle(group.muscle.id), library.get("valves", group.valve.id)]
    if group.tube.tube is not None:
        presets.append(library.get("tubes", group.tube.id))
    for preset in presets:  # a later part replaces the effect of an earlier one, as in the run
        for path, quantity in quantities(preset):
            if path.startswith("effects."):
                known[path.removeprefix("effects.")] = preset.id, quantity
    for effect, values in effects.items():
        for parameter in studio.catalogue[effect].parameters:
            name = f"{effect}.{parameter.name}"
            if parameter.name not in values:
                continue
            if name in known:
                preset_id, quantity = known[name]
                yield name, Figure(f"{preset_id}: {quantity.source}", quantity.grade)
            else:
                yield name, Figure(f"default: {parameter.source.text}", parameter.source.grade)
