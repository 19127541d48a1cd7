"""The verdict in words: error before and after, the noise, what is left."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from mckibben.identification.diagnose.judgement import Judgement
from mckibben.identification.diagnose.left_out import LeftOutSpecimen
from mckibben.identification.diagnose.repetition import Repetition
from mckibben.identification.diagnose.verdict import Interval
from mckibben.identification.diagnose.words import (
    applied_reasons,
    bounds_sentence,
    by_mechanism,
    corrections_sentence,
    left_out_sentence,
    sentence_of,
    title_of,
)
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.fit_model import FitModel, free_numbers
from mckibben.physics.catalogue import default_catalogue
from tests.identification.diagnose.test_judgement import judgement
from tests.identification.synthetic import MUSCLE

BUILT_IN = default_catalogue()
TITLES = {"creep": "Creep", "leak": "Leak"}
CATALOGUE = {name: replace(BUILT_IN[name], title=title) for name, title in TITLES.items()}


def result(
    status: str, before: float, after: float, *added: str, unit: str = "N", noise: float | None = 2.0,
    share: float = 0.05, alternatives: tuple[Any, ...] = (), refitted: float | None = None,
    highest: float | None = None, doubted: bool = False, term: object = None,
    repetition: Repetition | None = None, judgement: Judgement | None = None,
) -> Any:  # fmt: skip
    return SimpleNamespace(
        status=status,
        none_likely=False,
        unfinished=None,
        judgement=judgement
        or SimpleNamespace(
            predictable=share,
            depends_on=("pressure", "time", "velocity"),
            surface=object(),
            undecided=False,
            likeliest=None,
        ),
        with_them=None,
        superfluous=(),
        predictor=SimpleNamespace(unit=unit, channels=[SimpleNamespace(name="force" if unit == "N" else "")]),
        start=SimpleNamespace(rmse=before),
        root=SimpleNamespace(rmse=before if refitted is None else refitted, free=refitted is not None),
        best=SimpleNamespace(rmse=after),
        lean=SimpleNamespace(rmse=after),
        path=(SimpleNamespace(fitted_model=SimpleNamespace(rmse=after), refitted=False, correction=False),),
        added=added,
        noise=noise,
        noise_interval=None if highest is None else Interval(noise or 0.0, highest),
        context=(SimpleNamespace(stands=True),) if doubted else (),
        alternatives=alternatives,
        term=term,
        repetition=repetition,
        evidence=tuple(
            SimpleNamespace(
                effect=name,
                group=(name, *(other.effect for other in alternatives if other.of == name)),
                probability=0.97,
                read=False,
            )
            for name in added
        ),
        corrections=(),
        left_where=(
            SimpleNamespace(over="load", worst="load 1 to 2 N", rmse=99.0),
            SimpleNamespace(over="time", worst="time 3.00 to 4.00 s", rmse=11.0 * after / 10.0),
            SimpleNamespace(over="pressure", worst="pressure 5.00 to 6.00 bar", rmse=13.0 * after / 10.0),
        ),
    )


WEAVE = Repetition("length", 3.2e-3, 0.62, 10.7, True, 0.5, 3, 3)
REPEATS = (
    "it repeats every 3.20 mm of length (the same in all 3 records): a thread, rack or weave with that "
    "pitch, or what rings after each turn of the motion; "
    "this is 62 % of it, with an amplitude of 10.7 N that grows with the pressure"
)
FAINT = replace(WEAVE, share=0.38)  # less than half of the rest: what it depends on is told as well
SENTENCES = {
    f"No catalogued effect explains the error of 40.0 N: {REPEATS}.": result(
        "unknown_effect", 40.0, 40.0, repetition=WEAVE
    ),
    "Missing: Creep (probability 97 %). With it the error falls from 40.0 to 9.00 N; the noise is 2.00 N. No "
    f"catalogued effect explains the rest: {REPEATS}.": result(
        "unknown_effect", 40.0, 9.0, "creep", share=0.4, repetition=WEAVE
    ),
    "Missing: Creep (probability 97 %). With it the error falls from 40.0 to 9.00 N; the noise is 2.00 N. No "
    "catalogued effect explains the rest: 40 % of it depends on pressure and time; "
    f"{REPEATS.replace('62 %', '38 %')}.": result(
        "unknown_effect",
        40.0,
        9.0,
        "creep",
        share=0.4,
        repetition=FAINT,
        term=SimpleNamespace(share=0.8, smooth=False),
    ),
    "Nothing is missing: the error of 2.00 N is of the size of the noise (2.00 N).": result(
        "adequate", 2.0, 2.0
    ),
    "Nothing is missing: the error of 2.00 N (with the numbers of the model refitted; before 50.0 N) is of "
    "the size of the noise (2.00 N).": result("adequate", 50.0, 2.0),
    "Nothing is missing: the error of 1.00 times the noise is noise.": result(
        "adequate", 1.0, 1.0, unit="1", noise=1.0
    ),
    "No effect is proved to be missing behind the error of 5.00 N. These data cannot tell whether more is "
    "missing: the noise cannot be estimated and there are fewer than twenty rows. State the noise. Repeat "
    "the run: what is missing comes again, noise does not. Measure more, at other pressures or "
    "lengths.": result(
        "undecided", 5.0, 5.0, noise=None, judgement=judgement(noise=None, rows=False, rmse=5.0)
    ),
    "No effect is proved to be missing behind the error of 6.00 N. These data cannot tell whether more is "
    "missing: a free surface explains more than noise does. A free curve with 9 numbers would leave 1.00 N. "
    "Repeat the run: what is missing comes again, noise does not.": result(
        "undecided", 6.0, 6.0, highest=6.0, judgement=judgement(ratio=20.0, rmse=6.0)
    ),
    "Missing: Creep (probability 97 %). With it the error falls from 40.0 to 2.10 N, the noise of the data "
    "(2.00 N).": result("missing_effects", 40.0, 2.1, "creep"),
    "With the entries as stated, Creep would be missing, and the error would only fall from 40.0 to 9.00 N; "
    "the noise is 2.00 N.": result("ambiguous", 40.0, 9.0, "creep", doubted=True),
    "With the entries as stated, Creep would be missing, and the error would fall from 40.0 to 2.10 N, the "
    "noise of the data (2.00 N).": result("ambiguous", 40.0, 2.1, "creep", doubted=True),
    "Missing: Creep (probability 97 %). With it the error falls from 40.0 to 9.00 N; the noise is 2.00 N. No "
    "catalogued effect explains the rest: the proposed term takes 80 % of it.": result(
        "unknown_effect", 40.0, 9.0, "creep", term=SimpleNamespace(share=0.8, smooth=False)
    ),
    "Missing: Creep (probability 97 %) and Leak (97 %). "
    "With them the error falls from 4.00 to 1.02 times the noise.": result(
        "missing_effects", 4.0, 1.02, "creep", "leak", unit="1", noise=1.0
    ),
    "Missing: Creep (probability 97 %). "
    "With it the error falls from 40.0 to 3.00 mm; the noise is 2.00 mm. Of the rest, 40 % depends "
    "on pressure and time.": result(
        "missing_effects", 0.040, 0.003, "creep", unit="m", noise=2e-3, share=0.4
    ),
    "Missing: Creep (probability 97 %). "
    "With it the error falls from 40.0 to 9.00 N; the noise is 2.00 N. No catalogued effect explains "
    "the rest: it depends on no measured variable; repeat the run to see whether it recurs.": result(
        "unknown_effect", 40.0, 9.0, "creep"
    ),
    "No catalogued effect explains the error of 40.0 N: 90 % of it depends on pressure and time. No short "
    "formula halves it; look where it is largest: pressure 5.00 to 6.00 bar (52.0 N) and time 3.00 to 4.00 s "
    "(44.0 N).": result("unknown_effect", 40.0, 40.0, share=0.9),
    "No catalogued effect explains the error of 40.0 N: 90 % of it depends on pressure and time.": result(
        "unknown_effect", 40.0, 40.0, share=0.9, term=SimpleNamespace(share=0.8, smooth=False)
    ),
    "Missing: Creep (probability 97 %). "
    "With it the error falls from 40.0 to 10.0 mm; the noise is 2.00 mm. No catalogued effect "
    "explains the rest: 90 % of it depends on pressure and time. No formula is proposed; look where it is "
    "largest: pressure 5.00 to 6.00 bar (13.0 mm) and time 3.00 to 4.00 s (11.0 mm).": result(
        "unknown_effect", 0.040, 0.010, "creep", unit="m", noise=2e-3, share=0.9
    ),
    "Missing: Creep (probability 97 %). "
    "The model's own numbers, refitted, lower the error from 40.0 to 15.0 N; with it the error "
    "falls to 2.10 N, the noise of the data (2.00 N).": result(
        "missing_effects", 40.0, 2.1, "creep", refitted=15.0
    ),
    "Nothing is missing: the error of 6.00 N is of the size of the noise (2.00 N between neighbouring "
    "readings, 6.00 N with the rows that are farther off than most).": result(
        "adequate", 6.0, 6.0, highest=6.0
    ),
    "With the entries as stated no catalogued effect explains the error of 40.0 N.": result(
        "ambiguous", 40.0, 40.0, doubted=True
    ),
    "Missing: Creep (probability 97 %). "
    "With it the error falls from 40.0 to 2.10 N, the noise of the data (2.00 N). These data "
    "cannot tell Creep from Leak. The model holds Creep: it is the most common of them; "
    "every rubber relaxes when it is held.": result(
        "ambiguous", 40.0, 2.1, "creep", alternatives=(SimpleNamespace(of="creep", effect="leak"),)
    ),
}


def test_a_title_in_brackets_takes_the_probability_into_them() -> None:
    found = result("missing_effects", 40.0, 2.1, "bladder_elasticity", "creep")
    said = sentence_of(found, {**CATALOGUE, "bladder_elasticity": BUILT_IN["bladder_elasticity"]})
    assert said.startswith("Missing: Bladder elasticity (hyperelastic, probability 97 %) and Creep (97 %).")


@pytest.mark.parametrize("sentence", SENTENCES)
def test_a_verdict_in_words(sentence: str) -> None:
    assert sentence_of(SENTENCES[sentence], CATALOGUE) == sentence


@pytest.mark.parametrize(
    ("status", "added", "title"),
    [
        ("adequate", False, "The model is adequate"),
        ("missing_effects", True, "Effects are missing"),
        ("unknown_effect", False, "Something is missing that no catalogued effect explains"),
        ("unknown_effect", True, "Effects are missing, and the rest is unknown"),
    ],
)
def test_a_status_has_a_title(status: str, added: bool, title: str) -> None:
    assert title_of(status, added=added) == title
    # An entry that may be wrong goes before it.
    assert title_of(status, added=added, doubted=True).startswith("An entry may be wrong")


def test_a_verdict_in_which_no_effect_is_likely_says_so() -> None:
    found = result("unknown_effect", 20.0, 2.0, "creep")
    found.none_likely, found.evidence[0].probability = True, 0.31
    assert title_of("unknown_effect", added=True, none_likely=True) == (
        "Something is missing, and no catalogued effect is likely"
    )
    assert sentence_of(found, CATALOGUE) == (
        "Missing: perhaps Creep (probability 31 %). With it the error falls from 20.0 to 2.00 N, the noise "
        "of the data (2.00 N). That effect is less likely than not: one that is in no catalogue may act in "
        "its place."
    )
    found = result("unknown_effect", 20.0, 2.0, "creep", "leak")
    found.none_likely = True
    assert sentence_of(found, CATALOGUE).endswith(
        "It is likelier that none of them is missing: one in no catalogue may act in their place."
    )


def test_constants_of_the_start_model_that_were_freed_are_named() -> None:
    found = result("missing_effects", 40.0, 2.1, "creep", refitted=30.0)
    found.root.freed = frozenset({"viscous_damping.coefficient"})
    freed = found.root.freed | {"viscous_damping.exponent", "viscous_damping.lengthening_ratio"}
    own = SimpleNamespace(rmse=4.0, freed=freed)
    found.path = (SimpleNamespace(fitted_model=own, refitted=True, correction=False), *found.path)
    said = sentence_of(found, CATALOGUE | {"viscous_damping": BUILT_IN["viscous_damping"]})
    assert (
        "The model's own numbers, refitted (with exponent and lengthening ratio of Viscous damping free), "
        "lower the error from 40.0 to 4.00 N; with it the error falls to 2.10 N"
    ) in said


@pytest.mark.parametrize(
    ("rmse", "implausible", "free", "reason"),
    [
        (2.3, 0, 1, "it leaves 2.10 N; Creep, which is more common, leaves 2.30 N"),
        (2.05, 1, 1, "Creep is more common and fits as well, but only with values outside their usual range"),
        (2.05, 0, 2, "Creep is more common and fits as well, but needs more values"),
        (2.1001, 0, 1, "Creep is more common and fits as well; nothing in these data decides between them"),
    ],
)
def test_the_applied_effect_has_a_reason_where_another_is_more_common(
    rmse: float, implausible: int, free: int, reason: str
) -> None:
    model = SimpleNamespace(rmse=rmse, implausible=implausible, free=[None] * free)
    other = SimpleNamespace(of="leak", effect="creep", fitted_model=model)
    found = result("ambiguous", 40.0, 2.1, "leak", alternatives=(other,))
    found.lean = SimpleNamespace(rmse=found.lean.rmse, implausible=0, free=[None])
    assert applied_reasons(found, CATALOGUE) == {"leak": reason}


def test_a_correction_is_said_with_its_errors_and_probability() -> None:
    found = result("missing_effects", 40.0, 2.1, "creep")
    item = {"effect": "leak", "before": 2.1, "after": 1.9, "probability": 0.12}
    found.corrections = (SimpleNamespace(**item, kept=True, formula=False),)
    assert corrections_sentence(found, TITLES) == (
        "Not called missing, but kept in the model, which predicts better with it: Leak (from 2.10 to "
        "1.90 N, probability 12 %); a slightly inexact form of another effect would explain as much."
    )
    found.corrections = (SimpleNamespace(**item, kept=False, formula=True),)
    assert corrections_sentence(found, TITLES) == (
        "Neither called missing nor kept: Leak (from 2.10 to 1.90 N, probability 12 %); a formula of "
        "the same variables that no catalogue has is likelier."
    )
    assert corrections_sentence(result("adequate", 2.0, 2.0), TITLES) == ""


def test_many_alternatives_are_grouped_by_family() -> None:
    names = ["creep", "mullins", "prestress", "force_offset"]
    text = by_mechanism(names, BUILT_IN)
    elastomer = ", ".join(BUILT_IN[name].title for name in names[:3])
    assert text == f"4 others (elastomer: {elastomer}; sensor: {BUILT_IN['force_offset'].title})"
    assert by_mechanism(names[:2], BUILT_IN) == f"{BUILT_IN['creep'].title} or {BUILT_IN['mullins'].title}"


def test_an_entry_that_explains_as_much_is_named_beside_the_effect_that_it_replaces() -> None:
    found = result("missing_effects", 40.0, 2.0, "creep", "leak")
    entries = (("the load", "creep"), ("the braid diameter", "creep"), ("the angle", "leak"))
    found.context = tuple(
        SimpleNamespace(
            stands=False, kept=False, effects=(), instead_of=(lost,), entry=SimpleNamespace(title=title)
        )
        for title, lost in entries
    )
    said = sentence_of(found, CATALOGUE)
    assert "Creep (probability 97 %, or the load or the braid diameter is wrong instead)" in said
    assert "Leak (97 %, or the angle is wrong instead)" in said
    found.context = tuple(SimpleNamespace(**{**vars(each), "kept": True}) for each in found.context)
    assert "wrong" not in sentence_of(found, CATALOGUE)


def test_an_effect_that_is_less_likely_than_not_is_only_perhaps_missing() -> None:
    found = result("missing_effects", 20.0, 2.0, "creep", "leak")
    found.evidence[1].probability = 0.3
    assert "Missing: Creep (probability 97 %) and perhaps Leak (30 %)." in sentence_of(found, CATALOGUE)


@pytest.mark.parametrize(
    ("start", "names", "said"),
    [
        (10.0, (), ""),
        (200.0, ("coulomb_friction",), "Coulomb friction (force 200 N) ends at the bound of the search"),
    ],
)
def test_a_named_cause_that_ends_at_its_bound_is_said_to(
    start: float, names: tuple[str, ...], said: str
) -> None:
    effect = BUILT_IN["coulomb_friction"]
    model = FitModel(MUSCLE).adding(effect, {"force": start, "static_share": 0.5})
    free = free_numbers(model, (), frozenset({"coulomb_friction.static_share"}))
    rows = np.ones((9, len(free)))
    fitted = FittedModel(model, free, frozenset(), rows[:, 0], rows, ())
    found = SimpleNamespace(best=fitted, added=("coulomb_friction",))
    text = bounds_sentence(found, BUILT_IN)
    assert ("Coulomb friction" in text) == bool(names)
    assert text.startswith(said)
    assert bounds_sentence(SimpleNamespace(best=fitted, added=()), BUILT_IN) == ""


def test_specimens_that_were_left_out_are_told_in_newtons_and_percent() -> None:
    found = result("adequate", 2.0, 2.0)
    found.best.holdout_rmse = 2.1
    found.left_out = ()
    assert left_out_sentence(found) == ""
    found.left_out = (left_out("short", 2.5, 0.018), left_out("long", 3.0, 0.007))
    text = left_out_sentence(found)
    assert text == (
        "Fitted to the other specimens alone, the model predicts short to 2.50 N (1.8 %) and "
        "long to 3.00 N (0.7 %)."
    )
    found.left_out = (*found.left_out, left_out("other", 9.0, 0.05), left_out("last", 2.0, 0.01))
    text = left_out_sentence(found)
    assert "each of the 4 to at most 9.00 N" in text
    assert text.endswith("On left-out groups of the same ones it errs by 2.10 N: they differ by more than "
                         "the model says.")  # fmt: skip


def left_out(name: str, rmse: float, share: float) -> LeftOutSpecimen:
    return LeftOutSpecimen(name, rmse, share)
