"""The kernel on equations with known solutions; the compiled Jacobian against symbolic differentiation."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import symengine as se
from scipy.integrate import solve_ivp

from mckibben.physics.drive import DriveModel
from mckibben.physics.drive_terms import DriveStructure, StateInfo
from mckibben.simulation.integrate.engine import CompiledDrive, Outcome, Solution, compile_system, integrate
from mckibben.simulation.integrate.system import compiled_drive
from tests.shipped import shipped_studio

STUDIO = shipped_studio()
T, Y, Z, K, U = se.symbols("t y z k u")


def system(rates: dict[str, Any], outputs: dict[str, Any]) -> CompiledDrive:
    """Equations in t, y, z with a parameter k and an input u."""
    symbols = {"clock": T, "y": Y, "z": Z}
    model: Any = SimpleNamespace(
        states=[StateInfo(name, 0.0, 1.0) for name in rates],
        symbols={name: symbols[name] for name in rates},
        parameters={"k": K},
        inputs={"u": U},
        rates=[se.sympify(rate) for rate in rates.values()],
        outputs=[se.sympify(output) for output in outputs.values()],
        output_names=tuple(outputs),
        switches=[],
    )
    return compile_system(model)


def run(
    compiled: CompiledDrive, k: float, start: list[float], *, end: float = 2.0, **options: Any
) -> Solution:
    given = {
        "parameters": np.array([k]),
        "start": np.array(start),
        "times": np.array([0.0, end]),
        "inputs": np.zeros((1, 1)),
        "grid": np.linspace(0.0, end, 101),
        "tolerance": 1e-8,
    }
    return integrate(compiled, **{**given, **options})


def driven_by_time() -> CompiledDrive:
    """Prothero and Robinson: y' = k (sin t - y) + cos t has the solution sin t, whatever k."""
    return system({"y": K * (se.sin(T) - Y) + se.cos(T), "clock": 1.0}, {"twice": 2 * Y + T})


@pytest.mark.parametrize("stiffness", [1.0, 30.0, 1e3])
def test_an_equation_driven_by_time(stiffness):
    solution = run(driven_by_time(), stiffness, [0.0, 0.0])
    time = np.linspace(0.0, 2.0, 101)
    assert solution.rows[:, 0] == pytest.approx(np.sin(time), abs=1e-7)
    assert solution.rows[:, 1] == pytest.approx(time, abs=1e-15)
    assert solution.rows[:, 2] == pytest.approx(2 * np.sin(time) + time, abs=2e-7)
    # A wrong derivative by time costs the order, and thousands of steps.
    assert solution.steps + solution.rejected < 1000


def test_a_very_stiff_equation_takes_few_steps():
    solution = run(driven_by_time(), 1e6, [0.0, 0.0])
    assert solution.end[0] == pytest.approx(np.sin(2.0), abs=1e-8)
    assert solution.steps + solution.rejected < 50


def test_the_order_is_four():
    equation = system({"clock": 1.0, "y": -K * Y**2 * se.cos(T) * se.exp(-Y)}, {})
    errors, steps = [], []
    exact = run(equation, 3.0, [0.0, 1.0], tolerance=1e-13).end[1]
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        solution = run(equation, 3.0, [0.0, 1.0], tolerance=tolerance, grid=np.array([0.0]))
        errors.append(abs(solution.end[1] - exact))
        steps.append(solution.steps)
    slope = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert slope < -3.5


def test_an_integral_beside_an_oscillator():
    # z' = y^2 counts along; nothing depends on it.
    equation = system({"y": se.cos(T) * K, "z": Y**2, "clock": 1.0}, {})
    solution = run(equation, 1.0, [0.0, 0.0, 0.0])
    assert solution.end[1] == pytest.approx(1.0 - np.sin(4.0) / 4.0, abs=1e-7)


