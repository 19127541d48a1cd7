"""Rows that do not fit are named, set aside, and decide no verdict."""

from __future__ import annotations

from pathlib import Path

import pytest

import mckibben as mk
from tests.claims.test_verdicts import loops, model


def spoilt(path: Path, rows: dict[int, float]) -> Path:
    """Loops of the known truth with a force added to some rows, counted from 1."""
    loops(path)
    lines = path.read_text().splitlines()
    for row, force in rows.items():
        *others, last = lines[row + 2].split(",")
        lines[row + 2] = ",".join([*others, f"{float(last) + force:.3f}"])
    path.write_text("\n".join(lines))
    return path


@pytest.mark.parametrize("rows", [{100: 60.0}, {46: -45.0, 200: 80.0}])
def test_bad_rows_are_named_and_the_verdict_is_that_of_the_others(
    tmp_path: Path, rows: dict[int, float]
) -> None:
    found = model().diagnose(mk.read(spoilt(tmp_path / "loops.csv", rows)))
    assert {each.row for each in found.suspect_rows} == set(rows)
    for each in found.suspect_rows:
        assert each.residual == pytest.approx(rows[each.row], abs=10.0)
        assert f"row {each.row}" in found.verdict.sentence
    assert (found.verdict.status, found.verdict.effects) == ("adequate", [])
    assert found.verdict.proofs is not None
    assert found.verdict.proofs.no_outliers


def test_what_is_missing_is_missing_beside_a_bad_row_too(tmp_path: Path) -> None:
    file = mk.read(spoilt(tmp_path / "loops.csv", {100: 300.0}))
    found = model().without("coulomb_friction").diagnose(file)
    assert found.verdict.effects == ["coulomb_friction"]
    assert [each.row for each in found.suspect_rows] == [100]
    # The errors that are told are those that a comparison of all rows shows.
    added = found.model.compare(file)
    assert found.path[-1].rmse == pytest.approx(added.rmse, rel=1e-6)


def test_a_file_without_bad_rows_names_none(tmp_path: Path) -> None:
    assert model().diagnose(mk.read(loops(tmp_path / "loops.csv"))).suspect_rows == []


def test_a_limit_that_ends_the_second_look_keeps_the_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Setting rows aside begins anew: where the time is over then, what all rows say is still there."""
    from mckibben.identification.diagnose import diagnosis
    from mckibben.identification.fit.fitter import CancelledError
    from mckibben.simulation.outcome import Outcome

    begin, looks = diagnosis.prepare, []

    def timed(*given: object, **more: object) -> object:
        looks.append(given)
        if len(looks) > 1:
            raise CancelledError(Outcome.TIMED_OUT)
        return begin(*given, **more)  # type: ignore[arg-type]

    monkeypatch.setattr(diagnosis, "prepare", timed)
    found = model().diagnose(mk.read(spoilt(tmp_path / "loops.csv", {100: 60.0})))
    assert len(looks) == 2
    assert found.suspect_rows == []
    assert found.verdict.proofs is not None
    assert found.verdict.proofs.no_outliers is False
