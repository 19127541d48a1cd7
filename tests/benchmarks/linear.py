"""The linear view of every drive preset, beside central differences and beside runs:

    python -m tests.benchmarks.linear [--only propneu-20]

For each model of the preset's operating point (the middle of what can be held): the largest difference of A
and B to differences of the rates of the engine, over the largest entry of the matrix, below 1e-6; and the
largest deviation of the position after a step of 1 % of the command, and of 1 % of the muscle's force, from
the nonlinear run, over the largest motion of that run, wanted below 2 % where nothing sticks. At a
closed valve the command steps to the side of the model, and its differences are one-sided; so are those by
the states that open one orifice of a regulator, or push a play, where a model is that of one side.
"""

from __future__ import annotations

import argparse
from dataclasses import replace

import numpy as np

from mckibben.documents.drive_reading import drive_of, preset_document
from mckibben.physics.errors import InputError
from mckibben.simulation.command.shapes import Step
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import dead_times
from mckibben.simulation.linear.linearise import Linearisation, linearise
from mckibben.simulation.linear.model import LinearModel
from mckibben.simulation.linear.nonlinear import run_from
from tests.benchmarks.diagnosis import say
from tests.export.models import studio
from tests.simulation.linear.differences import of_model, offset_of, side_of
from tests.simulation.linear.steps import step_response

_MATRICES, _STEP = 1e-6, 0.02


def errors(linear: Linearisation, model: LinearModel) -> tuple[float, float]:
    """Largest differences of A and B, scaled, over their largest entries."""
    a, b, exact_a, exact_b = of_model(linear, model)
    return (
        float(np.abs(a - exact_a).max() / np.abs(exact_a).max()),
        float(np.abs(b - exact_b).max() / max(np.abs(exact_b).max(), 1.0)),
    )


def deviation(linear: Linearisation, model: LinearModel, given: Drive, source: str) -> float:
    """Largest difference of the positions after a step of 1 %, over the largest motion."""
    point, side = linear.point, side_of(model)
    seconds = 0.3 if given.regulator is not None else 0.15  # a valve integrates: it leaves the point
    time = np.linspace(0.0, seconds + max(dead_times(given)), 601)
    size = 0.01 * (side or 1) if source == "command" else 0.01 * point.force
    edge = point.command + (offset_of(linear, side) if source == "command" else 0.0)
    level = edge + (size if source == "command" else 0.0)
    changed = replace(
        given, duration=float(time[-1]), command=Step(at=0.0, level=level, initial=point.command),
        controller=None, reference=None,
    )  # fmt: skip
    if source != "command":
        changed = replace(changed, load=replace(given.load, force=point.bound.load_force + size))
    run = run_from(point, changed, grid=time, tolerance=1e-8)
    ran = run.states["stroke"] / given.load.lever_ratio - point.position
    expected = step_response(model, source, "position", time, size)
    return float(np.abs(ran - expected).max() / np.abs(ran).max())


def examined(name: str) -> tuple[bool, bool]:
    """Print the lines of one preset; whether all that was compared is as wanted, and whether a step was."""
    given = drive_of(preset_document(name, studio()), studio()).drive
    try:
        linear = linearise(given)
    except InputError as error:
        say(f"| {name} | - | - | - | - | - | {error.message} |")
        return True, False
    good, stepped = True, False
    for model in linear.models:
        words, shown = [], ["-"] * 4
        if model.name.startswith("mean") and len(linear.models) > 1:
            words.append("mean of the two above")
        elif "sliding" in model.name:
            words.append("the direction of the friction is held fixed: the engine has no such rates")
        else:
            found = list(errors(linear, model))
            shown[:2] = [f"{each:.1e}" for each in found]
            good = good and max(found) < _MATRICES
            if "held" in model.name or model.point.on_stop:
                words.append("friction holds the muscle" if "held" in model.name else "rests on its end stop")
            elif given.stiffness is not None:
                words.append("a joint of two controlled muscles: its loop is tested, not an open step")
            else:
                sources = ["command", "load_force"]
                if side_of(model) and given.regulator is not None:
                    sources.pop()  # it answers the load on the other side too; a closed valve does not
                steps = [deviation(linear, model, given, source) for source in sources]
                shown[2 : 2 + len(steps)] = [f"{100.0 * each:.2f} %" for each in steps]
                good, stepped = good and max(steps) < _STEP, True
        say(f"| {name} | {model.name} | {' | '.join(shown)} | {'; '.join(words)} |")
    return good, stepped


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--only", help="of the drive presets this one alone")
    given = parser.parse_args()
    say("| drive | model | A | B | step of the command | step of the force | why not |")
    say("|---|---|---:|---:|---:|---:|---|")
    names = [each.id for each in studio().library.list("drives") if given.only in (None, each.id)]
    lines = [examined(name) for name in names]
    say(
        f"{sum(good for good, _ in lines)} of {len(lines)} without a miss; a step could be compared of "
        f"{sum(stepped for _, stepped in lines)}"
    )


if __name__ == "__main__":
    main()
