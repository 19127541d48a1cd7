"""Options that say how a measurement file is to be read."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from mckibben.measurement.read import Correction

Sheet = Annotated[
    str | None, typer.Option("--sheet", metavar="NAME", help="Sheet, group or struct with the measurement.")
]
Head = Annotated[
    int | None, typer.Option("--head", metavar="ROW", help="Row of the column names, counted from 1.")
]
Columns = Annotated[
    list[str] | None,
    typer.Option(
        "--column",
        metavar="C=NAME",
        help='What a column is, e.g. "force=-Kraft [kN]": sign and unit; repeatable.',
    ),
]
Ignored = Annotated[
    list[str] | None,
    typer.Option("--ignore", metavar="NAME", help="A column that is not wanted; repeatable."),
]
RestLength = Annotated[
    str | None,
    typer.Option("--rest-length", help='Length of the muscle without air and load, e.g. "300 mm".'),
]
Load = Annotated[str | None, typer.Option("--load", help='Mass or force on the muscle, e.g. "6 kg".')]
Supply = Annotated[str | None, typer.Option("--supply", help='Supply pressure, gauge, e.g. "6 bar".')]
Strict = Annotated[
    bool, typer.Option("--strict", help="Refuse a file instead of assuming what it does not say.")
]


def correction_of(
    *,
    sheet: str | None,
    head: int | None,
    columns: Sequence[str] | None,
    ignored: Sequence[str] | None,
    rest_length: str | None,
    load: str | None,
    supply: str | None,
    strict: bool,
) -> Correction:
    """What these options say about the files.

    Raises:
        InputError: names the option, what is wrong and what would be right.
    """
    from mckibben.measurement.read import spoken_correction

    return spoken_correction(
        sheet=sheet,
        head=head,
        columns=columns or (),
        ignore=ignored or (),
        rest_length=rest_length,
        load=load,
        supply=supply,
        strict=strict,
    )
