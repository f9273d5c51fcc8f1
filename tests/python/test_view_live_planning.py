"""The live view of a search: what a browser would get is what the search has, and at the end the plan."""

from __future__ import annotations

import signal

import numpy as np
import pytest

pytest.importorskip("meshcat")

import mcplan as mp  # noqa: E402
from mcplan.cli import main  # noqa: E402
from mcplan.view.live import PlanningView  # noqa: E402
from mcplan.view.live import server as server_module  # noqa: E402
from mcplan.view.live.server import LiveServer  # noqa: E402


class Sent:
    """Stands for the server: what a browser would have now, node by node, and all that was ever sent."""

    url = "http://127.0.0.1:7000/static/"

    def __init__(self) -> None:
        self.nodes: dict[str, dict] = {}
        self.commands: list[dict] = []
        self.opened = self.closed = 0

    def show(self, stage) -> None:
        import umsgpack

        for _, path, packed in stage.taken():
            command = umsgpack.unpackb(packed)
            self.commands.append(command)
            if command["type"] == "delete":
                below = path.decode()
                self.nodes = {
                    at: node for at, node in self.nodes.items() if at != below and not at.startswith(below + "/")
                }
            elif command["type"] == "set_object":
                self.nodes[path.decode()] = command

    def wait(self) -> None:
        self.opened += 1

    def close(self) -> None:
        self.closed += 1

    def under(self, path: str) -> set[str]:
        return {at.removeprefix(path) for at in self.nodes if at.startswith(path)}


@pytest.fixture
def sent(monkeypatch) -> Sent:
    found = Sent()
    monkeypatch.setattr("mcplan.view.live.planning.LiveServer", lambda: found)
    return found


def footprints(plan: mp.Plan, end: str) -> int:
    """Contacts of an end-effector: it is counted anew whenever it comes to a surface."""
    names = [e.name for e in plan.robot.end_effectors]
    rows = [row[names.index(end)] for row in plan.contact_sequence()]
    return sum(now >= 0 and (k == 0 or rows[k - 1] != now) for k, now in enumerate(rows))


def test_iterates_are_drawn_as_they_are_and_the_plan_replaces_them(sent):
    scene, robot = mp.load_scene("stairs"), mp.load_robot("humanoid44")
    with PlanningView(scene, robot, hold_s=0.0) as view:
        assert sent.under("/meshcat/stances/") and sent.under("/meshcat/scene/")
        last = []

        def watch(plan: mp.Plan) -> None:
            last[:] = [plan]
            view(plan)

        result = mp.plan(scene, robot, watch=watch, max_iterations=60)
        assert view.iterates == view.pictures >= 60
        drawn = sent.under("/meshcat/iterate/")
        assert {"com", "right_foot", "left_foot"} <= drawn
        for foot in ("right_foot", "left_foot"):
            assert sum(at.startswith(f"{foot}/") for at in drawn) == footprints(last[0], foot) > 1
        view.show(result.plan)
    assert not sent.under("/meshcat/iterate") and not sent.under("/meshcat/stances")
    assert sent.under("/meshcat/robot/") and sent.commands[-1]["type"] == "set_animation"
    assert sent.closed == 1


def test_a_picture_stays_and_every_new_contact_sequence_is_shown(sent, monkeypatch):
    """By a clock of the test's own, in which an iterate takes a hundredth of what a picture stays."""
    now = [0.0]
    monkeypatch.setattr("mcplan.view.live.planning.time.perf_counter", lambda: now[0])
    monkeypatch.setattr("mcplan.view.live.planning.time.sleep", lambda s: now.__setitem__(0, now[0] + s))
    scene, robot = mp.load_scene("flat"), mp.load_robot("humanoid44")
    with PlanningView(scene, robot, hold_s=1.0) as view:
        sequences, changes = [], 0

        def watch(plan: mp.Plan) -> None:
            nonlocal changes
            now[0] += 0.01
            changes += not sequences or plan.contact_sequence() != sequences[-1]
            sequences.append(plan.contact_sequence())
            view(plan)

        mp.plan(scene, robot, watch=watch)
    assert view.iterates == len(sequences)
    assert changes <= view.pictures <= changes + len(sequences) // 100 + 1 < len(sequences)


def test_watching_changes_no_plan():
    """Nor do threads, whose iterates are told in order."""
    alone = mp.plan("stairs").plan
    for threads in (1, 3):
        seen: list[mp.Plan] = []
        watched = mp.plan("stairs", watch=seen.append, threads=threads)
        np.testing.assert_array_equal([k.com_W for k in watched.plan.knots], [k.com_W for k in alone.knots])
        assert len(seen) >= watched.report.iterations > 100
        for plan in seen[:: len(seen) // 20]:
            plan.validate()
            assert plan.scene == alone.scene and plan.robot == alone.robot


def test_iterates_of_a_part_of_the_scene_have_the_scenes_surfaces():
    """The search looks at what is near its way alone; who watches need not know."""
    scene = mp.load_scene("flat")
    floor = scene.surfaces[0]
    away = [np.array([100.0 + n, 50.0, 0.0]) for n in range(300)]
    far = [mp.model.Surface(name=f"far {n}", vertices_W=floor.vertices_W + by) for n, by in enumerate(away)]
    scene.surfaces = [*far, *scene.surfaces]
    seen: list[mp.Plan] = []
    mp.plan(scene, watch=seen.append, max_iterations=20, restarts=0)
    for plan in seen:
        assert len(plan.scene.surfaces) == len(scene.surfaces)
        used = {surface for row in plan.contact_sequence() for surface in row if surface >= 0}
        assert {plan.scene.surfaces[i].name for i in used} == {mp.load_scene("flat").surfaces[0].name}


@pytest.mark.usefixtures("ctrl_c")
def test_what_a_watcher_raises_comes_out_and_an_interrupt_has_the_best_plan():
    def fail(plan: mp.Plan) -> None:
        raise LookupError("no browser")

    with pytest.raises(LookupError, match="no browser"):
        mp.plan("flat", watch=fail)
    calls = []

    def interrupt(plan: mp.Plan) -> None:
        calls.append(plan)
        if len(calls) == 40:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(mp.Interrupted) as stop:
        mp.plan("flat", watch=interrupt)
    assert stop.value.result.plan.phases and len(calls) < 60
    with pytest.raises(mp.InvalidInput, match="watch: must be a function or None, got 3"):
        mp.plan("flat", watch=3)


def test_the_command_waits_for_the_browser_and_shows_the_plan(sent, capsys):
    assert main(["plan", "flat", "--live"]) == 0
    told = capsys.readouterr()
    assert sent.url in told.err and "the search begins then" in told.err and "solved" in told.out
    assert sent.opened == sent.closed == 1 and sent.commands[-1]["type"] == "set_animation"


def test_scenes_in_which_nobody_can_stand_are_refused_before_a_server_begins(monkeypatch):
    monkeypatch.setattr(server_module.LiveServer, "__init__", lambda self: pytest.fail("a server was begun"))
    scene = mp.load_scene("flat")
    scene.goal.contacts = {"right_foot": "nowhere"}
    with pytest.raises(mp.errors.InvalidScene):
        PlanningView(scene, mp.load_robot("humanoid44"))


def test_a_server_that_has_been_ended_is_no_error():
    view = PlanningView(mp.load_scene("flat"), mp.load_robot("humanoid44"))
    assert isinstance(view._server, LiveServer) and view.url.startswith("http://")
    view.show(mp.plan("flat", watch=view).plan)
    view.close()
    view._server._server.wait()
    view(mp.plan("flat").plan)
