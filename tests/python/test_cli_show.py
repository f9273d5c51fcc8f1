"""mcplan show: pages, pictures, plots and videos of saved plans and runs of both kinds; one-line errors."""

from __future__ import annotations

import pytest

import mcplan as mp
import planar_recordings
import plans_by_hand
import recordings
import tracked_cartwheel
from command_line import one_line_error
from mcplan.cli import main
from mcplan.planar.tracking import PlanarResult
from mcplan.planar.tracking.measures import measure
from mcplan.tracking import Options, TrackingResult
from reference_solutions import reference_plan

pytest.importorskip("meshcat")
pytest.importorskip("matplotlib")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A plan and a run of each kind, saved."""
    at = tmp_path_factory.mktemp("show")
    plans_by_hand.walk(plans_by_hand.flat(), plans_by_hand.humanoid()).save(at / "plan.npz")
    reference_plan("walking", "optimised_uniform").save(at / "whole_body.npz")
    TrackingResult(recordings.walking(), recordings.measures(), Options()).save(at / "run.npz")
    recording = planar_recordings.walking()
    PlanarResult(recording, measure(recording, 0, 1.0), tracked_cartwheel.tracked().options).save(at / "planar_run.npz")
    return at


def run(capsys, *words) -> tuple[int, str, str]:
    code = main(["show", *(str(word) for word in words)])
    out, err = capsys.readouterr()
    return code, out, err


@pytest.mark.parametrize("name", ["plan", "whole_body", "run", "planar_run"])
def test_a_page_and_plots_of_whatever_was_saved(name, folder, tmp_path, capsys):
    if name == "run":
        pytest.importorskip("pinocchio")
        pytest.importorskip("example_robot_data")
    page, plots = tmp_path / "page.html", tmp_path / "plots"
    code, out, err = run(capsys, folder / f"{name}.npz", "-o", page, "--plots", plots, "-q")
    assert (code, out, err) == (0, f"Saved {page}, {plots}\n", "")
    assert "</html>" in page.read_text(encoding="utf-8")
    assert ("simulated" in page.read_text(encoding="utf-8")) == ("run" in name)
    assert len(list(plots.glob("*.png"))) >= 4


@pytest.mark.parametrize("name", ["plan", "whole_body"])
def test_the_page_of_a_plan_is_the_one_of_show_and_pictures_may_be_drawn_in_vectors(name, folder, tmp_path, capsys):
    page, picture = tmp_path / "page.html", tmp_path / "picture.svg"
    assert run(capsys, folder / f"{name}.npz", "-o", page, "-o", picture, "-q")[0] == 0
    plan = mp.Plan.load(folder / "plan.npz") if name == "plan" else mp.PlanarPlan.load(folder / "whole_body.npz")
    assert page.read_text(encoding="utf-8") == mp.show(plan).html()
    assert "<svg" in picture.read_text(encoding="utf-8")


def test_a_run_is_rendered(folder, tmp_path, capsys):
    for module in ("mujoco", "pinocchio", "example_robot_data"):
        pytest.importorskip(module)
    from PIL import Image

    picture = tmp_path / "run.png"
    assert run(capsys, folder / "planar_run.npz", "-o", picture, "-q")[0] == 0
    with Image.open(picture) as image:
        assert image.size[0] == 1920


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["plan.npz"], "--output or --plots: must say what to draw"),
        (
            ["plan.npz", "-o", "plan.jpg"],
            "--output: must end in .html, .htm, .png, .pdf, .svg, .mp4, .webp or .gif, got",
        ),
        (["plan.npz", "-o", "no/plan.html"], "--output: must lie in a folder that exists, got"),
        (["plan.npz", "--plots", "plan.npz"], "--plots: must be a folder, or a name for a new one, got"),
        (["plan.npz", "-o", "plan.gif"], "--output: must be a page or a picture: a plan is filmed once mcplan track"),
        (["run.npz", "-o", "run.svg"], "--output: must end in .png: a run is rendered, got"),
        (["absent.npz", "-o", "plan.html"], "absent.npz: No such file or directory"),
        (["other.npz", "-o", "plan.html"], "other.npz: must be an .npz or .json file written by mcplan"),
    ],
)
def test_what_cannot_be_drawn_is_one_line(words, message, folder, capsys, monkeypatch):
    monkeypatch.chdir(folder)
    (folder / "other.npz").write_bytes(b"nothing of ours")
    there = set(folder.iterdir())
    assert one_line_error(run(capsys, *words)).startswith(message)
    assert set(folder.iterdir()) == there


def test_missing_packages_are_one_line(folder, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    message = one_line_error(run(capsys, folder / "plan.npz", "-o", tmp_path / "plan.html"))
    assert message.endswith("plan.html needs meshcat: pip install 'mcplan[view]'")
