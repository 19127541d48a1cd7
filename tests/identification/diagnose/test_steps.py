"""The path of single steps, where the zero error of the gauge is read and not fitted."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from mckibben.identification.diagnose.steps import path_to

#: Error of the model with these effects; "zero" is the zero error of the gauge.
ERRORS = {
    "": 65.6, "wall": 4.9, "friction": 64.0, "wall friction": 3.1,
    "zero": 68.0, "wall zero": 2.3, "friction zero": 67.0, "wall friction zero": 1.06,
}  # fmt: skip


def model(names: str, errors: dict[str, float], freed: frozenset[str] = frozenset()) -> Any:
    """A fitted model of these effects, some of whose further constants are free."""
    ids = tuple(sorted(names.split(), key=["wall", "friction", "zero"].index))
    effects = [SimpleNamespace(id=name) for name in ids]
    chosen = SimpleNamespace(ids=ids, effects=effects)
    return SimpleNamespace(rmse=errors[" ".join(ids)], free=(1,), freed=freed, fit_model=chosen)


def fitter(errors: dict[str, float]) -> Any:
    """One that looks errors up."""

    def adding(one: Any, effect: Any) -> Any:
        return model(" ".join((*one.fit_model.ids, effect.id)), errors)

    def dropping(one: Any, name: str) -> Any:
        return model(" ".join(each for each in one.fit_model.ids if each != name), errors)

    exact = SimpleNamespace(reading_errors=())
    return SimpleNamespace(adding=adding, dropping=dropping, predictor=exact)


@pytest.mark.parametrize(
    ("changed", "steps"),
    [
        ({}, [(None, 65.6), ("wall", 4.9), ("zero", 2.3), ("friction", 1.06)]),
        ({"zero": 60.0}, [(None, 65.6), ("zero", 60.0), ("wall", 2.3), ("friction", 1.06)]),
        ({"wall zero": 5.0}, [(None, 65.6), ("wall", 4.9), ("friction", 3.1), ("zero", 1.06)]),
    ],
)
def test_no_step_raises_the_error_for_the_zero_error_of_the_gauge(
    changed: dict[str, float], steps: list[tuple[str | None, float]]
) -> None:
    errors = {**ERRORS, **changed}
    zero: Any = SimpleNamespace(effect=SimpleNamespace(id="zero"))
    whole = model("wall friction zero", errors)
    path = path_to(fitter(errors), model("", errors), model("zero", errors), whole, zero)
    assert [(step.added, step.fitted_model.rmse) for step in path] == steps


@pytest.mark.parametrize(
    ("beside", "alone", "credited"), [(1.25, 1.4, 1.25), (1.4, 1.3, 1.3), (6.0, 7.0, 5.0)]
)
def test_what_the_own_laws_of_the_start_model_explain_is_credited_to_no_effect(
    beside: float, alone: float, credited: float
) -> None:
    """The best model has bent a law of the start model; without the added effect that does most of it."""
    bent = frozenset({"wall.exponent"})
    root = model("wall", {"wall": 5.0})
    best = model("wall friction", {"wall friction": 1.1}, bent | {"friction.share"})
    asked: list[frozenset[str]] = []

    def fit(fit_model: Any, freed: frozenset[str], *, again: bool) -> Any:
        assert again
        asked.append(freed)
        return model(" ".join(fit_model.ids), {"wall": alone}, freed)

    def dropping(_: Any, name: str) -> Any:
        assert name == "friction"
        return model("wall", {"wall": beside}, bent)

    fits: Any = SimpleNamespace(fit=fit, dropping=dropping, predictor=SimpleNamespace(reading_errors=()))
    path = path_to(fits, model("wall", {"wall": 7.0}), root, best, None)
    assert [(step.added, step.fitted_model.rmse) for step in path] == [
        (None, 7.0), (None, credited), ("friction", 1.1),
    ]  # fmt: skip
    assert [step.refitted for step in path] == [False, True, False]
    assert asked == [bent]
