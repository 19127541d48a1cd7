"""Projects on SQLite and PostgreSQL: the same suite on both."""

from __future__ import annotations

import hashlib
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import pytest
from sqlalchemy import select

from mckibben.physics.errors import InputError
from mckibben.projects import store as module
from mckibben.projects.database import Database
from mckibben.projects.project import ChangedElsewhereError, Revision, StoredAnswer, StoredFile, StoredStudy
from mckibben.projects.store import ProjectStore
from mckibben.projects.tables import ContentRow

DOCUMENT = {"schema": 1, "design": {"muscle": {"preset": "DMSP-20"}, "notes": "Größe 20 · 0.3 m 🙂"}}
CSV = b"# kind: static\npressure_bar,length_mm,force_N\n3,300,900\n"
FILE = StoredFile(hashlib.sha256(CSV).hexdigest(), "map.csv", CSV)
TABLE = StoredStudy("a" * 32, "b" * 64, 3, b"head\nthree rows\n")


def test_what_is_saved_is_opened(store: ProjectStore) -> None:
    made = store.create(DOCUMENT, title="  Lift,\n second muscle ", notes="measured by Ada", files=[FILE])
    opened = store.open(made.summary.id)
    assert opened == made
    assert opened.document == DOCUMENT
    assert (opened.summary.title, opened.summary.notes) == ("Lift, second muscle", "measured by Ada")
    assert (opened.summary.version, opened.summary.files) == (1, 1)
    assert opened.summary.size > len(CSV)
    assert opened.measurements == (FILE.measurement,)
    assert list(store.files(made.summary.id)) == [FILE]
    assert [each.id for each in store.list()] == [made.summary.id]


def test_a_window_with_an_earlier_version_does_not_overwrite(store: ProjectStore) -> None:
    identity = store.create(DOCUMENT, title="Lift").summary.id
    store.save(identity, {"from": "one"}, base_version=1, label="mass 20 kg")
    with pytest.raises(ChangedElsewhereError) as caught:
        store.save(identity, {"from": "two"}, base_version=1)
    assert (caught.value.last.version, caught.value.last.label) == (2, "mass 20 kg")
    assert store.open(identity).document == {"from": "one"}
    with pytest.raises(ChangedElsewhereError):
        store.describe(identity, base_version=1, title="Other")
    assert store.save(identity, {"from": "two"}, base_version=2).summary.version == 3


def test_of_many_windows_that_save_at_once_one_wins(store: ProjectStore) -> None:
    identity = store.create(DOCUMENT, title="Lift").summary.id
    start = threading.Barrier(6)

    def save(number: int) -> bool:
        start.wait(10.0)
        try:
            store.save(identity, {"from": number}, base_version=1)
        except ChangedElsewhereError:
            return False
        return True

    with ThreadPoolExecutor(6) as pool:
        won = list(pool.map(save, range(6)))
    assert won.count(True) == 1
    assert store.open(identity).document == {"from": won.index(True)}
    assert store.open(identity).summary.version == 2


def test_history_goes_back(store: ProjectStore) -> None:
    identity = store.create({"step": 1}, title="Lift").summary.id
    for step in (2, 3):
        store.save(identity, {"step": step}, base_version=step - 1, label=f"step {step}")
    store.describe(identity, base_version=3, title="Lift 2", notes="n")
    assert [(each.version, each.label) for each in store.history(identity)] == [
        (4, "title: Lift 2"),
        (3, "step 3"),
        (2, "step 2"),
        (1, "created"),
    ]
    assert store.open(identity, 2).document == {"step": 2}
    assert store.open(identity).document == {"step": 3}
    with pytest.raises(InputError, match="no version 9") as caught:
        store.open(identity, 9)
    assert caught.value.code == "not_found"


