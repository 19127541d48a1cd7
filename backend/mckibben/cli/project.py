"""``mckibben project``: lists, moves and brings back what the page has saved."""

from __future__ import annotations

from dataclasses import asdict
from datetime import UTC, datetime
from pathlib import Path

from mckibben.application.project.projects import found_project, packed, unpacked
from mckibben.cli.options import folders
from mckibben.cli.output import check_written, remark, write_json, write_summary
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError
from mckibben.projects.database import Database
from mckibben.projects.store import ProjectStore
from mckibben.report.summary import Table


def open_store(data: Path | None, address: str) -> ProjectStore:
    """The projects of the options."""
    return ProjectStore(Database(address or folders(None, None, data).data))


def show_list(store: ProjectStore, *, deleted: bool, as_json: bool) -> None:
    """The projects as a table or as JSON."""
    found = store.list(deleted=deleted)
    if as_json:
        write_json({"projects": [asdict(each) for each in found], "place": store.place})
        return
    if not found:
        remark(f"no projects in {store.place}")
        return
    rows = tuple(
        (each.title, each.id[:8], _when(each.changed), f"{each.version}", f"{each.files}", _size(each.size))
        for each in found
    )
    head = ("project", "id", "changed", "version", "files", "size")
    write_summary([Table("Deleted projects" if deleted else "Projects", head, rows)])


def show_project(store: ProjectStore, name: str, *, version: int | None, as_json: bool) -> None:
    """A project in words, or its document as JSON."""
    summary = found_project(store, name)
    project = store.open(summary.id, version)
    if as_json:
        write_json(
            {
                "project": asdict(project.summary),
                "revision": asdict(project.revision),
                "document": project.document,
                "measurements": list(project.measurements),
                "studies": len(project.studies),
            }
        )
        return
    tables = len(project.studies)
    also = f", {tables} study table{'' if tables == 1 else 's'}" if tables else ""
    remark(f"{summary.title}: {summary.files} measurement{'' if summary.files == 1 else 's'}{also}")
    if summary.notes:
        remark(summary.notes)
    rows = tuple(
        (f"{each.version}", _when(each.saved), each.label, "automatic" if each.automatic else "")
        for each in store.history(summary.id)
    )
    write_summary([Table("History", ("version", "saved", "what", ""), rows)])


def export_to(store: ProjectStore, name: str, out: Path) -> None:
    """Write a packed project.

    Raises:
        InputError: the file cannot be written.
    """
    check_written(out, "--out", (".zip",))
    identity = found_project(store, name).id
    try:
        with out.open("wb") as into:
            packed(store, identity, into)
    except OSError as error:
        raise InputError(f"--out {out}: {error.strerror or error}", hint="name another file") from error
    remark(f"project: {out}")


def import_from(store: ProjectStore, file: Path, data: Path | None) -> None:
    """Unpack a project.

    Raises:
        InputError: it is not a packed project, or cannot be read.
    """
    measurements = MeasurementStore(folders(None, None, data).data)
    try:
        source = file.open("rb")
    except OSError as error:
        raise InputError(f"{file}: {error.strerror or error}", hint="name a file that can be read") from error
    with source:
        project = unpacked(source, store, measurements)
    remark(f"{project.summary.title}: project {project.summary.id[:8]}")


def delete_project(store: ProjectStore, name: str) -> None:
    """Put a project into the bin."""
    summary = store.delete(found_project(store, name).id)
    remark(f"{summary.title} is in the bin; mckibben project restore {summary.id[:8]} brings it back")


def restore_project(store: ProjectStore, name: str) -> None:
    """Take a project out of the bin."""
    remark(f"{store.restore(found_project(store, name, deleted=True).id).title} is back")


def _when(instant: float) -> str:
    return datetime.fromtimestamp(instant, UTC).astimezone().strftime("%Y-%m-%d %H:%M")


def _size(count: int) -> str:
    return f"{count / 1e6:.1f} MB" if count >= 1e6 else f"{count / 1e3:.1f} kB"
