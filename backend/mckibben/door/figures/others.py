"""Figures of diagnoses, runs and sizings."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.application.run.simulate import SimulationResult
from mckibben.application.size.size import ExploredDrive, ProposedDrive, SizingResult
from mckibben.door.figures.style import ACCENT, LOAD, SECOND, SOFT, add_line, add_points, blank, name_axes
from mckibben.facts.comparison import NOISE, error_scale
from mckibben.facts.diagnosis import DIAGNOSIS
from mckibben.facts.sizing import SIZING

if TYPE_CHECKING:
    from plotly.graph_objects import Figure


def diagnosis_figure(result: DiagnosisResult, title: str) -> Figure:
    """The error after each addition, in the fit and in groups left out, and the noise."""
    from plotly.graph_objects import Bar

    scale = error_scale(result.unit)
    steps = [step.added or ("start model" if n == 0 else "refitted") for n, step in enumerate(result.path)]
    names = [f"{number}. {name}" for number, name in enumerate(steps)]
    figure = blank(title)
    figure.add_trace(
        Bar(
            x=names,
            y=[scale.of(s.rmse) for s in result.path],
            name=DIAGNOSIS["rmse"].label,
            marker_color=ACCENT,
        )
    )
    figure.add_trace(
        Bar(
            x=names,
            y=[scale.of(s.holdout_rmse) for s in result.path],
            name=DIAGNOSIS["holdout_rmse"].label,
            marker_color=SECOND,
        )
    )
    noise = result.noise_floor.rmse
    if noise is not None:
        figure.add_hline(
            y=scale.of(noise), line={"color": SOFT, "dash": "dash"}, annotation_text=NOISE["rmse"].words,
            annotation_font_color=SOFT,
        )  # fmt: skip
    name_axes(figure, "after adding", [f"{DIAGNOSIS['rmse'].label} ({scale.unit})"])
    return figure


def run_figure(result: SimulationResult, title: str) -> Figure:
    """Position with its set point, pressure, and force over time."""
    figure = blank(title, rows=3)
    add_line(figure, result.time, 1e3 * result.position, "position")
    if result.reference is not None:
        add_line(figure, result.time, 1e3 * result.reference, "set point", colour=SECOND, dash="dash")
    add_line(figure, result.time, result.pressure / 1e5, "pressure", row=2)
    if result.tube_pressure is not None:
        add_line(
            figure, result.time, result.tube_pressure / 1e5, "pressure in the tube", colour=SECOND, row=2
        )
    add_line(figure, result.time, result.force, "force of the muscle", row=3)
    add_line(figure, result.time, result.load_force, "force of the load", colour=LOAD, dash="dot", row=3)
    name_axes(figure, "Time (s)", ["Position (mm)", "Pressure (bar)", "Force (N)"])
    return figure


def sizing_figure(result: SizingResult, title: str) -> Figure:
    """Air per cycle over the time of the stroke: all drives that fulfil the task, and the proposals."""
    figure, (across, up) = blank(title), (SIZING["time"], SIZING["air_volume_anr"])

    def points(drives: Sequence[ExploredDrive | ProposedDrive], name: str, colour: str) -> None:
        x, y = ([getattr(one, each.name) for one in drives] for each in (across, up))
        add_points(figure, across.scale.all(x), up.scale.all(y), name, colour=colour)

    points(result.explored, "fulfils the task", SOFT)
    length = SIZING["nominal_length"].scale
    for rank, one in enumerate(result.proposals, 1):
        name = f"{rank}. {one.muscle}, {length.of(one.nominal_length):.4g} {length.unit}"
        points([one], name, ACCENT if rank == 1 else SECOND)
    name_axes(
        figure,
        f"{across.label} ({across.scale.unit})",
        [f"{up.label.removesuffix(' (ANR)')} ({up.scale.unit})"],
    )
    return figure
