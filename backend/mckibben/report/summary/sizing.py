"""Summary of a sizing: the proposals, and why the other parts were rejected."""

from __future__ import annotations

from mckibben.application.size.size import SizingResult, nothing_words
from mckibben.application.size.task import heading_of
from mckibben.report.summary.parts import Summary, Table, figure

_REJECTED_SHOWN = 12


def summary_of(result: SizingResult, name: str) -> Summary:
    """Proposals, the reason of the first, rejections, notices.

    Args:
        result: the sizing.
        name: of the task, beside its figures in the title.
    """
    shown = result.rejected[:_REJECTED_SHOWN]
    others = len(result.rejected) - len(shown)
    return [
        proposal_table(result, name),
        *([result.ranking] if result.proposals and result.ranking is not None else []),
        *(
            f"– {item.why} [{item.binding.replace('_', ' ')}]; it would work with {item.would_work_if}"
            for item in shown
        ),
        *([f"– and {others} further choices of parts"] if others else []),
        *notices(result),
    ]


def notices(result: SizingResult) -> list[str]:
    """Notices about task and parts, and why the search did not complete."""
    ended = [] if result.message is None else [result.message]
    return [*(notice.message for notice in result.flags), *ended]


def proposal_table(result: SizingResult, name: str) -> Table:
    """The proposals, the best first."""
    rows = [
        [
            f"{item.parallel} × {item.muscle}" if item.parallel > 1 else item.muscle,
            figure(item.nominal_length * 1e3, unit=" mm"),
            item.valve,
            item.tube or "–",
            figure(item.pressure / 1e5, 3, " bar"),
            figure(item.time, 3, " s"),
            figure(item.contraction * 100.0, 3, " %"),
            figure(item.force_reserve * 100.0, 3, " %"),
            figure(item.air_volume_anr * 1e3, 3, " l"),
            figure(item.impact_energy, 3, " J"),
            "–" if item.probability is None else figure(item.probability * 100.0, 3, " %"),
            figure(item.margins[item.binding] * 100.0, 2, " %"),
            item.binding.replace("_", " "),
        ]
        for item in result.proposals
    ]
    header = [
        "muscle", "length", "valve", "tube", "supply", "time", "contraction", "force reserve",
        "air per cycle", "impact", "probability", "margin", "nearest limit",
    ]  # fmt: skip
    counted = f"{result.combinations} combinations, {result.simulated} simulated"
    heading = heading_of(result.about, name)
    if not rows:
        return Table(f"{heading}: {nothing_words(result)} ({counted})", ["no drive"], [])
    found = "drives" if result.outcome == "completed" else "drives found so far"
    return Table(f"{heading}: {found}, best first ({counted})", header, rows)
