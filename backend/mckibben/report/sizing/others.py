"""Alternative drives, and rejected ones with their reasons."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.application.size.size import ExploredDrive, ProposedDrive, RejectedParts
from mckibben.facts.sizing import LIMITS, SIZING
from mckibben.report.chart import chart
from mckibben.report.document import Head, figure_of, paragraph, table
from mckibben.report.figures import plain
from mckibben.report.html import Child, Html, html, tag
from mckibben.report.marks import ACCENT, EDGE, INK, SECOND, Axis, Dots, Mark
from mckibben.report.sizing.material import Chosen, SizingMaterial
from mckibben.report.sizing.words import drive_words, of_proposal, parts_words

_ORDER = "Sorted by the change they would need, the smallest first."
_GROUPED = "One row for each choice of muscles and limit."
_AXES = ("air_volume_anr", "time")
_TOUCHING = 0.03  # share of an axis below which dots share a label
_FAR = 2.0  # times the largest air consumption of the proposals: designs beyond are not drawn


def alternatives_section(material: SizingMaterial, chosen: Chosen) -> Html:
    """Time over air of every design that fulfils the task, and a table of the proposals."""
    explored = material.result.explored
    not_drawn = len(explored) - len(_near(material))
    caption = (
        f"{len(explored)} choices of parts fulfil the task, each shown at its best length and pressure in a "
        "coarse first search. None is at least as good as one on the Pareto front in every aim (air, time, "
        "installed length, force reserve, stiffness) and better in one. Numbers are the "
        "proposals of the table, refined and simulated accurately."
        + (f" {not_drawn} that use more air are not drawn." if not_drawn else "")
    )
    parts: list[Child] = [
        paragraph(material.result.searched),
        figure_of(_picture(material, chosen), caption),
        _proposals(material, chosen),
    ]
    if material.result.message:
        parts.append(paragraph(material.result.message, note=True))
    return html(parts)


def _picture(material: SizingMaterial, chosen: Chosen) -> Html:
    proposals, explored = material.result.proposals, _near(material)
    front = [item for item in explored if item.front]
    rest = [item for item in explored if not item.front]
    marks: list[Mark] = []
    if rest:
        marks.append(Dots(*_places(rest), "fulfils the task", EDGE, 5.0))
    if front:
        marks.append(Dots(*_places(front), SIZING["front"].label, ACCENT, 6.0))
    others = [item for number, item in enumerate(proposals, 1) if number != chosen.rank]
    names = _names(proposals, explored, chosen.rank)
    chosen_name = names.pop(chosen.rank)
    if others:
        marks.append(Dots(*_places(others), "other proposals", INK, 7.0, [names[n] for n in sorted(names)]))
    place = _places([chosen.proposal])
    marks.append(Dots(*place, f"proposal {chosen.rank}", SECOND, 11.0, [chosen_name]))
    return chart(
        *map(_axis, _AXES),
        marks,
        title="Time over air of the designs that fulfil the task", height=280.0, room=140.0,
    )  # fmt: skip


def _axis(name: str) -> Axis:
    """That of a figure; its unit says ANR."""
    each = SIZING[name]
    return Axis(each.label.removesuffix(" (ANR)"), each.scale.unit, zero=True)


def _names(proposals: list[ProposedDrive], explored: list[ExploredDrive], rank: int) -> dict[int, str]:
    """Rank -> label of its dot; of overlapping dots one shows all ranks, preferably the chosen one."""
    x, y = _places(proposals)
    wide, high = (_TOUCHING * max(values) for values in _places([*proposals, *explored]))
    left = set(range(len(proposals)))
    names: dict[int, str] = {}
    for one in sorted(left, key=lambda number: number + 1 != rank):
        here = [n for n in sorted(left) if abs(x[n] - x[one]) < wide and abs(y[n] - y[one]) < high]
        labelled = here if one in left else []
        names[one + 1] = ", ".join(f"{number + 1}" for number in labelled)
        left -= set(labelled)
    return names


def _near(material: SizingMaterial) -> list[ExploredDrive]:
    """Explored designs that use at most `_FAR` times the air of the proposals."""
    most = _FAR * max(item.air_volume_anr for item in material.result.proposals)
    return [item for item in material.result.explored if item.air_volume_anr <= most]


def _places(items: Sequence[ProposedDrive | ExploredDrive]) -> tuple[list[float], list[float]]:
    return (
        SIZING[_AXES[0]].scale.all([item.air_volume_anr for item in items]),
        SIZING[_AXES[1]].scale.all([item.time for item in items]),
    )


def _proposals(material: SizingMaterial, chosen: Chosen) -> Html:
    columns = [
        Head("", number=True), Head("Drive", wide=True),
        *(Head(SIZING[name].label, number=True) for name in ("pressure", *_AXES[::-1])),
        Head(f"{SIZING['probability'].label} ± {SIZING['probability_error'].words}", number=True),
        Head("Reason for its rank", wide=True),
    ]  # fmt: skip
    rows: list[list[Child]] = []
    for number, item in enumerate(material.result.proposals, 1):
        name: list[Child] = [drive_words(item), tag("br"), parts_words(item)]
        rows.append(
            [
                tag("b", f"{number}") if number == chosen.rank else f"{number}",
                tag("b", name) if number == chosen.rank else html(name),
                *(of_proposal(item, name) for name in ("pressure", *_AXES[::-1])),
                _likely(item),
                item.reason,
            ]
        )
    return table(columns, rows, caption="Proposals, best first; this report describes the one in bold.")


def _likely(item: ProposedDrive) -> Child:
    if item.probability is None or item.probability_error is None:
        return "–"
    return html(of_proposal(item, "probability"), f" ± {plain(100.0 * item.probability_error, 2)}")


def rejected_section(material: SizingMaterial) -> Html:
    """Rejected parts: reason, violated limit, and what would help; a row per choice of muscles and limit."""
    rejected = material.result.rejected
    if not rejected:
        some = material.result.proposals
        return paragraph(f"{'Every' if some else 'No'} choice of parts that was tried fulfils the task.")
    groups: dict[tuple[str, int, str], list[RejectedParts]] = {}
    for item in rejected:
        groups.setdefault((item.muscle, item.parallel, item.binding), []).append(item)
    columns = [
        Head("Reason", wide=True),
        Head("Violated limit"),
        Head("What would help", wide=True),
    ]
    rows = [
        [_why(items), LIMITS[binding].words, items[0].would_work_if]
        for (_, _, binding), items in groups.items()
    ]
    return table(columns, rows, caption=f"{_ORDER} {_GROUPED}", whole=False)


def _why(items: list[RejectedParts]) -> Html:
    more = len(items) - 1
    others = f" And {more} more with other valves and tubes." if more else ""
    return html(f"{items[0].why}.{others}")
