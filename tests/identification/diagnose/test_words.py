"""The verdict in words: error before and after, the noise, what is left."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from mckibben.identification.diagnose.verdict import Interval
from mckibben.identification.diagnose.words import sentence_of, title_of
from mckibben.identification.residual.structure import ResidualStructure

TITLES = {"creep": "Creep", "leak": "Leak"}


def result(
    status: str, before: float, after: float, *added: str, unit: str = "N", noise: float | None = 2.0,
    share: float = 0.05, alternatives: tuple[Any, ...] = (), refitted: float | None = None,
    highest: float | None = None, doubted: bool = False, term: object = None,
) -> Any:  # fmt: skip
    return SimpleNamespace(
        status=status,
        predictor=SimpleNamespace(unit=unit, channels=[SimpleNamespace(name="force" if unit == "N" else "")]),
        start=SimpleNamespace(rmse=before),
        root=SimpleNamespace(rmse=before if refitted is None else refitted, free=refitted is not None),
        best=SimpleNamespace(rmse=after),
        added=added,
        noise=noise,
        noise_interval=None if highest is None else Interval(noise or 0.0, highest),
        context=(SimpleNamespace(stands=True),) if doubted else (),
        alternatives=alternatives,
        term=term,
        left_where=(
            SimpleNamespace(over="load", worst="load 1 to 2 N", rmse=99.0),
            SimpleNamespace(over="time", worst="time 3.00 to 4.00 s", rmse=11.0 * after / 10.0),
            SimpleNamespace(over="pressure", worst="pressure 5.00 to 6.00 bar", rmse=13.0 * after / 10.0),
        ),
        structure=ResidualStructure(share, (("pressure", 0.5), ("time", 0.2), ("velocity", 0.1))),
    )


SENTENCES = {
    "Nothing is missing: the error of 2 N is of the size of the noise (2 N).": result("adequate", 2.0, 2.0),
    "Nothing is missing: the error of 2 N (with the numbers of the model refitted; before 50 N) is of the "
    "size of the noise (2 N).": result("adequate", 50.0, 2.0),
    "Nothing is missing: the error of 1 times the noise is noise.": result(
        "adequate", 1.0, 1.0, unit="1", noise=1.0
    ),
    "No catalogued effect lowers the error of 5 N. The noise cannot be estimated from these data: "
    "state it to know whether the error exceeds it.": result("adequate", 5.0, 5.0, noise=None),
    "Missing: Creep. With it the error falls from 40 to 2.1 N, the noise of the data (2 N).": result(
        "missing_effects", 40.0, 2.1, "creep"
    ),
    "Missing: Creep and Leak. With them the error falls from 4 to 1.02 times the noise.": result(
        "missing_effects", 4.0, 1.02, "creep", "leak", unit="1", noise=1.0
    ),
    "Missing: Creep. With it the error falls from 40 to 3 mm; the noise is 2 mm. Of the rest, 40 % depends "
    "on pressure and time.": result(
        "missing_effects", 0.040, 0.003, "creep", unit="m", noise=2e-3, share=0.4
    ),
    "Missing: Creep. With it the error falls from 40 to 9 N; the noise is 2 N. No catalogued effect explains "
    "the rest: it depends on no measured variable; repeat the run to see whether it recurs.": result(
        "unknown_effect", 40.0, 9.0, "creep"
    ),
    "No catalogued effect explains the error of 40 N: 90 % of it depends on pressure and time. No short "
    "formula halves it; look where it is largest: pressure 5.00 to 6.00 bar (52 N) and time 3.00 to 4.00 s "
    "(44 N).": result("unknown_effect", 40.0, 40.0, share=0.9),
    "No catalogued effect explains the error of 40 N: 90 % of it depends on pressure and time.": result(
        "unknown_effect", 40.0, 40.0, share=0.9, term=object()
    ),
    "Missing: Creep. With it the error falls from 40 to 10 mm; the noise is 2 mm. No catalogued effect "
    "explains the rest: 90 % of it depends on pressure and time. No formula is proposed; look where it is "
    "largest: pressure 5.00 to 6.00 bar (13 mm) and time 3.00 to 4.00 s (11 mm).": result(
        "unknown_effect", 0.040, 0.010, "creep", unit="m", noise=2e-3, share=0.9
    ),
    "Missing: Creep. The model's own numbers, refitted, lower the error from 40 to 15 N; with it the error "
    "falls to 2.1 N, the noise of the data (2 N).": result(
        "missing_effects", 40.0, 2.1, "creep", refitted=15.0
    ),
    "Nothing is missing: the error of 6 N is of the size of the noise (2 N between neighbouring readings, "
    "6 N in all).": result("adequate", 6.0, 6.0, highest=6.0),
    "With the entries as stated no catalogued effect explains the error of 40 N.": result(
        "ambiguous", 40.0, 40.0, doubted=True
    ),
    "Missing: Creep. With it the error falls from 40 to 2.1 N, the noise of the data (2 N). These data "
    "cannot tell Creep from Leak.": result(
        "ambiguous", 40.0, 2.1, "creep", alternatives=(SimpleNamespace(of="creep", effect="leak"),)
    ),
}


@pytest.mark.parametrize("sentence", SENTENCES)
def test_a_verdict_in_words(sentence: str) -> None:
    assert sentence_of(SENTENCES[sentence], TITLES) == sentence


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
