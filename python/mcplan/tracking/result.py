"""A run and its measures."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path

from mcplan.files.plans import plan_to_bytes
from mcplan.files.robots import robot_to_dict
from mcplan.files.scenes import scene_to_dict

from .measures import Measures
from .options import Options
from .recording import Recording, recording_from
from .report import report
from .run_files import RUN, Arrays, Header, RunParts, load_run, measures_of, options_of, save_run
from .standing import falls_at_end


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
        """The same, and the robot stands at the end; of planar robots more is asked, see PlanarResult.followed."""
        return self.completed and not self.falls_at_end

    @property
    def falls_at_end(self) -> bool:
        """Whether the robot cannot stand where the run left it: its capture point is beside its soles."""
        return falls_at_end(self.recording)

    def save(self, path: str | Path) -> None:
        """Write everything, the plan included, to an .npz file, which is complete or not there at all."""
        save_run(self._parts(), path)

    def _parts(self) -> RunParts:
        """The content of its file."""
        run = self.recording
        return RunParts(
            RUN,
            run,
            plan_to_bytes(run.plan),
            self.measures,
            self.options,
            self.interrupted,
            run.fell_at_s,
            {
                "joints": list(run.joints),
                "robot": None if run.robot is None else robot_to_dict(run.robot),
                "touches": [asdict(touch) for touch in run.touches],
                "true_scene": None if run.true_scene is None else scene_to_dict(run.true_scene),
            },
        )

    @staticmethod
    def load(path: str | Path) -> TrackingResult:
        """Read what save() wrote.

        Raises:
            InvalidInput: No such file of a robot with a URDF; the message names file, field and rule.
            FileNotFoundError: There is no such file.
        """
        return load_run(path, {RUN: result_from})

    def __str__(self) -> str:
        return report(self)


def result_from(header: Header, arrays: Arrays) -> TrackingResult:
    """The result that the file of a run contains."""
    recording = recording_from(header, arrays)
    measures = Measures(**measures_of(header))
    return TrackingResult(recording, measures, options_of(header), bool(header["interrupted"]))
