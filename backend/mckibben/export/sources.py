"""The source and grade of every constant of a model."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mckibben.documents.drive import DriveDocument
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.export.about import Constant
from mckibben.physics.drive_terms import COUNTER_PATH_CONSTANTS, PATH_CONSTANTS
from mckibben.physics.muscle import GEOMETRY
from mckibben.presets import FittingPreset, MusclePreset, TubePreset, ValvePreset
from mckibben.presets.quantity import Quantity

_STATED = ("stated in the document", "user")
_GEOMETRY = {
    "nominal_length": ("m", "Length between the fittings at rest."),
    "braid_diameter": ("m", "Diameter of the braid at the braid angle."),
    "braid_angle": ("rad", "Angle between thread and axis at rest."),
    "wall_thickness": ("m", "Wall of the bladder at rest."),
    "inside_diameter": ("m", "Bore at rest."),
}
#: Constant of a drive -> unit, description, its path in a drive document.
DRIVE_CONSTANTS: Mapping[str, tuple[str, str, str]] = {
    "supply_pressure": ("Pa", "Absolute pressure of the supply.", "supply.pressure"),
    "ambient_pressure": ("Pa", "Absolute pressure of the surroundings.", "gas.ambient_pressure"),
    "ambient_temperature": ("K", "Temperature of supply and surroundings.", "gas.temperature"),
    "fill_conductance": ("m^3/(s*Pa)", "Sonic conductance of filling.", "valve.sonic_conductance"),
    "fill_ratio": ("1", "Critical pressure ratio of filling.", "valve.critical_pressure_ratio"),
    "exhaust_conductance": ("m^3/(s*Pa)", "Sonic conductance of venting.", "valve.exhaust_conductance"),
    "exhaust_ratio": ("1", "Critical pressure ratio of venting.", "valve.exhaust_critical_pressure_ratio"),
    "regulator_range": ("Pa", "Gauge pressure of the regulator at full command.", "regulator.range"),
    "regulator_time": ("s", "Time constant of the regulator.", "regulator.time"),
    "regulator_damping": ("1", "Damping ratio of a regulator of second order.", "regulator.damping"),
    "regulator_band": ("Pa", "Pressure error at which an orifice is fully open.", "regulator.band"),
    "regulator_dead_band": ("Pa", "Error in which both orifices are closed.", "regulator.dead_band"),
    "filling_restriction": ("m^3/(s*Pa)", "Flow control valve, filling; 1 is free flow.", "flow_control"),
    "filling_restriction_ratio": ("1", "Its critical pressure ratio.", "flow_control"),
    "venting_restriction": ("m^3/(s*Pa)", "Flow control valve, venting; 1 is free flow.", "flow_control"),
    "venting_restriction_ratio": ("1", "Its critical pressure ratio.", "flow_control"),
    "quick_exhaust_conductance": (
        "m^3/(s*Pa)",
        "Exhaust of a quick exhaust valve.",
        "quick_exhaust.sonic_conductance",
    ),
    "quick_exhaust_ratio": (
        "1",
        "Critical pressure ratio of it.",
        "quick_exhaust.critical_pressure_ratio",
    ),
    "quick_exhaust_band": ("Pa", "Pressure difference at which it is fully open.", "quick_exhaust.band"),
    "tube_volume": ("m^3", "Volume of the tube.", "tube"),
    "tube_conductance": ("m^3/(s*Pa)", "Sonic conductance of the tube.", "tube"),
    "tube_ratio": ("1", "Critical pressure ratio of the tube.", "tube"),
    "fitting_volume": ("m^3", "Dead volume of ports and fittings.", "gas.dead_volume"),
    "polytropic_exponent": ("1", "Polytropic exponent of the gas.", "gas.polytropic_exponent"),
    "wall_heat_transfer": ("W/(m^2*K)", "Heat transfer from gas to wall.", "gas.wall_heat_transfer"),
    "mass": ("kg", "Mass of the load.", "load.mass"),
    "own_mass": ("kg", "Moving mass besides the load; at least 1 g moves in all.", ""),
    "gravity": ("m/s^2", "Gravity along the motion.", "load.inclination"),
    "spring": ("N/m", "Spring against the contraction.", "load.spring"),
    "lever_ratio": ("1", "Stroke of the muscle per stroke of the load.", "load.lever_ratio"),
    "precontraction": ("m", "Stroke of both muscles of a pair in the middle.", "load.precontraction"),
    "stop_low": ("m", "Stroke of the muscle at its lower end stop.", "stops.min_contraction"),
    "stop_high": ("m", "Stroke of the muscle at its upper end stop.", "stops.max_contraction"),
    "slack_damping": ("N*s/m", "Damping of a slack muscle, of the method.", ""),
}
_OF_PATH = {
    "rim": ("m", "Radius at which the angle of a joint counts as a stroke.", "load.joint"),
    "spring_rest": ("m", "Stroke at which the torsion spring is relaxed.", "load.joint.spring"),
    "path_middle": ("rad", "Middle angle between the stops.", "load.joint.stops"),
    "path_half": ("rad", "Half of the angle between the stops.", "load.joint.stops"),
}
#: The same of the paths of a joint: coefficients of polynomials of (angle - middle) / half.
PATH_WORDS: Mapping[str, tuple[str, str, str]] = {
    name: _OF_PATH.get(
        name,
        (
            "m",
            f"Coefficient {name.rpartition('_')[2]} of the {'lever' if '_lever_' in name else 'length'} "
            f"of the {'second' if name.startswith('counter_') else 'first'} muscle.",
            "load.joint.muscles",
        ),
    )
    for name in (*PATH_CONSTANTS, *COUNTER_PATH_CONSTANTS)
}
#: Unit and description (and more) of every number of a drive besides those of its effects.
CONSTANT_WORDS: Mapping[str, tuple[str, ...]] = {**DRIVE_CONSTANTS, **PATH_WORDS, **_GEOMETRY}
# Figure of a part's preset for a path of the document.
_FIGURES = {
    "valve.sonic_conductance": "sonic_conductance",
    "valve.exhaust_conductance": "exhaust_conductance",
    "valve.critical_pressure_ratio": "critical_pressure_ratio",
    "valve.exhaust_critical_pressure_ratio": "critical_pressure_ratio",
}


@dataclass(frozen=True)
class Sources:
    """Where the numbers of a model can come from.

    Attributes:
        studio: presets.
        start: muscle and effects.
        saved: the fitted model, if it is one.
        document: of the drive.
        grounds: of a drive preset: path in its document -> source.
    """

    studio: Studio
    start: StartModel
    saved: SavedModel | None = None
    document: DriveDocument | None = None
    grounds: Mapping[str, Any] | None = None

    def constants(self, drive: Mapping[str, float] | None = None) -> tuple[Constant, ...]:
        """All constants; ``drive``: those of a run by name."""
        return (*self._geometry(), *self._effects(), *self._drive(drive or {}))

    def _muscle_preset(self) -> MusclePreset | None:
        preset = self.start.preset
        if preset is None or preset.id not in {each.id for each in self.studio.library.list("muscles")}:
            return None
        return self.studio.library.muscle(preset.id)

    def _fitted(self) -> tuple[str, str]:
        origin = None if self.saved is None else self.saved.origin
        files = ", ".join(file.name for file in origin.files) if origin is not None else "measurements"
        return f"fitted to {files}", "D"

    def _geometry(self) -> Iterator[Constant]:
        preset = self._muscle_preset()
        for name in GEOMETRY:
            unit, description = _GEOMETRY[name]
            value = float(getattr(self.start.muscle, name))
            quantity = None if preset is None else getattr(preset.geometry, name)
            ground = self._ground(f"muscle.{name}")
            if self.saved is not None and name in self.saved.free:
                source = self._fitted()
            elif name in self.start.assumed:
                source = ("typical value, assumed because it is not stated", "E")
            elif (of_preset := _same(quantity, value, unit)) is not None:
                source = of_preset
            elif value == 0.0:
                source = ("not known, and not used", "user")
            else:
                source = ground or _STATED
            yield Constant(name, value, unit, description, *source)

    def _effects(self) -> Iterator[Constant]:
        tables = [part.effects for part in self._parts()]
        freed = set() if self.saved is None else set(self.saved.freed)
        for effect_id, values in self.start.effects.items():
            for parameter in self.start.catalogue[effect_id].parameters:
                path, value = f"{effect_id}.{parameter.name}", values[parameter.name]
                quantities = [table.get(effect_id, {}).get(parameter.name) for table in tables]
                of_parts = [found for each in quantities if (found := _same(each, value, parameter.unit))]
                fits = self.saved is not None and self.saved.origin is not None
                if fits and (parameter.fitted or path in freed) and not parameter.reference:
                    source = self._fitted()
                elif of_parts:
                    source = of_parts[0]
                elif ground := self._ground(f"effects.{path}"):
                    source = ground
                elif value == parameter.default:
                    source = (parameter.source.text, parameter.source.grade)
                else:
                    source = _STATED
                yield Constant(path, value, parameter.unit, parameter.description, *source)

    def _drive(self, values: Mapping[str, float]) -> Iterator[Constant]:
        for name, (unit, description, path) in {**DRIVE_CONSTANTS, **PATH_WORDS}.items():
            if name in values:
                yield Constant(f"drive.{name}", values[name], unit, description, *self._of_drive(name, path))

    def _of_drive(self, name: str, path: str) -> tuple[str, str]:
        if name == "slack_damping":
            return "chosen so that a slack muscle takes its free length within microseconds", "D"
        if name in ("tube_conductance", "tube_ratio", "tube_volume"):
            return "computed from bore and length of the tube", "C"
        if ground := self._ground(path):
            return ground
        section, _, field = path.partition(".")
        if self._states(section, field):
            return _STATED
        figure = _FIGURES.get(path)
        for part in self._parts():
            if isinstance(part, ValvePreset) and figure in part.data:
                quantity = part.data[figure]
                return f"{part.id}: {quantity.source}", quantity.grade
            if isinstance(part, ValvePreset) and section == "regulator" and part.regulator is not None:
                quantity = getattr(part.regulator, field)
                if quantity is not None:
                    return f"{part.id}: {quantity.source}", quantity.grade
        if name == "gravity":
            return "standard gravity 9.80665 m/s^2 times the sine of the inclination", "C"
        return "default of the program, or follows from other entries", "E"

    def _states(self, section: str, field: str) -> bool:
        """Whether the drive document states an entry itself."""
        part = getattr(self.document, section, None)
        return part is not None and getattr(part, field, None) is not None and field in part.model_fields_set

    def _ground(self, path: str) -> tuple[str, str] | None:
        """Source of a path, or of a part that holds it, in a drive preset."""
        while path and self.grounds:
            if path in self.grounds:
                return self.grounds[path].source, self.grounds[path].grade
            path = path.rpartition(".")[0]
        return None

    def _parts(self) -> list[MusclePreset | ValvePreset | TubePreset | FittingPreset]:
        """Presets that the model names."""
        muscle = self._muscle_preset()
        parts: list[Any] = [] if muscle is None else [muscle]
        document = self.document
        if document is not None:
            named = [
                ("valves", document.valve.preset),
                ("tubes", document.tube.preset if document.tube else None),
            ]
            named += [("fittings", name) for name in document.fittings]
            parts += [self.studio.library.get(kind, name) for kind, name in named if name]
        return parts


def _same(quantity: Quantity | None, value: float, unit: str) -> tuple[str, str] | None:
    """Source of a quantity that has this value."""
    if quantity is None or not math.isclose(quantity.si(unit), value, rel_tol=1e-12):
        return None
    return quantity.source, quantity.grade
