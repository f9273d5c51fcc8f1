"""The shell blocks of the README work as they stand: in their order, in one empty folder."""

import re
import shlex
from pathlib import Path

import pytest

import mcplan as mp
from mcplan.cli import main
from mcplan.files.scenes import save_scene

README = Path(__file__).resolve().parents[2] / "README.md"

#: What takes over some seconds, and what stands for it in the quick test: near.toml is flat, with the goal 0.2 m away.
SHORTER = {
    "mcplan plan stairs_broad --robot talos": "mcplan plan near.toml --robot talos --phases 8",
    "mcplan rhp rubbles": "mcplan rhp flat --lookahead 2 --cycles 2",
    "mcplan sip climbing --certify": "mcplan sip cartwheel --minimise none",
    "mcplan sip walking": "mcplan sip cartwheel --minimise none",
    "mcplan demo": "mcplan demo --help",
    "mcplan reproduce tazaki": "mcplan reproduce tazaki --help",
    "mcplan bench": "mcplan bench --help",
    "mcplan bench robustness": "mcplan bench robustness --help",
    "mcplan bench contacts": "mcplan bench contacts --list",
}


class Simulates(Exception):
    """A run has begun."""


def blocks() -> list[list[str]]:
    """The commands of each fenced block without a language that calls mcplan, comments cut off."""
    # Between fences, text and code take turns.
    pieces = re.split(r"^```(.*)\n", README.read_text(encoding="utf-8"), flags=re.MULTILINE)
    bodies = [body for language, body in zip(pieces[1::4], pieces[2::4], strict=True) if not language]
    found = []
    for body in bodies:
        lines = [re.sub(r"\s+#.*", "", line) for line in body.splitlines()]
        commands = [part.strip() for line in lines for part in line.split("&&")]
        if commands and all(command.startswith("mcplan ") for command in commands):
            found.append(commands)
    return found


def test_the_blocks_are_found():
    verbs = {command.split()[1] for commands in blocks() for command in commands}
    assert len(blocks()) == 6
    assert verbs >= {"plan", "check", "rhp", "sip", "track", "scenes", "robots", "tasks", "demo", "bench"}


@pytest.fixture
def needs_everything():
    for name in ("meshcat", "matplotlib", "mujoco", "pinocchio", "proxsuite", "example_robot_data", "scipy"):
        pytest.importorskip(name)


@pytest.mark.usefixtures("needs_everything")
@pytest.mark.parametrize("number", range(6))
def test_every_line_is_accepted_after_those_before_it(number, tmp_path, monkeypatch, capsys):
    """What takes long is shortened; a run counts as begun where the simulation would."""

    def begin(*_, **__):
        raise Simulates

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("mcplan.tracking.runner._run", begin)
    near = mp.load_scene("flat")
    near.goal.position_W = [0.2, 0.0, 0.0]
    save_scene(near, Path("near.toml"))
    for command in blocks()[number]:
        for long, short in SHORTER.items():
            if command == long or command.startswith(f"{long} -"):
                command = command.replace(long, short)
        if command.startswith("mcplan track"):
            with pytest.raises(Simulates):
                main(shlex.split(command)[1:])
            continue
        if command.startswith("mcplan run"):
            command = re.sub(r" --duration \S+", "", command.replace(",1.4,90", ",0.1,90")) + " --duration 0.2"
        code = main(shlex.split(command)[1:])
        assert code == 0, f"{command}: {capsys.readouterr()}"


@pytest.mark.slow
@pytest.mark.usefixtures("needs_everything")
@pytest.mark.parametrize("number", range(6))
def test_every_line_succeeds_as_it_stands(number, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for command in blocks()[number]:
        code = main(shlex.split(command)[1:])
        assert code == 0, f"{command}: {capsys.readouterr()}"
