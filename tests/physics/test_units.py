"""Text to SI at the edge: what is understood, what is refused and in which words."""

import contextlib
import math
import os
import subprocess
import sys
import time
import timeit
from decimal import Decimal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mckibben.physics.errors import InputError
from mckibben.physics.units import convert, is_unit, meaning, si

PSI = 6894.757293168361
LBF = 4.4482216152605


@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("300 mm", "m", 0.3),
        ("300mm", "m", 0.3),
        ("  300   mm  ", "m", 0.3),
        ("+3e2 mm", "m", 0.3),
        (".5 m", "m", 0.5),
        ("5. m", "m", 5.0),
        ("-2 cm", "m", -0.02),
        ("12 in", "m", 0.3048),
        ("3 µm", "m", 3e-6),  # micro sign
        ("3 μm", "m", 3e-6),  # Greek mu
        ("6 bar", "Pa", 6e5),
        ("6 BAR", "Pa", 6e5),
        ("250 kPa", "Pa", 2.5e5),
        ("0.47 MPa", "Pa", 4.7e5),
        ("100 psi", "Pa", 100 * PSI),
        ("100 PSI", "Pa", 100 * PSI),
        ("10 cmH2O", "Pa", 980.665),
        ("25 deg", "rad", math.radians(25)),
        ("25°", "rad", math.radians(25)),
        ("0.4 rad", "rad", 0.4),
        ("25 %", "1", 0.25),
        ("25%", "1", 0.25),
        ("25 pct", "1", 0.25),  # to pint alone a picocarat
        ("0.3", "1", 0.3),
        ("3 mm/m", "1", 0.003),
        ("20 degC", "K", 293.15),
        ("20 °C", "K", 293.15),
        ("68 degF", "K", 293.15),
        ("293.15 K", "K", 293.15),
        ("10 lbf", "N", 10 * LBF),
        ("1 kN", "N", 1000.0),
        ("12 kg", "kg", 12.0),
        ("200 ms", "s", 0.2),
        ("0.5 min", "s", 30.0),
        ("120 N*s/m", "N*s/m", 120.0),
        ("120 N·s/m", "N*s/m", 120.0),
        ("120 N s/m", "N*s/m", 120.0),
        ("2 N/mm", "N/m", 2000.0),
        ("5 Nm", "N*m", 5.0),  # to pint alone a textile count
        ("300 l/min", "m3/s", 0.005),
        ("1.2 l/(s*bar)", "m3/(s*Pa)", 1.2e-8),
        ("4 m^3", "m3", 4.0),
        ("4 m**3", "m3", 4.0),
        ("4 m3", "m^3", 4.0),
        ("4 m³", "m3", 4.0),
        ("4 mm²", "m^2", 4e-6),
        ("5 1/s", "1/s", 5.0),
        ("5 s^-1", "1/s", 5.0),
        ("5 s⁻¹", "1/s", 5.0),
        ("9.81 m/s^2", "m/s^2", 9.81),
    ],
)
def test_text_becomes_si(text, unit, expected):
    assert si(text, unit) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "expected"), [("300 mm", 0.3), ("35 mm", 0.035), ("7 mm", 0.007), ("0.1 mm", 1e-4)]
)
def test_decimal_units_are_exact(text, expected):
    assert si(text, "m") == expected


@pytest.mark.parametrize("value", [0.3, 3, np.float64(0.3), np.float32(0.5), np.int64(3), -1.5])
def test_numbers_are_already_si(value):
    result = si(value, "m")
    assert result == float(value)
    assert isinstance(result, float)


@pytest.mark.parametrize(
    ("value", "unit", "message"),
    [
        ("300 kg", "m", "muscle.length: '300 kg' is a mass, a length is needed"),
        ("300", "m", "muscle.length: '300' has no unit, a length is needed"),
        ("3 lb", "N", "muscle.length: '3 lb' is a mass, a force is needed"),
        ("5 V", "Pa", "muscle.length: '5 V' is a voltage, a pressure is needed"),
        ("25 deg", "1", "muscle.length: '25 deg' is an angle, a plain number or a share is needed"),
        ("25 %", "rad", "muscle.length: '25 %' is a plain number or a share, an angle is needed"),
        ("25 %", "m", "muscle.length: '25 %' is a plain number or a share, a length is needed"),
        ("5 foo", "m", "muscle.length: '5 foo' cannot be used: 'foo' is not a known unit"),
        ("0,3 m", "m", "muscle.length: '0,3 m' has a decimal comma, use a decimal point"),
        ("1.2.3 m", "m", "muscle.length: '1.2.3 m' is more than one number"),
        ("5 5 m", "m", "muscle.length: '5 5 m' is more than one number"),
        ("3 dB", "1", "muscle.length: '3 dB' cannot be used: 'dB' is a logarithmic unit"),
        ("1e999 m", "m", "muscle.length: '1e999 m' is too large"),
        ("1e308 km", "m", "muscle.length: '1e308 km' is too large"),
        ("", "m", "muscle.length: the value is empty"),
        ("  ", "m", "muscle.length: the value is empty"),
        (None, "m", "muscle.length: the value is empty, a length is needed"),
        (True, "m", "muscle.length: the value is of type bool, a length is needed"),
        (np.True_, "m", "muscle.length: the value is of type bool, a length is needed"),
        ([1], "m", "muscle.length: the value is of type list, a length is needed"),
        (Decimal(1), "m", "muscle.length: the value is of type Decimal, a length is needed"),
        (1j, "m", "muscle.length: the value is of type complex, a length is needed"),
        (math.nan, "m", "muscle.length: nan is not a number that can be used, a length is needed"),
        (-math.inf, "m", "muscle.length: -inf is not a number that can be used, a length is needed"),
        (10**400, "m", "muscle.length: inf is not a number that can be used, a length is needed"),
        ("nan m", "m", "muscle.length: 'nan m' does not begin with a number, a length is needed"),
        ("inf m", "m", "muscle.length: 'inf m' does not begin with a number, a length is needed"),
        ("mm", "m", "muscle.length: 'mm' does not begin with a number, a length is needed"),
        ("٣ m", "m", "muscle.length: '٣ m' does not begin with a number, a length is needed"),
    ],
)
def test_refused_in_words(value, unit, message):
    with pytest.raises(InputError) as caught:
        si(value, unit, field="muscle.length")
    assert str(caught.value) == message
    assert caught.value.field == "muscle.length"
    assert caught.value.hint.startswith("e.g. '")


