"""mcplan.files.reading: only regular files of a bounded size are read, and files name others beside them alone."""

from __future__ import annotations

import io
import json
import os
import socket
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import numpy as np
import pytest

import malformed
import mcplan as mp
from mcplan.cli import main
from mcplan.files.archives import read_arrays
from mcplan.files.builtin import DATA
from mcplan.files.plans import MAX_PHASES, load_plan, plan_to_bytes
from mcplan.files.reading import MAX_TOML, read_file
from mcplan.files.robots import load_robot
from mcplan.files.scenes import load_scene
from mcplan.files.toml import toml_text
from mcplan.files.whole_body_plans import load_any_plan, load_whole_body_plan
from standing import standing_plan

LOADERS = [
    load_scene,
    load_robot,
    mp.load_planar_robot,
    mp.load_planar_task,
    load_plan,
    load_any_plan,
    load_whole_body_plan,
]


def robot_file(folder: Path, **changes: object) -> Path:
    """A robot whose com_reach or other fields are changed."""
    data = malformed.broken(malformed.ROBOT, ("posture",), {})
    if "com_reach" in changes:
        data["end_effectors"][0]["com_reach"] = changes.pop("com_reach")
    folder.mkdir(exist_ok=True)
    (folder / "robot.toml").write_text(toml_text({**data, **changes}))
    return folder / "robot.toml"


POLYTOPE = {"polytopes": {"com": malformed.ROBOT["end_effectors"][0]["com_reach"]}}


@pytest.mark.parametrize("load", LOADERS, ids=lambda load: load.__name__)
@pytest.mark.parametrize("kind", ["pipe", "socket", "folder", "zero"])
def test_what_is_no_regular_file_is_refused_without_waiting_for_it(load, kind, tmp_path):
    path = tmp_path / "x"
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "socket":
        with socket.socket(socket.AF_UNIX) as made:
            made.bind(str(path))
    elif kind == "folder":
        path.mkdir()
    else:
        path = Path("/dev/zero")
    with pytest.raises(
        mp.InvalidInput, match="must be a regular file, got a (pipe|socket|device)|cannot be read: Is a"
    ):
        load(path)


def test_a_file_above_the_limit_is_refused_before_it_is_read(tmp_path):
    with (tmp_path / "large.toml").open("wb") as file:
        file.truncate(200 * MAX_TOML)  # a hole: it takes no place on the disk
    with pytest.raises(mp.errors.InvalidScene, match=r"large.toml: may have 2 MiB at most, got 419430400 bytes"):
        load_scene(tmp_path / "large.toml")


def test_files_that_say_nothing_of_their_size_are_read_up_to_the_limit():
    assert os.stat("/proc/kallsyms").st_size == 0
    with pytest.raises(mp.InvalidInput, match="may have 1 KiB at most, got more"):
        read_file("/proc/kallsyms", 1024, mp.InvalidInput)


@pytest.mark.parametrize(
    "name",
    [
        "../reach.json",
        "/dev/zero",
        "/etc/passwd",
        "sub/../../reach.json",
        "link.json",
        "loop.json",
        "x" * 5000,
        "a\0b",
        ".",
        "pipe",
    ],
)
def test_polytopes_lie_beside_the_robot_or_below(name, tmp_path):
    folder = tmp_path / "robots"
    file = robot_file(folder, com_reach={"file": name, "name": "com"})
    (tmp_path / "reach.json").write_text(json.dumps(POLYTOPE))
    (folder / "sub").mkdir()
    (folder / "link.json").symlink_to(tmp_path / "reach.json")
    (folder / "loop.json").symlink_to(folder / "loop.json")
    os.mkfifo(folder / "pipe")
    with pytest.raises(mp.errors.InvalidRobot) as found:
        load_robot(file)
    assert found.value.field == "end_effectors[0].com_reach.file" and found.value.source == str(file)


@pytest.mark.parametrize("name", ["reach.json", "sub/reach.json", "inner.json"])
def test_polytopes_below_the_robots_folder_are_read(name, tmp_path):
    folder = tmp_path / "robots"
    file = robot_file(folder, com_reach={"file": name, "name": "com"})
    (folder / "sub").mkdir()
    for place in (folder / "reach.json", folder / "sub" / "reach.json"):
        place.write_text(json.dumps(POLYTOPE))
    (folder / "inner.json").symlink_to("sub/reach.json")
    assert load_robot(file).end_effectors[0].com_reach.given


def test_a_urdf_is_found_beside_its_robot_from_any_working_directory(tmp_path, monkeypatch):
    file = robot_file(tmp_path / "robots", urdf="urdf/my.urdf")
    (tmp_path / "robots" / "urdf").mkdir()
    (tmp_path / "robots" / "urdf" / "my.urdf").write_text("<robot/>")
    assert load_robot(file).urdf == str(tmp_path / "robots" / "urdf" / "my.urdf")
    monkeypatch.chdir(tmp_path)
    assert load_robot("robots/robot.toml").urdf == "robots/urdf/my.urdf"


