"""mcplan.export.unitree: rows as mjlab's and BeyondMimic's csv_to_npz read them."""

from __future__ import annotations

import numpy as np

import mcplan as mp
from exports import G1_JOINTS, run, simulation


def test_rows_are_root_quaternion_xyzw_and_joints_in_unitrees_order(tmp_path):
    rows = np.loadtxt(mp.export(run(), "unitree", tmp_path / "walk.csv", rate_hz=50), delimiter=",")
    recording = run()
    assert rows.shape == (len(recording.times_s[::2]), 7 + 29)
    np.testing.assert_array_equal(rows[:, :3], recording.configurations[::2, :3])
    quats = recording.configurations[::2, 3:7]
    np.testing.assert_allclose(rows[:, 3:7], quats * np.sign((rows[:, 3:7] * quats).sum(axis=1))[:, None], atol=1e-15)
    for column, name in enumerate(G1_JOINTS):
        expected = recording.configurations[::2, 7 + recording.joints.index(name)]
        np.testing.assert_array_equal(rows[:, 7 + column], expected)


def test_a_row_in_mujoco_puts_the_feet_where_they_were(tmp_path):
    """What the consumers do with a row: quaternion to wxyz, joints by the names of their list."""
    import mujoco

    rows = np.loadtxt(mp.export(run(), "unitree", tmp_path / "walk.csv"), delimiter=",")
    model, recording = simulation(), run()
    data = mujoco.MjData(model)
    for n in range(0, len(rows), 10):
        data.qpos[:3], data.qpos[3:7] = rows[n, :3], rows[n, [6, 3, 4, 5]]
        for name, angle in zip(G1_JOINTS, rows[n, 7:], strict=True):
            data.qpos[model.joint(name).qposadr[0]] = angle
        mujoco.mj_forward(model, data)
        k = min(n / 30 * 100, len(recording.times_s) - 1.0)
        low, high = recording.end_effectors_W[int(k)], recording.end_effectors_W[int(np.ceil(k))]
        for end in (0, 1):
            geom = model.geom(f"end/{recording.plan.robot.end_effectors[end].name}").id
            sole = data.geom_xpos[geom] - 0.01 * data.geom_xmat[geom].reshape(3, 3)[:, 2]
            np.testing.assert_allclose(sole, low[end] + (k % 1.0) * (high[end] - low[end]), atol=1e-4)
