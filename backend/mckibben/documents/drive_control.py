"""The controller of a drive document: of a position, or of the angle and the stiffness of a joint."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from mckibben.documents.drive import DriveDocument
from mckibben.physics.errors import InputError
from mckibben.physics.units import si
from mckibben.simulation.command.pid import PidController, controller_from
from mckibben.simulation.command.shapes import Scaled, Signal
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.joint import largest_difference
from mckibben.simulation.drive.parts import StiffnessControl


class Control(NamedTuple):
    """Controller, its set point [m], and the second one of a joint."""

    controller: PidController
    reference: Signal
    stiffness: StiffnessControl | None


def control_of(document: DriveDocument, regulated: bool) -> Control:
    """Controller and set points of a drive document that has a controller.

    Raises:
        InputError: no set point or two, a joint's without a joint, an impossible gain; names the field.
    """
    given = document.controller
    assert given is not None  # noqa: S101 - asked for drives with a controller only
    load, values = document.load, given.model_dump(exclude_none=True)
    joint, second = values.pop("angle", None), values.pop("stiffness", None)
    position = values.pop("reference", None)
    if load.arrangement != "antagonist" or load.pulley_radius is None:
        for name, stated in (("angle", joint), ("stiffness", second)):
            if stated is not None:
                raise InputError(
                    f"only an antagonist pair has a joint whose {name} is controlled",
                    field=f"controller.{name}",
                    hint='"load": {"arrangement": "antagonist", "pulley_radius": "20 mm"}',
                )
    if (joint is None) == (position is None):
        raise InputError(
            "controller.reference is missing"
            if joint is None
            else "give the position or the angle, not both",
            field="controller.reference",
            hint='e.g. {"shape": "triangle", "amplitude": "20 mm", "period": "1 s"}',
        )
    if joint is None:
        reference = signal_from(position, unit="m", field="controller.reference")
    else:
        assert load.pulley_radius is not None  # noqa: S101 - of a pair
        turned = _signal_or_constant(joint, "rad", "controller.angle")
        reference = Scaled(of=turned, factor=load.pulley_radius)
    rest = 0.0 if regulated else -1.0
    if second is None:
        return Control(controller_from(values, output_min=rest), reference, None)
    most = largest_difference(regulated)
    controller = controller_from({"output_max": most, **values}, output_min=-most)
    for name in ("output_min", "output_max"):
        if abs(getattr(controller, name)) > most:
            raise InputError(
                f"a difference of {getattr(controller, name):g} leaves no command to the other muscle",
                field=f"controller.{name}",
                hint=f"between {-most:g} and {most:g}",
            )
    gains = {
        name: si(second[name], unit, field=f"controller.stiffness.{name}") if name in second else default
        for name, unit, default in (
            ("kp", "1", 0.0 if regulated else 2.0),
            ("ki", "1/s", 0.5 if regulated else 0.0),
        )
    }
    for name, gain in gains.items():
        if not 0.0 <= gain <= 1e6:
            raise InputError(
                f"{gain:g} is no gain", field=f"controller.stiffness.{name}", hint="0 or more, e.g. 2"
            )
    wanted = _signal_or_constant(second["reference"], "N*m/rad", "controller.stiffness.reference")
    return Control(controller, reference, StiffnessControl(wanted, **gains))


def _signal_or_constant(given: Any, unit: str, field: str) -> Signal:
    if not isinstance(given, Mapping):
        given = {"shape": "step", "level": given, "initial": given}
    return signal_from(given, unit=unit, field=field)