@pytest.mark.parametrize("name", ["robot.toml", "./robot.toml", "../robots/robot.toml"])
def test_a_robot_in_the_working_directory_names_files_beside_it(name, tmp_path, monkeypatch):
    robot_file(tmp_path / "robots", urdf="my.urdf", com_reach={"file": "reach.json", "name": "com"})
    (tmp_path / "robots" / "my.urdf").write_text("<robot/>")
    (tmp_path / "robots" / "reach.json").write_text(json.dumps(POLYTOPE))
    monkeypatch.chdir(tmp_path / "robots")
    robot = load_robot(name)
    assert Path(robot.urdf).samefile(tmp_path / "robots" / "my.urdf") and robot.end_effectors[0].com_reach.given


def test_a_working_directory_that_is_gone_is_no_crash(tmp_path, monkeypatch):
    file = robot_file(tmp_path / "robots", com_reach={"file": "reach.json", "name": "com"})
    (tmp_path / "robots" / "reach.json").write_text(json.dumps(POLYTOPE))
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    assert load_robot(file).end_effectors[0].com_reach.given
    with pytest.raises(mp.errors.UnknownRobot):
        load_robot("robot.toml")


@pytest.mark.parametrize("urdf", ["../my.urdf", "/dev/zero", "/nowhere/my.urdf", "link.urdf"])
def test_a_urdf_elsewhere_is_refused(urdf, tmp_path):
    file = robot_file(tmp_path / "robots", urdf=urdf)
    (tmp_path / "my.urdf").write_text("<robot/>")
    (tmp_path / "robots" / "link.urdf").symlink_to(tmp_path / "my.urdf")
    with pytest.raises(
        mp.errors.InvalidRobot, match="urdf: must lie in the folder of the file that names it, or below"
    ):
        load_robot(file)


def test_a_task_names_robots_beside_it_alone(tmp_path):
    text = toml_text({"robot": "../robot.toml", "surfaces": [{"name": "a"}], "phases": [{"lift": ["x"]}]})
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "task.toml").write_text(text)
    (tmp_path / "robot.toml").write_text("")
    with pytest.raises(mp.errors.InvalidPlanarTask, match="task.toml: robot: must lie in the folder"):
        mp.load_planar_task(tmp_path / "sub" / "task.toml")


@pytest.mark.parametrize("name", [".", "pipe"])
def test_a_task_whose_robot_is_no_regular_file_is_named(name, tmp_path):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "task.toml").write_text(
        toml_text({"robot": name, "surfaces": [{"name": "a"}], "phases": [{"lift": ["x"]}]})
    )
    with pytest.raises(
        mp.errors.InvalidPlanarTask, match="task.toml: robot: (must be a regular file|cannot be read: Is a directory)"
    ):
        mp.load_planar_task(tmp_path / "task.toml")


def test_a_task_in_the_working_directory_names_a_robot_beside_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_bytes((DATA / "planar_robots" / "climber9.toml").read_bytes())
    text = (DATA / "planar_tasks" / "cartwheel.toml").read_text().replace('"climber9"', '"mine.toml"')
    (tmp_path / "task.toml").write_text(text)
    assert mp.load_planar_task("task.toml").robot.mass() == 24.5


def test_the_robots_that_mcplan_brings_may_be_links(tmp_path, monkeypatch):
    """Some package managers put links in place of files: what lies beside them is then elsewhere."""
    (tmp_path / "store").mkdir()
    (tmp_path / "data" / "robots").mkdir(parents=True)
    for name in ("talos_wang.toml", "talos_wang_reach.json"):
        (tmp_path / "store" / name).write_bytes((DATA / "robots" / name).read_bytes())
        (tmp_path / "data" / "robots" / name).symlink_to(tmp_path / "store" / name)
    monkeypatch.setenv("MCPLAN_DATA", str(tmp_path / "data"))
    assert load_robot("talos_wang").end_effectors[0].com_reach.given


# --- archives ---


