"""The diagnosis on data whose hidden effect follows other formulas than ours.

A choice of cases of `tests.truth`, each kind of experiment and of effect;
`python -m tests.benchmarks.diagnosis` runs all of them with three seeds.
"""

from __future__ import annotations

import pytest

from mckibben.identification.diagnose.diagnosis import Diagnosis, diagnose
from tests.benchmarks.diagnosis import diagnosed, subject_and_start
from tests.shipped import shipped_studio
from tests.truth.generate import case

FOUND = (
    "threshold-isometric",
    "end-caps-isobaric",
    "pressure-zero-isobaric",
    "force-zero-isobaric",
    "length-zero-diameter",
    "silencer-steps",
    "joint-angle-zero-cam",
)
LONG = ("coulomb-isobaric", "delay-pulses")
TOGETHER = (
    "pair-bladder-ends-isobaric",
    "pair-bladder-length-zero-map",
)
NOTHING = (
    "nothing-isobaric",
    "nothing-thread-form-map",
    "nothing-steps",
    "joint-nothing-pair",
)
UNKNOWN = ("unknown-magnet-map",)


@pytest.mark.parametrize("name", FOUND)
def test_a_single_hidden_effect_is_found_and_the_error_falls_to_the_noise(name: str) -> None:
    line = diagnosed(case(name, 0))
    assert not line.problem
    assert line.right, line
    assert line.after <= 1.15, line
    assert line.status in ("missing_effects", "ambiguous")


@pytest.mark.examination("test_a_single_hidden_effect_is_found_and_the_error_falls_to_the_noise")
@pytest.mark.parametrize("name", LONG)
def test_a_hidden_effect_of_many_rows_is_found_as_well(name: str) -> None:
    test_a_single_hidden_effect_is_found_and_the_error_falls_to_the_noise(name)


@pytest.mark.parametrize("name", TOGETHER)
def test_hidden_effects_are_found_together(name: str) -> None:
    line = diagnosed(case(name, 0))
    assert line.right, line
    assert line.after <= 1.15, line


@pytest.mark.parametrize("name", NOTHING)
def test_nothing_is_said_to_be_missing_when_nothing_is(name: str) -> None:
    line = diagnosed(case(name, 0))
    assert line.status == "adequate", line
    assert line.named == []


@pytest.mark.parametrize("name", UNKNOWN)
def test_what_no_catalogue_holds_is_said_to_be_unknown(name: str) -> None:
    line = diagnosed(case(name, 0))
    assert line.status == "unknown_effect", line


def found_in(name: str, seed: int) -> Diagnosis:
    """The whole diagnosis of a case."""
    studio = shipped_studio()
    predictor, start = subject_and_start(case(name, seed), studio)
    return diagnose(predictor, start, catalogue=studio.catalogue)


def test_a_first_answer_is_streamed_before_slower_effects_and_each_effect_once() -> None:
    """A plain restriction needs no equations of its own; the silencer, which fits better, follows it."""
    studio, streamed = shipped_studio(), []
    predictor, start = subject_and_start(case("silencer-steps", 0), studio)
    diagnose(
        predictor, start, catalogue=studio.catalogue, on_candidate=lambda one: streamed.append(one.effect.id)
    )
    assert streamed[0] == "exhaust_restriction"
    assert "silencer" in streamed[1:]
    assert len(set(streamed)) == len(streamed)


def test_a_law_between_two_pure_ones_that_fits_no_better_is_the_pure_one() -> None:
    """The regulator refills with the root of its droop; the data fit an exponent of 0.71 as well."""
    found = found_in("supply-droop-steps", 0)
    assert found.added == ("supply_droop",)
    assert found.best.fit_model.values["supply_droop"]["exponent"] == 0.5
    assert "supply_droop.exponent" not in found.best.freed


@pytest.mark.examination("test_a_single_hidden_effect_is_found_and_the_error_falls_to_the_noise")
def test_an_exchange_that_is_worse_beside_the_corrections_is_not_made() -> None:
    """Without the silencer, whose part is small, prestress fits better than the load that is hidden."""
    found = found_in("triple-delay-silencer-load-pulses", 1)
    assert set(found.best.fit_model.ids) >= {"valve_delay", "silencer"}
    assert {"load_scale", "effectiveness"} & set(found.added)
    assert found.best.rmse < 1.1 * found.noise
