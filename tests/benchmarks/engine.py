"""How fast a drive runs, beside other integrators at the same accuracy. One command, one run:

    python -m tests.benchmarks.engine

The reference lift: DMSP-20 of 0.8 m with 20 kg, valve with spool, tube, bladder, Dahl friction, creep,
damping, end stops; 4 s, 4001 rows. Each integrator gets the loosest tolerance at which the position stays
within 1e-5 m of scipy's Radau at 1e-10 on five parameter sets; then their runs are timed in turns. CasADi's
line is left out when it is not installed.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from scipy.integrate import odeint, solve_ivp

from mckibben.api.answers.simulations import read_document
from mckibben.drive_input import drive_of
from mckibben.resources import presets_folder
from mckibben.simulation.engine import compiled_drive, integrate, kernel
from mckibben.simulation.transient import parameters_of, segments_of, simulate, start_of
from mckibben.studio import Studio
from tests.benchmarks.translated import translated

ROWS, ACCURACY, SETS, ROUNDS = 4001, 1e-5, 5, 15
TOLERANCES = 10.0 ** np.arange(-3.5, -10.1, -0.5)
DOCUMENT: dict[str, Any] = {
    "muscle": {"preset": "DMSP-20", "nominal_length": "800 mm"},
    "effects": {
        "bladder_elasticity": {}, "prestress": {}, "dahl": {}, "creep": {}, "spool_lag": {},
        "viscous_damping": {"coefficient": "60 N*s/m"}, "valve_delay": {},
    },
    "supply": {"pressure": "6 bar"},
    "valve": {"sonic_conductance": "1.2 l/(s*bar)", "critical_pressure_ratio": 0.3},
    "tube": {"inside_diameter": "4 mm", "length": "1 m"},
    "load": {"mass": "20 kg"},
    "command": {"shape": "pulse", "on": "0 s", "off": "2 s"},
    "duration": "4 s",
}  # fmt: skip
Positions = Callable[[int, float], np.ndarray]
# (state, segment, begin, end, instants, parameter set) -> states at the instants
Solver = Callable[[np.ndarray, int, float, float, np.ndarray, int], np.ndarray]


class Lift:
    """The reference lift, and variations of it by ± 20 %."""

    def __init__(self, studio: Studio) -> None:
        self.drive = drive_of(read_document(DOCUMENT, "the lift"), studio).drive
        self.compiled = compiled_drive(self.drive.structure)
        self.grid = np.linspace(0.0, self.drive.duration, ROWS)
        self.times, self.inputs, _ = segments_of(self.drive)
        usual = parameters_of(self.drive, self.compiled)
        random = np.random.default_rng(7)
        names = list(self.compiled.model.parameters)
        free = [
            names.index(n) for n in ("mass", "fill_conductance", "exhaust_conductance", "supply_pressure")
        ]
        self.parameters = [usual]
        for _ in range(999):
            changed = usual.copy()
            changed[free] *= random.uniform(0.8, 1.2, len(free))
            self.parameters.append(changed)
        self.starts = [start_of(self.drive, self.compiled, p, self.inputs[0]) for p in self.parameters[:SETS]]
        self.scales = np.array([state.scale for state in self.compiled.model.states])
        self.stroke = [state.name for state in self.compiled.model.states].index("stroke")

    def start(self, number: int) -> np.ndarray:
        """States at rest of a parameter set."""
        return self.starts[number % SETS]

    def rows_of_segments(self) -> list[tuple[int, float, float, np.ndarray]]:
        """Segments with the instants of the rows in them."""
        found, written = [], 0
        for index in range(len(self.inputs)):
            begin, end = self.times[index], self.times[index + 1]
            last = index == len(self.inputs) - 1
            stop = int(np.searchsorted(self.grid, end, side="right" if last else "left"))
            found.append((index, begin, end, self.grid[written:stop]))
            written = stop
        return found


def by_segments(lift: Lift, solve: Solver) -> Callable[[int, np.ndarray], np.ndarray]:
    """Positions of a run from a solver of one segment."""

    def positions(number: int, state: np.ndarray) -> np.ndarray:
        found = []
        for index, begin, end, wanted in lift.rows_of_segments():
            instants = np.unique(np.concatenate([[begin], wanted, [end]]))
            states = solve(state, index, begin, end, instants, number)
            found.append(states[np.searchsorted(instants, wanted), lift.stroke])
            state = states[-1]
        return np.concatenate(found)

    return positions


def kernel_positions(lift: Lift, engine: str) -> Positions:
    """Our engine: the kernel, or the same machine code under scipy's solve_ivp."""

    def positions(number: int, tolerance: float) -> np.ndarray:
        rows = integrate(
            lift.compiled, parameters=lift.parameters[number], start=lift.start(number), times=lift.times,
            inputs=lift.inputs, grid=lift.grid, tolerance=tolerance, engine=engine,
        ).rows  # fmt: skip
        return rows[:, lift.stroke].copy()  # a view would keep all rows of a thousand runs

    return positions


