"""Figures of a diagnosis: what each effect would do, how likely it is missing, what is left to explain."""

from __future__ import annotations

from dataclasses import replace

from mckibben.facts.comparison import COMPARISON
from mckibben.facts.figure import Condition, Figure, Group

_TRIED = Condition("effects were tried", "no effect was tried")
_FINISHED = Condition("the search is finished", "the search is not finished")
_REPEATS = Condition("something repeats beyond doubt", "nothing repeats beyond doubt")
_EXPLAINS = Condition(
    "something repeats or a formula predicts the groups left out",
    "nothing repeats, and no formula predicts the groups left out",
)
_DOUBTED = Condition("a stated value is in doubt", "no stated value is in doubt")
_TWINS = Condition("there are effects that the data cannot tell apart", "the data can tell all effects apart")
_PROTOCOL = Condition(
    "an experiment of this rig tells them apart", "no experiment of this rig tells them apart"
)
_KEPT = Condition("there is a small correction", "there is no small correction")

DIAGNOSIS = Group(
    "diagnosis",
    "Diagnosis",
    replace(COMPARISON["rmse_beyond_accuracy"], name="rmse"),
    Figure(
        "nrmse_percent", "", "%", "Error of the largest measured magnitude",
        "100 × the error of the start model as given over max |measured|.",
        COMPARISON["nrmse_percent"].exists_when,
    ),
    replace(
        COMPARISON["holdout_rmse"],
        definition="The error over whole groups of rows, each predicted with values fitted to the others (to "
        "first order around the fit). Of the start model as given, in which nothing is fitted, the error.",
    ),
    COMPARISON["fitted"],
    Figure(
        "gain_percent", "", "%", "Gain over the refitted start model",
        "100 (1 − error with the effect/error of the start model with its own values refitted); everything "
        "is "
        "refitted with the effect.", _TRIED,
    ),
    Figure(
        "probability", "P", "1", "Probability",
        "Probability that the effect, or one that the data cannot tell from it, is missing.",
        _FINISHED, quantity="ratio",
    ),
    Figure("rmse_before", "", "", "Error without it", "The error without the correction.", _KEPT),
    Figure("rmse_after", "", "", "Error with it", "The error with it, everything refitted."),
    Figure(
        "unexplained_share", "", "1", "Share of the squared error left to explain",
        "Share of mean(r²) of the best model that a regression without physics predicts, cross-validated; "
        "of an "
        "unknown effect at least 1 − σ²/mean(r²), all above the noise σ.", quantity="ratio",
    ),
    Figure(
        "share", "", "1", "Share of the remaining squared error that it explains",
        "Share of mean(r²) of the best model that the repetition or the formula removes.",
        _EXPLAINS, quantity="ratio",
    ),
    Figure(
        "period", "", "", "Period", "Period of the repetition over a length, a pressure or the time.",
        _REPEATS,
    ),
    Figure(
        "amplitude", "", "", "Amplitude",
        "Amplitude of the repetition; at the mean pressure where it grows with it.", _REPEATS,
    ),
    Figure(
        "value", "", "", "Value that fits instead",
        "Best value of the entry in doubt; of a way of reading, the other one in words.", _DOUBTED,
    ),
    Figure("stderr", "±", "", "± standard error", "Standard error of that value.", _DOUBTED),
    Figure(
        "explains", "", "1", "Share of the squared error above the noise that the entry explains",
        "Share of mean(r²) − σ² of the start model that another value of the entry removes by itself.",
        _DOUBTED, quantity="ratio",
    ),
    Figure(
        "confidence", "P", "1", "Probability that the entry is wrong",
        "Probability of the model with another value of the entry against the best model with the stated "
        "one.", _DOUBTED, quantity="ratio",
    ),
    Figure(
        "separation", "", "1", "Separation in standard deviations of a reading",
        "Expected RMS difference of the two models after both adapted, over the noise of one reading.",
        _TWINS, quantity="number",
    ),
    Figure("minutes", "", "min", "Duration of the experiment", "With 30 s to set up each run.", _PROTOCOL),
    Figure(
        "difference", "", "1", "Difference in standard deviations of a reading",
        "RMS difference of the two models as they are in the simulated experiment where it is largest, over "
        "the noise of one reading.", _TWINS, quantity="number",
    ),
)  # fmt: skip
