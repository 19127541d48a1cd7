"""How the files of laboratories are read: python tests/benchmarks/formats.py [--own]

Each file of the corpus beside this checkout (its index says what is in it) is read right, asked about
rightly, refused with a reason, read in part, read silently wrong, or crashes. ``--own`` scores ten files of
other habits that were written before the reader.
"""

from __future__ import annotations

import json
import re
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import STROKES, Measurement
from mckibben.measurement.reading import preview, read_measurement
from mckibben.physics.errors import InputError
from tests.measurement.reading.sealed_files import WRITERS, LabFile, differs

CORPUS = Path(__file__).parents[3] / "shared" / "data" / "lab-formats"
CLASSES = ("right", "asked", "refused", "part", "wrong", "crashed")
SAME = 1e-6  # of the largest value
EXTRAS = ("temperature", "velocity", "diameter", "command")  # columns of files that an index need not list
AS_PRINTED = "absolute pressures as printed"  # of an entry whose index does not subtract the air from them
_KEYS = {
    "rest_length": "nominal_length", "load_mass": "load_mass", "supply_pressure": "supply_pressure",
    "muscle": "muscle",
}  # fmt: skip


class Score(NamedTuple):
    """How a file is read: one of `CLASSES`, and why."""

    file: str
    verdict: str
    why: str


class Reading(NamedTuple):
    """A file read: the measurement or the refusal, and all that is asked or refused, as one text."""

    measurement: Measurement | None
    refusal: str
    asked: str


def read(data: bytes, name: str) -> Reading:
    """Read a file as the program does, without any option."""
    asked = []
    try:
        found = preview(data, name)
        asked = [f"{question.about}: {question.text} {question.option}" for question in found.questions]
    except InputError as error:
        asked = [error.message]
    try:
        return Reading(read_measurement(data, name), "", "\n".join(asked))
    except InputError as error:
        return Reading(None, error.message, "\n".join([*asked, error.message, str(error.hint)]))


def score(entry: Mapping[str, Any], data: bytes) -> Score:
    """How a file of the corpus is read."""
    name = Path(entry["file"]).name
    try:
        reading = read(data, name)
    except Exception as error:
        return Score(name, "crashed", repr(error))
    unasked = [
        item["about"] for item in entry["ask"] if not all(re.search(w, reading.asked) for w in item["words"])
    ]
    if reading.measurement is None:
        verdict = "asked" if entry["ask"] and not unasked else "refused"
        return Score(name, verdict, reading.refusal)
    wrong, missing = _examined(entry, reading.measurement)
    wrong += [f"guessed, not asked: {about}" for about in unasked]
    if wrong:
        return Score(name, "wrong", "; ".join(wrong))
    if missing:
        return Score(name, "part", "; ".join(missing))
    return Score(name, "asked" if entry["ask"] else "right", "")


def _examined(entry: Mapping[str, Any], read: Measurement) -> tuple[list[str], list[str]]:
    """(what is wrong, what is missing)."""
    wrong, missing = [], []
    if read.kind not in entry["kind"]:
        wrong.append(f"kind {read.kind}")
    if read.rows != entry["rows"]:
        (wrong if read.rows > entry["rows"] else missing).append(f"{read.rows} rows of {entry['rows']}")
    truths = {c: (t["si"], t.get("tolerance")) for c, t in entry["channels"].items() if t["required"]}
    forms = {c: (si, None) for c, si in entry["same_as_stroke"].items()}
    # Of a table of results without runs the index gives the order of the sheet, which need not be that of the
    # test: its rows have to be there, each with all of its values.
    ordered = read.kind != "static" and entry["groups"] is not None
    near: list[NDArray[np.bool_]] = []  # of each channel: rows read that are the first rows of the index
    for channel, (si, tolerance) in (truths | forms).items():
        if channel not in read.columns:
            replaced = channel in STROKES and any(form in read.columns for form in forms)
            if channel in truths and not replaced:
                missing.append(f"{channel} not read")
            continue
        values = np.asarray(read.columns[channel], float)
        si = _gauge(si, entry) if channel == "pressure" else si
        offset = values.min() - si["minimum"] if channel == "time" else 0.0
        allowed = tolerance or SAME * max(abs(si["minimum"]), abs(si["maximum"]))
        found = {"minimum": values.min(), "maximum": values.max(), "mean": values.mean()}
        wrong += [
            f"{channel}: {what} {value:.7g}, not {si[what]:.7g}"
            for what, value in found.items()
            if abs(value - offset - si[what]) > allowed
        ]
        near.append(np.abs(values[:, None] - offset - np.asarray(si["first"])) <= allowed)
        for place, wanted in enumerate(si["first"] if ordered else ()):
            if not near[-1][place, place]:
                wrong.append(f"{channel}: row {place + 1} is {values[place]:.7g}, not {wanted:.7g}")
    if near and not ordered and not wrong:
        lost = np.flatnonzero(~np.all(near, axis=0).any(axis=0))
        wrong += [f"row {place + 1} of the index is not read" for place in lost]
    for channel in set(read.columns) - set(truths) - set(forms) - {"group", "direction"}:
        if channel not in entry["channels"] and not _is_extra(channel, entry, read):
            wrong.append(f"a {channel} that is not there")
    for item in entry["states"]:
        key = _KEYS.get(item["what"])
        value = read.conditions.get(key) if key else None
        as_printed = isinstance(value, str) and value in item["as"]
        if key and (value is None or not (as_printed or _same(value, item["value"]))):
            missing.append(f"{item['what']} ({item['where']}): {value!r}")
    return wrong, missing


