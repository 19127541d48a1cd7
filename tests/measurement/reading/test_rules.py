"""Each rule is found in its own example."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading.evidence import evidence_of
from mckibben.measurement.reading.heads import head_claims, taken_apart
from mckibben.measurement.reading.lexicon import Rule, all_rules, pattern_of, word_set
from mckibben.measurement.reading.model import Column, Span, Table
from mckibben.measurement.reading.scales import answered_scale, scales_in, valve_scale
from mckibben.measurement.reading.units import quantities, unit_of

RULES = all_rules()


def claimed(rule: Rule) -> set[str]:
    """The rules that are found in the example of a rule."""
    if rule.on == "head":
        heads = [rule.example] if not rule.dimension else [f"{rule.example} [{u}]" for u in ("mm", "kg", "N")]
        return {claim.rule for head in (*heads, rule.example) for claim in head_claims(head)}
    heads = (
        ("", "p_muscle [V]", "")
        if rule.id == "column_list"
        else ("t", "p", "x", "CH1 pressure [V]", "U_p [V]")
    )
    columns = tuple(Column(head, np.arange(9.0) ** 2, "column") for head in heads)
    table = Table(columns, (Span("line 1", rule.example),), np.zeros(9, np.intp))
    return {claim.rule for claim in evidence_of(table, "a.csv")}


@pytest.mark.parametrize("rule", RULES, ids=[rule.id for rule in RULES])
def test_a_rule_is_found_in_its_example(rule: Rule) -> None:
    if "scale" in rule.claims:
        assert rule.id in {scale.rule for scale, _ in scales_in(rule.example)}
    elif rule.id in ("legend", "column_list"):  # they claim what the heads that they give do
        assert pattern_of(rule).search(rule.example)
        assert len(claimed(rule)) > 1
    elif rule.on == "text" and "role" in rule.claims:  # of the columns that such a text is about
        assert pattern_of(rule).search(rule.example)
    else:
        assert rule.id in claimed(rule)


def test_names_of_rules_differ() -> None:
    assert len({rule.id for rule in RULES}) == len(RULES)


@pytest.mark.parametrize(
    ("head", "name", "unit", "absolute"),
    [
        ("Innendruck (Ü)", "Innendruck", None, False),
        ("Kraft_N_", "Kraft", "N", None),
        ("p/bar", "p", "bar", None),
        ("Druck, bar (abs)", "Druck", "bar", True),
        ("t (in ms)", "t", "ms", None),
        ("p [mbar, gauge]", "p", "mbar", False),
        ("pressure_bar_unclipped", "pressure_unclipped", "bar", None),
        ("velocity_mm/s", "velocity", "mm/s", None),
        ("Length (mm) inflating", "Length inflating", "mm", None),
        ("Kraft in N", "Kraft", "N", None),
        ("weight [g]", "weight", "g", None),
        ("Sensor A", "Sensor A", None, None),
        ("psig", "psig", "psi", False),
    ],
)
def test_heads_are_taken_apart(head: str, name: str, unit: str | None, absolute: bool | None) -> None:
    found = taken_apart(head)
    assert (found.name, found.unit and found.unit.name, found.absolute) == (name, unit, absolute)


def test_the_end_of_a_compound_says_what_it_is() -> None:
    channels = {claim.value for claim in head_claims("Kraftweg [mm]") if claim.facet == "channel"}
    assert channels == {"displacement"}
    assert {claim.value for claim in head_claims("Solldruck [bar]") if claim.facet == "role"} == {"set value"}


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("Ruhelänge 290 mm", [(290.0, "mm")]),
        ("L0 [mm]: 250", [(250.0, "mm")]),
        ("L0_mm: 250", [(250.0, "mm")]),
        ("load 6 kg, 3 bar (abs)", [(6.0, "kg"), (3.0, "bar")]),
        ("step_L360mm", [(360.0, "mm")]),
        ("L0;cm;18.5", [(18.5, "cm")]),
        ("120 at the end", []),
        ("v1.3 of 2024", []),
    ],
)
def test_quantities_of_texts(text: str, wanted: list[tuple[float, str]]) -> None:
    assert [(q.value, q.unit.name) for q in quantities(text)] == wanted


def test_units_in_other_letters() -> None:
    names = {
        text: unit.name for text in ("ｋＰａ", "мм", "Mpa", "mPa", "kgf/cm²", "°C") if (unit := unit_of(text))
    }
    assert names == {
        "ｋＰａ": "kPa",
        "мм": "mm",
        "Mpa": "MPa",
        "mPa": "mPa",
        "kgf/cm²": "kgf/cm2",
        "°C": "degC",
    }
    assert unit_of("Kraft") is None
    assert unit_of("t") is None


@pytest.mark.parametrize(
    ("text", "at", "value"),
    [
        ("0-10 V = 0-10 bar", 5.0, 5.0),
        ("1 V = 2 bar", 1.5, 3.0),
        ("0.5 bar/V", 4.0, 2.0),
        ("4-20 mA = 0-10 bar", 12.0, 5.0),
        ("0 to 72 mm = 228 to 300 mm", 36.0, 264.0),
    ],
)
def test_scales_that_a_user_says(text: str, at: float, value: float) -> None:
    scale = answered_scale(text)
    assert scale is not None
    assert scale.factor * (at - scale.offset) == pytest.approx(value)


def test_the_states_of_a_valve_are_a_scale() -> None:
    scale = valve_scale("Válvula: 0 V = vaciado, 5 V = cerrada, 10 V = llenado")
    assert scale is not None
    assert [scale.factor * (v - scale.offset) for v in (0.0, 5.0, 10.0)] == [-1.0, 0.0, 1.0]


def test_words_of_all_languages_are_known() -> None:
    assert word_set("at_rest").among(("ruhelage",))
    assert word_set("@pressure").among(("prufdruck",))
    assert not word_set("@pressure").among(("eindruckl",))
