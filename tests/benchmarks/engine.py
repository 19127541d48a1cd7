"""How fast a drive runs, beside other integrators at the same accuracy. One command, one run:

    python -m tests.benchmarks.engine

The reference lift: a muscle of 20 mm and 0.8 m lifts 20 kg for 2 s and lets it down again; 4 s, 4001 rows
with all outputs. Nine states act on each other:

- stroke and speed of the load, with rigid stops at 0 and 25 % contraction;
- the length of the muscle, which may hang slack;
- pressure in the muscle (polytropic, with a dead volume) and in the tube, between ISO 6358 restrictions: a
  valve with a dead time of 5 ms and the tube itself;
- Dahl friction: its share of full friction;
- creep: the extensions of three Maxwell arms.

Beside them run two integrals, the air taken in and let out, and the clock. Static: effectiveness with a
threshold, linear elasticity, viscous damping. In "lift with spool" a spool of second order moves behind the
command and a bladder of rubber takes the place of the spring.

Contact and slack are events. Ours finds them; the integrators of others are told when they happen.

Each integrator gets the loosest tolerance at which the position stays within 1e-5 m of scipy's Radau at
1e-10 on five parameter sets; then their runs are timed in turns. CasADi's line is left out when it is not
installed.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from scipy.integrate import odeint

from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.documents.studio import Studio
from mckibben.resources import presets_folder
from mckibben.simulation.drive.transient import simulate
from mckibben.simulation.integrate.engine import Solution, compiled_drive, integrate
from mckibben.simulation.integrate.lane_buffers import lane_kernels
from tests.benchmarks.lift import DOCUMENT, ROWS, SETS, STICKING, WITH_SPOOL, Lift, Positions, by_pieces
from tests.benchmarks.translated import translated
from tests.simulation.event_radau import Piece
from tests.simulation.lsoda import integrated

ACCURACY, ROUNDS = 1e-5, 15
TOLERANCES = 10.0 ** np.arange(-3.5, -10.1, -0.25)


def kernel_positions(lift: Lift, by: Callable[..., Solution] = integrate) -> Positions:
    """Our engine: the kernel, or the same machine code under scipy's solve_ivp."""

    def positions(number: int, tolerance: float) -> np.ndarray:
        start = lift.start(number)
        rows = by(
            lift.compiled, parameters=lift.parameters[number], start=start.state, switches=start.switches,
            times=lift.times, inputs=lift.inputs, grid=lift.grid, tolerance=tolerance,
        ).rows  # fmt: skip
        return rows[:, lift.stroke].copy()  # a view would keep all rows of a thousand runs

    return positions


def python_positions(lift: Lift) -> Positions:
    """Odeint (LSODA) with the equations as Python source."""
    rates = translated(lift.compiled.model, "python")

    def positions(number: int, tolerance: float) -> np.ndarray:
        parameters = list(lift.parameters[number])

        def solve(state: np.ndarray, piece: Piece, instants: np.ndarray, number: int) -> np.ndarray:
            rest = [*parameters, *piece.inputs, *piece.switches]
            return odeint(
                lambda y, t: rates([*y.tolist(), *rest]), state, instants,
                rtol=tolerance, atol=tolerance * lift.scales, mxstep=100_000,
            )  # fmt: skip

        return by_pieces(lift, solve)(number)

    return positions


def casadi_positions(lift: Lift) -> Positions | None:
    """CasADi's cvodes over the same equations in its own symbols; None where it is not installed."""
    try:
        import casadi
    except ImportError:
        return None
    size, width = lift.compiled.size, lift.inputs.shape[1] + len(lift.compiled.model.switches)
    y = casadi.SX.sym("y", size)
    p = casadi.SX.sym("p", len(lift.parameters[0]) + width)
    scales = casadi.DM(lift.scales)
    rates = translated(lift.compiled.model, "casadi")
    ode = casadi.vertcat(*rates([*casadi.vertsplit(y * scales), *casadi.vertsplit(p)])) / scales
    made: dict[Any, Any] = {}

    def positions(number: int, tolerance: float) -> np.ndarray:
        def solve(state: np.ndarray, piece: Piece, instants: np.ndarray, number: int) -> np.ndarray:
            key = (number, piece.begin, tolerance)
            if key not in made:
                options = {"reltol": tolerance, "abstol": tolerance, "max_num_steps": 100_000}
                made[key] = casadi.integrator(
                    "lift", "cvodes", {"x": y, "p": p, "ode": ode}, piece.begin, instants[1:], options
                )
            given = np.concatenate([lift.parameters[number], piece.inputs, piece.switches])
            found = np.array(made[key](x0=state / lift.scales, p=given)["xf"]).T * lift.scales
            return np.vstack([state, found])

        return by_pieces(lift, solve)(number)

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


