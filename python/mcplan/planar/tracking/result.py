"""A run of a planar robot and its measures."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mcplan.files.whole_body_plans import plan_to_bytes
from mcplan.tracking.options import Options
from mcplan.tracking.run_files import PLANAR_RUN, Arrays, Header, RunParts, load_run, measures_of, options_of, save_run

from .measures import PlanarMeasures
from .recording import PlanarRecording, recording_from
from .report import report

#: Contact forces that are off the plan's by more than this ratio are others: the run then proves nothing about the plan.
OTHER_FORCES = 0.25


@dataclass(frozen=True)
class PlanarResult:
    """Result of tracking a whole-body plan. As text: a report of some lines.

    Attributes:
        recording: What the robot did.
        measures: How well, and how near its contact forces were to the planned ones.
        options: Options of the run.
        interrupted: Whether Ctrl-C ended the run.
    """

    recording: PlanarRecording
    measures: PlanarMeasures
    options: Options
    interrupted: bool = False

    @property
    def completed(self) -> bool:
        """Whether the run went to its end and the robot was where the plan has it."""
        return self.measures.completed and not self.interrupted

    @property
    def followed(self) -> bool:
        """Whether it was completed with the plan's contact forces: less than a quarter off, rms over rms."""
        return self.completed and self.measures.force_rms <= OTHER_FORCES

    def save(self, path: str | Path) -> None:
        """Write everything, the plan included, to an .npz file, which is complete or not there at all."""
        run = self.recording
        parts = RunParts(
            PLANAR_RUN,
            run,
            plan_to_bytes(run.plan),
            self.measures,
            self.options,
            self.interrupted,
            run.left_plan_at_s,
            {"joints": list(run.joints), "ends": list(run.end_effectors)},
        )
        save_run(parts, path)

    @staticmethod
    def load(path: str | Path) -> PlanarResult:
        """Read what save() wrote.

        Raises:
            InvalidInput: No such file of a planar robot; the message names file, field and rule.
            FileNotFoundError: There is no such file.
        """
        return load_run(path, {PLANAR_RUN: result_from})

    def __str__(self) -> str:
        return report(self)


def result_from(header: Header, arrays: Arrays) -> PlanarResult:
    """The result that the file of a run contains."""
    recording = recording_from(header, arrays)
    measures = PlanarMeasures.from_dict(measures_of(header))
    return PlanarResult(recording, measures, options_of(header), bool(header["interrupted"]))
