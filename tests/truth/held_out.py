"""Other conditions for the rig of a case: within what it measured, at other levels and at twice the speed."""

from __future__ import annotations

from dataclasses import replace

from tests.truth.composition import Record, Truth

_STROKE = 0.85  # share of the contraction
_PRESSURE = 0.93  # share of the pressure
_LOAD = 0.85  # share of the load
_TIME = 0.5  # share of the time


def other_conditions(record: Record, truth: Truth, kind: str) -> Record:
    """The same test at levels between the measured ones, twice as fast.

    Args:
        record: the test that the diagnosis sees.
        truth: for the length without contraction.
        kind: of test.
    """
    rest = truth.muscle.nominal
    return replace(
        record,
        time=record.time * _TIME,
        pressure=record.pressure * (1.0 if kind == "isotonic" else _PRESSURE),
        length=rest - _STROKE * (rest - record.length),
        load=None if record.load is None else record.load * _LOAD,
    )
