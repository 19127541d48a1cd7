"""The C of a model, compiled by a strict compiler with sanitizers: the numbers of the engine."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from mckibben.documents.drive_reading import preset_document, read_document
from mckibben.documents.start_model import stated_muscle
from mckibben.export.c_static import RESULT_MEMBERS
from mckibben.export.formats import python
from mckibben.export.formats.c import sources
from mckibben.export.subject import RunnableDrive, Stated, Subject, subject_of
from mckibben.simulation.drive.transient import parameters_of
from mckibben.simulation.integrate.system import CompiledDrive, compiled_drive
from tests.export.models import assert_equal, cases, our_rates, ours, random_inputs, studio, subject

ROWS = 1000
FLAGS = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O0"]
SANITIZERS = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
INPUTS = ("length", "pressure", "velocity", "direction", "temperature")
NAMES = list(cases())

pytestmark = pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed")

_ROW = """
static void run_NAME(void)
{
    for (int row = 0; row < ROWS; ++row) {
        NAME_input in;
        NAME_result out;
        double given[WIDTH + 1];
        read_row(given, WIDTH + 1);
        NAME_rest(&in);
        in.length = given[0];
        in.pressure = given[1];
        in.velocity = given[2];
        in.direction = given[3];
        in.temperature = given[4];
STATES
        NAME_at(&in, &out);
        const double results[] = {RESULTS};
        write_row(results, (int)(sizeof results / sizeof results[0]));
RATES
    }
}
"""
_MAIN = """#include <stdio.h>
#include <stdlib.h>
INCLUDES
static void read_row(double *row, int count)
{
    if (fread(row, sizeof(double), (size_t)count, stdin) != (size_t)count) {
        exit(1);
    }
}
static void write_row(const double *row, int count)
{
    fwrite(row, sizeof(double), (size_t)count, stdout);
}
FUNCTIONS
int main(void)
{
CALLS
    return 0;
}
"""


def built(folder: Path, written: dict[str, tuple[str, str]], functions: str, flags: Sequence[str]) -> Path:
    """One program of all models and a main function that runs them in turn."""
    for name, (header, source) in written.items():
        (folder / f"{name}.h").write_text(header, "utf-8")
        (folder / f"{name}.c").write_text(source, "utf-8")
    text = _MAIN.replace("INCLUDES", "\n".join(f'#include "{name}.h"' for name in written))
    text = text.replace("FUNCTIONS", functions)
    text = text.replace("CALLS", "\n".join(f"    run_{name}();" for name in written))
    (folder / "main.c").write_text(text, "utf-8")
    command = ["gcc", *flags, "-o", "program", "main.c", *(f"{name}.c" for name in written), "-lm"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[:3000]
    return folder / "program"


def ran(program: Path, rows: Sequence[np.ndarray]) -> np.ndarray:
    """Output of a program that is given rows."""
    given = b"".join(np.ascontiguousarray(part, float).tobytes() for part in rows)
    done = subprocess.run([program], input=given, capture_output=True)
    assert done.returncode == 0, done.stderr.decode()[:3000]
    assert not done.stderr, done.stderr.decode()[:3000]
    return np.frombuffer(done.stdout)


def row_function(name: str, model: Subject) -> str:
    states = len(model.equations.states)
    text = _ROW.replace("WIDTH", str(len(INPUTS) + states)).replace("NAME", name).replace("ROWS", str(ROWS))
    text = text.replace(
        "STATES", "\n".join(f"        in.states[{k}] = given[{k + len(INPUTS)}];" for k in range(states))
    )
    text = text.replace("RESULTS", ", ".join(f"(double)out.{member}" for member in RESULT_MEMBERS))
    rates = (
        f"        double rates[{states}];\n"
        f"        {name}_state_rates(&in, given[{len(INPUTS) + states}], rates);\n"
        f"        write_row(rates, {states});"
    )
    if any(variable.sliding for variable in model.equations.state_variables.values()):
        rates += f"\n        {name}_sliding(&in);"
    rates += f"\n        write_row(in.states, {states});"
    return text.replace("RATES", rates if states else "")


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[dict[str, np.ndarray], np.ndarray]]:
    """Of each case its inputs (and the pressure rate), and the rows that its C gives."""
    models = {name: subject(name) for name in NAMES}
    stems = {name: f"model_{number}" for number, name in enumerate(NAMES)}
    written = {stems[name]: sources(model, stems[name]) for name, model in models.items()}
    functions = "\n".join(row_function(stems[name], model) for name, model in models.items())
    program = built(tmp_path_factory.mktemp("static"), written, functions, [*FLAGS, *SANITIZERS])
    given: dict[str, dict[str, np.ndarray]] = {}
    for number, (name, model) in enumerate(models.items()):
        inputs = random_inputs(model, ROWS, number)
        given[name] = {**inputs, "rate": np.random.default_rng(number).uniform(-1e6, 1e6, ROWS)}
    output = ran(program, [np.column_stack(list(inputs.values())) for inputs in given.values()])
    found, place = {}, 0
    for name, model in models.items():
        width = len(RESULT_MEMBERS) + 2 * len(model.equations.states)
        found[name] = given[name], output[place : place + ROWS * width].reshape(ROWS, width)
        place += ROWS * width
    assert place == len(output)
    return found


@pytest.mark.parametrize("name", NAMES)
def test_the_c_of_an_effect_gives_the_numbers_of_the_engine(name, answers):
    inputs, rows = answers[name]
    model = subject(name)
    expected = ours(model, inputs)
    assert 0 < np.count_nonzero(expected["force"]) <= ROWS
    for column, member in enumerate(RESULT_MEMBERS):
        assert_equal(rows[:, column], expected[member], f"{name}: {member}")
    if model.equations.states and not model.equations.compliant:
        rates = our_rates(model, inputs, inputs["rate"])
        for column, state in enumerate(model.equations.states, len(RESULT_MEMBERS)):
            assert_equal(rows[:, column], rates[column - len(RESULT_MEMBERS)], f"{name}: rate of {state}")
    for column, (state, variable) in enumerate(
        model.equations.state_variables.items(), len(RESULT_MEMBERS) + len(model.equations.states)
    ):
        reached = variable.sliding * inputs["direction"] if variable.sliding else inputs[state]
        assert_equal(rows[:, column], reached, f"{name}: {state} of a sliding muscle")


DRIVES = {
    "lift": "propneu-20",
    "valve": "paper-step-mpye",
    "controlled": "paper-pid-triangle",
    "pair": {
        "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
        "effects": {
            "bladder_elasticity": {}, "dahl": {}, "leak": {}, "sensor_lag": {}, "pressure_friction": {},
            "coulomb_friction": {"force": "6 N", "static_share": 0.3},
        },
        "supply": {"pressure": "6 bar"}, "valve": {"preset": "MPYE-5-1/8-HF"},
        "tube": {"inside_diameter": "4 mm", "length": "1 m"},
        "load": {"mass": "2 kg", "arrangement": "antagonist", "pulley_radius": "20 mm"},
        "command": {"shape": "sine", "amplitude": 0.5, "period": "1 s"}, "stops": {"restitution": 0.3},
        "pwm": {"frequency": "100 Hz", "min_on": "1 ms"},
    },
    "regulated": {
        "muscle": {"preset": "DMSP-10", "nominal_length": "250 mm"},
        "effects": {"spool_lag": {}, "creep": {}, "rig_compliance": {}, "moving_mass": {}},
        "supply": {"pressure": "7 bar"}, "valve": {"preset": "VPPM-6"},
        "flow_control": {"meter": "out", "sonic_conductance": 8e-9, "free_conductance": 2e-8},
        "load": {"mass": "5 kg", "force": {"shape": "step", "level": "20 N", "at": "1 s"}},
        "gas": {"polytropic_exponent": 1.2},
        "command": {"shape": "ramp", "from": 0, "to": 1, "duration": "2 s"},
    },
}  # fmt: skip
_DRIVE_ROW = """
static void run_NAME(void)
{
    double k[NAMEU_DRIVE_CONSTANTS];
    NAME_prepare(NAME_parameters, k);
    for (int row = 0; row < 1000; ++row) {
        double y[NAMEU_DRIVE_STATES], u[NAMEU_DRIVE_INPUTS], w[NAMEU_DRIVE_SWITCHES];
        double rates[NAMEU_DRIVE_STATES], out[NAMEU_DRIVE_OUTPUTS], guards[NAMEU_DRIVE_SWITCHES];
        double jacobian[NAMEU_DRIVE_STATES * NAMEU_DRIVE_STATES];
        double by_inputs[NAMEU_DRIVE_STATES * NAMEU_DRIVE_INPUTS];
        read_row(y, NAMEU_DRIVE_STATES);
        read_row(u, NAMEU_DRIVE_INPUTS);
        read_row(w, NAMEU_DRIVE_SWITCHES);
        NAME_rates(y, k, u, w, rates);
        NAME_outputs(y, k, u, w, out);
        NAME_guards(y, k, u, w, guards);
        NAME_jacobian(y, k, u, w, jacobian);
        NAME_input_jacobian(y, k, u, w, by_inputs);
        write_row(rates, NAMEU_DRIVE_STATES);
        write_row(out, NAMEU_DRIVE_OUTPUTS);
        write_row(guards, NAMEU_DRIVE_SWITCHES);
        write_row(jacobian, NAMEU_DRIVE_STATES * NAMEU_DRIVE_STATES);
        write_row(by_inputs, NAMEU_DRIVE_STATES * NAMEU_DRIVE_INPUTS);
        NAME_change(row % NAMEU_DRIVE_SWITCHES, NAME_parameters, k, u, y, w);
        NAME_inputs(0.02 * row, u);
        write_row(y, NAMEU_DRIVE_STATES);
        write_row(w, NAMEU_DRIVE_SWITCHES);
        write_row(u, NAMEU_DRIVE_INPUTS);
    }
}
"""
DRIVE_ROWS = 1000


def drive(name: str) -> Subject:
    """A drive, ready to be written."""
    stated = DRIVES[name]
    document = (
        preset_document(stated, studio()) if isinstance(stated, str) else read_document(stated, "the drive")
    )
    start = studio().start_model(stated_muscle(document.muscle), document.effects)
    return subject_of(Stated(start, title=name, document=document), studio())


def random_rows(runnable: RunnableDrive, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """States around those at the start, inputs and switches."""
    random, equations = np.random.default_rng(seed), runnable.equations
    states = np.tile(runnable.start, (DRIVE_ROWS, 1))
    for place, state in enumerate(equations.states):
        name = state.name.removesuffix("@counter")
        if name.endswith("pressure"):
            states[:, place] = random.uniform(1.02e5, 6e5, DRIVE_ROWS)
        elif name == "gas_mass":
            states[:, place] *= random.uniform(1.0, 6.0, DRIVE_ROWS)
        elif name in ("length", "stroke"):
            states[:, place] += random.uniform(-0.01, 0.0 if name == "length" else 0.01, DRIVE_ROWS)
        else:
            states[:, place] += state.scale * random.uniform(-1.0, 1.0, DRIVE_ROWS)
    inputs = np.column_stack(
        [
            random.uniform(6e5, 8e5, DRIVE_ROWS)
            if name == "supply_pressure"
            else random.uniform(-1.0, 1.0, DRIVE_ROWS)
            for name in equations.inputs
        ]
    )
    switches = random.integers(0, 2, (DRIVE_ROWS, len(equations.switches))).astype(float)
    return states, inputs, switches


def packed(
    compiled: CompiledDrive, runnable: RunnableDrive, state: np.ndarray, given: np.ndarray
) -> np.ndarray:
    """The same point for the engine: with clock, slopes of zero, and the supply among the parameters."""
    named = dict(zip(runnable.equations.inputs, given, strict=True))
    of_state = dict(zip((each.name for each in runnable.equations.states), state, strict=True))
    parameters = parameters_of(runnable.drive, compiled)
    parameters[list(compiled.model.parameters).index("supply_pressure")] = named["supply_pressure"]
    inputs = [named.get(name, 0.0) for name in compiled.model.inputs]
    return np.concatenate(
        [[of_state.get(each.name, 0.0) for each in compiled.model.states], parameters, inputs]
    )


@pytest.fixture(scope="module")
def drive_answers(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Subject, tuple, np.ndarray]]:
    models = {name: drive(name) for name in DRIVES}
    written = {name: sources(model, name) for name, model in models.items()}
    functions = "\n".join(_DRIVE_ROW.replace("NAMEU", name.upper()).replace("NAME", name) for name in DRIVES)
    program = built(tmp_path_factory.mktemp("drives"), written, functions, [*FLAGS, *SANITIZERS])
    given = {name: random_rows(model.runnable, n) for n, (name, model) in enumerate(models.items())}
    output = ran(program, [np.hstack(rows) for rows in given.values()])
    found, place = {}, 0
    for name, model in models.items():
        equations = model.runnable.equations
        size, inputs = len(equations.states), len(equations.inputs)
        width = size + len(equations.outputs) + len(equations.guards) + size * size + size * inputs
        width += size + len(equations.switches) + inputs
        found[name] = (
            model,
            given[name],
            output[place : place + DRIVE_ROWS * width].reshape(DRIVE_ROWS, width),
        )
        place += DRIVE_ROWS * width
    assert place == len(output)
    return found


@pytest.mark.parametrize("name", DRIVES)
def test_the_c_of_a_drive_gives_the_numbers_of_the_engine(name, drive_answers):
    model, (states, inputs, switches), rows = drive_answers[name]
    runnable = model.runnable
    equations = runnable.equations
    compiled = compiled_drive(runnable.drive.structure)
    names = [state.name for state in compiled.model.states]
    kept = [names.index(state.name) for state in equations.states]
    points = [packed(compiled, runnable, y, u) for y, u in zip(states, inputs, strict=True)]
    both = list(zip(points, switches, strict=True))
    size = len(kept)
    jacobians = [compiled.jacobian(point, w)[len(names) :].reshape(len(names), -1) for point, w in both]
    expected = np.hstack(
        [
            np.array([compiled.rates(point, w)[kept] for point, w in both]),
            np.array([compiled.outputs(point, w) for point, w in both]),
            np.array([compiled.guards(point, w) for point, w in both]),
            np.array([matrix[np.ix_(kept, kept)].ravel() for matrix in jacobians]),
        ]
    )
    assert np.all(np.isfinite(expected))
    for column in range(expected.shape[1]):
        assert_equal(rows[:, column], expected[:, column], f"{name}: column {column}")
    # By differences of the engine's own rates: the engine has no derivatives by inputs.
    count = size * len(equations.inputs)
    by_inputs = rows[:, expected.shape[1] :][:, :count].reshape(DRIVE_ROWS, size, len(equations.inputs))
    for column, step in enumerate({"supply_pressure": 10.0}.get(each, 1e-6) for each in equations.inputs):
        ahead, behind = inputs.copy(), inputs.copy()
        ahead[:, column] += step
        behind[:, column] -= step
        for row in range(0, DRIVE_ROWS, 20):
            after, before = (
                compiled.rates(packed(compiled, runnable, states[row], each[row]), switches[row])[kept]
                for each in (ahead, behind)
            )
            slope = (after - before) / (2.0 * step)
            scale = np.abs(slope) + np.abs(after) * 1e-9 / step + 1e-30
            assert np.all(np.abs(by_inputs[row, :, column] - slope) <= 1e-4 * scale), (name, row, column)
    # Changes of switches and inputs over time as in Python, which test_python.py checks against the engine.
    module = ModuleType("written")
    exec(python.write(model, "written")[0].content, module.__dict__)
    after = rows[:, expected.shape[1] + count :]
    numbers, constants = list(module.PARAMETERS.values()), module.CONSTANTS
    for row, (y, u, w) in enumerate(zip(states, inputs, switches, strict=True)):
        changed = module.change(row % len(w), numbers, constants, u, y, w)
        assert_equal(after[row], np.concatenate([*changed, module.inputs(0.02 * row)]), f"{name}: row {row}")