def reference_positions(lift: Lift, number: int) -> np.ndarray:
    """Radau at 1e-10 over our machine code."""
    size, parameters = lift.compiled.size, lift.parameters[number]

    def solve(
        state: np.ndarray, index: int, begin: float, end: float, instants: np.ndarray, number: int
    ) -> np.ndarray:
        packed = np.concatenate([state, parameters, lift.inputs[index]])

        def rates(_time: float, y: np.ndarray) -> np.ndarray:
            packed[:size] = y
            return lift.compiled.rates(packed)[:size]

        def jacobian(_time: float, y: np.ndarray) -> np.ndarray:
            packed[:size] = y
            return lift.compiled.jacobian(packed)[size:].reshape(size, size)

        found = solve_ivp(
            rates, (begin, end), state, "Radau", instants, jac=jacobian, rtol=1e-10, atol=1e-11 * lift.scales
        )
        return found.y.T

    return by_segments(lift, solve)(number, lift.start(number))


def python_positions(lift: Lift) -> Positions:
    """Odeint (LSODA) with the equations as Python source."""
    rates = translated(lift.compiled.model, "python")

    def positions(number: int, tolerance: float) -> np.ndarray:
        parameters = list(lift.parameters[number])

        def solve(
            state: np.ndarray, index: int, begin: float, end: float, instants: np.ndarray, number: int
        ) -> np.ndarray:
            rest = [*parameters, *lift.inputs[index]]
            return odeint(
                lambda y, t: rates([*y.tolist(), *rest]), state, instants,
                rtol=tolerance, atol=tolerance * lift.scales, mxstep=100_000,
            )  # fmt: skip

        return by_segments(lift, solve)(number, lift.start(number))

    return positions


def casadi_positions(lift: Lift) -> Positions | None:
    """CasADi's cvodes over the same equations in its own symbols; None where it is not installed."""
    try:
        import casadi
    except ImportError:
        return None
    size, width = lift.compiled.size, lift.inputs.shape[1]
    y = casadi.SX.sym("y", size)
    p = casadi.SX.sym("p", len(lift.parameters[0]) + width)
    scales = casadi.DM(lift.scales)
    rates = translated(lift.compiled.model, "casadi")
    ode = casadi.vertcat(*rates([*casadi.vertsplit(y * scales), *casadi.vertsplit(p)])) / scales
    made: dict[Any, Any] = {}

    def positions(number: int, tolerance: float) -> np.ndarray:
        def solve(
            state: np.ndarray, index: int, begin: float, end: float, instants: np.ndarray, number: int
        ) -> np.ndarray:
            if (index, tolerance) not in made:
                options = {"reltol": tolerance, "abstol": tolerance, "max_num_steps": 100_000}
                made[index, tolerance] = casadi.integrator(
                    "lift", "cvodes", {"x": y, "p": p, "ode": ode}, begin, instants[1:], options
                )
            given = np.concatenate([lift.parameters[number], lift.inputs[index]])
            found = np.array(made[index, tolerance](x0=state / lift.scales, p=given)["xf"]).T * lift.scales
            return np.vstack([state, found])

        return by_segments(lift, solve)(number, lift.start(number))

    return positions


def matched(name: str, positions: Positions, references: list[np.ndarray]) -> tuple[float, float] | None:
    """The loosest tolerance within the accuracy on every set, and its error."""
    for tolerance in TOLERANCES:
        try:
            errors = [
                float(np.max(np.abs(positions(number, float(tolerance)) - reference)))
                for number, reference in enumerate(references)
            ]
        except Exception as error:  # a solver that gives up at this tolerance
            say(f"  {name} at {tolerance:.0e}: {str(error).splitlines()[0][:80]}")
            continue
        if max(errors) <= ACCURACY:
            return float(tolerance), max(errors)
    return None


