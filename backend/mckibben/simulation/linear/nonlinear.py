"""Runs of the nonlinear drive that begin exactly at an operating point."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mckibben.simulation.command.pid import PidController, PidState
from mckibben.simulation.command.shapes import Signal
from mckibben.simulation.drive.control_loop import ControlLoop
from mckibben.simulation.drive.controlled import run_loop
from mckibben.simulation.drive.initial_state import Rest, Start
from mckibben.simulation.drive.joint import largest_difference
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import (
    TOLERANCE,
    Run,
    external_force,
    parameters_of,
    simulate,
)
from mckibben.simulation.integrate.engine import compiled_drive
from mckibben.simulation.linear.point import OperatingPoint
from mckibben.simulation.outcome import Watch

Array = np.ndarray


@dataclass(frozen=True, kw_only=True)
class _Settled(PidController):
    """A controller that has held the operating point for a long time.

    Attributes:
        held: its command there [-].
        position: its reference there [m].
    """

    held: float = 0.0
    position: float = 0.0

    def start(
        self, *, measurement: float, reference: float | None = None, command: float | None = None
    ) -> PidState:
        """The state in which the controller holds the operating point."""
        return super().start(measurement=measurement, reference=self.position, command=self.held)


def _start(point: OperatingPoint) -> Start:
    bound, switches = point.bound, point.switches.copy()
    if bound.directions:
        free = point.motion == 0 and point.on_stop is None
        switches[bound.directions] = point.direction > 0 or free, point.direction < 0
    return Start(point.state.copy(), switches, point.stroke, Rest.STATED)


def run_from(point: OperatingPoint, drive: Drive, *, grid: Array, tolerance: float = TOLERANCE) -> Run:
    """A run under the command of a drive, which may differ from that of the point in numbers only.

    Args:
        point: where it begins.
        drive: with the command, the load and the duration of the run.
        grid: times of the rows.
        tolerance: see `mckibben.simulation.drive.transient.simulate`.
    """
    return simulate(drive, grid=grid, tolerance=tolerance, start=_start(point))


def controlled_from(
    point: OperatingPoint,
    drive: Drive,
    controller: PidController,
    reference: Signal,
    *,
    grid: Array,
    tolerance: float = TOLERANCE,
    joint: bool = False,
) -> Run:
    """A run under a controller that has held the point before.

    Args:
        point: where it begins.
        drive: its numbers may differ from those of the point: another mass, another supply.
        controller: of the position.
        reference: of the position [m].
        grid: times of the rows; the last is the end of the run.
        tolerance: relative error per step.
        joint: whether the loop of a joint's stiffness runs too; else the common command is constant.
    """
    if joint:
        common = drive.common_command
        controller = replace(
            controller,
            output_min=max(controller.output_min - common, -largest_difference(drive.regulator is not None)),
            output_max=min(controller.output_max - common, largest_difference(drive.regulator is not None)),
        )
    settled = _Settled(
        **{name: getattr(controller, name) for name in PidController.__dataclass_fields__},
        held=point.command - (drive.common_command if joint else 0.0),
        position=point.position,
    )
    duration = float(grid[-1])
    stiffness = drive.stiffness if joint else None
    controlled = replace(
        drive, controller=settled, reference=reference, duration=duration, stiffness=stiffness
    )
    compiled = compiled_drive(drive.structure)
    samples = int(np.ceil(duration / controller.sample_time - 1e-9))
    loop = ControlLoop(
        drive=controlled,
        compiled=compiled,
        controller=settled,
        external=external_force(controlled),
        set_points=reference.value(np.arange(samples) * controller.sample_time),
        parameters=parameters_of(controlled, compiled),
        start=_start(point),
        grid=grid,
        tolerance=tolerance,
        watch=Watch(),
    )
    return run_loop(loop)
