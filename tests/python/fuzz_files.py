"""Mutations of files of every kind, read in a process of its own: python fuzz_files.py KIND SEED COUNT FOLDER.

Each mutation must load, or end in one of mcplan's errors that names the file in text any terminal can show, with bounded
time and memory. The process writes the number of the mutation before it tries it, so that a crash can be repeated:
mutation(KIND, SEED, NUMBER) gives the bytes.
"""

from __future__ import annotations

import contextlib
import copy
import io
import json
import resource
import signal
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import numpy as np

from mcplan import load_planar_robot, load_planar_task, load_robot, load_scene
from mcplan._core import plan_to_json, planar_plan_to_json
from mcplan.cli import main as command
from mcplan.errors import InvalidInput, UnknownName
from mcplan.files.archives import read_arrays
from mcplan.files.builtin import DATA
from mcplan.files.planar_robots import planar_robot_to_dict
from mcplan.files.planar_tasks import planar_task_to_dict
from mcplan.files.plans import plan_from_bytes, plan_to_bytes
from mcplan.files.robots import robot_to_dict
from mcplan.files.scenes import scene_to_dict
from mcplan.files.toml import toml_text
from mcplan.files.whole_body_plans import load_any_plan
from plain_toml import tomllib

#: Of one mutation [s of the processor], and what all of them may add to the memory in use [KiB].
MAX_CPU_S, MAX_GROWTH_KIB = 10.0, 600 * 1024

DEEP: Any = 0
for _ in range(60):
    DEEP = [DEEP]
HOSTILE: list[Any] = [
    float("nan"), float("inf"), -float("inf"), 0, -1, 1, 0.0, 1e308, -1e308, 5e-324, 1e-9, 1e9, 2**31, -(2**31) - 1, 2**63,
    2**64, 10**400, True, False, "", "x", "foot", "inf", "nan", "a\x00b", "\x1b[31mred", "\u202egnp", "\U0001f9a9", "x" * 5000,
    "../../../../etc/passwd", "/dev/zero", ".", "%s%n{}", [], {}, [0.0], [1.0, 2.0, 3.0], [[]], [{}], {"": 0}, {"x": {"y": []}},
    DEEP, [0.0] * 2000, ["x"] * 1100,
]  # fmt: skip
NUMBERS = [
    b"1e999",
    b"-0",
    b"0x" + b"f" * 5000,
    b"9" * 5000,
    b"1_0",
    b"+nan",
    b"1979-05-27",
    b"00",
    b".5",
    b"1e-400",
    b"--1",
]
SNIPPETS = [
    b"[" * 3000, b"a." * 3000 + b"a = 1\n", b"\xff", b"\x00", "\u2028".encode(), "é".encode("latin-1"), b"'" * 3, b'"' * 3,
    b"#", b"{}", b"]]", b"=", b"\r", b"<!DOCTYPE x [<!ENTITY a 'b'>]>", b"&lt;", b"&a;", b"<link name='x'/>", b"</link>",
    b"<a>" * 200, b"nan",
]  # fmt: skip

LEG = (
    '<robot name="leg">{links}<joint name="hip" type="revolute"><parent link="base"/><child link="thigh"/>'
    '<origin xyz="0 0 0.1" rpy="0 0 0"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="10" velocity="5"/></joint>\n'
    '<joint name="knee" type="revolute"><parent link="thigh"/><child link="shin"/><origin xyz="0 0 -0.3"/>'
    '<axis xyz="0 1 0"/><limit lower="-2" upper="0" effort="10" velocity="5"/></joint>\n'
    '<joint name="ankle" type="fixed"><parent link="shin"/><child link="sole"/><origin xyz="0 0 -0.3"/></joint>\n'
    "</robot>\n"
)
LINK = (
    '<link name="{name}"><inertial><origin xyz="0 0 -0.1"/><mass value="{mass}"/><inertia ixx="0.1" iyy="0.1" izz="0.1" '
    'ixy="0" ixz="0" iyz="0"/></inertial><visual><geometry><box size="0.1 0.1 0.2"/></geometry></visual></link>\n'
)


