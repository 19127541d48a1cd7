"""The files of one test are read together: notes without readings count for all of them, and what one file
says of a sensor counts for the others with the same columns that do not say it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from mckibben.measurement.measurement import Measurement, RigText
from mckibben.measurement.reading import Correction, Note
from mckibben.physics.errors import InputError


@dataclass(frozen=True)
class TestFile:
    """A file of a test and the ways to look at it.

    Attributes:
        name: without its folder, for messages.
        correction: what the user says about it.
        read: the measurement in it, with a correction.
        notes: its texts, where it holds no readings.
        heads: the names of its columns, also where it cannot be read yet.
    """

    __test__ = False

    name: str
    correction: Correction
    read: Callable[[Correction], Measurement]
    notes: Callable[[], tuple[Note, ...]]
    heads: Callable[[], tuple[str, ...]]


def read_together(files: Mapping[int, TestFile]) -> dict[int, Measurement]:
    """Place of a file -> its measurement; files of notes have none.

    Raises:
        InputError: what is wrong with the first file that cannot be read with all that the others say.
    """
    read: dict[int, Measurement] = {}
    refused: dict[int, InputError] = {}
    for place, file in files.items():
        try:
            read[place] = file.read(file.correction)
        except InputError as error:
            if len(files) == 1:
                raise
            refused[place] = error
    notes = {place: texts for place in refused if (texts := _notes(files[place]))}
    if refused and len(notes) == len(files):
        raise next(iter(refused.values()))
    shared = tuple(note for texts in notes.values() for note in texts)
    for place, file in files.items():
        if place in notes:
            continue
        more = (*shared, *_of_others(place, file, read))
        if more:
            whole = file.read(replace(file.correction, notes=(*file.correction.notes, *more)))
            read[place] = replace(whole, messages=(*_said_of(files, notes), *whole.messages))
        elif place in refused:
            raise refused[place]
    return {place: read[place] for place in sorted(read)}


def _said_of(files: Mapping[int, TestFile], notes: Mapping[int, object]) -> list[str]:
    return [
        f"{files[place].name} holds no readings: its texts count for the files beside it" for place in notes
    ]


def _notes(file: TestFile) -> tuple[Note, ...]:
    try:
        return file.notes()
    except InputError:
        return ()


def _of_others(place: int, file: TestFile, read: Mapping[int, Measurement]) -> tuple[Note, ...]:
    """What files with the same columns say of a sensor, and this one does not."""
    others = [one for other, one in read.items() if other != place and one.rig]
    if not others:
        return ()
    heads = read[place].heads if place in read else file.heads()
    own = {_of_sensor(text) for text in read[place].rig} if place in read else set()
    found = {
        text: Note(f"{one.name}, {text.where}", text.text)
        for one in others
        if one.heads == heads
        for text in one.rig
        if _of_sensor(text) not in own
    }
    return tuple(dict.fromkeys(found.values()))


def _of_sensor(text: RigText) -> tuple[str, str]:
    return text.facet, text.column
