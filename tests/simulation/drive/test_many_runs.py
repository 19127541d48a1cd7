"""Readings of drives side by side are those of each drive alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mckibben.documents.drive_reading import drive_of, preset_document
from mckibben.simulation.drive.many_runs import READINGS, readings_of_many
from mckibben.simulation.drive.transient import segments_of, simulate
from tests.shipped import shipped_studio

STUDIO = shipped_studio()
DRIVE = drive_of(preset_document("paper-step", STUDIO), STUDIO).drive
GRID = np.linspace(0.0, DRIVE.duration, 301)


def with_mass(factor: float):
    return replace(DRIVE, load=replace(DRIVE.load, mass=factor * DRIVE.load.mass))


def side_by_side(drives, **how):
    return readings_of_many(drives, [segments_of(drive)[:2] for drive in drives], grid=GRID, **how)


def test_each_has_the_readings_that_it_has_alone():
    drives = [with_mass(1.0 + 0.1 * number) for number in range(11)]
    for drive, found in zip(drives, side_by_side(drives), strict=True):
        alone = simulate(drive, grid=GRID).outputs
        for name in READINGS:
            assert found[name] == pytest.approx(alone[name], rel=1e-12)


def test_together_the_first_is_as_alone_and_the_others_differ_smoothly():
    alone = side_by_side([DRIVE])[0]
    first, one, two = side_by_side([DRIVE, with_mass(1.0001), with_mass(1.0002)], together=True)
    for name in READINGS:
        assert first[name] == pytest.approx(alone[name], rel=1e-7, abs=1e-7 * np.max(np.abs(alone[name])))
    near, far = (each["stroke_reading"] - first["stroke_reading"] for each in (one, two))
    assert np.linalg.norm(far - 2.0 * near) < 1e-3 * np.linalg.norm(far)


def test_a_drive_without_a_start_has_no_readings():
    torn = replace(DRIVE, start_position=9.0)
    assert not side_by_side([torn, DRIVE])[0].readings
    assert not any(run.readings for run in side_by_side([torn, DRIVE], together=True))
    ran, none = side_by_side([DRIVE, torn])
    assert not none.readings
    assert "9000 mm" in none.stop
    assert not ran.stop


def test_a_run_that_takes_too_many_steps_has_the_rows_before_and_states_its_limit():
    (whole,) = side_by_side([DRIVE])
    (part,) = side_by_side([DRIVE], max_steps=200)
    assert part.steps == 200 < whole.steps
    assert "more than 200 steps" in part.stop
    for name in READINGS:
        assert 0 < len(part[name]) < len(whole[name])
        assert np.array_equal(part[name], whole[name][: len(part[name])])
