"""A muscle whose force nobody knows from a curve comes behind all others, and the reason is said."""

from __future__ import annotations

from typing import Any

import pytest

from mckibben.documents.studio import Studio
from mckibben.presets import MusclePreset
from tests.sizing.conftest import sized

PARTS = {"valves": ["MPYE-5-M5"], "tubes": ["PUN-H-4x0.75"]}
EASY: dict[str, Any] = {
    "load": {"mass": "3 kg"}, "stroke": "15 mm", "catalogue": PARTS, "uncertainty": {"specimens": 0},
}  # fmt: skip
JOINT: dict[str, Any] = {
    "load": {"pair": {"angle": "40 deg", "torque": "0.5 N*m", "inertia": 0.001, "pulley_radius": "15 mm"}},
    "time": "0.5 s", "catalogue": PARTS, "uncertainty": {"specimens": 0},
}  # fmt: skip


@pytest.mark.parametrize(
    ("task", "order"),
    [(EASY, "air"), (EASY, "time"), (EASY, "balanced"), (JOINT, "air")],  # each order, each kind of load
    ids=["lift-air", "lift-time", "lift-balanced", "joint-air"],
)
def test_it_comes_last_even_where_it_is_the_best(studio: Studio, task: dict[str, Any], order: str) -> None:
    found = sized({**task, "rank_by": order}, studio)["proposals"]
    names = [item["muscle"] for item in found]
    assert "DMSP-5" in names
    assert names[0] != "DMSP-5"
    first = names.index("DMSP-5")
    assert set(names[first:]) == {"DMSP-5"}
    if order == "air":
        assert min(found, key=lambda item: item["air_volume_anr"])["muscle"] == "DMSP-5"
    for item in found[first:]:
        assert "behind all others: no force curve of this size is known" in item["reason"]
        assert any("Test a sample of DMSP-5 first" in note for note in item["notes"])
    assert not any("behind all others" in item["reason"] for item in found[:first])


def test_it_is_proposed_when_the_task_names_no_other(studio: Studio) -> None:
    task = {**EASY, "catalogue": {**PARTS, "muscles": ["DMSP-5"]}}
    found = sized(task, studio)["proposals"]
    assert found
    assert all("no force curve of this size is known" in item["reason"] for item in found)


def test_every_muscle_without_a_curve_of_its_own_says_so(studio: Studio) -> None:
    """A screwed muscle has the curve of the press-fitted one, with which it shares its whole model."""
    presets = [preset for preset in studio.library.list("muscles") if isinstance(preset, MusclePreset)]
    models = {preset.id: repr((preset.effect_values(), studio.facts(preset.id).muscle)) for preset in presets}
    known = {models[preset.id] for preset in presets if preset.reference_curve or preset.measurement}
    for preset in presets:
        assert (preset.extrapolated is None) == (models[preset.id] in known), preset.id


def test_a_rejection_names_the_tube_it_means(studio: Studio) -> None:
    parts = {"muscles": ["DMSP-40"], "valves": ["MPYE-5-M5"], "tubes": ["PUN-H-4x0.75", "PUN-H-6x1"]}
    task = {**EASY, "load": {"mass": "100 kg"}, "stroke": "60 mm", "time": "0.2 s", "catalogue": parts}
    rejected = [item for item in sized(task, studio)["rejected"] if item["tube"]]
    assert {item["tube"] for item in rejected} == {"PUN-H-4x0.75", "PUN-H-6x1"}
    assert all(f"with {item['valve']} and {item['tube']}: " in item["why"] for item in rejected)
