"""A large muscle is diagnosed as a small one with the same friction for its size."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest

from mckibben.identification.diagnose.diagnosis import diagnose
from mckibben.identification.diagnose.words import bounds_sentence
from tests.benchmarks.diagnosis import subject_and_start, true_floor
from tests.shipped import shipped_studio
from tests.truth import friction
from tests.truth.cases import Case
from tests.truth.composition import Truth
from tests.truth.elastic_cases import FOUR
from tests.truth.experiments import isobaric
from tests.truth.laboratory import case_of, usual_noise
from tests.truth.muscle import Muscle

SHARE = 0.06  # friction over the blocked force


def rubbing(diameter: float, share: float = SHARE) -> Case:
    """Loops of a muscle of a diameter [m] that rubs; the noise is the same share of its force as well."""
    rng = np.random.default_rng(0)
    muscle = Muscle(0.3, diameter, radians(26.0), 1.8e-3, diameter - 1.8e-3)
    rub = friction.bristles(share * muscle.blocked, 6e-5, "coulomb_friction", "dahl", "bouc_wen", rise=0.0)
    truth = Truth(muscle, hidden=(rub,))
    noise = usual_noise(truth, rng, force=0.001)
    record = isobaric(truth, levels=FOUR, speeds=(0.002, 0.02))
    return case_of("rubbing", 0, truth, record, "isobaric", rng, noise=noise)


@pytest.mark.examination("test_bounds_in_newtons_are_a_share_of_the_force_of_a_strong_muscle")
def test_friction_of_a_share_of_the_force_has_its_name_at_every_size() -> None:
    studio = shipped_studio()
    left = []
    for diameter in (12e-3, 40e-3):
        case = rubbing(diameter)
        predictor, start = subject_and_start(case, studio)
        found = diagnose(predictor, start, catalogue=studio.catalogue)
        assert found.added == ("coulomb_friction",)
        assert found.status == "missing_effects"
        assert found.best.rmse <= 1.15 * true_floor(case, predictor)
        assert bounds_sentence(found, studio.catalogue) == ""
        left.append(found.best.rmse / found.start.rmse)
    assert left[0] == pytest.approx(left[1], rel=1e-2), "the same share of the error"


def test_bounds_in_newtons_are_a_share_of_the_force_of_a_strong_muscle() -> None:
    """294 N of friction in a muscle of 4.9 kN are 6 % as 30 N in one of 0.5 kN, and found as those are."""
    case = rubbing(37.5e-3)
    studio = shipped_studio()
    predictor, start = subject_and_start(case, studio)
    assert start.size.force == pytest.approx(4.9e3 * 8.0 / 6.0, rel=0.05), "at 8 bar"
    friction_alone = {"coulomb_friction": studio.catalogue["coulomb_friction"]}
    found = diagnose(predictor, start, catalogue=friction_alone)
    assert found.best.fit_model.number("coulomb_friction.force") == pytest.approx(SHARE * 4.9e3, rel=0.01)
    assert found.best.rmse <= 1.15 * true_floor(case, predictor)
    assert bounds_sentence(found, studio.catalogue) == ""
