"""``--free start``: the start of a run is fitted, said with its error, and refused where there is none."""

from __future__ import annotations

import pytest

import mckibben as mk
from tests.cli.conftest import Run, result_of, write
from tests.identification.predict.test_free_starts import NOISE, swinging
from tests.identification.synthetic import BRAID, text

HEADER = "time [s],pressure [bar],stroke [mm]"


@pytest.fixture
def file() -> str:
    """A record that begins in the middle of a swing that hardly damps."""
    columns = swinging()[0].columns
    rows = [
        f"{time:.3f},{pressure / 1e5:g},{1e3 * stroke:.4f}"
        for time, pressure, stroke in zip(
            columns["time"], columns["pressure"], columns["displacement"], strict=True
        )
    ]
    write("m.json", BRAID)
    return write("swing.csv", text(rows, HEADER, "load_mass: 12 kg"))


def test_a_comparison_fits_and_says_the_start(run: Run, file: str) -> None:
    options = ("--muscle", "m.json", "--effect", "viscous_damping", "--fit", "--free", "start")
    code, out, err = run("compare", file, *options, "--json")
    assert code == 0, err
    answer = result_of(out)
    assert answer["rmse"] == pytest.approx(NOISE, rel=0.1)
    speed = answer["parameters"]["geometry"]["start_speed"]
    assert speed["value"] == pytest.approx(swinging()[2], abs=4.0 * speed["stderr"])
    (said,) = (each for each in answer["messages"] if each.startswith("start of the run, fitted:"))
    assert f"{1e3 * speed['value']:.3g}".replace("-", "−") in said
    model = mk.Model(**BRAID).with_effect("viscous_damping")
    mine = model.compare(mk.read(file), fit=True, free="start")
    assert mine.rmse == pytest.approx(answer["rmse"], rel=1e-9)


def test_a_diagnosis_begins_with_the_error_of_a_comparison_without_a_fit(file: str) -> None:
    model = mk.Model(**BRAID).with_effect("viscous_damping", coefficient=5.0)
    shown = model.compare(mk.read(file), free="start")
    resting = model.compare(mk.read(file))
    assert shown.rmse == pytest.approx(NOISE, rel=0.1)
    assert resting.rmse > 20.0 * NOISE
    assert any(each.startswith("start of the run, fitted:") for each in shown.messages)
    found = model.diagnose(mk.read(file), free="start")
    assert found.baseline.rmse == pytest.approx(shown.rmse, rel=1e-3)


def test_a_file_without_a_run_has_no_start(run: Run, file: str) -> None:
    del file
    map_ = write(
        "map.csv",
        text(["3,280,500", "3,290,600", "4,280,700", "4,290,800"], "pressure [bar],length [mm],force [N]"),
    )
    code, out, err = run("compare", map_, "--muscle", "m.json", "--fit", "--free", "start")
    assert (code, out) == (2, "")
    assert len(err.strip().splitlines()) == 1
    assert err.startswith("mckibben: --free start: a start can be fitted to records of a stroke over time")
