"""Summary of a model: dimensions, effects and their parameters."""

from __future__ import annotations

from mckibben.application.muscle_summary import start_notices
from mckibben.documents.start_model import StartModel
from mckibben.report.summary.parts import Summary, Table, figure


def summary_of(start: StartModel, name: str, *, with_length: bool) -> Summary:
    """Dimensions and effects.

    Args:
        start: the model.
        name: for the title.
        with_length: whether it has a length of its own.
    """
    muscle = start.muscle
    rows = [
        [
            "rest length",
            figure(muscle.nominal_length * 1e3, unit=" mm") if with_length else "that of the data",
        ],
        ["braid diameter", figure(muscle.braid_diameter * 1e3, unit=" mm")],
        ["braid angle", figure(muscle.braid_angle * 57.29577951308232, unit=" deg")],
        ["inside diameter", figure(muscle.inside_diameter * 1e3, unit=" mm")],
        ["wall thickness", figure(muscle.wall_thickness * 1e3, unit=" mm") if muscle.wall_thickness else "–"],
    ]
    parameters = [
        [f"{effect}.{p.name}", f"{values[p.name]:.5g}", p.unit]
        for effect, values in start.effects.items()
        for p in start.catalogue[effect].parameters
    ]
    summary: Summary = [Table(name, ["", ""], rows)]
    if start.term is not None:
        summary.append(f"term: {start.term}")
    if parameters:
        summary.append(Table("Effects", ["parameter", "value", "unit"], parameters))
    elif start.effects:
        summary.append(f"effects: {', '.join(start.effects)}")
    else:
        summary.append("ideal: no effects")
    return [*summary, *(notice.message for notice in start_notices(start))]
