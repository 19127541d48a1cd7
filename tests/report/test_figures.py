"""Numbers with units and as many digits as mean something."""

from __future__ import annotations

import math
import re

import pytest

from mckibben.physics.catalogue import default_catalogue
from mckibben.report.figures import Scale, figure, plain, pretty, probability, scale_of, variable, with_error


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (249.93722, 4, "249.9"),
        (0.0, 4, "0"),
        (-3.14159, 3, "\u22123.14"),
        (99.996, 4, "100.0"),
        (0.00123456, 3, "0.00123"),
        (0.000123456, 3, "1.23·10⁻⁴"),
        (1234567.0, 4, "1.235·10⁶"),
        (None, 4, "–"),
        (math.nan, 4, "–"),
        (math.inf, 4, "–"),
    ],
)
def test_significant_digits(value: float | None, digits: int, text: str) -> None:
    assert plain(value, digits) == text


def test_exact_numbers_lose_their_last_zeros() -> None:
    assert plain(300.0, 5, exact=True) == "300"
    assert plain(21.80, 5, exact=True) == "21.8"
    assert plain(5.0, 6, exact=True) == "5"


@pytest.mark.parametrize(
    ("value", "error", "scale", "text"),
    [
        # The error with two digits says where the value ends.
        (904714.377, 8805.395, Scale("MPa", 1e6), "(0.9047 ± 0.0088)\xa0MPa"),
        (0.911308748, 0.005161248, Scale(""), "0.9113 ± 0.0052"),
        (1.2031692e-05, 1.19432e-06, Scale("1/N"), "(1.20 ± 0.12)·10⁻⁵\xa01/N"),
        (120.0, 35.0, Scale("N"), "(120 ± 35)\xa0N"),
        (0.0003, 0.04, Scale("N"), "(0.000 ± 0.040)\xa0N"),
        (2.5, None, Scale("N"), "2.5\xa0N"),
        (293.15, 2.0, Scale("°C", 1.0, 1, 273.15), "(20.0 ± 2.0)\xa0°C"),
    ],
)
def test_values_with_errors(value: float, error: float | None, scale: Scale, text: str) -> None:
    shown = with_error(value, error, scale)
    assert re.sub("<[^>]*>", "", shown) == text
    assert f'value="{value!r}"' in shown


def test_probabilities_are_not_known_to_the_last_digit() -> None:
    shown = [re.sub("<[^>]*>", "", probability(share)) for share in (None, 0.0, 0.2, 0.94, 0.99, 0.9901)]
    assert shown == ["–", "&lt; 1\xa0%", "20\xa0%", "94\xa0%", "99\xa0%", "&gt; 99\xa0%"]


def test_a_figure_carries_its_exact_value() -> None:
    assert figure(0.0123456789, Scale("mm", 1e-3), 3) == '<data value="0.0123456789">12.3\xa0mm</data>'
    assert figure(math.radians(25.0), scale_of("rad"), exact=True).endswith(">25°</data>")
    assert figure(None) == "–"


def test_units() -> None:
    assert pretty("N*s/m^2") == "N·s/m²"
    assert pretty("W/(m^2*K)") == "W/(m²·K)"
    assert scale_of("Pa", 4.7e5, "shear_modulus")[:2] == ("N/mm²", 1e6)
    assert scale_of("Pa", 2.8e4, "threshold")[:2] == ("bar", 1e5)
    assert scale_of("K").of(293.15) == pytest.approx(20.0)
    assert scale_of("1").unit == ""
    assert variable("pressure")[1].of(3e5) == pytest.approx(3.0)
    assert scale_of("m").all([0.3, None]) == pytest.approx([300.0, math.nan], nan_ok=True)


def test_values_of_effects_have_units_of_engineers() -> None:
    shown = {
        f"{effect.id}.{p.name}": plain(scale_of(p.unit, p.default, p.name).of(p.default))
        for effect in default_catalogue().values()
        for p in effect.parameters
    }
    assert shown["pressure_friction.area"] == "4.000"  # N/bar, not 0.00004 m2
    assert [name for name, text in shown.items() if "\N{MIDDLE DOT}10" in text] == []