def bytes_of(members: dict[str, bytes], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", method) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return buffer.getvalue()


def array_bytes(array: np.ndarray) -> bytes:
    buffer = io.BytesIO()
    np.lib.format.write_array(buffer, array, allow_pickle=True)
    return buffer.getvalue()


def claiming(shape: str, descr: str = "'<f8'", fortran: str = "False") -> bytes:
    """An array's header that claims a shape, and 16 bytes of content."""
    text = f"{{'descr': {descr}, 'fortran_order': {fortran}, 'shape': {shape}, }}"
    text += " " * (64 - (10 + len(text) + 1) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text.encode() + bytes(16)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (claiming("(10**12,)"), "must be an array of NumPy"),
        (claiming("(1000000000000,)"), r"a: must have the 16 bytes that are there, got shape \(1000000000000,\)"),
        (claiming("(-2,)"), "must have the 16 bytes"),
        (claiming("(" + "1," * 32 + ")"), "4 axes at most"),
        (claiming("(2,)", "'|O'"), 'must be an .npz or .json file written by mcplan, got an array "a" of dtype'),
        (claiming("(1,)", "'<c16'"), "must be an .npz or .json file"),
        (claiming("(1,)", "'<f16'"), "must hold numbers of 64 bits at most"),
        (claiming("(1,)", "[('a', '<f8'), ('b', '<f8')]"), "must be an .npz or .json file"),
        (claiming("(" * 4000), "must be an array of NumPy"),
        (b"\x93NUMPY\x03\x00" + bytes(20), "must be an array of NumPy"),
        (b"", "must be an array of NumPy"),
    ],
)
def test_an_array_is_what_is_there_and_not_what_it_claims(content, message):
    with pytest.raises(mp.errors.InvalidPlan, match=message):
        read_arrays(bytes_of({"a.npy": content}))


def test_arrays_that_inflate_beyond_the_limit_are_refused_before_they_do():
    zeros = array_bytes(np.zeros(2**20))
    data = bytes_of({f"{i}.npy": zeros for i in range(3)})
    assert len(data) < 100_000
    with pytest.raises(mp.errors.InvalidPlan, match="may have 16 MiB at most when inflated, got 25166208 bytes"):
        read_arrays(data, 16 * 2**20)
    assert len(read_arrays(data, 32 * 2**20)) == 3


def test_a_member_that_inflates_further_than_it_says_is_damaged():
    data = bytearray(bytes_of({"a.npy": array_bytes(np.zeros(2**20))}))
    entry = data.rfind(b"PK\x01\x02")
    data[entry + 24 : entry + 28] = (1000).to_bytes(4, "little")
    with pytest.raises(mp.errors.InvalidPlan):
        read_arrays(bytes(data))


def test_few_arrays_make_an_archive():
    with pytest.raises(mp.errors.InvalidPlan, match="may have 64 arrays at most"):
        read_arrays(bytes_of({f"{i}.npy": claiming("(2,)") for i in range(65)}))
    with pytest.raises(mp.errors.InvalidPlan, match="may have 64 arrays at most, got a directory of"):
        read_arrays(bytes_of({f"{i}": b"" for i in range(5000)}))


def test_other_compressions_are_refused():
    with pytest.raises(mp.errors.InvalidPlan, match="a.npy: must be stored or deflated, got 14"):
        read_arrays(bytes_of({"a.npy": claiming("(2,)")}, zipfile.ZIP_LZMA))


@pytest.mark.parametrize("text", ['{"planner": "\\ud800"}', '{"a": [{"\\udfff": 1}]}'])
def test_halves_of_characters_are_no_text(text):
    from mcplan.files.archives import read_header

    with pytest.raises(mp.errors.InvalidPlan, match="must be text") as found:
        read_header({"header": np.frombuffer(text.encode(), dtype=np.uint8)})
    assert str(found.value).isprintable()


PEAK = """
import resource, sys
import mcplan as mp
from mcplan.files.whole_body_plans import load_any_plan, load_whole_body_plan
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
try:
    load_any_plan(sys.argv[1])
except mp.errors.InvalidPlan as found:
    print(found)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
"""


def peak_MiB(file: Path) -> tuple[str, float]:
    """What reading a plan says, and what it adds to the memory of its process."""
    found = subprocess.run(
        [sys.executable, "-c", PEAK, str(file)], capture_output=True, text=True, check=True, timeout=60
    )
    *said, peak = found.stdout.splitlines()
    return "\n".join(said), int(peak) / 1024


def test_a_small_file_takes_little_memory(tmp_path):
    """2 million phases of zeros, 8 million swings: some kB when deflated, a gigabyte as a plan."""
    with np.load(io.BytesIO(plan_to_bytes(standing_plan()))) as archive:
        arrays = {name: archive[name] for name in archive.files}
    for name, factor in (("durations", 2_000_000), ("swing_heights", 8_000_000)):
        np.savez_compressed(tmp_path / "bomb.npz", **{**arrays, name: np.zeros(factor)})
        assert (tmp_path / "bomb.npz").stat().st_size < 200_000
        said, peak = peak_MiB(tmp_path / "bomb.npz")
        assert f"{name}: may be" in said and peak < 300, (said, peak)
    np.savez_compressed(tmp_path / "bomb.npz", **{**arrays, "other": np.zeros(200_000_000, dtype=np.uint8)})
    said, peak = peak_MiB(tmp_path / "bomb.npz")
    assert "may have 128 MiB at most when inflated" in said and peak < 100


