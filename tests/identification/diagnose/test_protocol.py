"""Experiments that a rig can run: set points within its limits, and rows that follow them."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.diagnose.protocol import Protocol, Rig, protocols, rig_of
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from tests.identification.synthetic import CATALOGUE, MUSCLE, cycles

MODEL = FitModel(MUSCLE)
HELD = Rig(pressure=6e5, least=0.0, most=0.2, speed=0.05)
HUNG = Rig(pressure=6e5, least=0.0, most=0.2, speed=0.05, loads=(50.0, 200.0))
AT_LENGTH = protocols(HELD, MODEL, channel="force")
UNDER_LOAD = protocols(HUNG, MODEL, channel="length")


@pytest.mark.parametrize("protocol", [*AT_LENGTH, *UNDER_LOAD], ids=lambda protocol: protocol.words[:30])
def test_set_points_stay_within_the_rig(protocol: Protocol) -> None:
    points, run = protocol.schedule.columns, protocol.schedule.run
    assert 0.0 <= np.min(points["pressure"]) <= np.max(points["pressure"]) <= 6e5
    for number in np.unique(run):
        time = points["time"][run == number]
        assert time[0] == 0.0
        assert np.all(np.diff(time) > 0.0)
        if "length" in points:
            length = points["length"][run == number]
            assert np.all((length >= 0.24 - 1e-12) & (length <= 0.3 + 1e-12))
            speeds = np.abs(np.diff(length) / np.diff(time))
            assert np.all(speeds <= 0.05 * (1.0 + 1e-9))
        else:
            assert set(points["load"]) <= {50.0, 200.0}
    assert protocol.minutes == pytest.approx(
        sum(np.ptp(points["time"][run == n]) + 30.0 for n in np.unique(run)) / 60.0
    )


@pytest.mark.parametrize("protocol", AT_LENGTH, ids=lambda protocol: protocol.words[:30])
def test_rows_follow_the_set_points(protocol: Protocol) -> None:
    assert isinstance(protocol.predictor, QuasistaticPredictor)
    task, points, run = protocol.predictor.task, protocol.schedule.columns, protocol.schedule.run
    assert task.time is not None
    for label in np.unique(task.records):
        rows, corners = task.records == label, run == label
        for channel in ("pressure", "length"):
            wanted = np.interp(task.time[rows], points["time"][corners], points[channel][corners])
            assert task.state[channel][rows] == pytest.approx(wanted)
        # dL/dt as stated is that of the lengths.
        slope = np.gradient(task.state["length"][rows], task.time[rows])
        assert task.state["velocity"][rows] == pytest.approx(slope)


def test_a_load_moves_as_the_model_says() -> None:
    """In equilibrium: the force of the muscle at the predicted length is the load."""
    for protocol in UNDER_LOAD:
        assert isinstance(protocol.predictor, QuasistaticPredictor)
        task = protocol.predictor.task
        length = protocol.predictor.predict(MODEL)
        locked = length > 0.999 * float(MUSCLE.braid.thread_length)
        pressure, load = (task.state[name][~task.turning] for name in ("pressure", "load"))
        force = np.array([_ideal(p, x) for p, x in zip(pressure, length, strict=True)])
        assert force[~locked] == pytest.approx(load[~locked], rel=1e-6)


@pytest.mark.parametrize("effect", ["bouc_wen", "creep", "mullins"])
def test_a_muscle_with_memory_moves_under_a_load_as_well(effect: str) -> None:
    for protocol in protocols(HUNG, MODEL.adding(CATALOGUE[effect]), channel="length"):
        length = protocol.predictor.predict(MODEL.adding(CATALOGUE[effect]))
        assert np.all(np.isfinite(length))
        assert np.ptp(length) > 0.0


def _ideal(pressure: float, length: float) -> float:
    """Chou & Hannaford's equation, written here."""
    braid = MUSCLE.braid
    return float(pressure * (3.0 * length**2 - braid.thread_length**2) / (4.0 * np.pi * braid.turns**2))


def test_a_rig_does_what_its_file_did() -> None:
    predictor = predictor_of(cycles(noise=1.0, each=30, prestress=40.0), MUSCLE)
    assert isinstance(predictor, QuasistaticPredictor)
    rig = rig_of(predictor, MODEL)
    assert rig.pressure == pytest.approx(float(np.max(predictor.inputs["pressure"])))
    assert rig.least < rig.most <= 0.3
    assert rig.loads == ()


def test_without_pressure_there_is_no_experiment() -> None:
    assert protocols(Rig(0.0, 0.0, 0.2, 0.01), MODEL, channel="force") == []
    assert protocols(HELD, MODEL, channel="diameter") == []


def test_set_points_are_not_compared() -> None:
    """Friction turns there: contacts that shear by 1e-5 of the length differ from Coulomb's nowhere else."""
    loops = AT_LENGTH[0].predictor
    assert isinstance(loops, QuasistaticPredictor)
    assert np.count_nonzero(loops.task.turning) == 9 * 3
    sharp, shearing = (
        FitModel(MUSCLE, (CATALOGUE[name],), {name: CATALOGUE[name].defaults | values})
        for name, values in (
            ("coulomb_friction", {"force": 15.0}),
            ("dahl", {"force": 15.0, "break_strain": 1e-5}),
        )
    )
    difference = loops.predict(sharp, clipped=False) - loops.predict(shearing, clipped=False)
    assert np.max(np.abs(difference)) < 0.01 * 15.0


def test_friction_stays_in_a_hold() -> None:
    """After a contraction a rubbing muscle pulls less by its friction, and keeps doing so while it rests."""
    hold = next(p for p in AT_LENGTH if p.words.startswith("holds"))
    chosen = (CATALOGUE["coulomb_friction"],)
    rubbing = FitModel(MUSCLE, chosen, {"coulomb_friction": {**chosen[0].defaults, "force": 15.0}})
    assert isinstance(hold.predictor, QuasistaticPredictor)
    change = hold.predictor.predict(rubbing, clipped=False) - hold.predictor.predict(MODEL, clipped=False)
    time = hold.predictor.task.time
    assert time is not None
    first = hold.predictor.task.records == 0
    resting = first & (time > 10.0) & (time < 60.0)
    assert change[resting[~hold.predictor.task.turning]] == pytest.approx(-15.0)
