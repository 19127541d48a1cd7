"""Results as short tables and sentences, for terminals, notebooks and anything else that shows text."""

from mckibben.report.summary.parts import Summary, Table

__all__ = ["Summary", "Table"]