def test_van_der_pol_against_radau():
    equation = system({"clock": 1.0, "y": Z, "z": K * ((1 - Y**2) * Z - Y)}, {})
    solution = run(equation, 200.0, [0.0, 2.0, 0.0])
    found = solve_ivp(
        lambda _t, y: [y[1], 200.0 * ((1 - y[0] ** 2) * y[1] - y[0])], (0.0, 2.0), [2.0, 0.0], "Radau",
        np.linspace(0.0, 2.0, 101), rtol=1e-11, atol=1e-13,
    )  # fmt: skip
    assert solution.rows[:, 1] == pytest.approx(found.y[0], abs=1e-6)


def test_the_input_of_each_segment_and_the_step_that_goes_on():
    equation = system({"y": U, "clock": 1.0}, {})
    times = np.array([0.0, 0.5, 0.75, 2.0])
    solution = run(
        equation, 1.0, [0.0, 0.0], times=times, inputs=np.array([[1.0], [-4.0], [2.0]]), grid=times
    )
    assert solution.rows[:, 0] == pytest.approx([0.0, 0.5, -0.5, 2.0], abs=1e-12)
    assert solution.next_step > 1e-4
    again = run(equation, 1.0, [0.0, 0.0], first_step=solution.next_step)
    assert again.steps < run(equation, 1.0, [0.0, 0.0]).steps


def test_what_leaves_all_bounds_diverges():
    equation = system({"clock": 1.0, "y": K * Y**2}, {})
    solution = run(equation, 1.0, [0.0, 1.0])  # 1/(1 - t)
    assert solution.outcome is not Outcome.COMPLETED
    assert 45 <= len(solution.rows) <= 51, "it ends where the solution does"


@pytest.mark.parametrize(
    "names",
    [(), ("bladder_elasticity", "dahl", "creep", "spool_lag"), ("heat_exchange", "rig_compliance", "leak")],
)
@pytest.mark.parametrize("kind", ["tube", "regulator", "pair"])
def test_the_jacobian_is_the_derivative_of_the_rates(names, kind):
    structure = DriveStructure(tuple(STUDIO.catalogue[name] for name in names), **{kind: True})
    model, compiled = DriveModel(structure), compiled_drive(structure)
    switches = [switch.symbol for switch in model.switches]
    guards = [switch.guard for switch in model.switches]
    arguments = [*model.symbols.values(), *model.parameters.values(), *model.inputs.values(), *switches]
    size = compiled.size
    whole = se.Matrix(model.rates).jacobian(se.Matrix(list(model.symbols.values())))
    plain = se.Lambdify(arguments, [*model.rates, *model.outputs, *guards, *whole], cse=True)
    row = np.random.default_rng(5).uniform(0.5, 1.5, len(arguments))
    packed, state = row[: -len(switches)], row[-len(switches) :]
    rates, outputs, guard, entries = np.split(plain(row), np.cumsum([size, compiled.width, len(guards)]))
    assert compiled.rates(packed, state) == pytest.approx(rates, rel=1e-9)
    assert compiled.outputs(packed, state) == pytest.approx(outputs, rel=1e-9)
    assert compiled.guards(packed, state) == pytest.approx(guard, rel=1e-9)
    assert compiled.jacobian(packed, state)[:size] == pytest.approx(rates, rel=1e-9)
    scale = np.max(np.abs(entries))
    assert compiled.jacobian(packed, state)[size:] == pytest.approx(entries, rel=1e-8, abs=1e-14 * scale)


def test_every_level_computes_the_same():
    structure = DriveStructure((STUDIO.catalogue["bladder_elasticity"], STUDIO.catalogue["dahl"]), tube=True)
    quick, good = compiled_drive(structure), compiled_drive(structure, 2)
    assert quick is not good
    packed = np.random.default_rng(6).uniform(
        0.5, 1.5, quick.size + len(quick.model.parameters) + len(quick.model.inputs)
    )
    assert quick.rates(packed) == pytest.approx(good.rates(packed), rel=1e-10)
