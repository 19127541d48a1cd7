"""The reference lift of the benchmarks, and variations of it."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.documents.studio import Studio
from mckibben.simulation.drive.initial_state import Start, start_of
from mckibben.simulation.drive.transient import parameters_of, segments_of
from mckibben.simulation.integrate.engine import compiled_drive
from tests.simulation.event_radau import EventRadau, Piece

ROWS, SETS = 4001, 5
DOCUMENT: dict[str, Any] = {
    "muscle": {
        "inside_diameter": "20 mm", "braid_angle": "25 deg", "nominal_length": "800 mm",
        "wall_thickness": "1.8 mm",
    },
    "effects": {
        "effectiveness": {"factor": 0.98, "threshold": "0.1 bar"},
        "linear_elasticity": {"stiffness": "400 N/m"},
        "dahl": {"force": "25 N", "break_strain": 0.000375},
        "creep": {"stiffness": "1500 N/m", "time": "0.4 s"},
        "viscous_damping": {"coefficient": "60 N*s/m"},
        "valve_delay": {"opening_time": "5 ms", "closing_time": "5 ms"},
    },
    "supply": {"pressure": "6 bar"},
    "valve": {"sonic_conductance": "1.2 l/(s*bar)", "critical_pressure_ratio": 0.3},
    "tube": {"inside_diameter": "4 mm", "length": "1.2 m"},
    "gas": {"polytropic_exponent": 1.25, "dead_volume": "20 cm^3"},
    "load": {"mass": "20 kg"},
    "command": {"shape": "pulse", "on": "0 s", "off": "2 s"},
    "duration": "4 s",
}  # fmt: skip
WITH_SPOOL: dict[str, Any] = {
    **DOCUMENT,
    "muscle": {"preset": "DMSP-20", "nominal_length": "800 mm"},
    "effects": {
        "bladder_elasticity": {}, "prestress": {}, "dahl": {}, "creep": {}, "spool_lag": {},
        "viscous_damping": {"coefficient": "60 N*s/m"}, "valve_delay": {},
    },
    "tube": {"inside_diameter": "4 mm", "length": "1 m"},
    "gas": {},
}  # fmt: skip
#: Dry friction alone: the load sticks where the force that moves it is less, and breaks away again.
STICKING: dict[str, Any] = {
    **DOCUMENT,
    "effects": {
        "effectiveness": {"factor": 0.98, "threshold": "0.1 bar"},
        "linear_elasticity": {"stiffness": "400 N/m"},
        "coulomb_friction": {"force": "50 N"},
        "viscous_damping": {"coefficient": "60 N*s/m"},
        "valve_delay": {"opening_time": "5 ms", "closing_time": "5 ms"},
    },
}  # fmt: skip
Positions = Callable[[int, float], np.ndarray]
# (state, piece, instants, parameter set) -> states at the instants
Solver = Callable[[np.ndarray, Piece, np.ndarray, int], np.ndarray]


class Lift:
    """The reference lift, and variations of it by ± 20 %."""

    def __init__(self, studio: Studio, *, level: int = 0, document: dict[str, Any] = DOCUMENT) -> None:
        self.drive = drive_of(read_document(document, "the lift"), studio).drive
        self.compiled = compiled_drive(self.drive.structure, level)
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

    def start(self, number: int) -> Start:
        """States and switches at rest of a parameter set."""
        return self.starts[number % SETS]

    @cached_property
    def references(self) -> list[EventRadau]:
        """Radau at 1e-10 on the first parameter sets: rows in ``strokes``, its pieces from event to event."""
        found = []
        for number in range(SETS):
            run = EventRadau(self.drive, self.start(number), self.parameters[number])
            rows = []
            for index, inputs in enumerate(self.inputs):
                begin, end = self.times[index], self.times[index + 1]
                last = index == len(self.inputs) - 1
                rows.append(run.advance(begin, end, inputs, self.grid[self._within(begin, end, last)]))
            run.strokes = np.concatenate(rows)[:, self.stroke]
            found.append(run)
        return found

    def _within(self, begin: float, end: float, last: bool) -> np.ndarray:
        return (self.grid >= begin) & ((self.grid < end) | last)


def by_pieces(lift: Lift, solve: Solver) -> Callable[[int], np.ndarray]:
    """Positions of a run from a solver without events: it is told the instants of the events."""

    def positions(number: int) -> np.ndarray:
        found, state = [], lift.start(number).state
        for piece in lift.references[number].pieces:
            instants = np.unique(np.concatenate([[piece.begin], piece.wanted, [piece.end]]))
            states = solve(state, piece, instants, number)
            found.append(states[np.searchsorted(instants, piece.wanted), lift.stroke])
            state = states[-1].copy()
            for index, value in piece.sets.items():
                state[index] = value
        return np.concatenate(found)

    return positions
