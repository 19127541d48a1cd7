"""The way of a muscle that carries a load, against closed forms and an independent integration."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.muscle import Muscle
from mckibben.simulation.drive.isotonic import isotonic_code, isotonic_lengths
from mckibben.simulation.statics.model import StaticModel

CATALOGUE = default_catalogue()
MUSCLE = Muscle(nominal_length=0.3, braid_diameter=0.02, braid_angle=math.radians(25.0))
THREAD = 0.3 / math.cos(math.radians(25.0))
TURNS = THREAD * math.sin(math.radians(25.0)) / (math.pi * 0.02)
WEIGHT = 120.0  # N


def ideal(pressure: float, length: float) -> float:
    """P (3 L^2 - b^2)/(4 pi n^2) [N], Chou & Hannaford (1996)."""
    return pressure * (3.0 * length**2 - THREAD**2) / (4.0 * math.pi * TURNS**2)


def model(**values: Mapping[str, float]) -> StaticModel:
    effects = tuple(CATALOGUE[name] for name in sorted(values))
    return StaticModel.of(MUSCLE, effects, {e.id: {**e.defaults, **values[e.id]} for e in effects})


def carried(
    models: StaticModel | Sequence[StaticModel], time: np.ndarray, pressure: np.ndarray, *,
    records: np.ndarray | None = None, first: float = 0.3, weight: float = WEIGHT,
    begins: Mapping[int, Mapping[str, float]] | None = None,
) -> np.ndarray:  # fmt: skip
    chosen = [models] if isinstance(models, StaticModel) else list(models)
    rows = len(time)
    return isotonic_lengths(
        chosen,
        time=time,
        pressure=pressure,
        load=np.full((len(chosen), rows), weight),
        temperature=np.full(rows, 293.15),
        records=np.zeros(rows, int) if records is None else records,
        first=np.full((len(chosen), rows), first),
        begins=[begins or {}] * len(chosen),
    )


TIME = np.linspace(0.0, 20.0, 201)
CYCLES = 3e5 - 1.5e5 * np.cos(0.6 * TIME) - 0.5e5 * np.cos(2.3 * TIME)  # Pa; loops within a loop


def test_dahl_friction_balances_the_load_with_its_exact_law() -> None:
    way = 0.002 * 0.3
    lengths = carried(model(dahl={"force": 15.0, "break_strain": 0.002}), TIME, CYCLES)[0]
    share = 0.0
    for k, length in enumerate(lengths):
        if k:
            moved = length - lengths[k - 1]
            end = math.copysign(1.0, moved)
            share = end - (end - share) * math.exp(-abs(moved) / way)
        assert ideal(CYCLES[k], length) + 15.0 * share == pytest.approx(WEIGHT, abs=1e-6)
    assert np.ptp(lengths) > 0.02


def test_dry_friction_holds_the_length_until_the_load_exceeds_it() -> None:
    lengths = carried(model(coulomb_friction={"force": 12.0}), TIME, CYCLES)[0]
    before = 0.3
    for pressure, length in zip(CYCLES, lengths, strict=True):
        ends = [
            brentq(lambda x, s=s, p=pressure: ideal(p, x) + 12.0 * s - WEIGHT, 0.19, 0.33, xtol=1e-13)
            for s in (-1.0, 1.0)
        ]
        before = min(max(before, min(ends)), max(ends))
        assert length == pytest.approx(before, abs=2e-8)
    assert np.any(np.diff(lengths) == 0.0)


def test_creep_under_a_load_is_that_of_an_independent_integration() -> None:
    values = {"stiffness": 3000.0, "time": 2.0, "spread": 1.0}
    fine = np.linspace(0.0, 20.0, 2001)
    pressure = 3e5 - 1.5e5 * np.cos(0.6 * fine)

    def rate(time: float, y: np.ndarray) -> list[float]:
        # F(L, P) + k d = W, so that L' (F_L + k) = k d/tau - F_P P'
        length, arm = y
        p = 3e5 - 1.5e5 * math.cos(0.6 * time)
        slope = 6.0 * p * length / (4.0 * math.pi * TURNS**2)
        by_pressure = ideal(1.0, length) * 1.5e5 * 0.6 * math.sin(0.6 * time)
        speed = (3000.0 * arm / 2.0 - by_pressure) / (slope + 3000.0)
        return [speed, speed - arm / 2.0]

    start = brentq(lambda x: ideal(pressure[0], x) - WEIGHT, 0.19, 0.33, xtol=1e-14)
    exact = solve_ivp(rate, (0.0, 20.0), [start, 0.0], t_eval=fine, rtol=1e-10, atol=1e-13).y[0]
    lengths = carried(model(creep=values), fine, pressure)[0]
    assert np.max(np.abs(lengths - exact)) < 2e-6 < 1e-3 * np.ptp(exact)


@pytest.mark.parametrize("name", ["dahl", "bouc_wen", "maxwell_slip"])
def test_a_coarse_record_shows_the_way_of_a_fine_one(name: str) -> None:
    # Ways between turns that are rows of both records: a turn between two rows would be hidden.
    turns, pressures = [0.0, 5.0, 8.0, 12.0, 14.0, 20.0], [1e5, 5e5, 3e5, 4.5e5, 1.5e5, 5.5e5]
    fine, coarse = np.linspace(0.0, 20.0, 4001), np.linspace(0.0, 20.0, 201)
    there = model(**{name: {"force": 15.0, "break_strain": 0.004}})
    whole = carried(there, fine, np.interp(fine, turns, pressures))[0]
    assert carried(there, coarse, np.interp(coarse, turns, pressures))[0] == pytest.approx(
        whole[::20], abs=4e-5
    )


def test_muscles_that_differ_little_give_exact_derivatives() -> None:
    effects = {"bladder_elasticity": {"shear_modulus": 2e5}, "bouc_wen": {"force": 15.0}}
    muscle = MUSCLE._replace(wall_thickness=0.0015)
    effects_of = tuple(CATALOGUE[name] for name in sorted(effects))

    def with_force(force: float) -> StaticModel:
        values = {e.id: {**e.defaults, **effects[e.id]} for e in effects_of}
        values["bouc_wen"]["force"] = force
        return StaticModel.of(muscle, effects_of, values)

    here, beside = carried([with_force(15.0), with_force(15.0015)], TIME, CYCLES)
    below, above = (carried(with_force(force), TIME, CYCLES)[0] for force in (14.99, 15.01))
    by_force = (above - below) / 0.02
    assert (beside - here) / 0.0015 == pytest.approx(by_force, abs=5e-3 * np.max(np.abs(by_force)))


def test_records_begin_afresh_and_states_as_stated() -> None:
    there = model(dahl={"force": 15.0})
    twice, records = np.concatenate([CYCLES, CYCLES]), np.repeat([0, 1], len(TIME))
    both = carried(there, np.concatenate([TIME, TIME]), twice, records=records)[0]
    alone = carried(there, TIME, CYCLES)[0]
    assert both == pytest.approx(np.concatenate([alone, alone]), abs=1e-12)
    held = carried(there, TIME, CYCLES, begins={0: {"dahl.presliding": -1.0}})[0]
    assert ideal(CYCLES[0], held[0]) - 15.0 == pytest.approx(WEIGHT, abs=1e-6)


def test_a_tape_beside_a_compliant_rig_shows_both() -> None:
    stiff = carried(model(dahl={"force": 15.0}), TIME, CYCLES)[0]
    soft = carried(model(dahl={"force": 15.0}, rig_compliance={"compliance": 2e-6}), TIME, CYCLES)[0]
    assert soft - stiff == pytest.approx(2e-6 * WEIGHT, abs=2e-8)


def test_a_load_that_is_too_large_stretches_the_muscle_to_its_lock() -> None:
    lengths = carried(model(dahl={"force": 15.0}), TIME, CYCLES, weight=1e5)[0]
    assert lengths == pytest.approx(0.9999 * THREAD, rel=1e-12)


def test_a_structure_is_compiled_once() -> None:
    effects = (CATALOGUE["dahl"],)
    assert isotonic_code(effects) is isotonic_code(effects)
    assert isotonic_code(effects).states == ("dahl.presliding",)
