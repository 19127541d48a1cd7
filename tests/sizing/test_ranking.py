"""The order of proposals, their reservations, and the sentence that says why the first comes first."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from mckibben.sizing.proposal import Chance, Proposal
from mckibben.sizing.ranking import ranked, reservations, why_first
from mckibben.sizing.task import DesignLimits, Task

AIR, SURE = Task(rank_by="air"), Task(rank_by="probability")


def proposal(
    name: str,
    *,
    air: float,
    probability: float = 0.99,
    error: float = 0.01,
    margin: float = 0.3,
    impacts: tuple[float, float] = (1.0, 1.0),
    extrapolated: str | None = None,
    length: float = 0.3,
) -> Proposal:
    """A proposal with only what ranks it."""
    muscle = SimpleNamespace(id=name, extrapolated=extrapolated)
    design = SimpleNamespace(group=SimpleNamespace(muscle=muscle, parallel=1, muscles=1), length=length)
    rest = SimpleNamespace(capacity=[1.5], stiffness=[1e4])
    trial: Any = SimpleNamespace(
        design=design,
        margins={"contraction": margin},
        binding="contraction",
        air=air,
        rest=rest,
        figures=SimpleNamespace(time=0.4),
        force_reserve=0.5,
        worth=lambda: air,
    )
    return Proposal(trial, impacts, 0.1, 0.2, 1e5, 2e5, chance=Chance(probability, error, 100))


def order(*proposals: Proposal, task: Task = SURE) -> list[str]:
    return [item.design.group.muscle.id for item in ranked(list(proposals), task)]


def test_a_difference_within_the_uncertainty_is_a_tie_and_goes_by_what_the_task_ranks_by() -> None:
    # 95 % and 93 % with standard errors of 2 % cannot be told apart: the one with less air comes first.
    dear = proposal("dear", air=2.19e-3, probability=0.95, error=0.02)
    cheap = proposal("cheap", air=1.15e-3, probability=0.93, error=0.02)
    assert order(dear, cheap) == order(cheap, dear) == ["cheap", "dear"]
    sentence = why_first(ranked([dear, cheap], SURE), SURE)
    assert sentence is not None
    assert sentence.startswith(
        "cheap comes before dear: the shares of specimens that succeed, 93 ± 2 % and 95 ± 2 % (± standard "
    )
    assert "1.15 l of air a cycle, not 2.19 l" in sentence


def test_a_difference_beyond_the_uncertainty_counts() -> None:
    sure = proposal("sure", air=2e-3, probability=0.99, error=0.005)
    unsure = proposal("unsure", air=1e-3, probability=0.9, error=0.01)
    assert order(unsure, sure) == ["sure", "unsure"]
    assert "99 ± 0.5 % of its specimens succeed, not 90 ± 1 %" in str(
        why_first(ranked([sure, unsure], SURE), SURE)
    )


def test_a_drive_that_probably_fails_comes_last_even_without_reservations() -> None:
    fails = proposal("fails", air=1e-3, probability=0.5)
    thin = proposal("thin", air=2e-3, margin=0.01)
    assert order(fails, thin) == ["thin", "fails"]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"margin": 0.01}, "only 1 % margin to the limit of contraction"),
        ({"impacts": (7.0, 1.0)}, "impact of 7 J on the stroke"),
        ({"impacts": (3.0, 7.0)}, "impact of 7 J on the return"),  # the stroke is gentle, the return is not
    ],
)
def test_a_thin_margin_and_a_hard_impact_cost_rank(changes: dict[str, Any], words: str) -> None:
    task = replace(SURE, limits=DesignLimits(max_impact_energy=5.0))
    worse = proposal("worse", air=1e-3, probability=0.999, error=1e-3, **changes)
    better = proposal("better", air=2e-3, probability=0.95, error=0.01)
    assert order(worse, better, task=task) == ["better", "worse"]
    assert words in reservations(worse, task)[0]
    assert words in ranked([worse, better], task)[1].reason
    assert words in str(why_first(ranked([worse, better], task), task))


def test_an_impact_costs_nothing_where_the_task_states_no_limit() -> None:
    assert reservations(proposal("hard", air=1e-3, impacts=(100.0, 100.0)), SURE) == ()


def test_a_muscle_whose_force_nobody_knows_is_never_first() -> None:
    unknown = proposal("unknown", air=1e-4, extrapolated="its force is scaled from another size")
    known = proposal("known", air=2e-3, probability=0.85, margin=0.01)
    assert order(unknown, known) == ["known", "unknown"]
    assert "the force of the second is not known" in str(why_first(ranked([unknown, known], SURE), SURE))


def test_one_proposal_needs_no_sentence() -> None:
    assert why_first([proposal("alone", air=1e-3)], SURE) is None


def test_a_task_that_ranks_by_air_has_its_drives_in_that_order() -> None:
    """A thin margin and a low probability are said; they do not change what was asked for."""
    thin = proposal("thin", air=1e-3, margin=0.01, probability=0.6)
    safe = proposal("safe", air=2e-3)
    assert order(safe, thin, task=AIR) == ["thin", "safe"]
    assert "only 1 % margin" in ranked([safe, thin], AIR)[0].reason
    assert "1 l of air a cycle, not 2 l" in str(why_first(ranked([safe, thin], AIR), AIR))
    stated = replace(AIR, limits=DesignLimits(max_impact_energy=5.0))
    hard = proposal("hard", air=1e-3, impacts=(7.0, 1.0))
    assert order(hard, safe, task=stated) == ["safe", "hard"], "a stated limit is one"
    assert "impact of 7 J" in str(why_first(ranked([hard, safe], stated), stated))
