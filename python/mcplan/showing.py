"""For those who only look: plans and runs of both kinds, of robots in space and planar ones, in pages, pictures, plots, videos.

Both kinds of plan answer to ``duration()``, ``at(t)`` and ``save(path)``, and mcplan.check, mcplan.show and mcplan.track take
either.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from mcplan._core import Plan, PlanarPlan, Report, Robot, Scene
from mcplan.arguments import require, require_or_path
from mcplan.errors import InvalidInput, shown

if TYPE_CHECKING:
    from typing_extensions import TypeIs

    from mcplan.planar.tracking import PlanarRecording, PlanarResult
    from mcplan.tracking import Recording, TrackingResult
    from mcplan.view.pages.page import Page
    from mcplan.wb import Motion


class AnyPlan(Protocol):
    """What both kinds of plan answer."""

    def duration(self) -> float:
        """[s]"""
        ...

    def at(self, t: float) -> Any:
        """The state at a time [s] in 0 to duration()."""
        ...

    def save(self, path: str) -> None:
        """Write an .npz file."""
        ...


Run: TypeAlias = "Recording | TrackingResult | PlanarRecording | PlanarResult"
Shown: TypeAlias = "Plan | PlanarPlan | Motion | Run"


def load(path: str | Path) -> Plan | PlanarPlan | Motion | TrackingResult | PlanarResult:
    """Read a saved plan or run of either kind, or a motion.

    Raises:
        InvalidInput: Neither, or its content does not fit together; the message names file, field and rule.
        FileNotFoundError: There is no such file.
    """
    from mcplan.online.result import result_from
    from mcplan.planar.tracking.result import result_from as planar_result_from
    from mcplan.tracking.run_files import PLANAR_RUN, RUN, load_run
    from mcplan.wb.loading import load_any

    makers: dict[str, Callable[..., Any]] = {RUN: result_from, PLANAR_RUN: planar_result_from}
    saved: Plan | PlanarPlan | Motion | TrackingResult | PlanarResult = load_run(path, makers, load_any)
    return saved


def show(
    plan: Shown | str | Path,
    scene: Scene | str | Path | None = None,
    robot: Robot | str | Path | None = None,
    report: Report | None = None,
) -> Page:
    """Draw a plan, a motion or a run in the browser; the result has ``save_html(path)``.

    Args:
        plan: The plan, a motion, what track() found of a plan, or the path of any of them. A whole-body plan is drawn with
            its own task, a motion and a run with their own plan; they take no scene and no robot.
        scene: Drawn around it, or what load_scene takes; None: the plan's own.
        robot: Drawn along it, or what load_robot takes; None: the plan's own. With a URDF its meshes are drawn, else a
            stick robot.
        report: How the plan was found, for the caption.

    Raises:
        InvalidArgument: An argument is of another type, such as the result that has the plan.
        InvalidInput: A scene or a robot for a whole-body plan, a motion or a run; or the file is none of them.
        UnknownName: No such scene or robot, and no such file.
        FileNotFoundError: There is no such plan.
        MissingExtra: The packages of ``pip install 'mcplan[view]'`` are not installed.
    """
    from mcplan.extras import require as require_extra

    require_extra("mcplan.show", "view", "meshcat")
    plan, scene, robot = _with_files_read(plan, scene, robot)
    if is_motion(plan):
        _require_own("a motion is drawn with its own plan", scene=scene, robot=robot)
        from mcplan.view.pages.show_motion import show_motion

        return show_motion(plan)
    require("report", report, Report, optional=True)
    if isinstance(plan, PlanarPlan):
        _require_own("a whole-body plan is drawn with its own task", scene=scene, robot=robot)
        from mcplan.planar.view.pages import show_whole_body

        return show_whole_body(plan, report)
    if is_run(plan):
        _require_own("a run is drawn with its own plan", scene=scene, robot=robot)
        if _is_planar_run(plan):
            from mcplan.planar.view.run_pages import show_planar_run

            return show_planar_run(plan)
        from mcplan.view.pages.show_run import show_run

        return show_run(plan)
    from mcplan.files.meeting import warn_of_names
    from mcplan.view.pages.show import show as show_plan

    if scene is not None or robot is not None:
        warn_of_names(scene or plan.scene, robot or plan.robot)
    return show_plan(plan, scene, robot, report)


def _with_files_read(
    plan: Shown | str | Path, scene: Scene | str | Path | None, robot: Robot | str | Path | None
) -> tuple[Shown, Scene | None, Robot | None]:
    """What is to be shown, read where it is given by names or paths.

    Raises:
        InvalidArgument: One of them is of another type.
    """
    from mcplan.files.robots import load_robot
    from mcplan.files.scenes import load_scene

    if not isinstance(plan, Plan | PlanarPlan) and not is_motion(plan) and not is_run(plan):
        require_or_path("plan", plan, "a Plan", "a PlanarPlan", "a Motion", "a run")
        plan = load(plan)
    if not isinstance(scene, Scene):
        require_or_path("scene", scene, "a Scene", "a name", optional=True)
        scene = None if scene is None else load_scene(scene)
    if not isinstance(robot, Robot):
        require_or_path("robot", robot, "a Robot", "a name", optional=True)
        robot = None if robot is None else load_robot(robot)
    return plan, scene, robot


def save_plots(what: Shown, report: Report | None, folder: str | Path) -> list[Path]:
    """Write all plots of a plan, motion or run into a folder, which is made if it does not exist.

    Args:
        what: The plan, the motion or the run.
        report: How a plan was found, for the plots of the search; None: without them.
        folder: Where to.

    Returns:
        The files written.

    Raises:
        MissingExtra: matplotlib is not installed.
        InvalidPlan: The plan's arrays do not fit together.
        OSError: The folder cannot be written to.
    """
    if is_motion(what):
        from mcplan.view.plots.motion import save_motion_plots

        return save_motion_plots(what, folder)
    if isinstance(what, PlanarPlan):
        from mcplan.planar.view.save_plots import save_whole_body_plots

        return save_whole_body_plots(what, folder)
    if _is_planar_run(what):
        from mcplan.planar.view.plots_run import save_planar_run_plots

        return save_planar_run_plots(what, folder)
    if is_run(what):
        from mcplan.view.plots.run import save_run_plots

        return save_run_plots(what, folder)
    from mcplan.view.plots.save import save_plots as save_plan_plots

    return save_plan_plots(what, report, folder)


def save_picture(what: Shown, path: str | Path) -> Path:
    """Write one picture: postures of a plan or a motion in its scene, the film strip of a whole-body plan, snapshots of a run.

    Args:
        what: The plan, the motion or the run.
        path: .png, or of a plan or a motion .pdf or .svg.

    Raises:
        InvalidInput: Another ending.
        MissingExtra: What draws is not installed: matplotlib, and for runs MuJoCo, Pinocchio and Pillow.
        OSError: The file cannot be written.
    """
    if isinstance(what, PlanarPlan):
        from mcplan.planar.view.film_strip import film_strip
        from mcplan.view.sheets import save_figure

        return save_figure(film_strip(what), path)
    if is_motion(what):
        from mcplan.view.pictures.motion_picture import motion_picture

        return motion_picture(what, path=path)
    if is_run(what):
        return save_strip(what, path)
    from mcplan.view.pictures.picture import picture

    return picture(what, path=path)


def save_strip(run: Run, path: str | Path, **options: Any) -> Path:
    """Write snapshots of a run side by side; see mcplan.view.save_run_strip."""
    from mcplan.view.pictures.run_strip import save_run_strip

    return save_run_strip(run, path, **_laid_out(run), **options)


def save_video(run: Run, path: str | Path, **options: Any) -> Path:
    """Film a run; see mcplan.view.save_video."""
    from mcplan.view.video.film import save_video as film

    return film(run, path, **_laid_out(run), **options)


def is_motion(what: object) -> TypeIs[Motion]:
    """Whether it is a motion."""
    return not isinstance(what, Plan | PlanarPlan) and isinstance(what, _motion_kind())


def _motion_kind() -> type[Motion]:
    from mcplan.wb import Motion

    return Motion


def is_run(what: object) -> TypeIs[Run]:
    """Whether it is a recording or the result that carries one, not a plan."""
    from mcplan.tracking import Recording, TrackingResult

    return isinstance(what, (Recording, TrackingResult)) or _is_planar_run(what)


def _is_planar_run(what: object) -> TypeIs[PlanarRecording | PlanarResult]:
    from mcplan.planar.tracking import PlanarRecording, PlanarResult

    return isinstance(what, (PlanarRecording, PlanarResult))


def _laid_out(run: Run) -> dict[str, Any]:
    if not _is_planar_run(run):
        return {}
    from mcplan.planar.view.run_scene import planar_scene_of

    return {"lay_out": planar_scene_of}


def _require_own(rule: str, **given: Scene | Robot | None) -> None:
    for name, value in given.items():
        if value is not None:
            raise InvalidInput(name, rule, shown(value.name))
