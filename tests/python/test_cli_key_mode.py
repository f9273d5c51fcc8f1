"""A terminal is left as it was, however a program that reads its keys is stopped or ended."""

import os
import select
import signal
import subprocess
import sys

import pytest

pty = pytest.importorskip("pty")
termios = pytest.importorskip("termios")

from mcplan.cli.key_mode import KeyMode  # noqa: E402

PROGRAM = """
import signal, time
from mcplan.cli.key_mode import KeyMode
signal.signal(signal.SIGHUP, signal.SIG_DFL)  # nohup ignores it
KeyMode(0).begin()
print("begun", flush=True)
time.sleep(60)
"""


def local_modes(descriptor: int) -> int:
    return termios.tcgetattr(descriptor)[3]


def reads_keys(descriptor: int) -> bool:
    return not local_modes(descriptor) & (termios.ICANON | termios.ECHO)


def started(terminal: int) -> subprocess.Popen:
    """The program on a terminal, in a group of processes that can be stopped: its parent is in another one."""
    words = [sys.executable, "-c", PROGRAM]
    return subprocess.Popen(words, stdin=terminal, stdout=subprocess.PIPE, preexec_fn=lambda: os.setpgid(0, 0))


def test_keys_come_at_once_until_the_end_and_signals_are_left_as_they_were():
    ours, theirs = pty.openpty()
    handlers = [signal.getsignal(number) for number in (signal.SIGTSTP, signal.SIGTERM, signal.SIGHUP)]
    before = termios.tcgetattr(theirs)
    mode = KeyMode(theirs)
    mode.begin()
    assert reads_keys(theirs)
    os.write(ours, b"a")
    assert select.select([theirs], [], [], 5.0)[0] and os.read(theirs, 1) == b"a"  # without a line's end
    mode.end()
    assert termios.tcgetattr(theirs) == before
    assert handlers == [signal.getsignal(number) for number in (signal.SIGTSTP, signal.SIGTERM, signal.SIGHUP)]
    os.close(ours)
    mode.end()  # its other end is gone
    os.close(theirs)
    mode.end()


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_signal_that_ends_the_process_leaves_the_terminal_usable(number):
    ours, theirs = pty.openpty()
    usual = local_modes(theirs)
    with started(theirs) as process:
        assert process.stdout.readline() == b"begun\n"
        assert reads_keys(theirs)
        process.send_signal(number)
        assert process.wait(30) == -number
    assert local_modes(theirs) == usual
    os.close(ours)
    os.close(theirs)


def test_a_process_that_is_stopped_gives_the_terminal_back_and_takes_it_again():
    ours, theirs = pty.openpty()
    usual = local_modes(theirs)
    with started(theirs) as process:
        assert process.stdout.readline() == b"begun\n"
        os.kill(process.pid, signal.SIGTSTP)
        _, status = os.waitpid(process.pid, os.WUNTRACED)
        assert os.WIFSTOPPED(status) and local_modes(theirs) == usual
        os.kill(process.pid, signal.SIGCONT)
        for _ in range(600):
            if reads_keys(theirs):
                break
            select.select([], [], [], 0.05)
        assert reads_keys(theirs)
        process.kill()
    os.close(ours)
    os.close(theirs)
