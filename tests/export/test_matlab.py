"""The MATLAB of a model under Octave: the numbers of the engine."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from mckibben.export.formats import python
from mckibben.export.formats.matlab import write
from mckibben.simulation.integrate.system import compiled_drive
from tests.export.models import assert_equal, cases, our_rates, ours, random_inputs, subject
from tests.export.test_c import RESULT_MEMBERS, drive, packed, random_rows

ROWS = 1000
NAMES = list(cases())
OCTAVE = shutil.which("octave-cli") or shutil.which("octave")

pytestmark = pytest.mark.skipif(OCTAVE is None, reason="Octave is not installed")

_STATIC = """
m = NAME();
x = dlmread('NAME.csv');
motion = struct('length', x(:, 1), 'velocity', x(:, 3), 'direction', x(:, 4), 'temperature', x(:, 5));
if numel(m.states) > 0
  motion.states = x(:, 6:end-1);
end
r = m.evaluate(x(:, 2), 0.0, motion);
y = [];
names = {MEMBERS};
for k = 1:numel(names)
  y = [y, double(r.(names{k}))];
end
if numel(m.states) > 0
  y = [y, m.state_rates(x(:, 2), 0.0, motion, x(:, end))];
end
assert(isreal(y));
f = fopen('NAME.out', 'w'); fwrite(f, y', 'double'); fclose(f);
"""
_DRIVE = """
m = NAME();
x = dlmread('NAME.csv');
k = m.prepare(m.parameters);
n = numel(m.start); i = numel(m.input_names);
f = fopen('NAME.out', 'w');
for row = 1:rows(x)
  y = x(row, 1:n)'; u = x(row, n+1:n+i)'; w = x(row, n+i+1:end)';
  j = m.jacobian(y, k, u, w)';
  fwrite(f, [m.rates(y, k, u, w); m.outputs(y, k, u, w); m.guards(y, k, u, w); j(:)], 'double');
  [y, w] = m.change(mod(row - 1, numel(w)) + 1, m.parameters, k, u, y, w);
  fwrite(f, [y; w; m.inputs(0.02 * (row - 1))], 'double');
end
fclose(f);
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All models in one run of Octave, which takes half a second to start."""
    folder = tmp_path_factory.mktemp("octave")
    members = ", ".join(f"'{member}'" for member in RESULT_MEMBERS)
    script = ["1;"]
    for number, name in enumerate(NAMES):
        model, own = subject(name), f"model_{number}"
        (folder / f"{own}.m").write_bytes(write(model, own)[0].content)
        rate = np.linspace(-1e6, 1e6, ROWS)
        rows = np.column_stack([*random_inputs(model, ROWS, number).values(), rate])
        np.savetxt(folder / f"{own}.csv", rows, delimiter=",", fmt="%.17g")
        script.append(_STATIC.replace("NAME", own).replace("MEMBERS", members))
    for name in ("lift", "pair"):
        model = drive(name)
        (folder / f"{name}.m").write_bytes(write(model, name)[0].content)
        rows = np.hstack(random_rows(model.runnable, 5))[:40]
        np.savetxt(folder / f"{name}.csv", rows, delimiter=",", fmt="%.17g")
        script.append(_DRIVE.replace("NAME", name))
    (folder / "run_all.m").write_text("\n".join(script), "utf-8")
    done = subprocess.run(
        [str(OCTAVE), "--quiet", "--norc", "run_all.m"], cwd=folder, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr[-3000:]
    assert "warning" not in done.stderr, done.stderr[-3000:]
    return folder


@pytest.mark.parametrize("name", NAMES)
def test_octave_gives_the_numbers_of_the_engine(name, folder):
    number, model = NAMES.index(name), subject(name)
    inputs = random_inputs(model, ROWS, number)
    rows = np.fromfile(folder / f"model_{number}.out").reshape(ROWS, -1)
    expected = ours(model, inputs)
    for column, member in enumerate(RESULT_MEMBERS):
        assert_equal(rows[:, column], expected[member], f"{name}: {member}")
    if model.equations.states and not model.equations.compliant:
        rates = our_rates(model, inputs, np.linspace(-1e6, 1e6, ROWS))
        for column, rate in enumerate(rates, len(RESULT_MEMBERS)):
            assert_equal(rows[:, column], rate, name)


@pytest.mark.parametrize("name", ["lift", "pair"])
def test_the_drive_in_octave_gives_the_numbers_of_the_engine(name, folder):
    runnable = drive(name).runnable
    states, inputs, switches = (each[:40] for each in random_rows(runnable, 5))
    compiled = compiled_drive(runnable.drive.structure)
    names = [state.name for state in compiled.model.states]
    kept = [names.index(state.name) for state in runnable.equations.states]
    rows = np.fromfile(folder / f"{name}.out").reshape(40, -1)
    module = ModuleType("written")
    exec(python.write(drive(name), "written")[0].content, module.__dict__)
    numbers, expected = list(module.PARAMETERS.values()), []
    for row, (y, u, w) in enumerate(zip(states, inputs, switches, strict=True)):
        point = packed(compiled, runnable, y, u)
        matrix = compiled.jacobian(point, w)[len(names) :].reshape(len(names), -1)
        parts = (compiled.rates(point, w)[kept], compiled.outputs(point, w), compiled.guards(point, w))
        after = module.change(row % len(w), numbers, module.CONSTANTS, u, y, w)
        given = module.inputs(0.02 * row)
        expected.append(np.concatenate([*parts, matrix[np.ix_(kept, kept)].ravel(), *after, given]))
    for column, values in enumerate(np.array(expected).T):
        assert_equal(rows[:, column], values, f"{name}: column {column}")
