"""What an answer says of the error over windows, and the sentences for each pair of errors."""

from __future__ import annotations

from pathlib import Path

import pytest

import mckibben as mk
from mckibben.application.compare.windows import windows_result
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.windows import WindowErrors
from tests.identification.predict.test_moving import HIDDEN, drive, fit_model, measured
from tests.identification.synthetic import MUSCLE

NOISE = 1e-4  # m
LOST = Path(__file__).parents[4] / "shared/data/failing/lost_run_3Hz.csv"


@pytest.mark.parametrize(
    ("run", "windows", "perfect", "said"),
    [
        (1.02 * NOISE, 1.2 * NOISE, 1.2 * NOISE, "Both are noise"),
        (180 * NOISE, 176 * NOISE, 1.6 * NOISE, "one of shape"),
        (180 * NOISE, 12 * NOISE, 1.6 * NOISE, "builds up over more than a window"),
        # A drive that nothing damps: the start of each window rings on.
        (5 * NOISE, 8 * NOISE, 8 * NOISE, "they say nothing"),
    ],
)
def test_the_sentence_reads_both_errors(monkeypatch, run, windows, perfect, said):
    found = WindowErrors(1.0, 60, 6000, windows, run, perfect, NOISE)
    monkeypatch.setattr("mckibben.application.compare.windows.window_errors", lambda *_: found)
    predictor = predictor_of(measured(drive(), keep=("displacement", "pressure")), MUSCLE, drive({}))
    monkeypatch.setattr(type(predictor), "unit", "m")
    result, why = windows_result(predictor, fit_model(HIDDEN), None)
    assert result is not None
    assert not why
    assert said in result.sentence
    assert "60 windows of 1 s" in result.sentence


def test_without_windows_the_reason_is_said():
    predictor = predictor_of(measured(drive(), keep=("displacement",)), MUSCLE, drive({}))
    result, why = windows_result(predictor, fit_model(HIDDEN), None)
    assert result is None
    assert "no pressure was measured" in why


@pytest.mark.skipif(not LOST.exists(), reason="the measured record is not at hand")
def test_few_rows_a_swing_tell_no_noise_and_so_no_perfect_model() -> None:
    """Third differences of 14 rows a second at 3 Hz would make 17 mm of a stroke of 90 mm."""
    model = mk.Model.preset("DMSP-20", length="400 mm")
    found = model.compare(mk.read(LOST, rest_length="400 mm", load="5 kg"))
    assert found.windows is None
    assert any("too few rows a swing" in message for message in found.messages)
