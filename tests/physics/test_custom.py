"""A typed term: what may stand in it, what it is worth, and that nothing in it is ever evaluated."""

from __future__ import annotations

import builtins
import json
import os
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
import symengine as se
from fastapi.testclient import TestClient

from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.custom import blamed_on_the_term, custom_effect, typed_effect
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle
from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from mckibben.simulation.drive.records import force_of_record
from mckibben.simulation.statics.model import StaticModel

MUSCLE = Muscle(0.3, 0.0218, 0.4625, 0.0018, 0.02)
PLACE = "effects.custom.term"


def worth(effect: Effect, values: Mapping[str, Any], **state: Any) -> Any:
    """What the term adds to the tension."""
    at = {"muscle": MUSCLE, "length": 0.27, "pressure": 2e5, "velocity": 0.0, "direction": 0.0, **state}
    return effect.call("friction", at, {**effect.defaults, **values})


# --- what is refused

REFUSED = {
    "attribute": "c.real*P",
    "attribute of an attribute": "c.__class__.__mro__",
    "method": "c.conjugate()",
    "item": "c[0]",
    "other function": "c*log(P)",
    "built-in": "open(c)",
    "import": "__import__('os').system('echo')",
    "call of a call": "sin(P)(c)",
    "lambda": "lambda: c",
    "lambda called": "(lambda x: x)(c)",
    "comprehension": "sum([c for _ in (1, 2)])",
    "generator": "abs(c for x in P)",
    "list": "[c, P]",
    "tuple": "(c, P)",
    "dictionary": "{c: P}",
    "set": "{c}",
    "conditional": "c if P else v",
    "comparison": "c*(P > 1)",
    "boolean": "c and P",
    "not": "not c",
    "truth": "True*c",
    "nothing": "None*c",
    "ellipsis": "c*...",
    "imaginary": "c*1j",
    "floor": "c//P",
    "rest": "c % P",
    "matrix": "c @ P",
    "shift": "c << 2",
    "invert": "~c",
    "assignment": "c = P",
    "walrus": "(c := P)",
    "statement": "c; P",
    "two lines": "c\nP",
    "comment": "c*P # and more",
    "starred": "sin(*P)*c",
    "keyword": "abs(x=v)*c",
    "two arguments": "abs(v, P)*c",
    "no argument": "abs()*c",
    "function without argument": "c*sin",
    "sign without argument": "sign*c",
    "text": "c*'a'",
    "bytes": "c*b'a'",
    "formatted text": "f'{c}'",
    "await": "await c",
    "yield": "(yield c)",
    "dunder name": "c*__class__",
    "dunder import": "__import__*P",
    "private name": "_c*P",
    "name of the context": "muscle*P",
    "name of the direction": "direction*P",
    "name of the state": "elapsed*t",
    "name of the term": "term*P",
    "very long name": "x" * 65,
    "Greek capital rho": "\N{GREEK CAPITAL LETTER RHO}*c",
    "Cyrillic c": "\N{CYRILLIC SMALL LETTER ES}*P",
    "full-width sine": "c*\N{FULLWIDTH LATIN SMALL LETTER S}in(P)",
    "kappa sign": "c*\N{GREEK SMALL LETTER KAPPA}",
    "superscript": "c*P\N{SUPERSCRIPT TWO}",
    "minus sign": "\N{MINUS SIGN}c*P",
    "middle dot": "c\N{MIDDLE DOT}P",
    "zero width": "c*P\N{ZERO WIDTH SPACE}",
    "no break": "c*\N{NO-BREAK SPACE}P",
    "null": "c*P\0",
    "huge power": "c*9**9**9",
    "huge power of ten": "c*10**400",
    "huge number": "c*1e400",
    "very many digits": "c*" + "9" * 400,
    "division by zero": "c*(1/0)",
    "division of a symbol by zero": "c*P/0",
    "division by nothing": "c/(P - P)",
    "root of a negative number": "c*sqrt(-2)",
    "power of a negative number": "c*(-8)**0.5",
    "complex power": "c*(-8)**kappa",
    "overflowing exponential": "c*exp(1000)",
    "overflowing product": "c*1e308*1e308",
    "deep brackets": "abs(" * 50 + "c" + ")" * 50,
    "deep signs": "-" * 60 + "c",
    "deep sum": "+".join(["c"] * 60),
    "deeper than the parser": "(" * 240 + "c" + ")" * 240,
    "unbalanced": "c*(P",
    "operator missing": "c P",
    "nothing to multiply": "c*",
    "very long": "c*P" + "+c*P" * 200,
    "empty": "",
    "blank": "   ",
    "no parameter": "sign(v)*P",
    "numbers alone": "3.0 + 4.0",
}  # fmt: skip


