"""mp.export: a plan, a motion or a run, the name of a format, a path."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mcplan._core import Plan, PlanarPlan, Robot
from mcplan.arguments import require_number, require_or_path
from mcplan.errors import InvalidArgument, InvalidInput, shown
from mcplan.files.export_formats import format_of
from mcplan.files.outputs import require_named, require_target

if TYPE_CHECKING:
    from mcplan.tracking import Recording, TrackingResult
    from mcplan.wb import Motion

#: Legal samples per second: at 1 kHz a minute of motion is as much as the writers are meant for.
RATES_HZ = (1.0, 1000.0)


def export(
    what: Plan | Motion | Recording | TrackingResult | str | Path,
    to: str,
    path: str | Path,
    robot: Robot | str | Path | None = None,
    rate_hz: float | None = None,
) -> Path:
    """Write a plan, a motion or a run in the format of another tool.

        mp.export("run.npz", "mjlab", "motion.npz")
        mp.export(result.plan, "centroidal", "plan.csv", rate_hz=200)

    Of a run the recorded joints are written, of a motion its own. A plan has none: where a format needs them, inverse
    kinematics along the plan gives them, with the end-effectors in contact exactly where the plan has them.

    Args:
        what: A plan of ddp or rhp, a motion along one, a run, or the path of one of them.
        to: Name of the format; ``mcplan export --list`` prints them.
        path: The file, which is complete or not there at all.
        robot: Robot with a URDF and the plan's end-effectors by name; None: the plan's own. Runs and motions have
            their own, and formats without joints take none.
        rate_hz: Samples per second; None: what is usual for the format.

    Returns:
        The path.

    Raises:
        InvalidArgument: There is no such format, or an argument is of another type; the message names legal values.
        InvalidInput: The file is no plan or run, or the path is that file; a value is out of range; the robot cannot take
            up the plan's postures.
        InvalidPlan: The plan is malformed.
        InvalidRobot: The format needs joints, and the robot has no URDF.
        MissingExtra: The format needs Pinocchio: ``pip install 'mcplan[view]'``.
        OSError: The file cannot be written.
    """
    entry = format_of(to)
    if rate_hz is not None:
        rate_hz = require_number("rate_hz", rate_hz)
        if not RATES_HZ[0] <= rate_hz <= RATES_HZ[1]:
            raise InvalidInput("rate_hz", f"must lie in {RATES_HZ[0]:g} to {RATES_HZ[1]:g} [1/s]", shown(rate_hz))
    require_or_path("path", path)
    require_named(path)
    require_target("path", Path(path), entry.suffix, what)
    from .source import Source

    source = Source.of(_loaded(what), robot, entry, rate_hz)
    importlib.import_module(f"mcplan.export.{entry.module}").write(source, Path(path))
    return Path(path)


def _loaded(what: Any) -> Plan | Motion | Recording:
    """The plan, the motion, or the recording of the run."""
    from mcplan.tracking.recording import Recording, recording_from
    from mcplan.tracking.result import TrackingResult

    if isinstance(what, TrackingResult):
        return what.recording
    from mcplan.wb import Motion

    if isinstance(what, (Plan, Motion, Recording)):
        return what
    if isinstance(what, PlanarPlan):
        raise _planar(what.task.name)
    if hasattr(what, "plan") and isinstance(what.plan, Plan):
        raise InvalidArgument(
            "what", "must be a Plan, a Motion, a run or a path", f"a {type(what).__name__}; give its plan or motion"
        )
    require_or_path("what", what, "a Plan", "a Motion", "a run")
    from mcplan.tracking.run_files import PLANAR_RUN, RUN, load_run
    from mcplan.wb.loading import load_any

    def refused(*_: Any) -> Any:
        raise _planar(str(what))

    found: Any = load_run(what, {RUN: recording_from, PLANAR_RUN: refused}, load_any)
    return _loaded(found)


def _planar(name: str) -> InvalidInput:
    rule = "must be a plan of ddp or rhp, or a run of one: planar robots live in a plane, which no format here knows"
    return InvalidInput("what", rule, shown(name))
