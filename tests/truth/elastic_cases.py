"""Static effects of geometry and elastomer alone, each in a test that reveals it."""

from __future__ import annotations

import numpy as np

from tests.truth import elastomer, geometry
from tests.truth.cases import BOOK, Case
from tests.truth.composition import Record, Truth
from tests.truth.experiments import held, isobaric, isometric, pressure_cycles, scattered
from tests.truth.laboratory import case_of, usual_noise
from tests.truth.muscle import ROOM, Muscle, made

BAR = 1e5
FIVE = tuple(BAR * p for p in (2.0, 3.0, 4.0, 5.0, 6.0))
FOUR = tuple(BAR * p for p in (1.5, 3.0, 4.5, 6.0))
SIX_LENGTHS = (0.0, 0.03, 0.07, 0.11, 0.15, 0.19)
C10 = 0.467e6


def size(seed: int, first: int = 0) -> int:
    """Another size for every seed."""
    return (10, 20, 40)[(seed + first) % 3]


def known_wall(muscle: Muscle, c10: float = C10) -> tuple[dict, tuple]:
    """A start model that knows the neo-Hookean wall: its effects, and the truth of them."""
    return {"bladder_elasticity": {"shear_modulus": c10}}, (elastomer.known_bladder(muscle, c10),)


@BOOK.recipe("bladder-yeoh-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    wall = elastomer.bladder(m, elastomer.yeoh(0.3e6, -0.012e6, 0.004e6))
    truth = Truth(m, hidden=(wall,))
    noise = usual_noise(truth, rng, force=0.003)
    return case_of(
        "bladder-yeoh-isobaric", seed, truth, isobaric(truth, levels=FIVE), "isobaric", rng, noise=noise
    )


@BOOK.recipe("bladder-ogden-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    wall = elastomer.bladder(m, elastomer.ogden((0.62e6, 1.3), (1e3, 5.0), (-1e4, -2.0)))
    truth = Truth(m, hidden=(wall,))
    noise = usual_noise(truth, rng, force=0.003)
    record = isometric(truth, contractions=SIX_LENGTHS)
    return case_of("bladder-ogden-isometric", seed, truth, record, "isometric", rng, noise=noise)


@BOOK.recipe("bladder-exponential-map")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    wall = elastomer.exponential_bladder(m, 0.095 * m.blocked, 0.027, 0.06 * m.blocked)
    truth = Truth(m, hidden=(wall,))
    noise = usual_noise(truth, rng, force=0.003)
    record = scattered(
        truth,
        rng,
        levels=np.linspace(1.5e5, 6e5, 19).tolist(),
        contractions=np.linspace(0.0, 0.2, 21).tolist(),
        scatter=seed != 1,
    )
    return case_of("bladder-exponential-map", seed, truth, record, "static", rng, noise=noise)


@BOOK.recipe("bladder-eight-chain-isotonic")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    truth = Truth(m, hidden=(elastomer.bladder(m, elastomer.arruda_boyce(0.06e6, 3.5)),))
    loads = tuple(share * m.blocked for share in (0.12, 0.22, 0.34))
    record = pressure_cycles(low=2.8e5, high=6e5, loads=loads, rows=240)
    noise = usual_noise(truth, rng)
    noise.levels["length"] = 1e-4
    return case_of("bladder-eight-chain-isotonic", seed, truth, record, "isotonic", rng, noise=noise)


@BOOK.recipe("linear-spring-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    spring = elastomer.soft_spring(m, 0.6 * m.blocked / m.nominal)
    truth = Truth(m, hidden=(spring,))
    noise = usual_noise(truth, rng, force=0.002)
    return case_of(
        "linear-spring-isobaric", seed, truth, isobaric(truth, levels=FOUR), "isobaric", rng, noise=noise
    )


@BOOK.recipe("prestress-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    truth = Truth(m, hidden=(elastomer.tight_wall(m, 0.04 * m.blocked),))
    return case_of(
        "prestress-isometric", seed, truth, isometric(truth, contractions=SIX_LENGTHS), "isometric", rng
    )


@BOOK.recipe("threshold-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    contact = geometry.late_contact(28e3, 6e3, "threshold_pressure", "pressure_offset")
    truth = Truth(m, hidden=(contact,))
    return case_of(
        "threshold-isometric", seed, truth, isometric(truth, contractions=SIX_LENGTHS), "isometric", rng
    )


@BOOK.recipe("effectiveness-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    loss = geometry.saturating(0.9, 0.06, 1.5e5, "effectiveness", "force_scale")
    truth = Truth(m, hidden=(loss,))
    return case_of(
        "effectiveness-isometric", seed, truth, isometric(truth, contractions=SIX_LENGTHS), "isometric", rng
    )


@BOOK.recipe("contraction-factor-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    ends = geometry.faster_middle(m, 1.09, 0.08, 1.3e5, "contraction_factor", "end_caps")
    truth = Truth(m, hidden=(ends,))
    return case_of("contraction-factor-isobaric", seed, truth, isobaric(truth, levels=FIVE), "isobaric", rng)


@BOOK.recipe("contraction-factor-diameter")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    truth = Truth(m, hidden=(geometry.faster_middle(m, 1.12, 0.05, 1.3e5, "contraction_factor"),))
    record = isobaric(truth, levels=FOUR, rows=100)
    return case_of("contraction-factor-diameter", seed, truth, record, "diameter", rng)


@BOOK.recipe("end-caps-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    truth = Truth(m, hidden=(geometry.rounded_ends(m, 2.2, "end_caps", "contraction_factor"),))
    return case_of("end-caps-isobaric", seed, truth, isobaric(truth, levels=FIVE), "isobaric", rng)


@BOOK.recipe("wall-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made((20, 40, 20)[seed % 3], rng)
    truth = Truth(m, hidden=(geometry.thinning_wall(m, 0.9e-3, 0.15, "wall_thickness"),))
    return case_of("wall-isobaric", seed, truth, isobaric(truth, levels=FIVE, high=0.22), "isobaric", rng)


@BOOK.recipe("threads-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    compliance = 0.02 / (6e5 * m.thread * m.nominal / (2.0 * np.pi * m.turns**2))
    fibres = geometry.stretching_threads(m, compliance, 6.0, "thread_extensibility")
    truth = Truth(m, hidden=(fibres,))
    return case_of(
        "threads-isometric", seed, truth, isometric(truth, contractions=SIX_LENGTHS), "isometric", rng
    )


@BOOK.recipe("threads-diameter")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    compliance = 0.02 / (6e5 * m.thread * m.nominal / (2.0 * np.pi * m.turns**2))
    truth = Truth(m, hidden=(geometry.stretching_threads(m, compliance, 6.0, "thread_extensibility"),))
    record = isometric(truth, contractions=(0.02, 0.08, 0.14, 0.2), rows=110)
    return case_of("threads-diameter", seed, truth, record, "diameter", rng)


@BOOK.recipe("taut-braid-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    braid = geometry.taut_braid(m, 7.0 * m.blocked / m.nominal, -0.002, 0.0012, "braid_stiffening")
    truth = Truth(m, hidden=(braid,))
    record = isobaric(truth, levels=FOUR, low=-0.035, high=0.15, rows=130)
    return case_of("taut-braid-isobaric", seed, truth, record, "isobaric", rng)


@BOOK.recipe("jammed-braid-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    lock = float(np.arccos(0.83 * m.nominal / m.thread))
    truth = Truth(m, hidden=(geometry.jammed_braid(m, 3.0 * m.blocked / m.nominal, lock, "braid_lock"),))
    record = isobaric(truth, levels=FOUR, high=0.26, rows=130)
    return case_of("jammed-braid-isobaric", seed, truth, record, "isobaric", rng)


@BOOK.recipe("heat-of-work-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    effects, known = known_wall(m)
    heat = elastomer.working_heat(m, elastomer.neo_hooke(C10), 0.3, 60.0)
    truth = Truth(m, known=known, hidden=(heat,))
    # Six loops at one pressure and then at another, without a rest.
    turns = (1.0, 0.0) * 6
    record = isobaric(truth, levels=(6e5, 4e5), speeds=(0.05 * m.nominal,), turns=turns, rows=260)
    return case_of("heat-of-work-isobaric", seed, truth, record, "isobaric", rng, effects=effects)


@BOOK.recipe("softening-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    effects, known = known_wall(m)
    soft = elastomer.softening(m, elastomer.neo_hooke(C10), 4.0, 0.15)
    truth = Truth(m, known=known, hidden=(soft,))
    record = isobaric(
        truth, levels=(6e5, 5e5), turns=(0.5, 0.0, 0.5, 0.0, 1.0, 0.0, 1.0, 0.0), rows=420, speeds=(0.01,)
    )
    return case_of("softening-isobaric", seed, truth, record, "isobaric", rng, effects=effects)


@BOOK.recipe("creep-holds-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    truth = Truth(m, hidden=(elastomer.power_law_creep(0.35 * m.blocked / m.nominal, 0.12),))
    record = held(
        truth, levels=(6e5, 4.5e5, 3e5), stops=(0.01, 0.15, 0.05, 0.1, 0.01), speed=0.05, hold=40.0, rows=90
    )
    return case_of("creep-holds-isobaric", seed, truth, record, "isobaric", rng, say_kind=True)


@BOOK.recipe("settling-steps-isometric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    truth = Truth(m, hidden=(elastomer.settling(m, 0.09, 0.1),))
    record = isometric(
        truth, contractions=(0.0, 0.06, 0.12), turns=(1.0, 0.3, 0.8, 0.1, 0.6), rows=300, steps=1.5
    )
    return case_of("settling-steps-isometric", seed, truth, record, "isometric", rng)


@BOOK.recipe("warming-isobaric")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    effects, known = known_wall(m)
    warm = elastomer.warming(m, elastomer.neo_hooke(C10), -0.006, 2.5e-5)
    truth = Truth(m, known=known, hidden=(warm,))
    record = _heated(isobaric(truth, levels=(*FIVE, *FIVE[::-1])), m)
    return case_of(
        "warming-isobaric", seed, truth, record, "isobaric", rng, effects=effects, temperature=True
    )


def _heated(record: Record, muscle: Muscle) -> Record:
    """The room at 20 degC first, a warm box later, and a slow way in between."""
    share = record.time / record.time[-1]
    record.temperature = ROOM + 42.0 / (1.0 + np.exp(-(share - 0.5) / 0.08))
    return record
