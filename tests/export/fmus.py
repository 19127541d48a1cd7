"""FMUs of drives and muscles for the tests, simulated by FMPy, as runs of the engine."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from mckibben.export.fmu.build import Compiler
from mckibben.export.fmu.dialects import FMI2, Dialect
from mckibben.export.fmu.package import packed
from mckibben.export.fmu.variables import PLAY, Plant
from mckibben.export.subject import Subject
from mckibben.simulation.drive.transient import Run, simulate
from mckibben.simulation.timing.evaluation import timing_of, trace_of
from tests.one_at_a_time import one_at_a_time
from tests.simulation.lsoda import simulated as simulated_by_lsoda

STRICT = Compiler("linux64", (("", ("gcc", "-Wall", "-Wextra", "-Werror", "-pedantic")),))
KINDS = ("CoSimulation", "ModelExchange")
TOLERANCE = 1e-7


def fmu_of(subject: Subject, folder: Path, name: str, dialect: Dialect = FMI2) -> Path:
    """The FMU of a model, compiled without any warning."""
    file = packed(subject, name, (STRICT,), dialect)
    assert not any("failed" in remark for remark in file.remarks), file.remarks
    path = folder / file.name
    path.write_bytes(file.content)
    return path


def shared_fmu(subject: Subject, base: Path, name: str, dialect: Dialect = FMI2) -> Path:
    """As `fmu_of`, compiled by one of the processes of the suite for all modules.

    Args:
        base: pytest's temporary folder of this process (``tmp_path_factory.getbasetemp()``).
    """
    shared = base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base
    folder = shared / f"fmu-{name}-{dialect.version}"
    with one_at_a_time(shared / f"{folder.name}.lock"):
        if not folder.exists():
            made = folder.with_suffix(".part")  # complete, or not there
            made.mkdir(exist_ok=True)
            fmu_of(subject, made, name, dialect)
            made.rename(folder)
    return next(folder.iterdir())


def simulated(path: Path, subject: Subject, kind: str, *, interval: float = 1e-3, **more: Any) -> np.ndarray:
    """Rows of a simulation by FMPy with the command of the document; co-simulation in steps of ``interval``.

    Of model exchange only the rows on the grid are returned: those at events occur twice.
    """
    import fmpy

    plant = Plant(subject, "plant")
    duration = 1.0 if plant.drive is None else plant.drive.drive.duration
    starts = {PLAY: True, **more.pop("start_values", {})} if plant.plays else more.pop("start_values", {})
    rows = fmpy.simulate_fmu(
        str(path), fmi_type=kind, start_values=starts, stop_time=duration, output_interval=interval,
        step_size=interval if kind == "CoSimulation" else None, relative_tolerance=TOLERANCE,
        output=[each.name for each in (*plant.states, *plant.outputs)], **more,
    )  # fmt: skip
    share = rows["time"] / interval
    return rows[np.abs(share - np.round(share)) < 1e-6]


def opening_signal(subject: Subject) -> np.ndarray:
    """The command of the document as an input signal of FMPy."""
    assert subject.runnable is not None
    command = subject.runnable.signals["opening"]
    assert command is not None
    times = np.repeat(command.times, 2)[1:-1]
    levels = np.column_stack([command.start_values, command.end_values]).ravel()
    kinds = [("time", np.float64), ("opening", np.float64)]
    return np.array(list(zip(times, levels, strict=True)), dtype=kinds)


def our_run(subject: Subject, time: np.ndarray) -> Run:
    """The run of the engine's kernel at the times of an FMU; of equal times one."""
    assert subject.runnable is not None
    drive = subject.runnable.drive
    grid = np.unique(np.clip(np.round(time, 9), 0.0, drive.duration))
    return simulate(drive, grid=grid, tolerance=TOLERANCE)


def position_error(rows: np.ndarray, run: Run) -> float:
    """Largest difference of the positions [m]."""
    ours = np.interp(rows["time"], run.time, run.states["stroke"] / run.drive.load.lever_ratio)
    return float(np.max(np.abs(rows["position"] - ours)))


def figures(run: Run) -> dict[str, float]:
    """Figures of the timing table, from the rows alone."""
    trace = trace_of(replace(run, events=()))
    assert trace is not None
    table = timing_of(run.drive, trace)
    return {
        f"{phase}.{name}": value
        for phase in ("extend", "retract")
        if (own := getattr(table, phase)) is not None
        for name, value in vars_of(own).items()
        if isinstance(value, float)
    }


def vars_of(figure: Any) -> dict[str, Any]:
    """Fields of a frozen result."""
    return {name: getattr(figure, name) for name in type(figure).__dataclass_fields__}


def as_run(rows: np.ndarray, run: Run, subject: Subject) -> Run:
    """Rows of an FMU as a run of the engine."""
    plant = Plant(subject, "plant")
    _, first = np.unique(np.round(rows["time"], 9), return_index=True)
    states = {each.key: rows[each.name][first] for each in plant.states}
    outputs = {each.key: rows[each.name][first] for each in plant.outputs if each.key in run.outputs}
    assert set(outputs) == set(run.outputs)
    return replace(run, states={**states, "clock": run.time}, outputs=outputs, events=())


def timing_error(rows: np.ndarray, run: Run, subject: Subject) -> tuple[dict[str, float], list[str]]:
    """Relative difference of each timing figure, and those that our own runs do not agree on.

    A figure that is nearly zero is compared to a millionth of its unit. Of several maxima that are nearly as
    high the highest is a matter of the last digits: figures that differ by more than 0.5 % between our runs
    by the kernel and by LSODA are named and not compared.
    """
    ours, theirs = figures(run), figures(as_run(rows, run, subject))
    others = figures(simulated_by_lsoda(run.drive, grid=run.time, tolerance=TOLERANCE))
    assert ours.keys() == theirs.keys() == others.keys()

    def difference(name: str, other: dict[str, float]) -> float:
        return abs(other[name] - ours[name]) / max(abs(ours[name]), 1e-6)

    known = [name for name, value in ours.items() if np.isfinite(value)]
    settled = [name for name in known if difference(name, others) < 5e-3]
    return {name: difference(name, theirs) for name in settled}, sorted(set(known) - set(settled))
