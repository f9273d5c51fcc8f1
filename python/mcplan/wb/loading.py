"""Files of plans and of motions, told from each other by what they say that they are."""

from __future__ import annotations

from pathlib import Path

from mcplan._core import Plan, PlanarPlan
from mcplan.errors import InvalidInput
from mcplan.files.archives import read_arrays, read_header
from mcplan.files.plan_files import is_json, read_plan_file
from mcplan.files.whole_body_plans import load_any_plan

from .motion import KIND, Motion


def load_any(path: str | Path) -> Plan | PlanarPlan | Motion:
    """Read a saved plan of either kind, or a motion.

    Raises:
        InvalidPlan: None of them, or its content does not fit together; the message names file, field and rule.
        FileNotFoundError: There is no such file.
    """
    return Motion.load(path) if is_motion(path) else load_any_plan(path)


def is_motion(path: str | Path) -> bool:
    """Whether a file says that it is a motion; what cannot be read is none.

    Raises:
        FileNotFoundError: There is no such file.
    """
    try:
        data = read_plan_file(path)
        return not is_json(data, path) and read_header(read_arrays(data)).get("kind") == KIND
    except InvalidInput:
        return False
