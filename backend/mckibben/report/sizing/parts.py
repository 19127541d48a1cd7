"""The parts list, further parts needed, and every figure used with its source."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from mckibben.documents.drive_parts import ENTERING
from mckibben.documents.studio import Studio
from mckibben.documents.value_names import value_words
from mckibben.physics.effect import Effect
from mckibben.presets import Preset
from mckibben.presets.order_code import begin_of_order_code
from mckibben.presets.quantity import Quantity, quantities
from mckibben.report.document import Head, bullets, heading, mark, paragraph, table
from mckibben.report.figures import plain, pretty
from mckibben.report.html import Child, Html, html
from mckibben.report.sizing.material import Chosen, KnownFigure, Part, SizingMaterial
from mckibben.report.sizing.words import BAR, MILLIMETRES, of_proposal
from mckibben.report.sources import Figure, grades_table
from mckibben.sizing import Design

_HAIR = 1e-6
_LONG = 200  # letters of a remark that may be broken between two pages
#: Units of presets as the rest of the report writes them, with the space before them.
_UNITS = {"deg": "°", "degC": "\N{NO-BREAK SPACE}°C", "MPa": "\N{NO-BREAK SPACE}N/mm²"}

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


def parts_section(material: SizingMaterial, chosen: Chosen) -> Html:
    """Parts to order, and parts the sizing does not choose."""
    columns = [
        Head("Number", number=True), Head("Part"), Head("To order"), Head("Sources"),
        Head("Verified"),
    ]  # fmt: skip
    rows = [
        [f"{part.number}", _kind(part), _order(part), _sources(part), _verified(part)]
        for part in chosen.parts
    ]
    return html(
        table(columns, rows),
        paragraph(
            "An order code goes on with membrane and connections; other titles are those of the presets, "
            "not order codes: state connections and lengths with the order.",
            note=True,
        ),
        heading("Also needed, not chosen here"),
        bullets(_further_parts(material, chosen)),
    )


def _kind(part: Part) -> str:
    return f"{part.kind.capitalize()} {part.id}"


def _order(part: Part) -> Child:
    remark = " (your own preset)" if part.origin == "user" else ""
    maker = "" if not part.maker or part.order.startswith(part.maker) else f", {part.maker}"
    code = f"; order code {part.code}-…" if part.code else ""
    return f"{part.order}{maker}{remark}{code}"


def _sources(part: Part) -> str:
    counts: dict[str, int] = {}
    for known in part.figures:
        counts[known.figure.grade] = counts.get(known.figure.grade, 0) + 1
    shown = ", ".join(f"{count} of grade {grade}" for grade, count in sorted(counts.items()))
    return f"{len(part.figures)} figures: {shown}" if shown else "no figures"


def _verified(part: Part) -> Child:
    unverified = [known.name for known in part.figures if not known.figure.verified]
    return html(mark("no"), f": {', '.join(unverified)}") if unverified else "yes"


def _further_parts(material: SizingMaterial, chosen: Chosen) -> list[Child]:
    proposal = chosen.proposal
    supply = next(entry.value for entry in material.entries if entry.path == "supply_pressure")
    parts: list[Child] = []
    if isinstance(supply, float) and proposal.pressure < supply * (1.0 - _HAIR):
        parts.append(
            "A pressure regulator upstream of the valve, set to "
            f"{plain(BAR.of(proposal.pressure), 4, exact=True)} bar; the supply has "
            f"{plain(BAR.of(supply), 4, exact=True)} bar."
        )
    lower_stop: list[Child] = []
    if proposal.impact_energy_return:
        lower_stop = ["; on return, the lower one with ", of_proposal(proposal, "impact_energy_return")]
    end = MILLIMETRES.of(proposal.nominal_length * (1.0 - proposal.contraction))
    parts += [
        html(
            "End stops: the load hits the upper one with ",
            of_proposal(proposal, "impact_energy_stroke"),
            f", where each pulling muscle is {end:.4g} mm long",
            lower_stop,
            ".",
        ),
        "Fittings between valve, tube and muscle, and silencers: the run neglects their volume and "
        "resistance.",
        "End fittings and joints of the muscle, a guide for the load, wiring of the valve.",
    ]
    if proposal.tube is None:
        parts.append("No tube: the valve is mounted on the muscle.")
    if proposal.pulley_radius is not None:
        radius = MILLIMETRES.of(proposal.pulley_radius)
        parts.append(f"A pulley of {radius:.4g} mm radius, which both muscles drive.")
    return parts


def figures_section(chosen: Chosen) -> Html:
    """Every preset figure used, and what the grades mean."""
    columns = [
        Head("Figure"), Head("Value", number=True), Head("Source"), Head("Grade"), Head("Verified"),
    ]  # fmt: skip
    parts: list[Child] = [grades_table()]
    for part in chosen.parts:
        parts += [
            heading(f"{_kind(part)}"),
            table(columns, [_row(known) for known in part.figures], whole=False),
        ]
        parts += [paragraph(reference, note=True) for reference in part.references]
    return html(parts)


def _row(known: KnownFigure) -> list[Child]:
    unit = "" if known.unit == "1" else _UNITS.get(known.unit) or f"\N{NO-BREAK SPACE}{pretty(known.unit)}"
    about: list[Child] = [known.figure.source]
    if known.note:
        about.append(paragraph(known.note, note=True, long=len(known.note) > _LONG))
    return [
        known.name,
        f"{plain(known.value, 5, exact=True)}{unit}",
        html(about),
        known.figure.grade,
        "yes" if known.figure.verified else mark("no"),
    ]


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
