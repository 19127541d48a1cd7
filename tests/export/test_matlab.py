"""The MATLAB of a model under Octave: the numbers of the engine."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from mckibben.export.formats import linear, python, table
from mckibben.export.formats.linear import linear_points, main_point
from mckibben.export.formats.matlab import write
from mckibben.export.formats.table import lookup_of
from mckibben.simulation.integrate.system import compiled_drive
from tests.export.fmus import our_run
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


def test_tables_interpolate_in_octave_as_they_say_and_matrices_are_read(tmp_path: Path):
    """`interp2` and `interp1` on the tables of the script, and `load` of the linear models of a drive."""
    model = subject("together_0")
    for file in table.write(model, "t"):
        (tmp_path / file.name).write_bytes(file.content)
    matlab, _ = linear.write(drive("lift"), "lift")
    (tmp_path / matlab.name).write_bytes(matlab.content)
    random = np.random.default_rng(9)
    pressure, contraction = random.uniform(1e5, 5e5, 200), random.uniform(0.0, 0.1, 200)
    np.savetxt(tmp_path / "x.csv", np.column_stack([pressure, contraction]), delimiter=",", fmt="%.17g")
    script = """
    t; x = dlmread('x.csv'); s = t_table;
    force = interp2(s.contraction, s.pressure, s.force, x(:, 2), x(:, 1));
    again = interp2(s.contraction, s.force_axis, s.pressure_for_force, x(:, 2), force);
    blocked = interp1(s.pressure, s.blocked_force, x(:, 1));
    m = load('lift.mat');
    assert(isequal(m.A, m.points(3).models(end).A) || isequal(m.A, m.points(3).models(1).A));
    assert(columns(m.B) == numel(m.inputs) && strcmp(m.states{1}, 'stroke') && ischar(m.about));
    f = fopen('y.out', 'w');
    fwrite(f, [force, again, blocked], 'double'); fwrite(f, m.A, 'double'); fclose(f);
    """
    (tmp_path / "run_all.m").write_text(script, "utf-8")
    command = [str(OCTAVE), "--quiet", "--norc", "run_all.m"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    values = np.fromfile(tmp_path / "y.out")
    force, again, blocked = values[:600].reshape(3, 200)
    said = lookup_of(model.statics)
    rest = model.statics.muscle.nominal_length
    exact = model.statics.force(length=rest * (1.0 - contraction), pressure=pressure)
    assert np.max(np.abs(force - exact)) <= 1.1 * said.force_error
    pulls = (exact > 20.0) & np.isfinite(again)
    assert np.count_nonzero(pulls) > 100
    # Back through the inverse table: its own error, and that of the force over its slope.
    slope = model.statics.outputs(length=rest * (1.0 - contraction), pressure=pressure)["force_by_pressure"]
    allowed = 1.1 * (said.pressure_error + said.force_error / slope)
    assert np.all(np.abs(again - pressure)[pulls] <= allowed[pulls])
    line = model.statics.force(length=rest, pressure=pressure)
    assert np.max(np.abs(blocked - line)) <= 1.1 * said.blocked_error + 1e-6
    points, _ = linear_points(drive("lift").runnable)
    np.testing.assert_array_equal(values[600:].reshape(3, 3).T, main_point(points).primary.a)


_RUN = """
1;
function [value, stop, way] = event(m, t, y, k, w)
  value = m.guards(y, k, m.inputs(t), w)(:) + m.least;
  stop = ones(numel(w), 1); way = -stop;
end
warning('off', 'all');
m = lift(); k = m.prepare(m.parameters); y = m.start; w = m.start_switches;
breaks = [BREAKS]; now = 0; times = 0; strokes = y(1);
while now < breaks(end)
  u = m.inputs(now + 1e-12);
  for round = 1:6
    wrong = find(m.guards(y, k, u, w) < -m.least, 1);
    if isempty(wrong), break; end
    [y, w] = m.change(wrong, m.parameters, k, u, y, w);
  end
  last = breaks(find(breaks > now + 1e-12, 1));
  options = odeset('RelTol', 1e-5, 'AbsTol', 1e-8, 'MaxStep', 0.02, ...
                   'Jacobian', @(t, y) m.jacobian(y, k, u, w), 'Events', @(t, y) event(m, t, y, k, w));
  [t, s, te, ye, ie] = ode23s(@(t, y) m.rates(y, k, u, w), [now, last], y, options);
  times = [times; t(2:end)]; strokes = [strokes; s(2:end, 1)]; y = s(end, :)';
  now = t(end);
  if isempty(ie)
    now = last;
  else
    [y, w] = m.change(ie(end), m.parameters, k, u, y, w);
  end
end
f = fopen('y.out', 'w'); fwrite(f, [times, strokes], 'double'); fclose(f);
"""


def test_octaves_own_integrator_makes_the_run_of_the_engine(tmp_path: Path):
    """Right-hand side, Jacobian and events of the written file, by `ode23s`; the lift leaves its stop."""
    model = drive("lift")
    (tmp_path / "lift.m").write_bytes(write(model, "lift")[0].content)
    breaks = f"{float(model.runnable.signals['opening'].times[1])!r}, 0.6"
    (tmp_path / "run_all.m").write_text(_RUN.replace("BREAKS", breaks), "utf-8")
    command = [str(OCTAVE), "--quiet", "--norc", "run_all.m"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    times, strokes = np.fromfile(tmp_path / "y.out").reshape(2, -1)
    grid = np.linspace(0.0, 0.6, 121)
    run = our_run(model, grid)
    assert np.ptp(run.states["stroke"]) > 0.05
    times, first = np.unique(times, return_index=True)
    assert np.max(np.abs(np.interp(grid, times, strokes[first]) - run.states["stroke"])) < 1e-4
