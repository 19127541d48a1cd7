"""Steps of the nonlinear drive under a controller: goals, figures, and what they cost."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Literal

import numpy as np

from mckibben.facts.linear import SETTLING_BAND, STEP_DESIGN
from mckibben.facts.result import Number, result_class
from mckibben.simulation.command.pid import PidController
from mckibben.simulation.command.shapes import Pulse
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.linear.equations import COMMAND, READING
from mckibben.simulation.linear.linearise import Linearisation
from mckibben.simulation.linear.loop import (
    Margins,
    controller_response,
    hold_response,
    loop_frequencies,
    margins,
)
from mckibben.simulation.linear.nonlinear import controlled_from
from mckibben.simulation.linear.response import frequencies_for, frequency_response
from mckibben.simulation.outcome import Outcome, Watch

Array = np.ndarray

#: Where a controller comes from: the document, the tuning rule, or the refinement of it.
TrialName = Literal["own", "rule", "refined"]

LEAST_MODULUS = 0.5  # distance of the loop from -1: sensitivity at most 2 (Åström & Hägglund 1995)
_TOLERANCE = 1e-5
_SPREAD = 0.2  # of mass and supply
_FAILED = 1e3
_CHECKS, _UNCHECKED = 20, 10.0  # of controllers of a joint; cost of one that was not checked
_HOPELESS = 20.0  # cost of a controller whose neighbours need not be run


@dataclass(frozen=True, slots=True)
class Goals:
    """What a step of the position shall do.

    Attributes:
        overshoot: largest, as a share of the step [-].
        settling: latest time from which on the position stays within 2 % of the step [s].
        step: height [m]; None = a tenth of the range between the stops.
        unsaturated: whether the command must never reach its limits.
    """

    overshoot: float = 0.05
    settling: float = 1.0
    step: float | None = None
    unsaturated: bool = False


@result_class
class StepFigures:
    """Figures of a step and back again: the worse of the two."""

    FIGURES: ClassVar = STEP_DESIGN.name

    overshoot: Number
    settling: float | None
    rise: float | None
    saturated: float
    error: Number
    late_error: Number
    meets: bool
    """Whether the goals are met."""


@dataclass(frozen=True)
class Trial:
    """A controller, its steps on the nonlinear drive, and its margins on the linear plant.

    Attributes:
        name: "own", "rule" or "refined".
        controller: the controller.
        figures: of its steps.
        margins: of its loop.
        time, reference, position, command: of the run.
    """

    name: TrialName
    controller: PidController
    figures: StepFigures
    margins: Margins
    time: Array
    reference: Array
    position: Array
    command: Array


@dataclass(frozen=True, slots=True)
class Variation:
    """The refined controller on a drive with another mass and supply, as factors, and its figures."""

    mass: float
    supply: float
    figures: StepFigures


class Bench:
    """Steps of the nonlinear drive under a controller, away from the operating point and back."""

    def __init__(self, linear: Linearisation, goals: Goals, watch: Watch) -> None:
        self.linear, self.goals, self.watch = linear, goals, watch
        self.runs, self.ended = 0, False
        self.checks = _CHECKS  # runs with the loop of a joint's stiffness that are left
        drive = linear.point.bound.drive
        lowest = 0.0 if drive.regulator is not None else -1.0
        given = None if drive.controller is None else self.commanding(drive.controller)
        self.template = (
            PidController(kp=1.0, output_min=lowest)
            if given is None
            else replace(given, kp=1.0, ki=0.0, kd=0.0, feed_forward=0.0)
        )
        self.hold = 2.0 * goals.settling
        # Another mass or supply begins out of balance: it has this long to come back to the point.
        self.lead = goals.settling

    def commanding(self, controller: PidController) -> PidController:
        """A drive's controller as one of its first muscle's command: that of a joint gives a difference."""
        return self._shifted(controller, 1.0)

    def of_drive(self, trial: Trial) -> Trial:
        """A trial with its controller as the drive has it; inverse of `commanding`."""
        return replace(trial, controller=self._shifted(trial.controller, -1.0))

    def _shifted(self, controller: PidController, sign: float) -> PidController:
        drive = self.linear.point.bound.drive
        if drive.stiffness is None:
            return controller
        low, high = (
            end + sign * drive.common_command for end in (controller.output_min, controller.output_max)
        )
        return replace(controller, output_min=low, output_max=high)

    def run(
        self, controller: PidController, drive: Drive, *, joint: bool = False
    ) -> tuple[Array, Array, Array, Array, bool]:
        """Time, reference, position, command, and whether the run completed; ``joint``: with stiffness."""
        start, step = self.linear.point.position, self.goals.step or 0.0
        count = max(round(2.0 * self.hold / controller.sample_time), 200)
        stride = max(1, count // 1500)
        end = self.lead + 2.0 * self.hold
        grid = np.linspace(0.0, end, max(count // stride, 200) + 1)
        reference = Pulse(on=self.lead, off=self.lead + self.hold, level=start + step, initial=start)
        run = controlled_from(
            self.linear.point, drive, controller, reference, grid=grid, tolerance=_TOLERANCE, joint=joint
        )
        time = run.time
        position = run.states["stroke"] / drive.load.lever_ratio
        return (
            time,
            reference.value(time),
            position,
            run.command.value(time),
            run.outcome is Outcome.COMPLETED,
        )

    def figures(self, controller: PidController, drive: Drive, *, joint: bool = False) -> StepFigures:
        """Figures of both steps."""
        time, _, position, command, completed = self.run(controller, drive, joint=joint)
        return self._figures_of(controller, time, position, command, completed)

    def _figures_of(
        self, controller: PidController, time: Array, position: Array, command: Array, completed: bool
    ) -> StepFigures:
        self.runs += 1
        if not completed or not np.isfinite(position).all():
            return StepFigures(math.inf, None, None, 1.0, math.inf, math.inf, False)
        start, step = self.linear.point.position, self.goals.step or 0.0
        halves = []
        for begin, origin, target in (
            (self.lead, start, start + step),
            (self.lead + self.hold, start + step, start),
        ):
            rows = (time >= begin) & (time <= begin + self.hold + 1e-12)
            halves.append(_figures_of_step(time[rows] - begin, (position[rows] - origin) / (target - origin)))
        late = time >= self.lead
        limits = (command[late] >= controller.output_max) | (command[late] <= controller.output_min)
        saturated = float(np.mean(limits))
        overshoot = max(half[0] for half in halves)
        settling = _largest([half[1] for half in halves])
        goals = self.goals
        meets = (
            overshoot <= goals.overshoot + 1e-12
            and settling is not None
            and settling <= goals.settling
            and not (goals.unsaturated and saturated > 0.0)
        )
        rise = _largest([half[2] for half in halves])
        error, late = (max(half[index] for half in halves) for index in (3, 4))
        return StepFigures(overshoot, settling, rise, saturated, error, late, meets)

    def trial(self, name: TrialName, controller: PidController) -> Trial:
        """A controller with everything to show of it."""
        drive = self.linear.point.bound.drive
        joint = drive.stiffness is not None
        time, reference, position, command, completed = self.run(controller, drive, joint=joint)
        figures = self._figures_of(controller, time, position, command, completed)
        axis = frequencies_for(self.linear.primary)
        found = margins(self.linear.primary, controller, axis)
        return Trial(name, controller, figures, found, time, reference, position, command)

    @cached_property
    def _plant(self) -> tuple[Array, Array]:
        """Frequencies of the loop and the held plant at them."""
        model, period = self.linear.primary, self.template.sample_time
        frequency = loop_frequencies(self.template, frequencies_for(model))[::4]
        plant = frequency_response(model, COMMAND.name, READING.name, frequency)
        return frequency, plant * hold_response(period, frequency)

    def modulus_margin(self, controller: PidController) -> float:
        """Least distance of the linear loop from -1."""
        frequency, plant = self._plant
        return float(np.nanmin(np.abs(1.0 + controller_response(controller, frequency)[0] * plant)))

    def cost(self, controller: PidController) -> tuple[float, bool]:
        """How far the steps are from the goals, on the drive and on its slow and fast neighbours; all met?"""
        nominal = self.figures(controller, self.linear.point.bound.drive)
        missing = max(LEAST_MODULUS - self.modulus_margin(controller), 0.0)
        first = self._cost(nominal) + 60.0 * missing
        if first > _HOPELESS:
            return 1.5 * first, False
        others = [self.figures(controller, drive) for drive in self._neighbours()]
        met = missing == 0.0 and nominal.meets and all(other.meets for other in others)
        cost = first + 0.5 * max(self._cost(other) for other in others)
        if self.linear.point.bound.drive.stiffness is None:
            return cost, met
        return self._cost_of_joint(controller, cost) if met and self.checks else (cost + _UNCHECKED, False)

    def _cost_of_joint(self, controller: PidController, cost: float) -> tuple[float, bool]:
        """The same with the loop of the stiffness, which takes longer to run: only where it is worth it."""
        self.checks -= 1
        nominal = self.figures(controller, self.linear.point.bound.drive, joint=True)
        if not nominal.meets:
            return cost + self._cost(nominal), False
        others = [self.figures(controller, drive, joint=True) for drive in self._neighbours()]
        worst = max(self._cost(other) for other in others)
        return self._cost(nominal) + 0.5 * worst, all(other.meets for other in others)

    def _neighbours(self) -> list[Drive]:
        return [self.changed(1.0 + _SPREAD, 1.0 - _SPREAD), self.changed(1.0 - _SPREAD, 1.0 + _SPREAD)]

    def _cost(self, figures: StepFigures) -> float:
        goals = self.goals
        if not math.isfinite(figures.error):
            return _FAILED
        settling = figures.settling if figures.settling is not None else 2.0 * self.hold
        cost = settling / goals.settling + figures.error + figures.late_error / SETTLING_BAND
        cost += 10.0 * max(settling / goals.settling - 1.0, 0.0)
        cost += 20.0 * max(figures.overshoot - goals.overshoot, 0.0) / max(goals.overshoot, 0.02)
        return cost + (50.0 * figures.saturated if goals.unsaturated else 0.0)

    def changed(self, mass: float, supply: float) -> Drive:
        """The drive with another mass and supply, as factors; a regulator keeps its range."""
        drive = self.linear.point.bound.drive
        load = replace(drive.load, mass=drive.load.mass * mass)
        return replace(drive, load=load, supply_pressure=drive.supply_pressure * supply)

    def variations(self, controller: PidController) -> list[Variation]:
        """The corners of mass and supply."""
        factors = (1.0 - _SPREAD, 1.0, 1.0 + _SPREAD)
        joint = self.linear.point.bound.drive.stiffness is not None
        return [
            Variation(mass, supply, self.figures(controller, self.changed(mass, supply), joint=joint))
            for mass in factors
            for supply in factors
        ]


def _figures_of_step(time: Array, rise: Array) -> tuple[float, float | None, float | None, float, float]:
    """Overshoot, settling time, rise time, rms error and late rms error of a step from 0 to 1."""
    overshoot = max(float(rise.max()) - 1.0, 0.0)
    outside = np.flatnonzero(np.abs(rise - 1.0) > SETTLING_BAND)
    settling: float | None = 0.0
    if len(outside):
        last = int(outside[-1])
        settling = None if last == len(time) - 1 else float(time[last + 1])
    reached = [np.flatnonzero(rise >= level) for level in (0.1, 0.9)]
    times = [float(time[rows[0]]) for rows in reached if len(rows)]
    errors = (rise - 1.0) ** 2
    error, late = (float(np.sqrt(np.mean(part))) for part in (errors, errors[len(errors) // 2 :]))
    return overshoot, settling, times[1] - times[0] if len(times) == 2 else None, error, late


def _largest(values: list[float | None]) -> float | None:
    numbers = [value for value in values if value is not None]
    return max(numbers) if len(numbers) == len(values) else None
