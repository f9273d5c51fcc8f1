"""Pictures written as a video: .mp4 by ffmpeg, animated .webp and .gif by Pillow."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidInput, MissingExtra, either, shown_path
from mcplan.extras import require
from mcplan.files.outputs import whole_file

Pixels = NDArray[np.uint8]

SUFFIXES = (".mp4", ".webp", ".gif")


def find_ffmpeg() -> str | None:
    """Path of an ffmpeg: the one on the path, else that of the package imageio-ffmpeg; None: there is neither."""
    found = shutil.which("ffmpeg")
    if found is None and importlib.util.find_spec("imageio_ffmpeg") is not None:
        import imageio_ffmpeg

        try:
            found = str(imageio_ffmpeg.get_ffmpeg_exe())
        except RuntimeError:  # the package is there, its program is not
            return None
    return found


def check_target(path: Path) -> None:
    """Make sure that a video can be written under this name, before anything is rendered.

    Raises:
        InvalidInput: The file's name has none of the suffixes .mp4, .webp, .gif; or its folder does not exist.
        MissingExtra: It needs ffmpeg or Pillow, which is not there; the message says what to install.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise InvalidInput("video", f"must end in {either(SUFFIXES)}", shown_path(path))
    if not path.resolve().parent.is_dir():
        raise InvalidInput("video", "must lie in a folder that exists", shown_path(path))
    if suffix == ".mp4":
        if find_ffmpeg() is None:
            raise MissingExtra(
                f"{path.name} needs ffmpeg: pip install 'mcplan[video]' or apt-get install ffmpeg "
                "(names in .webp and .gif need neither)"
            )
    else:
        require(f"{path.name}", "sim", "PIL")


def write_video(frames: Iterator[Pixels], path: Path, rate_hz: float) -> None:
    """Write a video, which is complete or not there at all.

    Args:
        frames: Pictures (height, width, 3) of one size; for .mp4 of even width and height.
        path: File to write; its suffix says how.
        rate_hz: Pictures in a second.

    Raises:
        InvalidInput, MissingExtra: As check_target does.
        RuntimeError: ffmpeg failed; the message carries its last words.
        OSError: The file cannot be written.
    """
    check_target(path)
    with whole_file(path) as temporary:
        if path.suffix.lower() == ".mp4":
            _write_mp4(frames, temporary, rate_hz, path.name)
        else:
            _write_animation(frames, temporary, rate_hz)


def _write_mp4(frames: Iterator[Pixels], path: Path, rate_hz: float, name: str) -> None:
    first = next(frames)
    height, width = first.shape[:2]
    command = [str(find_ffmpeg()), "-y", "-loglevel", "error"]
    command += ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{rate_hz:g}", "-i", "-"]
    # yuv420p: what every player and browser reads.
    command += ["-an", "-c:v", "libx264", "-preset", "medium", "-crf", "20", "-pix_fmt", "yuv420p"]
    command += ["-movflags", "+faststart", str(path)]
    with tempfile.TemporaryFile() as words:
        # In a session of its own: Ctrl-C is for this process, which then ends the encoder.
        encoder = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=words, start_new_session=True
        )
        assert encoder.stdin is not None
        try:
            encoder.stdin.write(first.tobytes())
            for frame in frames:
                encoder.stdin.write(frame.tobytes())
        except BrokenPipeError:
            pass  # it has ended; why, it says below
        except BaseException:
            encoder.kill()
            encoder.wait()
            raise
        encoder.communicate()
        if encoder.returncode != 0:
            words.seek(0)
            said = words.read().decode(errors="replace").strip()
            raise RuntimeError(f"ffmpeg wrote no {name}: {said[-300:]}")


def _write_animation(frames: Iterator[Pixels], path: Path, rate_hz: float) -> None:
    from PIL import Image

    first = Image.fromarray(next(frames))
    rest = (Image.fromarray(frame) for frame in frames)
    common = {"save_all": True, "append_images": rest, "duration": 1000.0 / rate_hz, "loop": 0}
    if path.suffix.lower() == ".gif":
        # Durations of GIFs are whole hundredths of a second.
        common["duration"] = 10 * max(2, round(100.0 / rate_hz))
        first.save(path, format="GIF", **common)
    else:
        common["duration"] = round(1000.0 / rate_hz)
        first.save(path, format="WEBP", quality=75, method=2, **common)
