"""Wrong entry or missing physics, on data made by formulas written for the tests."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.diagnose.contest import _at_its_best, _Trial
from mckibben.identification.diagnose.diagnosis import Diagnosis, diagnose
from mckibben.identification.diagnose.entries import OtherReading, StatedEntry, read_otherwise, statements
from mckibben.identification.diagnose.entry_words import sentence_of
from mckibben.identification.fit.effort import diagnosis_effort
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.predict import Predictor, predictor_of
from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.measurement.reading import read_measurement
from mckibben.physics.muscle import Muscle
from tests.identification.synthetic import CATALOGUE, MUSCLE, csv, truth

NOISE = 0.5
TITLES = {name: effect.title for name, effect in CATALOGUE.items()}


def diagnosis(
    muscle: Muscle,
    *,
    kgf: bool = False,
    use: tuple[str, ...] = (),
    keep: tuple[str, ...] = (),
    c10: float = 0.0,
    wave: float = 0.0,
    each: int = 12,
) -> Diagnosis:
    """Loops of a muscle of 300 mm with a hidden wall, diagnosed with another muscle stated.

    With ``each`` points on each way; the time that a diagnosis takes grows with them.
    """
    random = np.random.default_rng(3)
    rows = ["# kind: isobaric", "time_s,pressure_bar,displacement_mm,force_N"]
    time = 0.0
    for pressure in (2e5, 3e5, 4e5, 5e5, 6e5):
        for share in (*np.linspace(0.0, 0.18, each), *np.linspace(0.18, 0.0, each)):
            time += 0.1
            length = 0.3 * (1.0 - share)
            force = float(truth(pressure, length, c10=c10)) + NOISE * random.standard_normal()
            force += wave * np.sin(140.0 * share)
            force /= 9.80665 if kgf else 1.0
            rows.append(f"{time:.1f},{pressure / 1e5:.4f},{1e3 * (0.3 - length):.4f},{force:.5f}")
    measurement = read_measurement("\n".join(rows).encode(), "loops.csv")
    start = FitModel(muscle)

    def predictor(readings: Sequence[OtherReading]) -> Predictor:
        return predictor_of(read_otherwise(measurement, readings), muscle)

    elastic = CATALOGUE.values()
    stated, accepted = statements(measurement, start, predictor, elastic=elastic).keeping(keep).using(use)
    return diagnose(
        predictor(stated.readings),
        start,
        catalogue=CATALOGUE,
        statements=stated,
        geometry=[entry.free for entry in accepted if entry.free is not None],
    )


LONG = MUSCLE._replace(nominal_length=0.36)


def test_a_wrong_rest_length_beside_an_elastic_wall_is_asked_about_first() -> None:
    result = diagnosis(LONG, c10=0.4e6)
    assert result.status == "ambiguous"
    assert result.term is None
    leading = result.context[0]
    assert leading.stands
    assert leading.entry.hypothesis == "rest_length"
    assert leading.value == pytest.approx(0.3, abs=2e-3)
    assert leading.stderr is not None
    assert abs(leading.value - 0.3) < 5.0 * leading.stderr
    assert leading.effects == ("bladder_elasticity",)
    assert leading.best.rmse == pytest.approx(NOISE, rel=0.1)
    text = sentence_of(leading, TITLES)
    assert "Rest length 300" in text
    assert "instead of 360 mm" in text


def test_accepted_it_is_fitted_and_the_effect_remains() -> None:
    result = diagnosis(LONG, c10=0.4e6, use=("rest_length",))
    assert result.added == ("bladder_elasticity",)
    assert result.best.fit_model.muscle.nominal_length == pytest.approx(0.3, abs=2e-3)
    assert not any(entry.stands for entry in result.context)


def test_kept_it_is_told_but_not_asked_about() -> None:
    result = diagnosis(LONG, c10=0.4e6, keep=("rest_length",))
    kept = next(entry for entry in result.context if entry.entry.hypothesis == "rest_length")
    assert kept.kept
    assert not kept.stands


def test_a_force_in_kgf_is_read_in_kgf() -> None:
    leading = diagnosis(MUSCLE, kgf=True, each=6).context[0]
    assert leading.stands
    assert leading.entry.hypothesis == "force_in_kgf"
    assert leading.effects == ()
    assert leading.explains > 0.99
    assert "in kgf" in sentence_of(leading, TITLES)


@pytest.mark.parametrize(("c10", "wave"), [(0.0, 0.0), (0.4e6, 0.0), (0.0, 20.0)])
def test_right_entries_are_not_doubted(c10: float, wave: float) -> None:
    """With nothing hidden, with an elastic wall, and with something that no effect explains."""
    result = diagnosis(MUSCLE, c10=c10, wave=wave, each=24 if wave else 12)
    assert not any(entry.stands for entry in result.context)
    expected = "unknown_effect" if wave else "missing_effects" if c10 else "adequate"
    assert result.status == expected


def test_a_thicker_braid_is_a_twin_of_a_stronger_force() -> None:
    """The ideal force goes with the square of the diameter: the data cannot tell the two.

    A caliper decides it, so it is asked first; its odds are those before any data, 0.1 against 0.3 / 0.7.
    Over its range, 1.1 of the stated diameter, the force changes by 2 x 1.1 x 1.1 of what it is, and by 1.21
    over that of the factor, 1: what may be more before any data says half as much.
    """
    result = diagnosis(replace_diameter(MUSCLE, 1.1))
    assert result.added == ("effectiveness",)
    leading = result.context[0]
    assert (leading.entry.hypothesis, leading.stands) == ("braid_diameter", True)
    assert leading.confidence == pytest.approx(1.0 / (1.0 + 2.0 * 0.3 / 0.7 / 0.1), abs=0.002)


@pytest.mark.parametrize(("head", "asked"), [("", True), ("# pressure: gauge", False)])
def test_what_a_file_says_in_words_is_not_doubted_where_an_effect_explains_as_much(
    head: str, asked: bool
) -> None:
    """Readings that are an atmosphere too high: absolute, or a bladder that meets the braid late."""
    random = np.random.default_rng(4)
    rows = [head] if head else []
    rows += ["# kind: isobaric", "time_s,pressure_bar,length_mm,force_N"]
    for pressure in (2e5, 3e5, 4e5, 5e5):
        for share in (*np.linspace(0.0, 0.15, 20), *np.linspace(0.15, 0.0, 20)):
            force = float(truth(pressure, 0.3 * (1.0 - share))) + NOISE * random.standard_normal()
            time = 0.1 * (len(rows) - 2)
            rows.append(
                f"{time:.1f},{(pressure + 101325.0) / 1e5:.5f},{300.0 * (1.0 - share):.4f},{force:.4f}"
            )
    measurement, start = read_measurement("\n".join(rows).encode(), "loops.csv"), FitModel(MUSCLE)

    def predictor(readings: Sequence[OtherReading]) -> Predictor:
        return predictor_of(read_otherwise(measurement, readings), MUSCLE)

    stated = statements(measurement, start, predictor, elastic=CATALOGUE.values())
    result = diagnose(predictor(()), start, catalogue=CATALOGUE, statements=stated)
    assert result.added == ("threshold_pressure",)
    assert ("absolute_pressure" in {e.entry.hypothesis for e in result.context if e.stands}) is asked


@pytest.mark.examination("test_a_wrong_rest_length_beside_an_elastic_wall_is_asked_about_first")
def test_a_wall_that_no_rubber_fits_is_asked_about() -> None:
    """A tenth of the wall: the modulus would have to be ten times that of the hidden wall, 4.7 MPa."""
    result = diagnosis(MUSCLE._replace(wall_thickness=0.18e-3), c10=0.468e6)
    leading = result.context[0]
    assert (leading.entry.hypothesis, leading.stands) == ("wall_thickness", True)
    assert leading.value == pytest.approx(1.8e-3, rel=0.02)  # the usual modulus is the hidden one
    assert leading.effects == ("bladder_elasticity",)
    assert "1.8 mm instead of 0.18 mm, of usual rubber," in sentence_of(leading, TITLES)
    accepted = diagnosis(MUSCLE._replace(wall_thickness=0.18e-3), c10=0.468e6, use=("wall_thickness",))
    assert accepted.status == "missing_effects"
    assert accepted.best.fit_model.muscle.wall_thickness == pytest.approx(1.8e-3, rel=0.02)


def test_what_a_trial_has_found_serves_the_entries_as_stated_as_well() -> None:
    """A wall, and forces that are 9 % too large: 4.5 % of the diameter, or the sensor.

    The best model has missed the wall, the trial with another diameter has found it: that says nothing
    against the diameter.
    """
    random = np.random.default_rng(5)
    rows = [
        f"{1e-5 * p:.2f},{length * 1e3:.3f},{1.09 * float(truth(p, length, c10=0.3e6)) + random.normal():.4f}"
        for p in (2e5, 4e5, 6e5)
        for length in np.linspace(0.25, 0.3, 30)
    ]
    predictor = predictor_of(csv(rows, "pressure_bar,length_mm,force_N"), MUSCLE)
    names = ("bladder_elasticity", "force_scale", "prestress")
    candidates, start = tuple(CATALOGUE[name] for name in names), FitModel(MUSCLE)
    fitter = Fitter(
        predictor=predictor.prepared(start, candidates), geometry=(), candidates=candidates, noise=1.0,
        load=None, effort=diagnosis_effort(simulated=False),
    )  # fmt: skip
    wall, gain, tense = candidates
    root = fitter.fit(start)
    best = fitter.adding(fitter.adding(root, tense), gain)
    diameter = Free("braid_diameter", MUSCLE.braid_diameter, 0.012, 0.034, "m")
    entry = StatedEntry(
        "braid_diameter", "muscle.braid_diameter", "the braid diameter", 0.02, "m", diameter, None, 0.1
    )
    own = replace(fitter, geometry=(diameter,), known={}, off_values={}, refitted_keys=set())
    trial = _Trial(entry, own, own.fit(start), own.adding(own.fit(start), wall), 1.0)
    assert trial.rmse < 0.5 * best.rmse
    found = _at_its_best(fitter, [trial], best, ("prestress", "force_scale"), 90.0, 1.0)
    assert set(found.fit_model.ids) == {"bladder_elasticity", "force_scale"}
    assert found.fit_model.muscle == MUSCLE
    assert found.rmse == pytest.approx(trial.rmse, rel=1e-3)


def replace_diameter(muscle: Muscle, factor: float) -> Muscle:
    return muscle._replace(braid_diameter=factor * muscle.braid_diameter)


@pytest.mark.examination("test_a_wrong_rest_length_beside_an_elastic_wall_is_asked_about_first")
def test_an_angle_is_asked_about_where_as_many_effects_take_its_place() -> None:
    """28° stated as 25°, a threshold of 35 kPa, a spring of 150 N/m: two effects with six numbers fit too.

    Chou & Hannaford 1996, equation 5, for a muscle of 180 mm and 16 mm.
    """
    random = np.random.default_rng(11)
    angle, rest, diameter = np.radians(28.0), 0.18, 0.016
    a, b = 3.0 / np.tan(angle) ** 2, 1.0 / np.sin(angle) ** 2
    rows = ["# kind: static", "pressure_kPa,displacement_mm,force_N"]
    for pressure in (100.0, 150.0, 200.0, 250.0, 300.0, 350.0):
        for stroke in np.arange(0.0, 42.0, 3.0):
            share = (1.0 - 1e-3 * stroke / rest) ** 2
            pull = np.pi * diameter**2 / 4.0 * 1e3 * (pressure - 35.0) * (a * share - b) - 0.15 * stroke
            rows.append(f"{pressure},{stroke},{pull + NOISE * random.standard_normal():.4f}")
    measurement = read_measurement("\n".join(rows).encode(), "map.csv")
    muscle = MUSCLE._replace(
        nominal_length=rest, braid_diameter=diameter, inside_diameter=0.0145, braid_angle=np.radians(25.0)
    )
    start = FitModel(muscle)

    def predictor(readings: Sequence[OtherReading]) -> Predictor:
        return predictor_of(read_otherwise(measurement, readings), muscle)

    stated = statements(measurement, start, predictor, elastic=CATALOGUE.values())
    leading = diagnose(predictor(()), start, catalogue=CATALOGUE, statements=stated).context[0]
    assert (leading.entry.hypothesis, leading.stands) == ("braid_angle", True)
    assert leading.value == pytest.approx(angle, abs=1e-3)
    assert set(leading.effects) == {"threshold_pressure", "linear_elasticity"}
