"""Contacts that nobody planned: links of a robot with each other, and links other than end-effectors with the terrain."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

#: A touch that pauses for no longer than this [s] goes on.
PAUSE_S = 0.05


@dataclass(frozen=True)
class Touch:
    """One contact of a link with another one, or with a surface.

    Attributes:
        links: Names of the two links; or of one and of the surface.
        terrain: Whether the second one is a surface.
        start_s, end_s: When it began, and when it was seen last.
        depth_m: Largest depth to which the shapes overlap.
        force_N: Largest normal force.
    """

    links: tuple[str, str]
    terrain: bool
    start_s: float
    end_s: float
    depth_m: float
    force_N: float

    def __str__(self) -> str:
        first, second = self.links
        return f"{first} {'on' if self.terrain else 'and'} {second} at {self.start_s:.2f} s, {self.force_N:.0f} N"


class TouchLog:
    """Collects touches control step by control step."""

    def __init__(self) -> None:
        self._open: dict[tuple[tuple[str, str], bool], Touch] = {}
        self._done: list[Touch] = []

    def add(self, time_s: float, seen: Iterable[Touch]) -> None:
        """Take in what touches at an instant."""
        for touch in seen:
            key = (touch.links, touch.terrain)
            before = self._open.get(key)
            if before is None or time_s - before.end_s > PAUSE_S:
                if before is not None:
                    self._done.append(before)
                self._open[key] = replace(touch, start_s=time_s, end_s=time_s)
                continue
            depth_m, force_N = max(before.depth_m, touch.depth_m), max(before.force_N, touch.force_N)
            self._open[key] = replace(before, end_s=time_s, depth_m=depth_m, force_N=force_N)

    def drop(self, before_s: float) -> None:
        """Forget what had ended by then."""
        self._done = [touch for touch in self._done if touch.end_s >= before_s]
        self._open = {key: touch for key, touch in self._open.items() if touch.end_s >= before_s}

    def touches(self) -> tuple[Touch, ...]:
        """All of them in the order in which they began."""
        return tuple(sorted([*self._done, *self._open.values()], key=lambda touch: (touch.start_s, touch.links)))


def hardest(touches: Sequence[Touch], terrain: bool) -> Touch | None:
    """The touch with the largest force, of links with each other or with the terrain; None: there is none."""
    return max((touch for touch in touches if touch.terrain == terrain), key=lambda touch: touch.force_N, default=None)
