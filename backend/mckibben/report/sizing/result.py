"""The result: the proposed drive, how well it fulfils the task, unverified figures."""

from __future__ import annotations

from mckibben.application.size.size import nothing_words
from mckibben.documents.task import TaskOperation
from mckibben.facts.sizing import LIMITS, SEARCH, SIZING
from mckibben.report.document import Tone, bullets, callout, paragraph, tiles
from mckibben.report.figures import percent
from mckibben.report.html import Child, Html, html
from mckibben.report.sizing.material import Chosen, SizingMaterial
from mckibben.report.sizing.words import AMPLE, drive_words, of_proposal, parts_words, pressure_words

_GOOD, _FAIR = 0.9, 0.5  # probabilities from which the result is shown as good, or with a warning
_USED_UP = 0.005  # margin below which a limit counts as used up


def result_section(material: SizingMaterial) -> Html:
    """The reported proposal, or that there is none."""
    if material.chosen is None:
        return _nothing(material)
    return _proposal(material, material.chosen)


def _proposal(material: SizingMaterial, chosen: Chosen) -> Html:
    proposal = chosen.proposal
    probability = proposal.probability
    tone: Tone = "plain"
    if probability is not None:
        tone = "good" if probability >= _GOOD else "warn" if probability >= _FAIR else "bad"
    count = len(material.result.proposals)
    rank = f"Proposal {chosen.rank} of {count}" if count > 1 else "The only proposal"
    parts: list[Child] = [
        paragraph(f"Task: {material.result.about}."),
        *_left_out(material),
        callout(
            f"{drive_words(proposal)}, with {parts_words(proposal)} at {pressure_words(proposal)}",
            f"{rank}: {proposal.reason}.",
            _chance_words(chosen),
            tone=tone,
        ),
        tiles(_tiles(chosen, material.operation)),
    ]
    if chosen.rank == 1 and material.result.ranking:
        parts.append(paragraph(material.result.ranking))
    remarks = [*proposal.notes, *_crossed(chosen)]
    if remarks:
        parts.append(bullets(remarks))
    parts.append(_unverified(chosen))
    return html(parts)


def _tiles(chosen: Chosen, operation: TaskOperation) -> list[tuple[Child, Child]]:
    proposal = chosen.proposal
    nearest = chosen.margins[0]
    names = ["time", "time_down", "pressure", "air_volume_anr"]
    if proposal.probability is not None:
        names.insert(0, "probability")
    pairs: list[tuple[Child, Child]] = [(SIZING[name].label, of_proposal(proposal, name)) for name in names]
    cost = SIZING["air_cost"]
    pairs += [
        (
            f"{cost.label} {cost.scale.unit}",
            f"{cost.scale.of(proposal.air_cost):.3g} {operation.currency}",
        ),
        (
            f"{SIZING['air_cost_year'].label} ({operation.cycles_per_year:,.0f} cycles)",
            f"{proposal.air_cost_year:.3g} {operation.currency}",
        ),
        (
            SIZING["force_reserve"].label,
            "ample" if proposal.force_reserve > AMPLE else of_proposal(proposal, "force_reserve"),
        ),
    ]
    names = ["impact_energy_stroke", "impact_energy_return", "installed_length", "outer_diameter"]
    pairs += [(SIZING[name].label, of_proposal(proposal, name)) for name in names]
    remaining = percent(max(nearest.share, 0.0)) if nearest.share > _USED_UP else "used up"
    pairs.append((f"{SIZING['binding'].label}: {LIMITS[nearest.name].words}", remaining))
    return pairs


def _chance_words(chosen: Chosen) -> str:
    proposal = chosen.proposal
    if proposal.probability is None or proposal.probability_error is None:
        return "No specimens were simulated: how many built drives would fulfil the task is unknown."
    share, error = 100.0 * proposal.probability, 100.0 * proposal.probability_error
    return (
        f"Of {proposal.specimens} simulated specimens {share:.3g} % succeed (standard error {error:.2g} %): "
        "they reach the end of the stroke in time and stay there. Section “Uncertainty” says what varies."
    )


def _crossed(chosen: Chosen) -> list[str]:
    """Limits exceeded during the run."""
    return [
        f"The run exceeds a limit: {flag.message}."
        for flag in chosen.run.flags
        if flag.code.startswith("over_")
    ]


def _unverified(chosen: Chosen) -> Html:
    figures = [known for part in chosen.parts for known in part.figures]
    unverified = [known for known in figures if not known.figure.verified]
    if not unverified:
        return callout("Every preset figure used was read in a source or computed from one")
    texts = [
        f"{part.id}: {', '.join(names)}"
        for part in chosen.parts
        if (names := [known.name for known in part.figures if not known.figure.verified])
    ]
    return callout(
        f"{len(unverified)} of {len(figures)} preset figures used are not verified",
        "General knowledge or estimates (grades M and E). Check them against data sheets before ordering; "
        "the times depend on the flow of the valve and the bore of the tube.",
        *(f"{text}." for text in texts),
        tone="warn",
    )


def _nothing(material: SizingMaterial) -> Html:
    rejected = material.result.rejected
    hints: list[Child] = []
    if rejected:
        nearest = rejected[0]
        if nearest.would_work_if.startswith("nothing"):
            if material.result.outcome == "completed":
                hints = ["Neither relaxing a single limit nor another part of the catalogue would help."]
        else:
            hints = [f"Closest: {nearest.why}.", f"It would work with {nearest.would_work_if}."]
    words = nothing_words(material.result)
    parts: list[Child] = [
        paragraph(f"Task: {material.result.about}."),
        *_left_out(material),
        callout(f"{words[:1].upper()}{words[1:]}", *hints, tone="bad"),
    ]
    tiles_: list[tuple[Child, Child]] = [
        (SEARCH[name].label, f"{getattr(material.result, name)}")
        for name in ("combinations", "pruned", "simulated")
    ]
    parts.append(tiles(tiles_))
    return html(parts)


def _left_out(material: SizingMaterial) -> list[Html]:
    """What the search did not try, before anything that it found."""
    message = material.result.message
    return [] if message is None else [callout("Not everything was tried", message, tone="warn")]
