"""The linear view of a drive: models at an operating point, responses, loop, sweep, controller design."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import get_args

import numpy as np

from mckibben.application.linear.result import (
    LinearResult,
    design_result,
    gain_unit,
    input_values,
    loop_result,
    model_result,
    named,
    near,
    point_of,
)
from mckibben.application.muscle_summary import curve_fit_notices
from mckibben.application.run.drive_run import run_drive
from mckibben.application.run.simulate import POINTS, result_of
from mckibben.documents.drive_reading import AnnotatedDrive
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.units import si
from mckibben.simulation.drive.joint_path import refuse_path
from mckibben.simulation.linear.bound import SLIDING_SPEED
from mckibben.simulation.linear.design import design
from mckibben.simulation.linear.equations import COMMAND, LOAD_FORCE, POSITION
from mckibben.simulation.linear.linearise import Linearisation, linearise
from mckibben.simulation.linear.point import Condition, Kind
from mckibben.simulation.linear.response import eigenvalues, frequencies_for
from mckibben.simulation.linear.sweep import SWEPT, DescribingPoint, describing_points
from mckibben.simulation.linear.trials import Goals
from mckibben.simulation.outcome import Watch
from mckibben.simulation.timing.evaluation import grid_of

SHARES = (0.01, 0.05, 0.2)  # amplitudes of a sweep: of the full command, of the tension of the muscle
MOST_AMPLITUDES = 6
_BEYOND = "the loop holds for small motions about its operating point; the run moves beyond them"
_ELSEWHERE = "the loop is that of its operating point; the run is elsewhere, or friction or a stop holds it"
_MOST_SAMPLES = 100_000  # of a run beside the loop
_SWEPT_FREQUENCIES = 10
_SWEEPABLE = ("position", "velocity", "pressure", "force", "mass_flow", "position_reading")

_UNITS: dict[str, str] = {"position": "m", "contraction": "1", "pressure": "Pa", "command": "1"}
_GOALS: dict[str, str] = {"overshoot": "1", "settling": "s", "step": "m"}
_UNSATURATED = "no saturation"
_AT_HINT = 'e.g. "position 40 mm", "contraction 10 %", "pressure 3 bar", "command 50 %"'
_DESIGN_HINT = 'e.g. "overshoot 5 %, settling 0.5 s, step 10 mm, no saturation"'


@dataclass(frozen=True, slots=True)
class LinearQuestion:
    """A drive, and what to show of its linear view.

    Attributes:
        annotated: the drive with notes on its parts.
        at: the operating point; None is the middle of the positions that can be held.
        input, output: the channel of responses, poles and zeros.
        amplitudes: of the sines for the nonlinear drive, in the unit of the input; None = `SHARES` of full
            command or tension, () = no sweep.
        goals: of a controller design; None = no design.
        sliding_speed: of the load, see `mckibben.simulation.linear.linearise.linearise` [m/s].
    """

    annotated: AnnotatedDrive
    at: Condition | None = None
    input: str = COMMAND.name
    output: str = POSITION.name
    amplitudes: tuple[float, ...] | None = None
    goals: Goals | None = None
    sliding_speed: float = SLIDING_SPEED


def linear_view(question: LinearQuestion, watch: Watch | None = None) -> LinearResult:
    """Answer a question.

    Raises:
        InputError: no such equilibrium (field "at"), channel ("input", "output"), amplitude ("amplitudes") or
            step ("design").
    """
    return prepare(question)(watch or Watch())


def prepare(question: LinearQuestion) -> Callable[[Watch], LinearResult]:
    """The linear models of a question, ready for sweep and design.

    Raises:
        InputError: as `linear_view`.
    """
    refuse_path(question.annotated.drive.path, "the linear view")
    linear = linearise(question.annotated.drive, question.at, sliding_speed=question.sliding_speed)
    _check(question, linear)
    return lambda watch: _answer(question, linear, watch)


def _check(question: LinearQuestion, linear: Linearisation) -> None:
    model = linear.primary
    for field, name, ports in (
        ("input", question.input, model.inputs),
        ("output", question.output, model.outputs),
    ):
        known = [port.name for port in ports]
        if name not in known:
            raise InputError(
                f"there is no {field} '{name[:40]}'", field=field, hint=did_you_mean(name, known)
            )
    amplitudes = question.amplitudes or ()
    if len(amplitudes) > MOST_AMPLITUDES:
        raise InputError(f"{len(amplitudes)} amplitudes are more than {MOST_AMPLITUDES}", field="amplitudes")
    if any(not (math.isfinite(each) and each > 0.0) for each in amplitudes):
        raise InputError("an amplitude is not positive", field="amplitudes", hint="e.g. 5 %")


def _answer(question: LinearQuestion, linear: Linearisation, watch: Watch) -> LinearResult:
    source, out, drive = question.input, question.output, question.annotated.drive
    notes = [str(notice) for notice in curve_fit_notices(drive.curve_fit)]
    with np.errstate(all="ignore"):
        frequency = frequencies_for(linear.primary, sweep_frequencies(linear))
        models = [model_result(linear, model, source, out, frequency) for model in linear.models]
        primary = next(model for model in models if model.primary)
        points = _swept(question, linear, watch, notes)
        loop = loop_found = None
        if drive.controller is not None and linear.point.on_stop is None:
            loop = loop_result(
                linear, drive.controller, lambda stable: _run_beside(question.annotated, watch, stable=stable)
            )
        if question.goals is not None:
            loop_found = design(linear, question.goals, watch)
    ports = {port.name: port for port in (*linear.primary.inputs, *linear.primary.outputs)}
    shown = {value.name: value.value for value in primary.outputs}
    return LinearResult(
        point=point_of(linear),
        smooth=linear.smooth,
        lost=list(linear.lost),
        dead_band=None if linear.dead_band is None else list(linear.dead_band),
        input=named(ports[source], input_values(linear)[source]),
        output=named(ports[out], shown[out]),
        gain_unit=gain_unit(ports[source], ports[out]),
        frequency=frequency,
        models=models,
        describing=near(points, primary, frequency),
        loop=loop,
        design=None if loop_found is None else design_result(loop_found),
        notes=notes,
    )


def _run_beside(annotated: AnnotatedDrive, watch: Watch, *, stable: bool) -> str | None:
    """What a run with the gains of the loop does, and why it differs from what the loop promises."""
    drive = annotated.drive
    if drive.controller is None or drive.reference is None:
        return None
    if drive.duration > _MOST_SAMPLES * drive.controller.sample_time:
        return None
    grid = grid_of(duration=drive.duration, begin=0.0, end=drive.duration, points=POINTS)
    verdict = result_of(annotated, grid, run_drive(annotated, grid, watch)).verdict
    swings = verdict.state in ("swings", "unstable")
    if verdict.state is None or swings != stable:
        return verdict.sentence
    why = _BEYOND if stable else _ELSEWHERE
    return f"{verdict.sentence} This differs from the loop: {why}."


def _swept(
    question: LinearQuestion, linear: Linearisation, watch: Watch, notes: list[str]
) -> list[DescribingPoint]:
    """The sweep of the nonlinear drive, if the channel has one."""
    amplitudes = question.amplitudes
    if amplitudes == ():
        return []
    if linear.point.on_stop is not None:
        notes.append("no sweep: the load rests on its end stop")
        return []
    if question.input not in SWEPT or question.output not in _SWEEPABLE:
        notes.append(f"no sweep: it needs the input {' or '.join(SWEPT)} and an output of the first muscle")
        return []
    if question.input == LOAD_FORCE.name and question.annotated.drive.pair:
        notes.append("no sweep of the load force of an antagonist pair")
        return []
    if amplitudes is None:
        unit = 1.0 if question.input == COMMAND.name else max(linear.point.force, 1.0)
        amplitudes = tuple(share * unit for share in SHARES)
    points = describing_points(
        linear,
        source=question.input,
        out=question.output,
        frequencies=sweep_frequencies(linear),
        amplitudes=amplitudes,
        watch=watch,
    )
    if len(points) < len(amplitudes) * _SWEPT_FREQUENCIES:
        notes.append("the sweep was ended early: frequencies at the end are missing")
    return points


def sweep_frequencies(linear: Linearisation) -> list[float]:
    """Frequencies [Hz] around the slowest oscillation of the load, or from 0.1 to 3 Hz without one."""
    swinging = [abs(value) for value in eigenvalues(linear.primary) if value.imag > 0.1 * abs(value)]
    middle = min(swinging) / (2.0 * math.pi) if swinging else 1.0
    middle = min(max(middle, 0.2), 50.0)
    return [float(each) for each in np.geomspace(0.1 * middle, 3.0 * middle, _SWEPT_FREQUENCIES)]


def condition_of(text: str) -> Condition:
    """The operating point that a text states.

    Raises:
        InputError: another word, no number, or a unit that does not fit; field "at".
    """
    word, _, value = text.strip().partition(" ")
    kind = word.lower()
    if kind not in get_args(Kind):
        raise InputError(f"'{text[:60]}' states no operating point", field="at", hint=_AT_HINT)
    return stated_condition(kind, value.strip())


def stated_condition(kind: str, value: float | str) -> Condition:
    """The operating point with a value in SI, or a text with a unit.

    Raises:
        InputError: no number, or a unit that does not fit; field "at".
    """
    if not str(value):
        raise InputError(f"the {kind} has no value", field="at", hint=_AT_HINT)
    try:
        number = si(value, _UNITS[kind], reference="gauge" if kind == "pressure" else None)
    except InputError as error:
        raise InputError(f"{kind}: {error.message}", field="at", hint=error.hint) from error
    return Condition(kind, number)  # type: ignore


def goals_of(text: str) -> Goals:
    """The goals that a text states, with the defaults of `Goals` for the others.

    Raises:
        InputError: another word, a value that is impossible, or a unit that does not fit; field "design".
    """
    goals = Goals()
    for part in filter(None, (each.strip() for each in text.split(","))):
        if part.lower() == _UNSATURATED:
            goals = replace(goals, unsaturated=True)
            continue
        word, _, value = part.partition(" ")
        if word.lower() not in _GOALS:
            known = did_you_mean(word, [*_GOALS, _UNSATURATED])
            raise InputError(f"there is no goal '{part[:40]}'", field="design", hint=known or _DESIGN_HINT)
        goals = replace(goals, **{word.lower(): _goal(word.lower(), value.strip())})
    return checked(goals)


def _goal(name: str, value: str) -> float:
    if not value:
        raise InputError(f"the goal {name} has no value", field="design", hint=_DESIGN_HINT)
    try:
        return si(value, _GOALS[name])
    except InputError as error:
        raise InputError(f"{name}: {error.message}", field="design", hint=error.hint) from error


def checked(goals: Goals) -> Goals:
    """The goals, if they are possible.

    Raises:
        InputError: a value out of its range; field "design".
    """
    wrong = None
    if not 0.0 <= goals.overshoot <= 1.0:
        wrong = f"an overshoot of {goals.overshoot * 100:g} % is not between 0 and 100 %"
    elif not 0.01 <= goals.settling <= 20.0:
        wrong = f"a settling time of {goals.settling:g} s is not between 10 ms and 20 s"
    elif goals.step is not None and not 1e-5 <= abs(goals.step) <= 10.0:
        wrong = f"a step of {goals.step:g} m is not between 0.01 mm and 10 m"
    if wrong is not None:
        raise InputError(wrong, field="design", hint=_DESIGN_HINT)
    return goals
