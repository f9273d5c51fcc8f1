"""mcplan run --steer: velocities and pushes from the keys of a terminal."""

from __future__ import annotations

import os
import select
import sys
import time
from types import TracebackType
from typing import Any

from mcplan.cli.key_mode import KeyMode
from mcplan.errors import InvalidInput, InvalidOptions
from mcplan.online.steering import Asked

Velocity = tuple[float, float, float]

#: What a line at the beginning says of them.
KEYS = "up, down: ahead; left, right: turn; a, d: to a side; space: on the spot; p: push; q: end"
#: Steps of velocities ahead, to the left [m/s] and turning [rad/s], their least and most, of a robot of human size.
STEPS: Velocity = (0.05, 0.025, 0.1)
LEAST: Velocity = (-0.05, -0.075, -0.4)
MOST: Velocity = (0.2, 0.075, 0.4)
#: Height of the CoM [m] and mass [kg] of a robot of human size, a push for it [N], how long it acts [s], and the directions
#: of one after the other [degrees].
HUMAN_M, HUMAN_KG, PUSH_N, PUSH_S = 0.88, 90.0, 100.0, 0.2
DIRECTIONS = (90.0, 180.0, 270.0, 0.0)
#: Keys by what a terminal sends: the velocity that they change, and by how many steps.
_STEERS = {
    b"\x1b[A": (0, 1),
    b"\x1b[B": (0, -1),
    b"\x1b[D": (2, 1),
    b"\x1b[C": (2, -1),
    b"a": (1, 1),
    b"d": (1, -1),
}
#: What ends the run, Ctrl-D among it.
_ENDS = (b"q", b"\x04")
#: So long at most a run waits for its clock at once [s], and every so often keys are looked for [s].
_WAIT_S, _LOOK_S = 0.05, 0.02


class Keyboard:
    """What is asked of a robot by keys, at real time at most: the option ``steer`` of mcplan.run.

        with Keyboard(robot.com_height, robot.mass) as keyboard:
            mp.run(plan, steer=keyboard)

    Args:
        com_height_m: Of the robot: velocities are those of one of human size, times the root of the ratio of heights.
        mass_kg: Of the robot: pushes are in proportion to it.
        stream: Where keys come from; None: standard input.

    Attributes:
        velocity: Ahead, to the left [m/s], turning [rad/s].

    Raises:
        InvalidInput: A robot of no height or mass.
        InvalidOptions: The stream is no terminal, or the system has none whose keys can be read one by one.
    """

    def __init__(self, com_height_m: float, mass_kg: float, stream: Any = None) -> None:
        for name, value in (("com_height_m", com_height_m), ("mass_kg", mass_kg)):
            if not 0.0 < value < float("inf"):
                raise InvalidInput(name, "must be above 0 and finite", f"{value:g}")
        ratio = (com_height_m / HUMAN_M) ** 0.5
        self._scale: Velocity = (ratio, ratio, 1.0 / ratio)
        self._push_N = PUSH_N * mass_kg / HUMAN_KG
        self._stream = sys.stdin if stream is None else stream
        self._counts = [0, 0, 0]
        self._pending = b""
        self._pushes, self._began_s, self._looked_s = 0, -1.0, -1.0
        require_terminal(self._stream)
        self._mode = KeyMode(self._stream.fileno())

    @property
    def velocity(self) -> Velocity:
        """What is asked for now."""
        ahead, left, turn = (n * step * scale for n, step, scale in zip(self._counts, STEPS, self._scale, strict=True))
        return ahead, left, turn

    def __enter__(self) -> Keyboard:
        self._mode.begin()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        self._mode.end()

    def __call__(self, time_s: float) -> Asked:
        """What the keys ask for that were pressed since the last call; see mcplan.online.Asked."""
        self._pace(time_s)
        if 0.0 <= time_s - self._looked_s < _LOOK_S and self._looked_s >= 0.0:
            return Asked(self.velocity)
        self._looked_s = time_s
        push, ends = None, False
        for key in self._pressed():
            if key in _STEERS:
                self._change(*_STEERS[key])
            elif key == b" ":
                self._counts = [0, 0, 0]
            elif key == b"p" and push is None:
                push = (self._push_N, PUSH_S, DIRECTIONS[self._pushes % len(DIRECTIONS)])
                self._pushes += 1
            ends = ends or key in _ENDS
        return Asked(self.velocity, push, ends)

    def __str__(self) -> str:
        ahead, left, turn = self.velocity
        return f"ahead {ahead:.2f} m/s, left {left:.3f} m/s, turning {turn:.2f} rad/s"

    def _change(self, which: int, by: int) -> None:
        steps = STEPS[which]
        least, most = round(LEAST[which] / steps), round(MOST[which] / steps)
        self._counts[which] = min(max(self._counts[which] + by, least), most)

    def _pace(self, time_s: float) -> None:
        """Wait until the clock has come as far as the simulated time, which may lag behind."""
        now_s = time.monotonic()
        if self._began_s < 0.0 or now_s - self._began_s > time_s:
            self._began_s = now_s - time_s  # what was lost is not made good by haste
        ahead_s = time_s - (now_s - self._began_s)
        if ahead_s > 0.0:
            time.sleep(min(ahead_s, _WAIT_S))

    def _pressed(self) -> list[bytes]:
        """Keys since the last call; what a terminal has sent of one in part waits for its rest."""
        descriptor = self._stream.fileno()
        try:
            while select.select([descriptor], [], [], 0.0)[0]:
                more = os.read(descriptor, 64)
                if not more:  # nobody is there any more
                    return [b"q"]
                self._pending += more
        except OSError:  # nor is the terminal
            return [b"q"]
        keys = []
        while self._pending:
            length = _length(self._pending)
            if length > len(self._pending):
                break
            key, self._pending = self._pending[:length], self._pending[length:]
            keys.append(key.replace(b"\x1bO", b"\x1b["))
        return keys


def _length(sent: bytes) -> int:
    """Bytes of the first key of what a terminal has sent."""
    if not sent.startswith(b"\x1b"):
        return 1
    if len(sent) < 2:
        return 2
    if sent[1:2] not in (b"[", b"O"):
        return 1
    for i in range(2, len(sent)):
        if 0x40 <= sent[i] <= 0x7E:
            return i + 1
    return len(sent) + 1


def require_terminal(stream: Any) -> None:
    """Raise InvalidOptions unless keys can be read one by one from a stream."""
    try:
        import termios  # noqa: F401  # not everywhere
    except ImportError:
        raise InvalidOptions("--steer", "must be used on a system with terminals of POSIX", sys.platform) from None
    if stream is None or stream.closed or not stream.isatty():
        raise InvalidOptions("--steer", "must be used in a terminal, whose keys it reads", "another standard input")
