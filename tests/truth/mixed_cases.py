"""Two and three hidden effects at once."""

from __future__ import annotations

import numpy as np

from tests.truth import drive_cases as drives
from tests.truth import elastomer, friction, geometry, sensors
from tests.truth.cases import BOOK, Case
from tests.truth.commands import PARTIAL, PULSES, RESTS
from tests.truth.composition import Hidden, Truth
from tests.truth.elastic_cases import BAR, FIVE, FOUR, SIX_LENGTHS, size
from tests.truth.experiments import isobaric, isometric, scattered
from tests.truth.laboratory import case_of, usual_noise
from tests.truth.muscle import Muscle, made
from tests.truth.rig import Test, setup, transient_case


def _wall(m: Muscle) -> Hidden:
    # Rubber of about the same share of the muscle's force in every size.
    c = 0.2e6 * m.blocked / 1572.0 * 0.0218 / m.diameter
    return elastomer.bladder(m, elastomer.yeoh(c, -0.03 * c, 0.01 * c))


def _rub(m: Muscle, share: float = 0.014) -> Hidden:
    return friction.bristles(share * m.blocked, 6e-5, "coulomb_friction", "dahl", "bouc_wen")


def _crossings(m: Muscle) -> Hidden:
    level = 0.025 * m.blocked / (6e5 * 4.0 / 3.0 * m.nominal / m.turns)
    return friction.crossings(m, level, 8e-5, "pressure_friction", "contact_friction")


