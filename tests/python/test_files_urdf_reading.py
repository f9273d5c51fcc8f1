"""mcplan.files.urdf_reading: what Pinocchio gets is a tree of few links with finite numbers and meshes of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import mcplan as mp
from mcplan.cli import main
from mcplan.files.urdf_reading import MAX_CHAIN, MAX_LINKS, read_urdf
from test_cli import LEG
from two_link_arm import arm_robot

INERTIA = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
LIMIT = '<limit lower="-1" upper="1" effort="10" velocity="1"/>'


def link(name: str, inside: str = INERTIA) -> str:
    return f'<link name="{name}">{inside}</link>'


def joint(name: str, parent: str, child: str, kind: str = "revolute", inside: str = LIMIT) -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/><origin xyz="0 0 -0.01"/><axis xyz="0 1 0"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{inside}</joint>'


def chain(links: int, kind: str = "fixed") -> str:
    joints = [joint(f"j{i}", f"l{i - 1}", f"l{i}", kind) for i in range(1, links)]
    return robot(*(link(f"l{i}") for i in range(links)), *joints)


def robot(*parts: str) -> str:
    return f'<robot name="r">{"".join(parts)}</robot>'


PAIR = [link("a"), link("b")]
BAD = {
    "many links": (robot(*(link(f"l{i}") for i in range(MAX_LINKS + 1))), "link: may be 1000 at most, got 1001"),
    "a deep chain": (chain(MAX_CHAIN + 1), "link l200: may be at most the link number 200 of its chain, got 201"),
    "one name twice": (robot(link("a"), link("a")), "link a: must have a name of its own"),
    "no name": (robot("<link/>"), "link: must have a name of its own"),
    "two roots": (robot(*PAIR), r'link: must be one without a joint above it, the root, got 2: \["a", "b"\]'),
    "none": (robot(), "link: must be one without a joint above it"),
    "a loop": (robot(*PAIR, joint("j", "a", "b"), joint("k", "b", "a")), 'joint k: may not close a loop, got "a"'),
    "itself": (robot(link("a"), joint("j", "a", "a")), "joint j: may not close a loop"),
    "two parents": (
        robot(*PAIR, joint("j", "a", "b"), joint("k", "a", "b")),
        "joint k: must be the only joint that carries",
    ),
    "no such link": (robot(*PAIR, joint("j", "a", "c")), 'joint j.child: must name a link, got "c"'),
    "nan": (
        robot(link("a", INERTIA.replace('value="1"', 'value="nan"'))),
        "link a: mass.value: must be a finite number",
    ),
    "huge": (
        robot(link("a", INERTIA.replace('ixx="1"', 'ixx="1e300"'))),
        "link a: inertia.ixx: must be a finite number",
    ),
    "words": (
        robot(*PAIR, joint("j", "a", "b").replace("0 0 -0.01", "0 0")),
        "joint j: origin.xyz: must be 3 finite numbers",
    ),
    "negative": (
        robot(link("a", INERTIA.replace('value="1"', 'value="-1"'))),
        "link a: mass.value: must not be negative",
    ),
    "no mass": (
        robot(link("a", INERTIA.replace('<mass value="1"/>', ""))),
        "link a: inertial.mass: is required",
    ),
    "a mass without a value": (
        robot(link("a", INERTIA.replace('<mass value="1"/>', "<mass/>"))),
        "link a: inertial.mass.value: is required",
    ),
    "no inertia": (robot(link("a", '<inertial><mass value="1"/></inertial>')), "link a: inertial.inertia: is required"),
    "half an inertia": (
        robot(link("a", INERTIA.replace('izz="1" ', ""))),
        "link a: inertial.inertia.izz: is required",
    ),
    "limits": (
        robot(*PAIR, joint("j", "a", "b").replace('"-1"', '"2"')),
        "joint j: limit.lower: must not be above upper",
    ),
    "entities": (
        "<!DOCTYPE r [<!ENTITY a 'b'>]>" + robot(link("a")),
        "is not XML of ours: may not declare a document type",
    ),
    "nested": ("<robot>" + "<a>" * 10_000, "is not XML of ours: may be nested 32 deep at most"),
    "an encoding": ("<?xml version='1.0' encoding='none-such'?>" + robot(link("a")), "is not XML"),
    "nothing": ("", "is not XML"),
}


@pytest.mark.parametrize("name", BAD)
def test_what_is_no_robot_is_refused_before_pinocchio_sees_it(name, tmp_path):
    text, message = BAD[name]
    (tmp_path / "bad.urdf").write_text(text)
    with pytest.raises(mp.errors.InvalidRobot, match=f"bad.urdf: {message}"):
        read_urdf(tmp_path / "bad.urdf", mp.errors.InvalidRobot)


def test_all_findings_are_said(tmp_path):
    (tmp_path / "bad.urdf").write_text(
        BAD["negative"][0].replace("</robot>", joint("j", "a", "c", inside="") + "</robot>")
    )
    with pytest.raises(mp.errors.InvalidRobot) as found:
        read_urdf(tmp_path / "bad.urdf", mp.errors.InvalidRobot)
    assert len(str(found.value).splitlines()) == 2


READ = """
import sys
import mcplan as mp
from mcplan.files.planar_urdf import PlanarEnd, planar_robot_from_urdf
from mcplan.files.urdf import End, load_model
for read in (lambda: planar_robot_from_urdf(sys.argv[1], [PlanarEnd("e", sys.argv[2])]),
             lambda: load_model(sys.argv[1], (End("e", sys.argv[2]),))):
    try:
        print(type(read()).__name__)
    except mp.InvalidInput as found:
        print(found)
