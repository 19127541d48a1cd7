"""Answers of ``/api/measurements``."""

from __future__ import annotations

from pydantic import Field

from mckibben.documents.strict import Strict
from mckibben.server.schemas.common import ErrorDetail
from mckibben.server.schemas.experiments import ExperimentField


class Channel(Strict):
    """One used column of a measurement."""

    name: str = Field(description="Name of the channel.", examples=["pressure"])
    column: str = Field(description="Header of the file.", examples=["p_bar"])
    unit: str = Field(description="Unit in the file.", examples=["bar"])
    si_unit: str = Field(description="SI unit of minimum, maximum and the columns.", examples=["Pa"])
    minimum: float | None = Field(description="Smallest value, SI.")
    maximum: float | None = Field(description="Largest value, SI.")


class Segmentation(Strict):
    """Division of the rows into sweeps."""

    signal: str = Field(description="The channel that defines the sweeps.", examples=["length"])
    sweeps: int = Field(description="Number of sweeps.")
    cycles: int = Field(description="Number of cycles.")
    held_rows: int = Field(description="Rows in which nothing moves.")
    speeds: list[float | None] = Field(
        description="Mean speed of each level, ascending [SI unit of the signal per s]; empty without time."
    )


class MissingCondition(Strict):
    """A condition that a comparison of this kind needs and the file does not state."""

    key: str = Field(description="Name of the condition.", examples=["load_mass"])
    unit: str = Field(description="Its SI unit.", examples=["kg"])
    why: str = Field(description="What it is needed for.")
    example: str = Field(description="An example value.", examples=["6 kg"])
    alternatives: list[str] = Field(description="Conditions that replace it.", examples=[["load_force"]])


class UnreadColumn(Strict):
    """A column that nothing is read from."""

    column: str = Field(description="Header of the file.", examples=["Traverse [mm]"])
    why: str = Field(description="Why nothing is read from it.", examples=["its name is not known"])


class StatedCondition(Strict):
    """A condition of the test and who says it."""

    key: str = Field(examples=["nominal_length"], description="Name of the condition.")
    value: str | float | None = Field(description="In SI, or a text.")
    origin: str = Field(
        description="file or you; assumed: a unit that was taken as proposed.", examples=["file"]
    )
    where: str = Field(description="Line or cell of the file; empty for the user's own.", examples=["line 4"])


class OpenQuestion(Strict):
    """What the file leaves open."""

    about: str = Field(description="What it is about.", examples=["unit of pressure"])
    text: str = Field(description="The question.")
    option: str = Field(
        description="What answers it, in the words of the command line and of a mapping.",
        examples=['--column "pressure=p [kPa]"'],
    )
    column: str | None = Field(description="The column concerned.", examples=["p"])
    proposed: str | None = Field(description="The likeliest answer.", examples=["kPa"])
    choices: list[str] = Field(description="Possible answers.", examples=[["kPa", "mbar"]])
    stops: bool = Field(description="Without an answer the file is not read.")


class MeasurementAnswer(Strict):
    """A measurement as it was read."""

    id: str = Field(
        description="SHA-256 of the file's content (and of the mapping, if there is one).",
        pattern=r"^[0-9a-f]{64}$",
    )
    name: str = Field(description="Name of the file.")
    kind: str = Field(description="isobaric, isometric, isotonic, diameter, transient or static.")
    kind_detected: bool = Field(description="Detected from the data, not stated in the file.")
    kind_reason: str = Field(description="Why this kind was detected; empty when it was stated.")
    rows: int = Field(description="Number of rows that were read.")
    usable_rows: int = Field(description="Rows with a usable measurement.")
    excluded: dict[str, int] = Field(
        description="Reason why rows are not usable -> number of rows.", examples=[{"slack": 66}]
    )
    skipped: dict[str, int] = Field(description="Reason why rows could not be read -> number of rows.")
    channels: list[Channel] = Field(description="The used columns.")
    ignored: list[str] = Field(description="Columns that are not used.")
    conditions: dict[str, str | float | None] = Field(description="Conditions of the test, SI.")
    missing: list[MissingCondition] = Field(description="Conditions to ask for.")
    groups: int = Field(description="Number of sweeps or cycles of the rows.")
    segments: Segmentation = Field(description="How the rows are divided into sweeps.")
    messages: list[str] = Field(description="Remarks on the file.")
    unread: list[UnreadColumn] = Field(description="All columns that nothing is read from, and why.")
    stated: list[StatedCondition] = Field(description="The conditions with their origin.")
    questions: list[OpenQuestion] = Field(description="What the file leaves open.")


class MeasurementDetail(MeasurementAnswer):
    """A measurement with its data."""

    columns: dict[str, list[float | bool | None]] = Field(
        description="Channel -> values in SI; 'slack' marks rows without pulling force, 'usable' those with "
        "a usable measurement, 'sweep' and 'cycle' number them, 'motion' is -1 shortening, "
        "+1 lengthening, 0 at rest."
    )


