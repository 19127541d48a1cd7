"""A limit of time that counts work: it is over after a number of looks at it, on any machine."""

from __future__ import annotations

from mckibben.simulation.outcome import Outcome, Watch


class Looks(Watch):
    """A watch whose time is over after some looks: of a diagnosis before each fit, of a search at each part.

    Args:
        most: looks after which the time is over.
    """

    def __init__(self, most: int) -> None:
        super().__init__(time_limit=7.0)
        self.left = most

    def ended(self, share: float) -> Outcome | None:
        """Count one more look."""
        self.left -= 1
        return Outcome.TIMED_OUT if self.left < 0 else super().ended(share)
