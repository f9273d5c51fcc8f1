"""The files that a run is written to: --video, --html, --strip, --plots, --save."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mcplan.cli.track_text import Progress
    from mcplan.planar.tracking import PlanarResult
    from mcplan.tracking import TrackingResult


@dataclass(frozen=True)
class RunOutputs:
    """Where to write; None: not asked for."""

    video: Path | None = None
    html: Path | None = None
    strip: Path | None = None
    plots: Path | None = None
    save: Path | None = None
    verb: str = "track"

    def require(self, source: Path | None = None) -> None:
        """Say what cannot be written before simulating, not after.

        Args:
            source: The file of which the run is made, which is not replaced.

        Raises:
            InvalidInput: A folder does not exist or cannot be written to, a file stands where a folder should be or the
                other way round, or a name has the wrong ending.
            MissingExtra: What draws is not installed.
        """
        from mcplan.cli.outputs import require_outputs, require_rendering
        from mcplan.files.outputs import ARCHIVE, require_target

        require_target("--save", self.save, ARCHIVE, source)
        require_target("--strip", self.strip, (".png",))
        require_outputs(self.verb, None, self.html, self.plots)
        if self.video is not None:
            from mcplan.view.video.files import SUFFIXES, check_target

            require_target("--video", self.video, SUFFIXES)
            check_target(self.video)
        for option, path in (("--video", self.video), ("--strip", self.strip)):
            if path is not None:
                require_rendering(f"mcplan {self.verb} {option}")

    def write(self, result: TrackingResult | PlanarResult, progress: Progress) -> list[str]:
        """Write what was asked for, the quick ones first.

        Returns:
            Names of what was written.
        """
        from mcplan.showing import save_plots, save_strip, save_video, show

        if self.save is not None:
            progress.working("saving the run")
            result.save(self.save)
        if self.plots is not None:
            progress.working("plotting")
            save_plots(result, None, self.plots)
        if self.html is not None:
            progress.working("drawing the page")
            show(result).save_html(self.html)
        if self.strip is not None:
            progress.working("taking snapshots")
            save_strip(result, self.strip)
        if self.video is not None:
            save_video(result, self.video, progress=progress.drawn)
        progress.end()
        return [str(path) for path in (self.save, self.plots, self.html, self.strip, self.video) if path is not None]
