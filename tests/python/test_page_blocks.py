"""The Python of the pages runs, from top to bottom of each; their TOML is loaded by the tests of its kind of file."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

pytest.importorskip("mcplan.tracking.options")
from pages.page import Page, all_pages  # noqa: E402

#: What a page takes for granted: files that its shell made.
STAIRS = 'mp.plan("stairs_broad", "talos", sole_inside=1.0).plan.save("stairs.npz")'
BEFORE = {
    "README.md": STAIRS,
    "docs/feasibility.md": 'mp.plan("stairs", "talos", joint_limits=False).plan.save("s.npz")',
    "docs/motion.md": 'mp.plan("stairs_broad", "talos").plan.save("stairs.npz")',
    "docs/planar_tasks.md": 'mp.files.planar_tasks.save_planar_task(mp.load_planar_task("walking"), "my_task.toml")',
    "docs/theory/sip_certificate.md": 'plan = mp.whole_body("cartwheel", minimise="none").plan',
    "docs/tracking.md": STAIRS,
}
WITH_PYTHON = [page.name for page in all_pages() if any(page.blocks("python"))]


@pytest.mark.slow
@pytest.mark.parametrize("name", WITH_PYTHON)
def test_the_python_of_a_page_runs(name, tmp_path):
    for package in ("mujoco", "pinocchio", "proxsuite", "meshcat", "scipy", "example_robot_data"):
        if importlib.util.find_spec(package) is None:
            pytest.skip(f"needs {package}")
    blocks = [text for _, text in Page.read(ROOT / name).blocks("python")]
    text = "\n".join(
        ["import mcplan", "import mcplan as mp", "import mcplan.files.planar_tasks", BEFORE.get(name, ""), *blocks]
    )
    env = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
    done = subprocess.run([sys.executable, "-c", text], cwd=tmp_path, env=env, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