def say(text: str) -> None:
    """A line at once."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def compare_engines(lift: Lift) -> None:
    """The table of integrators."""
    references = [reference_positions(lift, number) for number in range(SETS)]
    candidates: dict[str, Positions | None] = {
        "machine code, Rodas4 kernel": kernel_positions(lift, "rodas"),
        "machine code, scipy solve_ivp LSODA": kernel_positions(lift, "lsoda"),
        "Python right-hand side, scipy odeint": python_positions(lift),
        "CasADi cvodes": casadi_positions(lift),
    }
    tuned: dict[str, tuple[Positions, float, float]] = {}
    for name, positions in candidates.items():
        if positions is None:
            say(f"{name}: not installed")
            continue
        found = matched(name, positions, references)
        if found is None:
            say(f"{name}: no tolerance is accurate enough")
            continue
        tuned[name] = (positions, *found)
    times: dict[str, list[float]] = {name: [] for name in tuned}
    for _ in range(ROUNDS):
        for name, (positions, tolerance, _error) in tuned.items():
            began = time.perf_counter()
            positions(0, tolerance)
            times[name].append(time.perf_counter() - began)
    fastest = min(statistics.median(column) for column in times.values())
    say("\n| integrator | tolerance | position error | median ms | best ms | times the fastest |")
    say("|---|---:|---:|---:|---:|---:|")
    for name, (_, tolerance, error) in tuned.items():
        middle, best = statistics.median(times[name]), min(times[name])
        say(
            f"| {name} | {tolerance:.0e} | {error:.1e} m | {middle * 1e3:.2f} | {best * 1e3:.2f} "
            f"| {middle / fastest:.1f} |"
        )


def throughput(lift: Lift, tolerance: float) -> None:
    """Many parameter sets on one and two threads; the kernel lets go of the interpreter."""
    positions = kernel_positions(lift, "rodas")
    for threads in (1, 2):
        with ThreadPoolExecutor(threads) as pool:
            began = time.perf_counter()
            list(pool.map(lambda number: positions(number, tolerance), range(len(lift.parameters))))
            took = time.perf_counter() - began
        count = len(lift.parameters)
        say(f"{count} parameter sets, {threads} thread(s): {count / took:.0f} runs/s")


def new_combinations(studio: Studio, lift: Lift) -> None:
    """Time to a new combination of effects, and cost of a run against states and effects."""
    effects = [effect for effect in studio.catalogue.values() if not effect.needs]
    random = np.random.default_rng(3)
    say("\n| effects | states | ready in ms | ms a run | steps |")
    say("|---:|---:|---:|---:|---:|")
    for count in (0, 1, 2, 4, 6, 8, 12, 16):
        built, ran, states, steps = [], [], [], []
        for _ in range(5):
            chosen = random.choice(len(effects), size=count, replace=False)
            document = {**DOCUMENT, "effects": {effects[index].id: {} for index in chosen}}
            drive = drive_of(read_document(document, "the lift"), studio).drive
            began = time.perf_counter()
            compiled_drive.__wrapped__(drive.structure)
            built.append(time.perf_counter() - began)
            run = simulate(drive, points=ROWS, engine="rodas")
            ran.append(min(simulate(drive, points=ROWS, engine="rodas").wall_seconds for _ in range(3)))
            states.append(len(run.states))
            steps.append(run.steps)
        say(
            f"| {count} | {statistics.mean(states):.1f} | {statistics.median(built) * 1e3:.0f} "
            f"(most {max(built) * 1e3:.0f}) | {statistics.median(ran) * 1e3:.2f} "
            f"| {statistics.median(steps):.0f} |"
        )


def main() -> int:
    """Measure everything and print it."""
    kernel.warm().join()
    studio = Studio(presets=presets_folder())
    lift = Lift(studio)
    say(f"{lift.compiled.size} states, {len(lift.drive.model.effects)} effects, {ROWS} rows")
    compare_engines(lift)
    say("")
    throughput(lift, 1e-5)
    new_combinations(studio, lift)
    return 0


if __name__ == "__main__":
    sys.exit(main())
