"""LaTeX as MathML: every equation of the catalogue, and nothing but drawing."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest

from mckibben.physics.catalogue import default_catalogue
from mckibben.report.formula import equation, formula


@pytest.mark.parametrize("effect", default_catalogue().values(), ids=lambda effect: effect.id)
def test_equations_of_the_catalogue_become_mathml(effect) -> None:
    for latex in (effect.equation, *(parameter.symbol for parameter in effect.parameters)):
        root = ElementTree.fromstring(formula(latex))
        assert root.tag == "math", latex
        assert "".join(root.itertext()).strip()


@pytest.mark.parametrize(
    "latex", [r"\href{javascript:alert(1)}{x}", r"\style{color:red}{x}", r"\text{<b>x</b>}", r"\color{red} x"]
)
def test_only_what_draws_passes(latex: str) -> None:
    for element in ElementTree.fromstring(formula(latex)).iter():
        assert element.tag.startswith("m") or element.tag == "code"
        assert not {"href", "style", "class", "id"} & set(element.attrib)


def test_an_equation_may_continue_on_the_next_line_where_its_parts_end() -> None:
    box = ElementTree.fromstring(equation(r"a = \frac{b \quad c}{d}, \quad e = \left( f \quad g \right)"))
    assert [child.tag for child in box] == ["math", "math"]
    first, second = ("".join(part.itertext()) for part in box)
    assert {"a", "b", "c", "d"} <= set(first)
    assert {"e", "f", "g"} <= set(second)


def test_what_is_no_latex_is_shown_as_it_is() -> None:
    assert formula(r"\frac{1}{") == r"<code>\frac{1}{</code>"
