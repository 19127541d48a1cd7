"""What a preset is called, drive or curve fit, held against volumes and strokes by hand."""

from __future__ import annotations

import numpy as np
import pytest

import mckibben as mk

SIZES = {20: 0.2, 10: 0.2}  # bore [mm] -> stroke to the stop [m]


@pytest.mark.parametrize("size", SIZES)
def test_a_physical_drive_takes_the_air_of_its_muscle_and_a_curve_fit_does_not(size: int) -> None:
    """The braid holds V = L (b² - L²)/(4 pi n²): a fill takes its air at 6 bar, less what is in it before."""
    for name, physical in ((f"propneu-{size}-physical", True), (f"propneu-{size}", False)):
        found = mk.Drive.preset(name).run()
        thread, turns = found.geometry.thread_length, found.geometry.turns
        volume = found.length * (thread**2 - found.length**2) / (4.0 * np.pi * turns**2)
        bar = found.pressure.max() / 1e5
        needed = float(volume.max() * (bar + 1.013) - volume[0] * 1.013)  # at 1 bar, as ANR is
        taken = found.timing.extend.supplied_volume_anr
        assert (0.5 < taken / needed < 2.0) is physical
        said = [each.message for each in found.flags if each.code == "curve_fit"]
        assert bool(said) is not physical


@pytest.mark.parametrize("size", SIZES)
def test_a_physical_drive_rests_on_its_stop_until_the_vent(size: int) -> None:
    found = mk.Drive.preset(f"propneu-{size}-physical").run()
    vent = float(found.time[np.argmax(found.command < 1.0)])
    held = (found.time > vent - 1.0) & (found.time < vent)
    assert found.position[held] == pytest.approx(SIZES[size], abs=1e-6)
    assert found.verdict.state == "arrived_and_held"
