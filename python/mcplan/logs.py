"""What planners say as they work, given to the standard library's ``logging``, to the logger "mcplan".

    logging.basicConfig(level=logging.INFO)  # iteration tables, why a replan was refused, ...

A callback (the option ``logger``) is called all the same.
"""

from __future__ import annotations

import logging
from typing import Any

from mcplan._core import LogLevel

LOGGER = logging.getLogger("mcplan")
_LEVELS = {LogLevel.debug: logging.DEBUG, LogLevel.info: logging.INFO, LogLevel.warning: logging.WARNING}


def listen(options: Any) -> None:
    """Let "mcplan" have what a planner says, where it asks for it: planners say nothing above INFO but warnings.

    Args:
        options: Of a planner, a copy of the caller's; those without a ``logger`` are left alone.
    """
    if not hasattr(options, "logger") or not LOGGER.isEnabledFor(logging.INFO):
        return
    callback = options.logger

    def told(level: LogLevel, line: str) -> None:
        LOGGER.log(_LEVELS.get(level, logging.INFO), "%s", line)
        if callback is not None:
            callback(level, line)

    options.logger = told
