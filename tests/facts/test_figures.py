"""The declared figures: keys, units, definitions, and what is said where one does not exist."""

from __future__ import annotations

import pytest

from mckibben.facts.comparison import TIMES_NOISE, error_scale
from mckibben.facts.figure import Figure
from mckibben.facts.groups import FIGURES, GROUPS
from mckibben.facts.units import QUANTITIES, probability_text
from mckibben.physics.units import si


@pytest.mark.parametrize("figure", FIGURES.values(), ids=FIGURES)
def test_a_figure_is_complete(figure: Figure) -> None:
    assert figure.label == figure.label.strip()
    assert figure.label[:1].isupper() or figure.label[:1] in "…±"
    assert figure.definition.endswith(".")
    assert "  " not in figure.definition
    condition = figure.exists_when
    assert (condition.otherwise == "") == (condition.name == "always")
    assert not condition.otherwise.endswith(".")
    if figure.unit not in ("", "1"):
        assert si(f"1 {figure.unit}", figure.unit) == 1.0
    if figure.quantity:  # a level in dB is that of a gain in any unit
        assert QUANTITIES[figure.quantity].unit == (figure.unit or "1")
    elif not figure.unit:
        assert figure.shown_as is None


def test_keys_name_group_and_figure() -> None:
    assert len(FIGURES) == sum(map(len, GROUPS.values()))
    for group in GROUPS.values():
        for name, figure in group.items():
            assert FIGURES[f"{group.name}.{name}"] is figure


def test_errors_are_shown_in_the_unit_of_the_channel() -> None:
    assert error_scale("1") == TIMES_NOISE
    assert error_scale("m").of(0.012) == pytest.approx(12.0)
    assert error_scale("Pa").of(2e5) == pytest.approx(2.0)
    assert error_scale("N").unit == "N"


@pytest.mark.parametrize(
    ("probability", "text"),
    [(0.0, "< 1 %"), (0.0099, "< 1 %"), (0.01, "1 %"), (0.5, "50 %"), (0.99, "99 %"), (0.991, "> 99 %")],
)
def test_probabilities_have_one_rule_for_their_ends(probability: float, text: str) -> None:
    assert probability_text(probability) == text
