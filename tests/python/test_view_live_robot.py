"""The live view: what a browser would get is the robot as it is, by Pinocchio's own kinematics."""

from __future__ import annotations

import numpy as np
import pytest

for package in ("meshcat", "pinocchio", "example_robot_data", "mujoco", "proxsuite"):
    pytest.importorskip(package)

import mcplan as mp  # noqa: E402
from mcplan.kinematics.urdf_model import load_model  # noqa: E402
from mcplan.view.live import LiveView, robot  # noqa: E402


@pytest.fixture(scope="module")
def plan() -> mp.Plan:
    scene = mp.load_scene("flat")
    scene.goal.position_W = [0.2, 0.0, 0.0]
    return mp.plan(scene, "talos", phases=8).plan


class Sent:
    """Stands for the socket to the server: keeps what is sent, last of each node."""

    def __init__(self) -> None:
        self.transforms: dict[str, np.ndarray] = {}
        self.objects: list[str] = []
        self.properties: dict[str, dict[str, object]] = {}
        self.pictures = 0

    def send_multipart(self, parts: list[bytes]) -> None:
        import umsgpack

        command = umsgpack.unpackb(parts[2])
        if command["type"] == "set_transform":
            self.transforms[command["path"]] = np.array(command["matrix"]).reshape(4, 4).T
            self.pictures += command["path"].endswith("/root_joint")
        elif command["type"] == "set_property":
            self.properties.setdefault(command["path"], {})[command["property"]] = command["value"]
        else:
            self.objects.append(command["path"])

    def poll(self, _: int) -> bool:
        return True

    def recv(self) -> bytes:
        return b"ok"

    def close(self, linger: int) -> None:
        self.closed = True


@pytest.fixture
def sent(monkeypatch) -> Sent:
    found = Sent()
    original = LiveView._show

    def show(self: LiveView, configuration: np.ndarray) -> None:
        self._server._socket = found
        original(self, configuration)

    monkeypatch.setattr(LiveView, "_show", show)
    return found


def test_joints_are_where_kinematics_puts_them(plan, sent):
    import pinocchio as pin

    urdf_model = load_model(plan.robot)
    q = pin.integrate(urdf_model.model, urdf_model.neutral, np.full(urdf_model.model.nv, 0.05))
    with LiveView(plan, real_time=False) as view:
        assert view.url.startswith("http://")
        view(0.0, q, plan)
    data = urdf_model.model.createData()
    pin.forwardKinematics(urdf_model.model, data, q)
    placed = sent.transforms["/meshcat/robot/arm_left_4_joint"]
    np.testing.assert_allclose(placed, data.oMi[urdf_model.model.getJointId("arm_left_4_joint")].homogeneous)
    assert any(path.startswith("/meshcat/scene/") for path in sent.objects)
    assert "/meshcat/plan/com" in sent.objects
    camera = np.array(sent.properties["/Cameras/default/rotated/<object>"]["position"])
    assert camera[1] > 0.0 and 1.0 < np.linalg.norm(camera) < 5.0


def test_a_simulation_is_shown_at_its_rate_and_new_plans_are_drawn(plan, sent):
    with LiveView(plan, real_time=False) as view:
        result = mp.run(plan, duration=0.5, latency=0.02, watch=view)
    assert sent.objects.count("/meshcat/plan/com") == len(result.plans)
    assert sent.pictures == pytest.approx(1 + 0.5 * robot.RATE_HZ, abs=2)


def test_what_is_watched_is_what_is_recorded(plan):
    seen = []
    result = mp.track(plan, hold_s=0.0, watch=lambda now, q, of: seen.append((now, q.copy())))
    np.testing.assert_array_equal([now for now, _ in seen], result.recording.times_s)
    np.testing.assert_array_equal([q for _, q in seen], result.recording.configurations)


def test_planar_robots_have_no_live_view():
    with pytest.raises(mp.InvalidInput, match="watch: must not be given with a whole-body plan"):
        mp.track(mp.whole_body("cartwheel", minimise="none").plan, watch=print)
