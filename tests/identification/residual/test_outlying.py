"""Rows that do not fit: named where they were put in, not where an effect is narrow; formulas stand here."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.residual.outlying import (
    Outlying,
    common_place,
    growing_noise,
    outlying_of,
    outlying_rows,
)
from mckibben.identification.residual.surface import still_blocks
from tests.identification.residual.test_surface import (
    CONTRACTION,
    CURVE,
    EACH,
    FAILING,
    FORCE,
    LEVELS,
    NOISE,
    Rig,
    loops,
    needs_files,
    noise,
    start_of,
)
from tests.identification.synthetic import linear_node

#: Five pressures times six contractions, as a table of a paper.
PLACES = np.linspace(0.0, 0.2, 6)
TABLE_P, TABLE_K = np.repeat(np.linspace(2e5, 6e5, 5), 6), np.tile(PLACES, 5)
TABLE_DESIGN = np.column_stack([TABLE_P / 1e5 * (1 - TABLE_K) ** 2, TABLE_P / 1e5, TABLE_K, np.ones(30)])
TABLE_FORCE = TABLE_DESIGN @ np.array([300.0, -90.0, -900.0, 10.0])
SD = 5.0
TURNS = 2 * EACH * np.arange(LEVELS) + EACH


def table(extra: np.ndarray) -> tuple[FittedModel, Rig]:
    """The fitted table, with a further force."""
    curve = np.repeat(np.arange(5), 6)
    inputs = {"pressure": TABLE_P, "length": 1.0 - TABLE_K}
    rig = Rig(TABLE_FORCE + extra, TABLE_DESIGN, (curve, np.tile(np.arange(6), 5)), inputs)
    rig.records, rig.sweeps = curve, [np.flatnonzero(one == curve) for one in range(5)]
    return linear_node(rig.measured, TABLE_DESIGN, rig.folds), rig


def white(seed: int) -> np.ndarray:
    return SD * np.random.default_rng(seed).normal(size=30)


def test_one_bad_row_of_thirty_is_named_and_no_other() -> None:
    for seed, row in ((20, 4), (21, 17), (22, 26)):
        extra = white(seed)
        extra[row] += 8.0 * SD * (-1) ** seed
        found = outlying_of(*table(extra))
        assert found.rows == (row,)
        assert found.gain > 1.0
        assert found.place is None


def test_two_bad_rows_are_named_in_the_order_of_their_evidence() -> None:
    extra = white(23)
    extra[8] += 12.0 * SD
    extra[21] -= 20.0 * SD
    assert outlying_of(*table(extra)).rows == (21, 8)


def test_nothing_is_named_in_noise() -> None:
    for seed in range(30, 36):
        found = outlying_of(*table(white(seed)))
        assert found.rows == ()
        assert found.gain == 0.0


@pytest.mark.parametrize("kind", ["white", "growing", "quantised", "swinging", "0.9", "0.98"])
def test_nothing_is_named_in_loops_of_noise(kind: str) -> None:
    assert outlying_of(*loops(noise(kind, 50))).rows == ()


def test_all_pressures_share_a_deviation_at_one_stroke_and_it_is_a_surface() -> None:
    for seed, place in ((36, 2), (37, 4)):
        found = outlying_of(*table(white(seed) + 6.0 * SD * np.isclose(TABLE_K, PLACES[place])))
        assert found.rows == ()
        assert found.surface


def test_a_bad_row_is_named_beside_a_deviation_that_all_pressures_share() -> None:
    extra = white(38) + 6.0 * SD * np.isclose(TABLE_K, PLACES[3])
    extra[13] -= 15.0 * SD
    found = outlying_of(*table(extra))
    assert found.rows == (13,)
    assert found.surface


def test_a_bump_of_four_rows_is_a_surface_and_one_bad_row_upon_it_is_named() -> None:
    bump = 15.0 * np.exp(-(((CONTRACTION - 0.11) / 0.01) ** 2))
    found = outlying_of(*loops(bump + noise("white", 51)))
    assert found.rows == ()
    assert found.surface
    extra = bump + noise("white", 52)
    extra[70] += 8.0 * NOISE
    assert outlying_of(*loops(extra)).rows == (70,)


def test_first_rows_after_all_turns_are_named_with_what_they_share() -> None:
    extra = noise("white", 53)
    extra[TURNS] -= 50.0
    found = outlying_of(*loops(extra))
    assert set(found.rows) == set(TURNS.tolist())
    assert found.place is not None
    assert (found.place.kind, found.place.named, found.place.rows) == ("after a turn", LEVELS, LEVELS)
    assert found.place.sentence == "6 of the 6 first rows after a turn of the motion"


def test_many_rows_cost_a_bounded_number_of_candidates() -> None:
    rows = 10_000
    rng = np.random.default_rng(54)
    contraction = 0.2 * np.abs(np.sin(np.linspace(0.0, 40.0, rows)))
    pressure = np.repeat(np.linspace(1e5, 5e5, 10), rows // 10)
    design = np.column_stack([pressure / 1e5, contraction, np.ones(rows)])
    residual = rng.normal(size=rows)
    residual[[17, 5000]] += (14.0, -10.0)
    blocks = still_blocks({"pressure": pressure, "contraction": contraction}, pair=5)
    found = outlying_rows(design, residual, blocks, span=300.0)
    assert found.rows == (17, 5000)
    assert len(found.candidates) == 20


def test_tiny_tables_and_perfect_fits_name_nothing() -> None:
    nothing = Outlying((), 0.0, (), (), surface=False)
    assert outlying_rows(np.ones((7, 1)), np.arange(7.0), [], span=1.0) == nothing
    assert outlying_rows(np.ones((30, 1)), np.zeros(30), [], span=1.0) == nothing
    blocks = still_blocks({"pressure": TABLE_P, "contraction": TABLE_K}, pair=5)
    rounding = 1e-13 * np.random.default_rng(1).normal(size=30)
    assert outlying_rows(TABLE_DESIGN, rounding, blocks, span=1000.0).rows == ()


def test_a_row_that_alone_determines_a_constant_is_no_candidate() -> None:
    design = np.column_stack([np.ones(30), np.arange(30) == 7]).astype(float)
    residual = np.random.default_rng(3).normal(size=30)
    assert 7 not in outlying_rows(design, residual, [], span=100.0).candidates


def test_noise_that_grows_with_the_reading_is_told_from_bad_rows() -> None:
    blocks = still_blocks({"contraction": CONTRACTION})
    design = np.ones((len(FORCE), 1))
    size = np.abs(FORCE) / np.max(np.abs(FORCE))
    grown = np.random.default_rng(9).normal(size=len(FORCE)) * (0.05 + size)
    found = growing_noise(design, grown, blocks, FORCE, span=100.0)
    assert found is not None
    assert np.exp(np.mean(np.log(found))) == pytest.approx(1.0)
    assert np.corrcoef(np.log(found), np.log(0.05 + size))[0, 1] > 0.9
    steady = np.random.default_rng(10).normal(size=len(FORCE))
    steady[np.argmax(size)] += 9.0
    assert growing_noise(design, steady, blocks, FORCE, span=100.0) is None


def test_a_place_is_told_only_where_chance_does_not_give_it() -> None:
    sweeps = [np.flatnonzero(one == CURVE) for one in range(LEVELS)]
    variables = {"contraction": TABLE_K, "pressure": TABLE_P}
    lines = [np.arange(6) + 6 * one for one in range(5)]
    assert common_place([3], variables, lines) is None
    # Two of thirty rows at one of six contractions: 6 x (5/30 x 4/29) = 0.14.
    assert common_place([3, 15], variables, lines) is None
    found = common_place([3, 9, 15, 27], variables, lines)
    assert found is not None
    assert (found.kind, found.variable, found.named, found.rows) == ("level", "contraction", 4, 5)
    assert found.value == pytest.approx(0.12)
    assert found.sentence == "4 of the 5 rows at contraction 12 %"
    assert common_place([3, 9, 15, 28], variables, lines) is None
    course = common_place([60, 61, 63, 64], {}, sweeps)
    assert course is not None
    assert (course.kind, course.named, course.rows) == ("in a row", 4, 5)
    assert course.sentence == "4 of the 5 neighbouring rows"
    assert common_place([60, 61, 63, 130], {}, sweeps) is None


def test_swings_of_correlated_noise_are_no_bad_rows() -> None:
    """A run of 400 rows of a table without motion, as of a second-order process that nobody excites."""
    rng = np.random.default_rng(11)
    course = lfilter([1.0], [1.0, -1.2, 0.6], rng.normal(size=500))[100:]
    place = np.linspace(0.0, 1.0, 400)
    blocks = still_blocks({"contraction": place})
    assert outlying_rows(np.ones((400, 1)), course, blocks, span=100.0).rows == ()


@needs_files
def test_the_row_of_a_joint_that_its_second_file_leaves_out_is_named() -> None:
    lines = [(FAILING / f"joint_{end}.csv").read_text().splitlines() for end in ("one_bad_row", "without_it")]
    (left_out,) = [number - 1 for number, line in enumerate(lines[0]) if line not in lines[1]]
    found = outlying_of(*start_of("joint_one_bad_row.csv", "423 mm", ["prestress"]))
    assert found.rows == (left_out,)
    assert found.gain > 5.0
    assert outlying_of(*start_of("joint_without_it.csv", "423 mm", ["prestress"])).rows == ()


@needs_files
@pytest.mark.parametrize("name", ["A3_shared_end.csv", "A3_offset_end.csv"])
def test_the_loops_of_a_start_model_without_wall_have_a_surface_and_no_bad_row(name: str) -> None:
    """The rows at the turns, where the friction may have any value, are not scored by the product."""
    found = outlying_of(*start_of(name, "250 mm", []))
    assert found.rows == ()
    assert found.surface
