r"""What an effect leaves in the residual of each kind of test, if the model lacks it.

.. math:: r = y(\text{model with the effect}) - y(\text{model without it})

for the same prescribed motion, with the effect at its usual size. The tests are those of an ordinary rig,
sized by the muscle: loops of contraction at three pressures, pressure ramps at three lengths and under three
loads, a map at rest approached from both sides, the diameter over the contraction, the torque of a pulley
that is turned to and fro, and cycles of a valve.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from mckibben.facts.result import FiniteSeries, Number, result_class
from mckibben.identification.diagnose.protocol import RigRun, experiment_of
from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.joint import JointPredictor, JointRows
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.physics import ideal
from mckibben.physics.effect import Effect, Kind
from mckibben.physics.errors import InputError
from mckibben.physics.muscle_path import constant_lever
from mckibben.physics.units import GRAVITY
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.parts import Drive, Load, Tube, Valve
from mckibben.simulation.drive.transient import simulate
from mckibben.simulation.statics.model import StaticModel

#: Temperature of all tests [K]: warm, so that effects of the temperature show.
TEMPERATURE = 313.15
_SHARES = (1 / 3, 2 / 3, 1.0)  # of the largest pressure
_REACH = 0.8  # share of the contraction at which the ideal force vanishes
_STRETCH = -0.02  # contraction at which loops and maps begin: slightly stretched
_RATE = 0.05  # 1/s, of the contraction in loops
_RAMP, _SLOW_RAMP = 5.0, 60.0  # s, of the pressure up or down
_LOADS = (0.05, 0.2, 0.4)  # of the blocked force
_STATIC_POINTS = 25
_TURN = 0.5  # rad; half of the angle that a pulley is turned by
# A drive that any muscle can move: the load hangs, a proportional valve swings it.
_MASS_SHARE, _CYCLES, _FREQUENCY, _POINTS = 0.05, 1.5, 0.8, 181
_CONDUCTANCE = 1.5e-8  # m3/(s Pa), for a muscle of 300 mm and 20 mm
_READINGS = {
    "force_reading": ("force", "N"),
    "stroke_reading": ("stroke", "m"),
    "pressure_reading": ("pressure", "Pa"),
}


@result_class
class SignatureCurve:
    """The residual of one run, in the order of its motion."""

    level: Number
    """What the rig held, in Pa, m or N: pressure, length or load; NaN for a drive in motion."""
    x: FiniteSeries
    """What moved."""
    y: FiniteSeries
    """The residual: with the effect minus without it."""


@result_class
class SignaturePicture:
    """What an effect leaves in one kind of test."""

    kind: Kind
    """Kind of the test."""
    quantity: str
    """What is predicted: force, length, diameter, stroke or pressure."""
    unit: str
    """Its SI unit."""
    x: str
    """What moves: contraction, pressure or time."""
    x_unit: str
    """Its SI unit."""
    held: str
    """What the rig holds in each run; empty in a drive."""
    held_unit: str
    """Its SI unit."""
    curves: tuple[SignatureCurve, ...]
    """One for each run."""
    rms: float
    """Root mean square of the residual."""


def pictures(
    base: FitModel,
    effect: Effect,
    values: Mapping[str, float] | None = None,
    *,
    pressure: float,
    kinds: frozenset[Kind] | None = None,
) -> list[SignaturePicture]:
    """The pictures of an effect on a muscle.

    Args:
        base: the muscle, with effects that stand for what the effect acts on.
        effect: the effect.
        values: its parameters; missing ones take their usual size.
        pressure: largest gauge pressure of the tests [Pa].
        kinds: of test; None for those in which the effect shows.

    Raises:
        InputError: a value outside its bounds, or no positive pressure.
    """
    if not pressure > 0.0:
        raise InputError("the tests need a positive pressure", field="pressure")
    both = base.adding(effect, values)
    bare = replace(base, muscle=both.muscle, assumed=both.assumed)
    wanted = effect.kinds if kinds is None else kinds
    found: list[SignaturePicture] = []
    for kind in _AXES:
        if kind in wanted and (picture := _quasistatic(kind, rig_of(kind, bare, pressure), bare, both)):
            found.append(picture)
    if "transient" in wanted:
        found.append(_driven(bare, both, pressure))
    return found


def rig_of(kind: Kind, model: FitModel, pressure: float) -> Predictor:
    """An ordinary rig for a kind of test at given motions; nothing is measured yet.

    Args:
        kind: of the test; not transient.
        model: the muscle.
        pressure: largest gauge pressure [Pa].
    """
    if kind == "joint":
        return _turned(model, pressure)
    return QuasistaticPredictor(_TASKS[kind](model, pressure))


def _quasistatic(kind: Kind, predictor: Predictor, bare: FitModel, both: FitModel) -> SignaturePicture | None:
    """The picture; None where the prediction of this kind of test does not contain the effect."""
    predictor, effect = predictor.after(("rest",)), both.effects[-1]
    if kind in effect.kinds and predictor.why_hidden(effect):
        return None
    if kind == "diameter" and "compliance" in effect.slots:
        both = bare  # the length is read on the muscle, beside the diameter
    residual = predictor.predict(both, clipped=False) - predictor.predict(bare, clipped=False)
    residual = np.where(np.isfinite(residual), residual, 0.0)
    moved, held = _AXES[kind]
    inputs = predictor.inputs
    across = (
        1.0 - inputs["length"] / float(bare.muscle.nominal_length)
        if moved == "contraction"
        else inputs[moved]
    )
    holds, groups = inputs[held], predictor.groups
    curves = tuple(
        SignatureCurve(float(holds[rows][0]), across[rows], residual[rows])
        for label in np.unique(groups)
        if len(rows := np.flatnonzero(groups == label))
    )
    units = {"pressure": "Pa", "contraction": "1", "length": "m", "load": "N", "angle": "rad"}
    (channel,) = predictor.channels
    return SignaturePicture(
        kind, channel.name, channel.unit, moved, units[moved], held, units[held], curves, _rms(residual)
    )


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


#: Kind -> what moves and what is held.
_AXES: Mapping[Kind, tuple[str, str]] = {
    "isobaric": ("contraction", "pressure"),
    "isometric": ("pressure", "length"),
    "isotonic": ("pressure", "load"),
    "static": ("contraction", "pressure"),
    "diameter": ("contraction", "pressure"),
    "joint": ("angle", "pressure"),
}


def _reach(model: FitModel) -> float:
    """Contraction to which the tests go, a share of that at which the ideal force vanishes."""
    return _REACH * float(ideal.max_contraction(braid_angle=model.muscle.braid_angle))


def _warm(task: ComparableRows) -> ComparableRows:
    return replace(task, state={**task.state, "temperature": np.full(len(task.rows), TEMPERATURE)})


def _loops(model: FitModel, pressure: float) -> ComparableRows:
    reach = _reach(model)
    corners = np.array([_STRETCH, reach, _STRETCH])
    time = np.array([0.0, 1.0, 2.0]) * (reach - _STRETCH) / _RATE
    runs = [RigRun(time, np.full(3, share * pressure), corners) for share in _SHARES]
    return _task(runs, model)


def _ramps(model: FitModel, pressure: float) -> ComparableRows:
    time = np.array([0.0, _RAMP, 2.0 * _RAMP])
    pressures = pressure * np.array([0.0, 1.0, 0.0])
    runs = [
        RigRun(time, pressures, np.full(3, share * _reach(model)))
        for share in (_STRETCH / _reach(model), 0.4, 0.8)
    ]
    return replace(_task(runs, model), kind="isometric")


def _loaded(model: FitModel, pressure: float) -> ComparableRows:
    blocked = _blocked_force(model, pressure)
    time = np.array([0.0, _SLOW_RAMP, 2.0 * _SLOW_RAMP])
    pressures = pressure * np.array([0.3, 1.0, 0.3])
    warm = [RigRun(time, pressures, None, share * blocked) for share in _LOADS]
    return replace(_task(warm, model), load_read=True)  # by a force sensor, whose errors are drawn as well


def _task(runs: list[RigRun], model: FitModel) -> ComparableRows:
    task: ComparableRows = experiment_of("", runs, model).predictor.task  # type: ignore
    # A picture shows the set points as well, where an experiment compares nothing.
    return _warm(replace(task, turning=np.zeros(len(task.turning), bool)))


def _blocked_force(model: FitModel, pressure: float) -> float:
    muscle = model.muscle
    static = StaticModel(muscle, {})
    return float(static.force(length=np.array([muscle.nominal_length]), pressure=np.array([pressure]))[0])


def _mapped(model: FitModel, pressure: float) -> ComparableRows:
    """Points at rest, each approached once from either side; without an order in time."""
    return _grid(model, pressure, "static", "force", "N", (-1.0, 1.0))


def _shapes(model: FitModel, pressure: float) -> ComparableRows:
    return _grid(model, pressure, "diameter", "diameter", "m", (0.0,))


def _grid(
    model: FitModel, pressure: float, kind: Kind, channel: str, unit: str, ways: tuple[float, ...]
) -> ComparableRows:
    rest, reach = float(model.muscle.nominal_length), _reach(model)
    there = np.linspace(_STRETCH, reach, _STATIC_POINTS)
    path = np.concatenate([there if way <= 0.0 else there[::-1] for way in ways])
    directions = np.repeat(ways, _STATIC_POINTS)
    count, groups = len(path), np.repeat(np.arange(len(_SHARES)), len(path))
    total = count * len(_SHARES)
    return ComparableRows(
        kind=kind,
        channel=channel,
        unit=unit,
        measured=np.zeros(total),
        state={
            "pressure": np.repeat(np.array(_SHARES) * pressure, count),
            "length": rest * (1.0 - np.tile(path, len(_SHARES))),
            "velocity": np.zeros(total),
            "direction": np.tile(directions, len(_SHARES)),
            "temperature": np.full(total, TEMPERATURE),
        },
        time=None,
        records=np.arange(total),  # a map has no history
        groups=groups,
        turning=np.zeros(total, bool),
        rows=np.arange(total),
        excluded={},
        unknown_load=False,
        messages=(),
        rest_length=rest,
    )


def _turned(model: FitModel, pressure: float) -> JointPredictor:
    """A muscle on a pulley that is turned to and fro, to 0.5 rad either way of its middle."""
    task = _loops(model, pressure)
    rest = float(model.muscle.nominal_length)
    length = task.state["length"]
    middle = 0.5 * (np.max(length) + np.min(length))
    lever = float(np.ptp(length)) / (2.0 * _TURN)
    angle = (middle - length) / lever
    rows = JointRows(
        angle=angle,
        torque=np.zeros(len(angle)),
        lever=np.full(len(angle), lever),
        direction=-task.state["direction"],
        paths=(constant_lever(lever=lever, length=float(middle)),),
        angled=True,
    )
    return JointPredictor(replace(task, state={**task.state, "angle": angle}, rest_length=rest), rows)


_TASKS: Mapping[Kind, Callable[[FitModel, float], ComparableRows]] = {
    "isobaric": _loops,
    "isometric": _ramps,
    "isotonic": _loaded,
    "static": _mapped,
    "diameter": _shapes,
}


def drive_of(model: FitModel, pressure: float) -> Drive:
    """A drive that any muscle can move: a proportional valve swings a hanging load.

    Args:
        model: the muscle and all effects of the drive.
        pressure: of the supply, gauge [Pa].
    """
    muscle = model.muscle
    volume = float(muscle.nominal_length) * float(muscle.braid_diameter) ** 2 / (0.3 * 0.02**2)
    return Drive(
        model=StaticModel(muscle, model.values, catalogue={effect.id: effect for effect in model.effects}),
        valve=Valve(_CONDUCTANCE * volume, _CONDUCTANCE * volume),
        load=Load(mass=_MASS_SHARE * _blocked_force(model, pressure) / GRAVITY),
        command=signal_from(
            {"shape": "sine", "frequency": _FREQUENCY, "amplitude": 0.7}, unit="1", field="command"
        ),
        duration=_CYCLES / _FREQUENCY,
        supply_pressure=pressure,
        tube=Tube(0.004, 1.0),
        min_contraction=-0.05,
        max_contraction=1.2 * _reach(model),
        temperature=TEMPERATURE,
        wall_heat_transfer=0.0,  # what the wall does to the air is an effect
    )


def _driven(bare: FitModel, both: FitModel, pressure: float) -> SignaturePicture:
    """The reading of a recorder that changes most, against the largest value it shows."""
    time, without = _record(bare, pressure)
    _, with_it = _record(both, pressure)
    changes = {name: with_it[name] - without[name] for name in _READINGS}
    name = max(changes, key=lambda one: _rms(changes[one]) / (np.max(np.abs(without[one])) or 1.0))
    quantity, unit = _READINGS[name]
    curve = SignatureCurve(float("nan"), time, changes[name])
    return SignaturePicture("transient", quantity, unit, "time", "s", "", "", (curve,), _rms(changes[name]))


def _record(model: FitModel, pressure: float) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    run = simulate(drive_of(model, pressure), points=_POINTS)
    if len(run.time) < _POINTS:
        raise InputError("the drive of the test does not move with this effect", field="effect")
    return run.time, {name: run.outputs[name] for name in _READINGS}


def stand_ins(
    effect: Effect, catalogue: Mapping[str, Effect], chosen: Mapping[str, Mapping[str, float]]
) -> Iterator[str]:
    """Effects that must be there for this one to act on: an elastomer, if it only multiplies one.

    Those of the muscle in hand come first.
    """
    if set(effect.slots) - {"rates"} == {"elastomer_factor"}:
        named = [*chosen, *catalogue]
        yield next(name for name in named if name in catalogue and "elastomer" in catalogue[name].slots)
