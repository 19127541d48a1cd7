"""What must hold whatever the file: the way of writing changes nothing, and no value changes in silence."""

from __future__ import annotations

import itertools
import time

import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_here
from mckibben.measurement.reading.correction import Correction
from mckibben.physics.errors import InputError
from tests.measurement.reading.bench import (
    ABOVE,
    FORCE,
    PRESSURE,
    SI,
    STROKE,
    TIME,
    asked,
    assert_is,
    read,
    table,
)

COLUMNS = {"Zeit [s]": TIME, "Druck [bar]": PRESSURE / 1e5, "Kraft [N]": FORCE, "Hub [mm]": STROKE * 1e3}
REMARKS = (
    "# Prüfling DMSP-20, Ruhelänge 300 mm", "# Druck ist Überdruck", "# Zugkraft positiv, Verkürzung positiv",
    "# Versorgung 7 bar", "# 02.05.2024, hw",
)  # fmt: skip
CHANNELS = ("pressure", "force", "displacement", "time")


def written(columns: dict[str, np.ndarray], remarks: tuple[str, ...] = REMARKS) -> str:
    return "\n".join([*remarks, ";".join(columns), table(*columns.values(), separator=";")])


def differing(found: Measurement) -> list[str]:
    """The channels that are not read as they are."""
    return [
        c for c in CHANNELS
        if c in found.columns and not np.allclose(found.columns[c], SI[c], atol=1e-5 * np.max(np.abs(SI[c])))
    ]  # fmt: skip


@pytest.mark.parametrize("order", list(itertools.permutations(COLUMNS))[::5])
def test_the_order_of_columns_changes_nothing(order: tuple[str, ...]) -> None:
    assert_is(read(written({head: COLUMNS[head] for head in order})))


@pytest.mark.parametrize("gone", range(len(REMARKS)))
def test_a_remark_taken_away_changes_no_value_in_silence(gone: int) -> None:
    data = written(COLUMNS, tuple(r for i, r in enumerate(REMARKS) if i != gone))
    found = read(data)
    assert not differing(found)
    if "nominal_length" not in found.conditions:
        assert "rest length" in asked(data)


@pytest.mark.parametrize(("place", "part"), list(itertools.product(range(4), ("name", "unit", "head"))))
def test_a_word_of_a_head_taken_away_changes_no_value_in_silence(place: int, part: str) -> None:
    heads = list(COLUMNS)
    name, _, unit = heads[place].partition(" ")
    heads[place] = {"name": unit, "unit": name, "head": "x1"}[part]
    data = written(dict(zip(heads, COLUMNS.values(), strict=True)))
    questions = asked(data)
    try:
        found = read(data)
    except InputError:
        assert questions
        return
    assert not differing(found) or questions
    missing = [c for c in CHANNELS if c not in found.columns]
    assert not missing or missing == ["time"] or questions


@pytest.mark.parametrize(
    ("head", "factor"),
    [
        ("Druck [mbar]", 1e-2),
        ("Druck [kPa]", 1e-3),
        ("Druck [MPa]", 1e-6),
        ("Druck [psi]", 1 / 6894.757293168361),
        ("Druck [kgf/cm2]", 1 / 98066.5),
        ("Druck [Pa]", 1.0),
    ],
)
def test_units_of_pressure_change_nothing(head: str, factor: float) -> None:
    columns = {head if h.startswith("Druck") else h: v for h, v in COLUMNS.items()}
    columns[head] = PRESSURE * factor
    assert_is(read(written(columns)))


@pytest.mark.parametrize(
    "extra", ["Nr", "Bemerkung", "Temperatur [°C]", "Spannung [V]", "Druck Versorgung [bar]"]
)
def test_a_further_column_changes_nothing(extra: str) -> None:
    values = {"Nr": np.arange(1.0, len(TIME) + 1), "Temperatur [°C]": 22.0 + 0.01 * TIME}.get(
        extra, 6.0 + 0.0 * TIME
    )
    assert_is(read(written({extra: values, **COLUMNS})))


def test_a_question_that_is_answered_is_gone() -> None:
    data = written(
        {"Druck": PRESSURE / 1e5, **{h: v for h, v in COLUMNS.items() if not h.startswith("Druck")}}
    )
    assert asked(data)["unit of pressure"]
    from tests.measurement.reading.bench import said

    correction = said(["pressure=Druck [bar]"])
    assert "unit of pressure" not in asked(data, correction=correction)
    assert_is(read(data, correction=correction))


HOSTILE = {
    "a long head": lambda n: "x" * n + ",p_bar,F_N\n1,2,3\n2,3,4\n3,4,5\n",
    "brackets": lambda n: "p " + "[" * n + "bar" + "]" * n + ",F_N\n1,2\n2,3\n3,4\n",
    "remarks": lambda n: "# L0 = 250 mm rest length 3 bar\n" * (n // 8) + "p_bar,F_N\n1,2\n2,3\n3,4\n",
    "a long remark": lambda n: "# " + "0-10 V = 0-" * n + "\np_bar,F_N\n1,2\n2,3\n3,4\n",
    "formulas": lambda n: "# " + "p=1*U+" * n + "\np_bar,F_N\n1,2\n2,3\n3,4\n",
    "nested lists": lambda n: "[" * n + "]" * n,
    "many columns": lambda n: "\n".join(
        [",".join(f"c{i} [mm]" for i in range(n // 20)), *[",".join(["1.5"] * (n // 20))] * 20]
    ),
    "blocks": lambda n: "p_bar,F_N,L_mm\n1,2,3\n2,3,4\n3,4,5\n" * (n // 20),
    "markup": lambda n: "<!---->" * n,
}  # fmt: skip


def _refusal_of(data: bytes) -> str:
    try:
        read_here(data, "a.csv", Correction())
    except InputError as error:
        return error.message
    return ""


@pytest.mark.parametrize("kind", HOSTILE)
def test_the_time_grows_no_faster_than_the_file(kind: str) -> None:
    spent = []
    for size in (1000, 4000):
        begin = time.process_time()
        message = _refusal_of(HOSTILE[kind](size).encode())
        assert len(message) < 3000
        spent.append(time.process_time() - begin)
    assert spent[1] < 8.0 * max(spent[0], 0.05), spent


def test_any_byte_changed_ends_in_an_answer() -> None:
    data = bytearray(written(COLUMNS).encode())
    rng = np.random.default_rng(5)
    for place, value in zip(rng.integers(0, len(data), 60), rng.integers(0, 256, 60), strict=True):
        changed = bytes(data[:place]) + bytes([value]) + bytes(data[place + 1 :])
        try:
            found = read_here(changed, "a.csv", Correction())
        except InputError:
            continue
        assert found.rows > 0


def test_the_remarks_of_the_bench_are_read() -> None:
    found = read(written(COLUMNS))
    assert found.conditions["muscle"] == "DMSP-20"
    assert found.conditions["supply_pressure"] == 7e5
    assert ABOVE
