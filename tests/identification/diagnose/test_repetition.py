"""What repeats over length, pressure or time is found with its period, and noise of any kind is not."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.diagnose.atlas import rig_of, stand_ins
from mckibben.identification.diagnose.judgement import left_repetition
from mckibben.identification.diagnose.repetition import Repetition, _chance, repetition
from mckibben.identification.diagnose.repetition_words import repetition_text
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.physics.effect import Effect
from tests.identification.synthetic import CATALOGUE, MUSCLE

#: Sweeps of a test, rows in each.
LAYOUTS = {"three files": (12, 240), "short": (4, 30), "there and back": (2, 40), "one": (1, 100)}


class Pulls:
    """Pulls at one speed there and back between 260 and 200 mm, four at each pressure, in steps of 0.1 s."""

    def __init__(self, sweeps: int, rows: int) -> None:
        way = np.linspace(0.26, 0.20, rows)
        number = np.repeat(np.arange(sweeps), rows)
        self.size = sweeps * rows
        self.time = 0.1 * np.arange(self.size)
        self.length = np.concatenate([way if each % 2 == 0 else way[::-1] for each in range(sweeps)])
        self.records = number // 4
        self.pressure = 2e5 * (1.0 + self.records)
        self.sweeps = list(np.arange(self.size).reshape(sweeps, rows))
        self.place = (self.length - 0.20) / 0.06

    def found(self, residual: np.ndarray) -> Repetition | None:
        inputs = {"length": self.length, "pressure": self.pressure, "time": self.time}
        return repetition(residual, inputs, sweeps=self.sweeps, records=self.records)


def noise(count: int, seed: int, memory: float = 0.0) -> np.ndarray:
    """White noise, or an autoregressive process of unit drive."""
    drawn = np.random.default_rng(seed).standard_normal(count + 200)
    for row in range(1, len(drawn)):
        drawn[row] += memory * drawn[row - 1]
    return drawn[200:]


def left_by(effect: Effect) -> Iterator[tuple[str, np.ndarray, Predictor]]:
    """What the model without an effect leaves in the tests of the atlas that are not simulated."""
    base = FitModel(MUSCLE)
    for name in stand_ins(effect, CATALOGUE, {}):
        base = base.adding(CATALOGUE[name])
    both = base.adding(effect)
    bare = replace(base, muscle=both.muscle, assumed=both.assumed)
    for kind in effect.kinds - {"transient"}:
        predictor = rig_of(kind, bare, 6e5).after(("rest",))
        if not predictor.why_hidden(effect):
            left = predictor.predict(both, clipped=False) - predictor.predict(bare, clipped=False)
            yield kind, np.where(np.isfinite(left), left, 0.0), predictor


FILES = Pulls(*LAYOUTS["three files"])


def test_a_pitch_is_found_in_all_records_and_grows_with_the_pressure() -> None:
    wave = 3.0 * np.sin(2.0 * np.pi * FILES.length / 4.3e-3 + 0.7) * FILES.pressure / 4e5
    found = FILES.found(wave + noise(FILES.size, 0))
    assert found is not None
    assert (found.over, found.grows, found.parts, found.shown) == ("length", True, 3, 3)
    assert not found.of_sweeps
    assert found.period == pytest.approx(4.3e-3, rel=5e-3)
    assert found.amplitude == pytest.approx(3.0, rel=0.05)
    assert found.share == pytest.approx(np.mean(wave**2) / (np.mean(wave**2) + 1.0), abs=0.03)
    assert found.left_out > 0.9 * found.share
    assert found.also == ()  # one speed there and back: time has another phase on the way back


def test_a_thread_is_the_same_throughout_and_a_frame_rings_after_each_turn() -> None:
    thread = 3.0 * np.sin(2.0 * np.pi * FILES.length / 4e-3 + 0.7)
    way = np.where(np.arange(FILES.size) // 240 % 2 == 0, 0.26 - FILES.length, FILES.length - 0.20)
    ringing = 9.0 * np.exp(-way / 0.015) * np.cos(2.0 * np.pi * way / 4e-3)
    for wave, fades, said in (
        (thread, False, "a thread, rack"),
        (ringing, True, "what rings after each turn"),
    ):
        found = FILES.found(wave + noise(FILES.size, 5))
        assert found is not None
        assert (found.over, found.fades) == ("length", fades)
        assert f"): {said}" in repetition_text(found, "N", 1.0)


def test_one_pull_in_one_direction_does_not_tell_a_thread_from_ringing() -> None:
    pull = Pulls(*LAYOUTS["one"])
    found = pull.found(3.0 * np.sin(2.0 * np.pi * pull.length / 4.3e-3) + noise(pull.size, 6))
    assert found is not None
    assert found.fades is None


def test_a_wave_of_one_size_does_not_grow() -> None:
    found = FILES.found(2.0 * np.sin(2.0 * np.pi * FILES.length / 6e-3) + noise(FILES.size, 1))
    assert found is not None
    assert not found.grows


def test_a_saw_tooth_repeats_with_its_teeth() -> None:
    found = FILES.found(10.0 * (FILES.length / 5.1e-3 % 1.0) + noise(FILES.size, 2))
    assert found is not None
    assert found.period == pytest.approx(5.1e-3, rel=1e-2)


def test_hum_repeats_in_time_with_a_phase_of_its_own_in_each_record() -> None:
    phase = np.array([0.3, 2.0, 4.1])[FILES.records]
    found = FILES.found(3.0 * np.sin(2.0 * np.pi * 1.3 * FILES.time + phase) + noise(FILES.size, 3))
    assert found is not None
    assert (found.over, found.of_sweeps, found.parts) == ("time", True, 12)
    assert 1.0 / found.period == pytest.approx(1.3, rel=2e-3)


def test_steps_of_a_regulator_repeat_over_the_pressure() -> None:
    pressure = np.tile(np.concatenate([np.linspace(1e5, 6e5, 150), np.linspace(6e5, 1e5, 150)]), 4)
    sweeps = list(np.arange(1200).reshape(8, 150))
    wave = 3.0 * np.sin(2.0 * np.pi * pressure / 0.4e5)
    inputs = {"pressure": pressure, "time": 0.1 * np.arange(1200)}
    found = repetition(wave + noise(1200, 4), inputs, sweeps=sweeps, records=np.zeros(1200, int))
    assert found is not None
    assert (found.over, found.parts, found.of_sweeps) == ("pressure", 8, True)
    assert found.period == pytest.approx(0.4e5, rel=1e-2)


def test_one_pull_at_one_speed_does_not_tell_length_from_time() -> None:
    one = Pulls(*LAYOUTS["one"])
    found = one.found(2.0 * np.sin(2.0 * np.pi * one.length / 6e-3) + noise(one.size, 5))
    assert found is not None
    periods = dict([(found.over, found.period), *found.also])
    speed = 0.06 / 99 / 0.1
    assert periods["length"] == pytest.approx(6e-3, rel=2e-2)
    assert periods["time"] == pytest.approx(6e-3 / speed, rel=2e-2)


@pytest.mark.parametrize("memory", [0.0, 0.5, 0.9, 0.97, 0.99])
@pytest.mark.parametrize("layout", LAYOUTS)
def test_noise_does_not_repeat(layout: str, memory: float) -> None:
    pulls = Pulls(*LAYOUTS[layout])
    for seed in range(10):
        assert pulls.found(noise(pulls.size, seed, memory)) is None


SHAPES = {
    "wall": lambda u: 30.0 * np.exp(-u / 0.03),
    "step": lambda u: 10.0 * (u > 0.5),
    "kink": lambda u: 200.0 * np.maximum(u - 0.7, 0.0),
    "bump": lambda u: 20.0 * np.exp(-(((u - 0.5) / 0.06) ** 2)),
    "bump and dip": lambda u: (
        20.0 * (np.exp(-(((u - 0.3) / 0.06) ** 2)) - np.exp(-(((u - 0.6) / 0.06) ** 2)))
    ),
    "seventh degree": lambda u: 20.0 * np.polynomial.chebyshev.chebval(2.0 * u - 1.0, [0.0] * 7 + [1.0]),
}  # fmt: skip


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_smooth_course_and_a_single_bump_do_not_repeat(layout: str, shape: str) -> None:
    pulls = Pulls(*LAYOUTS[layout])
    assert pulls.found(SHAPES[shape](pulls.place) + noise(pulls.size, 6)) is None


def test_friction_after_reversals_does_not_repeat() -> None:
    since = np.tile(np.arange(240.0), 12)
    way = np.where(np.repeat(np.arange(12), 240) % 2 == 0, 1.0, -1.0)
    assert FILES.found(20.0 * way * np.exp(-since / 8.0) + noise(FILES.size, 7)) is None


@pytest.mark.parametrize(
    ("left", "hums"),
    [
        (lambda swing, rate: 20.0 * np.sign(rate), False),
        (lambda swing, rate: 20.0 * swing**3, False),
        (lambda swing, rate: 20.0 * np.polynomial.chebyshev.chebval(swing, [0.0] * 7 + [1.0]), False),
        (lambda swing, rate: 3.0 * np.sin(2.0 * np.pi * 12.5 * 0.01 * np.arange(3000)), True),
    ],
)
def test_multiples_of_what_drives_the_test_are_no_hum(left, hums: bool) -> None:
    time = 0.01 * np.arange(3000)
    swing, rate = np.sin(2.0 * np.pi * 0.5 * time), np.cos(2.0 * np.pi * 0.5 * time)
    sweeps = np.split(np.arange(3000), np.flatnonzero(np.diff(np.sign(rate)) != 0.0) + 1)
    inputs = {"pressure": 3e5 + 1.5e5 * swing, "time": time}
    residual = left(swing, rate) + noise(3000, 8)
    found = repetition(residual, inputs, sweeps=sweeps, records=np.zeros(3000, int))
    assert (found is not None and found.over == "time") == hums
    assert hums or found is None


def test_what_one_of_three_files_shows_does_not_repeat() -> None:
    wave = 6.0 * np.sin(2.0 * np.pi * FILES.length / 4.3e-3) * (FILES.records == 1)
    assert FILES.found(wave + noise(FILES.size, 9)) is None


def test_a_small_part_of_the_rest_few_rows_and_two_periods_are_no_claim() -> None:
    wave = np.sin(2.0 * np.pi * FILES.length / 4.3e-3)
    assert FILES.found(0.5 * wave + noise(FILES.size, 10)) is None  # 11 % of the rest
    assert FILES.found(5.0 * np.sin(2.0 * np.pi * FILES.length / 30e-3) + noise(FILES.size, 11)) is None
    few = Pulls(1, 58)
    assert few.found(5.0 * np.sin(2.0 * np.pi * few.length / 10e-3) + noise(58, 12)) is None
    assert FILES.found(np.zeros(FILES.size)) is None
    assert FILES.found(0.3 * FILES.place) is None  # nothing but what a polynomial follows


def test_the_chance_is_that_of_the_beta_distribution() -> None:
    from scipy.stats import beta

    for pairs, rows, share in ((1, 40.0, 0.5), (3, 60.0, 0.4), (1, 200.0, 0.1)):
        expected = beta.sf(share, pairs, 0.5 * rows - pairs)
        assert _chance(share, rows, pairs) == pytest.approx(expected, rel=1e-9)
    assert _chance(0.9, 2.0, 1) == 1.0


def test_the_rows_of_a_map_are_no_records() -> None:
    """Eight pressures at 60 places, in no order of time: each row is a record, each curve a sweep."""
    place = np.tile(np.linspace(0.26, 0.20, 60), 8)
    residual = 3.0 * np.sin(2.0 * np.pi * place / 6e-3) + noise(480, 13)
    inputs = {"length": place, "pressure": np.repeat(1e5 * np.arange(1.0, 9.0), 60)}
    curves = list(np.arange(480).reshape(8, 60))
    found = repetition(residual, inputs, sweeps=curves, records=np.arange(480))
    assert found is not None
    assert (found.over, found.parts, found.shown, found.of_sweeps) == ("length", 8, 8, True)


@pytest.mark.parametrize("effect", CATALOGUE.values(), ids=list(CATALOGUE))
def test_what_a_missing_effect_of_the_catalogue_leaves_does_not_repeat(effect: Effect) -> None:
    for kind, residual, predictor in left_by(effect):
        for level in (0.0, 0.1):
            size = level * float(np.sqrt(np.mean(residual**2)))
            assert left_repetition(predictor, residual + size * noise(len(residual), 14)) is None, kind


LENGTH = Repetition("length", 3.2e-3, 0.62, 10.7, True, 0.5, 3, 3)


@pytest.mark.parametrize(
    ("found", "said"),
    [
        (
            LENGTH,
            "it repeats every 3.20 mm of length (the same in all 3 records): a thread, rack or weave with "
            "that pitch, or what rings after each turn of the motion; "
            "this is 62 % of it, with an amplitude of 10.7 N that grows with the pressure",
        ),
        (
            replace(LENGTH, shown=2, grows=False, also=(("time", 0.5),)),
            "it repeats every 3.20 mm of length (the same in 2 of 3 records): a thread, rack or weave with "
            "that pitch, or what rings after each turn of the motion; "
            "this is 62 % of it, with an amplitude of 10.7 N; these data cannot tell it from one "
            "2.00 times a second: repeat the run at another speed",
        ),
        (
            Repetition("time", 0.08, 0.5, 2.0, False, 0.5, 12, 12, of_sweeps=True),
            "it repeats 12.5 times a second (seen in all 12 sweeps): hum of the mains, also as the sampling "
            "folds it, a pump or a vibration; this is 50 % of it, with an amplitude of 2.00 N",
        ),
        (
            Repetition("time", 4.0, 0.5, 2.0, False, 0.5, 1, 1, of_sweeps=True),
            "it repeats every 4.00 s (in both halves of the sweep): a pump, a compressor or a regulator that "
            "hunts; this is 50 % of it, with an amplitude of 2.00 N",
        ),
        (
            Repetition("pressure", 2e4, 0.5, 2.0, False, 0.5, 8, 8, of_sweeps=True),
            "it repeats every 0.200 bar of pressure (the same in all 8 sweeps): steps of that size in the "
            "regulator, the sensor or its converter; this is 50 % of it, with an amplitude of 2.00 N",
        ),
    ],
)  # fmt: skip
def test_what_is_said_of_it(found: Repetition, said: str) -> None:
    assert repetition_text(found, "N", 1.0) == said
