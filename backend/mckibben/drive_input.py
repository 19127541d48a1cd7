"""What a caller says about a drive, made complete: presets looked up, everything in SI, limits checked.

The one place where the command line and the HTTP interface turn a drive document into
`mckibben.simulation.parts.Drive`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import pi, radians

from mckibben.api.schemas.convert import given_muscle
from mckibben.api.schemas.drives import ControllerInput, DriveDocument, LoadInput, TubeInput, ValveInput
from mckibben.muscle_input import StartModel
from mckibben.physics import gas
from mckibben.physics.errors import InputError
from mckibben.presets import FittingPreset, TubePreset, ValvePreset
from mckibben.presets.quantity import quantities
from mckibben.simulation.control import PidController, controller_from
from mckibben.simulation.parts import Drive, Load, Regulator, Tube, Valve
from mckibben.simulation.shapes import Signal
from mckibben.simulation.signals import signal_from
from mckibben.simulation.static import StaticModel
from mckibben.studio import Studio

_DEFAULT_RATIO = 0.3
_DEFAULT_MAX_CONTRACTION = 0.25
_SHORTEST = 0.1  # a muscle does not get shorter than this share of its length


@dataclass(frozen=True)
class GivenDrive:
    """A drive ready to run, and what to know about it.

    Attributes:
        drive: in SI.
        start: its muscle with all effects.
        unverified: preset id -> names of its figures that enter and nobody verified; muscles left out.
        notes: where in the document -> remark.
    """

    drive: Drive
    start: StartModel
    unverified: Mapping[str, tuple[str, ...]]
    notes: Mapping[str, str]


def drive_of(document: DriveDocument, studio: Studio) -> GivenDrive:
    """The drive that a document means.

    Raises:
        InputError: an unknown preset, effect or shape (with the nearest match), or numbers that cannot be;
            ``field`` is the path in the document.
    """
    valve_preset = _preset(studio, "valves", document.valve and document.valve.preset, "valve.preset")
    tube_preset = _preset(studio, "tubes", document.tube and document.tube.preset, "tube.preset")
    fittings = [
        _preset(studio, "fittings", name, f"fittings.{index}") for index, name in enumerate(document.fittings)
    ]
    assert valve_preset is None or isinstance(valve_preset, ValvePreset)  # noqa: S101 - of its folder
    assert tube_preset is None or isinstance(tube_preset, TubePreset)  # noqa: S101
    parts = [part for part in (valve_preset, tube_preset, *fittings) if part is not None]

    start = studio.start_model(given_muscle(document.muscle), document.effects)
    if document.effects is None:
        own = {
            name: studio.catalogue[name].defaults | values
            for part in parts
            for name, values in part.effect_values().items()
        }
        start = replace(start, effects={**start.effects, **own})
    model = studio.static_model(start)
    regulator = _regulator(document, valve_preset)
    valve = _valve(document.valve, valve_preset)
    command, controller, reference, notes = _command(document, regulator is not None)
    _check_flow(valve, command, controller)
    lowest, highest = _stops(document, model)
    drive = Drive(
        model=model,
        valve=valve,
        load=_load(document.load),
        command=command,
        duration=document.duration,
        supply_pressure=document.supply.pressure,
        regulator=regulator,
        tube=_tube(document.tube, tube_preset),
        min_contraction=lowest,
        max_contraction=highest,
        start_pressure=document.start_pressure,
        fitting_volume=document.gas.dead_volume + _port_volume(fittings),
        polytropic_exponent=document.gas.polytropic_exponent,
        controller=controller,
        reference=reference,
        ambient_pressure=document.gas.ambient_pressure,
        temperature=document.gas.temperature,
    )
    unverified = {
        part.id: names
        for part in parts
        if (names := _unverified(part, with_effects=document.effects is None))
    }
    return GivenDrive(drive, start, unverified, notes)


def _preset(
    studio: Studio, kind: str, preset_id: str | None, field: str
) -> ValvePreset | TubePreset | FittingPreset | None:
    if preset_id is None:
        return None
    try:
        found = studio.library.get(kind, preset_id)
    except InputError as error:
        raise InputError(error.message, field=field, hint=error.hint, code="unknown_preset") from error
    assert isinstance(found, (ValvePreset, TubePreset, FittingPreset))  # noqa: S101 - of its folder
    return found


# Figures of parts that enter a run.
_ENTER = {
    "sonic_conductance",
    "exhaust_conductance",
    "critical_pressure_ratio",
    "inside_diameter",
    "port_volume",
}


def _unverified(part: ValvePreset | TubePreset | FittingPreset, *, with_effects: bool) -> tuple[str, ...]:
    return tuple(
        path.rpartition(".")[2].replace("_", " ")
        for path, quantity in quantities(part)
        if not quantity.verified
        and (
            (path.startswith("data.") and path.removeprefix("data.") in _ENTER)
            or path.startswith("regulator.")
            or (with_effects and path.startswith("effects."))
        )
    )


def _figure(preset: ValvePreset | TubePreset | FittingPreset | None, name: str, unit: str) -> float | None:
    """A figure of a preset in SI; None when there is no preset or it does not have it."""
    if preset is None or name not in preset.data:
        return None
    return preset.data[name].si(unit)


def _first(*values: float | None) -> float | None:
    return next((value for value in values if value is not None), None)


def _valve(given: ValveInput | None, preset: ValvePreset | None) -> Valve:
    if given is None:
        raise InputError("valve is missing", field="valve", hint='e.g. {"preset": "MPYE-5-1/8-HF"}')
    ratio = _first(
        given.critical_pressure_ratio, _figure(preset, "critical_pressure_ratio", "1"), _DEFAULT_RATIO
    )
    assert ratio is not None  # noqa: S101 - the last one never is
    fill = given.sonic_conductance
    if given.nominal_flow is not None:
        if fill is not None:
            raise InputError(
                "give the sonic conductance or the nominal flow, not both", field="valve.nominal_flow"
            )
        fill = float(gas.conductance_of_nominal_flow(nominal_flow=given.nominal_flow, critical_ratio=ratio))
    by_value = fill is not None
    fill = _first(fill, _figure(preset, "sonic_conductance", "m^3/(s*Pa)"))
    if fill is None:
        who = "the valve" if preset is None else preset.id
        raise InputError(
            f"the flow of {who} is not known",
            field="valve.sonic_conductance",
            hint='e.g. "sonic_conductance": "1.2 l/(s*bar)", or a preset that has it',
        )
    # A flow given by value means both ways; the preset's exhaust belongs to the preset's own flow.
    of_preset = None if by_value else _figure(preset, "exhaust_conductance", "m^3/(s*Pa)")
    exhaust = _first(given.exhaust_conductance, of_preset, fill)
    exhaust_ratio = _first(given.exhaust_critical_pressure_ratio, ratio)
    assert exhaust is not None  # noqa: S101 - fill is not
    assert exhaust_ratio is not None  # noqa: S101 - ratio is not
    return Valve(fill, exhaust, ratio, exhaust_ratio)


def _regulator(document: DriveDocument, preset: ValvePreset | None) -> Regulator | None:
    given, own = document.regulator, None if preset is None else preset.regulator
    if given is None and own is None:
        return None
    values: dict[str, float] = {}
    for name, unit, example in (("range", "Pa", "6 bar"), ("time", "s", "50 ms")):
        of_preset = None if own is None else getattr(own, name).si(unit)
        value = _first(None if given is None else getattr(given, name), of_preset)
        if value is None:
            raise InputError(
                f"regulator.{name} is missing", field=f"regulator.{name}", hint=f"e.g. '{example}'"
            )
        values[name] = value
    return Regulator(**values)


def _tube(given: TubeInput | None, preset: TubePreset | None) -> Tube | None:
    if given is None:
        return None
    inside = _first(given.inside_diameter, _figure(preset, "inside_diameter", "m"))
    length = _first(given.length, _figure(preset, "reference_length", "m"))
    for name, value, example in (("inside_diameter", inside, "4 mm"), ("length", length, "1 m")):
        if value is None:
            raise InputError(f"tube.{name} is missing", field=f"tube.{name}", hint=f"e.g. '{example}'")
    assert inside is not None  # noqa: S101 - checked
    assert length is not None  # noqa: S101
    if not inside < length:
        raise InputError(
            f"a tube of {length * 1e3:.4g} mm length is shorter than its bore of {inside * 1e3:.4g} mm",
            field="tube.length",
            hint="leave the tube out, or check the units",
        )
    return Tube(inside, length)


def _port_volume(fittings: list[ValvePreset | TubePreset | FittingPreset | None]) -> float:
    return sum(_figure(fitting, "port_volume", "m^3") or 0.0 for fitting in fittings)


def _load(given: LoadInput) -> Load:
    fixed = {"hanging": radians(90.0), "horizontal": 0.0}
    inclination, arrangement = given.inclination, given.arrangement
    if arrangement in fixed:
        if inclination is not None and abs(inclination - fixed[arrangement]) > 1e-3:
            raise InputError(
                f"a {arrangement} load has an inclination of {fixed[arrangement] * 180 / pi:.0f}°, "
                f"not {inclination * 180 / pi:.4g}°",
                field="load.inclination",
                hint='leave one of both out, or say "arrangement": "inclined"',
            )
        inclination = fixed[arrangement]
    elif arrangement == "inclined" and inclination is None:
        raise InputError("load.inclination is missing", field="load.inclination", hint="e.g. '30 deg'")
    if arrangement == "lever" and given.lever_ratio is None:
        raise InputError("load.lever_ratio is missing", field="load.lever_ratio", hint="e.g. 0.5")
    if arrangement not in ("lever", None) and given.lever_ratio not in (None, 1.0):
        raise InputError(
            f"a {arrangement} load has no lever", field="load.lever_ratio", hint='"arrangement": "lever"'
        )
    force = given.force
    if isinstance(force, Mapping):
        force = signal_from(force, unit="N", field="load.force")
    return Load(
        mass=given.mass,
        inclination=radians(90.0) if inclination is None else inclination,
        force=force,
        spring=given.spring,
        lever_ratio=given.lever_ratio or 1.0,
    )


def _command(
    document: DriveDocument, regulated: bool
) -> tuple[Signal, PidController | None, Signal | None, dict[str, str]]:
    """Command, controller and its reference; at rest a valve exhausts and a regulator gives no pressure."""
    rest = 0.0 if regulated else -1.0
    notes: dict[str, str] = {}
    if document.controller is not None:
        controller, reference = _controller(document.controller, rest)
        if document.command is not None:
            notes["command"] = "not used: the controller gives the command"
        closed = signal_from({"shape": "step", "level": 0.0, "initial": 0.0}, unit="1", field="command")
        return closed, controller, reference, notes
    if document.command is None:
        raise InputError(
            "command is missing", field="command", hint='e.g. {"shape": "pulse", "on": "0 s", "off": "2 s"}'
        )
    command = signal_from(document.command, unit="1", field="command", rest=rest, limits=(rest, 1.0))
    return command, None, None, notes


def _controller(given: ControllerInput, rest: float) -> tuple[PidController, Signal]:
    values = given.model_dump(exclude_none=True)
    reference = signal_from(values.pop("reference"), unit="m", field="controller.reference")
    return controller_from(values, output_min=rest), reference


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
                f"valve.{name} is 0, but the command asks for this way", field=f"valve.{name}",
                hint="e.g. '1.2 l/(s*bar)'",
            )  # fmt: skip


def _stops(document: DriveDocument, model: StaticModel) -> tuple[float, float]:
    """End stops as contractions, within what the muscle can be."""
    given = document.stops
    lowest, highest = given.min_contraction, given.max_contraction
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