def _urdf() -> bytes:
    links = [LINK.format(name=name, mass=mass) for name, mass in (("base", 5), ("thigh", 1), ("shin", 0.5))]
    return LEG.format(links="".join(links) + '<link name="sole"/>\n').encode()


def _polytopes() -> bytes:
    return (DATA / "robots" / "talos_wang_reach.json").read_bytes()


def _plans() -> list[bytes]:
    """One of each format."""
    import plans_by_hand
    from stepping import stepping_plan
    from wrench_plans import standing_on_wrenches

    walk = plans_by_hand.walk(plans_by_hand.flat(), plans_by_hand.humanoid())
    return [plan_to_bytes(plan) for plan in (walk, stepping_plan(), standing_on_wrenches())]


def _plans_in_json() -> list[bytes]:
    return [plan_to_json(plan_from_bytes(data)) for data in _plans()]


def _whole_body_plan_in_json() -> bytes:
    from mcplan.files.whole_body_plans import plan_from_bytes as from_bytes

    return planar_plan_to_json(from_bytes(_whole_body_plan()))


def _whole_body_plan() -> bytes:
    from mcplan.files.whole_body_plans import plan_to_bytes as to_bytes
    from reference_solutions import reference_plan

    return to_bytes(reference_plan("cartwheel", "optimised_per_point"))


def _run() -> bytes:
    """Of a robot that follows a plan in simulation; without one, which takes MuJoCo."""
    import dataclasses
    import tempfile

    import recordings
    from mcplan.tracking import Options, Push, TrackingResult

    recording = dataclasses.replace(recordings.walking(), robot=load_robot("talos"), fell_at_s=2.5)
    result = TrackingResult(recording, recordings.measures(fell=True), Options(pushes=(Push(40.0, 0.2, 0.8),)), True)
    with tempfile.TemporaryDirectory() as folder:
        result.save(Path(folder) / "run.npz")
        return (Path(folder) / "run.npz").read_bytes()


def _inline() -> bytes:
    """A planar task with its robot as a table."""
    return _plain(planar_task_to_dict(load_planar_task("cartwheel")))


def _plain(value: Any) -> bytes:
    return toml_text(value).encode("utf-8", "surrogatepass")


#: Valid content of each kind, one or more.
VALID: dict[str, Callable[[], list[bytes]]] = {
    "scene": lambda: [_plain(scene_to_dict(load_scene(name))) for name in ("gap_with_rail", "turn", "up_and_down")],
    "robot": lambda: [_plain(robot_to_dict(load_robot(name))) for name in ("humanoid44", "anymal", "talos_wang")],
    "polytopes": lambda: [_polytopes()],
    "planar_robot": lambda: [_plain(planar_robot_to_dict(load_planar_robot(name))) for name in ("walker9", "climber9")],
    "planar_task": lambda: (
        [(DATA / "planar_tasks" / f"{name}.toml").read_bytes() for name in ("cartwheel", "stairs", "walking")]
        + [_inline()]
    ),
    "plan": _plans,
    "plan_in_json": _plans_in_json,
    "whole_body_plan": lambda: [_whole_body_plan()],
    "whole_body_plan_in_json": lambda: [_whole_body_plan_in_json()],
    "run": lambda: [_run()],
    "urdf": lambda: [_urdf()],
}
ENDINGS = {
    "polytopes": ".json",
    "plan_in_json": ".json",
    "whole_body_plan_in_json": ".json",
    "plan": ".npz",
    "whole_body_plan": ".npz",
    "run": ".npz",
    "urdf": ".urdf",
}
_content: dict[str, list[bytes]] = {}


def mutation(kind: str, seed: int, number: int) -> bytes:
    """The bytes of a mutation, the same ones for the same arguments."""
    if kind not in _content:
        _content[kind] = VALID[kind]()
    rng, data = Random(f"{kind} {seed} {number}"), _content[kind][number % len(_content[kind])]
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        data = _mutated(kind, data, rng)
    return data


