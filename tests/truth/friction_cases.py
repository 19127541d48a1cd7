"""Friction, hysteresis and damping alone."""

from __future__ import annotations

import numpy as np

from tests.truth import friction
from tests.truth.cases import BOOK, Case
from tests.truth.composition import Truth
from tests.truth.elastic_cases import FOUR, SIX_LENGTHS, size
from tests.truth.experiments import isobaric, isometric, pressure_cycles
from tests.truth.laboratory import case_of, usual_noise
from tests.truth.muscle import made

# Corners of a loop with smaller loops inside it.
NESTED = (1.0, 0.35, 0.75, 0.5, 0.6, 0.0)


@BOOK.recipe("coulomb-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    rub = friction.bristles(0.014 * m.blocked, 6e-5, "coulomb_friction", "dahl", "bouc_wen")
    truth = Truth(m, hidden=(rub,))
    noise = usual_noise(truth, rng, force=0.001)
    record = isobaric(truth, levels=FOUR, speeds=(0.002, 0.02))
    return case_of("coulomb-isobaric", seed, truth, record, "isobaric", rng, noise=noise)


@BOOK.recipe("coulomb-isotonic")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    rub = friction.bristles(
        0.015 * m.blocked, 6e-5, "coulomb_friction", "guide_friction", "dahl", "bouc_wen", rise=0.0
    )
    truth = Truth(m, hidden=(rub,))
    loads = tuple(share * m.blocked for share in (0.15, 0.25, 0.35))
    record = pressure_cycles(low=2.6e5, high=6e5, loads=loads, rows=220)
    return case_of("coulomb-isotonic", seed, truth, record, "isotonic", rng)


@BOOK.recipe("crossing-friction-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    level = 0.025 * m.blocked / (6e5 * 4.0 / 3.0 * m.nominal / m.turns)
    rub = friction.crossings(m, level, 8e-5, "pressure_friction", "contact_friction")
    truth = Truth(m, hidden=(rub,))
    noise = usual_noise(truth, rng, force=0.001)
    record = isobaric(truth, levels=FOUR, speeds=(0.002, 0.02))
    return case_of("crossing-friction-isobaric", seed, truth, record, "isobaric", rng, noise=noise)


@BOOK.recipe("contact-friction-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng, length=0.2 + 0.05 * seed)
    share = 0.02 * m.blocked / (6e5 * np.pi * m.diameter * m.nominal)
    rub = friction.rubbing(m, share, 4.0 * share, 0.12, "contact_friction", "pressure_friction")
    truth = Truth(m, hidden=(rub,))
    record = isobaric(truth, levels=FOUR, speeds=(0.002, 0.01, 0.05))
    return case_of("contact-friction-isobaric", seed, truth, record, "isobaric", rng)


@BOOK.recipe("dahl-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    rub = friction.yielding(0.02 * m.blocked, 0.008 * m.nominal, 1.4, "dahl", "bouc_wen", "maxwell_slip")
    truth = Truth(m, hidden=(rub,))
    noise = usual_noise(truth, rng, force=0.001)
    record = isobaric(truth, levels=FOUR, turns=NESTED, rows=200)
    return case_of("dahl-isobaric", seed, truth, record, "isobaric", rng, noise=noise)


@BOOK.recipe("baber-noori-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    rub = friction.degrading_bouc(
        0.02 * m.blocked, 0.009 * m.nominal, 2.4, 0.3, "bouc_wen", "dahl", "maxwell_slip"
    )
    truth = Truth(m, hidden=(rub,))
    noise = usual_noise(truth, rng, force=0.001)
    record = isobaric(truth, levels=FOUR, turns=NESTED, rows=200)
    return case_of("baber-noori-isobaric", seed, truth, record, "isobaric", rng, noise=noise)


@BOOK.recipe("iwan-nested-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    rub = friction.iwan(0.025 * m.blocked, 0.04 * m.nominal, "maxwell_slip")
    truth = Truth(m, hidden=(rub,))
    noise = usual_noise(truth, rng, force=0.001)
    record = isobaric(truth, levels=FOUR, turns=NESTED, rows=240)
    return case_of("iwan-nested-isobaric", seed, truth, record, "isobaric", rng, noise=noise)


@BOOK.recipe("pressure-play-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    play = friction.pressure_play(0.011 * m.blocked, 9e4, "pressure_hysteresis")
    truth = Truth(m, hidden=(play,))
    noise = usual_noise(truth, rng, force=0.001)
    record = isometric(truth, contractions=SIX_LENGTHS, turns=(1.0, 0.3, 0.8, 0.0), rows=160)
    return case_of("pressure-play-isometric", seed, truth, record, "isometric", rng, noise=noise)


@BOOK.recipe("viscous-speeds-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    drag = friction.power_viscous(0.03 * m.blocked / 0.1**0.85, 0.85, 4e-7, 0.7)
    truth = Truth(m, hidden=(drag,))
    record = isobaric(truth, levels=FOUR, speeds=(0.001, 0.02, 0.1))
    return case_of("viscous-speeds-isobaric", seed, truth, record, "isobaric", rng, directed=seed == 0)


@BOOK.recipe("guide-isotonic")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    rub = friction.bristles(
        0.012 * m.blocked, 6e-5, "guide_friction", "coulomb_friction", "dahl", "bouc_wen", rise=0.0
    )
    truth = Truth(m, hidden=(rub,))
    record = pressure_cycles(low=2.2e5, high=5.6e5, loads=(0.2 * m.blocked, 0.3 * m.blocked), rows=300)
    return case_of("guide-isotonic", seed, truth, record, "isotonic", rng)
