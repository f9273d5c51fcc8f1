"""mcplan run --steer: keys of a terminal, here one of the test's own."""

import os

import pytest

from mcplan.cli import main
from mcplan.cli.keyboard import DIRECTIONS, LEAST, MOST, STEPS, Keyboard, require_terminal
from mcplan.errors import InvalidInput, InvalidOptions

pty = pytest.importorskip("pty")
termios = pytest.importorskip("termios")


class Terminal:
    """A terminal, and who presses its keys."""

    def __init__(self):
        self.presses, self.reads = pty.openpty()
        self.stream = os.fdopen(self.reads, "rb", buffering=0)

    def press(self, keys: bytes) -> None:
        os.write(self.presses, keys)

    def close(self) -> None:
        self.stream.close()
        os.close(self.presses)


@pytest.fixture
def terminal():
    terminal = Terminal()
    yield terminal
    terminal.close()


def after(keyboard: Keyboard, terminal: Terminal, keys: bytes, time_s: float):
    """What is asked for once these keys have been pressed."""
    terminal.press(keys)
    return keyboard(time_s)


UP, DOWN, RIGHT, LEFT = b"\x1b[A", b"\x1b[B", b"\x1b[C", b"\x1b[D"


def test_arrows_change_velocities_within_limits_and_space_ends_them(terminal):
    with Keyboard(0.88, 90.0, terminal.stream) as keyboard:
        assert keyboard(0.0).velocity == (0.0, 0.0, 0.0)
        asked = after(keyboard, terminal, UP + b"\x1bOA" + LEFT + b"a", 0.1)  # some terminals send O for [
        assert asked.velocity == pytest.approx((2 * STEPS[0], STEPS[1], STEPS[2]))
        assert after(keyboard, terminal, UP * 20 + LEFT * 20 + b"a" * 20, 0.2).velocity == pytest.approx(MOST)
        assert after(keyboard, terminal, DOWN * 40 + RIGHT * 40 + b"d" * 40, 0.3).velocity == pytest.approx(LEAST)
        assert "ahead -0.05 m/s" in str(keyboard)
        assert after(keyboard, terminal, b" ", 0.4).velocity == (0.0, 0.0, 0.0)


def test_smaller_robots_walk_slower_and_are_pushed_less(terminal):
    with Keyboard(0.22, 45.0, terminal.stream) as keyboard:
        asked = after(keyboard, terminal, UP + LEFT + b"p", 0.0)
        assert asked.velocity == pytest.approx((0.5 * STEPS[0], 0.0, 2.0 * STEPS[2]))
        assert asked.push == pytest.approx((50.0, 0.2, DIRECTIONS[0]))
        assert after(keyboard, terminal, b"p", 0.1).push == pytest.approx((50.0, 0.2, DIRECTIONS[1]))
        assert keyboard(0.2).push is None


def test_a_key_that_comes_in_parts_is_one(terminal):
    with Keyboard(0.88, 90.0, terminal.stream) as keyboard:
        assert after(keyboard, terminal, UP[:2], 0.0).velocity == (0.0, 0.0, 0.0)
        assert after(keyboard, terminal, UP[2:], 0.1).velocity == pytest.approx((STEPS[0], 0.0, 0.0))
        assert after(keyboard, terminal, b"\x1b[15~\x1bxyz", 0.2).velocity == pytest.approx((STEPS[0], 0.0, 0.0))


def test_pushes_come_one_after_the_other(terminal):
    with Keyboard(0.88, 90.0, terminal.stream) as keyboard:
        assert after(keyboard, terminal, b"ppp", 0.0).push[2] == DIRECTIONS[0]
        assert after(keyboard, terminal, b"p", 0.1).push[2] == DIRECTIONS[1]


@pytest.mark.parametrize("key", [b"q", b"\x04"])
def test_a_run_is_ended_by_keys(terminal, key):
    with Keyboard(0.88, 90.0, terminal.stream) as keyboard:
        assert not keyboard(0.0).ends
        assert after(keyboard, terminal, key, 0.1).ends


def test_the_terminal_is_left_as_it_was(terminal):
    before = termios.tcgetattr(terminal.reads)
    with pytest.raises(KeyboardInterrupt), Keyboard(0.88, 90.0, terminal.stream):
        assert termios.tcgetattr(terminal.reads)[3] != before[3]
        raise KeyboardInterrupt
    assert termios.tcgetattr(terminal.reads) == before


def test_a_terminal_that_hangs_up_ends_the_run(terminal):
    keyboard = Keyboard(0.88, 90.0, terminal.stream)
    with keyboard:
        os.close(terminal.presses)
        assert keyboard(0.0).ends
    terminal.presses = os.open(os.devnull, os.O_RDONLY)  # for close()


@pytest.mark.parametrize(("height", "mass"), [(0.0, 90.0), (0.88, -1.0), (float("nan"), 90.0)])
def test_robots_have_a_height_and_a_mass(terminal, height, mass):
    with pytest.raises(InvalidInput, match="(com_height_m|mass_kg): must be above 0 and finite"):
        Keyboard(height, mass, terminal.stream)


def test_without_a_terminal_there_is_one_line_that_says_so(capfd, tmp_path):
    with (tmp_path / "keys").open("w+") as file, pytest.raises(InvalidOptions, match="--steer: must be used in a"):
        require_terminal(file)
    with pytest.raises(InvalidOptions):
        require_terminal(None)
    assert main(["run", "flat", "--robot", "talos", "--steer"]) == 2
    assert capfd.readouterr().err.count("\n") == 1
