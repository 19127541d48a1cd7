"""Starts of many sets at once against the start of each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mckibben.documents.drive_reading import drive_of, preset_document, read_document
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.initial_state import Rest, start_of
from mckibben.simulation.drive.initial_states import starts_of_many
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import parameters_of, segments_of
from mckibben.simulation.integrate.engine import compiled_drive
from tests.benchmarks.lift import WITH_SPOOL
from tests.shipped import shipped_studio

STUDIO = shipped_studio()
SETS = 21


def preset(name: str) -> Drive:
    return drive_of(preset_document(name, STUDIO), STUDIO).drive


HEAVY = replace(preset("paper-step"), min_contraction=-1.0)
DRIVES = {
    "ends and between": preset("paper-hysteresis"),
    "vented": preset("propneu-20"),
    "with a spool": drive_of(read_document(WITH_SPOOL, "the lift"), STUDIO).drive,
    "pair": replace(
        preset("paper-hysteresis"), pair=True, precontraction=0.08, max_contraction=0.16, start_pressure=2e5
    ),
    "from above": replace(preset("paper-hysteresis"), start_pressure=2e5, start_reached=-1),
    "stated": replace(preset("paper-step"), start_position=0.01),
    "beyond its lock": replace(HEAVY, load=replace(HEAVY.load, mass=500.0)),
}


def start_or_error(drive, compiled, parameters, inputs):
    try:
        with np.errstate(all="ignore"):
            return start_of(drive, compiled, parameters, inputs)
    except InputError as error:
        return error


@pytest.mark.parametrize("name", DRIVES)
def test_each_start_is_that_of_its_set(name):
    drive = DRIVES[name]
    compiled = compiled_drive(drive.structure, 1)
    names, random = list(compiled.model.parameters), np.random.default_rng(2)
    parameters = np.tile(parameters_of(drive, compiled), (SETS, 1))
    for free in ("mass", "supply_pressure", "spring"):
        parameters[:, names.index(free)] *= random.uniform(0.3, 3.0, SETS)
    shift = random.uniform(-0.03, 0.03, SETS) * drive.muscle.nominal_length
    parameters[:, names.index("precontraction")] += shift
    inputs = np.tile(segments_of(drive)[1][0], (SETS, 1))
    inputs[:, list(compiled.model.inputs).index("external_force")] += random.uniform(-50.0, 50.0, SETS)
    found = starts_of_many(drive, compiled, parameters, inputs)
    scales = np.array([state.scale for state in compiled.model.states])
    for index in range(SETS):
        alone = start_or_error(drive, compiled, parameters[index], inputs[index])
        if isinstance(alone, InputError):
            assert str(found.errors[index]) == str(alone)
            assert np.isnan(found.states[index]).all()
            continue
        assert found.errors[index] is None
        assert found.why[index] is alone.why
        assert found.strokes[index] == pytest.approx(alone.stroke, abs=1e-9)
        assert np.array_equal(found.switches[index], alone.switches)
        assert np.max(np.abs(found.states[index] - alone.state) / scales) < 1e-9
    if name == "beyond its lock":
        assert any(error is not None for error in found.errors)
    if name == "ends and between":
        assert {Rest.LOW_STOP, Rest.HIGH_STOP, Rest.BALANCED} <= set(found.why)


def test_a_position_that_cannot_be_is_the_error_of_its_set():
    drive = DRIVES["stated"]
    compiled = compiled_drive(drive.structure, 1)
    drives = [drive, replace(drive, start_position=9.0), drive]
    parameters = np.tile(parameters_of(drive, compiled), (3, 1))
    found = starts_of_many(drives, compiled, parameters, segments_of(drive)[1][0])
    assert [error is None for error in found.errors] == [True, False, True]
    assert "between the end stops" in str(found.errors[1])