@BOOK.recipe("pair-bladder-coulomb-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    truth = Truth(m, hidden=(_wall(m), _rub(m)))
    noise = usual_noise(truth, rng, force=0.002)
    record = isobaric(truth, levels=FIVE, speeds=(0.003, 0.02))
    return case_of("pair-bladder-coulomb-isobaric", seed, truth, record, "isobaric", rng, noise=noise)


@BOOK.recipe("pair-bladder-prestress-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    wall = elastomer.mapped_bladder(m, m.blocked / 1572.0)
    truth = Truth(m, hidden=(wall, elastomer.tight_wall(m, 0.05 * m.blocked)))
    noise = usual_noise(truth, rng, force=0.003)
    record = isometric(truth, contractions=SIX_LENGTHS)
    return case_of("pair-bladder-prestress-isometric", seed, truth, record, "isometric", rng, noise=noise)


@BOOK.recipe("pair-bladder-crossings-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    truth = Truth(m, hidden=(_wall(m), _crossings(m)))
    noise = usual_noise(truth, rng, force=0.002)
    return case_of(
        "pair-bladder-crossings-isobaric",
        seed,
        truth,
        isobaric(truth, levels=FIVE),
        "isobaric",
        rng,
        noise=noise,
    )


@BOOK.recipe("pair-bladder-ends-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    ends = geometry.faster_middle(m, 1.1, 0.04, 2e5, "contraction_factor", "end_caps")
    truth = Truth(m, hidden=(_wall(m), ends))
    noise = usual_noise(truth, rng, force=0.002)
    record = isobaric(truth, levels=tuple(BAR * p for p in (1.5, 2.5, 3.5, 4.5, 5.3, 6.0)))
    return case_of("pair-bladder-ends-isobaric", seed, truth, record, "isobaric", rng, noise=noise)


@BOOK.recipe("pair-play-prestress-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    play = friction.pressure_play(0.011 * m.blocked, 6e4, "pressure_hysteresis")
    truth = Truth(m, hidden=(elastomer.tight_wall(m, 0.03 * m.blocked), play))
    noise = usual_noise(truth, rng, force=0.001)
    record = isometric(truth, contractions=SIX_LENGTHS, rows=140)
    return case_of("pair-play-prestress-isometric", seed, truth, record, "isometric", rng, noise=noise)


@BOOK.recipe("pair-viscous-coulomb-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    drag = friction.power_viscous(0.03 * m.blocked / 0.1**0.94, 0.94, 0.0, 0.9)
    truth = Truth(m, hidden=(drag, _rub(m)))
    noise = usual_noise(truth, rng, force=0.001)
    record = isobaric(truth, levels=FOUR, speeds=(0.002, 0.02, 0.1))
    return case_of("pair-viscous-coulomb-isobaric", seed, truth, record, "isobaric", rng, noise=noise)


@BOOK.recipe("pair-threads-threshold-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    compliance = 0.025 / (6e5 * m.thread * m.nominal / (2.0 * np.pi * m.turns**2))
    fibres = geometry.stretching_threads(m, compliance, 5.0, "thread_extensibility")
    contact = geometry.late_contact(30e3, 5e3, "threshold_pressure", "pressure_offset")
    truth = Truth(m, hidden=(fibres, contact))
    record = isometric(truth, contractions=SIX_LENGTHS)
    return case_of("pair-threads-threshold-isometric", seed, truth, record, "isometric", rng)


@BOOK.recipe("pair-bladder-length-zero-map")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    zero = sensors.zero_error("length", 0.006 * m.nominal, "length_offset")
    truth = Truth(m, hidden=(_wall(m), zero))
    noise = usual_noise(truth, rng, force=0.002)
    levels = np.linspace(1.5e5, 6e5, 24).tolist()
    record = scattered(
        truth, rng, levels=levels, contractions=np.linspace(0.005, 0.2, 24).tolist(), scatter=True
    )
    return case_of("pair-bladder-length-zero-map", seed, truth, record, "static", rng, noise=noise)


@BOOK.recipe("pair-delay-leak-rests")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 2), rng))
    parts = (drives.hidden_delay(), drives.hidden_leak(rig))
    return transient_case("pair-delay-leak-rests", seed, rig, parts, rng, Test(RESTS))


@BOOK.recipe("pair-flow-load-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed), rng), ratio=0.5)
    parts = (drives.hidden_flow(0.92), drives.hidden_load(0.97))
    return transient_case("pair-flow-load-steps", seed, rig, parts, rng)


@BOOK.recipe("pair-guide-dead-volume-steps")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 1), rng))
    parts = (drives.hidden_guide(rig), drives.hidden_dead_volume(rig))
    return transient_case("pair-guide-dead-volume-steps", seed, rig, parts, rng, Test(forced=True))


@BOOK.recipe("pair-bladder-drag-driven")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    rig = setup(m, damped=False, flow=0.4)
    stiff = 0.0015 * m.blocked * m.nominal / m.rubber
    wall = elastomer.bladder(m, elastomer.yeoh(stiff, -0.03 * stiff, 0.0))
    parts = (wall, drives.hidden_drag(rig))
    return transient_case("pair-bladder-drag-driven", seed, rig, parts, rng, Test(PARTIAL, commanded=False))


@BOOK.recipe("triple-bladder-prestress-coulomb-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    parts = (_wall(m), elastomer.tight_wall(m, 0.03 * m.blocked), _rub(m))
    truth = Truth(m, hidden=parts)
    noise = usual_noise(truth, rng, force=0.002)
    record = isobaric(truth, levels=FIVE, speeds=(0.003, 0.02), rows=100)
    return case_of(
        "triple-bladder-prestress-coulomb-isobaric", seed, truth, record, "isobaric", rng, noise=noise
    )


@BOOK.recipe("triple-bladder-crossings-viscous-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    drag = friction.power_viscous(0.04 * m.blocked / 0.1**0.94, 0.94, 0.0, 0.9)
    truth = Truth(m, hidden=(_wall(m), _crossings(m), drag))
    noise = usual_noise(truth, rng, force=0.0015)
    record = isobaric(truth, levels=FIVE, speeds=(0.002, 0.02, 0.1))
    return case_of(
        "triple-bladder-crossings-viscous-isobaric", seed, truth, record, "isobaric", rng, noise=noise
    )


@BOOK.recipe("triple-delay-silencer-load-pulses")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed, 2), rng))
    parts = (drives.hidden_delay(), drives.hidden_silencer(rig, 0.7), drives.hidden_load(1.02))
    return transient_case("triple-delay-silencer-load-pulses", seed, rig, parts, rng, Test(PULSES))


@BOOK.recipe("triple-overlap-guide-load-partial")
def _(rng: np.random.Generator, seed: int) -> Case:
    rig = setup(made(size(seed), rng), flow=2.0)
    parts = (
        drives.hidden_overlap(0.04),
        drives.hidden_guide(rig, 0.05, "coulomb_friction", "dahl", "bouc_wen"),
        drives.hidden_load(0.98),
    )
    return transient_case("triple-overlap-guide-load-partial", seed, rig, parts, rng, Test(PARTIAL))
