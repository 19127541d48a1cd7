"""Sensors, rig and recorder alone; tests in which nothing is missing; effects that no catalogue has."""

from __future__ import annotations

import numpy as np

from tests.truth import geometry, oddities, sensors
from tests.truth.cases import BOOK, Case
from tests.truth.composition import Truth
from tests.truth.elastic_cases import BAR, C10, FIVE, FOUR, SIX_LENGTHS, known_wall, size
from tests.truth.experiments import isobaric, isometric, pressure_cycles, scattered
from tests.truth.laboratory import case_of, usual_noise
from tests.truth.muscle import FULL_PRESSURE, made


@BOOK.recipe("pressure-zero-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    zero = sensors.zero_error("pressure", -14e3, "pressure_offset")
    truth = Truth(m, hidden=(zero,))
    return case_of("pressure-zero-isobaric", seed, truth, isobaric(truth, levels=FIVE), "isobaric", rng)


@BOOK.recipe("pressure-scale-map")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    scale = sensors.bent_scale(
        "pressure", 1.035, 0.004, FULL_PRESSURE, "pressure_scale", "effectiveness", "force_scale"
    )
    truth = Truth(m, hidden=(scale,))
    levels = [BAR * p for p in np.linspace(1.0, 6.0, 21)]
    record = scattered(
        truth, rng, levels=levels, contractions=np.linspace(0.0, 0.22, 20).tolist(), scatter=True
    )
    return case_of("pressure-scale-map", seed, truth, record, "static", rng)


@BOOK.recipe("force-zero-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    zero = sensors.zero_error("force", 0.03 * m.blocked, "force_offset", "prestress")
    truth = Truth(m, hidden=(zero,))
    return case_of("force-zero-isobaric", seed, truth, isobaric(truth, levels=FOUR), "isobaric", rng)


@BOOK.recipe("force-scale-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    scale = sensors.bent_scale(
        "force", 0.95, 0.004, m.blocked, "force_scale", "effectiveness", "pressure_scale"
    )
    truth = Truth(m, hidden=(scale,))
    return case_of(
        "force-scale-isometric", seed, truth, isometric(truth, contractions=SIX_LENGTHS), "isometric", rng
    )


@BOOK.recipe("length-zero-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    zero = sensors.zero_error("length", 0.006 * m.nominal, "length_offset")
    truth = Truth(m, hidden=(zero,))
    return case_of("length-zero-isobaric", seed, truth, isobaric(truth, levels=FIVE), "isobaric", rng)


@BOOK.recipe("length-zero-diameter")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    zero = sensors.zero_error("length", 0.008 * m.nominal, "length_offset")
    truth = Truth(m, hidden=(zero,))
    return case_of("length-zero-diameter", seed, truth, isobaric(truth, levels=FOUR), "diameter", rng)


@BOOK.recipe("force-lag-steps-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    slow = sensors.slow_amplifier("force", 20.0, 1.1, "sensor_lag")
    truth = Truth(m, hidden=(slow,))
    record = isometric(
        truth, contractions=(0.0, 0.06, 0.12), turns=(1.0, 0.3, 0.8, 0.1, 0.6), rows=500, steps=0.035
    )
    return case_of("force-lag-steps-isometric", seed, truth, record, "isometric", rng)


@BOOK.recipe("tube-behind-sensor-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    tube = sensors.tube_behind_the_sensor(m, 0.025, "pressure_lag")
    truth = Truth(m, hidden=(tube,))
    record = isometric(
        truth, contractions=(0.0, 0.06, 0.12), turns=(1.0, 0.3, 0.8, 0.1, 0.6), rows=500, steps=0.05
    )
    return case_of("tube-behind-sensor-isometric", seed, truth, record, "isometric", rng)


@BOOK.recipe("slow-pressure-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    slow = sensors.slow_amplifier("pressure", 10.0, 1.1, "pressure_lag", "time_skew")
    truth = Truth(m, hidden=(slow,))
    record = isometric(
        truth, contractions=(0.0, 0.06, 0.12), turns=(1.0, 0.3, 0.8, 0.1, 0.6), rows=500, steps=0.1
    )
    return case_of("slow-pressure-isometric", seed, truth, record, "isometric", rng)


@BOOK.recipe("warm-cell-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    truth = Truth(m, hidden=(sensors.warm_cell(0.0011 * m.blocked, "force_thermal"),))
    record = isobaric(truth, levels=(*FIVE, *FIVE[::-1]))
    record.temperature = 293.15 + 12.0 * np.sin(2.5 * record.time / record.time[-1])
    return case_of("warm-cell-isobaric", seed, truth, record, "isobaric", rng, temperature=True)


@BOOK.recipe("warming-amplifier-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    record = isobaric(Truth(m), levels=(*FIVE, *FIVE[::-1]))
    late = 0.25 * float(record.time[-1] - record.time[0])
    truth = Truth(m, hidden=(sensors.warming_amplifier(0.02 * m.blocked, late, "force_drift"),))
    return case_of("warming-amplifier-isobaric", seed, truth, record, "isobaric", rng)


@BOOK.recipe("skew-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    late = sensors.late_recorder(-0.06, "time_skew")
    truth = Truth(m, hidden=(late,))
    record = isobaric(truth, levels=FOUR, speeds=(0.01, 0.06), rows=120)
    return case_of("skew-isobaric", seed, truth, record, "isobaric", rng)


@BOOK.recipe("rig-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    rig = geometry.hardening_rig(0.012 * m.nominal / m.blocked, 2.5 * m.blocked, "rig_compliance")
    truth = Truth(m, hidden=(rig,))
    return case_of("rig-isobaric", seed, truth, isobaric(truth, levels=FIVE), "isobaric", rng)


@BOOK.recipe("rig-isotonic")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    rig = geometry.hardening_rig(0.012 * m.nominal / m.blocked, 2.5 * m.blocked, "rig_compliance")
    truth = Truth(m, hidden=(rig,))
    loads = tuple(share * m.blocked for share in (0.08, 0.2, 0.35, 0.5))
    record = pressure_cycles(low=3e5, high=6e5, loads=loads, rows=160)
    return case_of("rig-isotonic", seed, truth, record, "isotonic", rng)


@BOOK.recipe("nothing-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    truth = Truth(m)
    record = isobaric(truth, levels=FIVE, speeds=(0.003, 0.03))
    return case_of("nothing-isobaric", seed, truth, record, "isobaric", rng)


@BOOK.recipe("nothing-known-wall-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    effects, known = known_wall(m, 0.4e6)
    truth = Truth(m, known=known)
    record = isometric(truth, contractions=SIX_LENGTHS)
    return case_of("nothing-known-wall-isometric", seed, truth, record, "isometric", rng, effects=effects)


@BOOK.recipe("nothing-thread-form-map")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    truth = Truth(m)
    levels = [BAR * p for p in np.linspace(0.5, 6.0, 12)]
    record = scattered(
        truth, rng, levels=levels, contractions=np.linspace(0.0, 0.25, 36).tolist(), scatter=False
    )
    return case_of(
        "nothing-thread-form-map", seed, truth, record, "static", rng, form="thread", say_kind=True
    )


@BOOK.recipe("nothing-isotonic")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    truth = Truth(m)
    record = pressure_cycles(low=2e5, high=6e5, loads=(0.1 * m.blocked, 0.25 * m.blocked), rows=240)
    return case_of("nothing-isotonic", seed, truth, record, "isotonic", rng)


@BOOK.recipe("nothing-diameter")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    truth = Truth(m)
    return case_of("nothing-diameter", seed, truth, isobaric(truth, levels=FOUR), "diameter", rng)


@BOOK.recipe("unknown-ripple-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    wave = oddities.ripple(m, 0.02 * m.blocked, 0.031, float(rng.uniform(0.0, 6.0)))
    truth = Truth(m, hidden=(wave,))
    record = isobaric(truth, levels=FIVE, rows=140)
    return case_of(
        "unknown-ripple-isobaric",
        seed,
        truth,
        record,
        "isobaric",
        rng,
        unknown="force ripple over contraction",
    )


@BOOK.recipe("unknown-torsion-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    twist = oddities.torsion(m, 0.025 * m.blocked / FULL_PRESSURE, 0.11)
    truth = Truth(m, hidden=(twist,))
    record = isobaric(truth, levels=FIVE, rows=120)
    return case_of(
        "unknown-torsion-isobaric", seed, truth, record, "isobaric", rng, unknown="torsion of the braid"
    )


@BOOK.recipe("unknown-magnet-map")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    effects, known = known_wall(m, C10)
    latch = oddities.magnet(m, 0.06 * m.blocked, 0.09, 0.018)
    truth = Truth(m, known=known, hidden=(latch,))
    levels = [BAR * p for p in np.linspace(2.0, 6.0, 20)]
    record = scattered(
        truth, rng, levels=levels, contractions=np.linspace(0.0, 0.18, 30).tolist(), scatter=True
    )
    return case_of(
        "unknown-magnet-map",
        seed,
        truth,
        record,
        "static",
        rng,
        effects=effects,
        unknown="magnet at one length",
    )


@BOOK.recipe("unknown-humidity-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    truth = Truth(m, hidden=(oddities.humidity(0.02 * m.blocked, 17.0),))
    record = isometric(truth, contractions=SIX_LENGTHS, rates=(6e4,), rows=120)
    return case_of(
        "unknown-humidity-isometric", seed, truth, record, "isometric", rng, unknown="periodic drift in time"
    )


@BOOK.recipe("unknown-sticking-point-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    burr = oddities.sticking_point(m, 0.05 * m.blocked, 0.07, 0.008)
    truth = Truth(m, hidden=(burr,))
    noise = usual_noise(truth, rng, force=0.001)
    record = isobaric(truth, levels=FOUR, rows=160)
    return case_of(
        "unknown-sticking-point-isobaric",
        seed,
        truth,
        record,
        "isobaric",
        rng,
        noise=noise,
        unknown="friction at one length",
    )
