"""``project``: the projects of a database without the page."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mckibben.cli.app import app
from mckibben.cli.options import AsJson, DataFolder, ProjectsAddress

project = typer.Typer(
    help="Projects that the page saves: list, open, export, import, delete and restore.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.add_typer(project, name="project")

Named = Annotated[
    str, typer.Argument(metavar="PROJECT", help="Its title or id, or the first characters of the id.")
]


@project.command("list")
def list_projects(
    deleted: bool = typer.Option(False, "--deleted", help="Those in the bin instead of the others."),
    as_json: AsJson = False,
    data: DataFolder = None,
    projects: ProjectsAddress = "",
) -> None:
    """All projects, the one changed last first."""
    from mckibben.cli.project import open_store, show_list

    show_list(open_store(data, projects), deleted=deleted, as_json=as_json)


@project.command("show")
def show(
    name: Named,
    version: int | None = typer.Option(None, min=1, help="An earlier version; default: the last."),
    as_json: AsJson = False,
    data: DataFolder = None,
    projects: ProjectsAddress = "",
) -> None:
    """A project: notes, measurements, history; with --json its document."""
    from mckibben.cli.project import open_store, show_project

    show_project(open_store(data, projects), name, version=version, as_json=as_json)


@project.command("export")
def export_project(
    name: Named,
    out: Annotated[Path, typer.Option("--out", "-o", metavar="FILE", help="File to write (.zip).")],
    data: DataFolder = None,
    projects: ProjectsAddress = "",
) -> None:
    """A project as one file, with its history and measurements."""
    from mckibben.cli.project import export_to, open_store

    export_to(open_store(data, projects), name, out)


@project.command("import")
def import_project(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="What 'project export' wrote.")],
    data: DataFolder = None,
    projects: ProjectsAddress = "",
) -> None:
    """A project of another machine as a new one."""
    from mckibben.cli.project import import_from, open_store

    import_from(open_store(data, projects), file, data)


@project.command("delete")
def delete(name: Named, data: DataFolder = None, projects: ProjectsAddress = "") -> None:
    """Put a project into the bin, where it stays until its room is needed."""
    from mckibben.cli.project import delete_project, open_store

    delete_project(open_store(data, projects), name)


@project.command("restore")
def restore(name: Named, data: DataFolder = None, projects: ProjectsAddress = "") -> None:
    """Take a project out of the bin."""
    from mckibben.cli.project import open_store, restore_project

    restore_project(open_store(data, projects), name)
