"""The Python of a model: numpy alone, the numbers of the engine, accepted by ruff, and a drive that runs."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mckibben.export.formats.python import write
from mckibben.export.subject import Subject
from mckibben.simulation.drive.transient import parameters_of
from mckibben.simulation.integrate.system import compiled_drive
from tests.export.models import assert_equal, cases, our_rates, ours, random_inputs, studio, subject
from tests.export.test_c import DRIVES, drive, packed, random_rows
from tests.simulation.lsoda import Problem, _Run, simulated

ROWS = 1000


def module_of(model: Subject) -> ModuleType:
    """The written module, executed."""
    (file,) = write(model, "written")
    module = ModuleType("written")
    exec(compile(file.content, file.name, "exec"), module.__dict__)
    return module


@pytest.mark.parametrize("name", list(cases()))
def test_the_python_of_an_effect_gives_the_numbers_of_the_engine(name):
    model = subject(name)
    module, inputs = module_of(model), random_inputs(model, ROWS, 3)
    states = [inputs[state] for state in model.equations.states]
    named = {each: inputs[each] for each in ("pressure", "velocity", "direction", "temperature", "length")}
    given = module.evaluate(**named, states=states)
    for member, expected in ours(model, inputs).items():
        assert_equal(given[member], expected, f"{name}: {member}")
    if states and not model.equations.compliant:
        rate = np.linspace(-1e6, 1e6, ROWS)
        rates = module.state_rates(**named, states=states, pressure_rate=rate)
        for own, expected in zip(rates, our_rates(model, inputs, rate), strict=True):
            assert_equal(np.broadcast_to(own, ROWS), expected, name)


def test_force_of_a_contraction_is_that_of_the_curves():
    model = subject("bladder_elasticity")
    module = module_of(model)
    expected = model.statics.force(length=0.27, pressure=4e5)
    assert module.force(4e5, 0.1) == pytest.approx(float(expected[0]), rel=1e-12)


def test_a_slow_loop_is_that_of_the_curves():
    """Friction with memory, fully built up in the direction of the motion, as the page draws it."""
    model = subject("dahl")
    module, page = module_of(model), studio().slow_model(model.start)
    for direction in (-1.0, 0.0, 1.0):
        states = [module.SLIDING[name] * direction for name in module.STATES]
        theirs = module.evaluate(4e5, np.array([0.0, 0.1]), direction=direction, states=states)["force"]
        expected = page.force(length=np.array([0.3, 0.27]), pressure=4e5, direction=direction)
        np.testing.assert_allclose(theirs, expected, rtol=1e-12)
    assert abs(expected[0] - model.statics.force(length=0.3, pressure=4e5)[0]) > 1.0


def test_the_written_drive_makes_the_run_of_the_engine():
    """Solved by scipy from event to event with the written functions alone."""
    model = drive("lift")
    module = module_of(model)
    runnable = model.runnable
    duration = 2.6
    p, k = list(module.PARAMETERS.values()), module.CONSTANTS
    y, w, now = module.START, module.START_SWITCHES, 0.0
    times, strokes = [np.zeros(1)], [y[:1]]
    breaks = sorted({*module.OPENING_ROWS[:, 0], duration} - {0.0})
    while now < duration:
        u = module.inputs(now)
        for _ in range(6):
            wrong = np.flatnonzero(module.guards(y, k, u, w) < -module.LEAST)
            if not len(wrong):
                break
            y, w = module.change(int(wrong[0]), p, k, u, y, w)

        def guard(number, switches):
            def value(_, state):
                return module.guards(state, k, u, switches)[number] + module.LEAST  # noqa: B023

            value.terminal, value.direction = True, -1.0
            return value

        end = next(each for each in breaks if each > now + 1e-12)
        found = solve_ivp(
            lambda _, state: module.rates(state, k, u, w),  # noqa: B023
            (now, end), y, method="LSODA", rtol=1e-7, atol=1e-7 * np.maximum(np.abs(module.START), 1e-2),
            jac=lambda _, state: module.jacobian(state, k, u, w),  # noqa: B023
            events=[guard(number, w) for number in range(len(w))],
        )  # fmt: skip
        assert found.success
        times.append(found.t)
        strokes.append(found.y[0])
        now, y = float(found.t[-1]), found.y[:, -1]
        if found.status == 1:
            number = next(place for place, each in enumerate(found.t_events) if len(each))
            y, w = module.change(number, p, k, u, y, w)
        else:
            now = end
    grid = np.concatenate(times[1:])
    kept = np.concatenate(([True], np.diff(grid) > 1e-9))
    run = simulated(runnable.drive, grid=grid[kept], tolerance=1e-7)
    theirs = np.concatenate(strokes[1:])[kept]
    assert np.max(run.states["stroke"]) > 0.19
    assert np.max(np.abs(theirs - run.states["stroke"])) < 1e-4


@pytest.mark.parametrize("name", list(DRIVES))
def test_a_switch_changes_as_in_the_engine(name):
    """Each switch at states where its guard need not be zero; `by_lsoda` changes them with its own lines."""
    model = drive(name)
    module, runnable = module_of(model), model.runnable
    compiled = compiled_drive(runnable.drive.structure)
    names = [state.name for state in compiled.model.states]
    kept = [names.index(state.name) for state in runnable.equations.states]
    parameters = parameters_of(runnable.drive, compiled)
    for y, u, w in zip(*(each[:20] for each in random_rows(runnable, 8)), strict=True):
        point = packed(compiled, runnable, y, u)
        given = parameters.copy()
        given[list(compiled.model.parameters).index("supply_pressure")] = u[-1]
        for number in range(len(w)):
            problem = Problem(
                drive=compiled, constants=compiled.codes.constants(given), stops=compiled.stops(parameters),
                restitution=runnable.drive.restitution, state=point[: len(names)].copy(), switches=w.copy(),
                times=np.array([0.0, 1.0]), inputs=np.zeros((1, 7)), grid=np.zeros(1), tolerance=1e-6,
            )  # fmt: skip
            run = _Run(problem)
            run.packed[run.first_input : run.first_switch] = point[len(names) + len(parameters) :]
            run.change(number, 0.0)
            state, switches = module.change(
                number, list(module.PARAMETERS.values()), module.CONSTANTS, u, y, w
            )
            np.testing.assert_allclose(state, problem.state[kept], rtol=1e-9, atol=1e-12)
            assert switches.tolist() == problem.switches.tolist()


@pytest.mark.parametrize("name", ["lift", "pair", "regulated"])
def test_the_inputs_are_those_of_the_run(name):
    runnable = drive(name).runnable
    module = module_of(drive(name))
    for time in np.linspace(0.0, 0.999 * runnable.drive.duration, 40):
        given = dict(zip(module.INPUTS, module.inputs(time), strict=True))
        assert given["opening"] == pytest.approx(float(runnable.signals["opening"].value(time)), abs=1e-12)
        assert given["external_force"] == pytest.approx(
            float(runnable.signals["external_force"].value(time)), abs=1e-12
        )
        assert given["supply_pressure"] == runnable.supply
    assert "opening" in module.INPUTS
    closed = module_of(drive("controlled"))
    assert dict(zip(closed.INPUTS, closed.inputs(0.3), strict=True))["opening"] == 0.0


def test_no_import_but_numpy_and_nothing_for_ruff(tmp_path: Path):
    for name in ("together_1", "typed", "lift", "pair"):
        model = drive(name) if name in DRIVES else subject(name)
        (tmp_path / f"{name}.py").write_bytes(write(model, name)[0].content)
    command = [sys.executable, "-m", "ruff", "check", "--isolated", "--no-cache", "--line-length", "110"]
    command += ["--select", "E,F,W,I,UP,C4,PLE", "--output-format", "concise", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    program = (
        "import json, sys; sys.path.insert(0, sys.argv[1]); before = set(sys.modules); import numpy; "
        "allowed = set(sys.modules); import together_1, typed, lift, pair; "
        "print(json.dumps(sorted(set(sys.modules) - allowed)))"
    )
    shown = subprocess.run(
        [sys.executable, "-I", "-c", program, str(tmp_path)], capture_output=True, text=True, check=True
    )
    assert set(json.loads(shown.stdout)) == {"together_1", "typed", "lift", "pair"}
