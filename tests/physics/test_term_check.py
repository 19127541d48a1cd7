"""The size of a typed term: what would keep the process busy for hours is refused at once."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from mckibben.physics import term_check
from mckibben.physics.custom import custom_effect
from mckibben.physics.errors import InputError
from mckibben.simulation.statics.compiled import compiled_state

PLACE = "effects.custom.term"
LETTERS = "abcdefghijkmnopqrsuwxyz"


def nest(function: str, levels: int, inside: str = "c*v") -> str:
    """A function of a function of ..."""
    return f"{function}(" * levels + inside + ")" * levels


def product(factor: str, names: str = LETTERS) -> str:
    """A product of equal factors with parameters of their own, "#" in the factor."""
    return "*".join(factor.replace("#", name) for name in names)


TOO_LARGE = {
    "abs of abs": nest("abs", 38),
    "abs of differences": "abs(v-" * 19 + "c" + ")" * 19,
    "sign of sign": nest("sign", 38),
    "sign of abs": "sign(abs(" * 19 + "c*v" + "))" * 19,
    "abs of sin": "abs(sin(" * 19 + "c*v" + "))" * 19,
    "squares of abs": "abs(" * 18 + "c*v" + ")**2" * 18,
    "powers of abs": "abs(" * 18 + "c*v" + ")**v" * 18,
    "roots of abs": "sqrt(abs(" * 19 + "c*v" + "))" * 19,
    "quotients of abs": "abs(c/" * 19 + "v" + ")" * 19,
    "a product of sines": product("sin(#*v+P*L)"),
    "a product of tanh": product("tanh(#*v+P*L)"),
    "a product of sums": product("(#+v*P*kappa)"),
    "a product of abs in abs": product("abs(v-#*abs(P))"),
    "a product of powers": product("(#+P)**(L+v)"),
}
# Integers that symengine would work out digit by digit, were they not turned into floats.
TOWERS = {
    "numbers": "2**2**2**30*c",
    "powers of nine": "c*9**9**9",
    "exponent of a parameter": "c**9**9**9",
    "quotients": "c*((v+v)/v)**(((v+v+v+v)/v)**(((v+v)/v)**((v+v+v+v)/v)))",
}
SMALL_ENOUGH = {
    "roots": nest("sqrt", 15),
    "exponentials": "exp(sin(" * 19 + "c*v" + "))" * 19,
    "sines": nest("sin", 38),
    "tanh": nest("tanh", 38),
    "powers to the right": "**".join(["c"] * 39),
    "a large power": "(a+b+c)**40",
    "a huge power": "(a+b*v)**3000000",
    "a power beyond all bounds": "(a+b*v)**1e300",
    "sums times sums": product("(#+v)"),
    "a tiny number to a huge power": "c*(1e-300)**1e300",
    "a mixture": "abs(sin(sqrt(tanh(exp(" * 5 + "c*v" + ")))))" * 5,
    "nested abs": "abs(P - " * 18 + "c" + ")" * 18,
}
FROM_DATA = (
    "c1*sin(12.566*kappa)*sign(v)*P + c2*cos(12.566*kappa)*sign(v)*P + c3*v*abs(v)*v + "
    "c4*exp(-((kappa - 0.0775)/0.0186)**2)*P + c5*sin(1.2566*t)*v + c6*cos(1.2566*t)*v"
)
# A process of its own: what hangs in symengine ends with nothing but the process.
PROGRAM = """
import json, sys, time
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.custom import custom_effect
from mckibben.physics.drive_terms import DriveStructure
from mckibben.physics.errors import InputError
from mckibben.simulation.statics.compiled import compiled_state
from mckibben.simulation.integrate.system import compiled_drive, compiled_driven

series = [e for e in default_catalogue().values() if {"compliance", "heat"} & set(e.slots)]
for name, term in json.load(sys.stdin).items():
    begin = time.monotonic()
    try:
        effect = custom_effect(term)
        effects = (effect, *series)
        compiled_state((effect,), tuple(f"custom.{p.name}" for p in effect.parameters))
        compiled_drive(DriveStructure(effects, tube=True, pair=True))
        compiled_driven(effects, True)
        answer = "accepted"
    except InputError as error:
        answer = f"{error.field}: {error.message}"
    print(json.dumps([name, answer, time.monotonic() - begin]), flush=True)
"""


def answers(terms: dict[str, str]) -> dict[str, tuple[str, float]]:
    """What becomes of terms that are built, differentiated and compiled, and the seconds it takes."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        input=json.dumps(terms),
        capture_output=True,
        text=True,
        timeout=240,
        check=True,
    )
    return {name: (answer, seconds) for name, answer, seconds in map(json.loads, done.stdout.splitlines())}


@pytest.fixture(scope="module")
def all_answers() -> dict[str, tuple[str, float]]:
    return answers({**TOO_LARGE, **TOWERS, **SMALL_ENOUGH})


@pytest.mark.parametrize("name", TOO_LARGE)
def test_what_would_be_too_large_is_refused_at_once(all_answers, name):
    answer, seconds = all_answers[name]
    assert answer.startswith(PLACE)
    assert "is too large" in answer or "nested too deeply" in answer
    assert seconds < 10.0


@pytest.mark.parametrize("name", TOWERS)
def test_towers_of_powers_have_no_finite_value(all_answers, name):
    answer, seconds = all_answers[name]
    assert answer.startswith(PLACE)
    assert answer.endswith("has no finite value")
    assert seconds < 10.0


@pytest.mark.parametrize("name", SMALL_ENOUGH)
def test_what_stays_small_is_accepted_whatever_it_looks_like(all_answers, name):
    answer, seconds = all_answers[name]
    assert answer == "accepted"
    assert seconds < 20.0


@pytest.mark.parametrize(
    "term",
    [FROM_DATA, " + ".join(f"c{n}*sin({n}.5*kappa)*sign(v)*P" for n in range(1, 16))],
    ids=["three shapes", "as many waves as fit"],
)
def test_sums_of_waves_are_far_from_the_bounds(term, monkeypatch):
    monkeypatch.setattr(term_check, "_MOST_PARTS", 2000)
    monkeypatch.setattr(term_check, "_MOST_WRITTEN", 2000)
    effect = custom_effect(term)
    assert compiled_state((effect,), tuple(f"custom.{p.name}" for p in effect.parameters))


@pytest.mark.parametrize(
    ("term", "named"),
    [
        ("abs(" * 30 + "c" + ")" * 30, "written out in full, its derivative has more than 8388608 parts"),
        (product("sin(#*v+P*L)"), "with its derivatives it has more than 20000 parts"),
    ],
)
def test_the_error_says_what_is_too_large_and_what_would_help(term, named):
    with pytest.raises(InputError) as error:
        custom_effect(term)
    assert error.value.field == PLACE
    assert error.value.message == f"'{term[:60]}...' is too large: {named}"
    assert error.value.hint == "use fewer factors, and fewer functions in each other"


@pytest.mark.parametrize(
    "term",
    ["(" + "-" * 480 + "c)(P)", "not " + "-" * 480 + "c", "-" * 480 + "c"],
    ids=["a call of it", "the negation of it", "itself"],
)
def test_hundreds_of_signs_in_a_row_are_refused(term):
    with pytest.raises(InputError, match="nested too deeply") as error:
        custom_effect(term)
    assert error.value.field == PLACE


def test_a_term_over_several_lines_is_shown_in_one():
    with pytest.raises(InputError) as error:
        custom_effect("c*P\n\n + \n log(P")
    assert error.value.message == "'c*P + log(P' is not a formula"
