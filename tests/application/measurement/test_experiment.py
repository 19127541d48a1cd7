"""The experiment in the use case: plateaus with wrong clamps, specimens of several lengths."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mckibben.application.compare.compare import compare
from mckibben.application.compare.question import ModelQuestion, question_of
from mckibben.application.diagnose.diagnose import prepare
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.application.measurement.experiment import QuestionMeasurement, QuestionModel
from mckibben.documents.experiment import stated_accuracy
from mckibben.documents.muscle import MuscleInput
from mckibben.documents.start_model import StartModel, stated_muscle
from mckibben.documents.studio import Studio
from mckibben.measurement.experiment import ExperimentValue
from mckibben.measurement.points import Points, find_preset
from mckibben.measurement.reading import read_measurement
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Watch
from tests.application.truths import ANGLE, document, plateaus, specimen
from tests.shipped import shipped_studio

SHARP = "length 1 mm, force 0.1 %, pressure 2 mbar"
#: Sensors without an error: nothing is allowed for.
EXACT = stated_accuracy("length 0 mm, force 0 %, pressure 0 bar", "accuracy")


@pytest.fixture(scope="module")
def studio() -> Studio:
    """Presets and effects that come with the program."""
    return shipped_studio()


def model_of_question(
    studio: Studio, given: Mapping[str, Any], effects: Mapping[str, Any] | None = None
) -> QuestionModel:
    """A model as a door states it."""

    def start(named: str, length: float | None) -> StartModel:
        del named
        own = dict(given)
        if length is not None and "preset" not in own:
            own.setdefault("nominal_length", length)
        return studio.start_model(stated_muscle(MuscleInput.model_validate(own)), effects or {})

    return QuestionModel(start)


def asked(
    studio: Studio,
    texts: Sequence[str],
    given: Mapping[str, Any] | None = None,
    said: Mapping[str, ExperimentValue] | None = None,
    effects: Mapping[str, Any] | None = None,
    **options: Any,
) -> ModelQuestion:
    """The question of some files."""
    measurements = [
        QuestionMeasurement(Points(read_measurement(text.encode(), f"{number}.csv")), said or {})
        for number, text in enumerate(texts)
    ]
    return question_of(
        model_of_question(studio, given or document(), effects), measurements, studio, **options
    )


def diagnosed(studio: Studio, question: ModelQuestion) -> DiagnosisResult:
    """Its diagnosis."""
    return prepare(question, studio)(Watch(time_limit=float("inf")))


def named(result: DiagnosisResult) -> set[str]:
    """The effects of a verdict and those that the data cannot tell from them."""
    return {*result.verdict.effects, *itertools.chain(*result.verdict.indistinguishable)}


@pytest.mark.parametrize("hidden", [False, True], ids=["nothing missing", "rubber wall"])
@pytest.mark.parametrize("seed", [0, 1])
def test_clamps_that_are_off_are_no_missing_effect(studio: Studio, hidden: bool, seed: int) -> None:
    """Plateaus with clamps off by 1 mm: the errors are found within the accuracy, and the verdict stands."""
    errors = np.random.default_rng(100 + seed).normal(0.0, 1e-3, 6)
    texts = [plateaus(errors, hidden=hidden, seed=seed)]
    result = diagnosed(studio, asked(studio, texts))
    # Of a model in which nothing is fitted: one figure, whether compared or diagnosed.
    given = compare(asked(studio, texts), fit=False)
    assert given.rmse > 1.5 * given.rmse_beyond_accuracy
    assert given.holdout_rmse == pytest.approx(result.baseline.holdout_rmse, rel=1e-6)
    assert given.specimens[0].rmse == pytest.approx(result.baseline.rmse, rel=1e-6)
    if hidden:
        # What the steps promise is what a comparison with their models shows, whatever their slopes.
        for step in (*result.path, *result.candidates[:3]):
            shown = compare(asked(studio, texts, effects=step.model.effects), fit=False)
            assert shown.rmse_beyond_accuracy == pytest.approx(step.rmse, rel=1e-6)
        assert result.verdict.status in ("missing_effects", "ambiguous")
        assert "bladder_elasticity" in named(result)
    else:
        assert result.verdict.status == "adequate"
        assert result.verdict.effects == []
    found = np.array([each.value for each in result.absorbed])[::-1]  # listed from the shortest length
    assert np.all(np.abs(found - errors) < 1e-3)
    assert all(each.stderr < each.accuracy for each in result.absorbed)
    assert result.verdict.sentence.startswith(
        "Assuming readings accurate to 1 mm of length and 0.5 % of force and 20 mbar of pressure. "
    )


def test_better_sensors_tell_more_of_the_clamps(studio: Studio) -> None:
    errors = np.random.default_rng(5).normal(0.0, 1e-3, 6)
    said = stated_accuracy(SHARP, "accuracy")
    result = diagnosed(studio, asked(studio, [plateaus(errors)], said=said))
    found = np.array([each.value for each in result.absorbed])[::-1]
    deviations = np.array([each.stderr for each in result.absorbed])[::-1]
    assert np.max(deviations) < 0.3e-3
    assert np.all(np.abs(found - errors) < 3.0 * deviations)
    assert result.verdict.status == "adequate"


def test_without_the_accuracy_the_clamps_are_blamed_on_something_else(studio: Studio) -> None:
    """What the allowance is for: if the clamps are said to be exact, the same data lack an effect."""
    errors = np.array([1.2e-3, -0.8e-3, 1.5e-3, -1.5e-3, 0.9e-3, -1.1e-3])
    result = diagnosed(studio, asked(studio, [plateaus(errors)], said=EXACT))
    assert result.verdict.status != "adequate"
    assert result.absorbed == []


def test_an_effect_that_clamps_cannot_explain_is_found_beside_them(studio: Studio) -> None:
    """Clamps that are all off by 4 mm to one side: that is far beyond the accuracy and not hidden by it."""
    result = diagnosed(
        studio, asked(studio, [plateaus(np.full(6, 4e-3))], said=stated_accuracy(SHARP, "accuracy"))
    )
    assert result.verdict.effects
    assert result.path[0].rmse > 2.0 * (result.noise_floor.rmse or 0.0)


def test_an_error_within_the_accuracy_of_a_sensor_is_not_missing(studio: Studio) -> None:
    """A force sensor that is off by 4 N: a missing effect, unless the sensor is said to be no better."""
    text = specimen(0.3, zero=4.0, walled=False)
    exact = diagnosed(studio, asked(studio, [text]))
    assert exact.verdict.effects
    said = stated_accuracy("force 4 N", "accuracy")
    honest = diagnosed(studio, asked(studio, [text], said=said))
    assert (honest.verdict.status, honest.verdict.effects) == ("adequate", [])
    assert honest.noise_floor.rmse == pytest.approx(np.hypot(4.0, exact.noise_floor.rmse or 0.0), rel=0.1)
    assert "accuracy" in honest.noise_floor.how


def test_what_a_test_has_no_use_for_is_told(studio: Studio) -> None:
    said = {
        "load": ExperimentValue(3.0, "kg", "you", "--load"),
        "stops": ExperimentValue("0 % to 20 %", "", "you", "here"),
    }
    messages = compare(asked(studio, [specimen(0.3)], said=said)).messages
    assert any("load (3 kg) is stated, but not used in this isobaric test" in each for each in messages)
    assert any("end stops" in each and "not used" in each for each in messages)


def test_a_length_for_one_of_several_files_names_the_way_out(studio: Studio) -> None:
    length = ExperimentValue(0.2, "m", "you", "--muscle M:200mm")
    model = replace(model_of_question(studio, document(0.2)), length=length)
    measurements = [
        QuestionMeasurement(Points(read_measurement(specimen(each).encode(), f"{each}.csv")))
        for each in (0.2, 0.3)
    ]
    with pytest.raises(InputError, match=r"0\.3\.csv says a rest length of 300 mm") as caught:
        question_of(model, measurements, studio)
    assert "each file has its own" in str(caught.value.hint)


@pytest.mark.examination("test_each_specimen_is_predicted_as_alone")
def test_specimens_of_several_lengths_are_diagnosed_together(studio: Studio) -> None:
    """Three lengths of one hose with one hidden wall, each with a zero error of the force of its own."""
    zeros = (-3.0, 0.0, 3.0)
    texts = [
        specimen(length, zero=zero, seed=number)
        for number, (length, zero) in enumerate(zip((0.2, 0.3, 0.4), zeros, strict=True))
    ]
    question = asked(studio, texts)
    result = diagnosed(studio, question)
    assert result.verdict.status in ("missing_effects", "ambiguous")
    assert "bladder_elasticity" in named(result)
    assert result.path[-1].rmse < 1.3 * (result.noise_floor.rmse or 0.0)
    assert [each.file for each in result.specimens] == ["0.csv", "1.csv", "2.csv"]
    assert [each.experiment["rest_length"].value for each in result.specimens] == [0.2, 0.3, 0.4]
    assert sum(each.rows_used for each in result.specimens) == result.rows_used
    squares = [each.rows_used * (each.rmse or 0.0) ** 2 for each in result.specimens]
    assert np.sqrt(sum(squares) / result.rows_used) == pytest.approx(result.path[-1].rmse)
    assert all(each.holdout_rmse is not None for each in result.specimens)
    offsets = [each.value for each in result.absorbed if each.channel == "force"]
    assert offsets == pytest.approx(zeros, abs=1.5)
    # A length error of the fittings shows among several lengths, and only there.
    among = {effect.id for effect in studio.catalogue.values() if effect.among_lengths}
    assert not among & {each.effect for each in result.not_tried}
    alone = diagnosed(studio, asked(studio, texts[:1]))
    assert among <= {each.effect for each in alone.not_tried}


@pytest.mark.examination("test_each_specimen_is_predicted_as_alone")
def test_a_zero_error_that_all_specimens_share_is_an_effect(studio: Studio) -> None:
    """The same sensor, 5 N off for every length: no matter of mounting, and a new specimen shows it again."""
    texts = [specimen(length, zero=5.0, walled=False, seed=n) for n, length in enumerate((0.2, 0.4))]
    result = diagnosed(studio, asked(studio, texts))
    assert "force_offset" in named(result)
    offset, *_ = (
        value["offset"].value if name == "force_offset" else -value["force"].value
        for name, value in result.parameters.items()
    )
    assert offset == pytest.approx(5.0, abs=0.5)
    assert all(each.left_out_rmse == pytest.approx(each.rmse, rel=0.2) for each in result.specimens)
    assert "Fitted to the other specimens alone" in result.verdict.sentence


@pytest.mark.examination("test_each_specimen_is_predicted_as_alone")
def test_each_specimen_has_an_angle_of_its_own_where_fits_may_change_it(studio: Studio) -> None:
    """Braids of two hoses, 0.35 degrees steeper and flatter than stated: a matter of the specimens."""
    own = (0.006, -0.006)
    texts = [
        specimen(length, walled=False, steeper=angle, seed=n)
        for n, (length, angle) in enumerate(zip((0.2, 0.4), own, strict=True))
    ]
    stated = diagnosed(studio, asked(studio, texts))
    assert stated.verdict.status != "adequate"
    free = diagnosed(studio, asked(studio, texts, free=["braid_angle"]))
    assert free.verdict.status == "adequate"
    found = {each.of: each.value for each in free.absorbed if each.channel == "braid_angle"}
    # Stated minus true; the muscle of the model keeps the angle of both together.
    assert found == pytest.approx({"0.csv": -0.006, "1.csv": 0.006}, abs=5e-4)
    assert free.geometry.braid_angle == pytest.approx(ANGLE, abs=5e-4)
    assert any("braid angle 0.csv -0.3" in message for message in free.messages)


def test_each_specimen_is_predicted_as_alone(studio: Studio) -> None:
    texts = [specimen(length, seed=number) for number, length in enumerate((0.2, 0.4))]
    together = compare(asked(studio, texts, said=EXACT))
    for each, text in zip(together.specimens, texts, strict=True):
        alone = compare(asked(studio, [text], said=EXACT))
        assert each.rmse == pytest.approx(alone.rmse)


def isotonic(*conditions: str) -> str:
    """A muscle that lifts a weight, with conditions."""
    rows = [f"{n},{3 + 0.02 * n},{290 - 0.3 * n}" for n in range(40)]
    head = ["# kind: isotonic", *(f"# {line}" for line in conditions), "time_s,pressure_bar,length_mm"]
    return "\n".join([*head, *rows])


def test_different_loads_are_compared_together(studio: Studio) -> None:
    texts = [isotonic(f"load_mass: {mass} kg") for mass in (5, 20)]
    said = {"rest_length": ExperimentValue(0.3, "m", "you")}
    result = compare(asked(studio, texts, said=said))
    assert [each.experiment["load"].value for each in result.specimens] == [5.0, 20.0]
    for each, text in zip(result.specimens, texts, strict=True):
        assert each.rmse == pytest.approx(compare(asked(studio, [text], said=said)).rmse)
    assert result.specimens[0].rmse != pytest.approx(result.specimens[1].rmse)


def test_a_weight_on_an_incline_counts_along_it(studio: Studio) -> None:
    lines = (("load_mass: 5 kg",), ("load_mass: 10 kg", "inclination: 30 deg"))
    upright, inclined = (
        compare(asked(studio, [isotonic("nominal_length: 300 mm", *said)])).rmse for said in lines
    )
    assert upright == pytest.approx(inclined)


def test_files_of_forces_and_strokes_are_refused_together(studio: Studio) -> None:
    with pytest.raises(InputError, match="is isotonic"):
        asked(studio, [specimen(0.2), isotonic("load_mass: 5 kg", "nominal_length: 300 mm")])


def test_forces_measured_at_held_lengths_and_held_pressures_are_one_question(studio: Studio) -> None:
    texts = [specimen(0.2), plateaus(np.zeros(4))]
    result = compare(asked(studio, texts))
    assert result.kind == "static"
    alone = [compare(asked(studio, [text])) for text in texts]
    squares = sum(each.rmse**2 * each.rows_used for each in alone)
    assert result.rows_used == sum(each.rows_used for each in alone)
    assert result.rmse == pytest.approx((squares / result.rows_used) ** 0.5, rel=1e-6)


def test_a_preset_measurement_brings_its_own_length(studio: Studio) -> None:
    points = find_preset("martens-dmsp-10-250", studio.library)
    assert points is not None
    question = question_of(
        model_of_question(studio, {"preset": "DMSP-10"}), [QuestionMeasurement(points)], studio, strict=True
    )
    rest = question.specimens.each[0].experiment["rest_length"]
    assert (rest.value, rest.origin, rest.where) == (0.25, "preset", "martens-dmsp-10-250")
    assert question.start.muscle.nominal_length == 0.25


def test_a_specimen_of_another_preset_has_its_geometry(studio: Studio) -> None:
    said = {"muscle": ExperimentValue("DMSP-10", "", "you", "here")}
    measurements = [
        QuestionMeasurement(Points(read_measurement(specimen(0.25).encode(), "a.csv"))),
        QuestionMeasurement(Points(read_measurement(specimen(0.25).encode(), "b.csv")), said),
    ]
    question = question_of(model_of_question(studio, {"preset": "DMSP-20"}), measurements, studio)
    wide, thin = (each.muscle for each in question.specimens.each)
    assert wide.braid_diameter == studio.facts("DMSP-20").muscle.braid_diameter
    assert thin.braid_diameter == studio.facts("DMSP-10").muscle.braid_diameter
    assert wide.nominal_length == thin.nominal_length == 0.25
