"""Simulation of a drive: columns on the requested grid, timing from a finer grid, limits, notes."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import ClassVar

import numpy as np

from mckibben.application.curves.curves import EffectSettings, settings_of
from mckibben.application.envelope import use_notices
from mckibben.application.muscle_summary import (
    GeometrySummary,
    MakerLimits,
    Notice,
    curve_fit_notices,
    geometry_of,
    limit_notices,
    start_notices,
    stretch_notices,
    unverified_notice,
)
from mckibben.application.operating_limits import (
    pressure_notices,
    suspended_notices,
    temperature_notices,
    valve_notices,
)
from mckibben.application.prediction_interval import PositionInterval
from mckibben.application.run.drive_run import measured_interval, run_drive, use_of_run
from mckibben.application.run.events import STILL, RunEvent, events_of_run, rest_of_run
from mckibben.application.run.verdict import RunVerdict, verdict_of
from mckibben.documents.drive_reading import AnnotatedDrive
from mckibben.facts.comparison import CHANNELS
from mckibben.facts.figure import Figure, Group
from mckibben.facts.result import Booleans, Deferring, FiniteSeries, Number, Series, once, result_class
from mckibben.facts.run import JOINT, RUN, curve_fit_of
from mckibben.measurement.reading.conditions import COMMAND_BEFORE, IGNORE
from mckibben.physics.drive_terms import COUNTER
from mckibben.physics.errors import InputError
from mckibben.physics.gas import ANR_DENSITY
from mckibben.physics.model import Model
from mckibben.physics.units import GRAVITY
from mckibben.simulation.drive.static_contraction import static_contraction
from mckibben.simulation.drive.transient import Run, held_interval
from mckibben.simulation.integrate.engine import MOST_EVENTS
from mckibben.simulation.outcome import Outcome, OutcomeName, Watch
from mckibben.simulation.statics.characteristics import FILLING, VENTING
from mckibben.simulation.statics.limits import FlagCode, LimitFlag
from mckibben.simulation.timing.evaluation import (
    ChokedInterval,
    Grid,
    choked_of,
    grid_of,
    of_figures,
    stops_of,
    timing_of,
    trace_of,
    tracking_of,
)
from mckibben.simulation.timing.table import TimingTable
from mckibben.simulation.timing.tracking import Tracking

Array = np.ndarray

POINTS = 2001
_SLACK = 1e-6  # m; a muscle longer than its fittings are apart by more than this hangs slack
# Field of the document for each limit.
_FIELDS = {FlagCode.OVER_PRESSURE: "supply.pressure", FlagCode.OVER_FORCE_LIMIT: "load"}
_ABOVE = 1.001  # value over limit up to which the excess may be an integration error


@result_class
class JointMotion:
    """A joint, and its second muscle, whose channels are null where there is one muscle."""

    FIGURES: ClassVar = JOINT.name

    angle: Series
    torque: Series
    stiffness: Series
    counter_force: Series | None
    counter_pressure: Series | None
    counter_command: Series | None
    counter_mass_flow: Series | None
    counter_supply_flow: Series | None
    counter_exhaust_flow: Series | None
    counter_diameter: Series | None
    angle_reference: Series | None
    stiffness_reference: Series | None
    stiffness_error: float | None
    angle_range: tuple[Number, Number]
    torque_range: tuple[Number, Number]
    stiffness_range: tuple[Number, Number]


def joint_of(run: Run, rows: Array, figures: Run) -> JointMotion | None:
    """Angle, torque and stiffness of a joint; the stiffness at constant pressures.

    Args:
        run: the run.
        rows: of the result.
        figures: the run at the times of its figures.
    """
    drive = run.drive
    if drive.pulley_radius is None:
        return None
    radius = drive.pulley_radius
    error, wanted = None, None
    if drive.stiffness is not None:
        wanted = np.asarray(drive.stiffness.reference.value(run.time[rows]))
        if len(figures.time) > 1:
            square = (_stiffness(figures, slice(None)) - drive.stiffness.reference.value(figures.time)) ** 2
            error = float(np.sqrt(np.trapezoid(square, figures.time) / np.ptp(figures.time)))
    angle = run.states["stroke"][rows] / radius
    stiffness = _stiffness(run, rows)
    torque = _torque(run, rows)
    return JointMotion(
        angle=angle,
        torque=torque,
        stiffness=stiffness,
        **_second_muscle(run, rows),
        angle_reference=None
        if drive.reference is None
        else np.asarray(drive.reference.value(run.time))[rows] / radius,
        stiffness_reference=wanted,
        stiffness_error=error,
        angle_range=_range(angle),
        torque_range=_range(torque),
        stiffness_range=_range(stiffness),
    )


_SECOND = (
    "counter_force", "counter_pressure", "counter_command", "counter_mass_flow", "counter_supply_flow",
    "counter_exhaust_flow", "counter_diameter",
)  # fmt: skip


def _second_muscle(run: Run, rows: Array) -> dict[str, Array | None]:
    """Channels of the second muscle of a joint; None of each where there is one muscle."""
    drive = run.drive
    if not drive.pair:
        return dict.fromkeys(_SECOND)
    if run.counter_command is not None:
        command = run.counter_command.value(run.time)[rows]
    else:
        own = drive.command if drive.reference is None else run.command
        command = 2.0 * drive.common_command - np.asarray(own.value(run.time))[rows]
    flows = (run.outputs[f"{name}_flow{COUNTER}"][rows] for name in ("mass", "supply", "exhaust"))
    values = (
        run.outputs[f"force{COUNTER}"][rows],
        run.states[f"pressure{COUNTER}"][rows] - drive.ambient_pressure,
        command,
        *flows,
        run.outputs[f"diameter{COUNTER}"][rows],
    )
    return dict(zip(_SECOND, values, strict=True))


def _torque(run: Run, rows: Array) -> Array:
    """Torque of the muscles on the joint [N m]."""
    drive = run.drive
    forces = [run.outputs[f"force{suffix}"][rows] for suffix in ("", COUNTER)[: 1 + drive.pair]]
    if drive.path is None:
        return (drive.pulley_radius or 0.0) * (forces[0] - forces[1])
    stroke = run.states["stroke"][rows]
    levers = [np.asarray(drive.held(stroke, number).lever) for number in range(len(forces))]
    return np.sum([lever * force for lever, force in zip(levers, forces, strict=True)], axis=0)


def _range(values: Array) -> tuple[float, float]:
    """Least and largest value; NaN of none."""
    finite = values[np.isfinite(values)]
    return (float(finite.min()), float(finite.max())) if len(finite) else (float("nan"), float("nan"))


def _stiffness(run: Run, rows: Array | slice) -> Array:
    """Stiffness of the joint at constant pressures [N m/rad]; of a path with the change of its levers."""
    drive = run.drive
    stroke = run.states["stroke"][rows]
    total = np.zeros(len(stroke))
    for number, length in enumerate(drive.lengths(stroke)):
        name = f"pressure{COUNTER}" if number else "pressure"
        seen = drive.model.outputs(
            length=length,
            pressure=run.states[name][rows] - drive.ambient_pressure,
            temperature=drive.temperature,
        )
        lever, slope = np.full(len(stroke), drive.pulley_radius or 0.0), np.zeros(len(stroke))
        if drive.path is not None:
            lever = np.asarray(drive.held(stroke, number).lever)
            slope = np.asarray(drive.path.path(number).lever_slope(stroke / drive.path.rim))
        own = lever**2 * seen["tension_by_length"] - slope * seen["tension"]
        total += np.where(seen["tension"] > 0.0, own, 0.0)
    return total


@dataclass(frozen=True, slots=True)
class SimulationQuestion:
    """A drive, and the part of its run to return.

    Attributes:
        annotated: the drive with notes on its parts.
        points: rows of the result, at least two.
        begin, end: times of the first and last row [s]; None = the whole run.
        static: whether the static contractions of each row are asked for, which take as long as the run.
    """

    annotated: AnnotatedDrive
    points: int = POINTS
    begin: float | None = None
    end: float | None = None
    static: bool = False


@result_class
class SensorReadings:
    """Readings of the sensors: gauge pressure [Pa], force [N], position of the load [m]."""

    pressure: Series
    """Gauge pressure [Pa]."""
    force: Series
    """Force [N]."""
    position: Series
    """Position of the load [m]."""


@result_class
class StartPosition:
    """Position of the load [m] and contraction of the muscle [-] at t = 0, and why the run starts there."""

    position: float
    """Position of the load at t = 0 [m]."""
    contraction: float
    """Contraction of the muscle at t = 0 [-]."""
    reason: str
    """Why the run starts there, as a sentence."""
    lowest: float | None
    """Lowest position at which dry friction holds the load at the start pressure [m]; None without it."""
    highest: float | None
    """Highest such position [m]."""


@result_class
class DriveBounds(MakerLimits):
    """Limits stated by the maker, and positions of the load at the end stops; SI."""

    position_min: float
    """Lower stop as a position of the load [m]."""
    position_max: float
    """Upper stop as a position of the load [m]."""


@result_class
class SimulationResult(Deferring):
    """Columns over time, SI; pressures gauge, positions positive = muscle shorter."""

    FIGURES: ClassVar = RUN.name

    time: FiniteSeries
    position: Series
    velocity: Series
    acceleration: Series
    pressure: Series
    force: Series
    mass_flow: Series
    command: Series
    opening: Series
    reference: Series | None
    supply_flow: Series
    exhaust_flow: Series
    tube_pressure: Series | None
    regulator_pressure: Series | None
    volume: Series
    diameter: Series
    length: Series
    contraction: Series
    static_filling: Series | None
    static_venting: Series | None
    load_force: Series
    temperature: Series
    contact: Booleans
    slack: Booleans
    stuck: Booleans
    friction: Series
    friction_share: Series
    events: list[RunEvent]
    """What happens in the whole run, whatever rows are requested: impacts, slack, sticking, breaking away."""
    rest: str | None
    """What holds the load at the end if dry friction does, and the force left until it breaks away."""
    start: StartPosition
    """Where the load is at t = 0, and why there."""
    gas: str
    """How the air in the muscle is modelled."""
    readings: SensorReadings | None
    """None if no effect changes the sensor readings."""
    joint: JointMotion | None
    """Joint of an antagonist pair."""
    interval: PositionInterval | None
    """Where new readings of the position are expected; None where the model was not fitted."""
    choked: list[ChokedInterval]
    """Choked intervals of the whole run, whatever rows are requested."""
    timing: TimingTable
    """Times, speeds and air of the first fill and the vent after it."""
    tracking: Tracking | None
    """Tracking figures of a controlled run."""
    verdict: RunVerdict
    """Whether the run does what its command or its reference asks."""
    outcome: OutcomeName
    """How the run ended; only a completed one has all rows."""
    message: str | None
    """Advice if the run did not complete."""
    wall_ms: float
    """Computing time of the integration in ms."""
    steps: int
    """Steps of the integrator."""
    flags: list[Notice]
    """Remarks on the run."""
    notes: dict[str, str]
    """Field -> remark, including those of timing and tracking."""
    limits: DriveBounds
    """Limits stated by the maker, and the end stops."""
    geometry: GeometrySummary
    """Geometry of the muscle at rest, in all forms."""
    model: EffectSettings
    """The effects used, with all their values."""
    weight: float
    spring: float
    lever_ratio: float
    duration: float
    supplied_volume_anr: float | None
    conditions: dict[str, str]
    """What a measurement file of this run states besides its columns: condition -> value with its unit."""


def prepare(question: SimulationQuestion) -> Callable[[Watch], SimulationResult]:
    """The run of a question, ready to start.

    Raises:
        InputError: the rows do not lie within the run; field "from" or "to".
    """
    drive = question.annotated.drive
    duration = drive.duration
    begin = 0.0 if question.begin is None else question.begin
    end = duration if question.end is None else question.end
    if not 0.0 <= begin < end <= duration:
        raise InputError(
            f"the rows from {begin:g} s to {end:g} s do not lie within the run",
            field="from" if question.begin is not None else "to",
            hint=f"0 to {duration:g} s",
        )
    jumps = drive.command.segments(duration).times[1:-1].tolist() if drive.controller is None else ()
    grid = grid_of(duration=duration, begin=begin, end=end, points=question.points, jumps=jumps)

    def work(watch: Watch) -> SimulationResult:
        run = run_drive(question.annotated, grid, watch)
        interval = measured_interval(question.annotated, grid, run, watch)
        return result_of(question.annotated, grid, run, interval, static=question.static)

    return work


def simulate(question: SimulationQuestion, watch: Watch | None = None) -> SimulationResult:
    """Simulate the drive.

    Raises:
        InputError: the rows do not lie within the run, or there is no equilibrium to start from.
    """
    return prepare(question)(watch or Watch())


def result_of(
    annotated: AnnotatedDrive,
    grid: Grid,
    run: Run,
    interval: PositionInterval | None = None,
    *,
    static: bool = False,
) -> SimulationResult:
    """The complete result of a run; each field is computed when it is first read."""
    drive, out, states = run.drive, run.outputs, run.states
    rows = grid.rows if len(run.time) == len(grid.time) else grid.rows[grid.rows < len(run.time)]
    lever, rest = drive.load.lever_ratio, drive.muscle.nominal_length
    message = None if run.outcome is Outcome.COMPLETED else run.outcome.advice()

    # What several fields rest on; figures are of the same times whatever rows are asked for.
    figures = once(lambda: of_figures(run, grid))
    trace = once(lambda: trace_of(figures()))
    table = once(lambda: timing_of(drive, trace()))
    follows = once(lambda: tracking_of(figures(), trace()))
    between = once(lambda: held_interval(drive))
    contraction = once(lambda: drive.contraction(states["stroke"]))

    def at_rows(name: str, of: Mapping[str, Array] = out, over: float = 1.0) -> Callable[[], Array]:
        return lambda: of[name][rows] if over == 1.0 else of[name][rows] / over

    def gauge(name: str) -> Array | None:
        return states[name][rows] - drive.ambient_pressure if name in states else None

    def at_rest(direction: float) -> Array | None:
        if not static or drive.path is not None:
            return None
        return static_contraction(
            drive,
            pressure=run.pressure[rows],
            counter_pressure=gauge(f"pressure{COUNTER}"),
            load_force=out["external_force"][rows],
            direction=direction,
        )

    def supplied() -> float | None:
        found = trace()
        return None if found is None else float(np.ptp(found.supplied)) / ANR_DENSITY

    return SimulationResult.deferred(
        time=lambda: run.time[rows],
        position=at_rows("stroke", states, lever),
        velocity=at_rows("speed", states, lever),
        acceleration=at_rows("acceleration", over=lever),
        pressure=lambda: gauge("pressure"),
        force=at_rows("force"),
        mass_flow=at_rows("mass_flow"),
        command=lambda: (drive.command if drive.reference is None else run.command).value(run.time[rows]),
        opening=at_rows("opening"),
        reference=lambda: None if drive.reference is None else drive.reference.value(run.time[rows]),
        supply_flow=at_rows("supply_flow"),
        exhaust_flow=at_rows("exhaust_flow"),
        tube_pressure=lambda: gauge("tube_pressure"),
        regulator_pressure=lambda: gauge("regulator_pressure"),
        volume=at_rows("volume"),
        diameter=at_rows("diameter"),
        length=lambda: rest * (1.0 - contraction()[rows]),
        contraction=lambda: contraction()[rows],
        static_filling=lambda: at_rest(FILLING),
        static_venting=lambda: at_rest(VENTING),
        load_force=at_rows("external_force"),
        temperature=at_rows("gas_temperature"),
        contact=lambda: out["contact"][rows] != 0.0,
        slack=lambda: states["length"][rows] > rest * (1.0 - contraction()[rows]) + _SLACK,
        stuck=lambda: _stuck(run)[rows],
        friction=at_rows("friction"),
        friction_share=at_rows("friction_share"),
        events=lambda: events_of_run(run),
        rest=lambda: rest_of_run(run) if run.outcome is Outcome.COMPLETED else None,
        start=lambda: StartPosition(
            run.start.stroke / lever,
            float(drive.contraction(run.start.stroke)),
            run.start.why.value,
            *(end if end is None else end / lever for end in between() or (None, None)),
        ),
        gas=lambda: drive.gas_closure,
        readings=lambda: _readings(run, rows),
        joint=lambda: joint_of(run, rows, figures()),
        interval=lambda: interval,
        choked=lambda: choked_of(figures()),
        timing=table,
        tracking=follows,
        verdict=lambda: verdict_of(table(), follows(), run.outcome, message),
        outcome=lambda: run.outcome.label,
        message=lambda: message,
        wall_ms=lambda: run.wall_seconds * 1e3,
        steps=lambda: run.steps,
        flags=lambda: _flags(annotated, figures()),
        notes=lambda: _notes(annotated, run, table(), follows(), held=between() is not None),
        limits=lambda: _bounds(annotated),
        geometry=lambda: geometry_of(annotated.start),
        model=lambda: settings_of(drive.model, annotated.start),
        weight=lambda: drive.load.mass * GRAVITY * float(np.sin(drive.load.inclination)),
        spring=lambda: drive.load.spring,
        lever_ratio=lambda: lever,
        duration=lambda: drive.duration,
        supplied_volume_anr=supplied,
        conditions=lambda: _conditions(annotated),
    )


def _flags(annotated: AnnotatedDrive, run: Run) -> list[Notice]:
    """Remarks on a run."""
    drive = run.drive
    contraction = drive.contraction(run.states["stroke"])
    return [
        *start_notices(annotated.start),
        *curve_fit_notices(drive.curve_fit),
        *_part_notices(annotated),
        *limit_notices(_crossed(run)),
        *pressure_notices(_stated_pressures(annotated)),
        *suspended_notices(annotated.start, drive.load),
        *stretch_notices(annotated.start, float(np.nanmin(contraction, initial=0.0)), "stops"),
        *temperature_notices(annotated.start, drive.temperature, "gas.temperature"),
        *valve_notices(annotated),
        *(use_notices(fit, use_of_run(run)) if (fit := annotated.start.fit) is not None else ()),
    ]


def _notes(
    annotated: AnnotatedDrive, run: Run, table: TimingTable, follows: Tracking | None, *, held: bool
) -> dict[str, str]:
    """Field -> remark; ``held``: whether dry friction holds the load at the start."""
    notes = dict(annotated.notes) | {f"timing.{name}": why for name, why in table.notes.items()}
    if len(run.events) >= MOST_EVENTS:
        notes["events"] = f"of very many events in a short time only the first {MOST_EVENTS} are listed"
    if run.drive.start_reached and not held:
        notes["start.reached"] = "no dry friction holds the load at the start: it rests at one position"
    if follows is not None:
        notes |= {f"tracking.{name}": why for name, why in follows.notes.items()}
    return notes


def _stated_pressures(annotated: AnnotatedDrive) -> dict[str, float]:
    drive = annotated.drive
    stated = {"supply.pressure": drive.supply_pressure, "start_pressure": drive.start_pressure}
    return stated if drive.regulator is None else {**stated, "regulator.range": drive.regulator.range}


def _bounds(annotated: AnnotatedDrive) -> DriveBounds:
    low, high = stops_of(annotated.drive)
    return DriveBounds(**asdict(annotated.drive.model.limits), position_min=low, position_max=high)


def _stuck(run: Run) -> Array:
    """Rows in which dry friction holds the load."""
    out = run.outputs
    left = out["friction_left_up"] + out["friction_left_down"]
    held = (left > 0.0) | (out["friction_share"] > 0.0)
    return held & (np.abs(run.states["speed"]) <= STILL) & (out["contact"] == 0.0)


def _readings(run: Run, rows: Array) -> SensorReadings | None:
    model = Model(run.drive.model.effects)
    slots = (
        "pressure_sensor", "force_sensor", "length_sensor",
        "pressure_reading", "force_reading", "stroke_reading",
    )  # fmt: skip
    if not any(model.has(slot) for slot in slots):
        return None
    return SensorReadings(
        pressure=run.outputs["pressure_reading"][rows],
        force=run.outputs["force_reading"][rows],
        position=run.outputs["stroke_reading"][rows] / run.drive.load.lever_ratio,
    )


def _part_notices(annotated: AnnotatedDrive) -> list[Notice]:
    notices = [
        unverified_notice(f"{part}: {', '.join(names)}", "valve")
        for part, names in annotated.unverified.items()
    ]
    if (text := annotated.drive.tube_assumption) is not None:
        notices.append(Notice("assumed", text, "tube"))
    return notices


def _crossed(run: Run) -> Iterable[LimitFlag]:
    """The limits that the run exceeds."""
    if not len(run.time):
        return
    drive = run.drive
    contraction = drive.contraction(np.clip(run.states["stroke"], *drive.stops))
    limits = drive.model.limits
    # The smallest contraction is checked for the pretension limit, the largest for all others.
    for pick, stretch in ((np.nanmax, False), (np.nanmin, True)):
        crossed = limits.flags(
            pressure=_at_most(float(np.nanmax(run.pressure)), limits.max_pressure),
            force=_at_most(float(np.nanmax(run.outputs["force"])), limits.max_force),
            contraction=float(pick(contraction)),
        )
        for flag in crossed:
            if (flag.code is FlagCode.OVER_PRETENSION_LIMIT) is stretch:
                yield LimitFlag(flag.code, flag.message, _FIELDS.get(flag.code, "stops"))


def _at_most(value: float, limit: float | None) -> float:
    """The value, or the limit if the value exceeds it only by an integration error."""
    return value if limit is None or value > limit * _ABOVE else min(value, limit)


def trace_columns(result: SimulationResult) -> dict[str, np.ndarray]:
    """Head -> column, SI: the figures of a run that have a column, with those of a joint.

    Only what has sign and reference of a channel of measurements bears its name.
    """
    parts: list[tuple[Group, object]] = [(RUN, result), (JOINT, result.joint)]
    return {
        _head(figure): np.asarray(values, dtype=float)
        for group, part in parts
        for figure in group.values()
        if figure.column and (values := getattr(part, figure.name, None)) is not None
    }


def _head(figure: Figure) -> str:
    return figure.column if figure.unit == "1" else f"{figure.column}_{figure.unit}"


def trace_text(result: SimulationResult) -> str:
    """The columns as CSV, with the conditions of the run and which columns are no channels."""
    columns = trace_columns(result)
    channels = {_head(figure) for figure in (*RUN.values(), *JOINT.values()) if figure.column in CHANNELS}
    others = ", ".join(head for head in columns if head not in channels)
    text = io.StringIO()
    text.writelines(f"# {key}: {value}\n" for key, value in {**result.conditions, IGNORE: others}.items())
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([f"{value:.12g}" for value in row] for row in zip(*columns.values(), strict=True))
    return text.getvalue()


def _conditions(annotated: AnnotatedDrive) -> dict[str, str]:
    """What a measurement file of the run would state."""
    drive, preset = annotated.drive, annotated.start.preset
    stated = {"kind": "transient", "pressure": "gauge"}
    if drive.curve_fit:
        stated["drive"] = curve_fit_of(drive.curve_fit)
    if preset is not None:
        stated["muscle"] = f"{preset.id}:{drive.muscle.nominal_length * 1e3:g}mm"
    stated |= {"supply_pressure": f"{drive.supply_pressure!r} Pa", "load_mass": f"{drive.load.mass!r} kg"}
    if isinstance(drive.load.force, float) and drive.load.force:
        stated["load_force"] = f"{drive.load.force!r} N"
    if drive.controller is None:
        stated[COMMAND_BEFORE] = f"{drive.command.before!r} 1"
    return stated