def test_a_plan_that_could_not_be_read_again_is_not_written(tmp_path):
    plan = standing_plan()
    plan.phases = [plan.phases[0]] * (MAX_PHASES + 1)
    plan.knots = [plan.knots[0]] * (MAX_PHASES + 2)
    with pytest.raises(mp.errors.InvalidPlan, match="phases: may be 10000 at most, got 10001"):
        plan.save(tmp_path / "long.npz")
    assert not (tmp_path / "long.npz").exists()


# --- text ---


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("gravity = 0x" + "f" * 10_000, "is not TOML: "),
        ("gravity = 0x" + "f" * 16, "is not TOML: "),
        ("gravity = " + "9" * 10_000, "is not TOML: "),
        ('"\\u001b[31m" = 1', r"\\x1b[31m: no such key"),
        ('gravity = "\\u202e"', 'gravity: must be a number, got "\\\\u202e"'),
        ("a" + ".a" * 500_000 + " = 1", "a key may have 100 parts at most"),
        ("x = " + "[" * 100_000, "is not TOML"),
        ("\n".join(f"k{i} = 1" for i in range(100_000)), "may have 1000 keys at most"),
    ],
)
def test_no_text_makes_an_error_while_an_error_is_made(line, message, tmp_path):
    begin = time.process_time()
    (tmp_path / "bad.toml").write_text(
        line + "\n" + toml_text(malformed.broken(malformed.SCENE, ("gravity",), malformed.DELETE))
    )
    with pytest.raises(mp.errors.InvalidScene) as found:
        load_scene(tmp_path / "bad.toml")
    assert message.replace("\\\\", "\\") in str(found.value) and all(
        x.isprintable() for x in str(found.value).splitlines()
    )
    assert time.process_time() - begin < 10.0  # of the processor: some of these took hours


def test_all_findings_are_said_at_once_and_each_on_its_line(tmp_path, capsys):
    data = malformed.broken(malformed.SCENE, ("surfaces", 0, "friction"), -1.0)
    data = malformed.broken(data, ("gravity",), "heavy")
    data = malformed.broken(data, ("goal", "yaw"), float("nan"))
    (tmp_path / "bad.toml").write_text(toml_text(data))
    assert main(["scenes", str(tmp_path / "bad.toml")]) == 2
    file = tmp_path / "bad.toml"
    assert capsys.readouterr().err.splitlines() == [
        f'error: {file}: gravity: must be a number, got "heavy"',
        f"error: {file}: surfaces[0].friction: must be a positive number, got -1.0",
        f"error: {file}: goal.yaw: must be a finite number, got nan",
    ]


@pytest.mark.parametrize(("wrong", "right"), [("verticies", "vertices"), ("vertexes", "vertices"), ("nam", "name")])
def test_a_misspelt_required_key_is_named_once(wrong, right, tmp_path):
    data = malformed.broken(malformed.SCENE, ("surfaces", 0, right), malformed.DELETE)
    data["surfaces"][0][wrong] = malformed.SCENE["surfaces"][0][right]
    (tmp_path / "bad.toml").write_text(toml_text(data))
    with pytest.raises(mp.errors.InvalidScene) as found:
        load_scene(tmp_path / "bad.toml")
    assert str(found.value).startswith(
        f"{tmp_path / 'bad.toml'}: surfaces[0].{wrong}: no such key. Did you mean '{right}'? Keys: "
    )
    assert found.value.others == ()


def test_legal_keys_of_a_table_are_listed_once(tmp_path):
    data = {**malformed.SCENE, "gravitiy": 9.8, "zzz": 1, "nmae": "x"}
    (tmp_path / "bad.toml").write_text(toml_text(data))
    with pytest.raises(mp.errors.InvalidScene) as found:
        load_scene(tmp_path / "bad.toml")
    first, *others = (line.removeprefix(f"{tmp_path / 'bad.toml'}: ") for line in str(found.value).splitlines())
    assert first.startswith("gravitiy: no such key. Did you mean 'gravity'? Keys: name, ")
    assert others == ["zzz: no such key", "nmae: no such key. Did you mean 'name'?"]


def test_twenty_findings_are_listed_and_the_rest_is_counted(tmp_path):
    data = {
        **malformed.SCENE,
        "surfaces": [
            *malformed.SCENE["surfaces"],
            *({"name": f"s{i}", "vertices": malformed.SQUARE, "friction": -1.0} for i in range(70)),
        ],
    }
    (tmp_path / "bad.toml").write_text(toml_text(data))
    with pytest.raises(mp.errors.InvalidScene) as found:
        load_scene(tmp_path / "bad.toml")
    lines = str(found.value).splitlines()
    assert len(lines) == 21 and lines[-1] == "and 50 more" and len(found.value.others) == 69
