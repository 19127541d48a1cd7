"""What a server writes to the terminal: a level, a line for each request if asked for, never a flood.

The token of a link is not written.
"""

from __future__ import annotations

import copy
import logging
import re
import time
from typing import Any

from uvicorn.config import LOGGING_CONFIG

LEVELS = ("critical", "error", "warning", "info", "debug")
_MOST_ALIKE = 5  # lines of one message in a while
_WHILE = 10.0  # s
_TOKEN = re.compile(r"(?<=[?&]token=)[^&\s]*")


class Seldom(logging.Filter):
    """Lets a message through a few times in a while, and says how many were left out.

    Args:
        most: lines of one message in a while.
        seconds: how long a while is [s].
    """

    def __init__(self, most: int = _MOST_ALIKE, seconds: float = _WHILE) -> None:
        super().__init__()
        self._most, self._seconds = most, seconds
        self._seen: dict[str, tuple[float, int]] = {}

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether it is written."""
        # What asyncio says of a socket differs in its number alone.
        key = f"{record.name} {record.levelno} {re.sub(r'[0-9]+', '#', str(record.msg))[:200]}"
        now = time.monotonic()
        since, count = self._seen.get(key, (now, 0))
        if now - since > self._seconds:
            if count > self._most:
                record.msg = f"{record.getMessage()} (and {count - self._most} more like it before)"
                record.args = ()
            since, count = now, 0
        self._seen[key] = since, count + 1
        return count < self._most


class WithoutToken(logging.Filter):
    """Takes the token out of the lines of requests."""

    def filter(self, record: logging.LogRecord) -> bool:
        """Always written."""
        if isinstance(record.args, tuple):
            record.args = tuple(
                _TOKEN.sub("...", item) if isinstance(item, str) else item for item in record.args
            )
        return True


def log_config(level: str) -> dict[str, Any]:
    """Configuration of the loggers of the server, for `logging.config.dictConfig`.

    Args:
        level: of `LEVELS`.
    """
    config: dict[str, Any] = copy.deepcopy(LOGGING_CONFIG)
    config["filters"] = {"seldom": {"()": Seldom}, "without_token": {"()": WithoutToken}}
    config["handlers"]["default"]["filters"] = ["seldom"]
    config["handlers"]["access"]["filters"] = ["without_token"]
    own = {"handlers": ["default"], "level": level.upper(), "propagate": False}
    # What others warn of is a matter of theirs.
    others = {**own, "level": "ERROR" if level in ("critical", "error", "warning") else level.upper()}
    config["loggers"] |= {"mckibben": own, "asyncio": others, "pebble": others}
    return config
