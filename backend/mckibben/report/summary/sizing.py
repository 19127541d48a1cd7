"""Summary of a sizing: the proposals, and why the other parts were rejected."""

from __future__ import annotations

from mckibben.application.size.size import SizingResult, nothing_words
from mckibben.application.size.task import heading_of
from mckibben.facts.figure import Figure
from mckibben.facts.sizing import LIMITS, SIZING
from mckibben.report.summary import Summary, Table, figure

_REJECTED_SHOWN = 12
_FIGURES = (
    "nominal_length", "pressure", "time", "contraction", "force_reserve", "air_volume_anr", "impact_energy",
    "probability",
)  # fmt: skip


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
        result.searched,
        *([result.ranking] if result.proposals and result.ranking is not None else []),
        *(
            f"– {item.why} [{LIMITS[item.binding].words}]; it would work with {item.would_work_if}"
            for item in shown
        ),
        *([f"– and {others} further choices of parts"] if others else []),
        *notices(result),
    ]


def notices(result: SizingResult) -> list[str]:
    """Notices about task and parts, and why the search did not complete."""
    ended = [] if result.message is None else [result.message]
    return [*(notice.message for notice in result.flags), *ended]


def _shown(value: float | None, each: Figure, digits: int = 3) -> str:
    return figure(None if value is None else each.scale.of(value), digits, f" {each.scale.unit}")


def proposal_table(result: SizingResult, name: str) -> Table:
    """The proposals, the best first."""
    rows = [
        [
            f"{item.parallel} × {item.muscle}" if item.parallel > 1 else item.muscle,
            item.valve,
            item.tube or "–",
            *(_shown(getattr(item, name), SIZING[name]) for name in _FIGURES),
            _shown(item.margins[item.binding], SIZING["margins"], 2),
            LIMITS[item.binding].words,
        ]
        for item in result.proposals
    ]
    header = [
        "muscle", "valve", "tube",
        *(SIZING[name].words for name in (*_FIGURES, "margins", "binding")),
    ]  # fmt: skip
    heading = heading_of(result.about, name)
    if not rows:
        return Table(f"{heading}: {nothing_words(result)}", ["no drive"], [])
    found = "drives" if result.outcome == "completed" else "drives found so far"
    return Table(f"{heading}: {found}, best first", header, rows)
