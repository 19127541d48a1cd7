"""Every claim of every effect of the catalogue; an effect of a further folder is held to the same."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from latex2mathml.converter import convert

from mckibben.physics.catalogue import BUILT_IN_FOLDER, EffectCatalogue, default_catalogue
from mckibben.physics.effect import Effect
from mckibben.physics.units import si
from tests.physics import contract, contract_dynamic, contract_slots
from tests.physics.contract_states import acts_on_muscle

# Effects that exist or are planned; a twin may be named before its file is written.
KNOWN_IDS = frozenset(  # one block of words reads better than fifty quoted lines
    """
    effectiveness contraction_factor end_caps lost_stroke braid_stiffening wall_thickness thread_extensibility
    braid_lock bladder_elasticity linear_elasticity prestress threshold_pressure mullins creep pressure_creep
    temperature self_heating pressure_lag force_thermal force_drift
    coulomb_friction pressure_friction contact_friction dahl bouc_wen maxwell_slip pressure_hysteresis
    viscous_damping guide_friction dead_volume heat_exchange leak valve_delay spool_lag valve_deadband
    valve_hysteresis flow_coefficient exhaust_restriction silencer tube_resistance tube_delay supply_droop
    pressure_offset pressure_scale force_offset force_scale length_offset sensor_lag time_skew wall_volume
    moving_mass rig_compliance load_scale custom
    """.split()  # noqa: SIM905
)

EFFECTS = list(default_catalogue().values())
each_effect = pytest.mark.parametrize("effect", EFFECTS, ids=[effect.id for effect in EFFECTS])


@pytest.mark.parametrize(
    ("effect", "check"),
    [
        pytest.param(effect, check, id=f"{effect.id}-{check.__name__.removeprefix('check_')}")
        for effect in EFFECTS
        for check in contract.checks_of(effect)
    ],
)
def test_claim_holds(effect: Effect, check: Callable[[Effect], None]) -> None:
    check(effect)


@each_effect
def test_texts_are_there_and_render(effect: Effect) -> None:
    for text in (effect.title, effect.cause, effect.signature.text):
        assert text.strip() == text
        assert len(text) > 3
    assert re.fullmatch(r"[^.]+\. [^.]+\.|(?:[^.]|\.\d)+\. (?:[^.]|\.\d)+\.", effect.cause), "two sentences"
    for latex in (effect.equation, *(parameter.symbol for parameter in effect.parameters)):
        assert convert(latex).startswith("<math")
    for parameter in effect.parameters:
        assert parameter.description.endswith(".")
        text = "0.5" if parameter.unit == "1" else f"0.5 {parameter.unit}"
        assert si(text, parameter.unit) == 0.5, "the unit is one that users may type"
    for function in effect.slots.values():
        assert function.__doc__
        assert function.__globals__["__doc__"]


@each_effect
def test_shows_at_its_default(effect: Effect) -> None:
    assert effect.defaults != effect.off
    assert any(parameter.fitted for parameter in effect.parameters)


@each_effect
def test_twins_exist_and_are_separable(effect: Effect) -> None:
    for twin in effect.confused_with:
        assert twin.effect in KNOWN_IDS
        assert twin.effect != effect.id
        assert len(twin.separated_by) > 10


def test_ids_are_known() -> None:
    assert set(default_catalogue()) <= KNOWN_IDS


def test_files_stay_small() -> None:
    for path in BUILT_IN_FOLDER.glob("*.py"):
        assert len(path.read_text(encoding="utf-8").splitlines()) <= 170, path.name


def test_effect_of_a_further_folder_is_held_to_the_same(tmp_path: Path) -> None:
    source = (BUILT_IN_FOLDER / "linear_elasticity.py").read_text(encoding="utf-8")
    (tmp_path / "shop_spring.py").write_text(source, encoding="utf-8")
    catalogue = EffectCatalogue([tmp_path])
    assert catalogue.problems == []
    for check in contract.checks_of(catalogue["shop_spring"]):
        check(catalogue["shop_spring"])


@pytest.mark.parametrize(
    ("claim", "check"),
    [
        ({"direction": "odd"}, contract.check_direction),
        ({"direction": None}, contract.check_direction),
        ({"pressure_power": 1.0}, contract.check_pressure_power),
        ({"pressure_power": None}, contract.check_pressure_power),
        ({"zero_at": ("zero_pressure",)}, contract.check_zero_states),
        ({"energy": "dissipative"}, contract.check_energy),
        ({"energy": "lumped"}, contract.check_energy),
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
        ("dahl", {"direction": "even"}, contract_dynamic.check_mirrored_motion),
        ("dahl", {"pressure_power": 1.0}, contract_dynamic.check_power_over_run),
        ("dahl", {"zero_at": ()}, contract_dynamic.check_shows_in_runs),
        ("dahl", {"energy": "lumped"}, contract_dynamic.check_work_of_run),
        ("pressure_hysteresis", {"pressure_power": 0.0}, contract_dynamic.check_power_over_run),
        ("pressure_hysteresis", {"zero_at": ("no_motion",)}, contract_dynamic.check_shows_in_runs),
        ("pressure_hysteresis", {"energy": "dissipative"}, contract_dynamic.check_work_of_run),
        ("leak", {"energy": "reading"}, contract_dynamic.check_drive_claims),
        ("leak", {"direction": "odd"}, contract_dynamic.check_drive_claims),
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
        check = contract.check_off_is_ideal if on_muscle else contract_slots.check_off_leaves_slots_alone
        check(honest)
        with pytest.raises(AssertionError):
            check(lying)


@pytest.mark.parametrize(
    "kinds", [{"isobaric"}, {"isobaric", "isometric", "isotonic", "static", "transient", "diameter"}]
)
def test_false_kinds_are_found(kinds: set[str]) -> None:
    lying = dataclasses.replace(default_catalogue()["linear_elasticity"], kinds=frozenset(kinds))
    with pytest.raises(AssertionError):
        contract.check_kinds(lying)
