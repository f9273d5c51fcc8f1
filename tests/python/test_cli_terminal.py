"""mcplan.cli.terminal: names are shown and not obeyed, every letter can be printed, and a reader may leave."""

from __future__ import annotations

import os
import random
import re
import subprocess
import sys

import pytest

import mcplan as mp
from mcplan.cli import main
from mcplan.cli.terminal import printable, shown
from standing import standing_plan

ESCAPES = "\x1b[31m\x1b]0;title\x07\x9b2J\x08\x7f\u202e"
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e]")


def command(*words, environment=None, shell=None, cwd=None) -> subprocess.CompletedProcess:
    arguments = [sys.executable, "-m", "mcplan", *map(str, words)]
    if shell is not None:
        arguments = ["bash", "-c", f"set -o pipefail; {sys.executable} -m mcplan {shell}"]
    return subprocess.run(
        arguments, capture_output=True, env={**os.environ, **(environment or {})}, cwd=cwd, timeout=300
    )


def test_control_characters_are_written_out_and_all_others_stay():
    assert printable("a\x1b[31mb\nc\td\x07") == r"a\x1b[31mb\nc\td\x07"
    assert shown("a\nb\tc\r") == "a\nb\tc\\r"
    random_ = random.Random(3)
    for _ in range(300):
        text = "".join(chr(random_.randrange(0x3000)) for _ in range(20))
        assert not CONTROL.search(printable(text)) and "\n" not in printable(text)
    for text in ("plain", "übergröße", "歩く", "🦿", r"back\slash"):
        assert printable(text) == text


@pytest.fixture
def hostile(tmp_path):
    plan = standing_plan()
    plan.scene.name = f"scene{ESCAPES}\nspoofed: ok"
    plan.robot.name = f"robot{ESCAPES}<script>alert(1)</script>"
    for surface in plan.scene.surfaces:
        surface.name += f"{ESCAPES}<img src=x onerror=alert(1)>"
    for end in plan.robot.end_effectors:
        end.name += f'{ESCAPES}"><script>alert(2)</script>'
    return plan


def test_names_never_command_the_terminal(hostile, capsys, monkeypatch, tmp_path):
    result = _Result(hostile)
    monkeypatch.setattr(mp, "plan", lambda *_, **__: result)
    main(["plan", "flat"])
    out, err = capsys.readouterr()
    assert r"\x1b[31m" in out and not CONTROL.search(out + err)
    assert "\nspoofed" not in out


def test_nor_do_names_in_what_python_prints(hostile):
    violation = mp.model.Violation(
        name="reach", phase=0, end_effector=f"foot{ESCAPES}", time_s=0.0, value=1.0, tolerance=0.0, unit="m"
    )
    for text in (repr(hostile), str(violation)):
        assert not CONTROL.search(text.replace("\u202e", ""))


def test_nor_do_names_of_files_and_of_what_is_not_there(capsys, tmp_path):
    for words in (
        ["plan", f"st{ESCAPES}airs"],
        ["check", str(tmp_path / f"p{ESCAPES}.npz")],
        ["plan", "flat", f"--{ESCAPES}"],
        ["plan", "flat", "-o", str(tmp_path / f"no{ESCAPES}/x.npz")],
        ["scenes", f"x\n{ESCAPES}"],
    ):
        assert main(words) == 2
        out, err = capsys.readouterr()
        assert out == "" and err.count("\n") == 1 and not CONTROL.search(err)


def test_nor_do_names_run_in_pages(hostile, tmp_path):
    page = mp.show(hostile).save_html(tmp_path / "page.html").read_text(encoding="utf-8")
    assert "<script>alert" not in page and "<img src=x" not in page and '"><script>' not in page


class _Result:
    def __init__(self, plan):
        self.plan, self.report = plan, mp.plan("flat", max_iterations=1).report


def test_a_line_end_in_a_files_name_makes_no_line(capsys):
    assert main(["check", "a\nerror: b.npz"]) == 2
    assert capsys.readouterr().err == "error: a\\nerror: b.npz: No such file or directory\n"


@pytest.mark.parametrize(
    "environment",
    [
        {"LC_ALL": "C", "PYTHONIOENCODING": "ascii"},
        {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
        {"LC_ALL": "C.UTF-8", "PYTHONIOENCODING": "latin-1"},
    ],
)
def test_letters_that_the_terminal_lacks_are_escaped(tmp_path, environment):
    path = tmp_path / "Füße 歩.npz"
    standing_plan().save(path)
    for name, code in ((path, 0), (tmp_path / "Größe 歩.npz", 2)):
        done = command("check", name, environment=environment)
        assert b"Traceback" not in done.stderr and done.returncode == code
        # Escaped, or, where Python takes the C locale for bytes that it does not know, the bytes of the name itself.
        assert any(letter in done.stdout + done.stderr for letter in (rb"\u6b69", rb"\udce6", "歩".encode()))


@pytest.mark.parametrize(
    ("line", "code"),
    [("scenes | head -1", 0), ("plan flat -o a.npz | true", 0), ("--help | true", 0), ("plan --help | head -1", 0)],
)
def test_a_reader_that_leaves_is_no_failure(tmp_path, line, code):
    done = command(shell=line, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (code, b"")
    if "a.npz" in line:
        mp.Plan.load(tmp_path / "a.npz")


def test_a_full_disk_behind_the_output_is_one_line():
    done = command(shell="scenes > /dev/full")
    assert (done.returncode, done.stderr.count(b"\n")) == (2, 1)
    assert done.stderr == b"error: standard output: No space left on device\n"


@pytest.mark.parametrize("stream", ["<&-", ">&-", "2>&-"])
def test_closed_streams_are_no_failure(stream):
    done = command(shell=f"version {stream}")
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.parametrize(
    ("words", "option", "legal"),
    [
        (["plan", "flat", "-o", "plan.csv"], "--output", ".npz or .json"),
        (["plan", "flat", "--html", "page.png"], "--html", ".html or .htm"),
        (["sip", "cartwheel", "--strip", "a.mp4"], "--strip", ".png, .pdf or .svg"),
        (["scenes", "flat", "-o", "scene.npz"], "--output", ".toml"),
        (["tasks", "walking", "-o", "task.json"], "--output", ".toml"),
    ],
)
def test_a_name_of_another_kind_is_refused_before_the_work(words, option, legal, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(words) == 2
    assert capsys.readouterr().err == f'error: {option}: must end in {legal}, got "{words[-1]}"\n'
    assert os.listdir(tmp_path) == []