class PreviewColumn(Strict):
    """One column of the file, used or not."""

    header: str = Field(description="Header of the file; the key of a mapping.", examples=["p_bar"])
    channel: str | None = Field(description="The guessed or chosen channel; null = not used.")
    unit: str | None = Field(description="The guessed, given or chosen unit; null = not used.")
    unit_given: bool = Field(description="The unit is stated in the header or was chosen, not guessed.")
    absolute: bool | None = Field(description="An absolute pressure; null = not stated, gauge is assumed.")
    minimum: float | None = Field(description="Smallest value of the channel, SI.")
    maximum: float | None = Field(description="Largest value of the channel, SI.")
    why: str | None = Field(description="Why the column cannot be used as its header states.")
    unit_origin: str | None = Field(
        description="Who says the unit: file, you, proposed from the range, or assumed; null = not used."
    )
    unit_where: str | None = Field(
        description="Where the unit stands, apart from the header.", examples=["line 8"]
    )
    sign: int = Field(description="-1: the file counts it the other way.")
    unread: str | None = Field(description="Why nothing is read from the column; null = it is used.")
    place: int | None = Field(description="Its cell in the rows of 'raw', from 0; null = it stands in none.")


class SkippedRows(Strict):
    """Rows of the file that cannot be read, for one reason."""

    reason: str = Field(examples=["not a number"], description="Why they cannot be read.")
    rows: int = Field(description="Number of these rows.")
    first: str = Field(description="Where the first of them is.", examples=["row 7, column 'force_N'"])


class ChannelChoice(Strict):
    """A channel to which a column can be mapped."""

    name: str = Field(examples=["pressure"], description="Name of the channel.")
    si_unit: str = Field(examples=["Pa"], description="Its SI unit.")
    units: list[str] = Field(description="Usual units; others are accepted too.", examples=[["bar", "kPa"]])


class TableOption(Strict):
    """A sheet, group or struct of a file."""

    name: str = Field(examples=["Messung 1"], description="Its name.")
    is_read: bool = Field(description="It is read now, alone or with others of the same columns.")


class RawRow(Strict):
    """A row of a file."""

    row: int = Field(description="Its number in the file, from 1.", examples=[6])
    cells: list[str] = Field(
        description="Its cells as written.", examples=[["Zeit", "Druck", "Weg", "Kraft"]]
    )


class RawTable(Strict):
    """The first rows of a file as they stand in it; where the head is far down, rows between are left out."""

    rows: list[RawRow] = Field(description="The rows, in the order of the file.")
    head: int | None = Field(description="The row of the column names.", examples=[6])
    units: int | None = Field(description="The row of the units, where they stand apart.", examples=[7])
    head_moves: bool = Field(description="'head' of a mapping may name another row.")
    also: list[int] = Field(
        description="Cells, from 0, that hold the same columns again beside the first ones.",
        examples=[[3, 4]],
    )


class PreviewAnswer(Strict):
    """How a file would be read; nothing is stored."""

    name: str = Field(description="Name of the file.")
    format: str = Field(description="csv, json, xlsx, mat, hdf5 or tdms.")
    columns: list[PreviewColumn] = Field(description="All columns of the file, in its order.")
    sample: list[list[str]] = Field(description="The first rows as written in the file, up to 8.")
    rows: int = Field(description="Rows below the header.")
    valid_rows: int = Field(description="Rows that can be read.")
    skipped: list[SkippedRows] = Field(description="Rows that cannot be read, by reason.")
    kind: str | None = Field(description="The kind; null while the file cannot be used.")
    kind_detected: bool = Field(description="Detected from the data, not stated in the file.")
    kind_reason: str = Field(description="Why this kind was detected; empty when it was stated.")
    conditions: dict[str, str | float | None] = Field(
        description="Conditions in the file or in the mapping, SI."
    )
    missing: list[MissingCondition] = Field(description="Conditions to ask for.")
    measurement: MeasurementAnswer | None = Field(
        description="As it would be stored, without the skipped rows; null while the file cannot be used."
    )
    problem: ErrorDetail | None = Field(description="The error with which PUT would refuse the file.")
    only_bad_rows: bool = Field(
        description="The only problem are bad rows: the mapping {'bad_rows': 'skip'} leaves them out."
    )
    messages: list[str] = Field(description="Assumptions made.")
    channel_choices: list[ChannelChoice] = Field(description="Channels to which a column can be mapped.")
    kind_choices: list[str] = Field(description="Kinds that a mapping may state.")
    questions: list[OpenQuestion] = Field(
        description="What the file leaves open; 'problem' refuses it while one of them stops the reading."
    )
    unread: list[UnreadColumn] = Field(description="All columns that nothing is read from, and why.")
    stated: list[StatedCondition] = Field(description="The conditions with their origin.")
    table_choices: list[str] = Field(
        description="Sheets, groups or structs that could be meant; 'sheet' of a mapping picks one."
    )
    tables: list[TableOption] = Field(
        description="All sheets, groups or structs that 'sheet' of a mapping picks; empty where none are."
    )
    raw: RawTable | None = Field(
        description="The first rows as they stand in the file; null where the format has no rows."
    )
    points: dict[str, list[float | None]] = Field(
        description="Channel -> SI values of evenly chosen rows, for a picture, also while questions are open"
    )
    experiment: list[ExperimentField] = Field(
        description="Every field of the experiment that matters for this kind of test; those 'unanswered' "
        "are asked before the first diagnosis."
    )
