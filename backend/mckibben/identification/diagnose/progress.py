"""How far a diagnosis is, for whoever watches it."""

from __future__ import annotations

from mckibben.identification.fit.fitter import CancelledError
from mckibben.simulation.outcome import Watch


class Progress:
    """Reports the progress of a diagnosis to a watch."""

    def __init__(self, watch: Watch) -> None:
        self._watch = watch
        self.share, self.end = 0.0, 0.45

    def count_fit(self) -> None:
        """Count one more fitted model; end when the watch asks for it.

        Raises:
            CancelledError: the watch ended the diagnosis.
        """
        self.share += 0.02 * (self.end - self.share)
        outcome = self._watch.ended(self.share)
        if outcome is not None:
            raise CancelledError(outcome)
