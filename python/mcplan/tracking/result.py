"""A run and its measures."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from .measures import Measures
from .options import Options
from .recording import Recording


@dataclass(frozen=True)
class TrackingResult:
    """What came of tracking a plan. As text: a report of some lines.

    Attributes:
        recording: What the robot did.
        measures: How well.
        options: What was asked for, with the disturbances that were drawn from a seed.
        interrupted: Ctrl-C ended the run.
    """

    recording: Recording
    measures: Measures
    options: Options
    interrupted: bool = False

    @property
    def completed(self) -> bool:
        """Whether the run went to its end without a fall."""
        return not (self.measures.fell or self.interrupted)

    @property
    def followed(self) -> bool:
        """The same; of planar robots more is asked, see PlanarResult.followed."""
        return self.completed

    def save(self, path: str | Path) -> None:
        """Write everything, the plan included, to an .npz file, which is complete or not there at all."""
        from .run_files import save_run

        save_run(self, path)

    @staticmethod
    def load(path: str | Path) -> TrackingResult:
        """Read what save() wrote.

        Raises:
            InvalidInput: No such file of a robot with a URDF; the message names file, field and rule.
            FileNotFoundError: There is no such file.
        """
        from .run_files import load_run

        result = load_run(path)
        if not isinstance(result, TrackingResult):
            from mcplan.errors import InvalidInput

            raise InvalidInput(
                "header.kind", "must be that of a robot with a URDF; see PlanarResult.load", "", str(path)
            )
        return result

    def __str__(self) -> str:
        from .report import report

        return report(self)
