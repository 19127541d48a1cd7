"""Order codes of fluidic muscles: ``DMSP-20-300N-RM-CM``, ``MAS-10-N-100-AA-MCFK``.

They name series, inside diameter [mm], nominal length [mm] with an N before or behind it, and then membrane
and connections, which change nothing of the model.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass

from mckibben.physics.errors import InputError, did_you_mean

_LENGTH = re.compile(r"(?P<behind>\d+)N|N(?P<before>\d+)", re.IGNORECASE)
_ORDERED = {"DMSP": "{preset}-{length}N", "MAS": "{preset}-N-{length}"}
_CONNECTIONS = re.compile(r"M(?P<sides>[OC])F?(?P<limiter>[OK]?)")
_SIDES = {"O": "connections on both sides", "C": "connection on one side, the other is closed"}
_LIMITERS = {"O": "no force limiter", "K": "force limiter, whose lower force limit is not known"}
_ALONE = {
    "AA": "membrane of chloroprene",
    **_LIMITERS,
    **dict.fromkeys(("RM", "AM", "CM"), "connection: it changes nothing of the model"),
    **dict.fromkeys(("ER", "BG"), "accessory: it changes nothing of the model"),
}
_EXAMPLE = "e.g. DMSP-20-300N-RM-CM or MAS-10-N-100-AA-MCFK"


@dataclass(frozen=True, slots=True)
class OrderCode:
    """What an order code says.

    Attributes:
        preset: id of the preset of its series and diameter.
        length: nominal length [m].
        further: codes of membrane and connections, as they stand there.
    """

    preset: str
    length: float
    further: tuple[str, ...]

    @property
    def meanings(self) -> tuple[str, ...]:
        """What each of ``further`` says, by the type code of the maker's manual."""
        return tuple(_meaning(part) or "" for part in self.further)


def order_code(text: str, known: Collection[str]) -> OrderCode | None:
    """The parts of an order code; None for a text that does not begin like one of these muscles.

    Args:
        text: the code.
        known: ids of muscle presets, "DMSP-20".

    Raises:
        InputError: a part is not understood; names it. Field "code.2": its place between the hyphens.
    """
    series, *parts = text.strip().split("-")
    ids = {preset.upper(): preset for preset in known}
    if len(parts) < 2 or not any(preset.startswith(f"{series.upper()}-") for preset in ids):
        return None
    preset = ids.get(f"{series}-{parts[0]}".upper())
    if preset is None:
        made = [each.partition("-")[2] for each in ids if each.startswith(f"{series.upper()}-")]
        sizes = ", ".join(sorted((size for size in made if size.isdigit()), key=int))
        raise InputError(
            f"'{parts[0]}' in the order code {text} is no inside diameter of the {series.upper()} series",
            field="code.1",
            hint=did_you_mean(f"{series}-{parts[0]}", known) or f"{sizes} mm",
        )
    rest, place = parts[1:], 2
    if rest[0].upper() == "N" and len(rest) > 1:  # MAS-10-N-100
        place = 3
        rest = [f"N{rest[1]}", *rest[2:]]
    found = _LENGTH.fullmatch(rest[0])
    length = int(found["behind"] or found["before"]) if found else 0
    if not length:
        raise InputError(
            f"'{rest[0]}' in the order code {text} is no nominal length in mm",
            field=f"code.{place}",
            hint=f"300N; {_EXAMPLE}",
        )
    for number, part in enumerate(rest[1:], place + 1):
        if _meaning(part.upper()) is None:
            raise InputError(
                f"'{part}' in the order code {text} is not understood",
                field=f"code.{number}",
                hint=f"{', '.join(_ALONE)}, and MC and MO with FK, K or O behind them; leave out any other",
            )
    return OrderCode(preset, length * 1e-3, tuple(part.upper() for part in rest[1:]))


def _meaning(part: str) -> str | None:
    """What a part behind the length says, None for an unknown one."""
    if part in _ALONE:
        return _ALONE[part]
    found = _CONNECTIONS.fullmatch(part)
    if found is None:
        return None
    return "; ".join(filter(None, [_SIDES[found["sides"]], _LIMITERS.get(found["limiter"])]))


def begin_of_order_code(*, preset: str, length: float) -> str | None:
    """What an order of this muscle begins with, "DMSP-20-300N"; membrane and connections follow.

    Args:
        preset: id of the preset.
        length: nominal length [m], rounded to whole millimetres.

    Returns:
        None for a preset that is not of a series with known order codes.
    """
    series, _, size = preset.partition("-")
    if series not in _ORDERED or not size.isdigit():
        return None
    return _ORDERED[series].format(preset=preset, length=round(length * 1e3))