"""


@pytest.mark.parametrize("links", [MAX_CHAIN, 4000])
def test_no_chain_is_so_deep_that_the_process_dies(links, tmp_path):
    pytest.importorskip("example_robot_data")
    (tmp_path / "chain.urdf").write_text(chain(links, "revolute" if links == MAX_CHAIN else "fixed"))
    command = [sys.executable, "-c", READ, str(tmp_path / "chain.urdf"), f"l{links - 1}"]
    found = subprocess.run(command, capture_output=True, text=True)
    assert found.returncode == 0, found.stderr
    if links == MAX_CHAIN:
        planar, in_space = found.stdout.splitlines()
        assert planar.endswith(f"bodies: may have 100 entries at most, got {MAX_CHAIN}") and in_space == "tuple"
    else:
        assert found.stdout.count("at most, got") == 2


@pytest.mark.parametrize(
    ("mesh", "message"),
    [
        ("pipe.stl", "must be a regular file, got a pipe"),
        ("large.stl", "may have 256 MiB at most"),
        ("/dev/zero", "must lie in the robot's package"),
        ("../../outside.stl", "must lie in the robot's package"),
        ("package://../outside.stl", "must lie in the robot's package"),
        ("notes.txt", "must end in .stl"),
    ],
)
def test_meshes_are_regular_files_of_the_robots_package(mesh, message, tmp_path):
    pytest.importorskip("pinocchio")
    from mcplan.kinematics.urdf_model import load_model

    folder = tmp_path / "package" / "urdf"
    folder.mkdir(parents=True)
    body = arm_robot(folder)
    file = folder / "arm.urdf"
    visual = f'<visual><geometry><mesh filename="{mesh}"/></geometry></visual></link>'
    file.write_text(file.read_text().replace("</link>", visual, 1))
    os.mkfifo(folder / "pipe.stl")
    for path, size in ((folder / "large.stl", 2**30), (tmp_path / "outside.stl", 1), (folder / "notes.txt", 1)):
        with path.open("wb") as made:
            made.truncate(size)
    with pytest.raises(mp.errors.InvalidRobot, match=f"arm: urdf: must be a readable URDF, got .*{message}"):
        load_model(body)


def test_a_pipe_is_no_urdf(tmp_path, capsys):
    pytest.importorskip("example_robot_data")
    os.mkfifo(tmp_path / "x.urdf")
    for words in ([], ["--planar"]):
        assert main(["robots", *words, "--from-urdf", str(tmp_path / "x.urdf"), "--end", "a=b"]) == 2
        assert "must be a regular file, got a pipe" in capsys.readouterr().err


def test_a_robot_made_from_a_urdf_names_it_from_where_it_lies(tmp_path, monkeypatch, capsys):
    """Written beside or above its URDF a robot finds it from anywhere; written elsewhere it does without."""
    pytest.importorskip("example_robot_data")
    from mcplan.files.robots import load_robot

    folder = tmp_path / "robots" / "urdf"
    folder.mkdir(parents=True)
    (folder / "leg.urdf").write_text(LEG)
    monkeypatch.chdir(tmp_path)
    words = ["robots", "--from-urdf", "robots/urdf/leg.urdf", "--end", "foot=tip:foot", "-o"]
    assert main([*words, "robots/leg.toml"]) == 0
    assert "note: no trunk, robots/urdf/leg.urdf has no visual shapes of it" in capsys.readouterr().err
    assert 'urdf = "urdf/leg.urdf"' in Path("robots/leg.toml").read_text()
    monkeypatch.chdir("/")
    assert load_robot(tmp_path / "robots" / "leg.toml").urdf == str(folder / "leg.urdf")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    assert main([*words, "elsewhere/leg.toml"]) == 0
    assert "lies neither in the folder of elsewhere/leg.toml nor below: left out" in capsys.readouterr().err
    assert load_robot("elsewhere/leg.toml").urdf == ""
