"""Intervals of curves and runs: closed forms, random draws of the values, and where there are none."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mckibben.application.curves.curves import CurvesQuestion, CurvesResult, curves
from mckibben.application.prediction_interval import SHARE
from mckibben.application.run.drive_run import run_drive
from mckibben.application.run.simulate import SimulationQuestion, simulate
from mckibben.documents.drive_reading import AnnotatedDrive, drive_of, read_document
from mckibben.documents.start_model import StartModel, StatedMuscle
from mckibben.presets.fit import Covariance, FitRecord, MeasuredSpan
from mckibben.simulation.timing.evaluation import grid_of
from tests.identification.synthetic import LIFT, MUSCLE
from tests.shipped import shipped_studio

STUDIO = shipped_studio()
DEVIATIONS = 1.6448536269514722  # of a normal distribution, that hold 90 %
PRESSURES = (2e5, 4e5, 6e5)


def fitted(
    effects: dict[str, dict[str, float]], errors: dict[str, float], table: Covariance | None = None
) -> StartModel:
    stated = StatedMuscle(**MUSCLE._asdict())
    spans = {
        "pressure": MeasuredSpan(least=2e5, most=6e5, unit="Pa"),
        "contraction": MeasuredSpan(least=0.0, most=0.1, unit="1"),
    }
    record = FitRecord(files=["a.csv"], made="2026-01-01", errors=errors, envelope=spans, covariance=table)
    return replace(STUDIO.start_model(stated, effects), fitted=record)


def answer(start: StartModel, **options: Any) -> CurvesResult:
    given = {"contraction_from": 0.0, "contraction_to": 0.1} | options
    return curves(CurvesQuestion(start, PRESSURES, points=11, **given), STUDIO)


def widths(result: CurvesResult) -> np.ndarray:
    assert result.interval is not None
    assert result.interval.share == SHARE == 0.9
    assert np.allclose(result.interval.high - result.force, result.force - result.interval.low)
    return result.interval.high - result.force


def test_without_a_covariance_the_error_of_the_fit_is_left() -> None:
    start = fitted({"effectiveness": {"factor": 0.9}}, {"force": 7.0})
    assert np.allclose(widths(answer(start)), DEVIATIONS * 7.0)


def test_the_error_of_a_stroke_is_one_of_the_force_by_the_stiffness() -> None:
    result = answer(fitted({"effectiveness": {"factor": 0.9}}, {"displacement": 1e-4}))
    assert np.allclose(widths(result), DEVIATIONS * 1e-4 * np.abs(result.stiffness))


def test_a_factor_of_the_ideal_force_has_its_closed_form() -> None:
    table = Covariance(names=["effectiveness.factor"], matrix=[[0.02**2]])
    result = answer(fitted({"effectiveness": {"factor": 0.9, "threshold": 0.0}}, {"force": 3.0}, table))
    by_factor = result.force / 0.9
    assert np.allclose(widths(result), DEVIATIONS * np.hypot(3.0, 0.02 * by_factor), rtol=1e-9)


def test_values_that_replace_each_other_are_drawn_together() -> None:
    """The spread of 4000 draws from the covariance, of two values with a correlation of -0.9."""
    deviations, start_values = np.array([0.03, 25e3]), np.array([0.9, 0.4e6])
    matrix = np.outer(deviations, deviations) * np.array([[1.0, -0.9], [-0.9, 1.0]])
    names = ["effectiveness.factor", "bladder_elasticity.shear_modulus"]

    def effects(values: np.ndarray) -> dict[str, dict[str, float]]:
        return {"effectiveness": {"factor": values[0]}, "bladder_elasticity": {"shear_modulus": values[1]}}

    result = answer(
        fitted(effects(start_values), {"force": 0.0}, Covariance(names=names, matrix=matrix.tolist()))
    )
    draws = np.random.default_rng(1).multivariate_normal(start_values, matrix, 4000)
    # Both change the force in proportion, so that two models tell all others.
    plain = [
        answer(fitted(effects(start_values + change), {"force": 0.0})).force - result.force
        for change in np.diag(deviations)
    ]
    steps = (draws - start_values) / deviations
    spread = np.std(np.einsum("ni,i...->n...", steps, np.array(plain)), axis=0)
    assert np.allclose(widths(result), DEVIATIONS * spread, rtol=0.06)


def test_what_the_data_alone_had_changes_nothing() -> None:
    table = Covariance(names=["load_force", "creep.share"], matrix=[[4.0, 0.0], [0.0, 1.0]])
    start = fitted({"effectiveness": {"factor": 0.9}}, {"force": 7.0}, table)
    assert np.allclose(widths(answer(start)), DEVIATIONS * 7.0)


def test_a_dimension_of_the_muscle_may_be_uncertain() -> None:
    table = Covariance(names=["braid_diameter"], matrix=[[1e-8]])
    result = answer(fitted({}, {"force": 0.0}, table))
    # The ideal force grows with the square of the diameter.
    assert np.allclose(widths(result), DEVIATIONS * 2.0 * result.force * 1e-4 / 0.0218, rtol=1e-4)


def test_no_interval_without_a_fit_or_with_errors_of_something_else() -> None:
    assert answer(STUDIO.start_model(StatedMuscle(**MUSCLE._asdict()), {})).interval is None
    assert answer(fitted({}, {"diameter": 1e-5})).interval is None


def test_curves_say_where_they_leave_the_data() -> None:
    start = fitted({}, {"force": 1.0})
    assert [flag.code for flag in answer(start).flags] == []
    outside = [flag.message for flag in answer(start, contraction_to=0.2).flags]
    assert outside == ["contraction up to 20 %: the model was measured up to 10 %"]


def lift(start: StartModel) -> AnnotatedDrive:
    document = {**LIFT, "effects": {name: dict(values) for name, values in start.effects.items()}}
    annotated = drive_of(read_document(document, "the drive"), STUDIO)
    return replace(annotated, start=replace(annotated.start, fitted=start.fitted))


def test_an_error_of_the_force_is_a_constant_force_on_the_load() -> None:
    """At rest the interval is the width of the positions under the load with the error more and less."""
    annotated = lift(fitted({"effectiveness": {"factor": 0.9}}, {"force": 5.0}))
    result = simulate(SimulationQuestion(annotated, points=101))
    assert result.interval is not None
    grid = grid_of(duration=2.0, begin=0.0, end=2.0, points=101)
    drive = annotated.drive
    ends = [
        run_drive(replace(annotated, drive=replace(drive, load=replace(drive.load, force=force))), grid)
        for force in (5.0, -5.0)
    ]
    half = 0.5 * np.abs(ends[0].states["stroke"] - ends[1].states["stroke"])[grid.rows]
    assert np.allclose(result.interval.high - result.position, DEVIATIONS * half, atol=1e-9)
    held = int(np.argmin(np.abs(result.time - 0.95)))
    assert result.interval.high[held] - result.interval.low[held] > 1e-4


def test_uncertain_values_of_the_muscle_are_in_the_interval_of_a_run() -> None:
    """One value: the difference of two whole runs with it one standard deviation up and down."""
    values = {"effectiveness": {"factor": 0.9}}
    table = Covariance(names=["effectiveness.factor"], matrix=[[0.004**2]])
    annotated = lift(fitted(values, {"displacement": 0.0}, table))
    result = simulate(SimulationQuestion(annotated, points=101))
    assert result.interval is not None
    up, down = (
        simulate(SimulationQuestion(lift(fitted({"effectiveness": {"factor": factor}}, {})), points=101))
        for factor in (0.904, 0.896)
    )
    half = 0.5 * np.abs(up.position - down.position)
    assert np.allclose(result.interval.high - result.position, DEVIATIONS * half, atol=3e-5)
    assert np.max(half) > 1e-4


def test_a_run_says_where_it_leaves_the_data() -> None:
    result = simulate(SimulationQuestion(lift(fitted({}, {"displacement": 1e-4})), points=11))
    told = [flag.message for flag in result.flags if flag.code == "outside_measured_range"]
    assert any(text.startswith("pressure down to 0 bar") for text in told)
    assert any("the model was measured without time" in text for text in told)