def _mutated(kind: str, data: bytes, rng: Random) -> bytes:
    if ENDINGS.get(kind) == ".npz":
        return _archive(data, rng) if rng.random() < 0.7 else _bytes(data, rng)
    if rng.random() < 0.5:
        return _lines(data, rng) if rng.random() < 0.6 else _bytes(data, rng)
    try:
        if ENDINGS.get(kind) == ".json":
            return json.dumps(_tree(json.loads(data), rng)).encode("utf-8", "surrogatepass")
        if kind == "urdf":
            return _words(data, rng)
        return _plain(_tree(tomllib.loads(data.decode()), rng))
    except (ValueError, TypeError, RecursionError, UnicodeError):  # mutated before: no longer of that kind
        return _bytes(data, rng)


def _bytes(data: bytes, rng: Random) -> bytes:
    out = bytearray(data)
    at = rng.randrange(len(out)) if out else 0
    match rng.randrange(5):
        case 0:
            for _ in range(rng.choice((1, 2, 8))):
                if out:
                    out[rng.randrange(len(out))] ^= 1 << rng.randrange(8)
        case 1:
            del out[at:]
        case 2:
            del out[at : at + rng.choice((1, 4, 64))]
        case 3:
            out[at:at] = rng.choice(SNIPPETS)
        case 4:
            out[at : at + 1] = bytes([rng.randrange(256)])
    return bytes(out)


def _lines(data: bytes, rng: Random) -> bytes:
    lines = data.split(b"\n")
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    match rng.randrange(4):
        case 0:
            lines.insert(j, lines[i])
        case 1:
            del lines[i]
        case 2:
            lines[i], lines[j] = lines[j], lines[i]
        case 3:
            return _words(data, rng)
    return b"\n".join(lines)


def _words(data: bytes, rng: Random) -> bytes:
    """A number or a quoted word replaced."""
    import re

    found = list(re.finditer(rb'-?\d[\d.e+-]*|"[^"\n]*"', data))
    if not found:
        return data
    at = rng.choice(found)
    value = rng.choice(HOSTILE)
    written = rng.choice(
        (*NUMBERS, json.dumps(value, ensure_ascii=False).encode("utf-8", "surrogatepass"), rng.choice(found)[0])
    )
    return data[: at.start()] + written + data[at.end() :]


def _tree(data: Any, rng: Random) -> Any:
    """Nested data changed in one place."""
    data = copy.deepcopy(data)
    places: list[tuple[Any, Any]] = []
    left = [data]
    while left:
        value = left.pop()
        items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
        for key, inner in items:
            places.append((value, key))
            left.append(inner)
    if not places:
        return data
    (owner, key), (other, other_key) = rng.choice(places), rng.choice(places)
    match rng.randrange(6):
        case 0 | 1:
            owner[key] = copy.deepcopy(rng.choice(HOSTILE))
        case 2:
            del owner[key]
        case 3:
            owner[key] = copy.deepcopy(other[other_key])
        case 4:
            if isinstance(owner, dict):
                owner[rng.choice((str(key)[:-1], str(key) + "s", "\x1b", "x" * 300, ""))] = owner.pop(key)
            else:
                owner.extend([copy.deepcopy(owner[key])] * rng.choice((1, 9, 1200)))
        case 5:
            if isinstance(owner[key], float | int) and abs(owner[key]) < 1e300:
                owner[key] = owner[key] * rng.choice((-1, 10, 1e3, 1e-3, 1e12))
    return data


def _archive(data: bytes, rng: Random) -> bytes:
    """An archive packed again: arrays, headers of arrays, the JSON header, or the list of members changed."""
    try:
        arrays = read_arrays(data)
        header = json.loads(arrays.pop("header").tobytes())
    except (InvalidInput, ValueError, KeyError):
        return _bytes(data, rng)
    choice = rng.randrange(4)
    if choice == 0:
        try:
            text = json.dumps(_tree(header, rng)).encode()
        except (ValueError, RecursionError):
            return data
        text = _words(text, rng) if rng.random() < 0.1 else text
        return _packed({**arrays, "header": np.frombuffer(text, dtype=np.uint8)}, rng)
    if choice == 1:
        with contextlib.suppress(ValueError, IndexError, OverflowError, TypeError):
            _change_array(arrays, rng)
        return _packed_with(header, arrays, rng)
    if choice == 2:
        return _declared(_packed_with(header, arrays, rng), rng)
    return _packed_with(header, arrays, rng, broken=True)


