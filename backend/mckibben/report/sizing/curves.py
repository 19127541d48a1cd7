"""Force over contraction with the load and the operating points."""

from __future__ import annotations

import math

import numpy as np

from mckibben.facts.sizing import SIZING
from mckibben.report.chart import chart, family
from mckibben.report.document import Head, figure_of, paragraph, table
from mckibben.report.figures import figure, plain
from mckibben.report.html import Child, Html, html
from mckibben.report.marks import EDGE, INK, SECOND, Axis, Dots, Line, Mark, Rule
from mckibben.report.sizing.material import Chosen, SizingMaterial
from mckibben.report.sizing.words import AMPLE, BAR, MILLIMETRES, NEWTON, SHARE, of_proposal

_FEW_ROWS = 300
_HEIGHT = 330.0
_ROOM = 0.1  # share of the highest force that a name below a point needs


def curves_section(material: SizingMaterial, chosen: Chosen) -> Html:
    """Force curves of one muscle, its load, and a table of operating points."""
    one_only = chosen.proposal.muscles == 1
    who = "the muscle" if one_only else "one muscle"
    caption = (
        f"Static force of {who} over its contraction at several gauge pressures (while it shortens), the "
        "force the task demands over the stroke, and the simulated path from the start of filling to the "
        "end stop. The point above the load at the end of the stroke is the force at supply pressure."
    )
    if chosen.curves.run:
        caption += " Times and air come from a run with the dashed linear load."
    return html(
        figure_of(_drawing(chosen), caption),
        _table(material, chosen, who),
        paragraph(
            "At the end of the stroke: ",
            [
                html(SIZING[name].words, " ", of_proposal(chosen.proposal, name), end)
                for name, end in (("stiffness", "; "), ("stiffness_closed", "."))
            ],
        ),
    )


def _drawing(chosen: Chosen) -> Html:
    curves, reach = chosen.curves, chosen.proposal.contraction
    across = SHARE.all(curves.contraction)
    marks: list[Mark] = []
    colours = family(len(curves.pressures))
    for pressure, force, colour in zip(curves.pressures, curves.force, colours, strict=True):
        supply = pressure == curves.pressures[-1]
        shown = [value if value > 0.0 else math.nan for value in force]
        label = f"{plain(BAR.of(pressure), 3, exact=True)} bar{', supply' if supply else ''}"
        marks.append(Line(across, shown, label, colour, width=2.4 if supply else 1.5))
    marks.append(_path(chosen))
    places = SHARE.all(curves.places)
    marks.append(Line(places, curves.demand, "load", SECOND, width=2.4))
    if curves.run:
        marks.append(Line(places, curves.run, "load in the run", SECOND, "6 4"))
    available = float(np.interp(reach, curves.contraction, curves.force[-1]))
    carrying = [f"{plain(BAR.of(value), 3)} bar" for value in curves.carrying]
    for end, position in ((0, "start"), (-1, "end")):
        name = f"{position}: {carrying[end]}"
        place, force = [places[end]], [curves.demand[end]]
        below = end == 0 and force[0] > _ROOM * max(curves.force[-1])
        marks.append(Dots(place, force, "operating points", SECOND, 9.0, [name], below=below))
    marks += [
        Dots([places[-1]], [available], "at supply pressure", INK, 8.0, [f"{plain(available, 3)} N"]),
        Rule(SHARE.of(reach), "end of the stroke"),
    ]
    return chart(
        Axis("Contraction", "%", zero=True), Axis("Force of one muscle", "N", zero=True), marks,
        title="Force over contraction with load and operating points", height=_HEIGHT, room=150.0,
    )  # fmt: skip


def _path(chosen: Chosen) -> Line:
    """Tension over contraction from the start of filling to the end stop."""
    run, (on, off) = chosen.run, chosen.fill
    time = np.asarray(run.time, dtype=float)
    arrived = run.timing.extend.positioning_time
    rows = np.flatnonzero((time >= on) & (time <= (off if arrived is None else on + arrived)))
    rows = rows[np.unique(np.linspace(0, len(rows) - 1, min(len(rows), _FEW_ROWS)).astype(int))]
    contraction = np.asarray(run.contraction, dtype=float)[rows]
    return Line(SHARE.all(contraction), np.asarray(run.force, dtype=float)[rows], "the run", EDGE, width=1.2)


def _table(material: SizingMaterial, chosen: Chosen, who: str) -> Html:
    curves, proposal = chosen.curves, chosen.proposal
    supply = [
        float(np.interp(place, curves.contraction, curves.force[-1]))
        for place in (curves.places[0], curves.places[-1])
    ]
    demand = (curves.demand[0], curves.demand[-1])
    counter = (curves.counter[0], curves.counter[-1])
    ratios = [
        _ratio(force / load if load > 0.0 else math.inf) for force, load in zip(supply, demand, strict=True)
    ]
    length = proposal.nominal_length
    rows: list[list[Child]] = [
        [SIZING["contraction"].label, *(figure(curves.places[end], SHARE, 3) for end in (0, -1))],
        ["Length between the fittings", *(_length(length, curves.places[end]) for end in (0, -1))],
        [f"Force demanded of {who}", *(figure(value, NEWTON) for value in demand)],
    ]
    if material.pair:
        rows.append(["… of which to stretch the empty second muscle", *(figure(v, NEWTON) for v in counter)])
    rows += [
        [f"Force of {who} at supply pressure", *(figure(value, NEWTON) for value in supply)],
        ["Force over load", *ratios],
        [
            "Pressure that just carries the load, at rest",
            *(figure(value, BAR, 3) for value in curves.carrying),
        ],
        [
            "Pressure in the run at lift-off and on arrival",
            of_proposal(proposal, "pressure_start"),
            of_proposal(proposal, "pressure_end"),
        ],
    ]
    columns = [
        Head("At rest"),
        Head("Start of the stroke", number=True),
        Head("End", number=True),
    ]
    ratio = 1.0 + proposal.force_reserve
    least = f"The smallest force over load on the whole stroke is {_ratio(ratio)}"
    return table(columns, rows, caption=f"Operating points. {least}.")


def _ratio(value: float) -> str:
    return "ample" if value > AMPLE else plain(value, 3)


def _length(nominal: float, contraction: float) -> Html:
    return figure(nominal * (1.0 - contraction), MILLIMETRES)
