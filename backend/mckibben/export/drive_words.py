"""Unit and meaning of every state, input, output and switch of a drive."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from mckibben.physics.drive_terms import COUNTER, HIGH_STOP, LOW_STOP, SLACK, SLIDES_DOWN, SLIDES_UP
from mckibben.physics.effect import Effect


class Words(NamedTuple):
    """SI unit ("1" for none) and meaning of a quantity."""

    unit: str
    meaning: str

    @property
    def shown(self) -> str:
        """Unit and meaning in one line."""
        return self.meaning if self.unit == "1" else f"{self.unit}: {self.meaning}"


_STATES: Mapping[str, Words] = {
    "stroke": Words("m", "Stroke of the muscle, positive = shorter; of a pair from the middle."),
    "speed": Words("m/s", "Its rate."),
    "length": Words("m", "Length of the muscle; of a slack one not the distance of its fittings."),
    "pressure": Words("Pa", "Absolute pressure in the muscle."),
    "tube_pressure": Words("Pa", "Absolute pressure in the tube."),
    "regulator_pressure": Words("Pa", "Set point of the regulator after its lag, absolute."),
    "regulator_rate": Words("Pa/s", "Rate of the set point of the regulator."),
    "gas_mass": Words("kg", "Mass of the gas in the muscle."),
    "supplied": Words("kg", "Mass of the air drawn from the supply so far."),
    "vented": Words("kg", "Mass of the air vented and leaked so far."),
}
_INPUTS: Mapping[str, Words] = {
    "opening": Words(
        "1", "Valve: 1 fill, 0 closed, -1 vent; regulator: share of its range; after all dead times."
    ),
    "counter_opening": Words("1", "The same of the second muscle of the pair."),
    "external_force": Words("N", "Force on the load against the pull."),
    "supply_pressure": Words("Pa", "Absolute pressure of the supply."),
}
_OUTPUTS: Mapping[str, Words] = {
    "acceleration": Words("m/s^2", "Of the stroke."),
    "force": Words("N", "Tension of the muscle; 0 when slack."),
    "mass_flow": Words("kg/s", "Into the muscle, less leakage."),
    "supply_flow": Words("kg/s", "From the supply."),
    "exhaust_flow": Words("kg/s", "To the surroundings."),
    "opening": Words("1", "Opening of the valve after all effects."),
    "fill_pressure_ratio": Words("1", "Downstream over upstream pressure of filling."),
    "exhaust_pressure_ratio": Words("1", "Downstream over upstream pressure of venting."),
    "gas_temperature": Words("K", "Of the gas in the muscle."),
    "volume": Words("m^3", "Of the gas, with dead volumes."),
    "diameter": Words("m", "Of the braid at mid-span."),
    "contact": Words("1", "1 on the upper end stop, -1 on the lower one, 0 between."),
    "net_force": Words("N", "Along the stroke, without that of the stops."),
    "friction": Words("N", "Of the dry friction on the load, positive upwards; sticking what balances it."),
    "friction_share": Words("1", "Share of its range that the dry friction takes; 1 sliding."),
    "friction_left_up": Words(
        "N", "Force upwards that the friction of a sticking load still takes; 0 sliding."
    ),
    "friction_left_down": Words("N", "The same downwards."),
    "external_force": Words("N", "Force on the load against the pull."),
    "pressure_reading": Words("Pa", "Gauge pressure as its sensor reads it."),
    "force_reading": Words("N", "Force as its sensor reads it."),
    "stroke_reading": Words("m", "Stroke as its sensor reads it."),
}
_SWITCHES: Mapping[str, Words] = {
    LOW_STOP: Words("1", "1 while the lower end stop holds the load."),
    HIGH_STOP: Words("1", "1 while the upper end stop holds the load."),
    SLACK: Words("1", "1 while the muscle hangs slack."),
    SLIDES_UP: Words("1", "1 while the load slides up; in neither direction its dry friction holds it."),
    SLIDES_DOWN: Words("1", "1 while the load slides down."),
}
_TABLES = {"state": _STATES, "input": _INPUTS, "output": _OUTPUTS, "switch": _SWITCHES}


def words_for(kind: str, names: Iterable[str], effects: Iterable[Effect]) -> dict[str, Words]:
    """Unit and meaning of quantities by name.

    Args:
        kind: "state", "input", "output" or "switch".
        names: those of the equations; of the second muscle of a pair with its suffix.
        effects: for "effect.state".
    """
    own = {
        f"{effect.id}.{state.name}": Words(state.unit, state.description)
        for effect in effects
        for state in effect.states
    }
    table = {**own, **_TABLES[kind]}
    found = {}
    for name in names:
        words = table[name.removesuffix(COUNTER)]
        second = " (second muscle of the pair)" if name.endswith(COUNTER) else ""
        found[name] = words._replace(meaning=f"{words.meaning}{second}")
    return found
