"""The declared units agree with pint, which reads the texts of users."""

from __future__ import annotations

from typing import get_args

import pytest

from mckibben.facts.units import NAMES, QUANTITIES, SHIFTED, TYPED, System, quantity_of
from mckibben.physics.units import si

SI_OF_DIMENSION = ("m", "kg", "s", "K", "rad")
NO_UNIT = {"", "%", "l (ANR)", "per 1000 cycles"}  # shown as they are, or no unit of pint


@pytest.mark.parametrize("name", QUANTITIES)
def test_shown_units_have_the_factor_of_pint(name: str) -> None:
    quantity = QUANTITIES[name]
    for system in get_args(System):
        scale = quantity.scales[system]
        if scale.unit not in NO_UNIT and not scale.decibels:
            for shown in (0.0, 1.0, 12.5):
                wanted = si(f"{shown} {scale.unit}", quantity.unit)
                assert shown * scale.factor + scale.offset == pytest.approx(wanted, rel=1e-12, abs=1e-15)
                assert scale.of(wanted) == pytest.approx(shown, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_names_in_documents_have_the_factor_of_pint(name: str) -> None:
    factor, dimension = NAMES[name]
    unit = "*".join(
        f"{si_unit}^{power}" for si_unit, power in zip(SI_OF_DIMENSION, dimension, strict=True) if power > 0
    )
    below = "*".join(
        f"{si_unit}^{-power}" for si_unit, power in zip(SI_OF_DIMENSION, dimension, strict=True) if power < 0
    )
    whole = (unit or "1") + (f"/({below})" if below else "")
    if name == "1":
        return
    assert factor == pytest.approx(si(f"1 {name}", whole), rel=1e-12)


def test_typed_units_are_those_of_their_quantity() -> None:
    for unit, (quantity, factor, offset) in TYPED.items():
        assert quantity in QUANTITIES, unit
        scales = QUANTITIES[quantity].scales.values()
        assert factor > 0.0
        assert any(scale.offset == offset for scale in scales) or offset == 0.0, unit


@pytest.mark.parametrize(("scale", "zero"), [("degC", 273.15), ("degF", 255.3722222222222)])
def test_temperatures_have_their_zero(scale: str, zero: float) -> None:
    factor, offset = SHIFTED[scale]
    assert offset == pytest.approx(zero)
    assert 100.0 * factor + offset == pytest.approx(si(f"100 {scale}", "K"))


@pytest.mark.parametrize(
    ("unit", "name", "quantity"),
    [("Pa", "", "pressure"), ("Pa", "shear_modulus", "modulus"), ("m3", "", "volume"), ("m^3", "", "volume"),
     ("1", "", "number"), ("N*s/m", "", "damping"), ("kg*m^2", "", None)],
)  # fmt: skip
def test_the_quantity_of_a_unit(unit: str, name: str, quantity: str | None) -> None:
    assert quantity_of(unit, name) == quantity
