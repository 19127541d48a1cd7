"""Experiments that would separate models: what the catalogue says, and the proposals in words."""

from __future__ import annotations

import pytest

from mckibben.identification.diagnose.design import Designer
from mckibben.identification.diagnose.next_measurement import (
    SeparatingExperiment,
    declared,
    next_measurements,
)
from mckibben.identification.diagnose.twins import Alternative
from tests.identification.diagnose.test_design import TESTS, model
from tests.identification.synthetic import CATALOGUE


def test_the_catalogue_says_it_from_either_side() -> None:
    twin = declared(CATALOGUE["prestress"], CATALOGUE["force_offset"])
    assert twin is not None
    assert "muscle removed" in twin.separated_by
    assert not twin.by_muscle_test
    assert declared(CATALOGUE["force_offset"], CATALOGUE["prestress"])
    assert declared(CATALOGUE["prestress"], CATALOGUE["valve_delay"]) is None


def test_pairs_that_no_muscle_test_separates_are_declared_so_on_both_sides() -> None:
    pairs = {
        (effect.id, twin.effect)
        for effect in CATALOGUE.values()
        for twin in effect.confused_with
        if not twin.by_muscle_test
    }
    assert pairs == {(second, first) for first, second in pairs}
    # Braid and force sensor, pressure and its sensor: each pair is one product or sum.
    assert {frozenset(pair) for pair in pairs} == {
        frozenset(("prestress", "force_offset")), frozenset(("effectiveness", "pressure_scale")),
    }  # fmt: skip


def test_a_proposal_in_words() -> None:
    proposal = SeparatingExperiment("a", "b", "pull it slowly", "loops", 4.26)
    assert proposal.sentence({"a": "Alpha", "b": "Beta"}) == (
        "to tell Alpha from Beta: pull it slowly; simulated best: loops (4.3 sigma apart)"
    )
    assert (
        SeparatingExperiment("a", "b", "", "", 0.0).sentence({}) == "to tell a from b: no experiment is known"
    )
    near = SeparatingExperiment("a", "b", "remove the muscle", "any", 0.2).sentence({})
    assert near == "to tell a from b: remove the muscle; no experiment with this rig does"
    never = SeparatingExperiment("a", "b", "weigh it", "any", 0.2, by_muscle_test=False).sentence({})
    assert never == "to tell a from b: weigh it"
    none = SeparatingExperiment("a", "b", "", "any", 0.2).sentence({})
    assert none == "to tell a from b: no experiment with this rig does, and no other one is known"


def test_each_pair_has_its_experiment_and_whether_it_matters() -> None:
    best = model(coulomb_friction={"force": 15.0})
    others = [
        Alternative(
            "coulomb_friction", "viscous_damping", 0.3, model(viscous_damping={"coefficient": 300.0})
        ),
        Alternative("coulomb_friction", "dahl", 0.3, model(dahl={"force": 15.0})),
    ]
    pairs, designs = next_measurements(Designer(TESTS, 1.0), best, others, CATALOGUE)
    assert [(pair.first, pair.second) for pair in pairs] == [
        ("coulomb_friction", "viscous_damping"), ("coulomb_friction", "dahl"),
    ]  # fmt: skip
    # A damping of 15, 1.5 and 0.15 N at the three speeds; a constant friction can only take their mean.
    assert pairs[0].separation == pytest.approx(15.0 - 16.65 / 3.0, rel=0.03)
    assert pairs[0].matters
    assert pairs[0].minutes is not None
    assert {one.group for one in designs} == {("coulomb_friction", "viscous_damping", "dahl")}
    # Small reversals show what yields before it slides, other speeds what depends on them.
    assert {pair for one in designs for pair in one.decided()} >= {
        ("coulomb_friction", "viscous_damping"), ("viscous_damping", "dahl"),
    }  # fmt: skip
