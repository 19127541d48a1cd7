"""How well data determine a constant, and constants that share a value."""

from __future__ import annotations

import numpy as np
import pytest

import mckibben as mk
from tests.cli.conftest import Run
from tests.identification.synthetic import text, truth


def a_map() -> str:
    """A map of a DMSP-20 of 300 mm with a prestress of 40 N and noise of 2 N."""
    random = np.random.default_rng(7)
    rows = [
        f"{pressure / 1e5},{1e3 * length},{truth(pressure, length, prestress=40.0) + 2.0 * random.normal()}"
        for pressure in (2e5, 4e5, 6e5)
        for length in np.linspace(0.255, 0.3, 25)
    ]
    return text(rows, "pressure_bar,length_mm,force_N", "kind: static")


@pytest.fixture
def fitted(tmp_path: object) -> mk.Model:
    with open("map.csv", "w") as file:
        file.write(a_map())
    return mk.Model.preset("DMSP-20", length="300 mm").ideal().with_effect("prestress")


def test_where_the_error_is_a_parabola_the_interval_is_that_of_the_standard_error(fitted: mk.Model) -> None:
    comparison = fitted.compare("map.csv", fit=True)
    found = comparison.profile("prestress.force")
    assert found.stderr is not None
    assert found.stderr > 0.0
    assert found.low is not None
    assert found.high is not None
    assert found.best == pytest.approx(comparison.parameters["prestress"]["force"].value, rel=1e-4)
    assert found.high - found.best == pytest.approx(1.96 * found.stderr, rel=0.05)
    assert found.best - found.low == pytest.approx(1.96 * found.stderr, rel=0.05)
    assert found.low < 40.0 < found.high
    narrow = comparison.profile("prestress.force", share=0.68)
    assert narrow.low is not None
    assert found.low < narrow.low < found.best
    assert "with 95 % between" in str(found)
    assert len(found.to_frame()) == len(found.value) >= 7
    assert len(found.plot().data) == 2  # type: ignore
    with pytest.raises(mk.Problem, match=r"'prestress.fors' was not fitted.*prestress.force"):
        comparison.profile("prestress.fors")
    with pytest.raises(mk.Problem, match=r"no fit was requested.*fit=True"):
        fitted.compare("map.csv").profile("prestress.force")


def test_an_interval_at_a_bound_has_one_end(fitted: mk.Model) -> None:
    found = fitted.with_effect("bladder_elasticity").compare("map.csv", fit=True)
    one = found.profile("bladder_elasticity.shear_modulus")
    if one.best == 0.0:
        assert one.low is None
        assert one.high is not None
        assert "at most" in one.sentence
    assert one.high is not None


def test_tied_constants_share_one_value(fitted: mk.Model, run: Run) -> None:
    model = fitted.with_effect("force_offset")
    ties = {"force_offset.offset": "prestress.force"}
    both = model.compare("map.csv", fit=True, ties=ties).parameters
    force, offset = both["prestress"]["force"], both["force_offset"]["offset"]
    assert offset.value == force.value
    assert (offset.fitted, offset.stderr) == (True, force.stderr)
    alone = fitted.compare("map.csv", fit=True).parameters["prestress"]["force"].value
    assert abs(force.value) != pytest.approx(abs(alone), rel=0.1)
    with pytest.raises(mk.Problem, match=r"dahl.force is not fitted"):
        model.compare("map.csv", fit=True, ties={"dahl.force": "prestress.force"})
    code, out, err = run(
        "compare", "map.csv", "--muscle", "DMSP-20:300mm", "--effect", "prestress", "--profile",
        "prestress.force",
    )  # fmt: skip
    assert code == 0, err
    assert "between" in err + out
    code, _, err = run("compare", "map.csv", "--muscle", "DMSP-20:300mm", "--fit", "--tie", "a.b")
    assert code == 2
    assert "--tie a.b: is not of the form A=B" in err
