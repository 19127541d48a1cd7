"""Trials of an effect: hidden in simulated readings of an ordinary rig, is it found again?"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mckibben.facts.result import result_class
from mckibben.identification.diagnose.atlas import drive_of, rig_of
from mckibben.identification.diagnose.diagnosis import diagnose
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.measurement.reading import read_measurement
from mckibben.physics.effect import Effect, Kind
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.transient import simulate

#: Noise of the simulated readings, share of the largest one.
NOISE = 0.001
#: Sizes at which an effect is hidden: shares of the way from off to its usual size.
SIZES = (1.0, 0.6, 1.5)
_ROWS = 601


@result_class
class Trial:
    """One simulated experiment with the effect hidden in it, and what the diagnosis named."""

    kind: Kind
    """Kind of the test."""
    values: Mapping[str, float]
    """The hidden parameters, SI."""
    error_over_noise: float
    """Rms error of the start model, which lacks the effect, over the noise."""
    named: list[str]
    """The effects that the diagnosis added."""
    twins: list[str]
    """Effects that the data cannot tell from those."""
    outcome: str
    """"found", "as a twin" (it is one of the twins), "too small" (less than the noise) or "not found"."""


def trial(
    base: FitModel,
    effect: Effect,
    kind: Kind,
    *,
    number: int,
    pressure: float,
    catalogue: Mapping[str, Effect],
) -> Trial:
    """Hide the effect in a test of a kind, and diagnose the readings with the model that lacks it.

    Args:
        base: the muscle, with effects that stand for what the effect acts on.
        effect: the effect.
        kind: of the test; one that shows the effect.
        number: of the trial, from 0: decides the size of the effect and the noise.
        pressure: largest gauge pressure [Pa].
        catalogue: all effects, this one too.

    Raises:
        InputError: the drive of the test does not move.
    """
    values = hidden_values(effect, SIZES[number % len(SIZES)])
    both = base.adding(effect, values)
    start = replace(base, muscle=both.muscle, assumed=both.assumed, size=both.muscle.size)
    random = np.random.default_rng(20 + number)
    if kind == "transient":
        predictor = _transient(start, both, pressure, random)
    else:
        predictor = _read(rig_of(kind, start, pressure), both, random)
    result = diagnose(predictor, start, catalogue=catalogue)
    named = list(result.added)
    twins = sorted({twin.effect for twin in result.alternatives if twin.of in named} - set(named))
    over = float(result.start.rmse / result.noise) if result.noise else float("inf")
    if effect.id in named:
        outcome = "found"
    elif effect.id in twins:
        outcome = "as a twin"
    else:
        outcome = "too small" if over < 1.5 else "not found"
    return Trial(kind, values, over, named, twins, outcome)


def hidden_values(effect: Effect, share: float) -> dict[str, float]:
    """The parameters of the effect at a share of its usual size, within their bounds."""
    found = dict(effect.defaults)
    for parameter in effect.parameters:
        if parameter.off is not None:
            value = parameter.off + share * (parameter.default - parameter.off)
            found[parameter.name] = min(max(value, parameter.lower), parameter.upper)
    return found


def _read(rig: Predictor, both: FitModel, random: np.random.Generator) -> Predictor:
    clean = rig.after(("rest",)).predict(both)
    return rig.reading(clean + random.normal(0.0, NOISE * float(np.max(np.abs(clean))), clean.shape))


def _transient(start: FitModel, both: FitModel, pressure: float, random: np.random.Generator) -> Predictor:
    """Command, pressure and stroke of a drive, as a recorder writes them down."""
    drive = drive_of(both, pressure)
    run = simulate(drive, points=_ROWS)
    if len(run.time) < _ROWS:
        raise InputError("the drive of the test does not move with this effect", field="effect")
    columns = {"time_s": run.time, "command": np.asarray(drive.command.value(run.time))}
    for name, output in (("pressure_Pa", "pressure_reading"), ("displacement_m", "stroke_reading")):
        values = run.outputs[output]
        columns[name] = values + random.normal(0.0, NOISE * float(np.max(np.abs(values))), values.shape)
    rows = [",".join(f"{value:.9g}" for value in row) for row in zip(*columns.values(), strict=True)]
    head = [
        "# kind: transient", f"# load_mass: {drive.load.mass} kg", f"# supply_pressure: {pressure / 1e5} bar",
        f"# rest_length: {float(start.muscle.nominal_length) * 1e3} mm", ",".join(columns),
    ]  # fmt: skip
    text = "\n".join([*head, *rows]) + "\n"
    return predictor_of(read_measurement(text.encode(), "trial.csv"), start.muscle, drive_of(start, pressure))
