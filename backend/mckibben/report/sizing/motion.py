"""The run: position, pressure, speed and air over time, and the timing table."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.application.run.simulate import SimulationResult
from mckibben.facts.timing import AIR_FIGURES, PHASES, TIMING
from mckibben.report.chart import chart
from mckibben.report.document import Head, figure_of, mark, paragraph, table
from mckibben.report.figures import Scale, figure, percent
from mckibben.report.html import Child, Html, html
from mckibben.report.marks import ACCENT, EDGE, INK, SECOND, Axis, Line, Mark, Rule
from mckibben.report.sizing.material import Chosen, SizingMaterial
from mckibben.report.sizing.words import BAR, MILLIMETRES
from mckibben.report.summary.simulation import timing_remarks
from mckibben.simulation.timing.table import PhaseFigures, TimingTable

_MOST_ROWS = 420
_AFTER, _LEAST_AFTER = 1.2, 0.02  # shown time: this multiple of the motion, and at least so many s more
_LEAVES = 1e-5  # travel from which the load has started to move [m]
_MILLISECONDS = Scale("ms", 1e-3)
_PANEL = 70.0  # height of a drawing: both strokes stand below the table of the operating points
_SPEED, _FLOW = Scale("mm/s", 1e-3), Scale("g/s", 1e-3)

#: Figures that are those of one muscle times the number of muscles.
_TOGETHER = {"impact_energy", *AIR_FIGURES} - {"choked_share"}

_FOOT = 36.0  # height of the numbers and title of the x axis


class _DrawnPhase(NamedTuple):
    key: str
    begin: float
    end: float
    sign: float


def motion_section(material: SizingMaterial, chosen: Chosen) -> Html:
    """Both phases as drawings, then the table."""
    on, off = chosen.fill
    up = _DrawnPhase("extend", on, off, 1.0)
    back = _DrawnPhase("retract", off, chosen.run.duration, -1.0)
    parts: list[Child] = []
    if chosen.run.message is not None:
        parts.append(paragraph(f"The run did not complete: {chosen.run.message}"))
    for phase in (up, back):
        drawing = _drawing(material, chosen, phase)
        if drawing is not None:
            title = f"{PHASES[phase.key].capitalize()}, from the moment the valve is switched."
            parts.append(figure_of(drawing, title, panels=True))
    if not chosen.proposal.drive.load.mass:
        parts.append(
            paragraph(
                mark("No mass is moved"), " in this task: speeds, accelerations and energies are those of a "
                "practically massless load and have little meaning.",
            )
        )  # fmt: skip
    parts.append(_table(chosen))
    return html(parts)


def _drawing(material: SizingMaterial, chosen: Chosen, phase: _DrawnPhase) -> Html | None:
    run = chosen.run
    time = np.asarray(run.time, dtype=float)
    figures = _of_phase(run.timing, phase.key)
    moved = [time for time in (figures.positioning_time, figures.settling_time) if time is not None]
    whole = phase.end - phase.begin
    shown = min(whole, max(_AFTER * max(moved), max(moved) + _LEAST_AFTER)) if moved else whole
    rows = np.flatnonzero((time >= phase.begin - 1e-12) & (time <= phase.begin + shown))
    if len(rows) < 2:
        return None
    rows = rows[np.unique(np.linspace(0, len(rows) - 1, min(len(rows), _MOST_ROWS)).astype(int))]
    since = _MILLISECONDS.all((time[rows] - phase.begin).tolist())
    rules = _rules(run, phase, rows)

    def column(values: NDArray, scale: Scale) -> list[float]:
        return scale.all(np.asarray(values, dtype=float)[rows].tolist())

    def line(values: NDArray, scale: Scale, label: str = "", colour: str = ACCENT, **more: Any) -> Line:
        return Line(since, column(values, scale), label, colour, **more)

    joint = run.joint

    if joint is not None:
        place = (
            Axis("Angle", "°"),
            Line(since, column(joint.angle, Scale("°", math.pi / 180.0)), ""),
        )
    else:
        place = Axis("Position", "mm"), line(run.position, MILLIMETRES)
    pressures: list[Mark] = [line(run.pressure, BAR, "muscle", ACCENT)]
    if run.tube_pressure is not None:
        pressures.append(line(run.tube_pressure, BAR, "tube", EDGE, width=1.2))
    if joint is not None and joint.counter_pressure is not None:
        second = column(joint.counter_pressure, BAR)
        pressures.append(Line(since, second, "second muscle", SECOND))
    pressures.append(
        Line([since[0], since[-1]], [BAR.of(chosen.proposal.pressure)] * 2, "supply", INK, "2 3")
    )
    bare = [Rule(rule.x, "", rule.colour, rule.dash) for rule in rules]
    return stack(
        Axis("Time", "ms", ends=(0.0, _MILLISECONDS.of(shown))),
        [
            Panel(place[0], [*rules, place[1]], f"{place[0].title} of the load over time"),
            Panel(Axis("Pressure", "bar", zero=True), [*bare, *pressures], "Gauge pressures over time"),
            Panel(Axis("Speed", "mm/s"), [*bare, line(run.velocity, _SPEED)], "Speed of the load over time"),
            Panel(Axis("Air flow", "g/s"), [*bare, line(run.mass_flow, _FLOW)], "Mass flow into a muscle"),
        ],
        height=_PANEL,
    )  # fmt: skip


def _of_phase(timing: TimingTable, key: str) -> PhaseFigures:
    return timing.extend if key == "extend" else timing.retract


def _rules(run: SimulationResult, phase: _DrawnPhase, rows: NDArray) -> list[Rule]:
    """When the load starts, is at 10, 50 and 90 % of its stroke, and arrives."""
    time = np.asarray(run.time, dtype=float)[rows] - phase.begin
    position = np.asarray(run.position, dtype=float)[rows]
    figures = _of_phase(run.timing, phase.key)
    begin, end = (run.limits.position_min, run.limits.position_max)[:: int(phase.sign)]
    stroke = abs(end - begin)
    travel = phase.sign * (position - begin)
    rules: list[Rule] = []

    def at(value: float | None, name: str, colour: str, dash: str) -> None:
        if value is not None:
            shown = _MILLISECONDS.of(value)
            rules.append(Rule(shown, f"{name}: {shown:.3g} ms", colour, dash))

    at(_passes(time, travel, min(_LEAVES, 0.01 * stroke)), "starts", EDGE, "2 3")
    rise = [_passes(time, travel, share * stroke) for share in (0.1, 0.9)]
    at(rise[0], "10 %", EDGE, "6 3")
    at(figures.delay_time, "50 %", INK, "6 3")
    at(rise[1], "90 %", EDGE, "6 3")
    at(figures.positioning_time, "arrives", SECOND, "6 3")
    return rules


def _passes(time: NDArray, travel: NDArray, level: float) -> float | None:
    """First time at which the travel reaches a level, by linear interpolation."""
    there = np.flatnonzero(travel >= level)
    if not len(there):
        return None
    k = int(there[0])
    if k == 0:
        return float(time[0])
    share = (level - travel[k - 1]) / (travel[k] - travel[k - 1])
    return float(time[k - 1] + share * (time[k] - time[k - 1]))


def _table(chosen: Chosen) -> Html:
    timing = chosen.run.timing
    rows: list[list[Child]] = []
    for name, each in TIMING.items():
        values = [getattr(_of_phase(timing, phase), name) for phase in PHASES]
        if all(value is None for value in values):
            continue
        times = chosen.count if name in _TOGETHER else 1
        rows.append([each.label, *(_figure(v, times, each.scale) for v in values)])
    columns = [
        Head("Timing"),
        *(Head(words.capitalize(), number=True) for words in PHASES.values()),
    ]
    caption = "Times are measured from the moment the valve switches."
    if chosen.count > 1:
        caption += f" Energy and air are for all {chosen.count} muscles of a side together."
    return html(
        table(columns, rows, caption=caption),
        [paragraph(f"{note[:1].upper()}{note[1:]}.", note=True) for note in timing_remarks(timing)],
    )


def _figure(value: float | None, times: int, scale: Scale) -> Html:
    if scale.unit == "%":
        return percent(value, 3)
    return figure(None if value is None else value * times, scale)


@dataclass(frozen=True)
class Panel:
    """One of the drawings."""

    axis: Axis
    marks: Sequence[Mark]
    title: str


def stack(
    x: Axis, panels: Sequence[Panel], *, height: float = 84.0, left: float = 84.0, room: float = 150.0
) -> Html:
    """The drawings, with numbers on the x axis of the lowest one.

    Args:
        x: the common axis; its ``ends`` must be given.
        panels: from the top.
        height: of each.
        left: where the axes begin.
        room: width of the legends.
    """
    parts: list[Html] = []
    for number, panel in enumerate(panels):
        last = number == len(panels) - 1
        parts.append(
            chart(
                replace(x, bare=not last),
                panel.axis,
                panel.marks,
                title=panel.title,
                height=height + (_FOOT if last else 0.0),
                left=left,
                legend=True,
                room=room,
            )
        )
    return html(parts)
