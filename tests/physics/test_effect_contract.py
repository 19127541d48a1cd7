"""Every claim of every effect of the catalogue; an effect of a further folder is held to the same."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path

import pytest

from mckibben.application.effect import claims, runs, slots
from mckibben.application.effect.states import acts_on_muscle
from mckibben.physics.catalogue import BUILT_IN_FOLDER, EffectCatalogue, default_catalogue
from mckibben.physics.effect import Effect

EFFECTS = list(default_catalogue().values())


@pytest.mark.parametrize(
    ("effect", "check"),
    [
        pytest.param(effect, check, id=f"{effect.id}-{check.__name__.removeprefix('check_')}")
        for effect in EFFECTS
        for check in claims.checks_of(effect)
    ],
)
def test_claim_holds(effect: Effect, check: Callable[[Effect], None]) -> None:
    check(effect)


def test_files_stay_small() -> None:
    for path in BUILT_IN_FOLDER.glob("*.py"):
        assert len(path.read_text(encoding="utf-8").splitlines()) <= 170, path.name


def test_effect_of_a_further_folder_is_held_to_the_same(tmp_path: Path) -> None:
    source = (BUILT_IN_FOLDER / "linear_elasticity.py").read_text(encoding="utf-8")
    (tmp_path / "shop_spring.py").write_text(source, encoding="utf-8")
    catalogue = EffectCatalogue([tmp_path])
    assert catalogue.problems == []
    for check in claims.checks_of(catalogue["shop_spring"]):
        check(catalogue["shop_spring"])


@pytest.mark.parametrize(
    ("claim", "check"),
    [
        ({"direction": "odd"}, claims.check_direction),
        ({"direction": None}, claims.check_direction),
        ({"pressure_power": 1.0}, claims.check_pressure_power),
        ({"pressure_power": None}, claims.check_pressure_power),
        ({"zero_at": ("zero_pressure",)}, claims.check_zero_states),
        ({"energy": "dissipative"}, claims.check_energy),
        ({"energy": "lumped"}, claims.check_energy),
    ],
)
def test_false_claim_is_found(claim: dict, check: Callable[[Effect], None]) -> None:
    honest = default_catalogue()["linear_elasticity"]
    check(honest)
    lying = dataclasses.replace(honest, signature=dataclasses.replace(honest.signature, **claim))
    with pytest.raises(AssertionError):
        check(lying)


@pytest.mark.parametrize(
    ("effect_id", "claim", "check"),
    [
        ("dahl", {"direction": "even"}, runs.check_mirrored_motion),
        ("dahl", {"pressure_power": 1.0}, runs.check_power_over_run),
        ("dahl", {"zero_at": ()}, runs.check_shows_in_runs),
        ("dahl", {"energy": "lumped"}, runs.check_work_of_run),
        ("pressure_hysteresis", {"pressure_power": 0.0}, runs.check_power_over_run),
        ("pressure_hysteresis", {"zero_at": ("no_motion",)}, runs.check_shows_in_runs),
        ("pressure_hysteresis", {"energy": "dissipative"}, runs.check_work_of_run),
        ("leak", {"energy": "reading"}, runs.check_drive_claims),
        ("leak", {"direction": "odd"}, runs.check_drive_claims),
    ],
)
def test_false_claim_over_time_is_found(effect_id: str, claim: dict, check: Callable[[Effect], None]) -> None:
    honest = default_catalogue()[effect_id]
    check(honest)
    lying = dataclasses.replace(honest, signature=dataclasses.replace(honest.signature, **claim))
    with pytest.raises(AssertionError):
        check(lying)


def test_effect_that_is_not_off_at_its_off_values_is_found() -> None:
    for effect_id, name in (("leak", "conductance"), ("flow_coefficient", "factor"), ("dahl", "force")):
        honest = default_catalogue()[effect_id]
        parameters = tuple(
            dataclasses.replace(p, off=p.default) if p.name == name else p for p in honest.parameters
        )
        lying = dataclasses.replace(honest, parameters=parameters)
        on_muscle = acts_on_muscle(honest)
        check = claims.check_off_is_ideal if on_muscle else slots.check_off_leaves_slots_alone
        check(honest)
        with pytest.raises(AssertionError):
            check(lying)


@pytest.mark.parametrize(
    "kinds", [{"isobaric"}, {"isobaric", "isometric", "isotonic", "static", "transient", "diameter"}]
)
def test_false_kinds_are_found(kinds: set[str]) -> None:
    lying = dataclasses.replace(default_catalogue()["linear_elasticity"], kinds=frozenset(kinds))
    with pytest.raises(AssertionError):
        claims.check_kinds(lying)