def _gauge(si: Mapping[str, Any], entry: Mapping[str, Any]) -> Mapping[str, Any]:
    """A truth of pressure less the surrounding air, where the index gives it absolute as it is printed."""
    if entry["channels"]["pressure"].get("reference") != "absolute" or not entry.get(AS_PRINTED):
        return si
    air = next((i["value"] for i in entry["states"] if i["what"] == "ambient_pressure"), 101_325.0)
    return {k: [v - air for v in x] if isinstance(x, list) else x - air for k, x in si.items()}


def _is_extra(channel: str, entry: Mapping[str, Any], read: Measurement) -> bool:
    """Whether a channel that the index does not list stands in a column that it does not forbid."""
    columns = [c.column for c in read.channels if c.name == channel]
    return channel in EXTRAS and not set(columns) & set(entry.get("not_to_be_used", ()))


def _same(value: float | str, wanted: float | str) -> bool:
    if isinstance(value, float) and isinstance(wanted, (int, float)):
        return abs(value - wanted) <= SAME * abs(wanted)
    return value == wanted


def score_own(file: LabFile) -> Score:
    """How one of our own files is read."""
    try:
        reading = read(file.data, file.name)
    except Exception as error:
        return Score(file.name, "crashed", repr(error))
    if reading.measurement is None:
        return Score(file.name, "refused", reading.refusal)
    result = reading.measurement
    found = differs(file, result.columns)
    missing = [text for text in found if "missing" in text]
    wrong = [text for text in found if "missing" not in text]
    if result.kind not in file.kind:
        wrong.append(f"kind {result.kind}")
    wanted = set(file.channels) | {"group", "direction"}
    wrong += [f"a {channel} that is not there" for channel in set(result.columns) - wanted]
    for key, value in file.conditions.items():
        if not _same(result.conditions.get(key, ""), value):
            missing.append(f"{key}: {result.conditions.get(key)!r}")
    verdict = "wrong" if wrong else "part" if missing else "right"
    return Score(file.name, verdict, "; ".join(wrong + missing))


def corpus_scores() -> list[Score]:
    """The scores of the corpus."""
    entries = json.loads((CORPUS / "index.json").read_text(encoding="utf-8"))["files"]
    return [score(entry, (CORPUS / entry["file"]).read_bytes()) for entry in entries]


def report(scores: Sequence[Score]) -> str:
    """The scores, and how many of each class."""
    lines = [f"{found.verdict:8} {found.file:28} {found.why[:200]}" for found in scores]
    counts = Counter(found.verdict for found in scores)
    return "\n".join([*lines, "", *(f"{name:8} {counts[name]:3}" for name in CLASSES)])


if __name__ == "__main__":
    scores = [score_own(write()) for write in WRITERS] if "--own" in sys.argv else corpus_scores()
    sys.stdout.write(report(scores) + "\n")
