"""Pictures of pages through a browser without a window."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path

from mcplan.errors import MissingExtra
from mcplan.files.outputs import write_whole

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")


def find_browser() -> str | None:
    """Path of an installed Chromium or Chrome, or None."""
    return next((path for name in BROWSERS if (path := shutil.which(name))), None)


def screenshot(html: str, target: Path, fragment: str, size: tuple[int, int], timeout_s: float = 120.0) -> Path:
    """Write a PNG of a page.

    Args:
        html: The page.
        target: File to write.
        fragment: The part of its address behind "#".
        size: Width and height in pixels.
        timeout_s: Longest wait [s].

    Raises:
        MissingExtra: No browser is installed.
        RuntimeError: The browser wrote no picture.
    """
    browser = find_browser()
    if browser is None:
        raise MissingExtra(
            "Page.save_png needs Chromium or Chrome: apt-get install chromium (save_plots needs neither)"
        )
    with tempfile.TemporaryDirectory(prefix="mcplan-page-") as folder:
        page = Path(folder) / "page.html"
        page.write_text(html, encoding="utf-8")
        picture = Path(folder) / "page.png"
        command = [
            browser,
            "--headless=new",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
            f"--window-size={size[0]},{size[1]}",
            "--virtual-time-budget=8000",  # WebGL draws late: without it the picture may be taken before
            f"--user-data-dir={folder}/profile",
            f"--screenshot={picture}",
            f"{page.as_uri()}#{fragment}",
        ]
        try:
            result = subprocess.run(command, capture_output=True, text=True, timeout=timeout_s, check=False)
        except subprocess.TimeoutExpired as error:
            raise RuntimeError(f"{browser} took no picture within {timeout_s:g} s") from error
        if not picture.exists():
            raise RuntimeError(f"{browser} took no picture: {result.stderr.strip()[-300:]}")
        return write_whole(picture.read_bytes(), target)
