"""Saves one project again and again and says so after each save, until it is killed."""

from __future__ import annotations

import sys
from pathlib import Path

from mckibben.projects.database import Database
from mckibben.projects.store import ProjectStore


def main(address: str) -> None:
    store = ProjectStore(Database(address if "://" in address else Path(address)))
    version = 1
    made = store.create({"version": 1, "filling": "x" * 20_000}, title="Lift")
    while True:
        print(made.summary.id, version, flush=True)  # noqa: T201
        document = {"version": version + 1, "filling": "x" * 20_000}
        store.save(made.summary.id, document, base_version=version)
        version += 1


if __name__ == "__main__":
    main(sys.argv[1])
