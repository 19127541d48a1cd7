"""A claim of an effect that does not hold."""

from __future__ import annotations


class BrokenClaim(AssertionError):  # noqa: N818 - what it is
    """What an effect file says of itself is not so; the message says where and by how much."""


def claim(holds: object, message: str = "") -> None:
    """Go on where a claim holds.

    Raises:
        BrokenClaim: it does not.
    """
    if not holds:
        raise BrokenClaim(message)