def _packed_with(header: Any, arrays: dict[str, Any], rng: Random, broken: bool = False) -> bytes:
    text = np.frombuffer(json.dumps(header).encode(), dtype=np.uint8)
    return _packed({**arrays, "header": text}, rng, broken)


def _change_array(arrays: dict[str, Any], rng: Random) -> None:
    name = rng.choice(sorted(arrays))
    array = arrays[name].copy()
    match rng.randrange(8):
        case 0:
            array.flat[rng.randrange(max(1, array.size))] = rng.choice(
                (np.nan, np.inf, -np.inf, 1e308, 0, -1, 2**31, 1e9)
            )
        case 1:
            array = array.astype(rng.choice(("f4", "f8", "i8", "u1", "b1", "c16", "U4", "O", ">f8", "f2", "i4", "u8")))
        case 2:
            array = array.reshape(rng.choice(((-1,), (1, *array.shape), (*array.shape, 1), array.shape[::-1])))
        case 3:
            array = np.concatenate([array] * rng.choice((2, 50)))
        case 4:
            array = array[: rng.randrange(len(array) + 1)]
        case 5:
            array = np.zeros(rng.choice(((), (0,), (0, 0, 0), (20_000,), (1, 1, 1, 1, 1))))
        case 6:
            array = rng.choice(list(arrays.values()))
        case 7:
            del arrays[name]
            return
    arrays[rng.choice((name, name, name, "other", "\x1b[1m"))] = array


def _packed(arrays: dict[str, Any], rng: Random, broken: bool = False) -> bytes:
    buffer = io.BytesIO()
    victim = rng.choice(sorted(arrays))
    with zipfile.ZipFile(buffer, "w", rng.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))) as archive:
        for name, array in arrays.items():
            part = io.BytesIO()
            np.lib.format.write_array(part, np.asanyarray(array), allow_pickle=True)
            content = part.getvalue()
            if broken and name == victim:
                head, body = content[:128], content[128:]
                content = (_words(head, rng) if rng.random() < 0.5 else _bytes(head, rng)) + body
            archive.writestr(f"{name}.npy", content)
    return buffer.getvalue()


def _declared(data: bytes, rng: Random) -> bytes:
    """Sizes and other fields of a zip directory changed."""
    out = bytearray(data)
    marks = [i for mark in (b"PK\x01\x02", b"PK\x03\x04", b"PK\x05\x06") for i in _all(data, mark)]
    at = rng.choice(marks) + 4 + rng.randrange(40)
    width = rng.choice((1, 2, 4))
    out[at : at + width] = rng.choice((b"\xff\xff\xff\xff", b"\0\0\0\0", b"\x01\0\0\0", rng.randbytes(4)))[:width]
    return bytes(out)


def _all(data: bytes, mark: bytes) -> list[int]:
    """Where the mark begins, overlapping or not."""
    found = [data.find(mark)]
    while found[-1] >= 0:
        found.append(data.find(mark, found[-1] + 1))
    return found[:-1]


def read(kind: str, file: Path, number: int) -> None:
    """Read a file as its kind, and write again what came out."""
    match kind:
        case "scene":
            toml_text(scene_to_dict(load_scene(file)))
        case "robot":
            toml_text(robot_to_dict(load_robot(file)))
        case "polytopes":
            load_robot(file.parent / "names_polytopes.toml")
        case "planar_robot":
            toml_text(planar_robot_to_dict(load_planar_robot(file)))
        case "planar_task":
            toml_text(planar_task_to_dict(load_planar_task(file)))
        case "plan" | "plan_in_json" | "whole_body_plan" | "whole_body_plan_in_json":
            load_any_plan(file)
        case "run":
            from mcplan.planar.tracking.result import result_from as planar_result_from
            from mcplan.tracking.result import result_from
            from mcplan.tracking.run_files import PLANAR_RUN, RUN, load_run

            load_run(file, {RUN: result_from, PLANAR_RUN: planar_result_from})
        case "urdf":
            _read_urdf(file, number)


