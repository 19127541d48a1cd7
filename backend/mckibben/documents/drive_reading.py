"""From a drive document to a drive: presets looked up, values converted to SI, limits checked.

Command line and HTTP interface both use it to make a `mckibben.simulation.drive.parts.Drive`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_parts import (
    TYPICAL_TUBE,
    Part,
    flow_control_of,
    joint_load,
    load_of,
    port_volume_of,
    pwm_of,
    quick_exhaust_of,
    regulator_of,
    stated_joint,
    tube_of,
    unverified_of,
    valve_of,
)
from mckibben.documents.joint_parts import joint_stops, path_of
from mckibben.documents.kinds import is_preset, no_such, refuse_other, refuse_table
from mckibben.documents.located import at_file, located
from mckibben.documents.problems import validated
from mckibben.documents.start_model import StartModel, stated_muscle
from mckibben.documents.studio import Studio
from mckibben.documents.value_names import value_names
from mckibben.physics.errors import InputError, fields_inside
from mckibben.physics.muscle_path import MusclePath
from mckibben.physics.units import si
from mckibben.presets import DrivePreset, FittingPreset, TubePreset, ValvePreset
from mckibben.presets.reading import BadDocumentError, parse, read_file
from mckibben.simulation.command.pid import PidController, controller_from
from mckibben.simulation.command.shapes import Scaled, Signal
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.joint import largest_difference
from mckibben.simulation.drive.joint_path import JointPath, joint_path
from mckibben.simulation.drive.parts import Drive, StiffnessControl, Valve
from mckibben.simulation.statics.joint import weight_torque
from mckibben.simulation.statics.model import StaticModel


class Control(NamedTuple):
    """Controller, its set point [m], and the second one of a joint."""

    controller: PidController
    reference: Signal
    stiffness: StiffnessControl | None


def control_of(document: DriveDocument, regulated: bool, radius: float | None = None) -> Control:
    """Controller and set points of a drive document that has a controller.

    Args:
        document: the drive document.
        regulated: whether a pressure regulator feeds the muscle.
        radius: of the rim at which the coordinate of a joint counts [m]; None = the pulley's.

    Raises:
        InputError: no set point or two, a joint's without a joint, an impossible gain; names the field.
    """
    stated = document.controller
    assert stated is not None  # noqa: S101 - asked for drives with a controller only
    load, values = document.load, stated.model_dump(exclude_none=True)
    joint, second = values.pop("angle", None), values.pop("stiffness", None)
    position = values.pop("reference", None)
    if load.arrangement == "joint" and second is not None:
        raise InputError(
            "the stiffness of a joint is controlled on a pulley only",
            field="controller.stiffness",
            hint='"load": {"arrangement": "antagonist", "pulley_radius": "20 mm"}',
        )
    if load.arrangement != "joint" and (load.arrangement != "antagonist" or load.pulley_radius is None):
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
        rim = load.pulley_radius if radius is None else radius
        assert rim is not None  # noqa: S101 - of a joint
        angle = _signal_or_constant(joint, "rad", "controller.angle")
        reference = Scaled(of=angle, factor=rim)
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


def _signal_or_constant(value: Any, unit: str, field: str) -> Signal:
    if not isinstance(value, Mapping):
        value = {"shape": "step", "level": value, "initial": value}
    return signal_from(value, unit=unit, field=field)


_DEFAULT_MAX_CONTRACTION = 0.25
_REACHED = {None: 0, "from below": 1, "from above": -1}
_SHORTEST = 0.1  # shortest possible muscle, share of its rest length


@dataclass(frozen=True, slots=True)
class ValveRating:
    """What a valve is made for; None where its preset does not state it.

    Attributes:
        valve: id of its preset.
        lowest_pressure, highest_pressure: of the supply, gauge [Pa].
        highest_frequency: at which it can be switched [Hz].
        source: where these figures come from.
    """

    valve: str
    lowest_pressure: float | None
    highest_pressure: float | None
    highest_frequency: float | None
    source: str


@dataclass(frozen=True)
class AnnotatedDrive:
    """A drive ready to run, with notes for the user.

    Attributes:
        drive: in SI.
        start: its muscle with all effects.
        unverified: preset id -> its unverified values in use, in words; without the muscle.
        notes: path in the document -> note.
        valve_rating: from the valve's preset; None without a preset.
    """

    drive: Drive
    start: StartModel
    unverified: Mapping[str, tuple[str, ...]]
    notes: Mapping[str, str]
    valve_rating: ValveRating | None = None


def drive_of(document: DriveDocument, studio: Studio, *, measured: bool = False) -> AnnotatedDrive:
    """The drive described by a document.

    Args:
        document: the drive document.
        studio: presets and effects.
        measured: the drive belongs to a measurement with its own command, so the document needs none.

    Raises:
        InputError: an unknown preset, effect or shape (with the nearest match), or impossible values;
            ``field`` is the path in the document.
    """
    valve_preset, tube_preset, fittings = _preset_parts(document, studio)
    parts = [part for part in (valve_preset, tube_preset, *fittings) if part is not None]

    start = studio.start_model(stated_muscle(document.muscle), document.effects)
    if document.effects is None:
        start = with_effects_of_parts(start, document, studio)
    model = studio.static_model(start)
    regulator = regulator_of(document.regulator, valve_preset)
    valve = valve_of(document.valve, valve_preset)
    path = joint_path_of(document, model)
    radius = None if path is None else path.rim
    command, control, notes = _command(document, regulator is not None, measured=measured, radius=radius)
    _check_flow(valve, command, None if control is None else control.controller)
    tube, control_valve = tube_of(document.tube, tube_preset), flow_control_of(document.flow_control)
    if path is not None:
        start = with_joint_effects(start, document, studio)
        model = studio.static_model(start)
    lowest, highest = (0.0, 0.25) if path is not None else stops_of(document, model)
    if document.start.position is not None and document.start.reached is not None:
        raise InputError(
            "a load that is released at a stated position has not come to rest there",
            field="start.reached",
            hint="leave out start.position or start.reached",
        )
    drive = Drive(
        model=model,
        valve=valve,
        load=load_of(document.load) if path is None else joint_load(document.load, path),
        command=command,
        duration=document.duration,
        supply_pressure=document.supply.pressure,
        regulator=regulator,
        tube=tube,
        flow_control=control_valve,
        pwm=pwm_of(document.pwm, regulated=regulator is not None),
        quick_exhaust=quick_exhaust_of(document.quick_exhaust, tube=tube, control=control_valve),
        assumed_tube=None if "tube" in document.model_fields_set else TYPICAL_TUBE,
        min_contraction=lowest,
        max_contraction=highest,
        start_pressure=document.start_pressure,
        start_position=document.start.position,
        start_reached=_REACHED[document.start.reached],
        restitution=document.stops.restitution,
        fitting_volume=document.gas.dead_volume + port_volume_of(fittings),
        polytropic_exponent=document.gas.polytropic_exponent,
        wall_heat_transfer=document.gas.wall_heat_transfer,
        **_pair(document, lowest, highest, path)._asdict(),
        path=path,
        controller=None if control is None else control.controller,
        reference=None if control is None else control.reference,
        stiffness=None if control is None else control.stiffness,
        ambient_pressure=document.gas.ambient_pressure,
        temperature=document.gas.temperature,
        curve_fit=document.curve_fit,
    )
    unverified = {
        part.id: value_names(paths, studio.catalogue)
        for part in parts
        if (paths := unverified_of(part, with_effects=document.effects is None))
    }
    return AnnotatedDrive(drive, start, unverified, notes, _rating(valve_preset))


def _preset_parts(
    document: DriveDocument, studio: Studio
) -> tuple[ValvePreset | None, TubePreset | None, list[FittingPreset]]:
    valve = _preset(studio, "valves", document.valve.preset, "valve.preset")
    tube = _preset(studio, "tubes", document.tube.preset if document.tube else None, "tube.preset")
    fittings = [
        _preset(studio, "fittings", name, f"fittings.{index}") for index, name in enumerate(document.fittings)
    ]
    assert valve is None or isinstance(valve, ValvePreset)  # noqa: S101 - of its folder
    assert tube is None or isinstance(tube, TubePreset)  # noqa: S101
    return valve, tube, [part for part in fittings if isinstance(part, FittingPreset)]


def with_effects_of_parts(start: StartModel, document: DriveDocument, studio: Studio) -> StartModel:
    """The model of a muscle with the effects of the presets of valve, tube and fittings of its drive.

    Raises:
        InputError: an unknown preset.
    """
    valve, tube, fittings = _preset_parts(document, studio)
    added = {
        name: studio.catalogue[name].defaults | values
        for part in (valve, tube, *fittings)
        if part is not None
        for name, values in part.effect_values().items()
    }
    # What the parts of the drive add changes nothing of the muscle that was measured.
    return replace(start, effects={**start.effects, **added}, fitted=start.fit)


def _rating(preset: ValvePreset | None) -> ValveRating | None:
    if preset is None:
        return None
    units = {"min_pressure": "Pa", "max_pressure": "Pa", "max_frequency": "Hz"}
    stated = {name: preset.data[name] for name in units if name in preset.data}
    numbers = (stated[name].si(unit) if name in stated else None for name, unit in units.items())
    sources = dict.fromkeys(quantity.source for quantity in stated.values())
    return ValveRating(preset.id, *numbers, source="; ".join(sources))


def _preset(studio: Studio, kind: str, preset_id: str | None, field: str) -> Part | None:
    if preset_id is None:
        return None
    try:
        preset = studio.library.get(kind, preset_id)
    except InputError as error:
        raise error.at(field, code="unknown_preset") from error
    assert isinstance(preset, (ValvePreset, TubePreset, FittingPreset))  # noqa: S101 - of its folder
    return preset


def _command(
    document: DriveDocument, regulated: bool, *, measured: bool, radius: float | None
) -> tuple[Signal, Control | None, dict[str, str]]:
    """Command, controller and its reference; at rest a valve exhausts and a regulator gives no pressure."""
    rest = 0.0 if regulated else -1.0
    notes: dict[str, str] = {}
    closed = signal_from({"shape": "step", "level": 0.0, "initial": 0.0}, unit="1", field="command")
    if document.controller is not None:
        control = control_of(document, regulated, radius)
        if document.command is not None:
            notes["command"] = "not used: the controller generates the command"
        return closed, control, notes
    if document.command is None:
        if measured:
            return closed, None, notes
        raise InputError(
            "command is missing", field="command", hint='e.g. {"shape": "pulse", "on": "0 s", "off": "2 s"}'
        )
    command = signal_from(document.command, unit="1", field="command", rest=rest, limits=(rest, 1.0))
    return command, None, notes


def _check_flow(valve: Valve, command: Signal, controller: PidController | None) -> None:
    lowest, highest = command.extent
    if controller is not None:
        lowest, highest = controller.output_min, controller.output_max
    lowest = min(lowest, command.before)
    for name, conductance, needed in (
        ("sonic_conductance", valve.fill_conductance, highest > 0.0),
        ("exhaust_conductance", valve.exhaust_conductance, lowest < 0.0),
    ):
        if needed and not conductance > 0.0:
            raise InputError(
                f"valve.{name} is 0, but the command needs this flow", field=f"valve.{name}",
                hint="e.g. '1.2 l/(s*bar)'",
            )  # fmt: skip


DEFAULT_PRECONTRACTION = 0.1  # default of both muscles of a pair


class _PairSettings(NamedTuple):
    """Arguments of `Drive` that only an antagonist pair has."""

    pair: bool = False
    precontraction: float = 0.0
    pulley_radius: float | None = None


def _pair(document: DriveDocument, lowest: float, highest: float, path: JointPath | None) -> _PairSettings:
    """Arguments of a drive that describe its antagonist pair, if it is one."""
    load = document.load
    if path is not None:
        return _PairSettings(pair=len(path.lengths) == 2, pulley_radius=path.rim)
    if load.arrangement != "antagonist":
        return _PairSettings()
    middle = DEFAULT_PRECONTRACTION if load.precontraction is None else load.precontraction
    if not lowest < middle < highest:
        raise InputError(
            f"the middle at {middle * 100:.3g} % is not between the stops at {lowest * 100:.3g} % and "
            f"{highest * 100:.3g} %",
            field="load.precontraction",
            hint="e.g. '10 %'",
        )
    return _PairSettings(pair=True, precontraction=middle, pulley_radius=load.pulley_radius)


def joint_path_of(document: DriveDocument, model: StaticModel) -> JointPath | None:
    """The paths of the muscles of a joint; None of a drive without one.

    Raises:
        InputError: muscles of their own, more than two, a lever of the wrong sign, a path longer than the
            braid allows, or stops of a drive along a line.
    """
    load = document.load
    if load.arrangement != "joint":
        if load.joint is not None:
            raise InputError("only a joint has paths", field="load.joint", hint='"arrangement": "joint"')
        return None
    joint = stated_joint(load)
    for name in sorted(document.stops.model_fields_set - {"restitution"}):
        raise InputError(
            "a joint stops at angles", field=f"stops.{name}", hint='"load": {"joint": {"stops": {...}}}'
        )
    with fields_inside("load.joint"):
        low, high = joint_stops(joint)
        if len(joint.muscles) > 2:
            raise InputError("a run has one muscle or two", field="muscles", hint="statics take more")
        paths = []
        for place, stated in enumerate(joint.muscles):
            where = f"muscles.{place}"
            for name in ("muscle", "effects"):
                if getattr(stated, name) is not None:
                    raise InputError(
                        "in a run all muscles are that of the drive",
                        field=f"{where}.{name}",
                        hint="leave it out",
                    )
            with fields_inside(where):
                rest = float(model.muscle.nominal_length)
                path = path_of(stated.path, rest_length=rest, low=low, high=high)
                _check_path(path, low, high, sense=-1.0 if place else 1.0, longest=model.longest)
            paths.append(path)
        relaxed = 0.0 if joint.spring is None else joint.spring.relaxed_at
        return joint_path(tuple(paths), low=low, high=high, spring_rest=relaxed)


def _check_path(path: MusclePath, low: float, high: float, *, sense: float, longest: float) -> None:
    """Refuse what a run cannot follow."""
    angle = np.linspace(low, high, 361)
    lever = np.broadcast_to(np.asarray(path.lever(angle), float), angle.shape)
    if not np.all(sense * lever > 0.0):
        place = int(np.argmin(sense * lever))
        which = "first muscle turns to greater" if sense > 0.0 else "second muscle turns to smaller"
        raise InputError(
            f"the lever is {1e3 * lever[place]:.4g} mm at {np.degrees(angle[place]):.4g} deg: in a run the "
            f"{which} angles everywhere between the stops",
            field="path",
            hint="narrower stops, or the other sign of the angle",
        )
    length = np.asarray(path.length(angle), float)
    if np.max(length) >= longest:
        place = int(np.argmax(length))
        raise InputError(
            f"at {np.degrees(angle[place]):.4g} deg the path is {1e3 * length[place]:.4g} mm long, and the "
            f"braid locks at {1e3 * longest:.4g} mm",
            field="path",
            hint="narrower stops, or more contraction at the angle 0",
        )


def with_joint_effects(start: StartModel, document: DriveDocument, studio: Studio) -> StartModel:
    """The model with the friction of the bearing and the weight of the link of its joint."""
    joint = document.load.joint
    stated: dict[str, float] = {}
    if joint is not None and joint.friction:
        stated["friction"] = joint.friction
    if joint is not None and joint.link is not None:
        stated["link.moment"] = weight_torque(mass=joint.link.mass, centre=joint.link.centre)
        stated["link.level_at"] = joint.link.level_at
    added: dict[str, dict[str, float]] = {}
    for name, effect in studio.catalogue.items():
        given = {p.name: stated[p.of_joint] for p in effect.parameters if p.of_joint in stated}
        if given:
            added[name] = given
    # They change nothing of the muscle that was measured.
    return replace(start, effects={**added, **start.effects}, fitted=start.fit) if added else start


def stops_of(document: DriveDocument, model: StaticModel) -> tuple[float, float]:
    """End stops as contractions, within the possible range of the muscle."""
    stops = document.stops
    lowest, highest = stops.min_contraction, stops.max_contraction
    rest, longest = model.muscle.nominal_length, model.longest
    locked = 1.0 - longest / rest
    if lowest < locked:
        raise InputError(
            f"a stretch of {-lowest * 100:.3g} % is beyond the braid lock at {-locked * 100:.3g} %",
            field="stops.min_contraction",
            hint=f"at least '{locked * 100:.3g} %'",
        )
    if highest is None:
        highest = max(model.limits.max_contraction or _DEFAULT_MAX_CONTRACTION, lowest + 1e-3)
    if highest > 1.0 - _SHORTEST:
        raise InputError(
            f"no muscle contracts by {highest * 100:.3g} %", field="stops.max_contraction", hint="e.g. '25 %'"
        )
    if not highest > lowest:
        raise InputError(
            f"the stops are in the wrong order: {highest * 100:.3g} % is not above {lowest * 100:.3g} %",
            field="stops.max_contraction",
            hint="e.g. '25 %'",
        )
    return lowest, highest


def preset_document(preset_id: str, studio: Studio) -> DriveDocument:
    """The document of a drive preset.

    Raises:
        InputError: there is no such preset, or its document cannot be used.
    """
    try:
        preset = studio.library.get("drives", preset_id)
    except InputError as error:
        other = no_such(preset_id, "drive", studio.library)
        raise (other if other.code == "wrong_kind" else error.at(None, code="unknown_preset")) from error
    assert isinstance(preset, DrivePreset)  # noqa: S101 - of its folder
    return read_document(preset.document, f"the drive preset {preset.id}")


def read_document(document: object, subject: str) -> DriveDocument:
    """A drive document from JSON.

    Args:
        document: parsed JSON.
        subject: name of the document in messages.

    Raises:
        InputError: the document is not valid; ``field`` is the path in it.
    """
    return validated(DriveDocument, document, subject)


def named_document(name: str, studio: Studio) -> DriveDocument:
    """The document of a file, of a preset file, or of a preset.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    path = Path(name)
    known = [preset.id for preset in studio.library.list("drives")]
    if name in known or not (path.exists() or name.lower().endswith(".json")):
        if name not in known:
            raise no_such(name, "drive", studio.library)
        return preset_document(name, studio)
    try:
        refuse_table(name, "drive")
        content = read_file(path, follow_links=True)
        refuse_other(content, "", ("drive",))
        if is_preset(content):
            preset = parse(DrivePreset, content, studio.effect_table)
            assert isinstance(preset, DrivePreset)  # noqa: S101 - parsed as one
            content = preset.document
        return read_document(content, "the drive")
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{name}: {located(finding.field, finding.message)}", hint=finding.hint) from bad
    except InputError as error:
        raise at_file(name, error.field, error.message, error.hint) from error
