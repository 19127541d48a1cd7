"""A free surface on a residual: nothing in noise, what was hidden elsewhere; its formulas stand here."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import block_diag, toeplitz
from scipy.signal import cont2discrete, lfilter
from scipy.stats import multivariate_normal

from mckibben.identification.fit.fitted_model import FittedModel, refitted
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel, free_numbers
from mckibben.identification.predict.predictor import PredictedChannel, Predictor
from mckibben.identification.residual import surface
from mckibben.identification.residual.correlated import Chain, tried_noises
from mckibben.identification.residual.surface import (
    Block,
    lagged,
    likelihood_ratio,
    log_evidence,
    most_likely,
    play,
    ratio_of,
    surface_of,
)
from mckibben.measurement.reading import read_measurement
from mckibben.simulation.statics.model import checked_values
from tests.identification.synthetic import Plain, linear_node
from tests.shipped import shipped_studio

FAILING = Path(__file__).parents[4] / "shared/data/failing"
needs_files = pytest.mark.skipif(
    not FAILING.is_dir(), reason="the files of users are not beside this checkout"
)

#: Six pressures, each swept over the contraction and back: a linear subject with friction.
LEVELS, EACH, HIGH, NOISE = 6, 26, 0.22, 2.5
UP = np.linspace(0.0, HIGH, EACH)
CONTRACTION = np.tile(np.concatenate([UP, UP[::-1]]), LEVELS)
PRESSURE = np.repeat(np.linspace(1.5e5, 5.5e5, LEVELS), 2 * EACH)
DIRECTION = np.tile(np.repeat([-1.0, 1.0], EACH), LEVELS)
CURVE = np.repeat(np.arange(LEVELS), 2 * EACH)
ROWS = len(CURVE)
DESIGN = np.column_stack([
    PRESSURE / 1e5 * (1.0 - CONTRACTION) ** 2, PRESSURE / 1e5, CONTRACTION, DIRECTION, np.ones(ROWS),
])  # fmt: skip
FORCE = DESIGN @ np.array([300.0, -90.0, -900.0, 25.0, 0.0])


class Rig(Plain):
    """A plain subject whose rows have a length of a muscle of 1 m; of a run, with a known prediction.

    ``slope``: derivative of its force by the pressure.
    """

    predicted_values: np.ndarray | None = None
    slope: np.ndarray | None = None

    def input_slope(self, fit_model: FitModel, channel: str) -> np.ndarray:
        if channel != "pressure" or self.slope is None:
            return super().input_slope(fit_model, channel)
        return self.slope

    def rest_length(self, fit_model: FitModel) -> float:
        return 1.0

    def predict(self, fit_model: FitModel, *, clipped: bool = True) -> np.ndarray:
        return np.zeros(len(self.measured)) if self.predicted_values is None else self.predicted_values


def loops(extra: np.ndarray) -> tuple[FittedModel, Rig]:
    """The fitted subject and its data, with a further force."""
    levels = np.minimum(CONTRACTION / HIGH * 6, 5).astype(int)
    inputs = {"pressure": PRESSURE, "length": 1.0 - CONTRACTION, "direction": DIRECTION}
    rig = Rig(FORCE + extra, DESIGN, (CURVE, levels), inputs)
    rig.records = rig.groups = CURVE
    rig.sweeps = [np.flatnonzero(curve == CURVE) for curve in range(LEVELS)]
    return linear_node(rig.measured, DESIGN, rig.folds), rig


def beside(design: np.ndarray, effect: np.ndarray) -> np.ndarray:
    """What a fit of the constants leaves of an effect, with an rms of 1."""
    rest = effect - design @ np.linalg.lstsq(design, effect, rcond=None)[0]
    return rest / np.sqrt(np.mean(rest**2))


def correlated(rng: np.random.Generator, rho: float, each: int, lines: int = 1) -> np.ndarray:
    """Noise of standard deviation 1 with the autocorrelation rho, of lines of equal length."""
    start = rng.normal(size=(lines, each))
    start[:, 0] /= np.sqrt(1.0 - rho**2)
    return (np.sqrt(1.0 - rho**2) * lfilter([1.0], [1.0, -rho], start, axis=1)).ravel()


def noise(kind: str, seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    white = rng.normal(size=ROWS)
    if kind == "white":
        return NOISE * white
    if kind == "growing":
        return NOISE * white * 2.0 * np.abs(FORCE) / np.max(np.abs(FORCE))
    if kind == "quantised":
        return np.round((FORCE + 0.2 * white) / 5.0) * 5.0 - FORCE
    if kind == "swinging":
        course = lfilter([1.0], [1.0, -1.5, 0.75], rng.normal(size=(LEVELS, 2 * EACH + 200)), axis=1)[:, 200:]
        return NOISE * course.ravel() / np.std(course)
    return NOISE * correlated(rng, float(kind), 2 * EACH, LEVELS)


KINDS = ("white", "growing", "quantised", "swinging", "0.9", "0.98")
EFFECTS = {
    "a wave": np.cos(2.0 * np.pi * CONTRACTION / HIGH),
    "grows with pressure": (CONTRACTION / HIGH) ** 2 * PRESSURE / 4e5,
    "friction of pressure": DIRECTION * (PRESSURE / 1e5 - 3.5),
    "a bump": np.exp(-(((CONTRACTION - 0.09) / 0.015) ** 2)),
}


@pytest.mark.parametrize("kind", KINDS)
def test_noise_is_no_structure(kind: str) -> None:
    node, rig = loops(noise(kind, 40))
    found = surface_of(node, rig)
    assert found is not None
    assert likelihood_ratio(node, rig) < 16.0
    if kind not in ("0.9", "0.98"):
        assert found.gain_low[0] < 0.1


@pytest.mark.parametrize(
    ("name", "kind"), [*((name, "0.98") for name in EFFECTS), ("a bump", "white"), ("a wave", "0.9")]
)
def test_a_smooth_effect_is_more_than_correlated_noise(name: str, kind: str) -> None:
    node, rig = loops(1.5 * NOISE * beside(DESIGN, EFFECTS[name]) + noise(kind, 7))
    found = surface_of(node, rig)
    assert found is not None
    assert likelihood_ratio(node, rig) > 16.0
    assert max(found.gain_low) > 0.1


def test_what_is_left_is_the_noise_and_the_surface_is_what_was_hidden() -> None:
    hidden = 3.0 * NOISE * beside(DESIGN, EFFECTS["a wave"])
    node, rig = loops(hidden + noise("white", 11))
    found = surface_of(node, rig)
    assert found is not None
    assert node.rmse > 2.8 * NOISE
    assert found.left == pytest.approx(NOISE, rel=0.08)
    assert np.sqrt(np.mean((found.values - hidden) ** 2)) < 0.35 * NOISE
    # Nine of ten rows within two standard deviations, as of any interval that is right.
    assert np.mean(np.abs(found.values - hidden) < 2.0 * found.deviations) > 0.85
    assert 3 <= found.numbers <= 25
    assert found.variables[0][0] == "contraction"
    # Of a mean square of 1 + 9 noises all but 1 can be taken.
    assert found.gain[0] == pytest.approx(0.9, abs=0.05)
    assert found.gain_low[0] <= found.gain[0] <= found.gain_high[0]
    # Ends of the pressures, and of six ranges of the contraction, lie beyond the others.
    assert found.inside == pytest.approx((4 / 6, 16 / 26))
    assert found.independent == (True, False)


def test_white_noise_leaves_itself_and_takes_few_numbers() -> None:
    node, rig = loops(noise("white", 12))
    found = surface_of(node, rig)
    assert found is not None
    assert found.numbers <= 8
    assert found.left == pytest.approx(NOISE, rel=0.1)
    assert found.gain[0] < 0.05
    assert found.gain_high[0] < 0.25


def test_the_same_digits_every_time() -> None:
    node, rig = loops(noise("0.9", 13))
    first, second = surface_of(node, rig), surface_of(node, rig)
    assert first is not None
    assert second is not None
    assert first.gain == second.gain
    assert first.gain_low == second.gain_low
    assert first.left == second.left
    assert np.array_equal(first.values, second.values)


#: What the pressure acts by, and a gauge with a kink: above 3.5 bar it reads half of each further bar.
SLOPE = 3e-3 * (1.0 - CONTRACTION) ** 2 - 0.9e-3
KINK = -0.5 * np.maximum(PRESSURE - 3.5e5, 0.0)


def test_what_acts_through_a_reading_is_a_curve_of_that_reading() -> None:
    """The kink of a gauge is simple as a curve times what the pressure acts by, and a surface it is not."""
    node, rig = loops(SLOPE * KINK + noise("white", 17))
    plain, without = surface_of(node, rig), log_evidence(node, rig)
    rig.slope = SLOPE
    found, evidence = surface_of(node, rig), log_evidence(node, rig)
    assert plain is not None
    assert found is not None
    assert found.left == pytest.approx(NOISE, rel=0.08)
    assert found.variables[0][0] == "pressure"
    assert found.numbers < plain.numbers
    assert evidence is not None
    assert without is not None
    assert evidence > without + 5.0


def test_a_law_that_is_there_is_likelier_than_any_formula_and_one_that_is_not_is_not() -> None:
    """Beside a surface: the law that was hidden gains, one that only imitates it does not."""
    law = (CONTRACTION / HIGH) ** 2 * PRESSURE / 4e5
    _, rig = loops(4.0 * NOISE * beside(DESIGN, law) + noise("white", 19))
    other = np.maximum(CONTRACTION - 0.5 * HIGH, 0.0) * np.sqrt(PRESSURE)

    def with_law(column: np.ndarray) -> float:
        design = np.column_stack([DESIGN, column / np.sqrt(np.mean(column**2))])
        found = log_evidence(linear_node(rig.measured, design, rig.folds), rig)
        assert found is not None
        return found

    bare = log_evidence(linear_node(rig.measured, DESIGN, rig.folds), rig)
    assert bare is not None
    assert with_law(law) > bare + 3.0
    assert with_law(law) > with_law(other) + 3.0


def test_the_evidence_is_the_density_of_the_residual() -> None:
    """Against the density of the whole normal distribution of the rows, with a constant from -5 to 5."""
    _, rig = loops(2.0 * NOISE * beside(DESIGN, EFFECTS["a wave"]) + noise("white", 23))
    node = linear_node(rig.measured - FORCE, DIRECTION[:, None], rig.folds, [(-5.0, 5.0)])
    (channel,) = rig.channels
    blocks, _ = surface._blocks_of(node, rig, channel, np.arange(ROWS))
    columns = np.hstack([block.at_rows() for block in blocks])
    basis = DIRECTION[:, None] / np.sqrt(ROWS)
    outside = columns - basis @ (basis.T @ columns)
    rest = node.residual - basis @ (basis.T @ node.residual)
    found = most_likely(blocks, outside.T @ outside, outside.T @ rest, float(rest @ rest), ROWS - 1)
    wide = np.hstack([columns * found.roots, 5.0 * DIRECTION[:, None]])
    density = multivariate_normal(np.zeros(ROWS), wide @ wide.T + found.noise * np.eye(ROWS))
    assert log_evidence(node, rig) == pytest.approx(float(density.logpdf(node.residual)), rel=1e-6)


def test_nothing_is_said_of_few_rows_or_without_variables() -> None:
    few = np.arange(19)
    pressure = np.linspace(1e5, 5e5, 19)
    rig = Rig(pressure / 1e5 + np.sin(few), pressure[:, None], (few % 6,), {"pressure": pressure})
    node = linear_node(rig.measured, rig.design, rig.folds)
    assert surface_of(node, rig) is None
    assert likelihood_ratio(node, rig) == 0.0
    node, rig = loops(noise("white", 1))
    rig.inputs = {}
    assert surface_of(node, rig) is None
    assert likelihood_ratio(node, rig) == 0.0


def test_a_curve_beyond_the_others_is_not_corrected() -> None:
    """The end pressures lie outside of the range of the others: neither helped nor harmed."""
    node, rig = loops(2.0 * NOISE * beside(DESIGN, EFFECTS["a wave"]) + noise("white", 3))
    rig.folds = (np.where(CURVE == 5, 1, 0),)
    node = linear_node(rig.measured, DESIGN, rig.folds)
    found = surface_of(node, rig)
    assert found is not None
    assert found.inside == (0.0,)
    assert np.isnan(found.gain[0])
    assert np.isnan(found.gain_low[0])


def test_a_play_over_the_pressure_is_seen() -> None:
    """Held lengths, the pressure goes up and down: a loop of a play of a tenth of its range."""
    half = np.linspace(1e5, 6e5, 30)
    pressure = np.tile(np.concatenate([half, half[::-1]]), 5)
    held = np.repeat(np.arange(5), 60)
    length = 1.0 - 0.04 * held
    behind = pressure - play(pressure, 5e4, held)
    design = np.column_stack([pressure / 1e5, length, pressure / 1e5 * length, np.ones(300)])
    force = 100.0 * pressure / 1e5 * length + 1e-4 * behind + np.random.default_rng(2).normal(0, 1.5, 300)
    inputs = {"pressure": pressure, "length": length, "time": np.arange(300.0)}
    rig = Rig(force, design, (held, np.minimum((pressure - 1e5) / 1e5, 4).astype(int)), inputs)
    rig.records = held
    rig.sweeps = [np.flatnonzero(held == one) for one in range(5)]
    node = linear_node(force, design, rig.folds)
    found = surface_of(node, rig)
    assert found is not None
    assert found.gain_low[0] > 0.5
    assert {name for name, _ in found.variables[:2]} == {"pressure", "direction"}
    assert likelihood_ratio(node, rig) > 16.0


def run(seed: int, *, hidden: float) -> tuple[FittedModel, Rig]:
    """A damped load under a stepped pressure, 600 rows: stroke in mm, with correlated noise of 0.3 mm.

    What is hidden grows with the square of the stroke; its rms is given in mm.
    """
    time = 0.012 * np.arange(600)
    levels = np.repeat(np.random.default_rng(99).uniform(1.0, 5.0, 10), 60)
    pressure = lfilter([0.15], [1.0, -0.85], levels) + 0.3 * np.sin(2.0 * np.pi * 1.1 * time)

    def stroke(damping: float, stiffness: float, gain: float, zero: float) -> np.ndarray:
        system = (np.array([[0.0, 1.0], [-stiffness, -damping]]), np.array([[0.0], [1.0]]),
                  np.array([[1.0, 0.0]]), np.array([[0.0]]))  # fmt: skip
        a, b, c, *_ = cont2discrete(system, 0.012)
        rises = [0.0, (c @ b)[0, 0], (c @ a @ b)[0, 0] - np.trace(a) * (c @ b)[0, 0]]
        return 1e3 * lfilter(rises, [1.0, -np.trace(a), np.linalg.det(a)], gain * pressure) + zero

    at = np.array([9.0, 700.0, 6.0, 4.0])
    own = stroke(*at)
    columns = [(stroke(*(at + step)) - stroke(*(at - step))) / 2e-5 for step in np.diag(1e-5 * at)]
    design = np.column_stack(columns)
    noise_ = 0.3 * correlated(np.random.default_rng(seed), 0.9, 600)
    y = own + hidden * beside(design, (own / np.ptp(own)) ** 2) + noise_
    inputs = {"time": time, "pressure": 1e5 * pressure, "displacement": y}
    rig = Rig(y - own, design, (np.arange(600) * 6 // 600,), inputs)
    rig.kind = "transient"
    rig.channels = (PredictedChannel("displacement", "m", slice(None), 1.0, float(np.max(np.abs(y)))),)
    node = linear_node(rig.measured, design, rig.folds)
    rig.measured, rig.predicted_values = y, y - node.residual
    return node, rig


def test_a_run_shows_what_grows_with_the_square_of_its_stroke_beside_correlated_noise() -> None:
    node, rig = run(5, hidden=0.6)
    found = surface_of(node, rig)
    assert found is not None
    assert likelihood_ratio(node, rig) > 16.0
    assert found.gain_low[0] > 0.1
    assert likelihood_ratio(*run(6, hidden=0.0)) < 16.0


def test_the_likelihood_ratio_is_that_of_whole_matrices() -> None:
    """Two lines, one random effect, white noise against it: the ratio from dense matrices of these."""
    rng = np.random.default_rng(8)
    lines = [np.arange(30), np.arange(30, 55)]
    constants, column = rng.normal(size=(55, 2)), np.sin(0.4 * np.arange(55))[:, None]
    residual = 3.0 * column[:, 0] + correlated(rng, 0.7, 55)
    basis = np.linalg.svd(constants)[0][:, 2:]
    own = column / np.sqrt(np.mean(column**2))

    def best(covariances: list[np.ndarray]) -> float:
        found = []
        for covariance in covariances:
            inner, r = basis.T @ covariance @ basis, basis.T @ residual
            square = r @ np.linalg.solve(inner, r)
            found.append(-0.5 * (53 * np.log(square / 53) + np.linalg.slogdet(inner)[1]))
        return max(found)

    within = np.linalg.svd(constants, full_matrices=False)[0]
    plain = [np.eye(55)]
    for each in tried_noises(Chain(lines), within, residual)[1:]:
        first, second, white = each.noise
        course = [1.0, first / (1.0 - second)]
        while len(course) < 30:
            course.append(first * course[-1] + second * course[-2])
        parts = [(1 - white) * toeplitz(course[:n]) + white * np.eye(n) for n in (30, 25)]
        plain.append(block_diag(*parts))
    with_effect = [one + lam * own @ own.T for one in plain for lam in np.geomspace(1e-6, 1e4, 31)]
    whole = 2.0 * (best([*plain, *with_effect]) - best(plain))
    assert whole > 5.0
    assert ratio_of(constants, residual, column, [lines], [np.ones(1)]) == pytest.approx(whole, rel=1e-6)


def test_the_log_evidence_is_that_of_the_normal_distribution() -> None:
    rng = np.random.default_rng(4)
    place = np.linspace(-1.0, 1.0, 40)[:, None]
    block = Block(("pressure",), place, (8,))
    columns, y = block.at_rows(), np.sin(3.0 * place[:, 0]) + rng.normal(0.0, 0.3, 40)
    found = most_likely([block], columns.T @ columns, columns.T @ y, float(y @ y), 40)
    covariance = (columns * found.variances) @ columns.T + found.noise * np.eye(40)
    value = -0.5 * (
        40 * np.log(2 * np.pi) + np.linalg.slogdet(covariance)[1] + y @ np.linalg.solve(covariance, y)
    )
    assert found.log_evidence == pytest.approx(value, rel=1e-9)
    assert np.sqrt(found.noise) == pytest.approx(0.3, abs=0.1)
    weights = found.weights(columns.T @ columns, columns.T @ y)
    smooth = (columns * found.variances) @ columns.T @ np.linalg.solve(covariance, y)
    assert columns @ weights == pytest.approx(smooth, rel=1e-6, abs=1e-9)


def test_a_play_follows_within_its_width_and_a_lag_goes_on_from_rest() -> None:
    values = np.array([0.0, 0.5, 2.0, 1.5, -1.0, 5.0, 5.0])
    records = np.array([0, 0, 0, 0, 0, 1, 1])
    assert play(values, 1.0, records).tolist() == [0.0, 0.0, 1.0, 1.0, 0.0, 5.0, 5.0]
    time = np.array([0.0, 1.0, 2.0, 3.0])
    step = lagged(np.array([0.0, 1.0, 1.0, 1.0]), time, 2.0, np.zeros(4))
    assert step == pytest.approx(1.0 - np.exp(-time / 2.0))


def start_of(name: str, rest_length: str, effects: Sequence[str]) -> tuple[FittedModel, Predictor]:
    """A file of a user, predicted with a DMSP-20 and these effects, all of their numbers fitted."""
    from mckibben.documents.muscle import MuscleInput
    from mckibben.documents.start_model import stated_muscle

    studio = shipped_studio()
    stated = MuscleInput.model_validate({"preset": "DMSP-20", "nominal_length": rest_length})
    model = studio.static_model(studio.start_model(stated_muscle(stated), {}))
    values = checked_values({effect: {} for effect in effects}, studio.catalogue)
    chosen = tuple(studio.catalogue[effect] for effect in values)
    fit_model = FitModel(model.muscle, chosen, values)
    predictor = predictor_of(read_measurement((FAILING / name).read_bytes(), name), model.muscle, None)
    return refitted(predictor, fit_model, free_numbers(fit_model)), predictor


@needs_files
def test_the_loops_of_a_start_model_without_wall_leave_a_surface_of_contraction_and_direction() -> None:
    node, predictor = start_of("A3_offset_end.csv", "250 mm", [])
    found = surface_of(node, predictor)
    assert found is not None
    assert found.left < 0.05 * node.rmse
    assert {name for name, _ in found.variables[:2]} == {"contraction", "direction"}
    assert found.gain_low[0] > 0.9
    assert likelihood_ratio(node, predictor) > 16.0