@pytest.fixture
def _nothing_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Evaluating a text fails the test."""

    def never(*_: object, **__: object) -> None:
        raise AssertionError("the term was evaluated")

    monkeypatch.setattr(builtins, "eval", never)
    monkeypatch.setattr(builtins, "exec", never)
    monkeypatch.setattr(os, "system", never)


@pytest.mark.usefixtures("_nothing_runs")
@pytest.mark.parametrize("term", REFUSED.values(), ids=REFUSED)
def test_what_is_no_formula_is_refused_at_the_term(term):
    with pytest.raises(InputError) as error:
        custom_effect(term)
    assert error.value.field == PLACE
    assert error.value.message
    assert len(error.value.message) < 200
    assert "Traceback" not in error.value.message


@pytest.mark.parametrize(
    ("term", "named"),
    [
        ("c*'a'", "a single quote"),
        ('c*"a"', "a double quote"),
        ("c*P\0", "the character U+0000"),
        ("c*P\N{ZERO WIDTH SPACE}", "the character U+200B"),
        ("c & P", "'&'"),
    ],
)
def test_a_character_that_is_refused_is_named_legibly(term, named):
    with pytest.raises(InputError) as error:
        custom_effect(term)
    assert error.value.message == f"{named} cannot be part of a term"


@pytest.mark.parametrize("term", [None, 3, 2.5, ["c"], b"c*P"])
def test_a_term_is_a_text(term):
    with pytest.raises(InputError) as error:
        custom_effect(term)
    assert error.value.field == PLACE


def test_an_unknown_function_names_the_nearest():
    with pytest.raises(InputError, match="tan") as error:
        custom_effect("c*tan(P)")
    assert error.value.hint == "Did you mean 'tanh'?"


def test_nested_functions_do_not_take_for_ever():
    """Written out, each abs doubles what is inside: 2^18 parts."""
    term = "abs(P - " * 18 + "c" + ")" * 18
    assert len(term) <= 500
    model = StaticModel(MUSCLE, {"custom": {}}, catalogue={"custom": custom_effect(term)})
    assert np.isfinite(model.force(length=0.28, pressure=1e5)).all()


# --- what it is worth

FORMULAS = {
    "-c*sign(v)*P": lambda c, P, s, **_: -c * s * P,
    "c1*kappa + c2*kappa**2": lambda c1, c2, kappa, **_: c1 * kappa + c2 * kappa**2,
    "c*kappa^2": lambda c, kappa, **_: c * kappa**2,
    "c*exp(-(kappa/width)**2)": lambda c, kappa, width, **_: c * np.exp(-((kappa / width) ** 2)),
    "c*sqrt(P)*tanh(v/vs)": lambda c, P, v, vs, **_: c * np.sqrt(P) * np.tanh(v / vs),
    "a*sin(62.8*kappa) + b*cos(62.8*kappa)": lambda a, b, kappa, **_: (
        a * np.sin(62.8 * kappa) + b * np.cos(62.8 * kappa)
    ),
    "c*abs(v)*v": lambda c, v, **_: c * np.abs(v) * v,
    "+c*(L - 0.3)/0.3": lambda c, L, **_: c * (L - 0.3) / 0.3,
    "c*sin(2*pi*kappa)": lambda c, kappa, **_: c * np.sin(2 * np.pi * kappa),
    "c*P**n": lambda c, P, n, **_: c * P**n,
    "c/(1 + P/Pm)": lambda c, P, Pm, **_: c / (1 + P / Pm),
    "c*sign(P - 2e5)": lambda c, P, **_: c * np.sign(P - 2e5),
    "1e-3*c*P - - c": lambda c, P, **_: 1e-3 * c * P + c,
    "c*1_000": lambda c, **_: c * 1000,
}  # fmt: skip
NUMBERS = {
    "c": 0.7, "c1": -3.0, "c2": 11.0, "a": 2.0, "b": -1.5, "width": 0.05, "vs": 0.01, "n": 0.5, "Pm": 3e5
}  # fmt: skip


@pytest.mark.parametrize("term", FORMULAS)
def test_values_are_those_of_the_formula(term):
    names = [p.name for p in custom_effect(term).parameters]
    own = {name: NUMBERS[name] for name in names}
    effect = custom_effect(term, own)
    assert effect.defaults == own
    length = np.array([0.3, 0.29, 0.25, 0.24])
    pressure = np.array([0.0, 1e5, 2e5, 6e5])
    velocity = np.array([0.02, -0.05, 0.0, 0.001])
    known = {
        "P": pressure, "L": length, "kappa": 1.0 - length / 0.3, "v": velocity, "s": np.sign(velocity), **own
    }  # fmt: skip
    expected = FORMULAS[term](**known) * np.ones(4)
    state = {"length": length, "pressure": pressure, "velocity": velocity, "direction": np.sign(velocity)}
    assert worth(effect, own, **state) * np.ones(4) == pytest.approx(expected, rel=1e-12, abs=1e-12)
    for row in range(4):
        alone = {name: float(values[row]) for name, values in state.items()}
        assert float(worth(effect, own, **alone)) == pytest.approx(expected[row], rel=1e-12, abs=1e-12)
        symbols = {name: se.Symbol(name) for name in state}
        given = worth(effect, own, **symbols)
        shown = se.sympify(given).subs({symbols[name]: value for name, value in alone.items()})
        assert float(shown) == pytest.approx(expected[row], rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("term", FORMULAS)
def test_the_compiled_model_adds_the_formula(term):
    own = {p.name: NUMBERS[p.name] for p in custom_effect(term).parameters}
    catalogue = {"custom": custom_effect(term, own)}
    length, pressure, velocity = np.array([0.29, 0.25]), np.array([1e5, 4e5]), np.array([0.02, -0.03])
    state = {
        "length": length, "pressure": pressure, "velocity": velocity, "direction": np.sign(velocity)
    }  # fmt: skip
    with_term = StaticModel(MUSCLE, {"custom": {}}, catalogue=catalogue).force(clipped=False, **state)
    without = StaticModel(MUSCLE).force(clipped=False, **state)
    known = {"P": pressure, "L": length, "kappa": 1 - length / 0.3, "v": velocity, "s": np.sign(velocity)}
    assert with_term - without == pytest.approx(FORMULAS[term](**known, **own) * np.ones(2), abs=1e-8)


def test_the_sign_of_the_velocity_is_the_direction_and_zero_at_rest():
    effect = custom_effect("c*sign(v)", {"c": 5.0})
    for direction, expected in ((1.0, 5.0), (-1.0, -5.0), (0.0, 0.0)):
        # The direction may be known where the velocity is not.
        assert float(worth(effect, {}, velocity=0.0, direction=direction)) == expected
    general = custom_effect("c*sign(v + 0)", {"c": 5.0})
    for velocity, expected in ((0.3, 5.0), (-0.3, -5.0), (0.0, 0.0)):
        assert float(worth(general, {}, velocity=velocity)) == expected


def test_time_is_a_state_that_runs_with_the_record():
    effect = custom_effect("c*(1 - exp(-t/tau))", {"c": 20.0, "tau": 2.0})
    assert [state.name for state in effect.states] == ["elapsed"]
    assert "rates" in effect.slots
    time = np.linspace(3.0, 9.0, 61)  # a record need not begin at 0 s
    rows = {"time": time, "pressure": np.full(61, 3e5), "length": np.full(61, 0.28)}
    force = force_of_record(StaticModel(MUSCLE, {"custom": {}}, catalogue={"custom": effect}), **rows)
    bare = force_of_record(StaticModel(MUSCLE), **rows)
    assert force - bare == pytest.approx(20.0 * (1 - np.exp(-(time - 3.0) / 2.0)), abs=1e-3)
    assert custom_effect("c*P").states == ()


@pytest.mark.parametrize(
    "term", ["c*t**n", "c*sqrt(t)", "c*abs(t - 5)*P", "c*P*t*exp(-t/tau)", "c*sign(t - 1)"]
)
def test_curves_are_those_at_the_begin(term):
    effect = custom_effect(term)
    model = StaticModel(MUSCLE, {"custom": {}}, catalogue={"custom": effect})
    at = {"length": 0.28, "pressure": 2e5}
    change = model.force(clipped=False, **at) - StaticModel(MUSCLE).force(clipped=False, **at)
    assert change == pytest.approx([float(worth(effect, {}, **at))], abs=1e-8)


# --- what cannot be compiled


def test_a_failure_to_compile_is_blamed_on_the_term_where_there_is_one():
    typed = custom_effect("c*P")
    with pytest.raises(InputError) as error, blamed_on_the_term([typed]):
        raise RuntimeError("LLVMDouble can only represent real valued infinity")
    assert error.value.field == PLACE
    assert error.value.message == "'c*P' cannot be computed together with the rest of the model"
    with pytest.raises(RuntimeError, match="LLVM"), blamed_on_the_term(list(default_catalogue().values())):
        raise RuntimeError("LLVM")
    with pytest.raises(InputError, match="geometry"), blamed_on_the_term([typed]):
        raise InputError("the geometry", field="muscle")


# --- parameters


def test_parameters_are_the_other_names_in_their_order():
    effect = custom_effect("stiffness*kappa + c*P*sign(v) + stiffness*L", {"c": 2e-5})
    assert [p.name for p in effect.parameters] == ["stiffness", "c"]
    by_name = {p.name: p for p in effect.parameters}
    assert by_name["stiffness"].default == 1.0
    assert (by_name["c"].lower, by_name["c"].upper) == (pytest.approx(-0.02), pytest.approx(0.02))
    assert all(p.off == 0.0 and p.fitted for p in effect.parameters)
    assert effect.off == {"stiffness": 0.0, "c": 0.0}
    assert effect.id == "custom"


def test_a_parameter_of_zero_has_room():
    parameter = custom_effect("c*P", {"c": 0.0}).parameters[0]
    assert parameter.lower < 0.0 < parameter.upper


def test_typed_effects_take_numbers_and_texts():
    effect, term = typed_effect({"term": "a*P + b", "a": "2e-5", "b": 3})
    assert term == "a*P + b"
    assert effect.defaults == {"a": 2e-5, "b": 3.0}
    assert typed_effect({"b": 3, "a": 2e-5, "term": "a*P + b"})[0] is effect  # its machine code is kept


@pytest.mark.parametrize(
    ("given", "field"),
    [
        ({}, PLACE),
        ({"c": 1.0}, PLACE),
        ({"term": 5.0}, PLACE),
        ({"term": "c*P", "c": "much"}, "effects.custom.c"),
        ({"term": "c*P", "c": "5 N"}, "effects.custom.c"),
        ({"term": "c*P", "c": "nan"}, "effects.custom.c"),
        ({"term": "c*P", "c": "inf"}, "effects.custom.c"),
        ({"term": "c*P", "c": 1e13}, "effects.custom.c"),
        ({"term": "c*P", "d": 1.0}, "effects.custom.d"),
        ({"term": "stiffness*P", "stifness": 1.0}, "effects.custom.stifness"),
    ],
)
def test_values_that_cannot_be_are_named(given, field):
    with pytest.raises(InputError) as error:
        typed_effect(given)
    assert error.value.field == field


def test_a_misspelt_parameter_names_the_nearest():
    with pytest.raises(InputError) as error:
        typed_effect({"term": "stiffness*P", "stifness": 1.0})
    assert error.value.hint == "Did you mean 'stiffness'?"


# --- over HTTP


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory):
    folder = tmp_path_factory.mktemp("custom")
    app = create_app(Settings(data=folder / "data", user_presets=folder / "presets"))
    with TestClient(app, base_url="http://127.0.0.1:8000", raise_server_exceptions=False) as client:
        yield client


def curves(client: TestClient, effects: dict) -> Any:
    muscle = {"braid_diameter": "21.8 mm", "braid_angle": "26.5 deg", "nominal_length": "300 mm"}
    body = {"muscle": muscle, "effects": effects, "pressures": ["2 bar"], "points": 5}
    body |= {"contraction_from": 0.0, "contraction_to": 0.1}
    return client.post("/api/curves", content=json.dumps(body), headers={"content-type": "application/json"})


def test_curves_with_a_typed_term(client):
    bare = curves(client, {}).json()
    answer = curves(client, {"custom": {"term": "-c*kappa*P", "c": 1e-3}})
    assert answer.status_code == 200, answer.text
    expected = [-1e-3 * kappa * 2e5 for kappa in bare["contraction"]]
    change = [a - b for a, b in zip(answer.json()["force"][0], bare["force"][0], strict=True)]
    assert change == pytest.approx(expected, abs=1e-8)


@pytest.mark.parametrize(
    "term",
    ["c*log(P)", "__import__('os')", "c.real", "c*P/0", "P", "muscle*P", "\N{GREEK CAPITAL LETTER RHO}*c"],
)
def test_a_wrong_term_is_an_error_at_its_field(client, term):
    answer = curves(client, {"custom": {"term": term}})
    assert answer.status_code == 422
    assert answer.json()["error"]["field"] == PLACE


def test_a_wrong_value_is_an_error_at_its_field(client):
    answer = curves(client, {"custom": {"term": "c*P", "c": "5 N"}})
    assert answer.status_code == 422
    assert answer.json()["error"]["field"] == "effects.custom.c"


@pytest.mark.parametrize("term", ["", "c*P" + "+c*P" * 200], ids=["empty", "very long"])
def test_a_text_of_a_wrong_length_is_refused(client, term):
    answer = curves(client, {"custom": {"term": term}})
    assert answer.status_code == 422
    assert answer.json()["error"]["field"].startswith(PLACE)
