"""Transient tests: a load on a muscle behind a valve, its protocols, noise and file."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any
from zlib import crc32

import numpy as np

from tests.truth import valves
from tests.truth.bench import rms
from tests.truth.cases import Case, Held, file_name
from tests.truth.commands import OTHER, STEPS, Corners, command_at
from tests.truth.composition import Hidden
from tests.truth.drive import STEP
from tests.truth.drive import run as simulated
from tests.truth.muscle import FULL_PRESSURE, GRAVITY, ROOM, Array, Muscle
from tests.truth.plant import Plant, Trace
from tests.truth.sensors import Noise
from tests.truth.tables import STYLES, text_of

_VALVE = ("delay_on", "delay_off", "delay_blur", "hysteresis", "spool", "spool_speed", "overlap")


@dataclass(frozen=True)
class Setup:
    """A drive as its user knows it.

    Attributes:
        plant: its numbers without anything hidden.
        start: gauge pressure at which the load hangs at rest [Pa].
        known: effects of the start model that are not numbers of the plant.
        effects: the same as the user states them.
        document: the drive document without command and duration.
    """

    muscle: Muscle
    plant: Plant
    start: float
    known: tuple[Hidden, ...]
    effects: dict[str, dict[str, Any]]
    document: dict[str, Any] = field(default_factory=dict)


def setup(
    muscle: Muscle,
    *,
    damped: bool = True,
    share: float = 0.2,
    rest: float = 0.06,
    ratio: float = 0.3,
    tube: tuple[float, float] | None = None,
    flow: float = 1.0,
    wall: tuple[dict, tuple[Hidden, ...]] | None = None,
) -> Setup:
    """A load that hangs on the muscle.

    Args:
        damped: whether the user knows a linear damping of a quarter of the critical one.
        share: weight over the blocked force at 6 bar.
        rest: contraction at which the load hangs to begin with.
        ratio: critical pressure ratio of the valve.
        tube: bore and length [m].
        flow: conductance of the valve over that of filling at about 9 bar/s.
        wall: known wall of the muscle: effects, and their truth.
    """
    mass = float(f"{share * muscle.blocked / GRAVITY:.3g}")
    length = muscle.nominal * (1.0 - rest)
    at = np.array(length)
    effects, known = wall or ({}, ())
    push = sum(float(np.asarray(part.elastic(at, np.array(ROOM)))) for part in known if part.elastic)
    start = float(f"{(mass * GRAVITY - push) / float(muscle.area(at)):.4g}")
    volume = float(muscle.volume(np.array(0.9 * muscle.nominal)))
    conductance = float(f"{1e-5 * volume * flow:.3g}")
    stiffness = 3.0 * length * 3e5 / (2.0 * np.pi * muscle.turns**2)
    damping = float(f"{0.5 * np.sqrt(stiffness * mass):.3g}") if damped else 0.0
    plant = Plant(
        muscle.nominal, muscle.thread, muscle.turns, damping=damping, mass=mass, weight=mass * GRAVITY,
        fill=conductance, vent=conductance, ratio=ratio,
    )  # fmt: skip
    if damped:
        effects = effects | {"viscous_damping": {"coefficient": damping}}
    document: dict[str, Any] = {
        "schema": 1,
        "muscle": muscle.document(),
        "effects": effects,
        "supply": {"pressure": "6 bar"},
        "valve": {"sonic_conductance": conductance, "critical_pressure_ratio": ratio},
        "load": {"mass": f"{mass:.6g} kg", "arrangement": "hanging"},
        "gas": {"polytropic_exponent": 1.2},
        "stops": {"min_contraction": -0.05, "max_contraction": 0.33},
        "start_pressure": start,
    }
    if tube is not None:
        plant = plant._replace(tube_bore=tube[0], tube_length=tube[1])
        document["tube"] = {"inside_diameter": tube[0], "length": tube[1]}
    return Setup(muscle, plant, start, known, effects, document)


def opening_of(time: Array, corners: Corners, numbers: dict[str, float]) -> Array:
    """What the valve makes of a command on a fine grid."""
    command = command_at(time, corners)
    if "delay_on" in numbers:
        command = valves.dead_time(
            time, command, numbers["delay_on"], numbers["delay_off"], numbers["delay_blur"]
        )
    if "hysteresis" in numbers:
        command = valves.preisach(command, numbers["hysteresis"])
    if "spool" in numbers:
        step = float(time[1] - time[0])
        command = valves.spool(command, step, numbers["spool"], 0.9, numbers["spool_speed"])
    if "overlap" in numbers:
        command = valves.overlap(command, numbers["overlap"], 0.3 * numbers["overlap"])
    return command


@dataclass(frozen=True)
class Test:
    """One run: the protocol, and how it is written down."""

    corners: Corners = STEPS
    every: int = 40  # steps per sample: 2 ms
    forced: bool = False  # whether the tension is measured
    commanded: bool = True  # whether the command is written; else the pressure is the given quantity


def simulate(rig: Setup, parts: tuple[Hidden, ...], test: Test, pressure: Array | None = None) -> Trace:
    """The truth of a rig with hidden parts; with ``pressure`` (absolute, at the samples) a driven run."""
    numbers: dict[str, float] = {}
    for part in parts:
        numbers |= part.air
    plant = rig.plant._replace(**{k: v for k, v in numbers.items() if k not in _VALVE})
    rows = round(test.corners[-1][0] / (test.every * STEP)) + 1
    grid = np.arange(2.0 * test.every * (rows - 1) + 1.0) * (0.5 * STEP)
    given = None
    if pressure is not None:
        plant = plant._replace(driven=1.0)
        given = np.interp(grid, np.arange(rows) * test.every * STEP, pressure)
    length = np.linspace(0.55 * rig.muscle.nominal, 0.9995 * rig.muscle.thread, 3000)
    room = np.full_like(length, ROOM)
    table = np.zeros_like(length)
    for part in (*rig.known, *parts):
        if part.elastic:
            table = table + part.elastic(length, room)
    return simulated(
        plant,
        rows=rows,
        every=test.every,
        opening=opening_of(grid, test.corners, numbers),
        start_gauge=rig.start,
        wall=(table, float(length[0]), float(length[-1])),
        pressure=given,
    )


def _shown(rig: Setup, parts: tuple[Hidden, ...], trace: Trace) -> dict[str, Array]:
    channels = {
        "time": np.asarray(trace.time),
        "pressure": np.asarray(trace.pressure) - rig.plant.ambient,
        "length": rig.muscle.nominal - np.asarray(trace.stroke),
        "force": np.asarray(trace.force),
    }
    for part in parts:
        if part.reading:
            channels = part.reading(dict(channels))
    return channels


@dataclass(frozen=True)
class _Run:
    """One run: what happened, what ideal sensors show, what was read, the noise of what is predicted."""

    trace: Trace
    shown: dict[str, Array]
    columns: dict[str, Array]
    clean: dict[str, Array]
    level: dict[str, float]


def _run(rig: Setup, hidden: tuple[Hidden, ...], test: Test, noise: Noise, rng: np.random.Generator) -> _Run:
    trace = simulate(rig, hidden, test)
    shown = _shown(rig, hidden, trace)
    rows = len(shown["time"])
    columns = {"time": shown["time"], "group": np.zeros(rows)}
    errors = {}
    for channel in ("pressure", "length", "force"):
        columns[channel] = noise.quantised(channel, shown[channel] + noise.white(channel, rows, rng))
        errors[channel] = columns[channel] - shown[channel]
    columns["command"] = command_at(shown["time"], test.corners)
    if test.commanded:
        predicted = ("pressure", "length", "force") if test.forced else ("pressure", "length")
        clean = shown
    else:
        predicted = ("length",)
        pressure = np.asarray(trace.pressure) + errors["pressure"]
        clean = _shown(rig, hidden, simulate(rig, hidden, test, pressure))
    level = {channel: rms(columns[channel] - clean[channel]) for channel in predicted}
    return _Run(trace, shown, columns, clean, level)


def _text(rig: Setup, test: Test, run: _Run, rng: np.random.Generator, *, said: bool) -> str:
    conditions = {"kind": "transient"} if said else {}
    if not test.commanded:
        conditions["load_mass"] = rig.document["load"]["mass"]
    return text_of(
        run.columns,
        nominal=rig.muscle.nominal,
        style=STYLES[int(rng.integers(len(STYLES)))],
        conditions=conditions,
        stroke="displacement",
        channels=("time", "pressure")
        + (("command",) if test.commanded else ())
        + (("force",) if test.forced else ()),
    )


def _document(rig: Setup, test: Test) -> dict[str, Any]:
    return rig.document | {
        "command": {
            "shape": "table",
            "times": [corner[0] for corner in test.corners],
            "values": [corner[1] for corner in test.corners],
        },
        "duration": test.corners[-1][0],
    }


def transient_case(
    name: str,
    seed: int,
    rig: Setup,
    hidden: tuple[Hidden, ...],
    rng: np.random.Generator,
    test: Test | None = None,
    *,
    unknown: str | None = None,
    said: bool | None = None,
) -> Case:
    """Run, add noise, write the file. Arguments as for `tests.truth.laboratory.case_of`."""
    test = test or Test()
    full = rig.muscle.blocked
    noise = Noise(
        levels={
            "pressure": float(rng.uniform(1e-3, 1.5e-3)) * FULL_PRESSURE,
            "length": float(rng.uniform(4e-5, 8e-5)),
            "force": float(rng.uniform(1e-3, 2e-3)) * full,
        },
        ranges={"pressure": 1e6, "length": 0.5, "force": 1.5 * full},
        bits=int(rng.choice([12, 14, 16])),
    )
    run = _run(rig, hidden, test, noise, rng)
    ratios = []
    for index, part in enumerate(hidden):
        rest = hidden[:index] + hidden[index + 1 :]
        if test.commanded:
            other = _shown(rig, rest, simulate(rig, rest, test))
        else:
            seen = np.asarray(run.trace.pressure)
            if part.reading:
                seen = part.reading(dict(run.shown))["pressure"] + rig.plant.ambient
            other = _shown(rig, rest, simulate(rig, rest, test, seen))
        shares = [rms(run.shown[channel] - other[channel]) / level for channel, level in run.level.items()]
        ratios.append(float(np.sqrt(np.mean(np.square(shares)))))
    named = {"length": "displacement"}
    stroke = {"length": lambda values: rig.muscle.nominal - values}
    keep = {channel: stroke.get(channel, np.asarray) for channel in run.level}
    said = bool(rng.random() < 0.5) if said is None else said
    text = _text(rig, test, run, rng, said=said)
    # Random numbers of its own: what the diagnosis sees does not depend on what it does not see.
    other_test = replace(test, corners=OTHER[test.corners])
    own = np.random.default_rng([crc32(name.encode()), seed, 1])
    other_run = _run(rig, hidden, other_test, noise, own)
    held = Held(
        _text(rig, other_test, other_run, own, said=True),
        _document(rig, other_test) if test.commanded else None,
        {named.get(channel, channel): level for channel, level in other_run.level.items()},
    )
    answers = hidden[:-1] if unknown else hidden
    return Case(
        name=name,
        kind="transient",
        hidden=tuple(part.accepted for part in answers),
        unknown=unknown,
        muscle=rig.muscle.document(),
        drive=_document(rig, test) if test.commanded else None,
        effects=rig.effects,
        files={file_name(text): text},
        noise={named.get(channel, channel): level for channel, level in run.level.items()},
        seed=seed,
        truths=tuple(part.name for part in hidden),
        ratios=tuple(ratios),
        rows=len(run.columns["time"]),
        clean={named.get(c, c): keep[c](run.clean[c]) for c in run.level},
        measured={named.get(c, c): keep[c](run.columns[c]) for c in run.level},
        held=held,
    )
