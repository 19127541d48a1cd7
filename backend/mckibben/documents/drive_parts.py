"""Valve, regulator, tube and load of a drive document, with the values of their presets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf, pi, radians

from mckibben.documents.drive import LoadInput
from mckibben.documents.drive_air import (
    FlowControlInput,
    PwmInput,
    QuickExhaustInput,
    RegulatorInput,
    TubeInput,
    ValveInput,
)
from mckibben.documents.joint_parts import JointInput
from mckibben.physics import gas
from mckibben.physics.errors import InputError
from mckibben.presets import FittingPreset, TubePreset, ValvePreset
from mckibben.presets.quantity import quantities
from mckibben.simulation.command.pwm import PulseWidth
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.joint_path import JointPath
from mckibben.simulation.drive.parts import FlowControl, Load, QuickExhaust, Regulator, Tube, Valve

Part = ValvePreset | TubePreset | FittingPreset

_DEFAULT_RATIO = 0.3  # critical pressure ratio, typical of valves


#: Values of parts that a simulation uses.
ENTERING = frozenset(
    {"sonic_conductance", "exhaust_conductance", "critical_pressure_ratio", "inside_diameter", "port_volume"}
)


def unverified_of(part: Part, *, with_effects: bool) -> tuple[str, ...]:
    """Paths in the preset of the unverified values that a simulation uses, "effects.valve_lag.time"."""
    return tuple(
        path
        for path, quantity in quantities(part)
        if not quantity.verified
        and (
            (path.startswith("data.") and path.removeprefix("data.") in ENTERING)
            or path.startswith("regulator.")
            or (with_effects and path.startswith("effects."))
        )
    )


def _figure(preset: Part | None, name: str, unit: str) -> float | None:
    """A value of a preset in SI; None without a preset or without this value."""
    if preset is None or name not in preset.data:
        return None
    return preset.data[name].si(unit)


def _first(*values: float | None) -> float | None:
    return next((value for value in values if value is not None), None)


def valve_of(valve: ValveInput, preset: ValvePreset | None) -> Valve:
    """Conductances and critical ratios of filling and venting; stated values override those of the preset."""
    ratio = _first(
        valve.critical_pressure_ratio, _figure(preset, "critical_pressure_ratio", "1"), _DEFAULT_RATIO
    )
    assert ratio is not None  # noqa: S101 - the default is not None
    fill = valve.sonic_conductance
    if valve.nominal_flow is not None:
        if fill is not None:
            raise InputError(
                "give the sonic conductance or the nominal flow, not both", field="valve.nominal_flow"
            )
        fill = float(gas.conductance_of_nominal_flow(nominal_flow=valve.nominal_flow, critical_ratio=ratio))
    by_value = fill is not None
    fill = _first(fill, _figure(preset, "sonic_conductance", "m^3/(s*Pa)"))
    if fill is None:
        who = "the valve" if preset is None else preset.id
        raise InputError(
            f"the flow of {who} is not known",
            field="valve.sonic_conductance",
            hint='e.g. "sonic_conductance": "1.2 l/(s*bar)", or a preset with this value',
        )
    # A stated flow is that of both directions; the exhaust flow of the preset belongs to its own fill flow.
    of_preset = None if by_value else _figure(preset, "exhaust_conductance", "m^3/(s*Pa)")
    exhaust = _first(valve.exhaust_conductance, of_preset, fill)
    exhaust_ratio = _first(valve.exhaust_critical_pressure_ratio, ratio)
    assert exhaust is not None  # noqa: S101 - fill is not
    assert exhaust_ratio is not None  # noqa: S101 - ratio is not
    return Valve(fill, exhaust, ratio, exhaust_ratio)


_BAND = 0.05  # of the range, where an orifice of a regulator is fully open; an estimate


def regulator_of(regulator: RegulatorInput | None, preset: ValvePreset | None) -> Regulator | None:
    """The regulator, stated values before those of the preset; None for a plain valve."""
    of_preset = None if preset is None else preset.regulator
    if regulator is None and of_preset is None:
        return None

    def value(name: str, unit: str) -> float | None:
        own = None if of_preset is None else getattr(of_preset, name)
        return _first(getattr(regulator, name, None), None if own is None else own.si(unit))

    values: dict[str, float] = {}
    for name, unit, example in (("range", "Pa", "6 bar"), ("time", "s", "50 ms")):
        found = value(name, unit)
        if found is None:
            raise InputError(
                f"regulator.{name} is missing", field=f"regulator.{name}", hint=f"e.g. '{example}'"
            )
        values[name] = found
    band, dead_band = value("band", "Pa"), value("dead_band", "Pa")
    if dead_band is not None and dead_band >= values["range"]:
        most = values["range"] / 1e5
        raise InputError(
            f"a dead band of {dead_band / 1e5:.3g} bar is not below the range of {most:.3g} bar",
            field="regulator.dead_band",
            hint="e.g. '6 mbar'",
        )
    return Regulator(
        **values,
        damping=value("damping", "1"),
        band=_BAND * values["range"] if band is None else band,
        dead_band=dead_band or 0.0,
    )


#: Assumed tube where an effect needs one and none is stated: 1 m of a common size.
TYPICAL_TUBE = Tube(inside_diameter=4e-3, length=1.0)


def tube_of(tube: TubeInput | None, preset: TubePreset | None) -> Tube | None:
    """Bore and length; None without a tube."""
    if tube is None:
        return None
    inside = _first(tube.inside_diameter, _figure(preset, "inside_diameter", "m"))
    length = _first(tube.length, _figure(preset, "reference_length", "m"))
    for name, value, example in (("inside_diameter", inside, "4 mm"), ("length", length, "1 m")):
        if value is None:
            raise InputError(f"tube.{name} is missing", field=f"tube.{name}", hint=f"e.g. '{example}'")
    assert inside is not None  # noqa: S101 - checked
    assert length is not None  # noqa: S101
    if not inside < length:
        raise InputError(
            f"a tube of {length * 1e3:.4g} mm length is shorter than its bore of {inside * 1e3:.4g} mm",
            field="tube.length",
            hint="omit the tube, or check the units",
        )
    return Tube(inside, length)


def flow_control_of(document: FlowControlInput | None) -> FlowControl | None:
    """Its restrictions while filling and while venting; None without one."""
    if document is None:
        return None
    ratio = _DEFAULT_RATIO if document.critical_pressure_ratio is None else document.critical_pressure_ratio
    free = inf if document.free_conductance is None else document.free_conductance
    if free < document.sonic_conductance:
        raise InputError(
            f"the free direction passes less ({free * 1e8:.4g} l/(s*bar)) than the throttled one "
            f"({document.sonic_conductance * 1e8:.4g} l/(s*bar))",
            field="flow_control.free_conductance",
            hint="the conductance of the check valve, or leave it out",
        )
    throttled = document.sonic_conductance
    ways = (throttled, free) if document.meter == "in" else (free, throttled)
    return FlowControl(*ways, ratio, ratio)


def quick_exhaust_of(
    document: QuickExhaustInput | None, *, tube: Tube | None, control: FlowControl | None
) -> QuickExhaust | None:
    """The quick exhaust valve; None without one.

    Raises:
        InputError: there is no tube whose pressure could open it, or the flow control throttles what does
            not pass it any more.
    """
    if document is None:
        return None
    if tube is None:
        raise InputError(
            "a quick exhaust valve opens when the pressure in the tube falls below that in the muscle, but "
            "there is no tube",
            field="quick_exhaust",
            hint='state the tube, e.g. {"preset": "PUN-H-6x1", "length": "1 m"}',
        )
    if control is not None and control.exhaust_conductance < control.fill_conductance:
        raise InputError(
            "no air flows back through the flow control: the muscle vents through its quick exhaust valve",
            field="flow_control.meter",
            hint='"in", or leave one of the two out',
        )
    values = {"critical_ratio": document.critical_pressure_ratio, "band": document.band}
    return QuickExhaust(
        document.sonic_conductance, **{name: value for name, value in values.items() if value is not None}
    )


def pwm_of(pwm: PwmInput | None, *, regulated: bool) -> PulseWidth | None:
    """The modulation; None without one.

    Raises:
        InputError: of a regulator, or no pulse is possible.
    """
    if pwm is None:
        return None
    if regulated:
        raise InputError(
            "a pressure regulator is not switched", field="pwm", hint="choose a valve, or leave pwm out"
        )
    on, off = pwm.min_on or 0.0, pwm.min_off or 0.0
    if (on + off) * pwm.frequency >= 1.0:
        raise InputError(
            f"in a period of {1e3 / pwm.frequency:.4g} ms there is no pulse of at least {on * 1e3:.4g} ms "
            f"with a pause of at least {off * 1e3:.4g} ms",
            field="pwm.frequency",
            hint="lower the frequency",
        )
    return PulseWidth(pwm.frequency, pwm.valves, on, off)


def port_volume_of(fittings: Sequence[Part | None]) -> float:
    """Dead volume of the fittings [m^3]."""
    return sum(_figure(fitting, "port_volume", "m^3") or 0.0 for fitting in fittings)


def stated_joint(load: LoadInput) -> JointInput:
    """The joint of a load of that arrangement.

    Raises:
        InputError: it is missing.
    """
    if load.joint is None:
        raise InputError(
            "load.joint is missing",
            field="load.joint",
            hint='e.g. {"muscles": [{"path": {"lever": "30 mm"}}], "inertia": "0.01 kg*m^2"}',
        )
    return load.joint


def joint_load(load: LoadInput, path: JointPath) -> Load:
    """The load of a joint: its inertia and its torsion spring at the rim.

    Raises:
        InputError: the joint has no inertia, or the load states what belongs to one that moves along a line.
    """
    joint = stated_joint(load)
    for name in sorted(load.model_fields_set - {"joint", "arrangement"}):
        raise InputError(
            f"a joint has no {name.replace('_', ' ')} of its load",
            field=f"load.{name}",
            hint="state it in load.joint",
        )
    if not joint.inertia > 0.0:
        raise InputError(
            "load.joint.inertia is missing", field="load.joint.inertia", hint="e.g. '0.01 kg*m^2'"
        )
    spring = 0.0 if joint.spring is None else joint.spring.stiffness
    return Load(mass=joint.inertia / path.rim**2, inclination=0.0, spring=spring / path.rim**2)


def load_of(load: LoadInput) -> Load:
    """The load; its arrangement sets the inclination or requires a lever."""
    implied = {"hanging": radians(90.0), "horizontal": 0.0}
    if load.arrangement == "antagonist":
        if load.pulley_radius is None:
            raise InputError("load.pulley_radius is missing", field="load.pulley_radius", hint="e.g. '20 mm'")
        # A pulley turns about its centre: without an inclination there is no torque by weight.
        load = load.model_copy(update={"inclination": load.inclination or 0.0})
    elif load.pulley_radius is not None or load.precontraction is not None:
        name = "pulley_radius" if load.pulley_radius is not None else "precontraction"
        raise InputError(
            f"only an antagonist pair has a {name.replace('_', ' ')}",
            field=f"load.{name}",
            hint='"arrangement": "antagonist"',
        )
    inclination, arrangement = load.inclination, load.arrangement
    if arrangement in implied:
        if inclination is not None and abs(inclination - implied[arrangement]) > 1e-3:
            raise InputError(
                f"a {arrangement} load has an inclination of {implied[arrangement] * 180 / pi:.0f}°, "
                f"not {inclination * 180 / pi:.4g}°",
                field="load.inclination",
                hint='omit one of them, or give "arrangement": "inclined"',
            )
        inclination = implied[arrangement]
    elif arrangement == "inclined" and inclination is None:
        raise InputError("load.inclination is missing", field="load.inclination", hint="e.g. '30 deg'")
    if arrangement == "lever" and load.lever_ratio is None:
        raise InputError("load.lever_ratio is missing", field="load.lever_ratio", hint="e.g. 0.5")
    if arrangement not in ("lever", None) and load.lever_ratio not in (None, 1.0):
        article = "an" if arrangement[0] in "aeiou" else "a"
        raise InputError(
            f"{article} {arrangement} load has no lever",
            field="load.lever_ratio",
            hint='"arrangement": "lever"',
        )
    force = load.force
    if isinstance(force, Mapping):
        force = signal_from(force, unit="N", field="load.force")
    return Load(
        mass=load.mass,
        inclination=radians(90.0) if inclination is None else inclination,
        force=force,
        spring=load.spring,
        lever_ratio=load.lever_ratio or 1.0,
    )