def _read_urdf(file: Path, number: int) -> None:
    from mcplan.files.planar_urdf import PlanarEnd, planar_robot_from_urdf
    from mcplan.files.urdf import End, robot_from_urdf
    from mcplan.kinematics.urdf_model import load_model

    if number % 3 == 0:
        planar_robot_from_urdf(file, [PlanarEnd("foot", "sole", (-0.1, 0.1))])
    elif number % 300 == 1:
        robot_from_urdf(str(file), (End("foot", "sole"),), step=0.1)
    else:
        robot = load_robot("anymal")
        robot.name, robot.urdf, robot.posture = str(file), str(file), {}
        robot.end_effectors = robot.end_effectors[:1]
        robot.end_effectors[0].frame = "sole"
        load_model(robot)


COMMANDS = {
    "scene": ("scenes",),
    "robot": ("robots",),
    "planar_robot": ("robots",),
    "planar_task": ("tasks",),
    "plan": ("check",),
    "plan_in_json": ("check",),
    "whole_body_plan": ("check",),
    "whole_body_plan_in_json": ("check",),
    "urdf": ("robots", "--planar", "--end", "foot=sole", "--from-urdf"),
}


def attempt(kind: str, file: Path, number: int) -> str:
    """Read a mutated file; "" or what is wrong with how that ended."""
    try:
        read(kind, file, number)
    except InvalidInput as found:
        text = str(found)
        if not all(line.isprintable() for line in text.splitlines()):
            return f"unprintable message {text!r}"
        if kind not in ("polytopes", "urdf") and str(file) not in text:
            return f"no file in {text!r}"
    except UnknownName as found:
        str(found)
    except Exception as found:
        return f"{type(found).__name__}: {found!r}"
    if number % 50 == 0 and kind in COMMANDS:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as said:
            try:
                code = command([*COMMANDS[kind], str(file)])
            except Exception as found:
                return f"the command: {type(found).__name__}: {found!r}"
        if code not in (0, 1, 2) or (code == 2 and not said.getvalue().startswith("error: ")):
            return f"the command: exit code {code}, {said.getvalue()!r}"
    return ""


def _too_long(*_: Any) -> None:
    raise TimeoutError(f"more than {MAX_CPU_S} s")


def run(kind: str, seed: int, first: int, count: int, folder: Path) -> list[str]:
    """Failures of some mutations; the number of the one under way stands in folder/progress."""
    if kind == "polytopes":
        robot = (DATA / "robots" / "talos_wang.toml").read_text()
        (folder / "names_polytopes.toml").write_text(robot.replace("talos_wang_reach.json", "mutated.json"))
    file, progress, failures = folder / f"mutated{ENDINGS.get(kind, '.toml')}", folder / "progress", []
    signal.signal(signal.SIGPROF, _too_long)
    for number in range(first, first + count):
        progress.write_text(str(number))
        file.write_bytes(mutation(kind, seed, number))
        signal.setitimer(signal.ITIMER_PROF, MAX_CPU_S)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        wrong = attempt(kind, file, number)
        signal.setitimer(signal.ITIMER_PROF, 0)
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        if grown > MAX_GROWTH_KIB:
            wrong = f"{wrong} {grown} KiB"
        if wrong:
            failures.append(f"mutation({kind!r}, {seed}, {number}): {wrong[:300]}")
    return failures


if __name__ == "__main__":
    _kind, _seed, _first, _count = sys.argv[1], *map(int, sys.argv[2:5])
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    for _line in run(_kind, _seed, _first, _count, Path(sys.argv[5])):
        print(_line, flush=True)
    print("done")