def test_hint_shows_a_right_value():
    with pytest.raises(InputError) as caught:
        si("300 kg", "m", field="muscle.nominal_length")
    assert caught.value.hint == "e.g. '300 mm'"
    with pytest.raises(InputError) as caught:
        si("x", "m3/(s*Pa)")
    assert caught.value.hint == "e.g. '1.2 l/(s*bar)'"
    assert str(caught.value) == "'x' does not begin with a number, a flow conductance is needed"


@pytest.mark.parametrize(
    "text",
    [
        "9**9**9 m",
        "9^9^9 m",
        "5 m**9**9",
        "5 m^99",
        "5 (m**9)**9",
        "5 m*9**9",
        "5 m^9.5",
        "5 m²²",
        "5 m^2²",
        "5 m//m",
        "5 " + "(" * 38,
        "5 " + "m" * 41,
        "5 m*" * 200,
        "5 __import__('os')",
        "5 m;m",
        "5 m\nm\x00",
        "5 m@m",
        "5 m.real",
        "1" * 5000 + " m",
        "5 m=3",
        "5 'm'",
        "5 {m}",
        "5 m[0]",
        "5 lambda:m",
        "5 1/1/s",
        "5 *m",
        "5 m*",
    ],
)
def test_expressions_are_refused_at_once(text):
    si("1 mm", "m")  # pint is there
    begin = time.perf_counter()
    with pytest.raises(InputError):
        si(text, "m")
    assert time.perf_counter() - begin < 5.0  # an evaluated tower of powers would never end


@settings(deadline=None)  # the first use builds the registry
@given(st.text(max_size=60))
def test_any_text_is_a_number_or_refused(text):
    with contextlib.suppress(InputError):
        assert math.isfinite(si(f"5 {text}", "m"))


def test_columns():
    values = np.array([0.0, 50.0, np.nan])
    result = convert(values, "kPa", "Pa")
    np.testing.assert_array_equal(result, [0.0, 5e4, np.nan])
    np.testing.assert_array_equal(values, [0.0, 50.0, np.nan])
    np.testing.assert_allclose(convert([20], "degC", "K"), [293.15])
    np.testing.assert_array_equal(convert([1, 2], "", "1"), [1.0, 2.0])
    same = np.ones(2)
    assert convert(same, "m", "m") is not same
    with pytest.raises(InputError, match=r"pressure: the unit 'mm' is a length, a pressure is needed"):
        convert([1.0], "mm", "Pa", field="pressure")
    with pytest.raises(InputError, match="'parsnip' is not a known unit"):
        convert([1.0], "parsnip", "Pa")


def test_unit_questions():
    assert is_unit("N/mm")
    assert not is_unit("parsnip")
    assert not is_unit("")
    assert meaning("psi") == "a pressure"
    assert meaning("parsnip") is None


@pytest.mark.parametrize("cache", ["/dev/null/none", ""])
def test_works_without_a_cache_folder(cache):
    environment = {k: v for k, v in os.environ.items() if k not in ("XDG_CACHE_HOME", "HOME")}
    code = (
        "import sys; from mckibben.physics.units import si; assert 'pint' not in sys.modules\n"
        "print(si('3 mm', 'm'))"
    )
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code],
        env={**environment, "XDG_CACHE_HOME": cache, "HOME": "/dev/null"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.strip() == "0.003", done.stderr


@pytest.mark.parametrize(("value", "limit"), [(0.3, 1e-6), ("300 mm", 5e-6), ("1.2 l/(s*bar)", 5e-6)])
def test_is_fast(value, limit):
    unit = "m3/(s*Pa)" if value == "1.2 l/(s*bar)" else "m"
    assert min(timeit.repeat(lambda: si(value, unit), number=2000, repeat=5)) / 2000 < limit
