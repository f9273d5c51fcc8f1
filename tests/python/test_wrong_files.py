"""Files of the wrong kind, where the command and the library read one: the message says what it is and what is read there."""

from __future__ import annotations

import gzip
from pathlib import Path

import numpy as np
import pytest

import mcplan as mp
from command_line import one_line_error
from mcplan.cli import main
from mcplan.errors import InvalidPlan
from mcplan.files.scenes import scene_to_dict
from mcplan.files.toml import toml_text
from standing import standing_plan

PNG = b"\x89PNG\r\n\x1a\n" + bytes(range(256))
KINDS = {
    "an .npz archive": None,
    "a PNG picture": PNG,
    "a gzip archive": gzip.compress(b"a = 1"),
    "a PDF document": b"%PDF-1.4\n%\xe2\xe3",
    "binary data": bytes(range(256)),
    "XML": b'<?xml version="1.0"?>\n<robot name="r"/>\n',
}
#: Whose words stand before the file, what they read, and the ending that makes it so.
READERS = {
    "scenes": ("TOML", ".toml"),
    "plan": ("TOML", ".toml"),
    "robots": ("TOML", ".toml"),
    "tasks": ("TOML", ".toml"),
    "rhp": ("TOML", ".toml"),
    "sip": ("TOML", ".toml"),
    "check": ("JSON", ".json"),
    "show": ("an .npz or .json file written by mcplan", ".npz"),
    "track": ("an .npz or .json file written by mcplan", ".npz"),
}


def wrong_file(kind: str, path: Path) -> Path:
    content = KINDS[kind]
    if content is None:
        with path.open("wb") as file:
            np.savez(file, a=np.ones(3))
    else:
        path.write_bytes(content)
    return path


@pytest.mark.parametrize("verb", READERS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_file_of_another_kind_is_called_what_it_is(verb, kind, tmp_path, capsys):
    expected, suffix = READERS[verb]
    path = wrong_file(kind, tmp_path / f"file{suffix}")
    words = [verb, str(path), *(["-o", str(tmp_path / "page.html")] if verb == "show" else [])]
    message = one_line_error((main(words), *capsys.readouterr()))
    if kind == "an .npz archive" and suffix != ".toml":  # which is read, and is of somebody else
        expected, kind = "an .npz or .json file written by mcplan", "an archive without `header`"
    assert message == f"{path}: must be {expected}, got {kind}"


@pytest.mark.parametrize(("content", "kind"), [('{"a": 1}', "JSON"), ("[robot]\na = 1\n", "TOML")])
def test_text_of_another_kind_is_known_too(content, kind, tmp_path):
    other = tmp_path / ("file.toml" if kind == "JSON" else "file.json")
    other.write_text(content)
    if kind == "JSON":
        with pytest.raises(mp.errors.InvalidScene, match=r"file.toml: must be TOML, got JSON$"):
            mp.load_scene(other)
        return
    with pytest.raises(InvalidPlan, match=r"file.json: must be JSON, got TOML$"):
        mp.Plan.load(str(other))
    with pytest.raises(InvalidPlan, match=r"file.toml: must be an .npz or .json file written by mcplan, got TOML$"):
        mp.Plan.load(str(other.rename(tmp_path / "file.toml")))


def test_a_plan_of_the_other_kind_is_named_with_the_option(tmp_path, capsys):
    for name, message in (
        (
            "plan.npz",
            'header.kind: must be "whole_body": a plan of a planar robot, got none, as plans of contacts and CoM',
        ),
        ("plan.json", 'kind: must be "planar_plan": a plan of a planar robot, got "plan"'),
    ):
        path = tmp_path / name
        standing_plan().save(str(path))
        text = one_line_error((main(["sip", "walking", "--warm-start", str(path)]), *capsys.readouterr()))
        assert text.startswith(f"--warm-start {path}: {message}")
        with pytest.raises(InvalidPlan) as found:
            mp.whole_body("walking", warm_start=path)
        assert str(found.value).startswith(f"{path}: {message}")
    path = wrong_file("a PNG picture", tmp_path / "walk.npz")
    text = one_line_error((main(["rhp", "flat", "--sequence", str(path)]), *capsys.readouterr()))
    assert text.startswith(f"--sequence {path}: must be an .npz or .json file written by mcplan, got a PNG picture")


def test_a_warm_start_that_does_not_fit_names_its_file(tmp_path, capsys):
    path = tmp_path / "chimney.npz"
    mp.whole_body("chimney", forces="uniform", minimise="none", max_iterations=1).plan.save(str(path))
    text = one_line_error((main(["sip", "walking", "--warm-start", str(path)]), *capsys.readouterr()))
    assert text.startswith(f"--warm-start {path}: ")


@pytest.mark.parametrize(("field", "right"), [("end_effector", "left_foot"), ("surface", "left_4")])
def test_a_misspelt_name_in_a_walk_is_named_with_its_file_and_what_is_meant(field, right, tmp_path, capsys):
    path = tmp_path / "mine.toml"
    scene = mp.load_scene("rubbles")
    text = toml_text(scene_to_dict(scene))
    index = next(i for i, step in enumerate(scene.steps) if getattr(step, field) == right)
    start = text.index(
        f'{field} = "{right}"', text.index("[[steps]]") if "[[steps]]" in text else text.index("steps = ")
    )
    path.write_text(text[:start] + f'{field} = "{right}x"' + text[start + len(f'{field} = "{right}"') :])
    with pytest.raises(mp.errors.InvalidScene) as found:
        mp.walk(path, cycles=1)
    said = str(found.value)
    assert said.startswith(f"{path}: steps[{index}].{field}: must name a ")
    assert f"Did you mean '{right}'? There are: " in said and said.endswith(f'got "{right}x"')
    assert one_line_error((main(["rhp", str(path)]), *capsys.readouterr())) == said


def test_empty_paths_and_names_are_said_to_be_empty(tmp_path):
    for load, error, message in (
        (mp.load_scene, mp.errors.UnknownScene, "a scene must have a name or a path that is not empty. Built-in: "),
        (mp.load_robot, mp.errors.UnknownRobot, "a robot must have a name or a path that is not empty. Built-in: "),
        (
            mp.load_planar_task,
            mp.errors.UnknownPlanarTask,
            "a planar task must have a name or a path that is not empty. ",
        ),
        (mp.Plan.load, InvalidPlan, "path: must not be empty"),
        (mp.PlanarPlan.load, InvalidPlan, "path: must not be empty"),
        (standing_plan().save, mp.InvalidInput, "path: must not be empty"),
    ):
        with pytest.raises(error) as found:
            load("")
        assert str(found.value).startswith(message)