def test_automatic_saves_replace_each_other_for_some_minutes(
    store: ProjectStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [1_000_000_000_000]
    monkeypatch.setattr(module, "_now", lambda: now[0])
    identity = store.create({"step": 0}, title="Lift").summary.id
    for step in range(1, 9):
        now[0] += 100_000
        store.save(identity, {"step": step}, base_version=step, automatic=True, label="changed")
    kept = [each.version for each in reversed(store.history(identity))]
    assert kept[0] == 1
    assert kept[-1] == 9
    assert 3 <= len(kept) <= 5, "one for each five minutes"


def test_a_long_history_loses_its_oldest_automatic_revisions_first(
    store: ProjectStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "_MOST_REVISIONS", 5)
    monkeypatch.setattr(module, "_MERGED", 1)
    identity = store.create({"step": 0}, title="Lift").summary.id
    for step in range(1, 8):
        store.save(identity, {"step": step}, base_version=step, automatic=step % 2 == 1, label=f"{step}")
    labels = [each.label for each in store.history(identity)]
    assert len(labels) == 5
    assert labels[:1] == ["7"]
    assert {"created", "2", "4", "6"} >= set(labels[1:])


def test_the_bin_gives_back(store: ProjectStore) -> None:
    identity = store.create(DOCUMENT, title="Lift", files=[FILE]).summary.id
    store.delete(identity)
    assert store.list() == []
    assert [each.id for each in store.list(deleted=True)] == [identity]
    for refused in (
        lambda: store.open(identity),
        lambda: list(store.files(identity)),
        lambda: store.history(identity),
        lambda: store.save(identity, {}, base_version=1),
    ):
        with pytest.raises(InputError) as caught:
            refused()
        assert caught.value.code == "not_found"
    store.restore(identity)
    assert store.open(identity).document == DOCUMENT
    with pytest.raises(InputError, match="only a deleted project"):
        store.erase(identity)
    store.delete(identity)
    store.erase(identity)
    assert store.list(deleted=True) == []


@pytest.mark.parametrize("jump", [-20, 20])
def test_a_clock_that_jumps_by_years_ends_nothing(
    store: ProjectStore, monkeypatch: pytest.MonkeyPatch, jump: int
) -> None:
    now = [1_600_000_000_000]
    monkeypatch.setattr(module, "_now", lambda: now[0])
    binned = store.create(DOCUMENT, title="old", files=[FILE]).summary.id
    store.delete(binned)
    identity = store.create({}, title="Lift").summary.id
    store.save(identity, {"step": 1}, base_version=1, studies=[TABLE])
    now[0] += jump * 365 * 86_400_000
    store.create({}, title="new")
    later = StoredStudy("c" * 32, "b" * 64, 1, b"head\none\n")
    store.save(identity, {"step": 2}, base_version=2, automatic=True, studies=[later])
    assert store.open(identity).document == {"step": 2}
    assert [each.version for each in store.history(identity)] == [3, 2, 1]
    assert store.studies(identity) == [later, TABLE]
    assert [each.id for each in store.list(deleted=True)] == [binned]
    assert store.restore(binned).files == 1


def test_a_copy_is_its_own(store: ProjectStore) -> None:
    identity = store.create(DOCUMENT, title="Lift", notes="n", files=[FILE]).summary.id
    copy = store.duplicate(identity)
    assert (copy.summary.title, copy.summary.notes) == ("Lift (copy)", "n")
    assert copy.measurements == (FILE.measurement,)
    store.save(copy.summary.id, {"other": 1}, base_version=1)
    assert store.open(identity).document == DOCUMENT
    store.delete(identity)
    store.erase(identity)
    assert list(store.files(copy.summary.id)) == [FILE]


@pytest.mark.parametrize(
    ("title", "document", "words"),
    [
        (" \n", {}, "needs a title"),
        ("x" * 201, {}, "201 characters"),
        ("Lift", {"x": float("nan")}, "cannot be stored"),
        ("Lift", {"x": "a\0b"}, "zero character"),
        ("Lift", {"x": "\ud800"}, "cannot be stored"),
        ("Lift", {"x": "x" * 900_001}, "at most|characters"),
    ],
)
def test_what_cannot_be_stored_is_refused(
    store: ProjectStore, title: str, document: dict, words: str
) -> None:
    with pytest.raises(InputError, match=words):
        store.create(document, title=title)
    assert store.list() == []


@pytest.mark.parametrize("version", [0, -1, 10**12, 10**30])
def test_versions_that_no_project_has(store: ProjectStore, version: int) -> None:
    identity = store.create(DOCUMENT, title="Lift").summary.id
    with pytest.raises(InputError, match="no version"):
        store.open(identity, version)
    with pytest.raises(ChangedElsewhereError):
        store.save(identity, {}, base_version=version)
    with pytest.raises(InputError, match="different numbers from 1"):
        store.revive([(Revision(version, 0.0, "x", False), {})], title="Lift")


@pytest.mark.parametrize("saved", [-1.0, 1e308, float("inf"), float("nan")])
def test_an_impossible_instant_is_refused(store: ProjectStore, saved: float) -> None:
    with pytest.raises(InputError, match="no possible instant"):
        store.revive([(Revision(1, saved, "x", False), {})], title="Lift")


def test_hostile_texts_are_texts(store: ProjectStore) -> None:
    title = "'; DROP TABLE projects; -- <script>"
    identity = store.create({"x": title}, title=title, notes="a\0b").summary.id
    assert store.open(identity).summary.title == title
    assert store.open(identity).summary.notes == "ab"
    with pytest.raises(InputError):
        store.open("' OR 1=1 --")


def test_two_servers_share_a_database(database: Database) -> None:
    first, second = ProjectStore(database), ProjectStore(database)
    identity = first.create(DOCUMENT, title="Lift").summary.id
    second.save(identity, {"by": "second"}, base_version=1)
    assert first.open(identity).document == {"by": "second"}


def test_a_study_table_stays_with_its_project(store: ProjectStore) -> None:
    identity = store.create(DOCUMENT, title="Lift", studies=[TABLE]).summary.id
    assert store.studies(identity) == [TABLE]
    store.save(identity, {}, base_version=1)
    assert store.open(identity).studies == (TABLE.study,)
    assert store.studies(store.duplicate(identity).summary.id) == [TABLE]
    assert store.open(identity).summary.size == len("{}") + len(TABLE.content)
    moved = store.revive([(Revision(1, 0.0, "x", False), {})], title="Lift", studies=store.studies(identity))
    for each in (identity, moved.summary.id):
        store.delete(each)
        store.erase(each)
    assert store.studies(store.list()[0].id) == [TABLE], "the copy keeps it"


def test_a_longer_table_of_the_same_study_replaces_it(store: ProjectStore) -> None:
    identity = store.create(DOCUMENT, title="Lift", studies=[TABLE]).summary.id
    longer = replace(TABLE, runs=5, content=b"head\nfive rows\n")
    store.save(identity, {}, base_version=1, studies=[longer])
    store.save(identity, {}, base_version=2, studies=[TABLE])
    assert store.studies(identity) == [longer]
    with store._database.session() as session:
        contents = session.scalars(select(ContentRow.data)).all()
    assert contents == [longer.content], "what nobody needs is not kept"


def test_finished_diagnoses_stay_with_their_project(
    store: ProjectStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second, third = (StoredAnswer(name * 64, b"[]\n" + name.encode()) for name in "abc")
    identity = store.create(DOCUMENT, title="Lift", answers=[first]).summary.id
    store.save(identity, {}, base_version=1, answers=[first, second])
    assert list(store.answers(identity)) == [first, second]
    assert list(store.answers(identity, {first.name})) == [second]
    assert list(store.answers(store.duplicate(identity).summary.id)) == [first, second]
    monkeypatch.setattr(module, "_MOST_ANSWERS", 1)
    store.save(identity, {}, base_version=2, answers=[third])
    assert list(store.answers(identity)) == [third]


def test_study_tables_saved_first_give_way(store: ProjectStore, monkeypatch: pytest.MonkeyPatch) -> None:
    now = [1_000_000_000_000]
    monkeypatch.setattr(module, "_now", lambda: now[0])
    monkeypatch.setattr(module, "_MOST_STUDIES", 3)
    identity = store.create(DOCUMENT, title="Lift").summary.id
    for number in range(1, 6):
        now[0] += 1000
        study = StoredStudy(f"{number}", "b" * 64, 1, b"x" * number)
        store.save(identity, {}, base_version=number, studies=[study])
    assert [each.study for each in store.studies(identity)] == ["5", "4", "3"]
    monkeypatch.setattr(module, "_MOST_STUDY_BYTES", 12)
    now[0] += 1000
    store.save(identity, {}, base_version=6, studies=[StoredStudy("6", "b" * 64, 1, b"x" * 6)])
    assert [each.study for each in store.studies(identity)] == ["6", "5"]
