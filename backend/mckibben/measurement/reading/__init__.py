"""Reading measurement files by evidence: bytes -> cells -> tables -> evidence -> decision -> words.

What a laboratory's habits mean stands in `rules.toml` and `words.toml`; the modules only apply them.
"""

from __future__ import annotations

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading.answers import refusal
from mckibben.measurement.reading.assemble import measurement_of, reading_of
from mckibben.measurement.reading.correction import Correction, Note, read_correction, spoken_correction
from mckibben.measurement.reading.preview import Preview, preview_here
from mckibben.measurement.reading.process import bounded
from mckibben.measurement.reading.questions import questions_of
from mckibben.measurement.reading.rig import heads_in, notes_in

__all__ = [
    "Correction", "Note", "Preview", "column_names", "load_readers", "notes_of", "preview", "preview_here",
    "read_correction", "read_here", "read_measurement", "spoken_correction",
]  # fmt: skip

_ANY_FILE = b"# kind: static\npressure_bar;length_mm;force_N\n1;300;10\n1;290;5\n1;280;1\n"


def read_measurement(data: bytes, name: str, correction: Correction | None = None) -> Measurement:
    """The measurement in a file, told apart by the content.

    Args:
        data: the file's bytes.
        name: file name, for messages.
        correction: what the user says beyond the file.

    Raises:
        InputError: whatever is wrong with the file, naming row, column or key, and the remedy; also that it
            takes too much time or memory.
    """
    return bounded(
        lambda: read_here(data, name, correction or Correction()), name, load_readers, size=len(data)
    )


def preview(data: bytes, name: str, correction: Correction | None = None) -> Preview:
    """What a file would be read as; bad rows are counted, not refused.

    Raises:
        InputError: no table can be found in the file at all, the correction names what is not there, or the
            file takes too much time or memory.
    """
    return bounded(lambda: preview_here(data, name, correction), name, load_readers, size=len(data))


def notes_of(data: bytes, name: str) -> tuple[Note, ...]:
    """The texts of a file without readings, which say something of the files beside it; () = it is none.

    Raises:
        InputError: the file cannot be taken apart, or takes too much time or memory.
    """
    return bounded(lambda: notes_in(data, name), name, load_readers, size=len(data))


def column_names(data: bytes, name: str, correction: Correction) -> tuple[str, ...]:
    """The names of the columns of a file; () = it holds no table.

    Raises:
        InputError: the file takes too much time or memory.
    """
    return bounded(lambda: heads_in(data, name, correction), name, load_readers, size=len(data))


def load_readers() -> None:
    """Import what every measurement file needs."""
    read_here(_ANY_FILE, "any.csv", Correction())


def read_here(data: bytes, name: str, correction: Correction) -> Measurement:
    """The measurement in a file, read in this process.

    Raises:
        InputError: it cannot be read, or leaves something open.
    """
    reading = reading_of(data, name, correction)
    questions = questions_of(reading)
    if (open_questions := refusal(name, questions, strict=correction.strict)) is not None:
        raise open_questions
    return measurement_of(reading, questions, correction.identity(data))
