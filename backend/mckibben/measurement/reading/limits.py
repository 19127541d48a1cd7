"""How much of a file is read at most, whatever it says of itself."""

from __future__ import annotations

MAX_BYTES = 200_000_000
MAX_ROWS = 6_000_000
MAX_COLUMNS = 1000
MAX_CELLS = 24_000_000
MAX_TEXT = 1000  # characters of a remark
MAX_TEXTS = 2000  # remarks that are searched
MAX_DEPTH = 8  # of names within names
MAX_NODES = 100_000  # of a tree
MAX_SHEETS = 300
SPLIT = "split the file, or keep every second row"
