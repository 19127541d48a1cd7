"""Which of the user's own files are not used: where each is wrong, why, and what would be right."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

from mckibben.documents.studio import Studio

_SHOWN = 3  # problems of one preset file


def unused_files(studio: Studio, user_presets: Path | None) -> Iterator[str]:
    """Which files of effects and presets are not used, where and why, what would be right; one line each.

    Args:
        studio: what was loaded.
        user_presets: the user's folder of presets.
    """
    for problem in studio.catalogue.problems:
        yield f"effect file {problem.file} is not used: {problem.message}"
    for file, problems in groupby(studio.library.problems(), key=lambda problem: problem.file):
        name = file.removeprefix("user/")
        path = file if name == file or user_presets is None else user_presets / name
        listed = list(problems)
        for problem in listed[:_SHOWN]:
            known = not problem.field or problem.field in problem.message.replace("'", "")
            said = problem.message if known else f"{problem.field}: {problem.message}"
            hint = f" ({problem.hint.rstrip('.')})" if problem.hint else ""
            yield " ".join(f"preset file {path} is not used: {said}{hint}".split())
        if more := len(listed[_SHOWN:]):
            yield f"preset file {path}: and {more} more"
