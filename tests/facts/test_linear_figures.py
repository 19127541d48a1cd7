"""Gains, decibels and the units of declared figures."""

from __future__ import annotations

import math

import pytest

from mckibben.facts.groups import FIGURES
from mckibben.facts.linear import CONTROLLER, MARGINS
from mckibben.physics.units import si
from mckibben.report.summary import shown
from mckibben.simulation.command.pid import controller_from


@pytest.mark.parametrize(
    ("name", "stated", "words"),
    [("kp", 0.3, "0.3 %/mm"), ("ki", 10.0, "10 %/(mm·s)"), ("kd", 0.02, "0.02 %·s/mm")],
)
def test_a_gain_is_shown_as_a_document_states_it(name: str, stated: float, words: str) -> None:
    """One percent of full command per mm is 0.01/0.001 m = 10 1/m."""
    controller = controller_from({"kp": 1.0, name: stated})
    assert getattr(controller, name) == pytest.approx(10.0 * stated)
    assert shown(CONTROLLER[name], getattr(controller, name)) == words
    assert (
        shown(CONTROLLER[name], getattr(controller_from({"kp": 1.0, name: words.replace("·", "*")}), name))
        == words
    )


def test_a_factor_is_shown_in_decibels() -> None:
    margin = MARGINS["gain_margin"]
    assert margin.scale.of(math.sqrt(10.0)) == pytest.approx(10.0)
    assert shown(margin, 0.5) == "-6.021 dB"
    assert shown(margin, 0.0) == shown(margin, None) == "–"


def test_every_figure_has_a_known_unit() -> None:
    for key, figure in FIGURES.items():
        if figure.unit not in ("", "1"):
            assert si(f"1 {figure.unit}", figure.unit) == 1.0, key
