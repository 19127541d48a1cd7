"""An effect that names transients changes what a recorder shows of a moving drive."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from mckibben.application.effect.states import MUSCLE, WARM, companions
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.effect import Effect
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.parts import Drive, Load, Tube, Valve
from mckibben.simulation.drive.transient import simulate
from mckibben.simulation.statics.model import StaticModel

CATALOGUE = default_catalogue()
# Between a pressure sensor and the muscle it shows where the pressure was measured, not where a valve fills.
SHOWN = [
    effect
    for effect in CATALOGUE.values()
    if "transient" in effect.kinds and not effect.between_sensor_and_muscle
]
READINGS = {"force_reading": 100.0, "pressure_reading": 1e5, "stroke_reading": 0.01}


@cache
def record(effects: tuple[str, ...]) -> dict[str, np.ndarray]:
    """Readings over one and a half cycles of a proportional valve, from stretched to nearly contracted."""
    command = {"shape": "sine", "frequency": "0.8 Hz", "amplitude": 0.7}
    drive = Drive(
        model=StaticModel(MUSCLE, {effect: {} for effect in effects}),
        valve=Valve(1.5e-8, 1.5e-8),
        load=Load(mass=8.0),
        command=signal_from(command, unit="1", field="command"),
        duration=1.8,
        supply_pressure=7e5,
        tube=Tube(0.004, 1.0),
        min_contraction=-0.05,
        max_contraction=0.3,
        temperature=WARM,
        wall_heat_transfer=0.0,  # heat exchange is an effect here
    )
    run = simulate(drive, points=361, tolerance=1e-7)
    assert len(run.time) == 361, run.outcome
    assert all(np.isfinite(values).all() for values in run.states.values())
    return {name: run.outputs[name] / scale for name, scale in READINGS.items()}


def change(one: dict[str, np.ndarray], other: dict[str, np.ndarray]) -> float:
    return max(np.abs(one[name] - other[name]).max() for name in READINGS)


@pytest.mark.parametrize("effect", SHOWN, ids=[effect.id for effect in SHOWN])
def test_readings_change(effect: Effect) -> None:
    others = tuple(other.id for other in companions(effect))
    assert change(record(others), record((*others, effect.id))) > 1e-3


def test_effect_that_does_not_act_on_a_run_leaves_it_alone() -> None:
    for effect in CATALOGUE.values():
        if effect not in SHOWN:
            assert change(record(()), record((effect.id,))) < 1e-4
