"""The task as it was given, what was assumed besides, and what the computation leaves out."""

from __future__ import annotations

import re

from mckibben.report.document import Head, bullets, heading, paragraph, table
from mckibben.report.html import Child, Html, html
from mckibben.report.sizing.material import Chosen, Entry, SizingMaterial
from mckibben.report.sizing.words import entry_value, field_name

_WHOLE = frozenset({"load.force_over_stroke"})  # what the run makes of it belongs to the task


def task_section(material: SizingMaterial) -> Html:
    """What the task says."""
    rows = [
        [field_name(entry.path), entry_value(entry), _meaning(entry)]
        for entry in material.entries
        if entry.given
    ]
    open_ = [entry for entry in material.entries if not entry.given and entry.value is None]
    parts: list[Child] = [
        table([Head("Given"), Head("Value"), Head("What it is")], rows),
    ]
    if open_:
        names = ", ".join(field_name(entry.path).lower() for entry in open_)
        parts.append(paragraph(f"Not part of the task: {names}.", note=True))
    return html(parts)


def _meaning(entry: Entry) -> str:
    """The description without the reason for the usual value."""
    if entry.path in _WHOLE:
        return entry.about
    first = re.split(r"(?<=[.])\s", entry.about, maxsplit=1)[0]
    return "" if ":" in first else first


def assumptions_section(material: SizingMaterial) -> Html:
    """What was assumed because the task does not say it, and what the computation leaves out."""
    rows = [
        [field_name(entry.path), entry_value(entry), entry.about]
        for entry in material.entries
        if not entry.given and entry.value is not None
    ]
    columns = [
        Head("Assumed"),
        Head("Value"),
        Head("What it is, and why this value", wide=True),
    ]
    parts: list[Child] = [
        heading("What the task does not say"),
        table(columns, rows) if rows else paragraph("The task says everything."),
        heading("What the computation approximates"),
        bullets(_approximations(material)),
    ]
    return html(parts)


def _approximations(material: SizingMaterial) -> list[str]:
    chosen = material.chosen
    found = [
        "Forces at rest come from the static model with the muscle's own effects; "
        "they are those while the muscle fills, with its friction. A loop that is wider than that of the "
        "model enters the specimens of the probability only.",
        "Times come from a run of the drive: choked and subsonic flow through valve and tube, polytropic "
        "gas, a rigid load between two end stops. The valve fills or vents with its whole flow; nothing "
        "slows the load before the stop.",
        "The mass of the muscle, the volume of fittings and silencers and their resistance are not counted.",
        "Creep, relaxation, temperature in operation, wear and ageing are left out.",
        "The length of the end fittings counts only as far as the task states it.",
        "The life is general knowledge, not a maker's curve: 10⁷ load cycles without load, 10⁵ at the full "
        "force or contraction that the maker allows, by powers of ten between.",
    ]
    if material.profile[0]:
        found.insert(
            1,
            "The force over the stroke enters the figures at rest as it is. The run, and with it all times, "
            "the air and the probability, take the lowest straight line that is nowhere below it and does "
            "not fall: they are on the safe side for the force, not exact.",
        )
    if chosen is None:
        return found
    found += _of_drive(material, chosen)
    return found


def _of_drive(material: SizingMaterial, chosen: Chosen) -> list[str]:
    found = [f"The polytropic exponent of the air is {chosen.gas:.3g} (1 isothermal, 1.4 adiabatic)."]
    if chosen.count > 1:
        found.append(
            f"The {chosen.count} parallel muscles are taken as equal and loaded alike: the run is that of "
            "one with its share of the load and of the valve's flow. Unequal muscles carry unequal shares."
        )
    if material.pair:
        found += [
            "Both muscles of the pair are at their nominal length at the far end of their swing. The run "
            "first fills the second muscle, then swings; the reserve at rest counts the empty second "
            "muscle, in the run its air still vents.",
            "The stiffness is that with the second muscle empty.",
        ]
    return found
