"""The answer first: what is built, how well it does the task, what it rests on."""

from __future__ import annotations

from mckibben.report.document import Tone, bullets, callout, paragraph, tiles
from mckibben.report.figures import figure, percent, plain
from mckibben.report.html import Child, Html, html
from mckibben.report.sizing.material import Chosen, SizingMaterial
from mckibben.report.sizing.words import (
    AMPLE,
    BAR,
    JOULE,
    LITRES,
    MILLIMETRES,
    SECONDS,
    drive_words,
    limit_name,
    parts_words,
)

_LIKELY, _EVEN = 0.9, 0.5
_NONE_LEFT = 0.005


def result_section(material: SizingMaterial) -> Html:
    """The proposal that is written down, or that there is none."""
    if material.chosen is None:
        return _nothing(material)
    return _proposal(material, material.chosen)


def _proposal(material: SizingMaterial, chosen: Chosen) -> Html:
    found = chosen.proposal
    likely = found.probability
    tone: Tone = "plain"
    if likely is not None:
        tone = "good" if likely >= _LIKELY else "warn" if likely >= _EVEN else "bad"
    count = len(material.result.proposals)
    rank = f"Proposal {chosen.rank} of {count}" if count > 1 else "The only proposal"
    parts: list[Child] = [
        paragraph(f"Task: {material.about}."),
        callout(
            f"{drive_words(found)}, with {parts_words(found)} at {plain(BAR.of(found.pressure), 3)} bar",
            f"{rank}: {found.reason}.",
            _chance_words(chosen),
            tone=tone,
        ),
        tiles(_tiles(chosen)),
    ]
    remarks = [*found.notes, *_crossed(chosen)]
    if material.result.message:
        remarks.append(material.result.message)
    if remarks:
        parts.append(bullets(remarks))
    parts.append(_unverified(chosen))
    return html(parts)


def _tiles(chosen: Chosen) -> list[tuple[Child, Child]]:
    found = chosen.proposal
    nearest = chosen.margins[0]
    pairs: list[tuple[Child, Child]] = [
        ("Time for the stroke", figure(found.time, SECONDS, 3)),
        ("Way back", figure(found.time_down, SECONDS, 3)),
        ("Supply pressure", figure(found.pressure, BAR, 3)),
        ("Air a cycle (ANR)", figure(found.air_volume_anr, LITRES, 3)),
        (
            "Force reserve at rest",
            "ample" if found.force_reserve > AMPLE else percent(found.force_reserve, 3),
        ),
        ("Energy on the end stop", figure(found.impact_energy, JOULE, 3)),
        ("Installed length", figure(found.installed_length, MILLIMETRES, 4)),
        ("Outer diameter", figure(found.diameter, MILLIMETRES, 3)),
    ]
    if found.probability is not None:
        pairs.insert(0, ("Does the task", percent(found.probability, 3)))
    left = percent(max(nearest.share, 0.0)) if nearest.share > _NONE_LEFT else "used up"
    pairs.append((f"Nearest limit: {limit_name(nearest.name).lower()}", left))
    return pairs


def _chance_words(chosen: Chosen) -> str:
    found = chosen.proposal
    if found.probability is None or found.probability_error is None:
        return "No specimens were asked for: how likely it does the task when it is built is not known."
    share, error = 100.0 * found.probability, 100.0 * found.probability_error
    return (
        f"Of {found.specimens} simulated specimens {share:.3g} % do the task (standard error {error:.2g} "
        "%); section “Uncertainty” says what varies between them and what does not."
    )


def _crossed(chosen: Chosen) -> list[str]:
    """Limits that the run crosses anywhere."""
    return [
        f"The run crosses a limit: {flag.message}."
        for flag in chosen.run.flags
        if flag.code.startswith("over_")
    ]


def _unverified(chosen: Chosen) -> Html:
    every = [known for part in chosen.parts for known in part.figures]
    open_ = [known for known in every if not known.figure.verified]
    if not open_:
        return callout("Every preset figure that enters was read in a source or computed from one")
    texts = [
        f"{part.id}: {', '.join(names)}"
        for part in chosen.parts
        if (names := [known.name for known in part.figures if not known.figure.verified])
    ]
    return callout(
        f"{len(open_)} of {len(every)} preset figures that enter are not verified",
        "General knowledge or estimates (grades M and E). Check them against data sheets before ordering; "
        "the times rest on the flow of the valve and the bore of the tube.",
        *(f"{text}." for text in texts),
        tone="warn",
    )


def _nothing(material: SizingMaterial) -> Html:
    rejected = material.result.rejected
    words: list[Child] = []
    if rejected:
        nearest = rejected[0]
        if nearest.would_work_if.startswith("nothing"):
            words = ["No limit moved by itself, and no other part of the catalogue, would make it do."]
        else:
            words = [f"Nearest: {nearest.why}.", f"It would do with {nearest.would_work_if}."]
    parts: list[Child] = [
        paragraph(f"Task: {material.about}."),
        callout("Nothing in the catalogue does this task", *words, tone="bad"),
    ]
    tiles_: list[tuple[Child, Child]] = [
        ("Combinations", f"{material.result.combinations}"),
        ("Sorted out in closed form", f"{material.result.pruned}"),
        ("Simulated", f"{material.result.simulated}"),
    ]
    parts.append(tiles(tiles_))
    if material.result.message:
        parts.append(callout(material.result.message, tone="warn"))
    return html(parts)
