"""Work on records in two threads: in order, and what raises is told."""

from __future__ import annotations

import threading

import pytest

from mckibben.identification.predict.side_by_side import side_by_side


def test_two_items_are_worked_on_at_once_and_come_back_in_order() -> None:
    met = threading.Barrier(2, timeout=20.0)

    def work(item: int) -> int:
        met.wait()  # would break in one thread
        return item * item

    assert side_by_side(work, [3, 2]) == [9, 4]


def test_a_single_item_stays_in_its_thread() -> None:
    assert side_by_side(lambda _: threading.get_ident(), ["one"]) == [threading.get_ident()]
    assert side_by_side(lambda _: 1, []) == []


def test_items_of_items_do_not_wait_for_each_other() -> None:
    def rows(item: int) -> list[int]:
        return side_by_side(lambda part: 10 * item + part, [1, 2, 3])

    assert side_by_side(rows, [1, 2, 3, 4]) == [
        [10 * item + part for part in (1, 2, 3)] for item in (1, 2, 3, 4)
    ]


def test_an_error_of_an_item_is_raised() -> None:
    def work(item: int) -> float:
        return 1.0 / item

    with pytest.raises(ZeroDivisionError):
        side_by_side(work, [1, 0, 2])
