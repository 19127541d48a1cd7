"""Linear against nonlinear as plots, of four drives:

    python -m tests.benchmarks.linear_plots FOLDER [--only propneu-20]

writes two pages for each, to be opened in a browser: steps of 1, 5 and 20 % of the command from the operating
point, over their size, beside the linear models of that side; and the Bode diagram with the nonlinear drive
under sines. Prints the largest difference of each step from its models, over the largest motion of the run;
one that has friction holds a small step, and lets a large one slide.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np

from mckibben.application.linear.linearise import LinearQuestion, linear_view
from mckibben.documents.drive_reading import drive_of, preset_document
from mckibben.door.figures import SOFT, add_line, blank, bode_figure, name_axes
from mckibben.report.chart import family
from mckibben.simulation.command.shapes import Step
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import dead_times
from mckibben.simulation.linear.linearise import Linearisation, linearise
from mckibben.simulation.linear.model import LinearModel
from mckibben.simulation.linear.nonlinear import run_from
from tests.benchmarks.diagnosis import say
from tests.export.models import studio
from tests.simulation.linear.differences import offset_of, side_of
from tests.simulation.linear.steps import step_response

Array = np.ndarray

DRIVES = ("propneu-20", "paper-step-mpye", "paper-pid-pulse", "joint-20")
SIZES = (0.01, 0.05, 0.2)
_DASHES = ("dash", "dot")


def moved(linear: Linearisation, given: Drive, level: float, time: Array) -> Array:
    """The position of the nonlinear drive after a step of the command to a level, from the point [m]."""
    point = linear.point
    changed = replace(
        given, duration=float(time[-1]), command=Step(at=0.0, level=level, initial=point.command),
        controller=None, reference=None, stiffness=None,
    )  # fmt: skip
    run = run_from(point, changed, grid=time, tolerance=1e-8)
    return run.states["stroke"] / given.load.lever_ratio - point.position


def models_of(linear: Linearisation, sign: int) -> list[LinearModel]:
    """The models that say something of a step in a direction: of its side, and that slide its way."""
    other = {1: "longer", -1: "shorter"}[sign]
    single = len(linear.models) == 1
    own = [model for model in linear.models if single or not model.name.startswith("mean of ")]
    return [each for each in own if side_of(each) in (0, sign) and other not in each.name]


def steps(name: str, linear: Linearisation, folder: Path) -> None:
    """Draw the steps of a drive, and print how far they are from the models."""
    given = linear.point.bound.drive
    seconds = 0.6 if given.regulator is not None else 0.15  # a valve integrates: it leaves the point
    time = np.linspace(0.0, seconds + max(dead_times(given)), 601)
    figure = blank(f"{name}: steps of the command over their size", rows=2)
    known: set[str] = set()
    for row, sign in enumerate((1, -1), 1):
        models = models_of(linear, sign)
        edge = linear.point.command + offset_of(linear, sign)
        to_edge = moved(linear, given, edge, time)  # a pair moves before both of its muscles react
        runs = {}
        for size, colour in zip(SIZES, family(len(SIZES)), strict=True):
            runs[size] = (moved(linear, given, edge + sign * size, time) - to_edge) / (sign * size)
            add_line(
                figure, time, runs[size] * 1e3, f"nonlinear, {100 * size:g} %", colour=colour, row=row,
                legend=row == 1,
            )  # fmt: skip
        for model, dash in zip(models, _DASHES, strict=False):
            line = step_response(model, "command", "position", time, 1.0)
            new = row == 1 or model.name not in known
            known.add(model.name)
            add_line(figure, time, line * 1e3, model.name, colour=SOFT, dash=dash, row=row, legend=new)
            shown = [
                f"{100 * size:g} %: {100.0 * np.abs(run - line).max() / np.abs(run).max():.1f} %"
                for size, run in runs.items()
            ]
            say(f"| {name} | {'rises' if sign > 0 else 'falls'} | {model.name} | {'; '.join(shown)} |")
    name_axes(figure, "Time (s)", ["Rises (mm per 1)", "Falls (mm per 1)"])
    figure.write_html(folder / f"{name}-steps.html", include_plotlyjs="directory")


def main() -> None:
    """Write the pages and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", help="of the drives this one alone")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    say("| drive | command | model | difference of a step of |")
    say("|---|---|---|---|")
    for name in DRIVES:
        if given.only in (None, name):
            annotated = drive_of(preset_document(name, studio()), studio())
            steps(name, linearise(annotated.drive), given.folder)
            answer = linear_view(LinearQuestion(annotated))
            figure = bode_figure(answer, f"{name}: linear models and the nonlinear drive")
            figure.write_html(given.folder / f"{name}-bode.html", include_plotlyjs="directory")


if __name__ == "__main__":
    main()
