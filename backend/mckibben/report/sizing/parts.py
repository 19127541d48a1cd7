"""The parts list, what it still lacks, and every figure that enters with its source."""

from __future__ import annotations

from mckibben.report.document import Head, bullets, heading, mark, paragraph, table
from mckibben.report.figures import plain, pretty
from mckibben.report.html import Child, Html, html
from mckibben.report.sizing.material import Chosen, KnownFigure, Part, SizingMaterial
from mckibben.report.sizing.words import BAR, JOULE, MILLIMETRES
from mckibben.report.sources import grades_table

_HAIR = 1e-6


def parts_section(material: SizingMaterial, chosen: Chosen) -> Html:
    """What to order, and what the sizing does not choose."""
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
            "Titles are those of the presets, no order codes of a shop: connections and lengths are to be "
            "stated with the order.",
            note=True,
        ),
        heading("Needed besides, and not chosen here"),
        bullets(_besides(material, chosen)),
    )


def _kind(part: Part) -> str:
    return f"{part.kind.capitalize()} {part.id}"


def _order(part: Part) -> Child:
    own = " (a preset of your own)" if part.origin == "user" else ""
    maker = "" if not part.maker or part.order.startswith(part.maker) else f", {part.maker}"
    return f"{part.order}{maker}{own}"


def _sources(part: Part) -> str:
    counts: dict[str, int] = {}
    for known in part.figures:
        counts[known.figure.grade] = counts.get(known.figure.grade, 0) + 1
    shown = ", ".join(f"{count} of grade {grade}" for grade, count in sorted(counts.items()))
    return f"{len(part.figures)} figures: {shown}" if shown else "no figure of its own"


def _verified(part: Part) -> Child:
    open_ = [known.name for known in part.figures if not known.figure.verified]
    return html(mark("no"), f": {', '.join(open_)}") if open_ else "yes"


def _besides(material: SizingMaterial, chosen: Chosen) -> list[Child]:
    found = chosen.proposal
    supply = next(entry.value for entry in material.entries if entry.path == "supply_pressure")
    parts: list[Child] = []
    if isinstance(supply, float) and found.pressure < supply * (1.0 - _HAIR):
        parts.append(
            "A pressure regulator before the valve, set to "
            f"{plain(BAR.of(found.pressure), 4, exact=True)} bar: the supply has "
            f"{plain(BAR.of(supply), 4, exact=True)} bar."
        )
    energy = plain(JOULE.of(found.impact_energy), 3)
    back = chosen.run.timing.retract.impact_energy
    lower = "" if back is None else f", on the way back the lower one with {plain(back * chosen.count, 3)} J"
    end = MILLIMETRES.of(found.nominal_length * (1.0 - found.contraction))
    parts += [
        f"End stops: the load meets the upper one with {energy} J, where each pulling muscle is {end:.4g} mm "
        f"long{lower}.",
        "Fittings between valve, tube and muscle, and silencers: their volume and resistance are not in "
        "the run.",
        "End fittings and joints of the muscle, guide of the load, electrics of the valve.",
    ]
    if found.tube is None:
        parts.append("No tube: the valve sits on the muscle.")
    if found.pulley_radius is not None:
        radius = MILLIMETRES.of(found.pulley_radius)
        parts.append(f"The pulley: {radius:.4g} mm of radius, both muscles on it.")
    return parts


def figures_section(chosen: Chosen) -> Html:
    """Every preset figure that enters, and what the grades mean."""
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
    unit = "" if known.unit == "1" else f"\N{NO-BREAK SPACE}{pretty(known.unit)}"
    about: list[Child] = [known.figure.source]
    if known.note:
        about.append(paragraph(known.note, note=True))
    return [
        known.name,
        f"{plain(known.value, 5, exact=True)}{unit}",
        html(about),
        known.figure.grade,
        "yes" if known.figure.verified else mark("no"),
    ]