def compare_engines(lift: Lift, better: Lift) -> float:
    """The table of integrators, ours with quick and with better machine code; returns our tolerance."""
    references = [run.strokes for run in lift.references]
    candidates: dict[str, Positions | None] = {
        "machine code, Rodas4 kernel": kernel_positions(lift),
        "the same at level 1": kernel_positions(better),
        "machine code, scipy solve_ivp LSODA": kernel_positions(lift, integrated),
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
    return next(iter(tuned.values()))[1]


def throughput(studio: Studio, tolerance: float) -> None:
    """Many parameter sets on one and two threads; the kernel lets go of the interpreter.

    Runs per second of processor time tell what the machine could do when others use it too.
    """
    say("\n| parameter sets | level | threads | runs/s | runs per s of processor time |")
    say("|---:|---:|---:|---:|---:|")
    for level in (0, 1):
        lift = Lift(studio, level=level)
        positions, count = kernel_positions(lift), len(lift.parameters)
        for threads in (1, 2):
            with ThreadPoolExecutor(threads) as pool:
                began, used = time.perf_counter(), time.process_time()
                list(pool.map(lambda number: positions(number, tolerance), range(count)))  # noqa: B023
                took, used = time.perf_counter() - began, time.process_time() - used
            say(f"| {count} | {level} | {threads} | {count / took:.0f} | {count / used:.0f} |")


def levels(studio: Studio, tolerance: float) -> None:
    """What each level of LLVM's code generator costs and gains."""
    say("\n| level | ready in ms | ms a run |")
    say("|---:|---:|---:|")
    for level in range(4):
        lift = Lift(studio, level=level)
        structure, positions = lift.drive.structure, kernel_positions(lift)
        built = [timed(lambda: compiled_drive.__wrapped__(structure, level)) for _ in range(5)]  # noqa: B023
        ran = [timed(lambda: positions(0, tolerance)) for _ in range(20)]  # noqa: B023
        say(f"| {level} | {min(built) * 1e3:.0f} | {min(ran) * 1e3:.2f} |")


def timed(work: Callable[[], Any]) -> float:
    """Seconds that it takes."""
    began = time.perf_counter()
    work()
    return time.perf_counter() - began


def costs(studio: Studio) -> None:
    """Cost of a new structure and of a run at the tolerance of the product: both lifts, random effects."""
    effects = [effect for effect in studio.catalogue.values() if not effect.needs]
    random = np.random.default_rng(3)
    cases = {"reference lift": [DOCUMENT], "lift with spool": [WITH_SPOOL]}
    for count in (0, 1, 2, 4, 6, 8, 12, 16):
        chosen = [random.choice(len(effects), size=count, replace=False) for _ in range(5)]
        cases[f"{count} effects"] = [
            {**DOCUMENT, "effects": {effects[index].id: {} for index in picked}} for picked in chosen
        ]
    say("\n| drive | states | ready in ms | ms a run | steps |")
    say("|---|---:|---:|---:|---:|")
    for name, documents in cases.items():
        built, ran, states, steps = [], [], [], []
        for document in documents:
            drive = drive_of(read_document(document, "the lift"), studio).drive
            for _ in range(3):
                built.append(timed(lambda: compiled_drive.__wrapped__(drive.structure)))  # noqa: B023
            run = simulate(drive, points=ROWS)
            ran.append(min(simulate(drive, points=ROWS).wall_seconds for _ in range(3)))
            states.append(len(run.states))
            steps.append(run.steps)
        say(
            f"| {name} | {statistics.mean(states):.1f} | {statistics.median(built) * 1e3:.0f} "
            f"(most {max(built) * 1e3:.0f}) | {statistics.median(ran) * 1e3:.2f} "
            f"| {statistics.median(steps):.0f} |"
        )


def main() -> int:
    """Measure everything and print it."""
    lane_kernels.warm().join()
    studio = Studio(presets=presets_folder())
    lift = Lift(studio)
    say(f"reference lift: {lift.compiled.size} states with the clock, {ROWS} rows")
    tolerance = compare_engines(lift, Lift(studio, level=1))
    sticking = Lift(studio, document=STICKING)
    say(f"\nlift that sticks: {sum(len(run.pieces) for run in sticking.references)} pieces in {SETS} runs")
    compare_engines(sticking, Lift(studio, level=1, document=STICKING))
    levels(studio, tolerance)
    throughput(studio, tolerance)
    costs(studio)
    return 0


if __name__ == "__main__":
    sys.exit(main())
