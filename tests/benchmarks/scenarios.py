"""The paper's scenarios: our figures beside the printed ones.

    python -m tests.benchmarks.scenarios

prints the table of docs/reference/scenarios.md.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass

import numpy as np

from mckibben.application.run.drive_run import run_drive
from mckibben.application.run.simulate import SimulationResult, result_of
from mckibben.documents.drive_reading import AnnotatedDrive, drive_of, preset_document
from mckibben.documents.studio import Studio
from mckibben.presets import DrivePreset
from mckibben.resources import presets_folder
from mckibben.simulation.drive.transient import Run, dead_times
from mckibben.simulation.timing.evaluation import grid_of, trace_of
from mckibben.simulation.timing.trace import Trace

SCENARIOS = (
    "paper-ramp", "paper-step", "paper-step-mpye", "paper-hysteresis", "paper-pid-triangle",
    "paper-pid-pulse", "paper-pid-random", "propneu-20", "propneu-10", "propneu-20-physical",
    "propneu-10-physical",
)  # fmt: skip
POINTS = 2001


@dataclass(frozen=True)
class Scenario:
    """A scenario that has been run."""

    preset: DrivePreset
    given: AnnotatedDrive
    run: Run
    result: SimulationResult


@dataclass(frozen=True)
class Row:
    """A figure: ours and the paper's in SI, the share by which it may be missed, why it is not compared."""

    name: str
    ours: float | None
    paper: float
    unit: str
    tolerance: float | None
    excluded: str | None

    @property
    def difference(self) -> float:
        """Ours over the paper's, minus 1."""
        return float("nan") if self.ours is None else self.ours / self.paper - 1.0


def run_scenario(studio: Studio, preset_id: str) -> Scenario:
    """Run a drive preset under the kernel."""
    preset = studio.library.get("drives", preset_id)
    assert isinstance(preset, DrivePreset)
    given = drive_of(preset_document(preset_id, studio), studio)
    duration = given.drive.duration
    grid = grid_of(duration=duration, begin=0.0, end=duration, points=POINTS)
    run = run_drive(given, grid)
    return Scenario(preset, given, run, result_of(given, grid, run))


def rows_of(scenario: Scenario) -> list[Row]:
    """Every printed figure beside ours."""
    paper = scenario.preset.paper
    assert paper is not None
    return [
        Row(
            name,
            figure(scenario, name),
            quantity.si(_SI.get(quantity.unit, quantity.unit)),
            _SI.get(quantity.unit, quantity.unit),
            paper.tolerance.get(name),
            paper.excluded.get(name),
        )
        for name, quantity in paper.figures.items()
    ]


_SI = {"ms": "s", "mm": "m"}


def figure(scenario: Scenario, name: str) -> float | None:
    """A figure of the timing table, or one that only the paper uses."""
    phase, _, key = name.partition(".")
    if phase == "position":
        return float(getattr(np, key)(scenario.result.position))
    table = getattr(scenario.result.timing, phase)
    if key == "motion_time":
        return table.positioning_time - _leaves_stop(scenario, phase)
    if key == "rise_and_dead_time":
        return table.rise_time + dead_times(scenario.given.drive)[0 if phase == "extend" else 1]
    return getattr(table, key)


def _leaves_stop(scenario: Scenario, phase: str) -> float:
    """When the load leaves the stop on which the phase finds it, from the switching instant [s]."""
    trace = trace_of(scenario.run)
    assert isinstance(trace, Trace)
    off = float(scenario.given.drive.command.segments(scenario.given.drive.duration).times[1])
    start, end = (0.0, off) if phase == "extend" else (off, scenario.given.drive.duration)
    window = trace.window(start, end)
    assert window is not None
    return float(window.time[np.argmax(~window.contact)] - window.time[0])


def shown(value: float | None, unit: str) -> str:
    """A figure in the unit an engineer reads it in."""
    if value is None:
        return "–"
    factor, text = {"s": (1e3, "ms"), "m": (1e3, "mm"), "m/s^2": (1.0, "m/s²")}.get(unit, (1.0, unit))
    return f"{value * factor:.4g} {text}"


def table(scenarios: list[Scenario]) -> str:
    """The table in Markdown."""
    lines = ["| scenario | figure | ours | paper | difference | why |", "|---|---|---:|---:|---:|---|"]
    for scenario in scenarios:
        rows = rows_of(scenario)
        for row in rows:
            why, differs = row.excluded or "", "–" if row.ours is None else f"{row.difference:+.1%}"
            lines.append(
                f"| {scenario.preset.id} | {row.name} | {shown(row.ours, row.unit)} | "
                f"{shown(row.paper, row.unit)} | {differs} | {why} |"
            )
        follows = scenario.result.tracking
        if follows is not None:
            lag = shown(follows.lag, "s")
            lines.append(
                f"| {scenario.preset.id} | error rms, lag | {shown(follows.rms, 'm')}, {lag} | – | – | "
                "the paper prints curves only |"
            )
        elif not rows:
            width = loop_width(scenario)
            lines.append(
                f"| {scenario.preset.id} | loop width | {width / 1e5:.2f} bar | – | – | "
                "the paper prints a curve only |"
            )
    return "\n".join(lines)


def loop_width(scenario: Scenario) -> float:
    """Pressure between rising and falling branch at half the stroke, last cycle [Pa]."""
    run = scenario.run
    stroke, rising = run.states["stroke"], run.states["speed"] > 0.0
    late = run.time > 0.5 * scenario.given.drive.duration
    half = 0.5 * (stroke[late].max() + stroke[late].min())
    crossing = np.flatnonzero(late[:-1] & ((stroke[:-1] < half) != (stroke[1:] < half)))
    up = [run.pressure[index] for index in crossing if rising[index]]
    down = [run.pressure[index] for index in crossing if not rising[index]]
    return float(np.mean(up) - np.mean(down))


def main() -> int:
    """Print the table."""
    studio = Studio(presets=presets_folder())
    sys.stdout.write(table([run_scenario(studio, name) for name in SCENARIOS]) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
