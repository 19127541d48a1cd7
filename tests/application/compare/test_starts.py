"""Fitted starts in words: of each run one sentence, with errors, or the limit where the fit ended."""

from __future__ import annotations

from mckibben.application.compare.starts import start_messages
from mckibben.identification.fit.least_squares import FitResult, Fitted


def test_each_run_has_a_sentence_and_a_limit_stands_with_its_number() -> None:
    found = (
        Fitted("viscous_damping.coefficient", 5.0, 0.1, "N*s/m", at_bound=False),
        Fitted("start_stroke_1", -5.22e-4, None, "m", at_bound=True),
        Fitted("start_speed_1", 1.56e-3, 3.9e-3, "m/s", at_bound=False),
        Fitted("start_stroke_2", 2e-5, 5e-6, "m", at_bound=False),
    )
    assert start_messages(FitResult(found, (), ())) == [
        "start of run 1, fitted: stroke \N{MINUS SIGN}0.522 mm (at its limit) beyond its first reading, "
        "speed +1.56 ± 3.9 mm/s",
        "start of run 2, fitted: stroke +0.02 ± 0.005 mm beyond its first reading, speed 0 mm/s",
    ]
    assert start_messages(None) == []
